// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/instance.h"

#include <fmt/format.h>

#include <cstring>
#include <new>

namespace stylet::hal {

void KernelInstance::Aligned::operator()(std::byte* block) const {
  ::operator delete (block, std::align_val_t{kBlockAlignment});
}

KernelInstance::Block KernelInstance::touched_block(std::size_t bytes) {
  auto* block = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kBlockAlignment}));
  std::memset(block, 0, bytes);
  return Block(block);
}

KernelInstance::KernelInstance(const Organ& organ, const Config& config,
                               std::span<const ObstacleConfig> obstacles) {
  ConfigRefusal why;
  Status status = sizes(organ, config, predicted, &why);
  if (status == Status::kOk) {
    try {
      model_ = touched_block(predicted.model_bytes);
      state_ = touched_block(predicted.state_bytes);
      scratch_ = touched_block(predicted.scratch_bytes);
    } catch (const std::bad_alloc&) {
      const double bytes = static_cast<double>(predicted.model_bytes) +
                           static_cast<double>(predicted.state_bytes) +
                           static_cast<double>(predicted.scratch_bytes);
      throw LoadError(fmt::format(
          "organ \"{}\": {} voxels need {:.0f} MB: expected so much free memory on this machine",
          organ.name, organ.voxel_count, 1e-6 * bytes));
    }
    status = create(organ, config,
                    {{model_.get(), predicted.model_bytes},
                     {state_.get(), predicted.state_bytes},
                     {scratch_.get(), predicted.scratch_bytes}},
                    kernel);
  }
  if (status == Status::kOk) status = set_obstacles(kernel, obstacles, &why);
  if (status == Status::kOk) return;
  if (why.field[0] != '\0') {
    throw LoadError(fmt::format("{} [{}]: {:g}: expected {:g} to {:g}", why.field, why.index,
                                why.value, why.least, why.most));
  }
  throw LoadError(fmt::format("organ \"{}\": {} voxels: the kernel cannot be created: {}",
                              organ.name, organ.voxel_count, status_name(status)));
}

void warm_up(Kernel& kernel, std::span<const Input> handles, int ticks) {
  const std::uint64_t before = hash(kernel);
  for (int i = 0; i < ticks; ++i) tick(kernel, handles, {});
  reset(kernel);
  const std::uint64_t after = hash(kernel);
  if (after != before) {
    throw LoadError(
        fmt::format("warm-up: state hash {:016x} after reset: expected {:016x}", after, before));
  }
}

}  // namespace stylet::hal
