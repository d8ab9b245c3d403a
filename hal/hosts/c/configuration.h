// SPDX-License-Identifier: Apache-2.0
// A caller's configuration, needles and obstacles, of whatever size its structs have, as the
// kernel's; what they do not say has the kernel's defaults.
#pragma once

#include <span>

#include "stylet/kernel.h"
#include "stylet/stylet.h"

namespace stylet::c {

stylet_status read_config(const stylet_config* config, const stylet_needle* needles,
                          std::uint32_t needle_count, Config& out, stylet_refusal* refusal_out);
// As many as `out` has room for.
stylet_status read_obstacles(const stylet_obstacle* obstacles, std::span<ObstacleConfig> out,
                             stylet_refusal* refusal_out);

}  // namespace stylet::c
