// SPDX-License-Identifier: GPL-3.0-or-later
// The last resort for a triangle soup that encloses nothing: a closed skin around it (CGAL alpha
// wrapping, Portaneri et al. 2022). It bridges gaps up to `gap` and adds volume by its `offset`.
#pragma once

#include "base/geometry.h"

namespace stylet::offline {

Mesh alpha_wrap(const Mesh& mesh, double gap, double offset);

}  // namespace stylet::offline
