// SPDX-License-Identifier: Apache-2.0
#include "hal/record/replay_device.h"

#include <algorithm>

namespace stylet::hal {
namespace {

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  ReplayDevice& replay = *static_cast<ReplayDevice*>(self);
  if (replay.next == replay.samples.size()) return false;
  const ReplayedSample& played = replay.samples[replay.next++];
  if (!played.answered) return false;
  sample_out = played.sample;
  sample_out.t_ns = now_ns;
  return true;
}

void write(void* /*self*/, const Command& /*command*/) {}
void close(void* /*self*/) {}

}  // namespace

std::vector<ReplayedSample> read_samples(const RecordingReader& recording, std::uint32_t needle) {
  constexpr std::uint64_t kBlock = 4096;
  std::vector<ReplayedSample> samples;
  std::vector<TickRecord> block;
  for (std::uint64_t first = 0; first < recording.ticks(); first += block.size()) {
    block.resize(std::min(kBlock, recording.ticks() - first));
    recording.read(first, block, needle);
    for (const TickRecord& record : block) {
      samples.push_back({record.sample, record.answered != 0});
    }
  }
  return samples;
}

Device replay_device(ReplayDevice& replay, const DeviceInfo& info) {
  return {&replay, info, read, write, close};
}

}  // namespace stylet::hal
