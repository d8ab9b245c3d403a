// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/wrap.h"

#include <CGAL/alpha_wrap_3.h>

#include "meshes/cgal_surface.h"

namespace stylet::offline {

Mesh alpha_wrap(const Mesh& mesh, double gap, double offset) {
  CgalSurface wrapped;
  CGAL::alpha_wrap_3(cgal_points(mesh), mesh.triangles, gap, offset, wrapped);
  return mesh_of(wrapped);
}

}  // namespace stylet::offline
