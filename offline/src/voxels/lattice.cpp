// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/lattice.h"

#include <bit>
#include <tuple>

#include "base/refusal.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

constexpr int kSamples = 64;  // per cell

struct CellPlace {
  std::uint32_t x, y, z;
};

std::uint32_t nearest_cell(double at, std::uint32_t size) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(at), 0.0, size - 1.0));
}

// The cells that count as containing a place along one axis: its own, and a neighbour that it
// nearly touches.
std::size_t cells_along(double at, std::uint32_t size, std::uint32_t (&cells)[2]) {
  const std::uint32_t own = nearest_cell(at, size);
  cells[0] = own;
  const double fraction = at - own;
  if (own > 0 && fraction < 2 * kTouch) {
    cells[1] = own - 1;
    return 2;
  }
  if (own + 1 < size && fraction > 1 - 2 * kTouch) {
    cells[1] = own + 1;
    return 2;
  }
  return 1;
}

CellPlace own_cell(const Grid& grid, Vec at) {
  return {nearest_cell(at.x, grid.size[0]), nearest_cell(at.y, grid.size[1]),
          nearest_cell(at.z, grid.size[2])};
}

// The first cell at `at` for which `keeps` is true; its own cell is tried first.
template <typename Keeps>
std::optional<CellPlace> find_cell(const Grid& grid, Vec at, Keeps keeps) {
  std::uint32_t xs[2], ys[2], zs[2];
  const std::size_t nx = cells_along(at.x, grid.size[0], xs);
  const std::size_t ny = cells_along(at.y, grid.size[1], ys);
  const std::size_t nz = cells_along(at.z, grid.size[2], zs);
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t i = 0; i < nx; ++i) {
        if (keeps(cell_index(grid, xs[i], ys[j], zs[k]))) return CellPlace{xs[i], ys[j], zs[k]};
      }
    }
  }
  return std::nullopt;
}

std::uint16_t quantised(double fraction) {
  return static_cast<std::uint16_t>(std::floor(std::clamp(fraction, 0.0, 1.0) * 65535 + 0.5));
}

Vec rest_position(const Grid& grid, CellPlace cell, const OrganVertex& v) {
  constexpr double kStep = 1.0 / 65535;
  return grid.origin_m +
         Vec{cell.x + v.fx * kStep, cell.y + v.fy * kStep, cell.z + v.fz * kStep} * grid.edge_m;
}

// For a cell with some surface but no samples: owner of the fullest cell beside it, else its own.
std::uint16_t owner_beside(const Claims& claims, CellPlace at) {
  const Grid& grid = claims.grid;
  std::uint16_t owner = claims.owner[cell_index(grid, at.x, at.y, at.z)];
  int most = 0;
  for (std::uint32_t n = 0; n < 27; ++n) {
    // Indices are one too high, so that none is negative.
    const std::uint32_t x = at.x + n % 3, y = at.y + n / 3 % 3, z = at.z + n / 9;
    if (x < 1 || y < 1 || z < 1 || x > grid.size[0] || y > grid.size[1] || z > grid.size[2])
      continue;
    const std::size_t cell = cell_index(grid, x - 1, y - 1, z - 1);
    if (claims.owner_fill[cell] <= most) continue;
    most = claims.owner_fill[cell];
    owner = claims.owner[cell];
  }
  return owner;
}

// An input that fills a cell alone needs no share; it gets one as soon as a second input comes.
void keep_share(Claims& claims, std::size_t cell, Claims::Share share, int owner_priority) {
  share.cell = static_cast<std::uint32_t>(cell);
  const bool is_first = claims.inside[cell] == 0;
  if (share.inside == 0 || (is_first && share.inside == kFullCell)) return;
  if (claims.owner_fill[cell] == kSamples) {
    claims.shares.push_back({share.cell, claims.owner[cell], owner_priority, kFullCell});
  }
  claims.shares.push_back(share);
}

// A unit vector for each point that points inward: the negative sum of its triangles' normals.
std::vector<Vec> inward(const std::vector<Vec>& points, const std::vector<Triangle>& triangles) {
  std::vector<Vec> sum(points.size());
  for (const Triangle& t : triangles) {
    const Vec normal = cross(points[t[2]] - points[t[0]], points[t[1]] - points[t[0]]);
    for (const std::uint32_t corner : t) sum[corner] = sum[corner] + normal;
  }
  for (Vec& each : sum) {
    const double size = length(each);
    each = size > 0 ? each * (1 / size) : Vec{};
  }
  return sum;
}

// So far below a surface is the part that it belongs to.
constexpr double kDepth = 0.15;

// The voxel of a cell that a place belongs to; `below` points inward from the place.
std::uint32_t voxel_for(const Lattice& lattice, CellPlace at, Vec place, Vec below) {
  const std::size_t cell = cell_index(lattice.grid, at.x, at.y, at.z);
  const Vec in_cell = place + below * kDepth - Vec{1.0 * at.x, 1.0 * at.y, 1.0 * at.z};
  std::uint32_t bit = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    bit = bit * 4 + static_cast<std::uint32_t>(std::clamp(std::floor(in_cell[axis] * 4), 0.0, 3.0));
  }
  for (const SharedCell& each : shared_in(lattice, cell)) {
    if ((each.quarters >> bit & 1U) != 0) return each.voxel;
  }
  return lattice.voxel_of_cell[cell];
}

void require_few(std::size_t voxels, double edge_m) {
  if (voxels <= kMaxVoxels) return;
  refuse<TooFine>(
      "voxel edge {:.6g} mm: {} voxels: expected at most {}: choose a larger voxel edge",
      edge_m * 1e3, voxels, kMaxVoxels);
}

// Whether a point lies in such a cell, or nearly touches one.
template <typename Keeps>
bool is_held(const Grid& grid, Vec point_m, Keeps keeps) {
  return find_cell(grid, to_lattice(grid, point_m), keeps).has_value();
}

}  // namespace

std::span<const SharedCell> shared_in(const Lattice& lattice, std::size_t cell) {
  const auto first = std::ranges::lower_bound(lattice.shared, cell, {}, &SharedCell::cell);
  const auto behind =
      std::ranges::upper_bound(first, lattice.shared.end(), cell, {}, &SharedCell::cell);
  return {first, behind};
}

std::uint8_t fill_of(std::uint64_t inside) {
  const auto samples = static_cast<unsigned>(std::popcount(inside));
  return static_cast<std::uint8_t>(std::max(1U, (samples * 255U + 32U) / 64U));
}

Claims no_claims(const Grid& grid) {
  const std::size_t cells = cell_count(grid);
  return {grid,
          std::vector<std::uint64_t>(cells, 0),
          std::vector<std::uint8_t>(cells, 0),
          std::vector<std::uint16_t>(cells, 0),
          std::vector<std::uint8_t>(cells, 0),
          {}};
}

std::vector<std::uint16_t> owners(Claims& claims, const Lattice& lattice) {
  std::vector<std::uint16_t> of_voxel;
  for (const std::uint32_t cell : lattice.cell_of_voxel) of_voxel.push_back(claims.owner[cell]);
  const auto by_cell = [](const Claims::Share& a, const Claims::Share& b) {
    return a.cell < b.cell;
  };
  std::stable_sort(claims.shares.begin(), claims.shares.end(), by_cell);
  for (const SharedCell& each : lattice.shared) {
    const auto [first, last] = std::equal_range(claims.shares.begin(), claims.shares.end(),
                                                Claims::Share{each.cell, 0, 0, 0}, by_cell);
    auto best = std::make_tuple(false, 0, 0);
    for (auto share = first; share != last; ++share) {
      const int samples = std::popcount(share->inside & each.inside);
      const auto rank = std::make_tuple(samples > 0, share->priority, samples);
      if (!(rank > best)) continue;
      best = rank;
      of_voxel[each.voxel] = share->owner;
    }
  }
  return of_voxel;
}

void add_claim(Claims& claims, const Occupancy& occupancy, std::uint16_t input,
               const std::vector<int>& priorities) {
  for (std::size_t cell = 0; cell < claims.inside.size(); ++cell) {
    const auto fill = static_cast<std::uint8_t>(std::popcount(occupancy.inside[cell]));
    if (fill == 0 && occupancy.pierced[cell] == 0) continue;
    const std::uint16_t owner = claims.owner[cell];
    const std::uint8_t owner_fill = claims.owner_fill[cell];
    keep_share(claims, cell, {0, input, priorities[input], occupancy.inside[cell]},
               priorities[owner]);
    const auto rank = std::make_tuple(fill > 0, priorities[input], fill);
    const auto owner_rank = std::make_tuple(owner_fill > 0, priorities[owner], owner_fill);
    if (!is_kept(claims, cell) || rank > owner_rank) {
      claims.owner[cell] = input;
      claims.owner_fill[cell] = fill;
    }
    claims.inside[cell] |= occupancy.inside[cell];
    claims.pierced[cell] |= occupancy.pierced[cell];
  }
}

bool is_kept(const Claims& claims, std::size_t cell) {
  return claims.inside[cell] != 0 || claims.pierced[cell] != 0;
}

bool is_skin(const Claims& claims, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const Grid& grid = claims.grid;
  bool bare_face = false;
  bool all_full = true;
  for (std::uint32_t dz = 0; dz < 3; ++dz) {
    for (std::uint32_t dy = 0; dy < 3; ++dy) {
      for (std::uint32_t dx = 0; dx < 3; ++dx) {
        const std::uint32_t nx = x + dx, ny = y + dy, nz = z + dz;  // neighbour's index plus one
        const bool in_grid = nx >= 1 && ny >= 1 && nz >= 1 && nx <= grid.size[0] &&
                             ny <= grid.size[1] && nz <= grid.size[2];
        const std::size_t cell = in_grid ? cell_index(grid, nx - 1, ny - 1, nz - 1) : 0;
        const bool across_face = (dx != 1 ? 1 : 0) + (dy != 1 ? 1 : 0) + (dz != 1 ? 1 : 0) == 1;
        all_full = all_full && in_grid && claims.inside[cell] == kFullCell;
        bare_face = bare_face || (across_face && !(in_grid && is_kept(claims, cell)));
      }
    }
  }
  return !all_full && (bare_face || claims.pierced[cell_index(grid, x, y, z)] != 0);
}

std::size_t cell_of(const Grid& grid, Vec point_m) {
  const CellPlace own = own_cell(grid, to_lattice(grid, point_m));
  return cell_index(grid, own.x, own.y, own.z);
}

Lattice make_lattice(Claims& claims, const std::vector<Vec>& points_m,
                     const std::vector<std::uint8_t>& cut) {
  const Grid& grid = claims.grid;
  const auto kept = [&](std::size_t cell) {
    return is_kept(claims, cell) && (cut.empty() || cut[cell] == 0);
  };
  for (const Vec& point_m : points_m) {
    const Vec at = to_lattice(grid, point_m);
    if (find_cell(grid, at, kept)) continue;
    const CellPlace own = own_cell(grid, at);
    const std::size_t cell = cell_index(grid, own.x, own.y, own.z);
    claims.pierced[cell] = 1;
    claims.owner[cell] = owner_beside(claims, own);
  }
  Lattice lattice;
  lattice.grid = grid;
  lattice.sheet_rows = grid.size[1];
  lattice.voxel_of_cell.assign(cell_count(grid), kNoVoxel);
  bool row_goes_on = false;
  for (std::size_t cell = 0; cell < cell_count(grid); ++cell) {
    const std::size_t x = cell % grid.size[0];
    row_goes_on = row_goes_on && x > 0;
    if (!kept(cell)) {
      row_goes_on = false;
      continue;
    }
    if (!row_goes_on) {
      lattice.runs.push_back({static_cast<std::uint16_t>(x),
                              static_cast<std::uint16_t>(cell / grid.size[0] % grid.size[1]),
                              static_cast<std::uint16_t>(cell / grid.size[0] / grid.size[1]), 0});
      row_goes_on = true;
    }
    ++lattice.runs.back().count;
    lattice.voxel_of_cell[cell] = static_cast<std::uint32_t>(lattice.cell_of_voxel.size());
    lattice.cell_of_voxel.push_back(static_cast<std::uint32_t>(cell));
    lattice.fill.push_back(fill_of(claims.inside[cell]));
  }
  require_few(lattice.cell_of_voxel.size(), grid.edge_m);
  return lattice;
}

std::vector<Lattice> make_lattices(std::vector<Claims>& levels, const std::vector<Vec>& points_m,
                                   const std::vector<std::vector<std::uint8_t>>& absent) {
  const auto is_place = [&](std::size_t level, std::size_t cell) {
    return absent[level].empty() || absent[level][cell] == 0;
  };
  std::vector<std::vector<Vec>> without(levels.size());  // points that no voxel holds yet
  for (const Vec& point_m : points_m) {
    bool held = false;
    std::size_t own = 0;
    for (std::size_t level = 0; level < levels.size() && !held; ++level) {
      const Claims& claims = levels[level];
      held = is_held(claims.grid, point_m, [&](std::size_t cell) {
        return is_kept(claims, cell) && is_place(level, cell);
      });
      if (is_place(level, cell_of(claims.grid, point_m))) own = level;
    }
    if (!held) without[own].push_back(point_m);
  }
  std::vector<Lattice> lattices;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    lattices.push_back(make_lattice(levels[level], without[level], absent[level]));
  }
  while (lattices.size() > 1 && lattices.back().cell_of_voxel.empty()) lattices.pop_back();
  require_few(voxel_count(lattices), levels.front().grid.edge_m);
  return lattices;
}

std::size_t voxel_count(std::span<const Lattice> levels) {
  std::size_t count = 0;
  for (const Lattice& level : levels) count += level.cell_of_voxel.size();
  return count;
}

namespace {

// Where a point of the surface is embedded.
struct Seat {
  CellPlace cell;
  std::uint32_t voxel;
};

// `below` points inward from the place. Where inputs are apart, two of their surfaces may lie in a
// cell that has a voxel of only one of them, or on the border between two cells.
template <typename Exists>
std::optional<Seat> seat_of(const Lattice& lattice, Vec at, Vec below, Exists exists) {
  const Grid& grid = lattice.grid;
  const auto cell = find_cell(grid, at, exists);
  if (!cell) return std::nullopt;
  const Seat seat = {*cell, voxel_for(lattice, *cell, at, below)};
  const CellPlace deeper = own_cell(grid, at + below * kDepth);
  if (lattice.sides.empty() || !exists(cell_index(grid, deeper.x, deeper.y, deeper.z))) return seat;
  const Seat other = {deeper, voxel_for(lattice, deeper, at, below)};
  const bool same_side = (lattice.sides[seat.voxel] & lattice.sides[other.voxel]) != 0;
  return same_side ? seat : other;
}

// The level that holds a point, its seat there, and how many voxels the levels before have. The
// level in whose cell it lies comes first, then those that it nearly touches.
struct LevelSeat {
  const Lattice* level;
  Seat seat;
  std::uint32_t before;
};
std::optional<LevelSeat> level_seat(std::span<const Lattice> levels, Vec point_m, Vec below) {
  std::optional<LevelSeat> touched;
  std::uint32_t before = 0;
  for (const Lattice& level : levels) {
    const auto exists = [&](std::size_t cell) { return level.voxel_of_cell[cell] != kNoVoxel; };
    const auto seat = seat_of(level, to_lattice(level.grid, point_m), below, exists);
    const bool is_own = exists(cell_of(level.grid, point_m));
    if (seat && (is_own || !touched)) touched = {&level, *seat, before};
    if (is_own) break;
    before += static_cast<std::uint32_t>(level.cell_of_voxel.size());
  }
  return touched;
}

}  // namespace

Surface embed(std::span<const Lattice> levels, const std::vector<Vec>& points_m,
              const std::vector<Triangle>& triangles) {
  Surface surface;
  const bool one_each = std::ranges::all_of(
      levels, [](const Lattice& each) { return each.shared.empty() && each.sides.empty(); });
  const std::vector<Vec> below =
      one_each ? std::vector<Vec>(points_m.size()) : inward(points_m, triangles);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const auto [level, seat, before] = level_seat(levels, points_m[i], below[i]).value();
    const Grid& grid = level->grid;
    const CellPlace cell = seat.cell;
    const Vec at = to_lattice(grid, points_m[i]);
    surface.vertices.push_back({before + seat.voxel, quantised(at.x - cell.x),
                                quantised(at.y - cell.y), quantised(at.z - cell.z), 0});
    surface.rest_m.push_back(rest_position(grid, cell, surface.vertices.back()));
  }
  for (const Triangle& t : triangles) {
    const Vec sum = surface.rest_m[t[0]] + surface.rest_m[t[1]] + surface.rest_m[t[2]];
    const Vec down = (below[t[0]] + below[t[1]] + below[t[2]]) * (1.0 / 3);
    const auto found = level_seat(levels, sum * (1.0 / 3), down);
    surface.voxel_of.push_back(found ? found->before + found->seat.voxel
                                     : surface.vertices[t[0]].voxel);
  }
  return surface;
}

}  // namespace stylet::offline
