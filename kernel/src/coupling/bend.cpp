// SPDX-License-Identifier: Apache-2.0
#include "coupling/bend.h"

#include "coupling/contact.h"
#include "coupling/roll.h"
#include "coupling/spring.h"
#include "coupling/touches.h"
#include "state/attachment.h"

namespace stylet {
namespace {

// No needle is quite straight. This kink at every joint decides to which side a needle buckles when
// it is pressed exactly along its axis.
constexpr double kImperfectionRad = 1e-7;
// The mass of a needle that is thrown about is taken as that of solid steel.
constexpr double kSteelKgPerM3 = 7850;
// If the last Newton step turns a rod farther than this, the steps have not converged: the needle
// snaps over. (At rest they end below 1e-5, with a jerk on obstacles below 1e-3.)
constexpr double kSettledTurnRad = 1e-2;

bool is_elastic(const NeedleConfig& config) {
  return config.bending_nm2 > 0 || config.bent_angle_rad > 0;
}

// A direction across `from`, carried by the smallest turn from `from` to `to`.
Vec3 carried(Vec3 across, Vec3 from, Vec3 to) {
  const float opening = max_of(1 + dot(from, to), 1e-6F);
  const Vec3 moved = across - (dot(across, to) / opening) * (from + to);
  return unit_vector(moved - dot(moved, to) * to);
}

Sym3d across(Vec3 direction, float stiffness) {
  const double k = static_cast<double>(stiffness);
  const Vec3d t = to_double(direction);
  return {k * (1 - t.x * t.x), -k * t.x * t.y, -k * t.x * t.z,
          k * (1 - t.y * t.y), -k * t.y * t.z, k * (1 - t.z * t.z)};
}

// A particle that has slipped along the shaft will slip on: its force there is at its limit.
bool slides(const Particle& p) {
  return dot(p.slip_m, p.slip_m) > 0;
}

// A particle bends the needle by its spring, in the directions in which it is fixed to the needle:
// one that slips, only across the shaft. (Without its spring along the shaft, a needle pressed at
// the tip buckles under a load that does not give way.)
void add_particle(const Model& model, const State& state, const Needle& last, const Particle& p,
                  RodLoads& loads) {
  if (p.support_count == 0) return;
  const NeedleState& own = *state.needle;
  const Vec3 direction = needle_point(last, p.arc_m).direction;
  const Vec3 along = slides(p) ? direction : Vec3{};
  const double grip_arc_m = static_cast<double>(p.arc_m + dot(p.axial_way_m, direction));
  const double length = static_cast<double>(model.needle_config().length_m);
  loads.load[loads.count++] = {length - grip_arc_m, to_double(grip(p)) - to_double(own.base_m),
                               -1.0 * to_double(p.force_n), across(along, p.stiffness_n_per_m)};
}

// All loads from the tissue: its force in the last step, and how that changes with the needle.
void gather_loads(const Model& model, const State& state, RodLoads& loads) {
  const NeedleState& own = *state.needle;
  const Needle last = needle_of(model, state);
  loads.count = 0;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    add_particle(model, state, last, state.shaft[i], loads);
  }
  if (own.tip_alive != 0) add_particle(model, state, last, *state.tip, loads);
}

// A step near obstacles moves no node beyond the place that was searched. The stiffness that may
// hold a node is its mass over a tick squared: a larger one would let no needle move at all.
RodCare care_of(const Model& model) {
  const double radius = static_cast<double>(model.needle_config().outer_radius_m);
  const double period = static_cast<double>(model.head->config.period_s);
  const double kg_per_m = kSteelKgPerM3 * 3.14159265 * radius * radius;
  return {kReachM / kRodFaceSteps, kg_per_m * model.rod->rod_m / (period * period)};
}

struct HandleTurn {
  double wxyz[4];
};
HandleTurn handle_turn(const State& state) {
  const Quat& q = state.needle->handle.rotation;
  return {{static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
           static_cast<double>(q.z)}};
}

void put_nodes(const Model& model, State& state, const Scratch& scratch) {
  for (std::uint32_t i = 0; i <= model.rod->rods; ++i) {
    state.node[i] = state.needle->base_m + to_float(scratch.rod_result->node_m[i]);
  }
}

std::uint32_t keep_bend(const Model& model, State& state, const Scratch& scratch) {
  put_nodes(model, state, scratch);
  const RodResult& result = *scratch.rod_result;
  if (result.least_pivot > 0 && result.last_turn_rad < kSettledTurnRad) return 0;
  ++state.head->needle_unstable;
  return kFlagNeedleUnstable;
}

// A particle moves with the needle. One that slips only moves across it: how far it goes along is
// decided in the next tick.
void carry(const Needle& needle, Particle& p) {
  if (p.support_count == 0) return;
  const NeedlePoint at = needle_point(needle, p.arc_m);
  const Vec3 moved = at.place_m - p.position_m;
  const float along = slides(p) ? dot(moved, at.direction) : 0;
  p.position_m = p.position_m + (moved - along * at.direction);
  turn_axial_way(p, at.direction);
  p.force_n = force_on_tissue(p);
}

// Bends the needle against tissue and bodies together: looks at the bodies, bends, and looks again
// from the new shape. Returns output flags.
std::uint32_t bend(const Model& model, State& state, Scratch& scratch, Vec3 shift,
                   std::uint32_t looks, Nearest& nearest) {
  const RodModel& rod = *model.rod;
  const HandleTurn turn = handle_turn(state);
  RodResult& result = *scratch.rod_result;
  RodLoads& loads = *scratch.loads;
  gather_loads(model, state, loads);
  nearest = {};
  if (model.head->obstacle_count > 0) {
    carry_rod(rod, turn.wxyz, *state.rod_shape, *scratch.rod, result);
    Nearest before = {};
    look_around(model, state, scratch, shift, before, nearest);
    for (std::uint32_t look = 0; look < looks && nearest.faces.count > 0; ++look) {
      if (look > 0) {
        before = nearest;
        look_around(model, state, scratch, shift, before, nearest);
      }
      bend_rod(rod, turn.wxyz, loads, nearest.faces, care_of(model), *state.rod_shape, *scratch.rod,
               result);
    }
  }
  if (nearest.faces.count == 0) {
    solve_rod(rod, turn.wxyz, loads, *state.rod_shape, *scratch.rod, result);
  }
  return keep_bend(model, state, scratch);
}

}  // namespace

Needle needle_of(const Model& model, const State& state) {
  Needle needle = {};
  needle.node = state.node;
  needle.rods = model.rod->rods;
  needle.rod_m = static_cast<float>(model.rod->rod_m);
  needle.base_m = needle.node[0];
  needle.tip_m = needle.node[needle.rods];
  return needle;
}

void make_needle(const NeedleConfig& config, RodModel& rod_out) {
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
  make_rod(rods, static_cast<double>(config.length_m), bending, {kinks, rods}, rod_out);
}

std::uint32_t place_needle(const Model& model, State& state, Scratch& scratch, Needle& needle_out) {
  NeedleState& own = *state.needle;
  const NeedleConfig& config = model.needle_config();
  const Vec3 shift = attachment_shift(model, state);
  const Mat3 r = rotation_matrix(own.handle.rotation);
  own.base_m = own.handle.position_m - shift;
  const Vec3 before_m[2] = {state.node[0], state.node[1]};
  std::uint32_t flags = 0;
  if (is_elastic(config)) {
    // In the tissue the second bend gives the touches.
    Nearest nearest;
    flags |= bend(model, state, scratch, shift, kRodFaceLooks, nearest);
    if (own.tip_alive == 0) flags |= enter_touches(model, state, scratch, nearest);
  } else {
    state.node[0] = own.base_m;
    state.node[1] = own.base_m - config.length_m * column(r, 2);
  }
  needle_out = needle_of(model, state);
  Vec3 from = -1.0F * column(r, 2);
  needle_out.side = rolled_side(state, r);
  needle_out.tip_direction = from;
  for (std::uint32_t i = 0; is_elastic(config) && i < needle_out.rods; ++i) {
    const Vec3 to = unit_vector(needle_out.node[i + 1] - needle_out.node[i]);
    needle_out.side = carried(needle_out.side, from, to);
    needle_out.tip_direction = from = to;
  }
  if (!is_elastic(config)) {
    flags |= touch_obstacles(model, state, scratch, needle_out, before_m, shift);
  }
  return flags;
}

namespace {

// Bends the needle by the forces on it, and moves its particles along. Returns output flags.
std::uint32_t bend_on(const Model& model, State& state, Scratch& scratch, Needle& needle,
                      Nearest& nearest) {
  const Vec3 before_m = state.tip->position_m;
  const std::uint32_t flags =
      bend(model, state, scratch, attachment_shift(model, state), 1, nearest);
  needle.tip_m = needle.node[needle.rods];
  for (std::uint32_t i = 0; i < state.needle->shaft_count; ++i) {
    carry(needle, state.shaft[i]);
  }
  carry(needle, *state.tip);
  stretch_tip(state, scratch, needle.tip_m - before_m);
  throw_aside(model, state, scratch, needle, needle.tip_m - before_m);
  return flags;
}

}  // namespace

std::uint32_t meet_tissue(const Model& model, State& state, Scratch& scratch, Needle& needle) {
  Particle& tip = *state.tip;
  if (!is_elastic(model.needle_config()) || state.needle->phase != Phase::kContact) return 0;
  tip.force_n = force_on_tissue(tip);
  Nearest nearest;
  const std::uint32_t flags = bend_on(model, state, scratch, needle, nearest);
  needle.off_m = norm(residual(tip));
  return flags;
}

std::uint32_t settle_needle(const Model& model, State& state, Scratch& scratch, Needle& needle) {
  if (!is_elastic(model.needle_config()) || state.needle->tip_alive == 0) return 0;
  Nearest nearest;
  const std::uint32_t flags = bend_on(model, state, scratch, needle, nearest);
  return flags | enter_touches(model, state, scratch, nearest);
}

}  // namespace stylet
