// SPDX-License-Identifier: Apache-2.0
// The servo loop: one tick a period, from the devices' poses to the devices' forces. Each needle
// has one device, with its own frame, guard and coupling.
//
// Promises, from the first tick to the last: no allocation, lock or log; no system calls but
// clock_gettime, clock_nanosleep and those of the device itself. A late tick is counted and the
// loop goes on at the next grid point; it never runs ticks back to back to catch up. The kernel
// sees only inputs, never the clock: missed ticks change no bit of what it computes. Units: SI,
// times in ns. Frames: the device's outside, the world's inside.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "hal/base/channel.h"
#include "hal/base/clock.h"
#include "hal/base/histogram.h"
#include "hal/device/device.h"
#include "hal/guard/fault_mailbox.h"
#include "hal/guard/guard.h"
#include "hal/loop/coupling.h"
#include "hal/loop/display.h"
#include "hal/loop/grip.h"
#include "hal/loop/mapping.h"
#include "hal/loop/record.h"
#include "hal/loop/steady.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct Outlets {
  Ring<TickRecord>* records = nullptr;  // may be null
  Ring<Event>* events = nullptr;
  Display* display = nullptr;
  bool wait_for_room = false;                  // virtual time only: wait instead of losing a record
  SharedLatest<NewestTick>* newest = nullptr;  // published with the display
};

struct HandConfig {
  Mapping mapping;
  GuardConfig guard;
  CouplingConfig coupling;
  GripConfig grip = {};
  float max_torque_nm = 0;  // 0: the device renders none
  bool scripted = false;    // the device plays a script: it is left alone while the loop is paused
};

struct LoopConfig {
  std::int64_t period_ns = 1'000'000;
  std::uint64_t ticks = 0;
  std::uint32_t hash_every_ticks = 0;     // 0: never
  std::uint32_t display_every_ticks = 1;  // the last tick of a run is always published
  bool lets_go = true;  // the force fades at the end; false: another run takes it over
  std::array<HandConfig, kMaxNeedles> hand;
};

struct HandState {
  GuardState guard = guard_start();
  GuardState torque_guard = guard_start();  // the same rules for a torque: N m instead of N
  GripState grip = {};
  Sample sample = {};
  Pose handle = {};  // of the device, the last usable one, in the world
  bool have_handle = false;
  SteadyState steady;
  CouplingState coupling;
  Output output = {};  // of the last tick
};

// All that the loop changes, except the kernel. It is large: keep it off the stack.
struct LoopState {
  std::atomic<bool> stop{false};         // set by another thread or a signal: end after this tick
  std::atomic<std::int64_t> next_ns{0};  // when the next or present tick begins; used by helpers
  // Set by another thread: devices are read and guarded, but their force fades to zero as with the
  // clutch, and the kernel does not move. Paused ticks are not recorded.
  std::atomic<bool> paused{false};
  // Set by another thread: nobody takes records from their ring any more, so virtual time does not
  // wait for room in it.
  std::atomic<bool> unread{false};
  std::array<HandState, kMaxNeedles> hand;
  std::array<FaultMailbox, kMaxNeedles> mailbox;  // one for each hand
  std::uint32_t events_seen = 0;
  std::uint64_t ticks = 0;
  // Only the loop writes these; other threads may read them while it runs.
  std::atomic<std::uint64_t> missed_ticks{0};  // grid points skipped
  std::atomic<std::uint64_t> lost_records{0};
  std::atomic<std::uint64_t> lost_events{0};
  Histogram tick_time;  // from reading the device to writing the force
  Histogram lateness;   // of waking up
};

// Device i holds needle i; there must be as many devices as the kernel has needles.
void run_loop(const LoopConfig& config, Kernel& kernel, std::span<const Device> devices,
              const Clock& clock, const Outlets& outlets, LoopState& state);

}  // namespace stylet::hal
