// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/mixed.h"

#include <algorithm>

#include "voxels/cell_walk.h"

namespace stylet::offline {
namespace {

// A voxel, and those of its cell's samples that are inside it.
struct VoxelHere {
  std::uint64_t inside;
  std::uint16_t owner;
  std::uint8_t material, layer;
};

// The material of each sample, from the owners.
OfSamples materials_of(const TissueNumbers& numbers, double edge_m, const CellHere& here,
                       const VoxelHere& voxel) {
  OfSamples material{};
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    const std::uint16_t owner = here.owner[s];
    if (owner == kNoOwner || (voxel.inside >> s & 1U) == 0) {
      material[s] = kNoTissue;
    } else if (is_layered(numbers, owner)) {
      const std::uint8_t layer = layer_at(numbers, here.at[s] * edge_m);
      material[s] = layer == voxel.layer ? voxel.material : numbers.layers[layer].material;
    } else {
      material[s] = owner == voxel.owner ? voxel.material : numbers.of_owner[owner];
    }
  }
  return material;
}

// Finds the material of most of the samples that do not have the voxel's own, and its plane.
bool find_other(const SamplePlaces& places, const OfSamples& material, std::uint8_t own,
                OrganMixed& mixed_out) {
  OfSamples others{};
  const auto end = std::copy_if(material.begin(), material.end(), others.begin(),
                                [own](std::uint16_t m) { return m != own; });
  if (end == others.begin()) return false;
  std::ptrdiff_t most = 0;
  for (auto each = others.begin(); each != end; ++each) {
    const std::ptrdiff_t count = std::count(others.begin(), end, *each);
    if (count < most || (count == most && *each >= mixed_out.material)) continue;
    most = count;
    mixed_out.material = *each;
  }
  std::uint64_t beyond = 0;
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    beyond |= std::uint64_t{material[s] == mixed_out.material} << s;
  }
  const Plane plane = fit_plane(places, beyond);
  mixed_out.nx = static_cast<float>(plane.normal.x);
  mixed_out.ny = static_cast<float>(plane.normal.y);
  mixed_out.nz = static_cast<float>(plane.normal.z);
  mixed_out.limit = static_cast<float>(plane.limit);
  return true;
}

// Calls visit(voxel, its samples) for the voxels of a cell.
template <typename Visit>
void each_voxel(const Lattice& lattice, std::size_t cell, Visit visit) {
  const std::span<const SharedCell> shared = shared_in(lattice, cell);
  if (shared.empty()) visit(lattice.voxel_of_cell[cell], ~std::uint64_t{0});
  for (const SharedCell& each : shared) visit(each.voxel, each.inside);
}

}  // namespace

std::vector<OrganMixed> mixed_voxels(const Claims& claims, const SamplePlaces& places,
                                     const Lattice& lattice, const VoxelTissues& tissues,
                                     const TissueNumbers& numbers) {
  std::vector<OrganMixed> mixed;
  CellWalk(claims, places, numbers).each_cell([&](std::size_t cell, const CellHere& here) {
    each_voxel(lattice, cell, [&](std::uint32_t voxel, std::uint64_t inside) {
      if (voxel == kNoVoxel) return;  // cut away
      const std::uint16_t owner = tissues.owner[voxel];
      const std::uint8_t own = tissues.material[voxel];
      const std::uint8_t layer = voxel_layer(numbers, tissues.layers, cell, owner);
      const OfSamples found =
          materials_of(numbers, claims.grid.edge_m, here, {inside, owner, own, layer});
      OrganMixed two = {voxel, kNoTissue, 0, 0, 0, 0, 0};
      if (find_other(places, found, own, two)) mixed.push_back(two);
    });
  });
  std::sort(mixed.begin(), mixed.end(),
            [](const OrganMixed& a, const OrganMixed& b) { return a.voxel < b.voxel; });
  return mixed;
}

}  // namespace stylet::offline
