// SPDX-License-Identifier: Apache-2.0
#include "hal/publish/metrics.h"

#include <fmt/format.h>

#include <algorithm>

namespace stylet::hal {
namespace {

static_assert(static_cast<std::size_t>(Fault::kEnergy) + 1 == kFaults, "a fault has no counter");

void add(MetricDurations& durations, std::uint32_t ns) {
  const auto fits = [ns](std::uint32_t edge_us) { return ns <= std::uint64_t{1000} * edge_us; };
  const auto edge = std::find_if(kMetricEdgesUs.begin(), kMetricEdgesUs.end(), fits);
  ++durations.count[static_cast<std::size_t>(edge - kMetricEdgesUs.begin())];
  durations.sum_ns += ns;
}

// Keeps printable ASCII, escaped as the format wants: other bytes might not be UTF-8.
std::string label(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\' || c == '"') safe += '\\';
    safe += c >= ' ' && c <= '~' ? c : '?';
  }
  return safe;
}

std::string head(const char* name, const char* type, const char* help) {
  return fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
}

std::string counter(const char* name, const char* help, std::uint64_t value) {
  return head(name, "counter", help) + fmt::format("{} {}\n", name, value);
}

std::string gauge(const char* name, const char* help, double value) {
  return head(name, "gauge", help) + fmt::format("{} {:.9g}\n", name, value);
}

std::string histogram(const char* name, const char* help, const MetricDurations& durations) {
  std::string text = head(name, "histogram", help);
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < durations.count.size(); ++i) {
    below += durations.count[i];
    const bool last = i == kMetricEdgesUs.size();
    const std::string edge = last ? "+Inf" : fmt::format("{:g}", kMetricEdgesUs[i] * 1e-6);
    text += fmt::format("{}_bucket{{le=\"{}\"}} {}\n", name, edge, below);
  }
  return text + fmt::format("{0}_sum {1:.9f}\n{0}_count {2}\n", name,
                            static_cast<double>(durations.sum_ns) * 1e-9, below);
}

// Lists each fault of each needle from the start: a series that appears late hides its first step.
std::string faults(const Metrics& metrics) {
  std::string total = head("stylet_guard_faults_total", "counter", "Faults latched by the guard.");
  std::string now = head("stylet_guard_faulted", "gauge", "1 while the guard holds a fault.");
  for (std::size_t needle = 0; needle < std::min(metrics.needles, kMaxNeedles); ++needle) {
    for (std::size_t fault = 1; fault < kFaults; ++fault) {
      total +=
          fmt::format("stylet_guard_faults_total{{needle=\"{}\",fault=\"{}\"}} {}\n", needle,
                      label(fault_name(static_cast<Fault>(fault))), metrics.faults[needle][fault]);
    }
    now += fmt::format("stylet_guard_faulted{{needle=\"{}\"}} {}\n", needle,
                       metrics.fault[needle] == Fault::kNone ? 0 : 1);
  }
  return total + now;
}

}  // namespace

void metrics_add(MetricNumbers& metrics, const TickRecord& record) {
  if (record.needle >= kMaxNeedles) return;
  Fault& latched = metrics.fault[record.needle];
  const auto number = static_cast<std::size_t>(record.fault);
  if (record.fault != latched && number < kFaults) ++metrics.faults[record.needle][number];
  latched = record.fault;
  if (record.needle != 0) return;
  ++metrics.ticks;
  add(metrics.tick_time, record.tick_ns);
  add(metrics.lateness, record.late_ns);
}

std::string metrics_text(const Metrics& m) {
  std::string text = head("stylet_info", "gauge", "What is running.") +
                     fmt::format("stylet_info{{version=\"{}\",scene=\"{}\"}} 1\n", label(m.version),
                                 label(m.scene));
  text += gauge("stylet_running", "1 while the loop ticks.", m.running ? 1 : 0);
  text += gauge("stylet_period_seconds", "Time from tick to tick.", m.period_s);
  text += counter("stylet_attempts_total", "Runs begun.", m.attempts);
  text += counter("stylet_ticks_total", "Ticks done.", m.ticks);
  text += counter("stylet_missed_ticks_total", "Periods that the loop missed.", m.missed_ticks);
  text += histogram("stylet_tick_duration_seconds",
                    "Time from reading the device until its force is written.", m.tick_time);
  text += histogram("stylet_wakeup_lateness_seconds", "How late the loop wakes up.", m.lateness);
  text += faults(m);
  text += counter("stylet_lost_records_total", "Ticks that did not fit into the recorder's queue.",
                  m.lost_records);
  text += counter("stylet_lost_events_total", "Events that did not fit into the recorder's queue.",
                  m.lost_events);
  text += counter("stylet_console_lost_frames_total",
                  "Frames that pages of the console were too slow for.", m.lost_frames);
  return text + gauge("stylet_console_connections", "Connections open, this one among them.",
                      m.connections);
}

}  // namespace stylet::hal
