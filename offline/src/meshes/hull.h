// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a mesh into an obstacle: its convex hull, with few enough vertices for the kernel, as TOML
// text that a scene includes.
//
// Promises: the vertices are points of the mesh, so the obstacle lies within its convex hull; it
// falls short of the hull by at most `deviation_m`, the largest distance of a left-out vertex of
// the hull from the obstacle. The same mesh gives the same text. Units: metres. Source: greedy
// choice of the farthest vertex; CGAL's convex_hull_3 (quickhull).
#pragma once

#include <string>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

constexpr std::size_t kLeastHullVertices = 4;

struct Hull {
  std::vector<Vec> vertices_m;
  std::size_t hull_vertices = 0;  // number of vertices of the whole convex hull
  double deviation_m = 0;
  double volume_m3 = 0;
};

// `name` is for messages. Refuses points that span no volume.
Hull simple_hull(const std::string& name, const std::vector<Vec>& points_m,
                 std::size_t most_vertices);

// Volume of the convex hull; 0 if the points span no volume.
double hull_volume_m3(const std::vector<Vec>& points_m);

// The faces as planes with outward normals: inside is where dot(normal, place) <= limit for all.
struct HullPlane {
  Vec normal;
  double limit = 0;
};
std::vector<HullPlane> hull_planes(const Hull& hull);

// The hull as a mesh for display.
Mesh hull_mesh(const Hull& hull);

std::string hull_toml(const Hull& hull, const std::string& source, const std::string& sha256);

}  // namespace stylet::offline
