// SPDX-License-Identifier: Apache-2.0
// The virtual coupling: a spring between the device and the needle's base, so that the hand never
// feels more stiffness than its device can render, whatever the needle meets.
//
// In each tick the base moves one Newton step towards the balance K (base - device) = F, using the
// kernel's bound on the environment's stiffness; the hand feels the spring. If the bound is 0, the
// base is the device. In the balance the hand feels K K_env / (K + K_env). The bound is an upper
// one, so the step alone would lag behind a moving hand, felt as a drag of K_bound * period: 15 to
// 60 N s/m with a needle that slides. So the base first moves as the balance moves, by the fraction
// K / (K + K_env) of the device's velocity, with K_env from the last force and motion of the base.
// If the balance needs more force than the hand can be shown, the base is pulled along at the
// distance at which the spring has that force: the needle follows the push, and the force felt
// stays at its limit without a step.
// Promises: the step is safe however wrong K_env is; only + - * / sqrt; no allocation.
// Units: SI. Frame: world. Source: Colgate, Stanley and Brown 1995; Adams and Hannaford 1999.
#pragma once

#include "stylet/kernel.h"

namespace stylet::hal {

struct CouplingConfig {
  float stiffness_n_per_m = 0;  // 0: no spring, the needle's base is the device
  float max_force_n = 0;        // that the hand can be shown; 0: unlimited
  float period_s = 1e-3F;
};

// The coupling uses this fraction of the stiffness that a device can render.
constexpr double kCouplingFraction = 0.7;
// Averaging times of the device's velocity, which comes in steps of the device's resolution, and of
// the stiffness that the base meets.
constexpr float kCouplingVelocityS = 20e-3F, kCouplingStiffnessS = 5e-3F;

struct CouplingState {
  bool started = false;
  Vec3 base_m = {}, device_m = {}, force_n = {};  // of the last tick
  Vec3 moved_m = {};                              // by the base, in the last tick
  Vec3 step_m = {};                               // of the device in one tick, averaged
  float work_j = 0, square_m2 = 0;                // averaged: (change of force) . motion; motion^2
};

// The base's position in this tick, given the kernel's answer to the last tick.
Vec3 coupled_base(const CouplingConfig& config, CouplingState& state, Vec3 device_m,
                  const Output& last);
// What the hand feels, given the kernel's answer to this tick.
Vec3 coupled_force(const CouplingConfig& config, const CouplingState& state, Vec3 device_m,
                   Vec3 kernel_n);

}  // namespace stylet::hal
