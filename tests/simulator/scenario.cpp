// SPDX-License-Identifier: Apache-2.0
#include "scenario.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

// Makes sessions of procedures differ from random ones of the same seed.
constexpr std::uint64_t kProcedures = 1ULL << 48U;
constexpr std::uint64_t kStiffening = 1ULL << 49U;
constexpr std::uint64_t kMembranes = 1ULL << 50U;
constexpr std::uint64_t kToughness = 1ULL << 51U;
constexpr std::uint64_t kSliding = 1ULL << 52U;

TinyMaterial draw_material(Draw& draw) {
  TinyMaterial m;
  m.density_kg_per_m3 = draw.between(900, 1900);
  m.youngs_modulus_pa = draw.magnitude(2e3, 3e5);
  m.poisson_ratio = draw.between(0, 0.49);
  m.relaxing_fraction = draw.chance(0.5) ? draw.between(0, 0.7) : 0;
  m.relaxation_time_s = draw.magnitude(0.02, 10);
  m.puncture_force_n = draw.magnitude(0.02, 2);
  m.cutting_force_n = draw.magnitude(0.02, 1);
  m.recut_fraction = draw.between(0, 1);
  m.coulomb_friction_n_per_m = draw.magnitude(0.5, 100);
  m.static_friction_n_per_m = m.coulomb_friction_n_per_m * draw.between(1, 1.5);
  m.stribeck_velocity_m_per_s = draw.magnitude(1e-4, 1e-2);
  m.viscous_friction_n_s_per_m2 = draw.chance(0.5) ? draw.magnitude(1, 500) : 0;
  m.puncture_velocity_exponent = draw.chance(0.3) ? draw.between(0, 0.3) : 0;
  return m;
}

// One to three planes through the organ, up to 50 degrees from across its layers; most of them with
// tension.
void draw_membranes(Draw& draw, TinyOrgan& tiny) {
  const float edge_m = tiny.voxel_edge_m;
  const Vec3 size_m = edge_m * Vec3{static_cast<float>(tiny.nx), static_cast<float>(tiny.ny),
                                    static_cast<float>(tiny.nz)};
  const std::uint32_t count = 1 + draw.below(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    TinyMaterial material = draw_material(draw);
    if (draw.chance(0.7)) material.membrane_n_per_m = draw.magnitude(10, 3000);
    const float height_m = size_m.z * draw.between(0.05, 0.95);
    const float slope_x = draw.between(-1.2, 1.2), slope_y = draw.between(-1.2, 1.2);
    const auto corner = [&](float x, float y) {
      const Vec3 at = {
          x * size_m.x, y * size_m.y,
          height_m + slope_x * (x - 0.5F) * size_m.x + slope_y * (y - 0.5F) * size_m.y};
      return tiny.origin_m + at;
    };
    const Vec3 a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
    tiny.membranes.push_back(
        {static_cast<std::uint16_t>(tiny.materials.size()), {{a, b, c}, {a, c, d}}, 1.0F});
    tiny.materials.push_back(material);
  }
}

// Cuts the organ in two along a plane, more or less level; the parts slide on each other, and both
// are held from two sides. Some have a gap between them.
void draw_sliding(Draw& draw, TinyOrgan& tiny) {
  TwoParts parts;
  parts.floor_x = parts.lid_x = tiny.nx;
  parts.floor_y = parts.lid_y = tiny.ny;
  parts.height = tiny.nz;
  parts.voxel_edge_m = tiny.voxel_edge_m;
  parts.slope_x = draw.between(-0.2, 0.2);
  parts.slope_y = draw.between(-0.2, 0.2);
  parts.plane = static_cast<float>(tiny.nz) * draw.between(0.35, 0.75) -
                0.5F * (parts.slope_x * static_cast<float>(tiny.nx) +
                        parts.slope_y * static_cast<float>(tiny.ny));
  if (draw.chance(0.3)) parts.gap = draw.between(0, 0.3);
  parts.friction = draw.between(0, 0.8);
  tiny.fixed_faces |= kLowX | kHighX;
  make_two_parts(parts, tiny);
}

// Layers along z, held from below and perhaps from the sides. How fast they stiffen, how tough they
// are, membranes, and parts that slide are from seeds of their own: the session is otherwise that
// of the same seed without.
std::unique_ptr<OpenOrgan> draw_organ(Draw& draw, Further has, std::uint64_t seed) {
  TinyOrgan tiny;
  for (std::uint16_t* size : {&tiny.nx, &tiny.ny, &tiny.nz}) {
    *size = static_cast<std::uint16_t>(4 + draw.below(6));
  }
  tiny.voxel_edge_m = draw.between(2e-3, 6e-3);
  tiny.origin_m = {draw.between(-0.3, 0.3), draw.between(-0.3, 0.3), draw.between(-0.3, 0.3)};
  tiny.fixed_faces = kLowZ;
  for (const std::uint32_t face : {kLowX, kHighX, kLowY, kHighY}) {
    if (draw.chance(0.3)) tiny.fixed_faces |= face;
  }
  tiny.materials.clear();
  const std::uint32_t layers = 1 + draw.below(3);
  for (std::uint32_t i = 0; i < layers; ++i) tiny.materials.push_back(draw_material(draw));
  Draw further(~(seed ^ kStiffening));
  for (TinyMaterial& each : tiny.materials) {
    if (has.stiffening) each.strain_stiffening = further.magnitude(1, 100);
  }
  tiny.material_at = [nz = tiny.nz, layers](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return static_cast<std::uint8_t>(static_cast<std::uint32_t>(z) * layers / nz);
  };
  Draw of_toughness(~(seed ^ kToughness));
  for (TinyMaterial& each : tiny.materials) {
    if (!has.toughness) continue;
    each.fracture_toughness_j_per_m2 = of_toughness.magnitude(5, 1000);
    each.toughness_velocity_exponent = of_toughness.chance(0.5) ? of_toughness.between(0, 0.5) : 0;
    each.needle_friction_coefficient =
        of_toughness.chance(0.7) ? of_toughness.between(0.02, 0.5) : 0;
  }
  Draw of_membranes(~(seed ^ kMembranes));
  if (has.membranes) draw_membranes(of_membranes, tiny);
  Draw of_sliding(~(seed ^ kSliding));
  if (has.sliding) draw_sliding(of_sliding, tiny);
  return open_organ(tiny_organ(tiny));
}

NeedleConfig draw_needle(Draw& draw) {
  NeedleConfig needle;
  needle.length_m = draw.between(0.06, 0.2);
  needle.outer_radius_m = draw.between(0.2e-3, 1e-3);
  needle.unit_m = draw.magnitude(1e-3, 8e-3);
  needle.bending_nm2 = draw.chance(0.5) ? draw.magnitude(1e-4, 4e-2) : 0;
  needle.rods = 4 + draw.below(60);
  if (draw.chance(0.3)) needle.bevel_per_m = draw.between(1, 20);
  if (needle.bevel_per_m > 5) needle.torsion_nm2 = needle.bending_nm2 / 1.3F;
  if (draw.chance(0.15)) {
    needle.bent_length_m = draw.between(5e-3, 30e-3);
    needle.bent_angle_rad = draw.between(0.05, 0.5);
  }
  return needle;
}

Config draw_config(Draw& draw) {
  Config config;
  config.mode = draw.chance(0.15) ? Mode::kPaper : Mode::kPhysical;
  const float periods_s[] = {1e-3F, 1e-3F, 1e-3F, 0.5e-3F, 0.25e-3F, 2e-3F};
  config.period_s = periods_s[draw.below(6)];
  config.substeps = 1 + draw.below(4);
  config.tissue_damping_s = draw.magnitude(2e-5, 2e-3);
  config.surround_drag_per_s = draw.between(5, 30);
  config.needle_count = draw.chance(0.6) ? 1 : 1 + draw.below(kMaxNeedles);
  for (std::uint32_t i = 0; i < config.needle_count; ++i) config.needle[i] = draw_needle(draw);
  if (draw.chance(0.25)) {
    config.breathing = {
        {draw.between(-4e-3, 4e-3), draw.between(-4e-3, 4e-3), draw.between(0, 8e-3)},
        draw.between(1, 5)};
  }
  return config;
}

Vec3 inside(Draw& draw, const Organ& organ, double low_z, double high_z) {
  const float edge = organ.voxel_edge_m;
  return {organ.origin_m.x + edge * static_cast<float>(organ.size_x) * draw.between(0.1, 0.9),
          organ.origin_m.y + edge * static_cast<float>(organ.sheet_rows) * draw.between(0.1, 0.9),
          organ.origin_m.z + edge * static_cast<float>(organ.size_z) * draw.between(low_z, high_z)};
}

std::vector<ObstacleConfig> draw_obstacles(Draw& draw, const Organ& organ) {
  std::vector<ObstacleConfig> obstacles(draw.chance(0.35) ? 1 + draw.below(3) : 0);
  for (ObstacleConfig& each : obstacles) {
    if (draw.chance(0.5)) {
      make_sphere(each, draw.magnitude(1e-3, 6e-3));
    } else {
      make_box(each, {draw.magnitude(1e-3, 8e-3), draw.magnitude(1e-3, 8e-3),
                      draw.magnitude(1e-3, 8e-3)});
    }
    each.pose.position_m = inside(draw, organ, 0, 1.1);
    each.stiffness_n_per_m = draw.magnitude(500, 5e4);
    each.largest_force_n = draw.magnitude(2, 50);
    each.friction = draw.between(0, 0.8);
  }
  return obstacles;
}

// In and out and sideways, at any speed from a crawl to a jerk; at the end the needle is outside.
std::vector<hal::Waypoint> draw_waypoints(Draw& draw, float thickness_m, double fastest) {
  std::vector<hal::Waypoint> points(2 + draw.below(5));
  for (hal::Waypoint& each : points) {
    each.travel_m = draw.chance(0.3) ? -draw.between(0, 0.02) : thickness_m * draw.between(0, 1.3);
    if (draw.chance(0.4)) {
      each.right_m = draw.between(-4e-3, 4e-3);
      each.up_m = draw.between(-4e-3, 4e-3);
    }
    each.speed_m_per_s = draw.magnitude(5e-3, fastest);
    each.hold_s = draw.chance(0.5) ? draw.between(0, 0.3) : 0;
  }
  points.push_back({.travel_m = -0.02F, .speed_m_per_s = draw.magnitude(0.02, fastest)});
  return points;
}

HandPlan draw_hand(Draw& draw, const Organ& organ, const Config& config, float length_m,
                   bool gentle) {
  HandPlan plan;
  Vec3 direction = {draw.between(-0.4, 0.4), draw.between(-0.4, 0.4), -1};
  const float size = std::sqrt(dot(direction, direction));
  direction = (1 / size) * direction;
  plan.start_m = draw.between(1e-3, 10e-3);
  plan.mapping.rotation = hal::needle_rotation(direction);
  plan.mapping.origin_m = inside(draw, organ, 1, 1) - (plan.start_m + length_m) * direction;
  plan.limits = {"simulated", draw.between(1, 10), draw.between(1000, 5000), 0};
  plan.guard.period_s = config.period_s;
  plan.guard.max_force_n = plan.limits.max_force_n;
  plan.guard.max_slew_n_per_s = plan.limits.max_slew_n_per_s;
  plan.guard.ramp_s = draw.between(0, 0.2);
  plan.guard.watchdog_s = draw.between(2e-3, 5e-3);
  plan.hand = {draw.magnitude(0.05, 0.5), draw.magnitude(200, 2e4), draw.magnitude(5, 100)};
  plan.waypoints = draw_waypoints(draw, organ.voxel_edge_m * static_cast<float>(organ.size_z),
                                  gentle ? kGentleMPerS : 1);
  if (gentle) return plan;
  if (draw.chance(0.5)) {
    plan.turn_per_s = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-3, 3)};
  }
  if (draw.chance(0.5)) plan.bad_share = static_cast<double>(draw.magnitude(1e-3, 0.1));
  if (draw.chance(0.1)) plan.dead_from_s = static_cast<double>(draw.between(0, 2));
  return plan;
}

// The guard's other limits, from a seed of their own.
void draw_nets(Draw draw, bool gentle, HandPlan& plan) {
  hal::GuardConfig& guard = plan.guard;
  guard.continuous_force_n = guard.max_force_n * draw.magnitude(0.2, 1);
  guard.thermal_s = draw.magnitude(5, 60);
  guard.passivity_damping_n_s_per_m = draw.chance(0.5) ? draw.magnitude(0.1, 10) : 0;
  guard.buzz_n = draw.magnitude(0.02, 1) * guard.max_force_n;
  guard.max_speed_m_per_s = gentle ? 2 : draw.magnitude(0.1, 20);
  if (gentle || draw.chance(0.7)) return;
  guard.dead_man_button = static_cast<std::int32_t>(draw.below(32));
  plan.release_share = static_cast<double>(draw.magnitude(1e-4, 1e-2));
}

// In, and rest; sideways and back; deeper, to where bone may be; some way back, and out. The rests
// show relaxation and creep.
std::vector<hal::Waypoint> draw_steps(Draw& draw, float thickness_m, double fastest) {
  std::vector<hal::Waypoint> points;
  float deep_m = thickness_m * draw.between(0.3, 0.7), right_m = 0, up_m = 0;
  const auto go = [&](double hold_s) {
    points.push_back({.travel_m = deep_m,
                      .right_m = right_m,
                      .up_m = up_m,
                      .speed_m_per_s = draw.magnitude(5e-3, fastest),
                      .hold_s = draw.between(0, hold_s)});
  };
  go(0.4);
  for (std::uint32_t i = 1 + draw.below(3); i > 0; --i) {
    right_m = draw.between(-3e-3, 3e-3);
    up_m = draw.between(-3e-3, 3e-3);
    go(0.3);
  }
  right_m = up_m = 0;
  go(0);
  deep_m = thickness_m * draw.between(0.6, 0.95);
  go(0.4);
  if (draw.chance(0.5)) {
    right_m = draw.between(-3e-3, 3e-3);
    go(0.3);
  }
  deep_m = deep_m * draw.between(0.3, 0.9);
  go(0.2);
  points.push_back({.travel_m = -0.02F, .speed_m_per_s = draw.magnitude(5e-3, fastest)});
  return points;
}

// A sphere or a turned box on the needle's way, rarely with its middle on it; the needle may also
// miss it.
ObstacleConfig draw_bone(Draw& draw, const HandPlan& plan, float length_m, float thickness_m) {
  ObstacleConfig bone;
  const float size_m = draw.magnitude(1.5e-3, 8e-3);
  if (draw.chance(0.5)) {
    make_sphere(bone, size_m);
  } else {
    make_box(bone, {size_m, size_m * draw.between(0.5, 2), size_m * draw.between(0.5, 2)});
    float turn[4];
    for (float& part : turn) part = draw.between(-1, 1);
    const float norm =
        std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
    bone.pose.rotation = {turn[0] / norm, turn[1] / norm, turn[2] / norm, turn[3] / norm};
  }
  const Mat3 frame = rotation_matrix(plan.mapping.rotation);
  const float deep_m = length_m + plan.start_m + thickness_m * draw.between(0.5, 0.9) + size_m;
  const Vec3 off = {size_m * draw.between(-0.9, 0.9), size_m * draw.between(-0.9, 0.9), -deep_m};
  bone.pose.position_m = plan.mapping.origin_m + frame * off;
  bone.stiffness_n_per_m = draw.magnitude(500, 5e4);
  bone.largest_force_n = draw.magnitude(2, 50);
  bone.friction = draw.between(0, 1);
  return bone;
}

std::uint64_t ticks_of(const Scenario& scenario, double longest_s) {
  const double period_s = static_cast<double>(scenario.config.period_s);
  std::uint64_t ticks = 0;
  for (const HandPlan& plan : scenario.hands) {
    const auto script = hal::make_script(plan.waypoints, plan.start_m);
    ticks = std::max(ticks, hal::script_ticks(script, period_s));
  }
  return std::min(ticks, static_cast<std::uint64_t>(longest_s / period_s));
}

}  // namespace

Scenario draw_scenario(std::uint64_t seed, Further further) {
  Draw draw(seed);
  Scenario scenario;
  scenario.seed = seed;
  scenario.organ = draw_organ(draw, further, seed);
  scenario.config = draw_config(draw);
  scenario.obstacles = draw_obstacles(draw, scenario.organ->organ);
  scenario.gentle = draw.chance(0.3);
  if (draw.chance(0.3)) scenario.late_share = static_cast<double>(draw.magnitude(1e-3, 0.02));
  for (std::uint32_t i = 0; i < scenario.config.needle_count; ++i) {
    scenario.hands.push_back(draw_hand(draw, scenario.organ->organ, scenario.config,
                                       scenario.config.needle[i].length_m, scenario.gentle));
    draw_nets(Draw(~(seed * kMaxNeedles + i)), scenario.gentle, scenario.hands.back());
  }
  // A script so slow that it lasts longer is cut at the longest session.
  scenario.ticks = ticks_of(scenario, 3);
  return scenario;
}

Scenario draw_procedure(std::uint64_t seed, Further further) {
  Draw draw(seed ^ kProcedures);
  Scenario scenario;
  scenario.seed = seed;
  scenario.organ = draw_organ(draw, further, seed);
  const Organ& organ = scenario.organ->organ;
  const float thickness_m = organ.voxel_edge_m * static_cast<float>(organ.size_z);
  scenario.config = draw_config(draw);
  scenario.gentle = draw.chance(0.6);
  for (std::uint32_t i = 0; i < scenario.config.needle_count; ++i) {
    NeedleConfig& needle = scenario.config.needle[i];
    needle.length_m = std::max(needle.length_m, thickness_m + 0.05F);  // to be held outside
    needle.unit_m = std::min(needle.unit_m, organ.voxel_edge_m);
    if (needle.bending_nm2 > 0) needle.bending_nm2 = draw.magnitude(5e-4, 4e-2);  // 25G and thicker
    HandPlan plan = draw_hand(draw, organ, scenario.config, needle.length_m, scenario.gentle);
    draw_nets(Draw(~(seed * kMaxNeedles + i)), scenario.gentle, plan);
    plan.waypoints = draw_steps(draw, thickness_m, scenario.gentle ? kGentleMPerS : 0.2);
    if (draw.chance(0.6)) {
      scenario.obstacles.push_back(draw_bone(draw, plan, needle.length_m, thickness_m));
    }
    scenario.hands.push_back(plan);
  }
  scenario.ticks = ticks_of(scenario, 20);
  return scenario;
}

}  // namespace stylet::test
