// SPDX-License-Identifier: Apache-2.0
#include "hal/doctor/measure.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "hal/base/clock.h"
#include "hal/base/contained.h"
#include "hal/device/devices.h"
#include "hal/device/driver_call.h"
#include "hal/device/drivers/force_dimension.h"

namespace stylet::hal {
namespace {

void add(Spread& spread, std::int64_t ns) {
  spread.min_ns = spread.histogram.total == 0 ? ns : std::min(spread.min_ns, ns);
  histogram_add(spread.histogram, ns);
  spread.mean_ns +=
      (static_cast<double>(ns) - spread.mean_ns) / static_cast<double>(spread.histogram.total);
}

void cycle(const MeasureConfig& config, const Body& body, std::atomic<std::uint64_t>* progress,
           const std::atomic<bool>& stop, Measured& out) {
  std::int64_t grid_ns = monotonic_now_ns() + config.period_ns;
  const Clock clock = monotonic_clock();
  while (out.cycles < config.cycles && !stop.load(std::memory_order_relaxed)) {
    clock.sleep_until_ns(clock.self, grid_ns);
    const std::int64_t start_ns = monotonic_now_ns();
    if (body.run) body.run();
    const std::int64_t end_ns = monotonic_now_ns();
    add(out.wake_up, start_ns - grid_ns);
    add(out.body, end_ns - start_ns);
    ++out.cycles;
    if (progress != nullptr) progress->fetch_add(1, std::memory_order_relaxed);
    const std::int64_t missed = std::max<std::int64_t>(0, (end_ns - grid_ns) / config.period_ns);
    out.missed += static_cast<std::uint64_t>(missed);
    if (body.rest) body.rest();
    // The rest may take longer than what is left of the period: the body is not to blame.
    const std::int64_t passed = std::max<std::int64_t>(0, monotonic_now_ns() - grid_ns);
    grid_ns += (1 + passed / config.period_ns) * config.period_ns;
  }
}

// Threads without priority that keep all other processors busy with memory and system calls.
class Load {
 public:
  // Call it in a thread without priority, because its children inherit that.
  explicit Load(int spared_cpu) {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    sched_getaffinity(0, sizeof allowed, &allowed);
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
      if (cpu == spared_cpu || !CPU_ISSET(cpu, &allowed)) continue;
      threads_.emplace_back([this, cpu] { (void)contained("load", [this, cpu] { work(cpu); }); });
    }
  }
  ~Load() {
    stop_.store(true);
    for (std::thread& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  void work(int cpu) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    sched_setaffinity(0, sizeof set, &set);
    constexpr std::size_t kBytes = 8U << 20U;  // more than a processor's own caches hold
    std::vector<unsigned char> from(kBytes, 1), to(kBytes);
    while (!stop_.load(std::memory_order_relaxed)) {
      std::memcpy(to.data(), from.data(), kBytes);
      from.swap(to);
      sched_yield();
    }
  }

  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

// A driver that hangs gives nullopt.
std::optional<bool> ask_for_watchdog() {
  const auto end = std::chrono::steady_clock::now() + kClosingTime;
  const auto told = call_driver<std::optional<bool>>(
      force_dimension_watchdog, [end] { return std::chrono::steady_clock::now() > end; });
  return told.value_or(std::nullopt);
}

}  // namespace

Trials try_rights(const HostState& host, int cpu, int priority, int& cpu_out) {
  const auto trial = [](bool granted, int error) {
    return Trial{granted, granted ? "" : std::strerror(error)};
  };
  Trials trials;
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  trials.lock = trial(locked, errno);
  trials.awake = trial(host.latency_fd >= 0, EACCES);
  timespec resolution{};
  if (clock_getres(CLOCK_MONOTONIC, &resolution) == 0) {
    trials.clock_resolution_ns = resolution.tv_sec * 1'000'000'000 + resolution.tv_nsec;
  }
  // A future, so that exceptions of the thread are thrown again here.
  std::async(std::launch::async, [&] {
    HostReport refused;
    prepare_thread(cpu, priority, refused);
    cpu_out = sched_getcpu();
    sched_param parameters{};
    parameters.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    trials.fifo = trial(error == 0, error);
    parameters.sched_priority = kDevicePriority;
    const int refused_above = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    trials.device_fifo = trial(refused_above == 0, refused_above);
  }).get();
  trials.watchdog = ask_for_watchdog();
  return trials;
}

void measure(const MeasureConfig& config, const Body& body, std::atomic<std::uint64_t>* progress,
             const std::atomic<bool>& stop, Measured& measured_out) {
  measured_out = {};
  const std::unique_ptr<Load> load =
      config.load_others ? std::make_unique<Load>(config.cpu) : nullptr;
  std::async(std::launch::async, [&] {
    prepare_thread(config.cpu, config.priority, measured_out.host);
    const ThreadUse before = thread_use();
    cycle(config, body, progress, stop, measured_out);
    const ThreadUse after = thread_use();
    measured_out.use = {after.minor_faults - before.minor_faults,
                        after.major_faults - before.major_faults,
                        after.voluntary_switches - before.voluntary_switches,
                        after.involuntary_switches - before.involuntary_switches};
  }).get();
}

}  // namespace stylet::hal
