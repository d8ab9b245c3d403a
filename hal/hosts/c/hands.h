// SPDX-License-Identifier: Apache-2.0
// The hand's side of the interface, as hal has it: guards, devices, what is checked of them.
#pragma once

#include "hal/device/device.h"
#include "hal/guard/guard.h"
#include "hal/hosts/c/plain.h"
#include "hal/hosts/c/process.h"
#include "stylet/stylet_loop.h"

struct stylet_guard {
  stylet::hal::GuardConfig config;
  float max_torque_nm = 0;
  stylet::hal::GuardState force = stylet::hal::guard_start();
  stylet::hal::GuardState torque = stylet::hal::guard_start();
};

struct stylet_device {
  stylet::hal::Device device;
  bool opened = false;                               // by URI: in real time
  bool scripted = false;                             // computed
  bool taken = false;                                // by a loop, which closes it
  std::int64_t process = stylet::c::this_process();  // that closes it: its threads are there
};

namespace stylet::c {

struct CheckedGuard {
  hal::GuardConfig config;
  float max_torque_nm = 0;
};
stylet_guard_config plain(const hal::GuardConfig& config, float max_torque_nm);
stylet_status read_guard(const stylet_guard_config* config, std::uint32_t bytes,
                         std::uint32_t index, CheckedGuard& out, stylet_refusal* refusal_out);

}  // namespace stylet::c
