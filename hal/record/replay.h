// SPDX-License-Identifier: Apache-2.0
// Feeds a recording's inputs to a new kernel: gives the same bits, or tells the first field that
// differs. Promise: compares bits, not values (NaN equals NaN, -0 differs from 0); virtual time.
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
  std::uint64_t ticks = 0;  // number of ticks replayed
  std::uint64_t state_hash = 0;
  // If not the same:
  std::uint64_t tick = 0;  // the first that differs, counted from 1 as Output::tick
  std::string field;       // its path in the recording
  std::string recorded, replayed;
};

// `kernel` must be new, with the recording's organ and config. `progress` gets the ticks done.
ReplayResult replay(const RecordingReader& recording, Kernel& kernel,
                    const std::function<void(std::uint64_t)>& progress = {});

// The organ file for a replay: `given`, else the recorded path, else a file of that name next to
// the recording. Throws LoadError if there is none.
std::string find_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                                const std::string& given);

// Loads that file. Throws LoadError if its organ is not the recorded one.
OrganFile load_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                              const std::string& given);

}  // namespace stylet::hal
