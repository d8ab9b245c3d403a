// SPDX-License-Identifier: Apache-2.0
// A device that repeats what another one sent: the samples of a recording, bit for bit. It is
// silent where that one was silent, and after the end. It feels no force.
// Promise: the samples are in memory before the loop starts.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/device/device.h"
#include "hal/record/recording.h"

namespace stylet::hal {

struct ReplayedSample {
  Sample sample;
  bool answered;
};

struct ReplayDevice {
  std::vector<ReplayedSample> samples;
  std::size_t next = 0;
};

std::vector<ReplayedSample> read_samples(const RecordingReader& recording,
                                         std::uint32_t needle = 0);
// `replay` must outlive the device. Each sample has the time of the tick in which it is played.
Device replay_device(ReplayDevice& replay, const DeviceInfo& info);

}  // namespace stylet::hal
