// SPDX-License-Identifier: Apache-2.0
// The numbers in the metrics. metrics_test.py checks the format of the text: it reads what
// Metrics.Sample prints with Prometheus' own parser.
#include "hal/publish/metrics.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

namespace stylet::hal {
namespace {

TickRecord tick(std::uint32_t tick_us, std::uint32_t late_us, Fault fault = Fault::kNone,
                std::uint32_t needle = 0) {
  TickRecord record = {};
  record.tick_ns = tick_us * 1000;
  record.late_ns = late_us * 1000;
  record.fault = fault;
  record.needle = needle;
  return record;
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Metrics, TicksAndTheirTimes) {
  Metrics metrics;
  metrics.needles = 2;
  metrics_add(metrics, tick(10, 1));  // on an edge: it counts in the bucket that ends there
  metrics_add(metrics, tick(11, 1));
  metrics_add(metrics, tick(480, 30));
  metrics_add(metrics, tick(480, 30, Fault::kNone, 1));  // the same tick of another needle
  metrics_add(metrics, tick(4'000'000, 0));
  const std::string text = metrics_text(metrics);
  EXPECT_TRUE(has_line(text, "stylet_ticks_total 4"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"1e-05\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"2e-05\"} 2"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"0.0004\"} 2"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"0.0005\"} 3"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"0.1\"} 3"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_bucket{le=\"+Inf\"} 4"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_sum 4.000501000"));
  EXPECT_TRUE(has_line(text, "stylet_tick_duration_seconds_count 4"));
  EXPECT_TRUE(has_line(text, "stylet_wakeup_lateness_seconds_bucket{le=\"5e-05\"} 4"));
}

TEST(Metrics, FaultsCountWhenTheyLatch) {
  Metrics metrics;
  metrics.needles = 2;
  for (int i = 0; i < 3; ++i) metrics_add(metrics, tick(1, 1, Fault::kBuzz, 1));
  metrics_add(metrics, tick(1, 1, Fault::kNone, 1));
  metrics_add(metrics, tick(1, 1, Fault::kBuzz, 1));
  metrics_add(metrics, tick(1, 1, Fault::kTooFast, 1));
  metrics_add(metrics, tick(1, 1, static_cast<Fault>(4000), 0));  // of a damaged recording
  const std::string text = metrics_text(metrics), name = "stylet_guard_faults_total";
  EXPECT_TRUE(has_line(text, name + "{needle=\"1\",fault=\"" + fault_name(Fault::kBuzz) + "\"} 2"));
  EXPECT_TRUE(
      has_line(text, name + "{needle=\"1\",fault=\"" + fault_name(Fault::kTooFast) + "\"} 1"));
  EXPECT_TRUE(has_line(text, name + "{needle=\"0\",fault=\"" + fault_name(Fault::kBuzz) + "\"} 0"));
  EXPECT_TRUE(has_line(text, "stylet_guard_faulted{needle=\"1\"} 1"));
  EXPECT_EQ(text.find("needle=\"2\""), std::string::npos);
}

// A scene's name may contain any characters.
TEST(Metrics, Sample) {
  Metrics metrics;
  metrics.version = "0.1.0";
  metrics.scene = "a\"b\\c\nd} 1\n# TYPE \xff \t.toml";
  metrics.period_s = 1e-3;
  metrics.needles = 40;  // more than possible
  metrics.ticks = std::numeric_limits<std::uint64_t>::max() - 3;
  metrics.connections = 3;
  for (std::uint32_t us = 0; us < 2000; us += 7) metrics_add(metrics, tick(us, us / 20));
  const std::string text = metrics_text(metrics);
  EXPECT_TRUE(has_line(text,
                       "stylet_info{version=\"0.1.0\",scene=\"a\\\"b\\\\c?d} 1?# TYPE ? "
                       "?.toml\"} 1"));
  EXPECT_TRUE(has_line(text, "stylet_console_connections 3"));
  EXPECT_TRUE(has_line(text, "stylet_period_seconds 0.001"));
  std::printf("<<<\n%s>>>\n", text.c_str());
}

}  // namespace
}  // namespace stylet::hal
