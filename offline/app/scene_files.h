// SPDX-License-Identifier: GPL-3.0-or-later
// The files beside an organ of a label map: hulls of its obstacles, and a scene with them and the
// targets.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/outputs.h"
#include "pipeline/build.h"

namespace stylet::bake {

// Adds them to `outputs` and returns what there is to say of them; null where there are none.
nlohmann::ordered_json add_scene(Outputs& outputs, const Built& built,
                                 const std::filesystem::path& organ);

// Lines for the terminal of what add_scene returned.
std::string scene_text(const nlohmann::ordered_json& scene);

}  // namespace stylet::bake
