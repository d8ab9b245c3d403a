// SPDX-License-Identifier: Apache-2.0
// The command that makes a scene's organ: the line `# organ: stylet-organ ...` of the scene's file,
// where `{data}` is the folder of the meshes and `{scenes}` the scene's own folder.
#pragma once

#include <string>

#include "hal/scene/scene.h"

namespace stylet::app {

// The command as a shell takes it; `organ` is the file that it makes. Empty: the scene has none.
std::string organ_command(const hal::Scene& scene, const std::string& organ);

}  // namespace stylet::app
