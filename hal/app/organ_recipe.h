// SPDX-License-Identifier: Apache-2.0
// The command that makes the organ of a scene: the line `# organ: stylet-organ ...` of its file,
// in which `{data}` is the folder of the meshes and `{scenes}` the scene's own.
#pragma once

#include <string>

#include "hal/scene/scene.h"

namespace stylet::app {

// As a shell takes it; `organ` is the file that it makes. Empty: the scene does not say.
std::string organ_command(const hal::Scene& scene, const std::string& organ);

}  // namespace stylet::app
