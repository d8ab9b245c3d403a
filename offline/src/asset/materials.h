// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues by name: the presets, and those of the user's TOML file, which take precedence.
//
// Promises: a file is accepted whole, or refused with `file:line: key: ...` and what is allowed.
// Units: SI here; the keys of the TOML file name their own units.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stylet::offline {

struct Tissue {
  std::string name;
  std::string source;  // where the numbers come from
  double density_kg_per_m3 = 0;
  double youngs_modulus_pa = 0;
  double poisson_ratio = 0;
  double relaxing_fraction = 0;
  double relaxation_time_s = 0;
  double puncture_force_n = 0;
  double cutting_force_n = 0;
  double recut_fraction = 0;
  double coulomb_friction_n_per_m = 0;
  double static_friction_n_per_m = 0;
  double stribeck_velocity_m_per_s = 0;
  double viscous_friction_n_s_per_m2 = 0;
  // Tension stiffness of a thin skin (modulus times thickness), carried by a surface voxel besides
  // its own stiffness; it adds membrane_n_per_m / (voxel edge) to the voxel's modulus.
  double membrane_n_per_m = 0;
  double puncture_velocity_exponent = 0;  // force falls with speed as (v / 10 mm/s)^-m
};

const std::vector<Tissue>& preset_tissues();

// One table per tissue. A table named like a preset replaces it; keys left out keep its values.
std::vector<Tissue> read_tissues(const std::filesystem::path& toml_file);

// Refuses an unknown name and lists the known ones.
const Tissue& find_tissue(const std::vector<Tissue>& own, const std::string& name);

// A tissue in a layer of this thickness. The kernel spreads a tissue's membrane over one voxel. In
// a layer of several voxels each voxel would carry the whole membrane, so here the membrane is
// spread over the layer and becomes part of the modulus. (Giving it to the layer's first voxels
// only was tried: they are partly filled and form stairs, and a sloping layer lost its membrane as
// voxels became finer.)
Tissue in_layer(Tissue tissue, double thickness_m, double edge_m);

}  // namespace stylet::offline
