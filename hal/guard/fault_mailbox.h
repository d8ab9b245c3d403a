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

inline LatchedFault latched_fault(const GuardState& guard) {
  if (guard.fault == Fault::kNone) return {};
  return {guard.fault, static_cast<std::uint32_t>(guard.counters.faults)};
}

struct FaultMailbox {
  std::atomic<LatchedFault> latched{};  // the loop writes it
  std::atomic<LatchedFault> seen{};     // the loop takes it
};
static_assert(std::atomic<LatchedFault>::is_always_lock_free);

// Called by the loop at the end of every tick.
inline void exchange_mail(FaultMailbox& mailbox, GuardState& guard) {
  if (guard.mode != GuardMode::kFading) {
    const LatchedFault seen = mailbox.seen.exchange({}, std::memory_order_relaxed);
    if (seen.number != 0 && seen == latched_fault(guard)) (void)guard_rearm(guard, seen.fault);
  }
  mailbox.latched.store(latched_fault(guard), std::memory_order_relaxed);
}

}  // namespace stylet::hal
