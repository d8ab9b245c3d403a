// SPDX-License-Identifier: Apache-2.0
// A kernel with the memory it asked for.
// Promise: LoadError is one line with place, value and what was expected. Before the loop only.
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

// Blocks of exactly the predicted size, every page of them touched, and the kernel in them.
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

// Same state from the same start: ticks a fresh kernel at `handles` to warm caches and pages,
// resets it, and throws LoadError if the state's hash is not what it was.
void warm_up(Kernel& kernel, std::span<const Input> handles, int ticks);

}  // namespace stylet::hal
