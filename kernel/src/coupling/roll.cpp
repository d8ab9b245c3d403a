// SPDX-License-Identifier: Apache-2.0
#include "coupling/roll.h"

#include "coupling/bend.h"
#include "coupling/friction.h"

namespace stylet {
namespace {

// Below this force in N a particle does not hold the shaft.
constexpr float kLeastHoldN = 1e-9F;

// A violent hand may leave particles behind its own place: no arm is taken to be shorter than this.
constexpr float kLeastArmM = 1e-3F;

struct RollGrip {
  float torque_nm, moment_nm2;  // sums of t and of t s
};

RollGrip roll_grip(const Model& model, const State& state) {
  const NeedleState& own = *state.needle;
  const float length = model.needle_config().length_m,
              radius = model.needle_config().outer_radius_m;
  const Needle last = needle_of(model, state);
  RollGrip grip = {};
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    const Particle& p = state.shaft[i];
    const float limit = friction_limit_n(model, state, p);
    const float carried = dot(p.force_n, needle_point(last, p.arc_m).direction);
    const float left = std::sqrt(max_of(limit * limit - carried * carried, 0));
    grip.torque_nm += left * radius;
    grip.moment_nm2 += left * radius * max_of(length - p.arc_m, kLeastArmM);
  }
  return grip;
}

}  // namespace

void roll_tip(const Model& model, State& state, float rolled_rad) {
  const float torsion = model.needle_config().torsion_nm2;
  NeedleState& own = *state.needle;
  if (!(torsion > 0)) return;
  const RollGrip grip = roll_grip(model, state);
  const double before = roll_energy(state);
  const bool held = grip.torque_nm > kLeastHoldN * model.needle_config().outer_radius_m;
  const float stiffness = held ? torsion * grip.torque_nm / grip.moment_nm2 : 0;
  // Where the holding particles have moved, torque or twist stays, whichever adds no energy.
  if (stiffness > own.twist_nm_per_rad) own.twist_rad *= own.twist_nm_per_rad / stiffness;
  own.twist_nm_per_rad = stiffness;
  state.head->friction_j += before - roll_energy(state);
  const float limit = held ? min_of(grip.moment_nm2 / torsion, kMaxTwistRad) : 0;
  const float wound = own.twist_rad + rolled_rad, twist = clamp(wound, -limit, limit);
  // At the mean of the torques before and after, like the hand's work in the books.
  const float torque = 0.5F * stiffness * (own.twist_rad + twist);
  state.head->friction_j += static_cast<double>(torque * (wound - twist));
  own.twist_rad = settle(twist);
}

Vec3 rolled_side(const State& state, const Mat3& handle) {
  const float twist = state.needle->twist_rad;
  const float part = (twist < 0 ? -twist : twist) * (1 / 3.14159265F);
  const float sine = sine_of_half_turns(part);
  const float cosine =
      part < 0.5F ? sine_of_half_turns(0.5F - part) : -sine_of_half_turns(part - 0.5F);
  return cosine * column(handle, 0) - (twist < 0 ? -sine : sine) * column(handle, 1);
}

Vec3 roll_torque_nm(const State& state) {
  const NeedleState& own = *state.needle;
  const Mat3 handle = rotation_matrix(own.handle.rotation);
  return (-own.twist_nm_per_rad * own.twist_rad) * column(handle, 2);
}

double roll_energy(const State& state) {
  const NeedleState& own = *state.needle;
  return 0.5 * static_cast<double>(own.twist_nm_per_rad * own.twist_rad * own.twist_rad);
}

}  // namespace stylet
