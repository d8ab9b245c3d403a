// SPDX-License-Identifier: GPL-3.0-or-later
// A hull as text, apart from the hull itself: CGAL and the library of JSON in one file compile too
// slowly.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "meshes/hull.h"

namespace stylet::offline {

std::string hull_toml(const Hull& hull, const std::string& source, const std::string& sha256) {
  std::string text = fmt::format(
      "# Made by stylet-organ hull: {} of the {} vertices of a convex hull.\n"
      "source = {}\nsha256 = \"{}\"\ndeviation_mm = {:.4f}\nvertices_m = [\n",
      hull.vertices_m.size(), hull.hull_vertices, nlohmann::json(source).dump(), sha256,
      hull.deviation_m * 1e3);
  for (const Vec& v : hull.vertices_m) {
    text += fmt::format("  [{:.7f}, {:.7f}, {:.7f}],\n", v.x, v.y, v.z);
  }
  return text + "]\n";
}

}  // namespace stylet::offline
