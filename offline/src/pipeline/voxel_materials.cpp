// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/voxel_materials.h"

#include "base/refusal.h"
#include "pipeline/slides.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

// Whether a cell across one of the faces has one of the wanted tissues.
bool touches(const Claims& claims, std::size_t cell, const std::vector<std::string>& tissues,
             const std::vector<std::string>& wanted) {
  const Grid& grid = claims.grid;
  const std::size_t steps[3] = {1, grid.size[0], std::size_t{grid.size[0]} * grid.size[1]};
  for (std::size_t axis = 0; axis < 3 && !wanted.empty(); ++axis) {
    const std::size_t at = cell / steps[axis] % grid.size[axis];
    for (const bool high : {false, true}) {
      if (high ? at + 1 == grid.size[axis] : at == 0) continue;
      const std::size_t next = high ? cell + steps[axis] : cell - steps[axis];
      if (is_kept(claims, next) &&
          std::find(wanted.begin(), wanted.end(), tissues[claims.owner[next]]) != wanted.end()) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::uint8_t number_of(MaterialList& list, const Tissue& wanted) {
  for (std::size_t i = 0; i < list.tissues.size(); ++i) {
    const Tissue& there = list.tissues[i];
    if (there.name == wanted.name && there.youngs_modulus_pa == wanted.youngs_modulus_pa) {
      return static_cast<std::uint8_t>(i);
    }
  }
  if (list.tissues.size() >= kMaxMaterials) refuse("more than {} tissues", kMaxMaterials);
  list.tissues.push_back(wanted);
  return static_cast<std::uint8_t>(list.tissues.size() - 1);
}

TissueNumbers number_tissues(const std::vector<std::string>& tissues, const BuildOptions& options,
                             double edge_m, MaterialList& list) {
  TissueNumbers numbers;
  numbers.course = options.layer_course;
  const std::string& of = options.layer_course.of;
  for (const std::string& tissue : tissues) {
    const bool layered = !options.layers.empty() && (of.empty() || of == tissue);
    numbers.is_layered.push_back(layered);
    numbers.of_owner.push_back(layered ? std::uint8_t{0}
                                       : number_of(list, find_tissue(list.own, tissue)));
  }
  for (const Layer& layer : options.layers) {
    const Tissue tissue = in_layer(find_tissue(list.own, layer.tissue), layer.thickness_m, edge_m);
    numbers.layers.push_back({layer.thickness_m, number_of(list, tissue)});
  }
  return numbers;
}

VoxelMaterials voxel_materials(const Claims& claims, const Lattice& lattice,
                               const std::vector<std::uint16_t>& owner_of_voxel,
                               const std::vector<std::string>& tissues,
                               const TissueNumbers& numbers,
                               const std::vector<std::uint8_t>& layers, const BuildOptions& options,
                               MaterialList& list) {
  const std::uint8_t capsule =
      options.capsule.empty() ? 0 : number_of(list, find_tissue(list.own, options.capsule));
  const Grid& grid = lattice.grid;
  const ApartOwners apart = apart_owners(options.slides, tissues);
  VoxelMaterials of_voxel;
  for (std::size_t voxel = 0; voxel < lattice.cell_of_voxel.size(); ++voxel) {
    const std::uint32_t cell = lattice.cell_of_voxel[voxel];
    const std::uint16_t owner = owner_of_voxel[voxel];
    const std::uint32_t x = cell % grid.size[0], row = cell / grid.size[0];
    const bool has_capsule = !options.capsule.empty() &&
                             (options.capsule_of.empty() || options.capsule_of == tissues[owner]);
    const bool is_capsule =
        has_capsule && (is_skin(claims, x, row % grid.size[1], row / grid.size[1]) ||
                        meets_apart(lattice, static_cast<std::uint32_t>(voxel), apart) ||
                        touches(claims, cell, tissues, options.wall));
    const std::uint8_t layer = voxel_layer(numbers, layers, cell, owner);
    const std::uint8_t given =
        layer != kNotLayered ? numbers.layers[layer].material : numbers.of_owner[owner];
    of_voxel.given.push_back(given);
    of_voxel.material.push_back(is_capsule ? capsule : given);
  }
  return of_voxel;
}

}  // namespace stylet::offline
