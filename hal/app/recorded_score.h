// SPDX-License-Identifier: Apache-2.0
// What a recorded attempt came to: the score that was told when it ended, from its records.
#pragma once

#include <span>

#include "hal/record/recording.h"
#include "hal/score/score.h"

namespace stylet::app {

hal::Score score_of(const hal::RecordingReader& recording, std::span<const hal::Target> targets);

}  // namespace stylet::app
