// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/wrap.h"

#include <CGAL/Alpha_wrap_3/internal/Alpha_wrap_3.h>

#include "meshes/soup_oracle.h"
#include "meshes/soup_surface.h"

namespace stylet::offline {
namespace {

using Wrapper = CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<SoupOracle>;

}  // namespace
}  // namespace stylet::offline

// CGAL calls this only if it is asked for a surface that need not be a manifold; we never ask.
// clang-format off
template <>
template <>
void stylet::offline::Wrapper::extract_possibly_non_manifold_surface(
    stylet::offline::CgalSurface&, stylet::offline::SurfacePoints) const { CGAL_error(); }
// clang-format on

namespace stylet::offline {

// CGAL::alpha_wrap_3 of points and triangles.
Mesh alpha_wrap(const Mesh& mesh, double gap, double offset) {
  const SoupOracle oracle(mesh, gap);
  Wrapper wrap(oracle);
  CgalSurface wrapped;
  wrap(gap, offset, wrapped);
  return mesh_of(wrapped);
}

}  // namespace stylet::offline
