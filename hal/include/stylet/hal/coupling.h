// SPDX-License-Identifier: Apache-2.0
// The virtual coupling: a spring between the device and the needle's base, so that the hand never
// feels more stiffness than its device can render, whatever the needle meets.
//
// The base follows one Newton step a tick towards the balance K (base - device) = F, with the bound
// on the environment's stiffness that the kernel gives; the hand feels the spring. Where that bound
// is zero the base is the device. Felt in the balance: K K_env / (K + K_env). The bound is an upper
// one, so a sliding needle feels at most K_env * period of extra viscous drag.
// Promises: force changes by at most K per metre of the device; only + - * /; no allocation.
// Units: SI. Frame: world. Source: Colgate, Stanley and Brown 1995; Adams and Hannaford 1999.
#pragma once

#include "stylet/kernel.h"

namespace stylet::hal {

struct CouplingConfig {
  float stiffness_n_per_m = 0;  // 0: none, the needle's base is the device
};

// Share of the stiffness a device can render that the coupling uses.
constexpr double kCouplingShare = 0.7;

struct CouplingState {
  bool started = false;
  Vec3 base_m = {};
};

// Where the base is in this tick, given the kernel's answer to the last one.
Vec3 coupled_base(const CouplingConfig& config, CouplingState& state, Vec3 device_m,
                  const Output& last);
// What the hand feels, given the kernel's answer to this one.
Vec3 coupled_force(const CouplingConfig& config, const CouplingState& state, Vec3 device_m,
                   Vec3 kernel_n);

}  // namespace stylet::hal
