// SPDX-License-Identifier: Apache-2.0
// Threads that help the loop with the tissue step of a large organ (kernel.h: set_team, help).
//
// They have the loop's priority and one processor each. During a tick they look for parts to do;
// then they sleep until the next grid point, which the loop leaves in LoopState::next_ns.
//
// Promises: the same bits with any number of helpers; the loop does nothing for them but that one
// store; memory is allocated and touched before the loop. In virtual time they yield, never sleep.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "hal/base/countdown.h"
#include "hal/loop/host.h"
#include "hal/loop/loop.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct HelperConfig {
  std::uint32_t count = 0;
  bool real_time = false;  // false: virtual time, no rights are asked for
  std::vector<int> cpus;   // in real time: one processor for each
  int priority = 80;
};

class Helpers {
 public:
  // Sets the kernel's team before it returns; refused rights are written to `report`.
  Helpers(Kernel& kernel, const HelperConfig& config, const LoopState& loop, HostReport& report);
  // Ends the threads and the team. The loop must have ended before.
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  // How many parts of the step the helpers have done.
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
  Countdown ready_;
  std::vector<std::thread> threads_;
};

}  // namespace stylet::hal
