// SPDX-License-Identifier: Apache-2.0
// Is a configuration within its limits? Source of the limits: limits.h, and below where a limit is
// of one field alone. Not in a tick.
#pragma once

#include "stylet/kernel.h"

namespace stylet {

// kConfigValueOutOfRange: the first field outside is told.
Status check_config(const Config& config, ConfigRefusal* refusal_out);

// Values that do not matter are made the same, so that equal configurations have equal bytes.
Config canonical(Config config);
ObstacleConfig canonical(ObstacleConfig config);

}  // namespace stylet
