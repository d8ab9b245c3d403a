// SPDX-License-Identifier: Apache-2.0
// Two blocks, one on the other, that may slide: a floor in the first sheet of the lattice and a lid
// in the second, with a plane between them at any height, also within voxels. Units: SI; heights
// and widths in voxel edges where a name says so.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "owned_organ.h"

namespace stylet::test {

struct TwoParts {
  std::uint16_t floor_x = 8, floor_y = 6;  // voxels of the floor
  std::uint16_t lid_x = 8, lid_y = 6;      // of the lid, which lies from (at_x, at_y) on
  std::uint16_t at_x = 0, at_y = 0;
  float plane = 4;  // height of the plane
  std::uint16_t height = 8;
  float friction = 0;
  float voxel_edge_m = 0.005F;
  TinyMaterial floor, lid;
  bool held = true;  // the floor's low face
};

inline std::unique_ptr<Owner> two_parts(const TwoParts& parts) {
  const auto rows = static_cast<std::uint16_t>(std::max(parts.floor_y,
      static_cast<std::uint16_t>(parts.at_y + parts.lid_y)) + 1);
  const auto floor_top = static_cast<std::uint16_t>(std::ceil(parts.plane));
  const auto lid_low = static_cast<std::uint16_t>(std::floor(parts.plane));
  TinyOrgan tiny;
  tiny.nx = std::max(parts.floor_x, static_cast<std::uint16_t>(parts.at_x + parts.lid_x));
  tiny.ny = static_cast<std::uint16_t>(2 * rows);
  tiny.nz = parts.height;
  tiny.voxel_edge_m = parts.voxel_edge_m;
  tiny.materials = {parts.floor, parts.lid};
  tiny.fixed_faces = parts.held ? kLowZ : 0U;
  const auto in_lid = [=](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return y >= rows + parts.at_y && y < rows + parts.at_y + parts.lid_y && x >= parts.at_x &&
           x < parts.at_x + parts.lid_x && z >= lid_low;
  };
  tiny.material_at = [=](std::uint16_t, std::uint16_t y, std::uint16_t) {
    return static_cast<std::uint8_t>(y >= rows ? 1 : 0);
  };
  tiny.inside = [=](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return in_lid(x, y, z) || (y < parts.floor_y && x < parts.floor_x && z < floor_top);
  };
  std::unique_ptr<Owner> owner(format::GetOrgan(tiny_organ(tiny).data())->UnPack());
  owner->vertices.clear();
  owner->triangles.clear();
  owner->sphere_nodes.clear();
  owner->format_version = 4;
  owner->sheets = std::make_unique<format::SheetsT>();
  owner->sheets->rows = rows;
  owner->slides = std::make_unique<format::SlidesT>();
  std::uint32_t voxel = 0;
  std::vector<std::uint32_t> ground_of_column(std::size_t{tiny.nx} * rows);
  for (const format::Run& run : owner->runs) {
    for (std::uint16_t x = run.x(); x < run.x() + run.count(); ++x, ++voxel) {
      const float above = parts.plane - static_cast<float>(run.z());
      const bool lid = run.y() >= rows;
      const float filled = std::clamp(lid ? 1 - above : above, 0.0F, 1.0F);
      owner->voxel_fill[voxel] = static_cast<std::uint8_t>(std::lround(255 * filled));
      if (lid) continue;
      ground_of_column[run.y() * tiny.nx + x] =
          static_cast<std::uint32_t>(owner->slides->grounds.size());
      std::array<float, 8> distance = {};
      for (std::size_t i = 0; i < 8; ++i) distance[i] = (i >= 4 ? 1.0F : 0.0F) - above;
      owner->slides->grounds.emplace_back(voxel, flatbuffers::span<const float, 8>(distance));
    }
  }
  voxel = 0;
  for (const format::Run& run : owner->runs) {
    for (std::uint16_t x = run.x(); x < run.x() + run.count(); ++x, ++voxel) {
      if (run.y() < rows || run.z() != lid_low) continue;
      const auto up = static_cast<std::uint16_t>(
          std::lround(65535 * (parts.plane - static_cast<float>(lid_low))));
      owner->slides->points.emplace_back(voxel, std::uint16_t{32768}, std::uint16_t{32768}, up,
                                         std::uint16_t{0}, 1.0F,
                                         ground_of_column[(run.y() - rows) * tiny.nx + x],
                                         parts.friction);
    }
  }
  return owner;
}

// The same, with the lid's surface, through which a needle enters.
inline std::unique_ptr<Owner> two_parts_with_surface(const TwoParts& parts) {
  std::unique_ptr<Owner> owner = two_parts(parts);
  const std::uint16_t rows = owner->sheets->rows;
  TinyOrgan lid;
  lid.nx = owner->size_x;
  lid.ny = rows;
  lid.nz = parts.height;
  lid.voxel_edge_m = parts.voxel_edge_m;
  const auto low = static_cast<std::uint16_t>(std::floor(parts.plane));
  lid.inside = [=](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return y >= parts.at_y && y < parts.at_y + parts.lid_y && x >= parts.at_x &&
           x < parts.at_x + parts.lid_x && z >= low;
  };
  const std::unique_ptr<Owner> alone(format::GetOrgan(tiny_organ(lid).data())->UnPack());
  std::vector<std::uint32_t> number;  // in both, voxels of the lid have the same order
  std::uint32_t voxel = 0;
  for (const format::Run& run : owner->runs) {
    for (std::uint32_t i = 0; i < run.count(); ++i, ++voxel) {
      if (run.y() >= rows) number.push_back(voxel);
    }
  }
  for (const format::Vertex& v : alone->vertices) {
    owner->vertices.emplace_back(number[v.voxel()], v.fx(), v.fy(), v.fz(), 0);
  }
  owner->triangles = alone->triangles;
  owner->sphere_nodes = alone->sphere_nodes;
  return owner;
}

}  // namespace stylet::test
