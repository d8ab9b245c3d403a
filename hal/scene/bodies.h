// SPDX-License-Identifier: Apache-2.0
// The bodies in a scene: the needle, obstacles that it cannot enter, and targets that it is to
// reach. The needles by name, with their dimensions: hal/base/needles.h.
#pragma once

#include <array>
#include <vector>

#include "hal/scene/section.h"
#include "stylet/kernel.h"

namespace stylet::hal {

// Reads [needle]. The caller then calls needle.finish(), because this table may contain others.
NeedleConfig read_needle(Section& needle);
// A rotation by angles about the world's x, then y, then z.
Quat turned(const std::array<double, 3>& degrees);
// `scene_file`: hull file names are relative to its folder. Adds the files read to `hulls_out`.
std::vector<ObstacleConfig> read_obstacles(std::vector<Section> sections,
                                           const std::string& scene_file,
                                           std::vector<std::string>& hulls_out);
std::vector<Target> read_targets(std::vector<Section> sections);
BreathingConfig read_breathing(Section breathing);
// The gravity that acts now, less the gravity that acted when the organ's shape was taken.
Vec3 read_gravity(Section gravity);

}  // namespace stylet::hal
