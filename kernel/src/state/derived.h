// SPDX-License-Identifier: Apache-2.0
// What creation derives from organ and configuration, once, for the tick to read: materials, rules,
// levels.
//
// Promises: plain structs. Units SI.
#pragma once

#include <cstdint>

#include "stylet/limits.h"

namespace stylet {

// What the voxels of one level are made of, the thin skin spread over the voxel.
struct LatticeMaterial {
  float shear_pa, volume_ratio;  // shear modulus; lambda over twice the shear modulus
};

// What the tick needs to know of a material; derived once.
struct MaterialModel {
  float shear_pa, poisson_ratio;               // without its thin skin
  float skin_shear_n_per_m;                    // of the skin: modulus times thickness
  LatticeMaterial lattice[kMaxLevels];         // of each level
  float stiffening;                            // exponent b of strain stiffening; 0: none
  float puncture_exponent;                     // of the speed
  float relaxing_fraction, relaxation_time_s;  // of its forces
  float real_kg, stepped_kg;                   // of its voxels; with the mass that the step adds
};

// Where the paper's rules differ from the physical model (PHYSICS 16). Filled once from
// Config::mode: functions ask for the rule, not for the mode.
struct Rules {
  bool one_support;       // one voxel holds a CP; else the eight around it, and those of two layers
  bool voxel_springs;     // a CP's spring is its voxel's; else what the lattice leaves to it
  bool relaxes;           // a CP's force relaxes, and its spring has a compliance along the needle
  bool contact_law;       // contact follows the law of cone and film; else a CP's spring
  bool unit_punctures;    // a surface breaks once a needle unit is inside; else at its force
  bool layer_punctures;   // layers inside must be punctured, too
  bool unit_slips;        // a CP moves by whole needle units; else exactly back to its limit
  bool slips_again;       // CPs slip once more after the tissue's step
  bool planes_in_voxels;  // a voxel where two tissues meet knows the plane between them
};

// One level of the lattice; level 0 is the coarsest, each has half the edge of the one before.
struct Level {
  float edge_m, inverse_edge_per_m;   // of its voxels
  std::uint32_t first_plane, planes;  // voxel planes in the lattice (stylet/levels.h)
};

}  // namespace stylet
