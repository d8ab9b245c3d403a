// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sample_cell.h"

namespace stylet::offline {
namespace {

constexpr std::uint32_t kSamples = 64;

// The axes, face diagonals and space diagonals of a cube, each turned a little, so that rays do not
// run along faces with these directions, which are common in meshes.
constexpr std::array<Vec, 13> kRays{
    Vec{1, 0.0131, 0.0173},  Vec{0.0151, 1, 0.0127},  Vec{0.0119, 0.0163, 1},
    Vec{1, 1.0137, 0.0149},  Vec{1, -1.0113, 0.0171}, Vec{1, 0.0141, 1.0157},
    Vec{1, 0.0129, -1.0167}, Vec{0.0147, 1, 1.0133},  Vec{0.0153, 1, -1.0121},
    Vec{1, 1.0143, 1.0161},  Vec{1, 1.0123, -1.0159}, Vec{1, -1.0139, 1.0117},
    Vec{-1, 1.0109, 1.0169}};

// Change of the winding number on the way from `from` to `to` due to one triangle; `sure` becomes
// false if rounding could decide.
int winding_step(const std::array<Vec, 3>& c, Vec from, Vec to, bool& sure) {
  const Vec way = to - from;
  const Vec edge_1 = c[1] - c[0], edge_2 = c[2] - c[0];
  const Vec normal = cross(edge_1, edge_2);
  const double size = length(normal);
  const double along = dot(way, normal);
  const double start = dot(c[0] - from, normal);
  constexpr double kRounding = 1e-9;
  const double slack = kRounding * size;
  // The way lies wholly on one side of the triangle's plane.
  if ((start > slack && start - along > slack) || (start < -slack && start - along < -slack)) {
    return 0;
  }
  if (std::abs(start) <= slack || std::abs(start - along) <= slack) {
    sure = false;
    return 0;
  }
  const Vec p = cross(way, edge_2), q = cross(from - c[0], edge_1);
  const double u = -dot(from - c[0], p) / along, v = -dot(way, q) / along;
  const double inner = std::min({u, v, 1 - u - v});
  if (std::abs(inner) <= kRounding) sure = false;
  return inner < 0 ? 0 : along > 0 ? -1 : 1;  // a way along the outward normal leads out
}

}  // namespace

// 64 points of a rank-1 lattice: along each axis they have 64 different, evenly spread coordinates.
// So a face parallel to the grid is located to 1/64, too; a 4 x 4 x 4 grid would give only 1/4.
Vec sample_point(std::uint32_t i) {
  constexpr std::uint32_t kStepY = 5, kStepZ = 19, kCount = 64;
  return Vec{i + 0.5, (i * kStepY) % kCount + 0.5, (i * kStepZ) % kCount + 0.5} * (1.0 / kCount);
}

bool is_inside(const InsideTest& test, Vec point) {
  if (test.by_winding) return winding_number(test.tree, point) > 0.5;
  std::size_t votes = 0;
  for (const Vec& ray : kRays) votes += crossings(test.tree, point, ray) % 2 != 0 ? 1 : 0;
  return votes > kRays.size() / 2;
}

double odd_rays(const TriangleTree& tree, Vec point) {
  int odd = 0;
  for (const Vec& ray : kRays) {
    odd += crossings(tree, point, ray) % 2 + crossings(tree, point, ray * -1) % 2;
  }
  return odd / (2.0 * kRays.size());
}

std::uint64_t sample_cell(const InsideTest& test, Vec low_corner) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    if (is_inside(test, low_corner + sample_point(i))) bits |= std::uint64_t{1} << i;
  }
  return bits;
}

std::uint64_t sample_cell(const InsideTest& test, Vec low_corner,
                          std::span<const std::array<Vec, 3>> near) {
  const Vec start = low_corner + sample_point(0);
  const double winding = winding_number(test.tree, start);
  const int at_start = static_cast<int>(std::lround(winding));
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Vec point = low_corner + sample_point(i);
    int here = at_start;
    bool sure = std::abs(winding - at_start) < 0.25;
    for (std::size_t t = 0; t < near.size() && sure; ++t) {
      here += winding_step(near[t], start, point, sure);
    }
    if (sure ? here > 0 : is_inside(test, point)) bits |= std::uint64_t{1} << i;
  }
  return bits;
}

}  // namespace stylet::offline
