// SPDX-License-Identifier: Apache-2.0
// Threads that help the loop with the tissue step of a large organ (kernel.h: set_team, help).
//
// They have the loop's priority and a processor each. While a tick lasts they look for a part to
// do; then they sleep until the next grid point, which the loop leaves in LoopState::next_ns.
//
// Promises: same bits with any number of them; nothing in the loop but that one store; memory is
// allocated and touched before the loop. In virtual time they do not sleep, only yield.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

#include "hal/loop/host.h"
#include "hal/loop/loop.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct HelperConfig {
  std::uint32_t count = 0;
  bool real_time = false;  // else virtual time: no rights are asked for
  std::vector<int> cpus;   // real time: a processor for each
  int priority = 80;
};

class Helpers {
 public:
  // The kernel's team is set when this returns; rights that were refused go to `report`.
  Helpers(Kernel& kernel, const HelperConfig& config, const LoopState& loop, HostReport& report);
  // Ends the threads and the team. The loop must have ended.
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  // Parts of the step that they have done.
  std::uint64_t parts() const { return parts_.load(); }

 private:
  void work(const HelperConfig& config, std::uint32_t index, HostReport& report);
  void end();

  struct Aligned {
    void operator()(std::byte* block) const;
  };
  Kernel& kernel_;
  const LoopState& loop_;
  std::unique_ptr<std::byte, Aligned> memory_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> parts_{0};
  std::latch ready_;
  std::vector<std::thread> threads_;
};

}  // namespace stylet::hal
