// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the 64 samples of cells hang together. Units: cell edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/geometry.h"

namespace stylet::bake {

// Of a cell's samples, in the cell.
using SamplePlaces = std::array<Vec, 64>;

// Samples nearer than this hang together. Flat cuts through a cell then leave one part but for
// specks of up to three samples (in 1 of 1000 cuts more); neighbours that a cut grazes may be apart
// with a little in each.
constexpr double kReach = 0.36;
constexpr int kLeastPart = 6, kLeastNeighbour = 16;

using Near = std::array<std::uint64_t, 64>;

// Of each sample, those nearer than `reach` in the cell at `offset`.
Near near_samples(const SamplePlaces& places, Vec offset, double reach);
std::uint64_t reached(std::uint64_t from, const Near& near);

// The samples `bits` of a cell by what hangs together; `near` of the cell itself.
std::vector<std::uint64_t> connected_parts(std::uint64_t bits, const Near& near);

// From a place to the nearest of some samples of the cell at `offset`.
double distance_to(std::uint64_t bits, const SamplePlaces& places, Vec offset, Vec place);

}  // namespace stylet::bake
