// SPDX-License-Identifier: Apache-2.0
// Messages between a loop and whoever looks after it: which fault is latched, and which fault
// somebody has seen.
//
// Any thread may write `seen` and read `latched`. Once the force has faded, the loop takes `seen`
// and rearms if it names the latched fault, number included, and the device answers. If not, it is
// forgotten and must be sent again, so that no force comes back long after somebody asked for it.
// Without the number, a late message about one fault would clear the next fault of the same kind,
// which nobody has seen.
// Promises: wait-free, no allocation, no system call.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "hal/guard/guard.h"

namespace stylet::hal {

// Aligned like the 64-bit word that it fills: with less, Clang calls a library that may lock.
struct alignas(std::uint64_t) LatchedFault {
  Fault fault = Fault::kNone;
  std::uint32_t number = 0;  // counts all faults this guard has latched, from 1; 0: no fault

  bool operator==(const LatchedFault&) const = default;
};

// What a person should know of the latched fault besides its name.
struct alignas(std::uint64_t) FaultCause {
  Refusal why = Refusal::kNone;  // of the samples, if the fault is theirs
  bool clears_itself = false;
  std::uint16_t allowed_us = 0;  // the watchdog
  std::uint32_t for_us = 0;      // how late the sample was, or the time without a usable one
};

inline FaultCause cause_of(const GuardState& guard) {
  if (guard.fault == Fault::kNone) return {};
  const bool of_samples = guard.fault == Fault::kStaleSamples ||
                          guard.fault == Fault::kDeviceSilent ||
                          (guard.fault == Fault::kTooFast && guard.refused.why == Refusal::kJumped);
  const RefusedSamples refused = of_samples ? guard.refused : RefusedSamples{};
  const auto us = [](std::int64_t ns, std::int64_t most) {
    return std::clamp<std::int64_t>(ns / 1000, 0, most);
  };
  return {refused.why, guard_clears_itself(guard),
          static_cast<std::uint16_t>(us(refused.allowed_ns, UINT16_MAX)),
          static_cast<std::uint32_t>(us(refused.for_ns, UINT32_MAX))};
}

inline LatchedFault latched_fault(const GuardState& guard) {
  if (guard.fault == Fault::kNone) return {};
  return {guard.fault, static_cast<std::uint32_t>(guard.counters.faults)};
}

struct FaultMailbox {
  std::atomic<LatchedFault> latched{};  // the loop writes it
  std::atomic<FaultCause> cause{};      // likewise, before `latched`
  std::atomic<LatchedFault> seen{};     // the loop takes it
};
static_assert(std::atomic<LatchedFault>::is_always_lock_free);
static_assert(std::atomic<FaultCause>::is_always_lock_free);

// Called by the loop at the end of every tick.
inline void exchange_mail(FaultMailbox& mailbox, GuardState& guard) {
  if (guard.mode != GuardMode::kFading) {
    const LatchedFault seen = mailbox.seen.exchange({}, std::memory_order_relaxed);
    if (seen.number != 0 && seen == latched_fault(guard)) (void)guard_rearm(guard, seen.fault);
  }
  mailbox.cause.store(cause_of(guard), std::memory_order_relaxed);
  mailbox.latched.store(latched_fault(guard), std::memory_order_release);
}

}  // namespace stylet::hal
