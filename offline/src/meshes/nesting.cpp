// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/nesting.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "base/refusal.h"

namespace stylet::offline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Corners::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Not parallel to edges, faces or diagonals that are common in meshes.
constexpr std::array<Vec, 3> kDirections{Vec{0.7931, 0.3127, 0.5227}, Vec{-0.4271, 0.8377, 0.3407},
                                         Vec{0.2903, -0.5519, 0.7817}};

struct Faces {
  Corners corners;
  std::vector<std::array<Vec, 3>> corners_of;
  std::vector<std::uint32_t> piece;  // of each face
};

Faces faces_of(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
               const std::vector<ClosedPiece>& pieces) {
  const auto at = [&](std::uint32_t i) {
    return Kernel::Point_3(points[i].x, points[i].y, points[i].z);
  };
  Faces faces;
  for (std::uint32_t piece = 0; piece < pieces.size(); ++piece) {
    for (const std::uint32_t i : pieces[piece].triangles) {
      const Triangle& t = triangles[i];
      faces.corners.emplace_back(at(t[0]), at(t[1]), at(t[2]));
      faces.corners_of.push_back({points[t[0]], points[t[1]], points[t[2]]});
      faces.piece.push_back(piece);
    }
  }
  return faces;
}

Vec farthest_along(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
                   const ClosedPiece& piece, Vec direction) {
  Vec best = points[triangles[piece.triangles.front()][0]];
  for (const std::uint32_t i : piece.triangles) {
    for (const std::uint32_t corner : triangles[i]) {
      if (dot(points[corner], direction) > dot(best, direction)) best = points[corner];
    }
  }
  return best;
}

// Skips faces that the ray certainly misses, or meets only behind another, before CGAL computes
// exactly: the boxes of thousands of nested pieces all lie in one place.
class Filter {
 public:
  Filter(const Faces& faces, Vec from, Vec direction, std::uint32_t piece, std::size_t& tests)
      : faces_(faces), from_(from), direction_(direction), piece_(piece), tests_(tests) {}

  bool skips(std::size_t face) {
    if (++tests_ > kMostTests) {
      refuse("more than {} faces of closed pieces lie one in another: expected a simpler surface",
             kMostTests);
    }
    if (faces_.piece[face] == piece_) return true;
    const auto& [a, b, c] = faces_.corners_of[face];
    const Vec edge_1 = b - a, edge_2 = c - a, p = cross(direction_, edge_2);
    const double determinant = dot(edge_1, p);
    if (std::abs(determinant) <= kRounding * length(edge_1) * length(edge_2)) return false;
    const Vec away = from_ - a, q = cross(away, edge_1);
    const double u = dot(away, p) / determinant, v = dot(direction_, q) / determinant;
    const double inner = std::min({u, v, 1 - u - v});
    const double along = dot(edge_2, q) / determinant;
    if (inner < -kRounding || along < -kRounding * length(edge_1) ||
        along > nearest_ * (1 + kRounding)) {
      return true;
    }
    if (inner > kRounding) nearest_ = along;
    return false;
  }

 private:
  // Takes about a minute. Organs need some dozens of tests per piece and direction.
  static constexpr std::size_t kMostTests = 100'000'000;
  static constexpr double kRounding = 1e-9;
  const Faces& faces_;
  Vec from_, direction_;
  std::uint32_t piece_;
  std::size_t& tests_;
  double nearest_ = std::numeric_limits<double>::infinity();
};

// The first face that a ray meets. Faces of the ray's own piece do not count.
std::optional<std::size_t> first_face(const Tree& tree, const Faces& faces, Vec from, Vec direction,
                                      std::uint32_t piece, std::size_t& tests) {
  const Kernel::Ray_3 ray(Kernel::Point_3(from.x, from.y, from.z),
                          Kernel::Vector_3(direction.x, direction.y, direction.z));
  Filter filter(faces, from, direction, piece, tests);
  const auto number = [&](const Primitive::Id& id) {
    return static_cast<std::size_t>(id - faces.corners.cbegin());
  };
  const auto hit = tree.first_intersected_primitive(
      ray, [&](const Primitive::Id& id) { return filter.skips(number(id)); });
  if (!hit) return std::nullopt;
  return number(*hit);
}

std::vector<std::uint32_t> around_along(const std::vector<Vec>& points,
                                        const std::vector<Triangle>& triangles,
                                        const std::vector<ClosedPiece>& pieces, const Tree& tree,
                                        const Faces& faces, Vec direction) {
  std::vector<Vec> start;
  for (const ClosedPiece& piece : pieces) {
    start.push_back(farthest_along(points, triangles, piece, direction));
  }
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater<>{},
                           [&](std::uint32_t i) { return dot(start[i], direction); });
  // A piece that is met reaches farther, comes earlier in `order`, and so has its result already.
  std::vector<std::uint32_t> around(pieces.size(), kNoPiece);
  std::size_t tests = 0;
  for (const std::uint32_t i : order) {
    const std::optional<std::size_t> face = first_face(tree, faces, start[i], direction, i, tests);
    if (!face) continue;
    const std::uint32_t met = faces.piece[*face];
    const auto& [a, b, c] = faces.corners_of[*face];
    const double through = dot(cross(b - a, c - a), direction);
    const bool from_inside = (through > 0) == (pieces[met].volume > 0);
    around[i] = from_inside ? met : around[met];
  }
  return around;
}

}  // namespace

std::vector<std::uint32_t> pieces_around(const std::vector<Vec>& points,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<ClosedPiece>& pieces) {
  const Faces faces = faces_of(points, triangles, pieces);
  Tree tree(faces.corners.cbegin(), faces.corners.cend());
  std::array<std::vector<std::uint32_t>, kDirections.size()> votes;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    votes[i] = around_along(points, triangles, pieces, tree, faces, kDirections[i]);
  }
  std::vector<std::uint32_t> around(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    around[i] = votes[1][i] == votes[2][i] ? votes[1][i] : votes[0][i];
    const bool smaller =
        around[i] != kNoPiece && std::abs(pieces[around[i]].volume) > std::abs(pieces[i].volume);
    if (!smaller) around[i] = kNoPiece;
  }
  return around;
}

}  // namespace stylet::offline
