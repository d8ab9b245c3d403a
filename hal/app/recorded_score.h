// SPDX-License-Identifier: Apache-2.0
// The score of a recorded attempt, computed from its records: the same as at the attempt's end.
#pragma once

#include <span>

#include "hal/record/recording.h"
#include "hal/score/score.h"

namespace stylet::app {

hal::Score score_of(const hal::RecordingReader& recording, std::span<const hal::Target> targets);

}  // namespace stylet::app
