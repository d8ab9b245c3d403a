// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/holes.h"

#include <map>

namespace stylet::offline {
namespace {

using Way = std::vector<std::uint32_t>;  // corners of a hole, each once

// The border: from each corner, the corners to which more triangles run than come back from there,
// each as often as the difference.
std::map<std::uint32_t, Way> border_of(const std::vector<Triangle>& triangles) {
  std::map<std::array<std::uint32_t, 2>, int> net;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      net[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::map<std::uint32_t, Way> border;
  for (const auto& [edge, count] : net) {
    Way& to = border[count > 0 ? edge[0] : edge[1]];
    to.insert(to.end(), static_cast<std::size_t>(std::abs(count)), count > 0 ? edge[1] : edge[0]);
  }
  return border;
}

// As many edges of a border lead to a corner as away from it. So a walk along it can only end at a
// corner where it was before, and the part between the two visits is a hole.
std::vector<Way> closed_ways(std::map<std::uint32_t, Way> border) {
  std::vector<Way> ways;
  for (auto& [start, to] : border) {
    Way path;
    std::map<std::uint32_t, std::size_t> place;  // in the path
    for (std::uint32_t at = start; !path.empty() || !to.empty();) {
      if (const auto seen = place.find(at); seen != place.end()) {
        const auto first = path.begin() + static_cast<std::ptrdiff_t>(seen->second);
        ways.emplace_back(first, path.end());
        for (auto each = first; each != path.end(); ++each) place.erase(*each);
        path.erase(first, path.end());
        if (path.empty() && to.empty()) break;
      }
      place[at] = path.size();
      path.push_back(at);
      Way& next = border.at(at);
      at = next.back();
      next.pop_back();
    }
  }
  return ways;
}

Vec middle_of(const std::vector<Vec>& points, const Way& way) {
  Vec sum;
  for (const std::uint32_t corner : way) sum = sum + points[corner];
  return sum * (1.0 / static_cast<double>(way.size()));
}

double farthest(const std::vector<Vec>& points, const Way& way, Vec from, Vec& where_out) {
  double most = 0;
  for (const std::uint32_t corner : way) {
    const double away = length(points[corner] - from);
    if (away <= most) continue;
    most = away;
    where_out = points[corner];
  }
  return most;
}

}  // namespace

Patched patch_holes(const Solid& solid) {
  Patched patched{{solid.surface.points, solid.boundary}, {}};
  Mesh& mesh = patched.mesh;
  for (const Way& way : closed_ways(border_of(solid.boundary))) {
    Hole hole{middle_of(mesh.points, way), 0};
    Vec corner = hole.middle, opposite;
    farthest(mesh.points, way, hole.middle, corner);
    hole.across = farthest(mesh.points, way, corner, opposite);
    patched.holes.push_back(hole);
    const auto centre = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(hole.middle);
    for (std::size_t i = 0; i < way.size(); ++i) {
      mesh.triangles.push_back({way[(i + 1) % way.size()], way[i], centre});
    }
  }
  std::stable_sort(patched.holes.begin(), patched.holes.end(),
                   [](const Hole& a, const Hole& b) { return a.across > b.across; });
  return patched;
}

}  // namespace stylet::offline
