// SPDX-License-Identifier: Apache-2.0
// What the handles of stylet.h are. A handle holds what it needs: a simulation its organ, a loop
// and a batch their simulations, each by a count of its users.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>

#include "stylet/kernel.h"
#include "stylet/stylet.h"

struct stylet_organ {
  struct Aligned {
    void operator()(std::byte* block) const {
      ::operator delete (block, std::align_val_t{stylet::kBlockAlignment});
    }
  };
  using Block = std::unique_ptr<std::byte, Aligned>;

  std::atomic<std::uint32_t> users{1};
  Block bytes;
  stylet::Organ organ;
};

struct stylet_simulation {
  std::atomic<std::uint32_t> users{1};
  stylet_organ* organ = nullptr;
  stylet::Kernel kernel;
  stylet::Config config;
  std::uint32_t obstacle_count = 0;
  std::array<stylet::ObstacleConfig, stylet::kMaxObstacles> obstacle;
  stylet_organ::Block team;
  void* own_memory = nullptr;  // null: the caller's
  std::atomic<bool> in_loop{false};
};

namespace stylet::c {

// Null if there is not as much memory.
stylet_organ::Block make_block(std::size_t bytes);
// Of a direction of any length; -z of what has none.
Vec3 unit(stylet_vec3 direction);
stylet_organ* keep(const stylet_organ* organ);
stylet_simulation* keep(stylet_simulation* simulation);

}  // namespace stylet::c
