// SPDX-License-Identifier: Apache-2.0
// Organs of any runs of voxels: no surface, nothing held, one material. Units: SI.
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

// The runs in the order of the format.
inline std::vector<std::byte> organ_of_runs(const std::vector<format::Run>& runs) {
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
  const std::vector<format::Vertex> vertices;
  const std::vector<format::Triangle> triangles;
  const std::vector<format::SphereNode> spheres;
  format::FinishOrganBuffer(
      builder, format::CreateOrganDirect(
                   builder, 1, "sparse", TinyOrgan{}.voxel_edge_m, 0, 0, 0,
                   static_cast<std::uint16_t>(size[0]), static_cast<std::uint16_t>(size[1]),
                   static_cast<std::uint16_t>(size[2]), &runs, &material, &fill, nullptr,
                   &materials, &vertices, &triangles, &spheres));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

}  // namespace stylet::test
