// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/instance.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <new>

#include "hal/base/input_file.h"
#include "stylet/content_sum.h"

namespace stylet::hal {

OrganFile load_organ(const std::string& path) {
  constexpr const char* kExpected = "expected an organ file, as stylet-organ makes them";
  if (const std::string why = why_unreadable(path); !why.empty()) {
    throw LoadError(fmt::format("{}: {}: {}", path, why, kExpected));
  }
  OrganFile file;
  file.path = path;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0 || size == std::numeric_limits<std::streamoff>::max()) {
    throw LoadError(fmt::format("{}: is a pipe: {}", path, kExpected));
  }
  file.bytes.resize(static_cast<std::size_t>(size));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(file.bytes.data()), size)) {
    throw LoadError(fmt::format("{}: cannot be read to the end", path));
  }
  OrganRefusal refusal;
  if (const Status status = organ_open(file.bytes, file.organ, &refusal); status != Status::kOk) {
    throw LoadError(fmt::format("{}: {}[{}]: {:g}: {}: expected {}", path, refusal.place,
                                refusal.index, refusal.value, status_name(status),
                                refusal.expected));
  }
  if (!has_its_bytes(file.bytes, file.organ)) {
    throw LoadError(fmt::format(
        "{}: content_sha256: not that of its bytes: expected the file as stylet-organ wrote it",
        path));
  }
  return file;
}

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
  Status status = sizes(organ, config, predicted);
  if (status == Status::kOk) {
    try {
      model_ = touched_block(predicted.model_bytes);
      state_ = touched_block(predicted.state_bytes);
      scratch_ = touched_block(predicted.scratch_bytes);
    } catch (const std::bad_alloc&) {
      const double bytes = static_cast<double>(predicted.model_bytes) +
                           static_cast<double>(predicted.state_bytes) +
                           static_cast<double>(predicted.scratch_bytes);
      throw LoadError(
          fmt::format("organ \"{}\": {} voxels need {:.0f} MB: expected as much memory here",
                      organ.name, organ.voxel_count, 1e-6 * bytes));
    }
    status = create(organ, config,
                    {{model_.get(), predicted.model_bytes},
                     {state_.get(), predicted.state_bytes},
                     {scratch_.get(), predicted.scratch_bytes}},
                    kernel);
  }
  if (status == Status::kOk) status = set_obstacles(kernel, obstacles);
  if (status != Status::kOk) {
    throw LoadError(fmt::format("organ \"{}\": {} voxels: kernel cannot be made: {}", organ.name,
                                organ.voxel_count, status_name(status)));
  }
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
