// SPDX-License-Identifier: Apache-2.0
// Which material lies where in an organ file: an independent reading, without the kernel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "offline_support.h"

namespace stylet::test {

struct VoxelPlace {
  std::uint32_t x, y, z;
};

// Cell of each voxel, in space.
inline std::vector<VoxelPlace> cells_of(const Organ& organ) {
  std::vector<VoxelPlace> cells;
  for (const OrganRun& run : organ.runs) {
    const std::uint32_t y = std::uint32_t{run.y} % organ.sheet_rows;
    for (std::uint32_t i = 0; i < run.count; ++i) cells.push_back({run.x + i, y, run.z});
  }
  return cells;
}

// The sub-samples of its cell that belong to each voxel.
inline std::vector<std::uint64_t> quarters_of(const Organ& organ) {
  std::vector<std::uint64_t> quarters;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const auto part = std::find_if(
          organ.parts.begin(), organ.parts.end(),
          [&](const OrganPart& p) { return p.x == run.x + i && p.y == run.y && p.z == run.z; });
      quarters.push_back(part == organ.parts.end() ? ~std::uint64_t{0} : part->quarters);
    }
  }
  return quarters;
}

struct Places {
  const Organ& organ;
  std::vector<VoxelPlace> cells;
  std::vector<std::uint64_t> quarters;

  explicit Places(const Organ& of) : organ(of), cells(cells_of(of)), quarters(quarters_of(of)) {}

  // The material at a place; kNoTissue also outside the lattice.
  int material_at(offline::Vec place) const {
    const double edge = static_cast<double>(organ.voxel_edge_m);
    const offline::Vec origin = {static_cast<double>(organ.origin_m.x),
                                 static_cast<double>(organ.origin_m.y),
                                 static_cast<double>(organ.origin_m.z)};
    const offline::Vec at = (place - origin) * (1 / edge);
    const offline::Vec low = {std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    const offline::Vec part = at - low;
    const auto quarter = [](double f) { return static_cast<unsigned>(4 * f); };
    const unsigned bit = quarter(part.x) + 4 * quarter(part.y) + 16 * quarter(part.z);
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      if (cells[i].x != low.x || cells[i].y != low.y || cells[i].z != low.z) continue;
      if ((quarters[i] >> bit & 1U) == 0) continue;
      const auto two = std::find_if(organ.mixed.begin(), organ.mixed.end(),
                                    [i](const OrganMixed& m) { return m.voxel == i; });
      if (two == organ.mixed.end()) return organ.voxel_material[i];
      const double side = static_cast<double>(two->nx) * part.x +
                          static_cast<double>(two->ny) * part.y +
                          static_cast<double>(two->nz) * part.z;
      return side > static_cast<double>(two->limit) ? two->material : organ.voxel_material[i];
    }
    return kNoTissue;
  }
};

// How far each material reaches from `from` along `way`, in steps of 1/100 of a voxel.
inline std::vector<double> lengths_along(const Organ& organ, offline::Vec from, offline::Vec way,
                                         double length_m) {
  const Places places(organ);
  const double step = static_cast<double>(organ.voxel_edge_m) / 100;
  std::vector<double> lengths(organ.material_count, 0);
  for (double at = 0.5 * step; at < length_m; at += step) {
    const int material = places.material_at(from + way * at);
    if (material != kNoTissue) lengths[static_cast<std::size_t>(material)] += step;
  }
  return lengths;
}

}  // namespace stylet::test
