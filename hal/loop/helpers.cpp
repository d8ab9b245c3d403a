// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/helpers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>

#include "hal/base/contained.h"

namespace stylet::hal {
namespace {

constexpr std::uint32_t kLooks = 200;                 // about 8 us
constexpr std::int64_t kLeadNs = 30'000;              // wakes this much before the loop
constexpr std::int64_t kLongestSleepNs = 10'000'000;  // so that an ended loop is noticed

std::byte* touched_block(std::size_t bytes) {
  auto* block = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kBlockAlignment}));
  std::memset(block, 0, bytes);
  return block;
}

// Sleeps if the next tick is far away; returns whether it did.
bool sleep_until_tick(std::int64_t next_ns) {
  const std::int64_t now_ns = monotonic_now_ns();
  if (next_ns - kLeadNs <= now_ns) return false;
  const Clock clock = monotonic_clock();
  clock.sleep_until_ns(clock.self, std::min(next_ns - kLeadNs, now_ns + kLongestSleepNs));
  return true;
}

}  // namespace

void Helpers::Aligned::operator()(std::byte* block) const {
  ::operator delete (block, std::align_val_t{kBlockAlignment});
}

Helpers::Helpers(Kernel& kernel, const HelperConfig& config, const LoopState& loop,
                 HostReport& report)
    : kernel_(kernel), loop_(loop), ready_(config.count) {
  const std::size_t bytes = team_bytes(kernel, config.count);
  memory_.reset(touched_block(bytes));
  if (const Status status = set_team(kernel, config.count, {memory_.get(), bytes});
      status != Status::kOk) {
    throw std::invalid_argument(
        fmt::format("{} helper threads: {}", config.count, status_name(status)));
  }
  std::vector<HostReport> reports(config.count);
  threads_.reserve(config.count);
  try {
    for (std::uint32_t i = 0; i < config.count; ++i) {
      threads_.emplace_back([this, &config, i, &own = reports[i]] { work(config, i, own); });
    }
  } catch (...) {
    end();
    throw;
  }
  ready_.wait();  // the threads use neither `config` nor `reports` later
  for (std::uint32_t i = 0; i < config.count; ++i) {
    for (const std::string& lack : reports[i].lacks) {
      report.lacks.push_back(fmt::format("helper thread {}: {}", i + 1, lack));
    }
  }
}

Helpers::~Helpers() {
  end();
}

void Helpers::end() {
  stop_.store(true);
  for (std::thread& thread : threads_) thread.join();
  (void)set_team(kernel_, 0, {});
}

void Helpers::work(const HelperConfig& config, std::uint32_t index, HostReport& report) {
  const bool real_time = config.real_time;
  name_thread("stylet-helper");
  const bool prepared = !real_time || contained("helper thread", [&] {
    prepare_thread(config.cpus[index], config.priority, report);
  });
  ready_.count_down();
  // A thread without its rights would hold up the loop.
  while (prepared && !stop_.load(std::memory_order_relaxed)) {
    if (real_time && sleep_until_tick(loop_.next_ns.load(std::memory_order_relaxed))) continue;
    if (help(kernel_, kLooks)) {
      parts_.fetch_add(1, std::memory_order_relaxed);
    } else if (!real_time) {
      std::this_thread::yield();  // there may be fewer processors than threads
    }
  }
}

}  // namespace stylet::hal
