// SPDX-License-Identifier: GPL-3.0-or-later
// The files written beside an organ built from a label map: the hulls of its obstacles, and a scene
// with these hulls and the targets.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/outputs.h"
#include "pipeline/build.h"

namespace stylet::offline {

// Adds these files to `outputs` and returns the facts about them; null if there are none.
nlohmann::ordered_json add_scene(Outputs& outputs, const Built& built,
                                 const std::filesystem::path& organ);

// What add_scene returned, as lines for the terminal.
std::string scene_text(const nlohmann::ordered_json& scene);

}  // namespace stylet::offline
