// SPDX-License-Identifier: Apache-2.0
// Between a loop and whoever looks after it: the fault that is latched, and the one that somebody
// has seen.
//
// Any thread may write `seen` and read `latched`. The loop takes `seen` once the force has faded,
// and rearms if it names the fault and the device answers; if not, it is forgotten and to be asked
// for again, so that nothing comes back long after somebody wanted it.
// Promises: wait-free, no allocation, no system call.
#pragma once

#include <atomic>

#include "stylet/hal/guard.h"

namespace stylet::hal {

struct FaultMailbox {
  std::atomic<Fault> latched{Fault::kNone};  // the loop writes it
  std::atomic<Fault> seen{Fault::kNone};     // the loop takes it
};
static_assert(std::atomic<Fault>::is_always_lock_free);

// The loop, at the end of every tick.
inline void exchange_mail(FaultMailbox& mailbox, GuardState& guard) {
  if (guard.mode != GuardMode::kFading) {
    const Fault seen = mailbox.seen.exchange(Fault::kNone, std::memory_order_relaxed);
    if (seen != Fault::kNone) (void)guard_rearm(guard, seen);
  }
  mailbox.latched.store(guard.fault, std::memory_order_relaxed);
}

}  // namespace stylet::hal
