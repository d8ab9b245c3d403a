// SPDX-License-Identifier: Apache-2.0
// The organ of a scene, and the command that makes it: the line `# organ: stylet-organ ...` of the
// scene's file, where `{data}` is the folder of the meshes and `{scenes}` the scene's own folder.
//
// The organs of Stylet's own scenes are made on first use, except the liver phantom, which is
// installed with this program (toolchain/cmake/stylet_phantom.cmake). The scenes' folder belongs to
// the system, so organs are kept where the XDG Base Directory Specification puts files that can be
// made again: $XDG_CACHE_HOME/stylet/organs, else ~/.cache/stylet/organs.
#pragma once

#include <string>

#include "hal/scene/scene.h"

namespace stylet::app {

// Whether a scene's text says how its organ is made.
bool has_organ_command(const std::string& scene_text);

// The file of the organ that the scene names. Makes it if it is not there and the scene comes with
// Stylet; else, and where stylet-organ is missing, throws SceneError with the command that does.
std::string organ_of_scene(const hal::Scene& scene);

}  // namespace stylet::app
