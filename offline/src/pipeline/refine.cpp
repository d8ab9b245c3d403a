// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/refine.h"

#include <set>

#include "base/refusal.h"
#include "pipeline/voxel_materials.h"
#include "voxels/cell_walk.h"

namespace stylet::offline {
namespace {

constexpr double kMetresPerMm = 1e-3;

// ---- ways and boxes, in lattice coordinates -----------------------------------------------------

double distance_to_cell(Vec at, const Vec& low) {
  Vec off;
  double* const parts[] = {&off.x, &off.y, &off.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *parts[axis] = std::max({low[axis] - at[axis], at[axis] - low[axis] - 1, 0.0});
  }
  return length(off);
}

// The least distance from a place of the way to the cell. Along a line it is convex, so thirds that
// hold no minimum are left out; 60 times, (2/3)^60 of the way is left.
double distance_to_way(Vec from, Vec to, const Vec& low) {
  const auto at = [&](double part) { return distance_to_cell(from + (to - from) * part, low); };
  double first = 0, last = 1;
  for (int i = 0; i < 60; ++i) {
    const double a = first + (last - first) / 3, b = last - (last - first) / 3;
    if (at(a) <= at(b)) {
      last = b;
    } else {
      first = a;
    }
  }
  return at((first + last) / 2);
}

// Calls visit(cell, its low corner) for the cells of a grid that a box touches.
template <typename Visit>
void each_cell_in(const Grid& grid, Vec low, Vec high, Visit visit) {
  std::array<std::uint32_t, 3> first{}, end{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = grid.size[axis];
    first[axis] = static_cast<std::uint32_t>(std::clamp(std::floor(low[axis]) - 1, 0.0, size));
    end[axis] = static_cast<std::uint32_t>(std::clamp(std::floor(high[axis]) + 2, 0.0, size));
  }
  for (std::uint32_t z = first[2]; z < end[2]; ++z) {
    for (std::uint32_t y = first[1]; y < end[1]; ++y) {
      for (std::uint32_t x = first[0]; x < end[0]; ++x) {
        visit(cell_index(grid, x, y, z), Vec{1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
}

// Calls visit(cell) for the cells of a grid within a way's radius, or in a box. A box that only
// touches a cell's face does not reach into it.
template <typename Visit>
void each_near(const Grid& grid, const Refinement& r, Visit visit) {
  const Vec from = to_lattice(grid, r.from_mm * kMetresPerMm);
  const Vec to = to_lattice(grid, r.to_mm * kMetresPerMm);
  const double radius = r.radius_mm * kMetresPerMm / grid.edge_m;
  Box box;
  grow(box, from);
  grow(box, to);
  const Vec wide = {radius, radius, radius};
  each_cell_in(grid, box.low - wide, box.high + wide, [&](std::size_t cell, const Vec& low) {
    bool meets = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      meets = meets && box.low[axis] < low[axis] + 1 - 2 * kTouch + radius &&
              box.high[axis] > low[axis] + 2 * kTouch - radius;
    }
    const bool is_way = r.kind == Refinement::Kind::kWay;
    if (meets && (!is_way || distance_to_way(from, to, low) <= radius)) visit(cell);
  });
}

// ---- tissues and surface ------------------------------------------------------------------------

// Calls visit(cell) for the cells of a level with a sample of one of the tissues.
template <typename Visit>
void each_with_tissue(const Claimed& claimed, const BuildOptions& options, const Refinement& r,
                      Visit visit) {
  const Claims& claims = claimed.levels[r.levels];
  MaterialList list{options.own_tissues, {}};
  const TissueNumbers numbers = number_tissues(claimed.tissues, options, claims.grid.edge_m, list);
  const auto is_wanted = [&](std::uint8_t material) {
    return std::ranges::find(r.tissues, list.tissues[material].name) != r.tissues.end();
  };
  CellWalk(claims, claimed.places, numbers).each_cell([&](std::size_t cell, const CellHere& here) {
    for (std::uint32_t s = 0; s < kCellSamples; ++s) {
      const std::uint16_t owner = here.owner[s];
      if (owner == kNoOwner) continue;
      const std::uint8_t layer = is_layered(numbers, owner)
                                     ? layer_at(numbers, here.at[s] * claims.grid.edge_m)
                                     : kNotLayered;
      if (!is_wanted(layer == kNotLayered ? numbers.of_owner[owner]
                                          : numbers.layers[layer].material)) {
        continue;
      }
      visit(cell);
      return;
    }
  });
}

// Calls visit(cell) for the cells of a level at the outer surface, also for those that have only a
// point of it.
template <typename Visit>
void each_at_surface(const Claims& claims, const std::vector<Vec>& points_m, Visit visit) {
  const Grid& grid = claims.grid;
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x, ++cell) {
        if (is_kept(claims, cell) && is_skin(claims, x, y, z)) visit(cell);
      }
    }
  }
  for (const Vec& point_m : points_m) {
    const std::size_t at = cell_of(grid, point_m);
    if (!is_kept(claims, at)) visit(at);
  }
}

// Splits the cells that are to be finer; false if none is.
bool split_for(const Refinement& r, const Claimed& claimed, const BuildOptions& options,
               Splitting& splitting) {
  bool any = false;
  const auto take = [&](std::size_t cell) {  // of the level with the wanted edge
    if (!splitting.is_occupied(r.levels, cell)) return;
    splitting.split_around(r.levels, cell);
    any = true;
  };
  switch (r.kind) {
    case Refinement::Kind::kWay:
    case Refinement::Kind::kBox:
      each_near(claimed.levels[r.levels - 1].grid, r, [&](std::size_t cell) {
        any = any || splitting.is_occupied(r.levels - 1, cell);
        splitting.split(r.levels - 1, cell);
      });
      break;
    case Refinement::Kind::kLabels:
      each_with_tissue(claimed, options, r, take);
      break;
    case Refinement::Kind::kSurface:
      each_at_surface(claimed.levels[r.levels], claimed.mesh.points, take);
      break;
  }
  return any;
}

}  // namespace

void check_refinements(const BuildOptions& options, const std::vector<std::string>& tissues) {
  if (options.refinements.empty()) return;
  std::set<std::string> known(tissues.begin(), tissues.end());
  for (const Layer& layer : options.layers) known.insert(layer.tissue);
  if (!options.gap_tissue.empty()) known.insert(options.gap_tissue);
  std::string list;
  for (const std::string& tissue : known) list += (list.empty() ? "" : ", ") + tissue;
  for (const Refinement& each : options.refinements) {
    for (const std::string& tissue : each.tissues) {
      if (known.contains(tissue)) continue;
      refuse("{}: {}: expected a tissue of this organ: {}", each.from, tissue, list);
    }
  }
}

LevelCells absent_cells(const Claimed& claimed, const BuildOptions& options,
                        std::vector<std::string>& warnings) {
  if (options.refinements.empty()) return {claimed.cut};
  Splitting splitting(claimed.levels, claimed.mesh.points, claimed.cut);
  for (const Refinement& each : options.refinements) {
    if (split_for(each, claimed, options, splitting)) continue;
    warnings.push_back(
        fmt::format("{}: no voxel is finer for it: expected a place, or a tissue, "
                    "in the organ",
                    each.from));
  }
  return splitting.balanced();
}

}  // namespace stylet::offline
