// SPDX-License-Identifier: Apache-2.0
// Tests whether a configuration is within its limits. The limits are in limits.h, or in config.cpp
// if only one field has them. Not called in a tick.
#pragma once

#include "stylet/kernel.h"

namespace stylet {

// kConfigValueOutOfRange: `refusal_out` names the first field outside its limits.
Status check_config(const Config& config, ConfigRefusal* refusal_out);

// Values that do not matter are made the same, so that equal configurations have equal bytes.
Config canonical(Config config);
ObstacleConfig canonical(ObstacleConfig config);

}  // namespace stylet
