// SPDX-License-Identifier: Apache-2.0
// Between a loop and whoever looks after it: the fault that is latched, and the one that somebody
// has seen.
//
// Any thread may write `seen` and read `latched`. The loop takes `seen` once the force has faded,
// and rearms if it names the fault, by its number too, and the device answers; if not, it is
// forgotten and to be asked for again, so that nothing comes back long after somebody wanted it.
// Without the number, what was said of one fault and is late would clear the next of its kind,
// which nobody has seen.
// Promises: wait-free, no allocation, no system call.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/guard/guard.h"

namespace stylet::hal {

// Aligned as the word it fills: of less, Clang asks a library that may lock.
struct alignas(std::uint64_t) LatchedFault {
  Fault fault = Fault::kNone;
  std::uint32_t number = 0;  // of all that this guard has latched, from 1; 0: none

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

// The loop, at the end of every tick.
inline void exchange_mail(FaultMailbox& mailbox, GuardState& guard) {
  if (guard.mode != GuardMode::kFading) {
    const LatchedFault seen = mailbox.seen.exchange({}, std::memory_order_relaxed);
    if (seen.number != 0 && seen == latched_fault(guard)) (void)guard_rearm(guard, seen.fault);
  }
  mailbox.latched.store(latched_fault(guard), std::memory_order_relaxed);
}

}  // namespace stylet::hal
