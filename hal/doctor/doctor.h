// SPDX-License-Identifier: Apache-2.0
// Whether a machine is fit for the loop, from what Linux says of itself.
//
// Promises: only reads, and only below `root`, so that captured trees of /proc and /sys are
// examined like the machine itself. What cannot be read is kUnknown, never kOk. Each finding names
// what was seen, where, and the remedy. May allocate; never called from the loop. Source of what is
// good: the Linux kernel's documentation (core-api/real-time, admin-guide).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylet::hal {

// kInfo: worth knowing, neither good nor bad.
enum class Verdict { kOk, kInfo, kWarn, kFail, kUnknown };
const char* verdict_name(Verdict verdict);

struct Finding {
  std::string name;
  Verdict verdict = Verdict::kUnknown;
  Verdict severity = Verdict::kWarn;  // the worst this check can say: kInfo, kWarn or kFail
  std::string value;                  // what was seen
  std::string source;                 // where
  std::string remedy;                 // empty where there is nothing to do
};

enum class Fitness { kReady, kDegraded, kUnfit };
const char* fitness_name(Fitness fitness);
// Unfit with any kFail; degraded with any kWarn, or kUnknown of a check that could have warned.
Fitness fitness(std::span<const Finding> findings);

// What only an attempt shows. `why`: of a refusal.
struct Attempt {
  bool granted = false;
  std::string why;
};
struct Attempts {
  Attempt fifo, lock, awake;  // priority, mlockall, /dev/cpu_dma_latency
  std::int64_t clock_resolution_ns = 0;
  Attempt device_fifo;           // priority of threads that talk to devices
  std::optional<bool> watchdog;  // of a Force Dimension device; nothing: none could be asked
};

struct Patient {
  std::string root = "/";
  int cpu = 0;  // that the loop runs on
  int priority = 80;
  std::optional<Attempts> attempts;  // none: a captured tree, where limits must tell
};

std::vector<Finding> examine(const Patient& patient);

// What disturbs a processor shows in counters that must not move while nothing is asked of it.
struct Disturbances {
  std::map<std::string, std::uint64_t> interrupts;  // on the loop's processor, but its own timer's
  std::optional<std::uint64_t> system_management;   // interrupts that Linux does not see
  std::optional<std::uint64_t> throttled;           // because it was too hot
};
Disturbances count_disturbances(const Patient& patient);
std::vector<Finding> compare_disturbances(const Patient& patient, const Disturbances& before,
                                          const Disturbances& after, double seconds);

}  // namespace stylet::hal
