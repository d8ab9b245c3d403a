// SPDX-License-Identifier: GPL-3.0-or-later
// A bar on standard error that shows the stage and the time left in it; only if standard error is
// a terminal, and only after one second has passed.
#pragma once

#include "base/progress.h"

namespace stylet::offline {

// The bar is wiped when the last copy of the returned function is destroyed.
Progress progress_bar();

}  // namespace stylet::offline
