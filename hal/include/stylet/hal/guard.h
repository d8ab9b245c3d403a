// SPDX-License-Identifier: Apache-2.0
// The guard between kernel and device: whatever either of them does, the hand is safe.
//
// It trusts neither side and shares no code with them. Every force it lets through is finite, at
// most max_force_n long (shortened, never turned) and at most max_slew_n_per_s away from the one
// before. Forces fade in after arming. Trouble latches a fault: the force goes to zero within
// kDecayS, or at once if it is not a number, and stays there until guard_rearm names the fault.
// Plain functions over a plain struct: no allocation, no clock, bounded time.
// Units: SI. Frame: the device's.
#pragma once

#include <cstdint>

#include "stylet/hal/device.h"

namespace stylet::hal {

constexpr float kDecayS = 0.020F;

// Numbers are part of recordings: they never change meaning.
enum class Fault : std::uint32_t {
  kNone = 0,
  kForceNotFinite = 1,  // the kernel asked for NaN or an infinity
  kStaleSamples = 2,    // the device answers, but with nothing new or nothing usable
  kDeviceSilent = 3,    // the device does not answer
  kTooLate = 4,         // the loop missed too many ticks in a row
  kKernelFault = 5,     // the kernel latched a fault of its own
};
const char* fault_name(Fault fault);

struct GuardConfig {
  float period_s = 1e-3F;
  float max_force_n = 8;
  float max_slew_n_per_s =
      2000;                  // at least max_force_n / kDecayS, so that a fault can fade in time
  float ramp_s = 0.5F;       // after arming
  float watchdog_s = 3e-3F;  // longest time without a new usable sample
};

struct GuardCounters {
  std::uint64_t samples_used;
  std::uint64_t samples_missing;   // no answer
  std::uint64_t samples_repeated;  // sequence number not newer than the last
  std::uint64_t samples_lost;      // gaps in the sequence numbers
  std::uint64_t samples_old;       // older than watchdog_s
  std::uint64_t samples_not_finite;
  std::uint64_t samples_absurd;  // further than 10 m away, or not a rotation
  std::uint64_t force_not_finite;
  std::uint64_t force_limited;
  std::uint64_t slew_limited;
  std::uint64_t faults;
  std::uint64_t rearms;
};

struct GuardState {
  Fault fault;                // latched
  std::uint32_t blind_ticks;  // ticks in a row without a usable sample
  std::uint32_t ramp_tick;    // since arming
  std::uint32_t decay_tick;   // since the fault
  std::uint32_t have_seq;
  std::uint64_t seq;  // of the newest sample
  Vec3 force_n;       // last one let through
  Vec3 force_at_fault_n;
  GuardCounters counters;
};

// Armed, at zero force, at the start of the ramp.
GuardState guard_start();

// True if the kernel may use the sample. `answered`: the device gave one at all.
bool guard_sample(const GuardConfig& config, GuardState& state, bool answered, const Sample& sample,
                  std::int64_t now_ns);

// The force to send instead of `force_n`.
Vec3 guard_force(const GuardConfig& config, GuardState& state, Vec3 force_n);

// Latches `fault` unless one is latched already.
void guard_trip(GuardState& state, Fault fault);

// Back into the ramp, if `seen` is the latched fault and the force has gone to zero.
bool guard_rearm(GuardState& state, Fault seen);

}  // namespace stylet::hal
