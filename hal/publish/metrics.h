// SPDX-License-Identifier: Apache-2.0
// The loop in numbers for Prometheus: its text format 0.0.4, made from plain counters.
//
// The server of these numbers fills a MetricNumbers, mostly tick by tick with metrics_add, and
// gives it, with the names, to metrics_text. Names end in their unit, counters in _total; times are
// in seconds. Promises: metrics_add allocates nothing; metrics_text is a pure function whose result
// obeys the format whatever a label contains. Format:
// prometheus.io/docs/instrumenting/exposition_formats.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hal/loop/record.h"
#include "stylet/limits.h"

namespace stylet::hal {

constexpr const char* kMetricsContentType = "text/plain; version=0.0.4; charset=utf-8";

// Upper edges of the buckets, us, for ticks and wake-ups; the last bucket has no upper edge.
constexpr std::array<std::uint32_t, 16> kMetricEdgesUs = {
    10, 20, 50, 75, 100, 150, 200, 300, 400, 500, 750, 1000, 2000, 5000, 10'000, 100'000};
constexpr std::size_t kFaults = 9;  // number of faults in Fault

struct MetricDurations {
  std::array<std::uint64_t, kMetricEdgesUs.size() + 1> count = {};  // of each bucket alone
  std::uint64_t sum_ns = 0;
};

// Plain data, because it is passed between processes.
struct MetricNumbers {
  double period_s = 0;
  bool running = false;
  std::uint32_t needles = 1;
  std::uint64_t attempts = 0;
  std::uint64_t ticks = 0, missed_ticks = 0;
  std::uint64_t lost_records = 0, lost_events = 0;  // on the way out of the loop
  MetricDurations tick_time, lateness;
  std::array<std::array<std::uint64_t, kFaults>, kMaxNeedles> faults = {};  // latched so far
  std::array<Fault, kMaxNeedles> fault = {};                                // latched now
  std::uint32_t connections = 0;                                            // to the console, now
  std::uint64_t lost_frames = 0;  // that pages of the console were too slow for
};

struct Metrics : MetricNumbers {
  std::string version, scene;
};

// Adds ticks, their times, and faults.
void metrics_add(MetricNumbers& metrics, const TickRecord& record);
std::string metrics_text(const Metrics& metrics);

}  // namespace stylet::hal
