// SPDX-License-Identifier: Apache-2.0
// What is known only by doing: the rights this machine grants, how late it wakes a thread that asks
// for every period, and how long a body takes in that thread.
//
// Promises: measures in a thread of its own, prepared as the loop's is. Between the first cycle and
// the last it allocates nothing and calls only the clock, the body and, outside the timed part,
// the body's `rest`. A missed period is counted and skipped, as in the loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "hal/doctor/doctor.h"
#include "hal/loop/host.h"
#include "hal/loop/loop.h"

namespace stylet::hal {

// Asks for what the loop needs, in a thread of its own. `host` must come from prepare_process, and
// keeps what it was granted. `cpu_out`: where the loop would run; `cpu` is as for prepare_thread.
Trials try_rights(const HostState& host, int cpu, int priority, int& cpu_out);

// `run` is done in each period; `rest` as well, but is not timed. Both may be empty.
struct Body {
  std::function<void()> run;
  std::function<void()> rest;
};

struct MeasureConfig {
  int cpu = 0;
  int priority = 80;
  std::int64_t period_ns = 1'000'000;
  std::uint64_t cycles = 0;
  bool load_others = false;  // meanwhile the other processors copy memory and call the kernel
};

struct Spread {
  Histogram histogram;
  std::int64_t min_ns = 0;
  double mean_ns = 0;
};

struct Measured {
  Spread wake_up, body;
  std::uint64_t cycles = 0, missed = 0;
  ThreadUse use = {};
  HostReport host;  // what was refused to the thread
};

// `progress` counts the cycles and may be null; `stop` ends the measurement early.
void measure(const MeasureConfig& config, const Body& body, std::atomic<std::uint64_t>* progress,
             const std::atomic<bool>& stop, Measured& measured_out);

}  // namespace stylet::hal
