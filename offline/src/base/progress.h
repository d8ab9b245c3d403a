// SPDX-License-Identifier: GPL-3.0-or-later
// How a long stage tells how far it is: its name and a fraction 0..1. Called at most a few hundred
// times per stage, from the thread that does the work.
#pragma once

#include <functional>

namespace stylet::bake {

using Progress = std::function<void(const char* stage, double fraction)>;

}  // namespace stylet::bake
