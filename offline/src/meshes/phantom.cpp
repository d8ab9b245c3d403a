// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "meshes/implicit_mesh.h"

namespace stylet::offline {
namespace {

double ellipsoid(Vec p, Vec centre, Vec radii) {
  const Vec from = p - centre;
  const Vec once{from.x / radii.x, from.y / radii.y, from.z / radii.z};
  const Vec twice{once.x / radii.x, once.y / radii.y, once.z / radii.z};
  const double slope = length(twice);
  const double level = length(once);
  return slope > 0 ? level * (level - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

// The smaller of two distances; smoothed if they differ by less than `width`.
double blend(double a, double b, double width) {
  const double closeness = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - closeness * closeness * width / 4;
}

// `p` and the result are in millimetres.
double liver_shape(Vec p) {
  const double right = ellipsoid(p, {0, -30, 0}, {58, 58, 66});
  const double left = ellipsoid(p, {-10, 40, 14}, {36, 52, 30});
  const double gallbladder = ellipsoid(p, {-14, 2, -46}, {22, 16, 30});
  return -blend(-blend(right, left, 30), gallbladder, 8);
}

}  // namespace

Mesh block_phantom(Vec size_m, double facet_m) {
  std::array<std::uint32_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells[axis] =
        static_cast<std::uint32_t>(std::clamp(std::round(size_m[axis] / facet_m), 1.0, 500.0));
  }
  Mesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  const auto point = [&](std::array<std::uint32_t, 3> at) {
    const auto [entry, is_new] = known.try_emplace(at, mesh.points.size());
    if (is_new) {
      mesh.points.push_back({size_m.x * at[0] / cells[0],
                             size_m.y * at[1] / cells[1] - size_m.y / 2,
                             size_m.z * at[2] / cells[2] - size_m.z / 2});
    }
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far_side : {false, true}) {
      for (std::uint32_t i = 0; i < cells[u]; ++i) {
        for (std::uint32_t j = 0; j < cells[v]; ++j) {
          const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
            std::array<std::uint32_t, 3> at{};
            at[axis] = far_side ? cells[axis] : 0;
            at[u] = i + du;
            at[v] = j + dv;
            return point(at);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                              d = corner(0, 1);
          mesh.triangles.push_back(far_side ? Triangle{a, b, c} : Triangle{a, c, b});
          mesh.triangles.push_back(far_side ? Triangle{a, c, d} : Triangle{a, d, c});
        }
      }
    }
  }
  return mesh;
}

Mesh ball_phantom(double diameter_m, double facet_m) {
  const double radius = diameter_m / 2;
  const auto sphere = [radius](Vec p) { return length(p) - radius; };
  constexpr double kToleranceOfRadius = 0.0025;  // flat facets lose three times that in volume
  return implicit_mesh(sphere, {}, radius * 1.2, facet_m, radius * kToleranceOfRadius);
}

Mesh liver_phantom(double facet_m) {
  constexpr double kMmPerMetre = 1e3;
  constexpr double kToleranceMm = 0.2;
  Mesh mesh = implicit_mesh(liver_shape, {0, -20, 0}, 150, facet_m * kMmPerMetre, kToleranceMm);
  for (Vec& p : mesh.points) p = p * (1 / kMmPerMetre);
  return mesh;
}

}  // namespace stylet::offline
