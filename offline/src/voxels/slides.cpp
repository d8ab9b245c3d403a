// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/slides.h"

#include <deque>
#include <map>
#include <unordered_map>

#include "base/polygon.h"
#include "meshes/near_surface.h"
#include "stylet/limits.h"
#include "voxels/apart.h"

namespace stylet::offline {
namespace {

// Of points, in edges. With half of it the forces of a patient's insertion were within 1 %, and its
// ticks took 1.8 ms instead of 1.1.
constexpr double kSpacing = 1;
// Cosine between outward normals of surfaces that face each other, at most: 107 degrees. So the
// sides of a part do not face what it lies on, but the rim of what it lies on faces it.
constexpr double kFacing = -0.3;
// A point whose cell has no voxel of its part is moved into the next one, but no farther, in edges.
constexpr double kMostMoved = 0.5;
// A ground reaches this far on both sides of its surface: deeper than contact presses.
constexpr double kGroundReach = 2.5;
// Surface in a box of `kSpacing` that is smaller than this part of its face goes to a neighbour.
constexpr double kLeastBit = 0.25;

Polygon corners_of(const Mesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

Vec middle_of(const Polygon& polygon) {
  Vec sum;
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double part = area_of({polygon[0], polygon[i - 1], polygon[i]});
    sum = sum + (polygon[0] + polygon[i - 1] + polygon[i]) * (part / 3);
    area += part;
  }
  return area > 0 ? sum * (1 / area) : polygon.front();
}

bool faces(Vec normal, Vec area_vector) {
  return dot(normal, area_vector) < kFacing * length(area_vector);
}

using Cell = std::array<std::int64_t, 3>;

Cell cell_at(Vec at) {
  return {static_cast<std::int64_t>(std::floor(at.x)), static_cast<std::int64_t>(std::floor(at.y)),
          static_cast<std::int64_t>(std::floor(at.z))};
}

// Distance of a place from a cell of edge 1, and the place of the cell that is nearest to it.
Vec nearest_in(const Cell& cell, Vec at) {
  const auto in = [](double value, std::int64_t low) {
    return std::clamp(value, static_cast<double>(low), static_cast<double>(low + 1));
  };
  return {in(at.x, cell[0]), in(at.y, cell[1]), in(at.z, cell[2])};
}

// ---- surface in pieces --------------------------------------------------------------------------

struct Bit {
  double area = 0;
  Vec middle, normal;  // sums, weighted with areas
};
using Bits = std::map<Cell, Bit>;

// Calls visit(index, part) for each slab of thickness 1 across an axis.
template <typename Visit>
void each_slab(const Polygon& polygon, std::size_t axis, Visit visit) {
  double low = polygon.front()[axis], high = low;
  for (const Vec& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  for (double at = std::floor(low); at <= high; at += 1) {
    // What lies in the plane between two slabs is only in the upper one.
    if (at == high && low < high) continue;
    const Polygon part = between(polygon, axis, at, at + 1);
    if (part.size() > 2) visit(static_cast<std::int64_t>(at), part);
  }
}

template <typename Visit>
void each_bit(const Polygon& polygon, Visit visit) {
  each_slab(polygon, 2, [&](std::int64_t z, const Polygon& slab) {
    each_slab(slab, 1, [&](std::int64_t y, const Polygon& bar) {
      each_slab(bar, 0, [&](std::int64_t x, const Polygon& part) { visit(Cell{x, y, z}, part); });
    });
  });
}

void add(Bit& to, const Bit& other) {
  to.area += other.area;
  to.middle = to.middle + other.middle;
  to.normal = to.normal + other.normal;
}

// Small bits join the largest one beside them that faces the same way.
void join_small(Bits& bits) {
  for (auto at = bits.begin(); at != bits.end();) {
    Bit* best = nullptr;
    for (int n = 0; n < 27 && at->second.area < kLeastBit; ++n) {
      const Cell& c = at->first;
      const auto there = bits.find({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1});
      if (there == bits.end() || there->second.area < kLeastBit) continue;
      if (dot(there->second.normal, at->second.normal) <= 0) continue;
      if (best == nullptr || there->second.area > best->area) best = &there->second;
    }
    if (best != nullptr) add(*best, at->second);
    at = best != nullptr ? bits.erase(at) : std::next(at);
  }
}

// ---- the two parts ------------------------------------------------------------------------------

class Slides {
 public:
  Slides(const std::vector<SlidingPart>& parts, const std::vector<SlidingPair>& pairs,
         const Lattice& lattice, const std::vector<std::uint8_t>& cut)
      : parts_(parts),
        pairs_(pairs),
        lattice_(lattice),
        cut_(cut),
        reach_(kSlideReachM / lattice.grid.edge_m) {
    for (const SlidingPart& part : parts) {
      mesh_.push_back(part.surface_m);
      for (Vec& p : mesh_.back().points) p = to_lattice(lattice.grid, p);
      surface_.emplace_back(mesh_.back());
    }
  }

  SlideLists list() {
    for (std::size_t ground = 0; ground < parts_.size(); ++ground) add_ground(ground);
    SlideLists lists;
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    for (const auto& [voxel, distance] : grounds_) {
      number[voxel] = static_cast<std::uint32_t>(lists.grounds.size());
      OrganSlideGround ground = {voxel, {}};
      std::ranges::copy(distance, ground.distance);
      lists.grounds.push_back(ground);
    }
    for (const SlidingPair& pair : pairs_) lists.areas.push_back(add_points(pair, lists.points));
    for (OrganSlidePoint& point : lists.points) point.ground = number.at(point.ground);
    return lists;
  }

 private:
  using Distances = std::array<float, 8>;

  // A voxel that holds the part, and nothing that the part is apart from.
  bool is_of(std::uint32_t voxel, std::size_t part) const {
    const std::uint32_t sides = lattice_.sides[voxel];
    return (sides & parts_[part].side) != 0 && (sides & parts_[part].apart_from) == 0;
  }

  // Calls visit(voxel) for each voxel of a cell; of one outside the grid, for none.
  template <typename Visit>
  void each_voxel_of(const Cell& cell, Visit visit) const {
    const Grid& grid = lattice_.grid;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= std::int64_t{grid.size[axis]}) return;
    }
    const auto at = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis]); };
    each_voxel(lattice_, cell_index(grid, at(0), at(1), at(2)), visit);
  }

  struct Found {
    std::uint32_t voxel = kNoVoxel;
    Cell cell{};
    double away = 0;
  };
  // The nearest voxel that `wanted` accepts, no farther than `most`.
  template <typename Wanted>
  Found find(Vec at, double most, Wanted wanted) const {
    Found best{kNoVoxel, {}, most};
    const Cell own = cell_at(at);
    for (int ring = 0; ring - 1 <= best.away; ++ring) {
      for (int z = -ring; z <= ring; ++z) {
        for (int y = -ring; y <= ring; ++y) {
          const bool inner = std::max(std::abs(z), std::abs(y)) < ring;
          for (int x = -ring; x <= ring; x += inner ? 2 * ring : 1) {
            const Cell cell = {own[0] + x, own[1] + y, own[2] + z};
            const double away = length(nearest_in(cell, at) - at);
            if (away > best.away || (away == best.away && best.voxel != kNoVoxel)) continue;
            each_voxel_of(cell, [&](std::uint32_t voxel) {
              if (wanted(voxel)) best = {voxel, cell, away};
            });
          }
        }
      }
    }
    return best;
  }

  // The triangles of a ground that face a part which slides on it. So a thin ground's other side
  // does not count: the ground goes on below its surface, however thin it is.
  Mesh facing_part(std::size_t ground) const {
    Mesh facing;
    facing.points = mesh_[ground].points;
    for (const Triangle& t : mesh_[ground].triangles) {
      const Polygon corners = corners_of(mesh_[ground], t);
      const bool faces_any = std::ranges::any_of(pairs_, [&](const SlidingPair& pair) {
        return pair.ground == ground && !mesh_[pair.part].triangles.empty() &&
               faces(surface_[pair.part].nearest(middle_of(corners)).normal, area_vector(corners));
      });
      if (faces_any) facing.triangles.push_back(t);
    }
    return facing;
  }

  void add_ground(std::size_t ground) {
    const Mesh facing = facing_part(ground);
    if (facing.triangles.empty()) return;
    const NearSurface surface(facing);
    const auto& size = lattice_.grid.size;
    std::unordered_map<std::uint64_t, float> known;  // distances of corners
    for (std::uint32_t voxel = 0; voxel < lattice_.cell_of_voxel.size(); ++voxel) {
      if (!is_of(voxel, ground)) continue;
      const std::uint32_t cell = lattice_.cell_of_voxel[voxel];
      const std::uint32_t x = cell % size[0], y = cell / size[0] % size[1],
                          z = cell / size[0] / size[1];
      const Vec middle = {x + 0.5, y + 0.5, z + 0.5};
      if (length(surface.nearest(middle).at - middle) > kGroundReach) continue;
      const auto [entry, is_first] = grounds_.try_emplace(voxel);
      Distances& distance = entry->second;
      for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t cx = x + (i & 1U), cy = y + (i >> 1U & 1U), cz = z + (i >> 2U);
        const std::uint64_t key = (std::uint64_t{cz} << 40U) | (std::uint64_t{cy} << 20U) | cx;
        const auto [at, is_new] = known.try_emplace(key, 0.0F);
        if (is_new)
          at->second = static_cast<float>(surface.outside({1.0 * cx, 1.0 * cy, 1.0 * cz}));
        // Of two grounds in one voxel, the surface is that of both together.
        distance[i] = is_first ? at->second : std::min(distance[i], at->second);
      }
    }
  }

  // Whether another ground of the pair's part lies nearer to a bit of its surface.
  bool faces_nearer(const SlidingPair& pair, Vec middle, Vec normal, double away) const {
    return std::ranges::any_of(pairs_, [&](const SlidingPair& other) {
      if (other.part != pair.part || other.ground == pair.ground) return false;
      if (mesh_[other.ground].triangles.empty()) return false;
      const NearSurface::Place near = surface_[other.ground].nearest(middle);
      return length(near.at - middle) < away && faces(near.normal, normal);
    });
  }

  Bits bits_of(const SlidingPair& pair) const {
    const NearSurface& ground = surface_[pair.ground];
    Bits bits;
    if (mesh_[pair.ground].triangles.empty()) return bits;
    for (const Triangle& t : mesh_[pair.part].triangles) {
      Polygon corners = corners_of(mesh_[pair.part], t);
      for (Vec& p : corners) p = p * (1 / kSpacing);
      each_bit(corners, [&](const Cell& cell, const Polygon& part) {
        const Vec normal = area_vector(part), middle = middle_of(part);
        const double area = length(normal);
        const NearSurface::Place near = ground.nearest(middle * kSpacing);
        const double away = length(near.at - middle * kSpacing);
        const bool counts = area > 0 && faces(near.normal, normal) && away <= reach_ &&
                            !faces_nearer(pair, middle * kSpacing, normal, away);
        if (counts) add(bits[cell], {area, middle * area, normal});
      });
    }
    join_small(bits);
    return bits;
  }

  // Where a point lies in a ground, or what of the ground is nearest to it across a gap.
  Found ground_at(Vec at, std::size_t ground) const {
    constexpr double kNear = 1;
    const auto is_ground = [&](std::uint32_t voxel) {
      return is_of(voxel, ground) && grounds_.contains(voxel);
    };
    const Found near = find(at, kNear, is_ground);
    return near.voxel != kNoVoxel ? near : find(surface_[ground].nearest(at).at, kNear, is_ground);
  }

  SlideArea add_points(const SlidingPair& pair, std::vector<OrganSlidePoint>& points) const {
    SlideArea areas;
    for (const auto& [cell, bit] : bits_of(pair)) {
      const double area = bit.area * kSpacing * kSpacing;
      const Vec at = surface_[pair.part].nearest(bit.middle * (kSpacing / bit.area)).at;
      if (is_cut(at)) continue;
      areas.facing += area;
      const Found own =
          find(at, kMostMoved, [&](std::uint32_t voxel) { return is_of(voxel, pair.part); });
      if (own.voxel == kNoVoxel) {
        areas.without_voxel += area;
        continue;
      }
      const Vec there = nearest_in(own.cell, at);
      const Found ground = ground_at(there, pair.ground);
      if (ground.voxel == kNoVoxel) {
        areas.without_ground += area;
        continue;
      }
      const auto part = [](double value, std::int64_t low) {
        return static_cast<std::uint16_t>(std::lround(65535 * (value - static_cast<double>(low))));
      };
      // Crumpled surface, as noise in a map makes, is more than one point may stand for.
      const double count = std::ceil(area / static_cast<double>(kMaxSlideArea));
      const OrganSlidePoint point = {own.voxel,
                                     part(there.x, own.cell[0]),
                                     part(there.y, own.cell[1]),
                                     part(there.z, own.cell[2]),
                                     0,
                                     static_cast<float>(area / count),
                                     ground.voxel,
                                     static_cast<float>(pair.friction)};
      points.insert(points.end(), static_cast<std::size_t>(count), point);
    }
    return areas;
  }

  bool is_cut(Vec at) const {
    const Grid& grid = lattice_.grid;
    return !cut_.empty() && cut_[cell_of(grid, grid.origin_m + at * grid.edge_m)] != 0;
  }

  const std::vector<SlidingPart>& parts_;
  const std::vector<SlidingPair>& pairs_;
  const Lattice& lattice_;
  const std::vector<std::uint8_t>& cut_;
  double reach_;            // in edges
  std::vector<Mesh> mesh_;  // in lattice coordinates, as are all places here
  std::deque<NearSurface> surface_;
  std::map<std::uint32_t, Distances> grounds_;  // by voxel
};

}  // namespace

SlideLists list_slides(const std::vector<SlidingPart>& parts, const std::vector<SlidingPair>& pairs,
                       const Lattice& lattice, const std::vector<std::uint8_t>& cut) {
  return Slides(parts, pairs, lattice, cut).list();
}

}  // namespace stylet::offline
