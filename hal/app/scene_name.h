// SPDX-License-Identifier: Apache-2.0
// The scenes that come with Stylet, which are run by their name: `stylet run lumbar-puncture`. They
// lie in share/stylet/hal/scenes beside the folder of the program, in a checkout in hal/scenes. A
// scene is a file there that says how its organ is made (organ_command.h).
#pragma once

#include <string>

namespace stylet::app {

// The file of a scene that is given by its name or as a file; a file wins. Throws SceneError with
// the names if it is neither.
std::string scene_file(const std::string& given);

// Whether it is one of Stylet's own: only their commands are run without being asked for.
bool comes_with_stylet(const std::string& scene_file);

// Prints names, each with the first sentence of its file. Returns the exit code.
int list_scenes(bool json);

// Prints the file of a scene's organ, made if the scene comes with Stylet and it is not there.
// Throws SceneError. Returns the exit code.
int tell_organ(const std::string& given);

}  // namespace stylet::app
