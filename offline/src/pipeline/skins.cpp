// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/skins.h"

#include <algorithm>

#include "pipeline/membranes.h"

namespace stylet::offline {
namespace {

// How far the surface is moved inward, in edges: a face between two cells belongs to the inner one.
// Less than what still counts as touching a cell.
constexpr double kInset = 1e-3;

Mesh moved_inward(const Mesh& surface_m, double way_m) {
  Mesh out;
  for (const Triangle& t : surface_m.triangles) {
    const Vec a = surface_m.points[t[0]], b = surface_m.points[t[1]], c = surface_m.points[t[2]];
    const Vec across = cross(b - a, c - a);
    const double twice_area = length(across);
    if (!(twice_area > 0)) continue;
    const Vec move = across * (-way_m / twice_area);
    const auto first = static_cast<std::uint32_t>(out.points.size());
    for (const Vec& p : {a, b, c}) out.points.push_back(p + move);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

std::vector<std::uint32_t> voxels_in(const Lattice& level, std::size_t cell) {
  std::vector<std::uint32_t> voxels;
  for (const SharedCell& each : shared_in(level, cell)) voxels.push_back(each.voxel);
  if (voxels.empty() && level.voxel_of_cell[cell] != kNoVoxel) {
    voxels.push_back(level.voxel_of_cell[cell]);
  }
  return voxels;
}

}  // namespace

std::vector<OrganSkin> place_skins(const Mesh& surface_m, std::span<const Lattice> levels,
                                   std::span<const std::uint8_t> material_of_voxel,
                                   const std::vector<Tissue>& materials) {
  std::vector<OrganSkin> skins;
  const auto has_skin = [](const Tissue& tissue) { return tissue.membrane_n_per_m > 0; };
  if (std::ranges::none_of(materials, has_skin)) return skins;
  std::uint32_t first_voxel = 0;
  for (const Lattice& level : levels) {
    const Grid& grid = level.grid;
    const Mesh inside_m = moved_inward(surface_m, kInset * grid.edge_m);
    const MembraneLists lists = list_membranes({{inside_m, 0}}, cells_of(grid));
    for (const OrganMembraneCell& cell : lists.cells) {
      std::vector<std::uint32_t> voxels =
          voxels_in(level, cell_index(grid, cell.x, cell.y, cell.z));
      std::erase_if(voxels, [&](std::uint32_t voxel) {
        return !has_skin(materials[material_of_voxel[first_voxel + voxel]]);
      });
      for (const std::uint32_t voxel : voxels) {
        skins.push_back({first_voxel + voxel, cell.area / static_cast<float>(voxels.size())});
      }
    }
    first_voxel += static_cast<std::uint32_t>(level.fill.size());
  }
  std::ranges::sort(skins, {}, &OrganSkin::voxel);
  return skins;
}

}  // namespace stylet::offline
