// SPDX-License-Identifier: GPL-3.0-or-later
// A long stage calls this to report its progress: its name and a fraction from 0 to 1. Called at
// most a few hundred times per stage, from the thread that does the work.
#pragma once

#include <functional>

namespace stylet::offline {

using Progress = std::function<void(const char* stage, double fraction)>;

}  // namespace stylet::offline
