// SPDX-License-Identifier: Apache-2.0
// Decides whether a machine is fit for the loop, from what Linux says of itself.
//
// Promises: only reads, and only below `root`, so captured trees of /proc and /sys can be examined
// like the machine itself. What cannot be read is kUnknown, never kOk. Each finding names what was
// seen, where, and the remedy. May allocate; never called from the loop. Source for what is good:
// the Linux kernel's documentation (core-api/real-time, admin-guide).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylet::hal {

// kInfo: worth knowing, but neither good nor bad.
enum class Verdict { kOk, kInfo, kWarn, kFail, kUnknown };
const char* verdict_name(Verdict verdict);

struct Finding {
  std::string name;
  Verdict verdict = Verdict::kUnknown;
  Verdict severity = Verdict::kWarn;  // the worst result of this check: kInfo, kWarn or kFail
  std::string value;                  // what was seen
  std::string source;                 // where it was seen
  std::string remedy;                 // empty if there is nothing to do
};

enum class Fitness { kReady, kDegraded, kUnfit };
const char* fitness_name(Fitness fitness);
// Unfit if any is kFail; degraded if any is kWarn, or kUnknown from a check that could have warned.
Fitness fitness(std::span<const Finding> findings);

// What is known only by trying. `why`: the reason of a refusal.
struct Trial {
  bool granted = false;
  std::string why;
};
struct Trials {
  Trial fifo, lock, awake;  // priority, mlockall, /dev/cpu_dma_latency
  std::int64_t clock_resolution_ns = 0;
  Trial device_fifo;             // priority of threads that talk to devices
  std::optional<bool> watchdog;  // of a Force Dimension device; nullopt: no device could be asked
};

struct Patient {
  std::string root = "/";
  int cpu = 0;  // on which the loop runs
  int priority = 80;
  std::optional<Trials> trials;  // nullopt: a captured tree, where only limits can be read
};

std::vector<Finding> examine(const Patient& patient);

// Disturbances of a processor, as counters that must not grow while nothing is asked of it.
struct Disturbances {
  std::map<std::string, std::uint64_t> interrupts;  // on the loop's processor, without its timer's
  std::optional<std::uint64_t> system_management;   // interrupts that Linux does not see
  std::optional<std::uint64_t> throttled;           // because it was too hot
};
Disturbances count_disturbances(const Patient& patient);
std::vector<Finding> compare_disturbances(const Patient& patient, const Disturbances& before,
                                          const Disturbances& after, double seconds);

}  // namespace stylet::hal
