// SPDX-License-Identifier: Apache-2.0
// The things in a scene: the needle, what it cannot enter, and the targets that it shall reach.
// Needles by name, and what they have of their own: hal/base/needles.h.
#pragma once

#include <array>
#include <vector>

#include "hal/scene/section.h"
#include "stylet/kernel.h"

namespace stylet::hal {

// The caller must end with needle.finish(), because other tables may lie in this one.
NeedleConfig read_needle(Section& needle);
// A rotation by angles about the world's x, then y, then z.
Quat turned(const std::array<double, 3>& degrees);
// `scene_file`: hull file names are relative to its folder. Adds the files read to `hulls_out`.
std::vector<ObstacleConfig> read_obstacles(std::vector<Section> sections,
                                           const std::string& scene_file,
                                           std::vector<std::string>& hulls_out);
std::vector<Target> read_targets(std::vector<Section> sections);
BreathingConfig read_breathing(Section breathing);
// What acts now, less what acted when the organ's shape was taken.
Vec3 read_gravity(Section gravity);

}  // namespace stylet::hal
