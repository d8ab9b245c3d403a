// SPDX-License-Identifier: Apache-2.0
#include "needle.h"

#include "coupling.h"
#include "roll.h"

namespace stylet {
namespace {

// No needle is quite straight: this kink at every joint decides to which side one pressed exactly
// along its axis buckles.
constexpr double kImperfectionRad = 1e-7;
// Length over which a cut falls in with the needle behind it: a bevel and the shaft's first bend.
constexpr float kBevelAlignM = 0.02F;

Vec3 unit(Vec3 v) {
  const float length = norm(v);
  return length > 1e-12F ? (1 / length) * v : Vec3{0, 0, -1};
}

// A direction across `from`, carried by the smallest turn from `from` to `to`.
Vec3 carried(Vec3 across, Vec3 from, Vec3 to) {
  const float opening = max_of(1 + dot(from, to), 1e-6F);
  const Vec3 moved = across - (dot(across, to) / opening) * (from + to);
  return unit(moved - dot(moved, to) * to);
}

bool is_elastic(const NeedleConfig& config) {
  return config.bending_nm2 > 0 || config.bent_angle_rad > 0;
}

Sym3d across(Vec3 direction, float stiffness) {
  const double k = static_cast<double>(stiffness);
  const Vec3d t = to_double(direction);
  return {k * (1 - t.x * t.x), -k * t.x * t.y, -k * t.x * t.z,
          k * (1 - t.y * t.y), -k * t.y * t.z, k * (1 - t.z * t.z)};
}

Sym3d symmetric(const Mat3& m) {
  const auto d = [](float v) { return static_cast<double>(v); };
  return {d(m.m[0][0]), d(m.m[0][1]), d(m.m[0][2]), d(m.m[1][1]), d(m.m[1][2]), d(m.m[2][2])};
}

// A held particle bends the needle by its spring: in contact on all sides, inserted across the
// shaft, for along it slip decides.
void add_particle(const View& view, const Needle& last, const Particle& p, RodLoads& loads) {
  if (p.share_count == 0) return;
  const NeedleState& own = *view.state.needle;
  const bool contact = own.phase == Phase::kContact;
  const Vec3 slides = contact ? Vec3{} : needle_point(last, p.arc_m).direction;
  const double length = static_cast<double>(view.needle_config().length_m);
  loads.load[loads.count++] = {length - static_cast<double>(p.arc_m),
                               to_double(p.position_m) - to_double(own.base_m),
                               -1.0 * to_double(p.force_n), across(slides, p.stiffness_n_per_m)};
}

// All that pushed the needle in the last tick, as it answers to being moved.
void gather_loads(const View& view, Vec3 shift, RodLoads& loads) {
  const NeedleState& own = *view.state.needle;
  const Needle last = needle_of(view);
  loads.count = 0;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    add_particle(view, last, view.state.shaft[i], loads);
  }
  if (own.tip_alive != 0) add_particle(view, last, *view.state.tip, loads);
  for (std::uint32_t i = 0; i < own.touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    loads.load[loads.count++] = {static_cast<double>(touch.arc_m),
                                 to_double(touch.at_m - shift) - to_double(own.base_m),
                                 to_double(touch.force_n), symmetric(touch.stiffness_n_per_m)};
  }
}

std::uint32_t bend(const View& view, Vec3 shift) {
  NeedleState& own = *view.state.needle;
  RodLoads& loads = *view.scratch.loads;
  gather_loads(view, shift, loads);
  const Quat& q = own.handle.rotation;
  const double handle[4] = {static_cast<double>(q.w), static_cast<double>(q.x),
                            static_cast<double>(q.y), static_cast<double>(q.z)};
  RodResult& result = *view.scratch.rod_result;
  solve_rod(*view.model.rod, handle, loads, *view.state.rod_shape, *view.scratch.rod, result);
  for (std::uint32_t i = 0; i <= view.model.rod->rods; ++i) {
    view.state.node[i] = own.base_m + to_float(result.node_m[i]);
  }
  if (result.least_pivot > 0) return 0;
  ++view.state.head->needle_unstable;
  return kFlagNeedleUnstable;
}

// What a piece remembers of an obstacle; nothing if it did not touch it in the last tick.
ObstacleContact remembered(const View& view, std::uint32_t obstacle, std::uint32_t rod) {
  for (std::uint32_t i = 0; i < view.state.needle->touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    if (touch.obstacle == obstacle && touch.rod == rod) return touch.contact;
  }
  return {};
}

// Looks at one piece and one body; enters what touches into the list of this tick.
std::uint32_t touch_piece(const View& view, const Needle& needle, Vec3 shift, std::uint32_t body,
                          std::uint32_t rod, std::uint32_t& count) {
  StateHead& state = *view.state.head;
  const NeedlePiece piece = {needle.node[rod] + shift, needle.node[rod + 1] + shift,
                             view.needle_config().outer_radius_m};
  const ObstacleContact last = remembered(view, body, rod);
  ObstacleContact next = {};
  const ObstacleLoad load = obstacle_load(view.model.obstacle[body], piece, last, next);
  state.obstacles_j += static_cast<double>(load.dissipated_j);
  if (!(load.depth_m > 0)) return 0;
  if (count == kMaxTouches) {
    ++state.obstacle_pool_full;
    return kFlagObstaclePoolFull;
  }
  view.scratch.touch[count++] = {body,
                                 rod,
                                 next,
                                 load.at_m,
                                 load.force_n,
                                 (static_cast<float>(rod) + load.place) * needle.rod_m,
                                 load.stiffness_n_per_m,
                                 load.normal};
  return 0;
}

std::uint32_t touch_obstacles(const View& view, const Needle& needle, Vec3 shift) {
  NeedleState& own = *view.state.needle;
  std::uint32_t flags = 0, count = 0;
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    for (std::uint32_t rod = 0; rod < needle.rods; ++rod) {
      flags |= touch_piece(view, needle, shift, body, rod, count);
    }
  }
  if (count > 0 && own.touch_count == 0) add_event(view, EventKind::kObstacle, 0);
  for (std::uint32_t i = 0; i < count; ++i) view.state.touch[i] = view.scratch.touch[i];
  own.touch_count = count;
  own.touch_max = own.touch_max > count ? own.touch_max : count;
  return flags;
}

}  // namespace

Needle needle_of(const View& view) {
  Needle needle = {};
  needle.node = view.state.node;
  needle.rods = view.model.rod->rods;
  needle.rod_m = static_cast<float>(view.model.rod->rod_m);
  needle.base_m = needle.node[0];
  needle.tip_m = needle.node[needle.rods];
  return needle;
}

// Counted from the tip: there a place must be exact to the motion of a tick.
NeedlePoint needle_point(const Needle& needle, float arc_from_tip_m) {
  const float at = arc_from_tip_m / needle.rod_m;
  const auto rod = static_cast<std::uint32_t>(clamp(at, 0, static_cast<float>(needle.rods) - 0.5F));
  const Vec3* end = needle.node + (needle.rods - rod);
  const Vec3 back = end[-1] - end[0];
  return {end[0] + (at - static_cast<float>(rod)) * back, unit(-1.0F * back)};
}

Vec3 attachment_shift(const View& view) {
  const BreathingConfig& b = view.model.head->config.breathing;
  const double breaths = static_cast<double>(view.state.head->tick) *
                         static_cast<double>(view.model.head->config.period_s) /
                         static_cast<double>(b.period_s);
  const double part = breaths - static_cast<double>(static_cast<std::int64_t>(breaths));
  const float s = sine_of_half_turns(static_cast<float>(part));
  return ((s * s) * (s * s)) * b.amplitude_m;
}

void make_needle(const View& view) {
  const NeedleConfig& config = view.needle_config();
  const std::uint32_t rods = is_elastic(config) ? config.rods : 1;
  const double bending =
      config.bending_nm2 > 0 ? static_cast<double>(config.bending_nm2) : kRigidBendingNm2;
  RodKink kinks[kMaxRods] = {};
  const float rod_m = config.length_m / static_cast<float>(rods);
  const float bent = config.bent_length_m / rod_m + 0.5F;
  const std::uint32_t count = bent < 1 ? 1 : static_cast<std::uint32_t>(bent);
  const double angle = static_cast<double>(config.bent_angle_rad) / count;
  for (std::uint32_t i = 0; i < rods; ++i) kinks[i].x = kImperfectionRad;
  for (std::uint32_t i = 0; i < count && i < rods; ++i) {
    kinks[rods - 1 - i].x += angle * (1 - angle * angle / 6 * (1 - angle * angle / 20));
  }
  make_rod(rods, static_cast<double>(config.length_m), bending, {kinks, rods}, *view.model.rod);
}

std::uint32_t place_needle(const View& view, Needle& needle_out) {
  NeedleState& own = *view.state.needle;
  const NeedleConfig& config = view.needle_config();
  const Vec3 shift = attachment_shift(view);
  const Mat3 r = rotation_matrix(own.handle.rotation);
  own.base_m = own.handle.position_m - shift;
  std::uint32_t flags = 0;
  if (is_elastic(config)) {
    flags |= bend(view, shift);
  } else {
    view.state.node[0] = own.base_m;
    view.state.node[1] = own.base_m - config.length_m * column(r, 2);
  }
  needle_out = needle_of(view);
  Vec3 from = -1.0F * column(r, 2);
  needle_out.side = rolled_side(view, r);
  needle_out.tip_direction = from;
  for (std::uint32_t i = 0; is_elastic(config) && i < needle_out.rods; ++i) {
    const Vec3 to = unit(needle_out.node[i + 1] - needle_out.node[i]);
    needle_out.side = carried(needle_out.side, from, to);
    needle_out.tip_direction = from = to;
  }
  return flags | touch_obstacles(view, needle_out, shift);
}

Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m) {
  const float size = advance_m < 0 ? -advance_m : advance_m;
  const Vec3 side = unit(needle.side - dot(needle.side, cut) * cut);
  const float part = size / (size + kBevelAlignM);
  const Vec3 turned = cut + max_of(advance_m, 0) * bevel_per_m * side;
  return unit(turned + part * (needle.tip_direction - cut));
}

}  // namespace stylet
