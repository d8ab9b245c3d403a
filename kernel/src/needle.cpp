// SPDX-License-Identifier: Apache-2.0
#include "needle.h"

#include "coupling.h"
#include "roll.h"

namespace stylet {
namespace {

// No needle is quite straight: this kink at every joint decides to which side one pressed exactly
// along its axis buckles.
constexpr double kImperfectionRad = 1e-7;
// Of what a needle is taken to be made of when it is thrown about: solid steel.
constexpr double kSteelKgPerM3 = 7850;
// A needle in contact bends so far in a tick without meeting its own inertia.
constexpr double kFreeBendM = 1e-4;
// Where the last Newton step turns a rod farther than this, the steps have not ended: the needle
// snaps over. (At rest they end below 1e-5, with a jerk on obstacles below 1e-3.)
constexpr double kSettledTurnRad = 1e-2;
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

// Where a particle has slipped along the shaft it will slip on: its force there is on its limit.
bool slides(const Particle& p) {
  return dot(p.slip_m, p.slip_m) > 0;
}

// A held particle bends the needle by its spring: one that slips, only across the shaft. (Without
// the spring along it, one pressed at the tip buckles under a load that does not give way.)
void add_particle(const View& view, const Needle& last, const Particle& p, RodLoads& loads) {
  if (p.share_count == 0) return;
  const NeedleState& own = *view.state.needle;
  const Vec3 along = slides(p) ? needle_point(last, p.arc_m).direction : Vec3{};
  const double length = static_cast<double>(view.needle_config().length_m);
  loads.load[loads.count++] = {length - static_cast<double>(p.arc_m),
                               to_double(p.position_m) - to_double(own.base_m),
                               -1.0 * to_double(p.force_n), across(along, p.stiffness_n_per_m)};
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

// A node's mass over the square of a tick: from rest its inertia lets it go no farther. Only in
// contact with obstacles, where a needle that snaps over would go through them: elsewhere it rests.
double drag_n_per_m(const View& view) {
  if (view.state.needle->touch_count == 0) return 0;
  const double radius = static_cast<double>(view.needle_config().outer_radius_m);
  const double period = static_cast<double>(view.model.head->config.period_s);
  const double kg_per_m = kSteelKgPerM3 * 3.14159265 * radius * radius;
  return kg_per_m * view.model.rod->rod_m / (period * period);
}

struct HandleTurn {
  double wxyz[4];
};
HandleTurn handle_turn(const View& view) {
  const Quat& q = view.state.needle->handle.rotation;
  return {{static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
           static_cast<double>(q.z)}};
}

void put_nodes(const View& view) {
  for (std::uint32_t i = 0; i <= view.model.rod->rods; ++i) {
    view.state.node[i] = view.state.needle->base_m + to_float(view.scratch.rod_result->node_m[i]);
  }
}

void solve(const View& view, Vec3 shift) {
  RodLoads& loads = *view.scratch.loads;
  gather_loads(view, shift, loads);
  solve_rod(*view.model.rod, handle_turn(view).wxyz, loads, *view.state.rod_shape,
            *view.scratch.rod, *view.scratch.rod_result);
}

std::uint32_t keep_bend(const View& view) {
  put_nodes(view);
  const RodResult& result = *view.scratch.rod_result;
  if (result.least_pivot > 0 && result.last_turn_rad < kSettledTurnRad) return 0;
  ++view.state.head->needle_unstable;
  return kFlagNeedleUnstable;
}

std::uint32_t bend(const View& view, Vec3 shift) {
  solve(view, shift);
  if (view.model.head->obstacle_count > 0) {
    slow_bend(*view.model.rod, handle_turn(view).wxyz, drag_n_per_m(view), kFreeBendM,
              *view.state.rod_shape, *view.scratch.rod, *view.scratch.rod_result);
  }
  return keep_bend(view);
}

// A particle goes where the needle has gone; one that slips, only across, for how far along is
// decided in the next tick.
void carry(const Needle& needle, Particle& p) {
  if (p.share_count == 0) return;
  const NeedlePoint at = needle_point(needle, p.arc_m);
  const Vec3 moved = at.place_m - p.position_m;
  const float along = slides(p) ? dot(moved, at.direction) : 0;
  p.position_m = p.position_m + (moved - along * at.direction);
  p.force_n = force_on_tissue(p);
}

// What a piece remembers of an obstacle; nothing if it did not touch it in the last tick.
ObstacleContact remembered(const View& view, std::uint32_t obstacle, std::uint32_t rod) {
  for (std::uint32_t i = 0; i < view.state.needle->touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    if (touch.obstacle == obstacle && touch.rod == rod) return touch.contact;
  }
  return {};
}

struct Touching {
  std::uint32_t count, left_out;
  double dissipated_j;
};

// In a full list, the place of one that presses less than `force_n`, those that are lost before all
// others; null: the new one is left out.
Touch* least_touch(const View& view, Touching& out, bool touches, Vec3 force_n) {
  if (!touches) return nullptr;
  Touch* least = nullptr;
  float least_n2 = dot(force_n, force_n);
  for (std::uint32_t i = 0; i < kMaxTouches; ++i) {
    Touch& touch = view.scratch.touch[i];
    const float n2 = touch.depth_m < 0 ? -1 : dot(touch.force_n, touch.force_n);
    if (!(n2 < least_n2)) continue;
    least = &touch;
    least_n2 = n2;
  }
  if (least == nullptr || least->depth_m > 0) ++out.left_out;
  return least;
}

// Looks at one piece and one body; enters what touches, and what is lost, into the list.
void touch_piece(const View& view, const Needle& needle, Vec3 shift, std::uint32_t body,
                 std::uint32_t rod, Touching& out) {
  const NeedlePiece piece = {needle.node[rod] + shift, needle.node[rod + 1] + shift,
                             view.needle_config().outer_radius_m};
  const ObstacleContact last = remembered(view, body, rod);
  ObstacleContact next = {};
  const ObstacleLoad load = obstacle_load(view.model.obstacle[body], piece, last, next);
  out.dissipated_j += static_cast<double>(load.dissipated_j);
  const bool touches = load.depth_m > 0, lost = load.depth_m < 0;
  if (!touches && !lost) return;
  Touch* const entry = out.count < kMaxTouches ? view.scratch.touch + out.count++
                                               : least_touch(view, out, touches, load.force_n);
  if (entry == nullptr) return;
  *entry = {body,
            rod,
            next,
            load.at_m,
            load.force_n,
            (static_cast<float>(rod) + load.place) * needle.rod_m,
            load.stiffness_n_per_m,
            load.normal,
            load.depth_m};
}

// All pieces and bodies, into the list of scratch.
Touching find_touches(const View& view, const Needle& needle, Vec3 shift) {
  Touching out = {};
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    for (std::uint32_t rod = 0; rod < needle.rods; ++rod) {
      touch_piece(view, needle, shift, body, rod, out);
    }
  }
  return out;
}

// How much of the bending of this tick presses none of the `count` touches more than kMaxPlungeM
// deeper.
double bend_allowed(const View& view, std::uint32_t count) {
  const RodResult& result = *view.scratch.rod_result;
  const Vec3d* const start = view.scratch.rod->start_m;
  double share = 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Touch& touch = view.scratch.touch[i];
    const std::uint32_t j = touch.rod;
    const double place = static_cast<double>(touch.arc_m) / view.model.rod->rod_m - j;
    const Vec3d from = start[j] + place * (start[j + 1] - start[j]);
    const Vec3d to = result.node_m[j] + place * (result.node_m[j + 1] - result.node_m[j]);
    const double moved = dot(to_double(touch.normal), from - to);
    const double depth = static_cast<double>(touch.depth_m);
    const double deeper = moved < depth ? moved : depth;
    if (deeper > kMaxPlungeM && kMaxPlungeM < share * deeper) share = kMaxPlungeM / deeper;
  }
  return share;
}

// A needle that bends in air as fast as it likes would find itself deep in a body, and be thrown
// back through the other side of it. Looked at again after that: the way there may lead deeper
// through the body than where it ends.
void approach_obstacles(const View& view, Vec3 shift) {
  for (std::uint32_t look = 0; look < kApproachLooks; ++look) {
    const Touching found = find_touches(view, needle_of(view), shift);
    shorten_bend(*view.model.rod, handle_turn(view).wxyz, bend_allowed(view, found.count),
                 *view.state.rod_shape, *view.scratch.rod, *view.scratch.rod_result);
    put_nodes(view);
  }
}

// Whether a piece of the needle passes the sphere around a body.
bool near_obstacles(const View& view, Vec3 shift) {
  const Vec3* const node = view.state.node;
  const float radius_m = view.needle_config().outer_radius_m;
  bool near = false;
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    for (std::uint32_t rod = 0; rod < view.model.rod->rods; ++rod) {
      const NeedlePiece piece = {node[rod] + shift, node[rod + 1] + shift, radius_m};
      near |= obstacle_near(view.model.obstacle[body], piece);
    }
  }
  return near;
}

// Takes the last bend back, to the nodes it began with.
void unbend(const View& view, const Vec3* node) {
  shorten_bend(*view.model.rod, handle_turn(view).wxyz, 0, *view.state.rod_shape, *view.scratch.rod,
               *view.scratch.rod_result);
  for (std::uint32_t i = 0; i <= view.model.rod->rods; ++i) view.state.node[i] = node[i];
}

std::uint32_t touch_obstacles(const View& view, const Needle& needle, Vec3 shift) {
  NeedleState& own = *view.state.needle;
  const Touching found = find_touches(view, needle, shift);
  view.state.head->obstacles_j += found.dissipated_j;
  view.state.head->obstacle_pool_full += found.left_out;
  if (found.count > 0 && own.touch_count == 0) add_event(view, EventKind::kObstacle, 0);
  for (std::uint32_t i = 0; i < found.count; ++i) view.state.touch[i] = view.scratch.touch[i];
  own.touch_count = found.count;
  own.touch_max = own.touch_max > found.count ? own.touch_max : found.count;
  return found.left_out > 0 ? std::uint32_t{kFlagObstaclePoolFull} : 0U;
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

namespace {

// The rod at `arc_from_tip_m`: its end towards the tip, the way back from there, and how far along.
// Counted from the tip: there a place must be exact to the motion of a tick.
struct RodPlace {
  Vec3 end, back;
  float along;
};
RodPlace rod_place(const Needle& needle, float arc_from_tip_m) {
  const float at = arc_from_tip_m / needle.rod_m;
  // Also for what is not a number, which a broken state may bring.
  const float within = max_of(0, min_of(at, static_cast<float>(needle.rods) - 0.5F));
  const auto rod = static_cast<std::uint32_t>(within);
  const Vec3* end = needle.node + (needle.rods - rod);
  return {end[0], end[-1] - end[0], at - static_cast<float>(rod)};
}

}  // namespace

NeedlePoint needle_point(const Needle& needle, float arc_from_tip_m) {
  const RodPlace rod = rod_place(needle, arc_from_tip_m);
  return {rod.end + rod.along * rod.back, unit(-1.0F * rod.back)};
}

Vec3 needle_place(const Needle& needle, float arc_from_tip_m) {
  const RodPlace rod = rod_place(needle, arc_from_tip_m);
  return rod.end + rod.along * rod.back;
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
    approach_obstacles(view, shift);
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

std::uint32_t settle_needle(const View& view, Needle& needle) {
  NeedleState& own = *view.state.needle;
  if (!is_elastic(view.needle_config()) || own.tip_alive == 0) return 0;
  const Vec3 shift = attachment_shift(view);
  if (own.touch_count > 0 || near_obstacles(view, shift)) return 0;
  Vec3 before[kMaxRods + 1];
  for (std::uint32_t i = 0; i <= needle.rods; ++i) before[i] = needle.node[i];
  solve(view, shift);
  const std::uint32_t flags = keep_bend(view);
  if (near_obstacles(view, shift)) {
    unbend(view, before);
    return flags;
  }
  needle.tip_m = needle.node[needle.rods];
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) carry(needle, view.state.shaft[i]);
  const Vec3 moved = needle.tip_m - view.state.tip->position_m;
  carry(needle, *view.state.tip);
  throw_aside(view, needle, moved);
  return flags;
}

Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m) {
  const float size = advance_m < 0 ? -advance_m : advance_m;
  const Vec3 side = unit(needle.side - dot(needle.side, cut) * cut);
  const float part = size / (size + kBevelAlignM);
  const Vec3 turned = cut + max_of(advance_m, 0) * bevel_per_m * side;
  return unit(turned + part * (needle.tip_direction - cut));
}

}  // namespace stylet
