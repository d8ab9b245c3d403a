// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/host.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hal/base/host_tree.h"
#include "hal/base/thread_rights.h"
#include "hal/loop/stack.h"

namespace stylet::hal {
namespace {

void lock_memory(HostReport& report) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return;
  report.lacks.push_back(fmt::format(
      "memory cannot be locked ({}): run as root, or put \"@realtime - memlock unlimited\" into "
      "/etc/security/limits.conf and your user into the group realtime",
      why_refused(errno)));
}

void stay_awake(HostState& host) {
  constexpr const char* kPath = "/dev/cpu_dma_latency";
  const std::int32_t latency_us = 0;
  host.latency_fd = open(kPath, O_WRONLY | O_CLOEXEC);
  if (host.latency_fd < 0 && errno == ENOENT) {
    host.report.notes.push_back(
        fmt::format("{} is not there: deep sleep of the processor stays on", kPath));
  } else if (host.latency_fd < 0 ||
             write(host.latency_fd, &latency_us, sizeof latency_us) != sizeof latency_us) {
    host.report.lacks.push_back(fmt::format(
        "{} cannot be written ({}): run as root, or give your user the right to it by a udev rule",
        kPath, why_refused(errno)));
  }
}

void check_kernel(HostReport& report) {
  utsname system{};
  uname(&system);
  if (std::strstr(system.version, "PREEMPT_RT") != nullptr) return;
  report.notes.push_back(
      fmt::format("Linux {} has no PREEMPT_RT: wake-ups may be late; install linux-image-rt-amd64",
                  system.release));
}

std::vector<int> allowed_cpus() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  std::vector<int> cpus;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(cpu, &allowed)) cpus.push_back(cpu);
  }
  return cpus;
}

}  // namespace

HostState::~HostState() {
  if (latency_fd >= 0) close(latency_fd);
}

void prepare_process(HostState& host) {
  check_kernel(host.report);
  lock_memory(host.report);
  stay_awake(host);
}

// The loop may use an isolated processor, although only threads that ask for it run there.
std::vector<int> loop_processors(int cpu) {
  std::vector<int> chosen;
  const auto take = [&chosen](int each) {
    if (each >= 0 && std::find(chosen.begin(), chosen.end(), each) == chosen.end()) {
      chosen.push_back(each);
    }
  };
  take(cpu);
  const auto isolated = read_text({""}, "/sys/devices/system/cpu/isolated");
  const std::vector<int> apart = parse_cpu_list(isolated.value_or("")), others = allowed_cpus();
  std::for_each(apart.rbegin(), apart.rend(), take);
  std::for_each(others.rbegin(), others.rend(), take);
  return chosen;
}

void prepare_thread(int cpu, int priority, HostReport& report) {
  const int chosen = loop_processors(cpu).at(0);
  if (const int error = stay_on(chosen); error != 0) {
    report.lacks.push_back(fmt::format(
        "thread cannot be pinned to processor {} ({}): set loop.cpu to one this process may use",
        chosen, why_refused(error)));
  }
  if (const int error = rise_to(priority); error != 0) {
    report.lacks.push_back(fmt::format(
        "SCHED_FIFO priority {} refused ({}): run as root, or put \"@realtime - rtprio 90\" into "
        "/etc/security/limits.conf and your user into the group realtime",
        priority, why_refused(error)));
  }
  touch_stack();
}

ThreadUse thread_use() {
  rusage use{};
  getrusage(RUSAGE_THREAD, &use);
  return {use.ru_minflt, use.ru_majflt, use.ru_nvcsw, use.ru_nivcsw};
}

}  // namespace stylet::hal
