// SPDX-License-Identifier: Apache-2.0
// The embedded surface: where it is now, and where the needle first meets it.
//
// The sphere tree stays at rest. Every vertex is a convex combination of corner displacements, so
// no point of the surface is farther from its rest place than the largest displacement of any
// particle. The query is enlarged by that much, and the tree never changes. Only triangles of the
// leaves reached are deformed, nearest to the tip first. This replaces refitting leaf spheres per
// voxel: it needs no work per leaf and is exact for tissue at rest, the usual state at first
// contact. Where another needle dents the tissue, a query visits more leaves.
//
// Promises: at most kMaxTreeVisits nodes and kMaxTriangleTests triangles. Units SI. Frame of the
// attachments. PHYSICS 7.1.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// kSideways: only on the tip's way of this tick. kUnknown: a bound was reached before anything was
// found; kFlagContactBudget is then set, and the tip must not go on.
enum class Contact : std::uint32_t { kNone, kFound, kSideways, kUnknown };

// Length of the front part of a needle that is searched for the surface.
float contact_reach_m(const Model& model);

// Looks for the surface along the front part of the needle that ends here, `reach_m` long, then
// along the tip's way in this tick, `step_m`. If found: gives the rest and present place of the
// crossing nearest the tip.
Contact find_contact(const Model& model, State& state, Vec3 tip_m, Vec3 direction, float reach_m,
                     Vec3 step_m, Vec3& rest_out_m, Vec3& place_out_m, std::uint32_t& flags_out);

}  // namespace stylet
