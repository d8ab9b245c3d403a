// SPDX-License-Identifier: GPL-3.0-or-later
// What CGAL's alpha wrap does with the triangles that it found. Only for wrap.cpp, which compiles
// slowly enough without it.
#pragma once

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include "meshes/cgal_surface.h"

namespace stylet::offline {

using SurfacePoints = boost::property_map<CgalSurface, CGAL::vertex_point_t>::type;
using NoOptions = CGAL::parameters::Default_named_parameters;
using SurfaceOptions =
    decltype(CGAL::parameters::vertex_point_map(std::declval<const SurfacePoints&>()));

}  // namespace stylet::offline

namespace CGAL::Polygon_mesh_processing {

extern template bool is_polygon_soup_a_polygon_mesh(const stylet::offline::SoupTriangles&);
extern template void polygon_soup_to_polygon_mesh(const stylet::offline::SoupPoints&,
                                                  const stylet::offline::SoupTriangles&,
                                                  stylet::offline::CgalSurface&,
                                                  const stylet::offline::NoOptions&,
                                                  const stylet::offline::SurfaceOptions&);
extern template void orient_to_bound_a_volume(stylet::offline::CgalSurface&,
                                              const stylet::offline::SurfaceOptions&);

}  // namespace CGAL::Polygon_mesh_processing
