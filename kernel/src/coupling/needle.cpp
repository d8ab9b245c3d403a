// SPDX-License-Identifier: Apache-2.0
#include "coupling/needle.h"

#include "coupling/coupling.h"
#include "coupling/roll.h"
#include "needle/obstacle.h"
#include "needle/rod.h"

namespace stylet {
namespace {

// No needle is quite straight: this kink at every joint decides to which side one pressed exactly
// along its axis buckles.
constexpr double kImperfectionRad = 1e-7;
// Of what a needle is taken to be made of when it is thrown about: solid steel.
constexpr double kSteelKgPerM3 = 7850;
// Obstacles nearer than this are looked for. All steps of one look go no farther, so that a needle
// that snaps over does not go through what it has not seen.
constexpr double kReachM = 2e-3;
// A touch so near to a rod's end, in rods, may go on at the next rod.
constexpr float kNearNode = 0.1F;
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

// Where a particle has slipped along the shaft it will slip on: its force there is on its limit.
bool slides(const Particle& p) {
  return dot(p.slip_m, p.slip_m) > 0;
}

// A held particle bends the needle by its spring, where that is fixed to it: one that slips, only
// across the shaft. (Without the spring along it, one pressed at the tip buckles under a load that
// does not give way.)
void add_particle(const View& view, const Needle& last, const Particle& p, RodLoads& loads) {
  if (p.share_count == 0) return;
  const NeedleState& own = *view.state.needle;
  const Vec3 direction = needle_point(last, p.arc_m).direction;
  const Vec3 along = slides(p) ? direction : Vec3{};
  const double grip_arc_m = static_cast<double>(p.arc_m + dot(p.give_m, direction));
  const double length = static_cast<double>(view.needle_config().length_m);
  loads.load[loads.count++] = {length - grip_arc_m, to_double(grip(p)) - to_double(own.base_m),
                               -1.0 * to_double(p.force_n), across(along, p.stiffness_n_per_m)};
}

// All that the tissue pushed the needle with in the last step, as it answers to being moved.
void gather_loads(const View& view, RodLoads& loads) {
  const NeedleState& own = *view.state.needle;
  const Needle last = needle_of(view);
  loads.count = 0;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    add_particle(view, last, view.state.shaft[i], loads);
  }
  if (own.tip_alive != 0) add_particle(view, last, *view.state.tip, loads);
}

// A step near obstacles takes no node past what was looked at. What holds it, if need be, is a
// node's mass over the square of a tick: more than that its inertia would let no needle go.
RodCare care_of(const View& view) {
  const double radius = static_cast<double>(view.needle_config().outer_radius_m);
  const double period = static_cast<double>(view.model.head->config.period_s);
  const double kg_per_m = kSteelKgPerM3 * 3.14159265 * radius * radius;
  return {kReachM / kRodFaceSteps, kg_per_m * view.model.rod->rod_m / (period * period)};
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

std::uint32_t keep_bend(const View& view) {
  put_nodes(view);
  const RodResult& result = *view.scratch.rod_result;
  if (result.least_pivot > 0 && result.last_turn_rad < kSettledTurnRad) return 0;
  ++view.state.head->needle_unstable;
  return kFlagNeedleUnstable;
}

// A particle goes where the needle has gone; one that slips, only across, for how far along is
// decided in the next tick.
void carry(const Needle& needle, Particle& p) {
  if (p.share_count == 0) return;
  const NeedlePoint at = needle_point(needle, p.arc_m);
  const Vec3 moved = at.place_m - p.position_m;
  const float along = slides(p) ? dot(moved, at.direction) : 0;
  p.position_m = p.position_m + (moved - along * at.direction);
  turn_give(p, at.direction);
  p.force_n = force_on_tissue(p);
}

// ==== Obstacles
// =====================================================================================

// The touch of the last tick that goes on at a piece: its own, or that of a piece beside it which
// it has come from along the shaft. Null: it did not touch.
const Touch* remembered(const View& view, std::uint32_t obstacle, std::uint32_t rod) {
  const Touch* beside = nullptr;
  for (std::uint32_t i = 0; i < view.state.needle->touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    if (touch.obstacle != obstacle) continue;
    if (touch.rod == rod) return &touch;
    const float place = touch.contact.place;
    const bool from_above = touch.rod + 1 == rod && place > 1 - kNearNode;
    const bool from_below = touch.rod == rod + 1 && place < kNearNode;
    if (from_above || from_below) beside = &touch;
  }
  return beside;
}

// A face of a body beside a piece of the needle.
struct Near {
  std::uint32_t body, rod;
  ObstacleFace face;
  const Touch* last;
};
// Those that reach deepest, and the same for the rods.
struct Nearest {
  std::uint32_t left_out;  // that touch
  Near near[kMaxTouches];
  RodFaces faces;
};

Vec3d world_origin(const View& view, Vec3 shift) {
  return to_double(view.state.needle->base_m) + to_double(shift);
}

RodFace rod_face(const View& view, const Near& near, Vec3d origin_m) {
  const ObstacleConfig& config = view.model.obstacle[near.body].config;
  const double k = static_cast<double>(config.stiffness_n_per_m);
  const double most_n = static_cast<double>(config.largest_force_n);
  return {(near.rod + static_cast<double>(near.face.place)) * view.model.rod->rod_m,
          near.face.at_m - origin_m,
          near.face.normal,
          near.face.depth_m,
          near.face.bristle_m,
          k < kMaxRodStiffnessNPerM ? k : kMaxRodStiffnessNPerM,
          most_n < kMaxRodForceN ? most_n : kMaxRodForceN,
          static_cast<double>(config.friction),
          near.face.goes_on ? static_cast<double>(near.last->contact.limit_n) : 0,
          near.face.depth_m > 0 || near.last != nullptr,
          false,
          0,
          0};
}

// In a full list, the place of the face that is least deep; null: the new one is left out.
Near* place_for(Nearest& out, double depth_m) {
  if (out.faces.count < kMaxTouches) return out.near + out.faces.count++;
  Near* least = out.near;
  for (Near& each : out.near) {
    if (each.face.depth_m < least->face.depth_m) least = &each;
  }
  if (depth_m > 0 && least->face.depth_m > 0) ++out.left_out;
  return least->face.depth_m < depth_m ? least : nullptr;
}

// A face as it was in the last look and what bending made of it; null: it was not seen.
struct Seen {
  const Near* near;
  const RodFace* face;
};
Seen seen(const Nearest& before, std::uint32_t body, std::uint32_t rod) {
  for (std::uint32_t i = 0; i < before.faces.count; ++i) {
    const Near& near = before.near[i];
    if (near.body == body && near.rod == rod) return {&near, before.faces.face + i};
  }
  return {nullptr, nullptr};
}

// All pieces, at the shape of the rods' result, and all bodies.
void look_around(const View& view, Vec3 shift, const Nearest& before, Nearest& out) {
  const RodResult& result = *view.scratch.rod_result;
  const double radius_m = static_cast<double>(view.needle_config().outer_radius_m);
  const Vec3d origin_m = world_origin(view, shift);
  out = {};
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    for (std::uint32_t rod = 0; rod < view.model.rod->rods; ++rod) {
      const Segment axis = {origin_m + result.node_m[rod], origin_m + result.node_m[rod + 1]};
      const Touch* last = remembered(view, body, rod);
      Vec3d now = {0, 0, 0};
      if (last != nullptr) {
        const double arc =
            (last->rod + static_cast<double>(last->contact.place)) * view.model.rod->rod_m;
        now = origin_m + rod_point(*view.model.rod, result, arc).place_m;
      }
      Near found = {body, rod, {}, last};
      const Seen at = seen(before, body, rod);
      if (!find_face(view.model.obstacle[body], axis, radius_m,
                     last != nullptr ? last->contact : ObstacleContact{}, now,
                     at.near != nullptr ? at.near->face.normal : Vec3d{0, 0, 0}, kReachM,
                     found.face)) {
        continue;
      }
      Near* const place = place_for(out, found.face.depth_m);
      if (place == nullptr) continue;
      *place = found;
      RodFace& face = out.faces.face[place - out.near];
      face = rod_face(view, found, origin_m);
      // Friction goes on from the limit that it came to, not from the last tick's once more.
      if (at.face != nullptr) face.limit_n = at.face->limit_n;
    }
  }
}

// Bends the needle against tissue and bodies together: looks at the bodies, bends, and looks again
// from there. Returns output flags.
std::uint32_t bend(const View& view, Vec3 shift, std::uint32_t looks, Nearest& nearest) {
  const RodModel& model = *view.model.rod;
  const HandleTurn turn = handle_turn(view);
  RodResult& result = *view.scratch.rod_result;
  RodLoads& loads = *view.scratch.loads;
  gather_loads(view, loads);
  nearest = {};
  if (view.model.head->obstacle_count > 0) {
    carry_rod(model, turn.wxyz, *view.state.rod_shape, *view.scratch.rod, result);
    Nearest before = {};
    look_around(view, shift, before, nearest);
    for (std::uint32_t look = 0; look < looks && nearest.faces.count > 0; ++look) {
      if (look > 0) {
        before = nearest;
        look_around(view, shift, before, nearest);
      }
      bend_rod(model, turn.wxyz, loads, nearest.faces, care_of(view), *view.state.rod_shape,
               *view.scratch.rod, result);
    }
  }
  if (nearest.faces.count == 0) {
    solve_rod(model, turn.wxyz, loads, *view.state.rod_shape, *view.scratch.rod, result);
  }
  return keep_bend(view);
}

// What a face did, as the touch that the next tick remembers; its loss goes into the books.
bool enter_touch(const View& view, const Nearest& nearest, std::uint32_t i, Touch& out) {
  const Near& near = nearest.near[i];
  const RodFace& face = nearest.faces.face[i];
  const Obstacle& obstacle = view.model.obstacle[near.body];
  const RodTouch touch = touch_face(*view.model.rod, *view.scratch.rod_result, face);
  // No friction without force, whatever the limit was on the way.
  const double most_n = face.friction * touch.force_n, most = most_n / face.stiffness_n_per_m;
  const double length = norm(touch.bristle_m);
  const Vec3d bristle = length > most ? (most / length) * touch.bristle_m : touch.bristle_m;
  const ObstacleContact last = near.last != nullptr ? near.last->contact : ObstacleContact{};
  view.state.head->obstacles_j += face_loss(obstacle, near.face, last, touch.moved_m, bristle);
  if (!(touch.force_n > 0)) return false;
  const Vec3 normal = to_float(near.face.normal);
  const Vec3d at = near.face.at_m + touch.moved_m;
  out = {near.body,
         near.rod,
         {normal, to_float(bristle), at, near.face.place,
          static_cast<float>(touch.slips && face.limit_n < most_n ? face.limit_n : most_n)},
         to_float(at),
         to_float(touch.force_n * near.face.normal - face.stiffness_n_per_m * bristle),
         static_cast<float>(face.arc_m),
         obstacle_stiffness(obstacle, normal, touch.depth_m, touch.slips),
         normal,
         static_cast<float>(touch.depth_m)};
  return true;
}

std::uint32_t keep_touches(const View& view, const Touch* touch, std::uint32_t count,
                           std::uint32_t left_out) {
  NeedleState& own = *view.state.needle;
  view.state.head->obstacle_pool_full += left_out;
  if (count > 0 && own.touch_count == 0) add_event(view, EventKind::kObstacle, 0);
  for (std::uint32_t i = 0; i < count; ++i) view.state.touch[i] = touch[i];
  own.touch_count = count;
  own.touch_max = own.touch_max > count ? own.touch_max : count;
  return left_out > 0 ? std::uint32_t{kFlagObstaclePoolFull} : 0U;
}

std::uint32_t enter_touches(const View& view, const Nearest& nearest) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < nearest.faces.count; ++i) {
    if (enter_touch(view, nearest, i, view.scratch.touch[count])) ++count;
  }
  return keep_touches(view, view.scratch.touch, count, nearest.left_out);
}

// A stiff needle goes where the hand does.
std::uint32_t touch_obstacles(const View& view, const Needle& needle, Vec3 shift) {
  std::uint32_t count = 0;
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    const NeedlePiece piece = {needle.node[0] + shift, needle.node[1] + shift,
                               view.needle_config().outer_radius_m};
    const Touch* const last = remembered(view, body, 0);
    ObstacleContact next = {};
    const ObstacleLoad load =
        obstacle_load(view.model.obstacle[body], piece,
                      last != nullptr ? last->contact : ObstacleContact{}, next);
    view.state.head->obstacles_j += static_cast<double>(load.dissipated_j);
    if (!(load.depth_m > 0)) continue;
    view.scratch.touch[count++] = {body,
                                   0,
                                   next,
                                   load.at_m,
                                   load.force_n,
                                   load.place * needle.rod_m,
                                   load.stiffness_n_per_m,
                                   load.normal,
                                   load.depth_m};
  }
  return keep_touches(view, view.scratch.touch, count, 0);
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
    // In the tissue the touches are those of the second bend.
    Nearest nearest;
    flags |= bend(view, shift, kRodFaceLooks, nearest);
    if (own.tip_alive == 0) flags |= enter_touches(view, nearest);
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
  if (!is_elastic(config)) flags |= touch_obstacles(view, needle_out, shift);
  return flags;
}

namespace {

// Bends the needle by the forces on it, and takes its particles along. Returns output flags.
std::uint32_t bend_on(const View& view, Needle& needle, Nearest& nearest) {
  const Vec3 before_m = view.state.tip->position_m;
  const std::uint32_t flags = bend(view, attachment_shift(view), 1, nearest);
  needle.tip_m = needle.node[needle.rods];
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    carry(needle, view.state.shaft[i]);
  }
  carry(needle, *view.state.tip);
  stretch_tip(view, needle.tip_m - before_m);
  throw_aside(view, needle, needle.tip_m - before_m);
  return flags;
}

}  // namespace

std::uint32_t meet_tissue(const View& view, Needle& needle) {
  Particle& tip = *view.state.tip;
  if (!is_elastic(view.needle_config()) || view.state.needle->phase != Phase::kContact) return 0;
  tip.force_n = force_on_tissue(tip);
  Nearest nearest;
  const std::uint32_t flags = bend_on(view, needle, nearest);
  needle.off_m = norm(residual(tip));
  return flags;
}

std::uint32_t settle_needle(const View& view, Needle& needle) {
  if (!is_elastic(view.needle_config()) || view.state.needle->tip_alive == 0) return 0;
  Nearest nearest;
  const std::uint32_t flags = bend_on(view, needle, nearest);
  return flags | enter_touches(view, nearest);
}

Vec3 turn_cut(Vec3 cut, const Needle& needle, float bevel_per_m, float advance_m) {
  const float size = advance_m < 0 ? -advance_m : advance_m;
  const Vec3 side = unit(needle.side - dot(needle.side, cut) * cut);
  const float part = size / (size + kBevelAlignM);
  const Vec3 turned = cut + max_of(advance_m, 0) * bevel_per_m * side;
  return unit(turned + part * (needle.tip_direction - cut));
}

}  // namespace stylet
