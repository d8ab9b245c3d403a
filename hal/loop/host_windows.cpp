// SPDX-License-Identifier: Apache-2.0
// On Windows: asks for what the system grants. Windows promises no thread any time, and the report
// always says so.
#include <fmt/format.h>
#include <windows.h>

#include <algorithm>

#include "hal/base/thread_rights.h"
#include "hal/loop/host.h"
#include "hal/loop/stack.h"

namespace stylet::hal {
namespace {

// Windows keeps at least so much of this process in memory.
constexpr SIZE_T kLeastPages = SIZE_T{256} << 20U;

std::vector<int> allowed_cpus() {
  DWORD_PTR own = 0, all = 0;
  std::vector<int> cpus;
  if (GetProcessAffinityMask(GetCurrentProcess(), &own, &all) == 0) return {0};
  for (int cpu = 0; cpu < 64; ++cpu) {
    if ((own >> static_cast<unsigned>(cpu) & 1U) != 0) cpus.push_back(cpu);
  }
  return cpus;
}

}  // namespace

HostState::~HostState() = default;

void prepare_process(HostState& host) {
  if (SetProcessWorkingSetSize(GetCurrentProcess(), kLeastPages, 4 * kLeastPages) != 0) return;
  host.report.lacks.push_back(fmt::format("memory cannot be kept from being paged out ({})",
                                          why_refused(static_cast<int>(GetLastError()))));
}

std::vector<int> loop_processors(int cpu) {
  std::vector<int> chosen, others = allowed_cpus();
  if (cpu >= 0) chosen.push_back(cpu);
  std::reverse(others.begin(), others.end());
  for (const int each : others) {
    if (each != cpu) chosen.push_back(each);
  }
  return chosen;
}

void prepare_thread(int cpu, int priority, HostReport& report) {
  const int chosen = loop_processors(cpu).at(0);
  report.lacks.emplace_back(
      "Windows promises no time: a tick may come late at any priority; use Linux with PREEMPT_RT "
      "where no tick may be late");
  if (const int error = stay_on(chosen); error != 0) {
    report.lacks.push_back(
        fmt::format("thread cannot be pinned to processor {} ({})", chosen, why_refused(error)));
  }
  if (const int error = rise_to(priority); error != 0) {
    report.lacks.push_back(fmt::format("time-critical priority refused ({})", why_refused(error)));
  }
  touch_stack();
}

ThreadUse thread_use() {
  return {};
}

}  // namespace stylet::hal
