// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/repair.h"

#include <numeric>
#include <tuple>

#include "base/disjoint_set.h"
#include "meshes/nesting.h"
#include "meshes/triangle_tree.h"

namespace stylet::offline {
namespace {

// Merges bit-equal points and renumbers points in the order in which triangles first use them.
void merge_points(Mesh& mesh, RepairCounts& counts) {
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Vec& p = mesh.points[i];
    return std::make_tuple(p.x, p.y, p.z, i);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first_equal(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && mesh.points[order[i]] == mesh.points[order[i - 1]];
    first_equal[order[i]] = same ? first_equal[order[i - 1]] : order[i];
    counts.points_merged += same ? 1 : 0;
  }
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  std::vector<std::uint32_t> renumbered(mesh.points.size(), kUnused);
  std::vector<Vec> points;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) {
      std::uint32_t& number = renumbered[first_equal[corner]];
      if (number == kUnused) {
        number = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh.points[corner]);
      }
      corner = number;
    }
  }
  counts.points_unused = mesh.points.size() - counts.points_merged - points.size();
  mesh.points = std::move(points);
}

bool has_area(const Mesh& mesh, const Triangle& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
  const Vec a = mesh.points[t[1]] - mesh.points[t[0]];
  const Vec b = mesh.points[t[2]] - mesh.points[t[0]];
  const Vec normal = cross(a, b);
  // Collinear points give a small area by rounding; an area below this counts as none.
  constexpr double kRounding = 1e-28;
  return dot(normal, normal) > kRounding * dot(a, a) * dot(b, b);
}

// +1 or -1: the direction in which the triangle runs through its sorted corners.
int direction(const Triangle& t) {
  const int turns = (t[0] > t[1] ? 1 : 0) + (t[1] > t[2] ? 1 : 0) + (t[0] > t[2] ? 1 : 0);
  return turns % 2 == 0 ? 1 : -1;
}

// Groups equal triangles. The first of each group stays in the surface. It is part of the boundary
// only if the copies do not cancel: as many in one direction as in the other enclose nothing.
void drop_duplicates(Mesh& mesh, std::vector<Triangle>& boundary, RepairCounts& counts) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b; });
  std::vector<int> net(mesh.triangles.size(), 0);
  std::vector<bool> first(mesh.triangles.size(), false);
  for (std::size_t i = 0; i < order.size();) {
    const std::uint32_t head = order[i];
    first[head] = true;
    for (; i < order.size() && sorted[order[i]] == sorted[head]; ++i) {
      net[head] += direction(mesh.triangles[order[i]]) * direction(mesh.triangles[head]);
    }
  }
  std::vector<Triangle> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!first[i]) continue;
    Triangle t = mesh.triangles[i];
    kept.push_back(t);
    if (net[i] < 0) std::swap(t[1], t[2]);
    if (net[i] != 0) boundary.push_back(t);
  }
  counts.duplicates = mesh.triangles.size() - kept.size();
  mesh.triangles = std::move(kept);
}

struct Edge {
  std::uint32_t low, high, triangle;
  bool forward;
};

std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(triangles.size() * 3);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangles[i][c], b = triangles[i][(c + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

// Calls visit(first, count) for every group of edges with the same two points.
template <typename Visit>
void each_edge(const std::vector<Edge>& edges, Visit visit) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high) {
      ++end;
    }
    visit(i, end - i);
    i = end;
  }
}

struct EdgeCounts {
  std::size_t border = 0, non_manifold = 0, inconsistent = 0, open = 0;
};

// Faces agree at an edge if as many run in one direction as in the other, apart from an odd one.
EdgeCounts count_edges(const std::vector<Edge>& edges) {
  EdgeCounts counts;
  each_edge(edges, [&](std::size_t first, std::size_t count) {
    int net = 0;
    for (std::size_t i = first; i < first + count; ++i) net += edges[i].forward ? 1 : -1;
    counts.border += count == 1 ? 1 : 0;
    counts.non_manifold += count > 2 ? 1 : 0;
    counts.inconsistent += std::abs(net) > static_cast<int>(count % 2) ? 1 : 0;
    counts.open += net != 0 ? 1 : 0;
  });
  return counts;
}

struct Piece {
  std::vector<std::uint32_t> triangles;
  double volume = 0;  // only of a closed piece
  bool open = false;
  bool says_sides = true;  // its faces in the file tell which side is outside
};

std::vector<Triangle> select(const std::vector<Triangle>& triangles, const Piece& piece) {
  std::vector<Triangle> own;
  for (const std::uint32_t i : piece.triangles) own.push_back(triangles[i]);
  return own;
}

// A piece is connected through edges of exactly two faces.
std::vector<Piece> find_pieces(const std::vector<Vec>& points,
                               const std::vector<Triangle>& triangles,
                               const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> parent = each_by_itself(triangles.size());
  std::vector<bool> open(triangles.size(), false);
  each_edge(edges, [&](std::size_t first, std::size_t count) {
    if (count == 2) {
      join(parent, edges[first].triangle, edges[first + 1].triangle);
    } else {
      for (std::size_t i = first; i < first + count; ++i) open[edges[i].triangle] = true;
    }
  });
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> number(triangles.size(), 0);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t root = root_of(parent, i);
    if (root == i) {
      number[i] = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    Piece& piece = pieces[number[root]];
    piece.triangles.push_back(i);
    piece.open = piece.open || open[i];
  }
  for (Piece& piece : pieces) {
    const Vec centre = points[triangles[piece.triangles.front()][0]];
    piece.volume = signed_volume(points, select(triangles, piece), centre);
  }
  return pieces;
}

void turn(std::vector<Triangle>& triangles, const Piece& piece) {
  for (const std::uint32_t i : piece.triangles) std::swap(triangles[i][1], triangles[i][2]);
}

// An open surface has no volume that tells its sides apart. But it winds around points that it half
// encloses, positively if it faces outward. `sum` is over points spread through its box; `enclosed`
// counts points with more than half a winding.
struct Evidence {
  double sum = 0;
  int enclosed = 0;
};

// Fewer points for a small piece, so that time stays linear in the triangles: a triangle soup may
// have as many pieces as triangles.
int points_per_axis(std::size_t triangles) {
  constexpr double kPointsEach = 16;
  constexpr int kLeast = 2, kMost = 12;
  const double wanted = std::ceil(std::cbrt(kPointsEach * static_cast<double>(triangles)));
  return wanted < kMost ? std::max(kLeast, static_cast<int>(wanted)) : kMost;
}

Evidence look_around(const std::vector<Vec>& points, const std::vector<Triangle>& triangles) {
  Box box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) grow(box, points[corner]);
  }
  const TriangleTree tree = triangle_tree(points, triangles);
  const int per_axis = points_per_axis(triangles.size());
  const Vec step = (box.high - box.low) * (1.0 / per_axis);
  Evidence evidence;
  for (int z = 0; z < per_axis; ++z) {
    for (int y = 0; y < per_axis; ++y) {
      for (int x = 0; x < per_axis; ++x) {
        const Vec offset{(x + 0.5) * step.x, (y + 0.5) * step.y, (z + 0.5) * step.z};
        const double winding = winding_number(tree, box.low + offset);
        evidence.sum += winding;
        evidence.enclosed += std::abs(winding) > 0.5 ? 1 : 0;
      }
    }
  }
  return evidence;
}

// Open pieces that enclose something by themselves are judged alone, as are all if faces had to be
// reoriented. The others are judged together, because their relative sides in a file whose faces
// agreed have a meaning.
void turn_open(const std::vector<Vec>& points, std::vector<Triangle>& triangles,
               const std::vector<Piece>& pieces, bool faces_agreed) {
  std::vector<Triangle> rest;
  std::vector<const Piece*> rest_pieces;
  for (const Piece& piece : pieces) {
    if (!piece.open) continue;
    const std::vector<Triangle> own = select(triangles, piece);
    const Evidence evidence = look_around(points, own);
    if (!faces_agreed || evidence.enclosed > 0) {
      if (evidence.sum < 0) turn(triangles, piece);
    } else {
      rest.insert(rest.end(), own.begin(), own.end());
      rest_pieces.push_back(&piece);
    }
  }
  if (rest.empty() || look_around(points, rest).sum >= 0) return;
  for (const Piece* piece : rest_pieces) turn(triangles, *piece);
}

// How often the open pieces wind around a closed one, which they may contain: -1, 0 or 1.
int side_of_open(const TriangleTree& open, Vec point) {
  const double winding = winding_number(open, point);
  return winding > 0.5 ? 1 : winding < -0.5 ? -1 : 0;
}

TriangleTree tree_of_open(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
                          const std::vector<Piece>& pieces) {
  std::vector<Triangle> open;
  for (const Piece& piece : pieces) {
    if (!piece.open) continue;
    for (const std::uint32_t i : piece.triangles) open.push_back(triangles[i]);
  }
  return triangle_tree(points, open);
}

std::vector<std::uint32_t> largest_first(const std::vector<ClosedPiece>& pieces) {
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return std::abs(pieces[a].volume) > std::abs(pieces[b].volume);
  });
  return order;
}

// Works from the outside in. An outer piece must face outward; if it is turned in the file, so are
// the pieces in it. A piece in tissue that faces the other way is a cavity (in any number); one
// that faces the same way is tissue in tissue. In a cavity there can only be tissue. `open` has the
// file's open pieces before they were turned.
void turn_closed(const std::vector<Vec>& points, std::vector<Triangle>& triangles,
                 const std::vector<Piece>& pieces, const TriangleTree& open) {
  std::vector<ClosedPiece> closed;
  std::vector<const Piece*> piece_of;
  for (const Piece& piece : pieces) {
    if (piece.open) continue;
    closed.push_back({piece.triangles, piece.volume});
    piece_of.push_back(&piece);
  }
  if (closed.empty()) return;
  const std::vector<std::uint32_t> around = pieces_around(points, triangles, closed);
  std::vector<int> winding(closed.size()), turned(closed.size());
  for (const std::uint32_t i : largest_first(closed)) {
    const std::uint32_t outer = around[i];
    const bool outermost = outer == kNoPiece;
    const Vec place = points[triangles[closed[i].triangles.front()][0]];
    const int by_open = outermost ? side_of_open(open, place) : 0;
    const int depth = outermost ? std::abs(by_open) : winding[outer];
    const bool all_turned =
        outermost ? by_open < 0 || (by_open == 0 && closed[i].volume < 0) : turned[outer] != 0;
    const bool outward = piece_of[i]->says_sides ? (closed[i].volume > 0) != all_turned : depth < 1;
    const bool cavity = !outward && depth > 0;
    winding[i] = depth + (cavity ? -1 : 1);
    const bool turns = (closed[i].volume < 0) != cavity;
    turned[i] = (piece_of[i]->says_sides ? turns : all_turned) ? 1 : 0;
    if (turns) turn(triangles, *piece_of[i]);
  }
}

// If faces disagreed, the majority says which side is outside; without a clear majority the faces
// say nothing. `before` are the triangles as they were read.
void ask_faces(const std::vector<Triangle>& before, std::vector<Triangle>& triangles,
               std::vector<Piece>& pieces) {
  constexpr double kClearPart = 0.75;
  for (Piece& piece : pieces) {
    if (piece.open) continue;
    std::size_t as_read = 0;
    for (const std::uint32_t i : piece.triangles) as_read += triangles[i] == before[i] ? 1 : 0;
    const double part = static_cast<double>(as_read) / static_cast<double>(piece.triangles.size());
    if (part < 0.5) {
      turn(triangles, piece);
      piece.volume = -piece.volume;
    }
    piece.says_sides = std::max(part, 1 - part) >= kClearPart;
  }
}

}  // namespace

Solid repair(Mesh mesh) {
  Solid solid;
  RepairCounts& counts = solid.counts;
  counts.triangles_read = mesh.triangles.size();
  merge_points(mesh, counts);
  const auto flat = [&](const Triangle& t) { return !has_area(mesh, t); };
  counts.degenerate = std::erase_if(mesh.triangles, flat);
  drop_duplicates(mesh, solid.boundary, counts);

  const std::vector<Triangle> as_read = solid.boundary;
  const EdgeCounts before = count_edges(sorted_edges(solid.boundary));
  counts.border_edges = before.border;
  counts.non_manifold_edges = before.non_manifold;
  counts.inconsistent_edges = before.inconsistent;
  if (before.inconsistent > 0) orient_neighbours(mesh.points, solid.boundary);

  const std::vector<Edge> edges = sorted_edges(solid.boundary);
  std::vector<Piece> pieces = find_pieces(mesh.points, solid.boundary, edges);
  counts.pieces = pieces.size();
  const bool faces_agreed = before.inconsistent == 0;
  if (!faces_agreed) ask_faces(as_read, solid.boundary, pieces);
  const TriangleTree open = tree_of_open(mesh.points, solid.boundary, pieces);
  turn_open(mesh.points, solid.boundary, pieces, faces_agreed);
  turn_closed(mesh.points, solid.boundary, pieces, open);
  const EdgeCounts after = count_edges(sorted_edges(solid.boundary));
  solid.oriented = after.inconsistent == 0;
  solid.closed = after.open == 0;
  for (std::size_t i = 0; i < as_read.size(); ++i) {
    counts.triangles_turned += as_read[i] != solid.boundary[i] ? 1 : 0;
  }
  solid.surface = std::move(mesh);
  return solid;
}

}  // namespace stylet::offline
