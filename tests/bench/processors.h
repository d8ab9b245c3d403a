// SPDX-License-Identifier: Apache-2.0
// Two processors for two threads, and a thread on one of them: Linux by itself may run both on one
// processor for longer than a measurement lasts.
#pragma once

#include <sched.h>

#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylet::test {

// Those this thread may run on.
inline std::vector<int> allowed_processors() {
  cpu_set_t set;
  std::vector<int> allowed;
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return allowed;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &set)) allowed.push_back(i);
  }
  return allowed;
}

// The processors of one core share its arithmetic; empty where the machine does not say.
inline std::string core_of(int processor) {
  std::ifstream file("/sys/devices/system/cpu/cpu" + std::to_string(processor) +
                     "/topology/thread_siblings_list");
  std::string core;
  std::getline(file, core);
  return core;
}

// Two of them, of different cores if there are any; none where there is only one.
inline std::optional<std::pair<int, int>> two_processors(const std::vector<int>& allowed) {
  if (allowed.size() < 2) return std::nullopt;
  const std::string core = core_of(allowed[0]);
  for (std::size_t i = 1; i < allowed.size(); ++i) {
    if (core_of(allowed[i]) != core) return std::pair(allowed[0], allowed[i]);
  }
  return std::pair(allowed[0], allowed[1]);
}

// This thread on these processors alone.
inline bool stay_on(const std::vector<int>& processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(processor, &set);
  return sched_setaffinity(0, sizeof(set), &set) == 0;
}

}  // namespace stylet::test
