// SPDX-License-Identifier: Apache-2.0
// Measures what a device really does: rate and jitter of its samples, resolution, buttons, and, on
// request, whether a force pushes in the right direction. For hardware that nobody here has seen.
// Promise: forces stay below a third of the device's largest, at most 1 N, and pass the guard.
// Units: SI. Frame: the device's.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "hal/base/clock.h"
#include "hal/device/device.h"
#include "hal/guard/guard.h"
#include "hal/loop/loop.h"

namespace stylet::hal {

struct PushSeen {
  float force_n;  // largest of the ramp
  Vec3 moved_m;   // of the hand, during the ramp
};

struct DeviceProbe {
  double seconds = 0;
  std::uint64_t ticks = 0, unanswered = 0, repeated = 0, samples = 0, lost = 0;
  Histogram interval;                  // between the times of two samples
  Histogram age;                       // of a new sample in the tick that reads it
  std::int64_t longest_gap_ns = 0;     // without a new sample, as the ticks saw it
  std::int64_t latest_tick_ns = 0;     // how late this machine was itself
  std::optional<PacketCount> packets;  // of a device that sends packets
  std::array<float, 3> step_m = {};    // smallest change seen in each coordinate; 0: no change
  Vec3 low_m = {}, high_m = {};
  std::uint32_t buttons_seen = 0;     // pressed at least once
  std::array<PushSeen, 6> push = {};  // along +x, -x, +y, ...; no force: not requested
  Fault fault = Fault::kNone;
  Refusal refused = Refusal::kNone;  // why the samples were not used that caused the fault
};

// Ticks the device a thousand times a second: `seconds` without force; then, if `pushes`, half a
// second in both directions of each axis. Stops early when `stop` is set.
void probe_device(const Device& device, double seconds, bool pushes, const Clock& clock,
                  const std::atomic<bool>& stop, DeviceProbe& out);

}  // namespace stylet::hal
