// SPDX-License-Identifier: Apache-2.0
// A recording's inputs through a new kernel: the same bits, or the first field that differs.
// Promise: compares bits, not values (NaN equals NaN, -0 differs from 0); virtual time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "hal/record/organ_file.h"
#include "hal/record/recording.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct ReplayResult {
  bool same = false;
  std::uint64_t ticks = 0;  // replayed
  std::uint64_t state_hash = 0;
  // Where not the same:
  std::uint64_t tick = 0;  // first that differs, counted from 1 as Output::tick
  std::string field;       // place in the recording
  std::string recorded, replayed;
};

// `kernel` must be fresh, of the recording's organ and config. `progress` gets the ticks done.
ReplayResult replay(const RecordingReader& recording, Kernel& kernel,
                    const std::function<void(std::uint64_t)>& progress = {});

// The organ file to replay with: `given`, else the recorded path, else the same file name next to
// the recording. Throws LoadError if none is there.
std::string find_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                                const std::string& given);

// That file, loaded. Throws LoadError if it is another organ than the recorded one.
OrganFile load_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                              const std::string& given);

}  // namespace stylet::hal
