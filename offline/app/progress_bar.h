// SPDX-License-Identifier: GPL-3.0-or-later
// A bar on standard error with the stage and the time left in it, only where that is a terminal and
// only once a second has passed.
#pragma once

#include "base/progress.h"

namespace stylet::bake {

// The bar wipes itself when the last copy of the returned function goes.
Progress progress_bar();

}  // namespace stylet::bake
