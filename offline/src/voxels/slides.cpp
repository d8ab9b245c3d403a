// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/slides.h"

#include <deque>
#include <map>
#include <unordered_map>

#include "base/disjoint_set.h"
#include "meshes/near_surface.h"
#include "stylet/limits.h"
#include "voxels/apart.h"
#include "voxels/surface_bits.h"

namespace stylet::offline {
namespace {

// Of points, in edges of the finest voxels near them. With half of it the forces of a patient's
// insertion were within 1 %, and its ticks took 1.8 ms instead of 1.1.
constexpr double kSpacing = 1;
// Cosine between outward normals of surfaces that face each other, at most: 107 degrees. So the
// sides of a part do not face what it lies on, but the rim of what it lies on faces it.
constexpr double kFacing = -0.3;
// A point whose cell has no voxel of its part is moved into the next one, but no farther, in edges
// of that.
constexpr double kMostMoved = 0.5;
// A ground reaches this far on both sides of its surface, in its voxels' edges: deeper than contact
// presses.
constexpr double kGroundReach = 2.5;

Polygon corners_of(const Mesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

bool faces(Vec normal, Vec area_vector) {
  return dot(normal, area_vector) < kFacing * length(area_vector);
}

using Cell = SurfaceCell;

Cell cell_at(Vec at) {
  return {static_cast<std::int64_t>(std::floor(at.x)), static_cast<std::int64_t>(std::floor(at.y)),
          static_cast<std::int64_t>(std::floor(at.z))};
}

Vec low_of(const Cell& cell) {
  return {static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
}

// Distance of a place from a cell of edge 1, and the place of the cell that is nearest to it.
Vec nearest_in(const Cell& cell, Vec at) {
  const auto in = [](double value, std::int64_t low) {
    return std::clamp(value, static_cast<double>(low), static_cast<double>(low + 1));
  };
  return {in(at.x, cell[0]), in(at.y, cell[1]), in(at.z, cell[2])};
}

// ---- the two parts ------------------------------------------------------------------------------

class Slides {
 public:
  Slides(const std::vector<SlidingPart>& parts, const std::vector<SlidingPair>& pairs,
         std::span<const Lattice> levels, const std::vector<std::uint8_t>& cut)
      : parts_(parts),
        pairs_(pairs),
        levels_(levels),
        cut_(cut),
        reach_(kSlideReachM / coarsest().edge_m),
        body_(each_by_itself(parts.size())) {
    for (const SlidingPart& part : parts) {
      mesh_.push_back(part.surface_m);
      for (Vec& p : mesh_.back().points) p = to_lattice(coarsest(), p);
      surface_.emplace_back(mesh_.back());
    }
    std::uint32_t count = 0;
    for (const Lattice& level : levels) {
      before_.push_back(count);
      count += static_cast<std::uint32_t>(level.cell_of_voxel.size());
    }
    find_finest();
  }

  SlideLists list() {
    for (std::size_t ground = 0; ground < parts_.size(); ++ground) add_ground(ground);
    SlideLists lists;
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    for (const auto& [voxel, own] : grounds_) {
      number[voxel] = static_cast<std::uint32_t>(lists.grounds.size());
      OrganSlideGround ground = {voxel, {}};
      std::ranges::copy(own.distance, ground.distance);
      lists.grounds.push_back(ground);
      if (levels_.size() == 1) continue;
      lists.bodies.push_back(static_cast<std::uint8_t>(root_of(body_, own.part)));
    }
    for (const SlidingPair& pair : pairs_) lists.areas.push_back(add_points(pair, lists.points));
    for (OrganSlidePoint& point : lists.points) point.ground = number.at(point.ground);
    return lists;
  }

 private:
  using Distances = std::array<float, 8>;
  struct Ground {
    std::uint32_t part;  // the first one whose surface it knows
    Distances distance;
  };

  const Grid& coarsest() const { return levels_.front().grid; }
  static double ratio_of(std::size_t level) { return static_cast<double>(1U << level); }

  // Voxels are numbered through all levels.
  std::size_t level_of(std::uint32_t voxel) const {
    const auto behind = std::upper_bound(before_.begin(), before_.end(), voxel);
    return static_cast<std::size_t>(behind - before_.begin()) - 1;
  }

  // A voxel that holds the part, and nothing that the part is apart from.
  bool is_of(std::uint32_t voxel, std::size_t part) const {
    const std::size_t level = level_of(voxel);
    const std::uint32_t sides = levels_[level].sides[voxel - before_[level]];
    return (sides & parts_[part].side) != 0 && (sides & parts_[part].apart_from) == 0;
  }

  // Calls visit(voxel) for each voxel of a level's cell; of one outside the grid, for none.
  template <typename Visit>
  void each_voxel_of(std::size_t level, const Cell& cell, Visit visit) const {
    const Grid& grid = levels_[level].grid;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= std::int64_t{grid.size[axis]}) return;
    }
    const auto at = [&](std::size_t axis) { return static_cast<std::uint32_t>(cell[axis]); };
    each_voxel(levels_[level], cell_index(grid, at(0), at(1), at(2)),
               [&](std::uint32_t voxel) { visit(before_[level] + voxel); });
  }

  // The finest level of the voxels in each cell of level 0.
  void find_finest() {
    finest_in_.assign(cell_count(coarsest()), 0);
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      const auto& size = levels_[level].grid.size;
      for (const std::uint32_t cell : levels_[level].cell_of_voxel) {
        const std::uint32_t x = cell % size[0], y = cell / size[0] % size[1],
                            z = cell / size[0] / size[1];
        finest_in_[cell_index(coarsest(), x >> level, y >> level, z >> level)] =
            static_cast<std::uint8_t>(level);
      }
    }
  }

  // That of the cells around a cell of level 0 as well: points as dense as there meet no voxel that
  // is smaller than what they stand for, also when parts move a little.
  std::size_t finest_near(const Cell& cell) const {
    std::size_t finest = 0;
    const auto& size = coarsest().size;
    for (int n = 0; n < 27 && levels_.size() > 1; ++n) {
      const std::int64_t x = cell[0] + n % 3 - 1, y = cell[1] + n / 3 % 3 - 1,
                         z = cell[2] + n / 9 - 1;
      if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) continue;
      const auto u32 = [](std::int64_t value) { return static_cast<std::uint32_t>(value); };
      finest =
          std::max<std::size_t>(finest, finest_in_[cell_index(coarsest(), u32(x), u32(y), u32(z))]);
    }
    return finest;
  }

  struct Found {
    std::uint32_t voxel = kNoVoxel;
    std::size_t level = 0;
    Cell cell{};      // of its level
    double away = 0;  // in edges of level 0

    // The place in it that is nearest to one of level 0.
    Vec nearest(Vec at) const {
      return nearest_in(cell, at * ratio_of(level)) * (1 / ratio_of(level));
    }
  };
  // The nearest voxel that `wanted` accepts, no farther than `most` of its edges.
  template <typename Wanted>
  Found find(Vec at, double most, Wanted wanted) const {
    Found best{kNoVoxel, 0, {}, most};
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const double ratio = ratio_of(level);
      Found own = find_in(level, at * ratio, most, wanted);
      own.away /= ratio;
      if (own.voxel == kNoVoxel) continue;
      if (best.voxel == kNoVoxel || own.away < best.away) best = own;
    }
    return best;
  }

  // The same of one level, in its coordinates.
  template <typename Wanted>
  Found find_in(std::size_t level, Vec at, double most, Wanted wanted) const {
    Found best{kNoVoxel, level, {}, most};
    const Cell own = cell_at(at);
    for (int ring = 0; ring - 1 <= best.away; ++ring) {
      for (int z = -ring; z <= ring; ++z) {
        for (int y = -ring; y <= ring; ++y) {
          const bool inner = std::max(std::abs(z), std::abs(y)) < ring;
          for (int x = -ring; x <= ring; x += inner ? 2 * ring : 1) {
            const Cell cell = {own[0] + x, own[1] + y, own[2] + z};
            const double away = length(nearest_in(cell, at) - at);
            if (away > best.away || (away == best.away && best.voxel != kNoVoxel)) continue;
            each_voxel_of(level, cell, [&](std::uint32_t voxel) {
              if (wanted(voxel)) best = {voxel, level, cell, away};
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
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      add_ground_at(level, static_cast<std::uint32_t>(ground), surface);
    }
  }

  // Its voxels of a level; those of the coarser ones are there.
  void add_ground_at(std::size_t level, std::uint32_t ground, const NearSurface& surface) {
    const Lattice& lattice = levels_[level];
    const double ratio = ratio_of(level);
    std::unordered_map<std::uint64_t, float> known;  // distances of corners
    for (std::uint32_t i = 0; i < lattice.cell_of_voxel.size(); ++i) {
      const std::uint32_t voxel = before_[level] + i;
      if (!is_of(voxel, ground)) continue;
      const Cell cell = cell_of_voxel(lattice, i);
      const Vec middle = (low_of(cell) + Vec{0.5, 0.5, 0.5}) * (1 / ratio);
      if (length(surface.nearest(middle).at - middle) * ratio > kGroundReach) continue;
      const auto [entry, is_first] = grounds_.try_emplace(voxel, Ground{ground, {}});
      join(body_, ground, entry->second.part);
      Distances& distance = entry->second.distance;
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const Cell at = {cell[0] + (corner & 1U), cell[1] + (corner >> 1U & 1U),
                         cell[2] + (corner >> 2U)};
        const auto [found, is_new] = known.try_emplace(corner_key(at), 0.0F);
        if (is_new) found->second = distance_at(level, at, ground, surface);
        // Of two grounds in one voxel, the surface is that of both together.
        distance[corner] = is_first ? found->second : std::min(distance[corner], found->second);
      }
    }
  }

  static Cell cell_of_voxel(const Lattice& lattice, std::uint32_t voxel) {
    const auto& size = lattice.grid.size;
    const std::uint32_t cell = lattice.cell_of_voxel[voxel];
    return {cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]};
  }

  static std::uint64_t corner_key(const Cell& at) {
    const auto u64 = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
    return (u64(at[2]) << 40U) | (u64(at[1]) << 20U) | u64(at[0]);
  }

  // How far a corner of a level's cell lies outside the ground's surface, in edges of that level.
  // Where a coarser voxel of the ground has it on its surface, it is what that says: so distances
  // do not jump from level to level, as the corner itself moves with that voxel.
  float distance_at(std::size_t level, const Cell& corner, std::uint32_t ground,
                    const NearSurface& surface) const {
    const double ratio = ratio_of(level);
    const Vec at = low_of(corner);
    for (std::uint32_t side = 0; side < 8 && level > 0; ++side) {
      Cell coarse{};
      bool touches = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool below = (side >> axis & 1U) != 0;
        touches = touches && (!below || corner[axis] % 2 == 0);
        coarse[axis] = corner[axis] / 2 - (below ? 1 : 0);
      }
      const Distances* found = nullptr;
      each_voxel_of(level - 1, coarse, [&](std::uint32_t voxel) {
        const auto own = grounds_.find(voxel);
        if (touches && own != grounds_.end() && is_of(voxel, ground)) found = &own->second.distance;
      });
      if (found != nullptr) return static_cast<float>(2 * trilinear(*found, at * 0.5, coarse));
    }
    return static_cast<float>(surface.outside(at * (1 / ratio)) * ratio);
  }

  static double trilinear(const Distances& distance, Vec at, const Cell& cell) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      double weight = static_cast<double>(distance[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double part = at[axis] - static_cast<double>(cell[axis]);
        weight *= (i >> axis & 1U) != 0 ? part : 1 - part;
      }
      sum += weight;
    }
    return sum;
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

  // Those of each level, in its coordinates.
  std::vector<SurfaceBits> bits_of(const SlidingPair& pair) const {
    std::vector<SurfaceBits> bits(levels_.size());
    if (mesh_[pair.ground].triangles.empty()) return bits;
    for (const Triangle& t : mesh_[pair.part].triangles) {
      Polygon corners = corners_of(mesh_[pair.part], t);
      for (Vec& p : corners) p = p * (1 / kSpacing);
      each_bit(corners, [&](const Cell& cell, const Polygon& part) {
        const std::size_t level = finest_near(cell);
        if (level == 0) {
          add_bit(pair, 0, cell, part, bits[0]);
          return;
        }
        Polygon finer = part;
        for (Vec& p : finer) p = p * ratio_of(level);
        each_bit(finer, [&](const Cell& fine, const Polygon& bit) {
          add_bit(pair, level, fine, bit, bits[level]);
        });
      });
    }
    for (SurfaceBits& of_level : bits) join_small(of_level);
    return bits;
  }

  // If it faces the ground and is near it.
  void add_bit(const SlidingPair& pair, std::size_t level, const Cell& cell, const Polygon& part,
               SurfaceBits& bits) const {
    const Vec normal = area_vector(part), middle = middle_of(part);
    const double area = length(normal), to_coarsest = kSpacing / ratio_of(level);
    const NearSurface::Place near = surface_[pair.ground].nearest(middle * to_coarsest);
    const double away = length(near.at - middle * to_coarsest);
    const bool counts = area > 0 && faces(near.normal, normal) && away <= reach_ &&
                        !faces_nearer(pair, middle * to_coarsest, normal, away);
    if (counts) bits[cell].add({area, middle * area, normal});
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
    const std::vector<SurfaceBits> bits = bits_of(pair);
    for (std::size_t level = 0; level < bits.size(); ++level) {
      for (const auto& [cell, bit] : bits[level]) {
        const double wide = kSpacing / ratio_of(level);
        add_point(pair, bit.middle * (wide / bit.area), bit.area * wide * wide, areas, points);
      }
    }
    return areas;
  }

  // For a bit of the part's surface, in edges of level 0.
  void add_point(const SlidingPair& pair, Vec middle, double area, SlideArea& areas,
                 std::vector<OrganSlidePoint>& points) const {
    const Vec at = surface_[pair.part].nearest(middle).at;
    if (is_cut(at)) return;
    areas.facing += area;
    const Found own =
        find(at, kMostMoved, [&](std::uint32_t voxel) { return is_of(voxel, pair.part); });
    if (own.voxel == kNoVoxel) {
      areas.without_voxel += area;
      return;
    }
    const Vec there = own.nearest(at);
    const Found ground = ground_at(there, pair.ground);
    if (ground.voxel == kNoVoxel) {
      areas.without_ground += area;
      return;
    }
    const Vec in_level = there * ratio_of(own.level);
    const auto part = [](double value, std::int64_t low) {
      return static_cast<std::uint16_t>(std::lround(65535 * (value - static_cast<double>(low))));
    };
    // Crumpled surface, as noise in a map makes, is more than one point may stand for.
    const double squares = area * ratio_of(own.level) * ratio_of(own.level);
    const double count = std::ceil(squares / static_cast<double>(kMaxSlideArea));
    const OrganSlidePoint point = {own.voxel,
                                   part(in_level.x, own.cell[0]),
                                   part(in_level.y, own.cell[1]),
                                   part(in_level.z, own.cell[2]),
                                   0,
                                   static_cast<float>(squares / count),
                                   ground.voxel,
                                   static_cast<float>(pair.friction)};
    points.insert(points.end(), static_cast<std::size_t>(count), point);
  }

  bool is_cut(Vec at) const {
    const Grid& grid = coarsest();
    return !cut_.empty() && cut_[cell_of(grid, grid.origin_m + at * grid.edge_m)] != 0;
  }

  const std::vector<SlidingPart>& parts_;
  const std::vector<SlidingPair>& pairs_;
  std::span<const Lattice> levels_;
  const std::vector<std::uint8_t>& cut_;
  double reach_;                     // in edges of level 0
  std::vector<std::uint32_t> body_;  // of parts: those that share voxels are one
  std::vector<Mesh> mesh_;           // in lattice coordinates of level 0, as are places here
  std::deque<NearSurface> surface_;
  std::vector<std::uint32_t> before_;        // voxels of the levels before
  std::vector<std::uint8_t> finest_in_;      // by cell of level 0
  std::map<std::uint32_t, Ground> grounds_;  // by voxel
};

}  // namespace

SlideLists list_slides(const std::vector<SlidingPart>& parts, const std::vector<SlidingPair>& pairs,
                       std::span<const Lattice> levels, const std::vector<std::uint8_t>& cut) {
  return Slides(parts, pairs, levels, cut).list();
}

}  // namespace stylet::offline
