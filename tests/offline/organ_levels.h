// SPDX-License-Identifier: Apache-2.0
// Options for voxels of several sizes; and where those of all levels lie: an independent reading of
// an organ, without the kernel. Units: those of a `Cube` are edges of the finest level, from the
// organ's origin.
#pragma once

#include <array>
#include <map>

#include "offline_support.h"

namespace stylet::test {

inline offline::BuildOptions refined(double voxel_mm, const std::vector<std::string>& where) {
  offline::BuildOptions options;
  options.voxel_edge_m = voxel_mm * 1e-3;
  for (const std::string& text : where) {
    options.refinements.push_back(offline::parse_refinement(text, "--refine"));
  }
  return options;
}

struct Cube {
  std::uint32_t level;
  std::array<int, 3> low;  // in space
  int size;
  std::array<std::uint32_t, 3> place;  // in the lattice
};

inline std::vector<Cube> cubes_of(const Organ& organ) {
  std::vector<Cube> cubes;
  for (const OrganRun& run : organ.runs) {
    std::uint32_t level = 0, z = run.z, planes = organ.level_planes;
    while (z > planes) {  // behind each level's planes is an empty one
      z -= planes + 1;
      planes *= 2;
      ++level;
    }
    const int size = 1 << (organ.levels - 1U - level);
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const int x = static_cast<int>(run.x + i), y = run.y % organ.sheet_rows;
      cubes.push_back({level,
                       {x * size, y * size, static_cast<int>(z) * size},
                       size,
                       {run.x + i, run.y, run.z}});
    }
  }
  return cubes;
}

inline double finest_m(const Organ& organ) {
  return static_cast<double>(organ.voxel_edge_m) / (1 << (organ.levels - 1));
}

inline offline::Vec low_m(const Organ& organ, const Cube& cube) {
  const offline::Vec origin = {static_cast<double>(organ.origin_m.x),
                               static_cast<double>(organ.origin_m.y),
                               static_cast<double>(organ.origin_m.z)};
  const offline::Vec low = {1.0 * cube.low[0], 1.0 * cube.low[1], 1.0 * cube.low[2]};
  return origin + low * finest_m(organ);
}

inline double edge_m(const Organ& organ, const Cube& cube) {
  return finest_m(organ) * cube.size;
}

inline double filled_m3(const Organ& organ) {
  double sum = 0;
  const std::vector<Cube> cubes = cubes_of(organ);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    sum += organ.voxel_fill[i] / 255.0 * std::pow(edge_m(organ, cubes[i]), 3);
  }
  return sum;
}

inline offline::Vec vertex_m(const Organ& organ, const std::vector<Cube>& cubes,
                             const OrganVertex& v) {
  const Cube& cube = cubes[v.voxel];
  const offline::Vec part = {v.fx / 65535.0, v.fy / 65535.0, v.fz / 65535.0};
  return low_m(organ, cube) + part * edge_m(organ, cube);
}

// The voxel in each cell of the finest level; cells without voxels are not there.
using CellsOf = std::map<std::array<int, 3>, std::size_t>;
inline CellsOf finest_cells(const std::vector<Cube>& cubes) {
  CellsOf cells;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const Cube& cube = cubes[i];
    for (int n = 0; n < cube.size * cube.size * cube.size; ++n) {
      const std::array<int, 3> at = {cube.low[0] + n % cube.size,
                                     cube.low[1] + n / cube.size % cube.size,
                                     cube.low[2] + n / cube.size / cube.size};
      EXPECT_TRUE(cells.emplace(at, i).second) << "two voxels in one place";
    }
  }
  return cells;
}

}  // namespace stylet::test
