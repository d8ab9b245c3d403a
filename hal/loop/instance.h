// SPDX-License-Identifier: Apache-2.0
// A kernel together with the memory it needs.
// Promise: LoadError is one line with place, value and what was expected. Use before the loop only.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>

#include "stylet/kernel.h"

namespace stylet::hal {

struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Memory of exactly the predicted size, with every page touched, and the kernel in it.
class KernelInstance {
 public:
  KernelInstance(const Organ& organ, const Config& config,
                 std::span<const ObstacleConfig> obstacles = {});
  KernelInstance(const KernelInstance&) = delete;
  KernelInstance& operator=(const KernelInstance&) = delete;

  Kernel kernel;
  Sizes predicted = {};

 private:
  struct Aligned {
    void operator()(std::byte* block) const;
  };
  using Block = std::unique_ptr<std::byte, Aligned>;
  static Block touched_block(std::size_t bytes);
  Block model_, state_, scratch_;
};

// Warms caches and pages, and leaves the same state: ticks a fresh kernel at `handles`, resets it,
// and throws LoadError if the hash of its state has changed.
void warm_up(Kernel& kernel, std::span<const Input> handles, int ticks);

}  // namespace stylet::hal
