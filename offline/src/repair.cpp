// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include <numeric>
#include <tuple>

#include "disjoint_set.h"
#include "triangle_tree.h"

namespace stylet::bake {
namespace {

// Renumbers points so that bit-equal ones are one, in order of first use by a triangle.
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
  // Collinear points leave a rest of rounding; anything below it is not an area.
  constexpr double kRounding = 1e-28;
  return dot(normal, normal) > kRounding * dot(a, a) * dot(b, b);
}

// +1 or -1: which way round the triangle runs through its sorted corners.
int direction(const Triangle& t) {
  const int turns = (t[0] > t[1] ? 1 : 0) + (t[1] > t[2] ? 1 : 0) + (t[0] > t[2] ? 1 : 0);
  return turns % 2 == 0 ? 1 : -1;
}

// Groups equal triangles. The first of each group stays in the surface. It bounds the solid only
// where copies do not cancel: as many one way as the other enclose nothing between them.
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

// Faces agree at an edge when as many run one way as the other, give or take an odd one.
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
  double volume = 0;  // of a closed piece
  bool open = false;
};

std::vector<Triangle> select(const std::vector<Triangle>& triangles, const Piece& piece) {
  std::vector<Triangle> own;
  for (const std::uint32_t i : piece.triangles) own.push_back(triangles[i]);
  return own;
}

// Pieces hang together through edges of exactly two faces.
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

// A closed piece that is inside out and lies within another is a cavity and stays as it is.
bool is_cavity(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
               const Piece& piece) {
  std::vector<bool> own(triangles.size(), false);
  for (const std::uint32_t i : piece.triangles) own[i] = true;
  std::vector<Triangle> others;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!own[i]) others.push_back(triangles[i]);
  }
  const Vec probe = points[triangles[piece.triangles.front()][0]];
  return std::abs(winding_number(triangle_tree(points, others), probe)) > 0.5;
}

// An open surface has no volume to tell its sides by, but it winds round the points it half
// encloses: positively when it faces outward. `sum` over points spread through its box; `enclosed`
// counts those that it winds round more than half.
struct Evidence {
  double sum = 0;
  int enclosed = 0;
};

Evidence look_around(const std::vector<Vec>& points, const std::vector<Triangle>& triangles) {
  Box box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) grow(box, points[corner]);
  }
  const TriangleTree tree = triangle_tree(points, triangles);
  constexpr int kPerAxis = 12;
  const Vec step = (box.high - box.low) * (1.0 / kPerAxis);
  Evidence evidence;
  for (int z = 0; z < kPerAxis; ++z) {
    for (int y = 0; y < kPerAxis; ++y) {
      for (int x = 0; x < kPerAxis; ++x) {
        const Vec offset{(x + 0.5) * step.x, (y + 0.5) * step.y, (z + 0.5) * step.z};
        const double winding = winding_number(tree, box.low + offset);
        evidence.sum += winding;
        evidence.enclosed += std::abs(winding) > 0.5 ? 1 : 0;
      }
    }
  }
  return evidence;
}

// Open pieces that enclose something by themselves, or whose faces had to be reoriented, are judged
// alone; the others all together, because in a file whose faces agreed their relative sides mean
// something.
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

// A closed piece is turned where its volume is negative, unless it is a cavity of another.
void turn_closed(const std::vector<Vec>& points, std::vector<Triangle>& triangles,
                 const std::vector<Piece>& pieces, bool faces_agreed) {
  constexpr std::size_t kMostCavities = 64;  // bounds the time spent on looking for them
  std::size_t probed = 0;
  for (const Piece& piece : pieces) {
    if (piece.open || piece.volume >= 0) continue;
    const bool cavity = faces_agreed && pieces.size() > 1 && probed++ < kMostCavities &&
                        is_cavity(points, triangles, piece);
    if (!cavity) turn(triangles, piece);
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
  const std::vector<Piece> pieces = find_pieces(mesh.points, solid.boundary, edges);
  counts.pieces = pieces.size();
  const bool faces_agreed = before.inconsistent == 0;
  turn_open(mesh.points, solid.boundary, pieces, faces_agreed);
  turn_closed(mesh.points, solid.boundary, pieces, faces_agreed);
  const EdgeCounts after = count_edges(sorted_edges(solid.boundary));
  solid.oriented = after.inconsistent == 0;
  solid.closed = after.open == 0;
  for (std::size_t i = 0; i < as_read.size(); ++i) {
    counts.triangles_turned += as_read[i] != solid.boundary[i] ? 1 : 0;
  }
  solid.surface = std::move(mesh);
  return solid;
}

}  // namespace stylet::bake
