// SPDX-License-Identifier: Apache-2.0
#include "hand/force.h"

#include "coupling/bend.h"
#include "coupling/roll.h"
#include "coupling/spring.h"
#include "hand/input.h"
#include "state/attachment.h"

namespace stylet {

namespace {

void add_torque(const Needle& needle, Vec3 at_m, Vec3 on_needle_n, Output& out) {
  out.torque_nm = out.torque_nm + cross(at_m - needle.base_m, on_needle_n);
}

void add_particle(const Needle& needle, const Particle& p, Vec3& along_out_n, Output& out) {
  const Vec3 on_needle = -1.0F * p.force_n;
  const Vec3 direction = needle_point(needle, p.arc_m).direction;
  const Vec3 axial = dot(on_needle, direction) * direction;
  along_out_n = along_out_n + axial;
  out.cause.clamping_n = out.cause.clamping_n + (on_needle - axial);
  out.stiffness_n_per_m = out.stiffness_n_per_m + p.stiffness_n_per_m;
  add_torque(needle, grip(p), on_needle, out);
}

}  // namespace

void sum_forces(const Model& model, const State& state, const Needle& needle, Output& out) {
  const NeedleState& own = *state.needle;
  ForceByCause& cause = out.cause;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    add_particle(needle, state.shaft[i], cause.friction_n, out);
  }
  if (own.tip_alive != 0 && own.phase != Phase::kContact) {
    add_particle(needle, *state.tip, cause.cutting_n, out);
  } else if (own.tip_alive != 0) {
    const Particle& tip = *state.tip;
    cause.stiffness_n = -1.0F * tip.force_n;
    out.stiffness_n_per_m = tip.stiffness_n_per_m;
    add_torque(needle, tip.position_m, cause.stiffness_n, out);
  }
  const Vec3 shift = attachment_shift(model, state);
  for (std::uint32_t i = 0; i < own.touch_count; ++i) {
    const Touch& touch = state.touch[i];
    const Mat3& k = touch.stiffness_n_per_m;
    cause.obstacle_n = cause.obstacle_n + touch.force_n;
    out.stiffness_n_per_m = out.stiffness_n_per_m + (k.m[0][0] + k.m[1][1] + k.m[2][2]);
    add_torque(needle, touch.at_m - shift, touch.force_n, out);
  }
  // Sum of the causes, not of all forces: contacts may push against each other with 100 times that.
  out.force_n = ((cause.stiffness_n + cause.cutting_n) + (cause.friction_n + cause.clamping_n)) +
                cause.obstacle_n;
  out.torque_nm = out.torque_nm + roll_torque_nm(state);
}

void book_work(State& state, const Pose& before, const Output& out) {
  NeedleState& own = *state.needle;
  const Pose& now = own.handle;
  const Vec3 step = now.position_m - before.position_m;
  const Vec3 turn = turn_between(before.rotation, now.rotation);
  const float work = -0.5F * (dot(out.force_n + own.last_force_n, step) +
                              dot(out.torque_nm + own.last_torque_nm, turn));
  state.head->work_by_hand_j += static_cast<double>(work);
  own.last_force_n = out.force_n;
  own.last_torque_nm = out.torque_nm;
}

}  // namespace stylet
