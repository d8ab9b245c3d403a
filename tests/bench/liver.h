// SPDX-License-Identifier: Apache-2.0
// Liver-like lattices of any number of voxels: the bodies whose tissue step is measured.
//
// Two overlapping ellipsoids, longest along x, 1.5 l whatever the number of voxels, attached at the
// lowest plane; three materials, chosen per voxel: capsule, parenchyma, and a stiff ball inside.
#pragma once

#include <cmath>

#include "session.h"

namespace stylet::test {

constexpr float kLiverM3 = 1.5e-3F;

namespace detail {

struct LiverShape {
  float scale;  // half length of the greater lobe, in voxels

  std::uint16_t size(float part) const {
    return static_cast<std::uint16_t>(2 * std::ceil(part * scale));
  }
  bool holds(std::uint16_t x, std::uint16_t y, std::uint16_t z) const {
    const float px = (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(size(1.0F))) / scale;
    const float py = (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(size(0.7F))) / scale;
    const float pz = (static_cast<float>(z) + 0.5F - 0.5F * static_cast<float>(size(0.6F))) / scale;
    const auto square = [](float v) { return v * v; };
    return square((px + 0.3F) / 0.7F) + square(py / 0.7F) + square(pz / 0.6F) < 1 ||
           square((px - 0.3F) / 0.7F) + square((py - 0.1F) / 0.45F) + square(pz / 0.4F) < 1;
  }
  std::size_t count() const {
    std::size_t voxels = 0;
    for (std::uint16_t z = 0; z < size(0.6F); ++z) {
      for (std::uint16_t y = 0; y < size(0.7F); ++y) {
        for (std::uint16_t x = 0; x < size(1.0F); ++x) voxels += holds(x, y, z) ? 1 : 0;
      }
    }
    return voxels;
  }
};

inline LiverShape liver_shape(std::size_t voxels) {
  float low = 1, high = 500;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5F * (low + high);
    (LiverShape{middle}.count() < voxels ? low : high) = middle;
  }
  return {high};
}

inline TinyMaterial liver_material(const char* name, float youngs_modulus_pa) {
  TinyMaterial material;
  material.name = name;
  material.youngs_modulus_pa = youngs_modulus_pa;
  material.relaxing_fraction = 0.3F;
  material.puncture_force_n = 0.2F;
  material.viscous_friction_n_s_per_m2 = 50;
  return material;
}

}  // namespace detail

// The smallest such body with at least `voxels` voxels.
inline std::unique_ptr<OpenOrgan> liver_organ(std::size_t voxels) {
  const detail::LiverShape shape = detail::liver_shape(voxels);
  TinyOrgan tiny;
  tiny.nx = shape.size(1.0F);
  tiny.ny = shape.size(0.7F);
  tiny.nz = shape.size(0.6F);
  tiny.voxel_edge_m = std::cbrt(kLiverM3 / static_cast<float>(voxels));
  tiny.fixed_faces = kLowZ;
  tiny.inside = [shape](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return shape.holds(x, y, z);
  };
  tiny.materials = {detail::liver_material("parenchyma", 5000),
                    detail::liver_material("capsule", 20000),
                    detail::liver_material("tumour", 30000)};
  tiny.material_at = [shape, tiny](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    if (!shape.holds(x, y, static_cast<std::uint16_t>(z + 1))) return std::uint8_t{1};
    const float dx = static_cast<float>(x) - 0.35F * static_cast<float>(tiny.nx);
    const float dy = static_cast<float>(y) - 0.50F * static_cast<float>(tiny.ny);
    const float dz = static_cast<float>(z) - 0.40F * static_cast<float>(tiny.nz);
    const float radius = 0.2F * shape.scale;
    return static_cast<std::uint8_t>(dx * dx + dy * dy + dz * dz < radius * radius ? 2 : 0);
  };
  return open_organ(tiny_organ(tiny));
}

// Where the needle enters: from above, on the line through the middle of the organ's voxels.
inline Script script_for(const Organ& organ, const Config& config) {
  Script script = block_script(organ, config);
  double x = 0, y = 0, count = 0;
  for (const OrganRun& run : organ.runs) {
    x += run.count * (run.x + 0.5 * run.count);
    y += run.count * (run.y + 0.5);
    count += run.count;
  }
  script.entry_m.x = organ.origin_m.x + organ.voxel_edge_m * static_cast<float>(x / count);
  script.entry_m.y = organ.origin_m.y + organ.voxel_edge_m * static_cast<float>(y / count);
  const Vec3 above_m = {script.entry_m.x, script.entry_m.y, script.entry_m.z + 0.01F};
  float distance_m = 0;
  if (organ_raycast(organ, above_m, {0, 0, -1}, distance_m)) {
    script.entry_m.z = above_m.z - distance_m;
  }
  return script;
}

}  // namespace stylet::test
