// SPDX-License-Identifier: Apache-2.0
// Organs of any runs of voxels: nothing is held, there is one material, and the top of one voxel is
// the surface. Units: SI.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tiny_organ.h"

namespace stylet::test {

inline std::uint32_t voxels_of(const std::vector<format::Run>& runs) {
  std::uint32_t voxels = 0;
  for (const format::Run& run : runs) voxels += run.count();
  return voxels;
}

// The position of a voxel, in edges; voxels are counted run by run.
struct SparseCell {
  std::uint32_t x, y, z;
};
inline SparseCell cell_of_voxel(const std::vector<format::Run>& runs, std::uint32_t voxel) {
  for (const format::Run& run : runs) {
    if (voxel < run.count()) return {run.x() + voxel, run.y(), run.z()};
    voxel -= run.count();
  }
  return {};
}

// Runs are in the order of the format; `top`: the voxel with a surface.
inline std::vector<std::byte> organ_of_runs(const std::vector<format::Run>& runs,
                                            std::uint32_t top = 0) {
  flatbuffers::FlatBufferBuilder builder;
  const std::vector<std::uint8_t> material(voxels_of(runs), 0), fill(voxels_of(runs), 255);
  std::uint32_t size[3] = {};
  for (const format::Run& run : runs) {
    size[0] = std::max<std::uint32_t>(size[0], std::uint32_t{run.x()} + run.count());
    size[1] = std::max<std::uint32_t>(size[1], run.y() + 1U);
    size[2] = std::max<std::uint32_t>(size[2], run.z() + 1U);
  }
  const std::vector<flatbuffers::Offset<format::Material>> materials = {
      detail::material_of(builder, TinyMaterial{})};
  constexpr std::uint16_t kEnd = 65535;
  const std::vector<format::Vertex> vertices = {{top, 0, 0, kEnd, 0},
                                                {top, kEnd, 0, kEnd, 0},
                                                {top, kEnd, kEnd, kEnd, 0},
                                                {top, 0, kEnd, kEnd, 0}};
  const std::vector<format::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const float edge_m = TinyOrgan{}.voxel_edge_m;
  const SparseCell cell = cell_of_voxel(runs, top);
  const std::vector<format::SphereNode> spheres = {
      {edge_m * (static_cast<float>(cell.x) + 0.5F), edge_m * (static_cast<float>(cell.y) + 0.5F),
       edge_m * static_cast<float>(cell.z + 1), edge_m, 0, 2}};
  format::FinishOrganBuffer(
      builder, format::CreateOrganDirect(
                   builder, 1, "sparse", edge_m, 0, 0, 0, static_cast<std::uint16_t>(size[0]),
                   static_cast<std::uint16_t>(size[1]), static_cast<std::uint16_t>(size[2]), &runs,
                   &material, &fill, nullptr, &materials, &vertices, &triangles, &spheres));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

}  // namespace stylet::test
