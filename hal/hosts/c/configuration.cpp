// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/c/configuration.h"

#include "hal/base/needles.h"
#include "hal/hosts/c/plain.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"

namespace stylet::c {
namespace {

stylet_config to_struct(const Config& c) {
  return {sizeof(stylet_config),
          static_cast<std::uint32_t>(c.mode),
          c.period_s,
          c.substeps,
          static_cast<std::uint32_t>(c.inertia),
          c.tissue_damping_s,
          c.surround_drag_per_s,
          c.hourglass_weight,
          c.paper_alpha,
          plain(c.breathing.amplitude_m),
          c.breathing.period_s,
          plain(c.gravity_m_per_s2)};
}

stylet_needle to_struct(const NeedleConfig& n) {
  return {sizeof(stylet_needle),
          n.length_m,
          n.outer_radius_m,
          n.unit_m,
          n.bending_nm2,
          n.rods,
          n.bevel_per_m,
          n.bent_length_m,
          n.bent_angle_rad,
          n.torsion_nm2,
          n.tip_half_angle_rad,
          n.torn_diameters,
          static_cast<std::uint32_t>(n.hub),
          n.bore_radius_m,
          n.opening_m,
          n.filling_pa_s,
          n.plunger_radius_m,
          n.plunger_friction_n,
          n.syringe_m3,
          n.syringe_filled,
          n.syringe_gas_m3};
}

// The kernel's default contact on a body of some shape: without one it would be refused.
ObstacleConfig default_obstacle() {
  ObstacleConfig out;
  make_sphere(out, 0.01F);
  return out;
}

stylet_obstacle to_struct(const ObstacleConfig& o) {
  stylet_obstacle out = {};
  out.struct_bytes = sizeof out;
  out.vertex_count = o.vertex_count;
  out.pose = plain(o.pose);
  for (std::uint32_t i = 0; i < kMaxHullVertices; ++i) out.vertices_m[i] = plain(o.vertices_m[i]);
  out.rounding_m = o.rounding_m;
  out.stiffness_n_per_m = o.stiffness_n_per_m;
  out.largest_force_n = o.largest_force_n;
  out.friction = o.friction;
  return out;
}

ObstacleConfig obstacle(const stylet_obstacle& o) {
  ObstacleConfig out;
  out.pose = pose(o.pose);
  out.vertex_count = o.vertex_count;
  for (std::uint32_t i = 0; i < kMaxHullVertices; ++i) out.vertices_m[i] = vec(o.vertices_m[i]);
  out.rounding_m = o.rounding_m;
  out.stiffness_n_per_m = o.stiffness_n_per_m;
  out.largest_force_n = o.largest_force_n;
  out.friction = o.friction;
  return out;
}

void put_config(const stylet_config& c, Config& out) {
  out.mode = static_cast<Mode>(c.mode);
  out.period_s = c.period_s;
  out.substeps = c.substeps;
  out.inertia = static_cast<Inertia>(c.inertia);
  out.tissue_damping_s = c.tissue_damping_s;
  out.surround_drag_per_s = c.surround_drag_per_s;
  out.hourglass_weight = c.hourglass_weight;
  out.paper_alpha = c.paper_alpha;
  out.breathing = {vec(c.breathing_amplitude_m), c.breathing_period_s};
  out.gravity_m_per_s2 = vec(c.gravity_m_per_s2);
}

NeedleConfig needle(const stylet_needle& n) {
  return {n.length_m,
          n.outer_radius_m,
          n.unit_m,
          n.bending_nm2,
          n.rods,
          n.bevel_per_m,
          n.bent_length_m,
          n.bent_angle_rad,
          n.torsion_nm2,
          n.tip_half_angle_rad,
          n.torn_diameters,
          static_cast<Hub>(n.hub),
          n.bore_radius_m,
          n.opening_m,
          n.filling_pa_s,
          n.plunger_radius_m,
          n.plunger_friction_n,
          n.syringe_m3,
          n.syringe_filled,
          n.syringe_gas_m3};
}

}  // namespace

stylet_status read_config(const stylet_config* config, const stylet_needle* needles,
                          std::uint32_t needle_count, Config& out, stylet_refusal* refusal_out) {
  out = {};
  stylet_config own = to_struct(out);
  if (config != nullptr && !take(config, own)) {
    return refuse_struct(refusal_out, "config", config);
  }
  put_config(own, out);
  out.needle_count = needle_count == 0 ? 1 : needle_count;
  if (out.needle_count > kMaxNeedles) {
    const ConfigRefusal many = {"needle_count", 0, static_cast<double>(needle_count), 1,
                                kMaxNeedles};
    return refuse_config(refusal_out, Status::kConfigValueOutOfRange, many);
  }
  if (needles == nullptr) {
    return needle_count <= 1 ? stylet_status{STYLET_OK} : refuse_missing(refusal_out, "needles");
  }
  const std::uint32_t stride = stride_of(needles);
  for (std::uint32_t i = 0; i < needle_count; ++i) {
    stylet_needle each = to_struct(NeedleConfig{});
    if (!take(element(needles, stride, i), stride, each)) {
      return refuse_struct(refusal_out, "needle", needles, i);
    }
    out.needle[i] = needle(each);
  }
  return STYLET_OK;
}

stylet_status read_obstacles(const stylet_obstacle* obstacles, std::span<ObstacleConfig> out,
                             stylet_refusal* refusal_out) {
  if (obstacles == nullptr && !out.empty()) return refuse_missing(refusal_out, "obstacles");
  const std::uint32_t stride = out.empty() ? 0 : stride_of(obstacles);
  for (std::size_t i = 0; i < out.size(); ++i) {
    stylet_obstacle each = to_struct(default_obstacle());
    if (!take(element(obstacles, stride, i), stride, each)) {
      return refuse_struct(refusal_out, "obstacle", obstacles, i);
    }
    out[i] = obstacle(each);
  }
  return STYLET_OK;
}

}  // namespace stylet::c

using namespace stylet;

stylet_status stylet_config_init(stylet_config* config, size_t struct_bytes) {
  return c::init(c::to_struct(Config{}), config, struct_bytes);
}

stylet_status stylet_needle_init(stylet_needle* needle, size_t struct_bytes) {
  return c::init(c::to_struct(NeedleConfig{}), needle, struct_bytes);
}

stylet_status stylet_needle_preset(stylet_needle* needle, const char* name) {
  if (needle == nullptr || name == nullptr) return STYLET_ARGUMENT_MISSING;
  stylet_needle own = c::to_struct(NeedleConfig{});
  if (!c::take(needle, own)) return STYLET_STRUCT_SIZE_UNKNOWN;
  const hal::NeedlePreset* const preset = hal::find_needle(name);
  if (preset == nullptr) return STYLET_ARGUMENT_OUT_OF_RANGE;
  const NeedleConfig config = hal::needle_of(*preset);
  stylet_needle made = c::to_struct(config);
  made.unit_m = own.unit_m;
  made.rods = own.rods;
  made.hub = own.hub;
  made.filling_pa_s = own.filling_pa_s;
  made.plunger_radius_m = own.plunger_radius_m;
  made.plunger_friction_n = own.plunger_friction_n;
  made.syringe_m3 = own.syringe_m3;
  made.syringe_filled = own.syringe_filled;
  made.syringe_gas_m3 = own.syringe_gas_m3;
  (void)c::give(made, needle);
  return STYLET_OK;
}

const char* stylet_needle_preset_name(uint32_t index) {
  const auto all = hal::needle_presets();
  return index < all.size() ? all[index].name : nullptr;
}

stylet_status stylet_obstacle_init(stylet_obstacle* obstacle, size_t struct_bytes) {
  return c::init(c::to_struct(c::default_obstacle()), obstacle, struct_bytes);
}

namespace {

// Gives another shape to an obstacle; the rest stays.
template <typename Make>
stylet_status reshape(stylet_obstacle* obstacle, const Make& make) {
  if (obstacle == nullptr) return STYLET_ARGUMENT_MISSING;
  stylet_obstacle own = c::to_struct(c::default_obstacle());
  if (!c::take(obstacle, own)) return STYLET_STRUCT_SIZE_UNKNOWN;
  ObstacleConfig config = c::obstacle(own);
  make(config);
  (void)c::give(c::to_struct(config), obstacle);
  return STYLET_OK;
}

}  // namespace

stylet_status stylet_obstacle_box(stylet_obstacle* obstacle, stylet_vec3 half_m) {
  return reshape(obstacle, [&](ObstacleConfig& config) { make_box(config, c::vec(half_m)); });
}

stylet_status stylet_obstacle_sphere(stylet_obstacle* obstacle, float radius_m) {
  return reshape(obstacle, [&](ObstacleConfig& config) { make_sphere(config, radius_m); });
}
