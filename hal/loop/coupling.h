// SPDX-License-Identifier: Apache-2.0
// The virtual coupling: a spring between the device and the needle's base, so that the hand never
// feels more stiffness than its device can render, whatever the needle meets.
//
// The base follows one Newton step a tick towards the balance K (base - device) = F, with the bound
// on the environment's stiffness that the kernel gives; the hand feels the spring. Where that bound
// is zero the base is the device. Felt in the balance: K K_env / (K + K_env). The bound is an upper
// one, so the step alone would lag behind a moving hand, which feels as drag of K_bound * period:
// 15 to 60 N s/m of a needle that slides. So the base first goes where the balance goes: with the
// share K / (K + K_env) of the device's velocity, K_env as the last force and motion of the base
// tell it. Where the balance needs more than the hand can be shown, the base is drawn along at that
// distance: the needle goes where it is pushed, and what is felt is cut off without a step.
// Promises: the step is safe whatever K_env was thought to be; only + - * / sqrt; no allocation.
// Units: SI. Frame: world. Source: Colgate, Stanley and Brown 1995; Adams and Hannaford 1999.
#pragma once

#include "stylet/kernel.h"

namespace stylet::hal {

struct CouplingConfig {
  float stiffness_n_per_m = 0;  // 0: none, the needle's base is the device
  float max_force_n = 0;        // that the hand can be shown; 0: any
  float period_s = 1e-3F;
};

// Share of the stiffness a device can render that the coupling uses.
constexpr double kCouplingShare = 0.7;
// Over which the device's velocity is averaged, since it comes in steps of its resolution; and the
// stiffness that the base meets.
constexpr float kCouplingVelocityS = 20e-3F, kCouplingStiffnessS = 5e-3F;

struct CouplingState {
  bool started = false;
  Vec3 base_m = {}, device_m = {}, force_n = {};  // of the last tick
  Vec3 moved_m = {};                              // by the base, in it
  Vec3 step_m = {};                               // of the device in a tick, averaged
  float work_j = 0, square_m2 = 0;                // of changes of force, of motions: averaged
};

// Where the base is in this tick, given the kernel's answer to the last one.
Vec3 coupled_base(const CouplingConfig& config, CouplingState& state, Vec3 device_m,
                  const Output& last);
// What the hand feels, given the kernel's answer to this one.
Vec3 coupled_force(const CouplingConfig& config, const CouplingState& state, Vec3 device_m,
                   Vec3 kernel_n);

}  // namespace stylet::hal
