// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the 64 samples of cells are connected. Units: cell edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

// Places of a cell's samples, within the cell.
using SamplePlaces = std::array<Vec, 64>;

// Samples nearer to each other than this are connected. A flat cut through a cell then leaves one
// part and specks of up to three samples (more in 1 of 1000 cuts). If a cut grazes two neighbouring
// cells, their few samples may be unconnected.
constexpr double kReach = 0.36;
constexpr int kLeastPart = 6, kLeastNeighbour = 16;

using Near = std::array<std::uint64_t, 64>;

// For each sample, the samples of the cell at `offset` that are nearer than `reach`.
Near near_samples(const SamplePlaces& places, Vec offset, double reach);
std::uint64_t reached(std::uint64_t from, const Near& near);

// The samples `bits` of a cell divided into connected parts; `near` is for the cell itself.
std::vector<std::uint64_t> connected_parts(std::uint64_t bits, const Near& near);

// Distance from a place to the nearest of the samples `bits` of the cell at `offset`.
double distance_to(std::uint64_t bits, const SamplePlaces& places, Vec offset, Vec place);

}  // namespace stylet::offline
