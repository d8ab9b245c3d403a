// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues by name: the presets, and those of the user's TOML file, which come first.
//
// Promises: a file is taken whole or refused with `file:line: key: ...` naming what is allowed.
// Units: SI here; the keys of the TOML file carry theirs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stylet::bake {

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
  // Tension stiffness of a thin skin (modulus times thickness) that a surface voxel carries besides
  // its own; spread over the voxel it adds this over the voxel's edge to the modulus.
  double membrane_n_per_m = 0;
  double puncture_velocity_exponent = 0;  // force falls with speed as (v / 10 mm/s)^-m
};

const std::vector<Tissue>& preset_tissues();

// One table per tissue; a name that is also a preset replaces it, keys left out keep its values.
std::vector<Tissue> read_tissues(const std::filesystem::path& toml_file);

// Refuses an unknown name and lists the known ones.
const Tissue& find_tissue(const std::vector<Tissue>& own, const std::string& name);

// A tissue in a layer of this thickness. Its membrane (modulus times thickness of a thin skin) is
// spread over the voxel by the kernel, and in a layer of several voxels each would carry it all; so
// there it is spread over the layer here, and is part of the modulus. (Only the layer's first
// voxels with it was tried: they are partly filled and form stairs, and a slope lost its membrane
// as voxels became finer.)
Tissue in_layer(Tissue tissue, double thickness_m, double edge_m);

}  // namespace stylet::bake
