// SPDX-License-Identifier: Apache-2.0
// A material, and the list of its numbers: fields, limits, and how a table of tissues spells them.
//
// Promises: organ_open refuses a number outside its limits and names it, with its value. From the
// list follow the fields of Material and what organ_open reads and checks; in offline, the keys of
// a tissue's table, the numbers in the file and the output of `info`. The schema (organ.fbs) has
// the same fields in the same order; a test compares the two. material_model in kernel.cpp and
// PHYSICS 4.1 say what each number does. Units: SI; the units of keys are in their names.
#pragma once

#include "stylet/limits.h"

namespace stylet {

// F(field, least, most, expected, key, si_per_unit, must_be_given): the field; its limits; the
// limits in words, for a refusal; the key in a tissue's table, and the number of SI units in one
// unit of the key; whether the table of a new tissue must have the key (otherwise it is 0). A new
// number is added at the end, and 0 must be within its limits, because files from before it have 0.
#define STYLET_MATERIAL_NUMBERS(F)                                                                 \
  F(density_kg_per_m3, 1, 20000, "1 to 20000", "density_kg_per_m3", 1, true)                       \
  F(youngs_modulus_pa, kMinYoungsModulusPa, kMaxYoungsModulusPa, "1 to 1e9", "youngs_modulus_kpa", \
    1e3, true)                                                                                     \
  F(poisson_ratio, 0, kMaxPoissonRatio, "0 to 0.49", "poisson_ratio", 1, true)                     \
  /* part of the force that decays while held */                                                   \
  F(relaxing_fraction, 0, 0.95F, "0 to 0.95", "relaxing_fraction", 1, true)                        \
  F(relaxation_time_s, 1e-3F, 1e5F, "0.001 to 1e5", "relaxation_time_s", 1, true)                  \
  /* to enter this material, from outside or from another */                                       \
  F(puncture_force_n, 0, kMaxTipForceN, "0 to 1000", "puncture_force_n", 1, true)                  \
  /* at the tip while it advances; the part of it in a track that is there already */              \
  F(cutting_force_n, 0, kMaxTipForceN, "0 to 1000", "cutting_force_n", 1, true)                    \
  F(recut_fraction, 0, 1, "0 to 1", "recut_fraction", 1, true)                                     \
  /* per metre of shaft: Coulomb friction; static friction, at least the Coulomb friction */       \
  F(coulomb_friction_n_per_m, 0, kMaxFrictionNPerM, "0 to 1e4", "coulomb_friction_n_per_mm", 1e3,  \
    true)                                                                                          \
  F(static_friction_n_per_m, 0, kMaxFrictionNPerM, "coulomb_friction_n_per_m to 1e4",              \
    "static_friction_n_per_mm", 1e3, true)                                                         \
  F(stribeck_velocity_m_per_s, 1e-6F, 10, "1e-6 to 10", "stribeck_velocity_mm_per_s", 1e-3, true)  \
  F(viscous_friction_n_s_per_m2, 0, 1e6F, "0 to 1e6", "viscous_friction_n_s_per_m2", 1, true)      \
  /* m: puncture takes force (v / 10 mm/s)^-m; most tissues' hardly depends on speed */            \
  F(puncture_velocity_exponent, 0, 0.5F, "0 to 0.5", "puncture_velocity_exponent", 1, false)       \
  /* modulus times thickness of a thin skin, which a surface voxel carries besides its own */      \
  /* stiffness: it adds membrane_n_per_m / (voxel edge) to the voxel's modulus */                  \
  F(membrane_n_per_m, 0, kMaxMembraneNPerM, "0 to 1e5", "membrane_n_per_mm", 1e3, false)           \
  /* how fast the shear modulus grows with the square of the strain (PHYSICS 2.7) */               \
  F(strain_stiffening, 0, kMaxStrainStiffening, "0 to 1000", "strain_stiffening", 1, false)        \
  /* what a new surface takes: above 0, puncture and cutting follow from it and the needle */      \
  /* instead of the forces above; n: tearing takes (v / 10 mm/s)^n of it */                        \
  F(fracture_toughness_j_per_m2, 0, kMaxToughnessJPerM2, "0 to 1e5",                               \
    "fracture_toughness_j_per_m2", 1, false)                                                       \
  F(toughness_velocity_exponent, 0, 0.5F, "0 to 0.5", "toughness_velocity_exponent", 1, false)     \
  /* of steel on it: above 0, friction follows from it and the pressure on the shaft, and the */   \
  /* friction above only says how it depends on speed */                                           \
  F(needle_friction_coefficient, 0, 2, "0 to 2", "needle_friction_coefficient", 1, false)          \
  /* of fluid in it: above the air's pressure; what flows per pressure, to or from a needle's */   \
  /* opening: 0, nothing; viscosity: 0, that of what the needle is filled with */                  \
  F(fluid_pressure_pa, kMinFluidPa, kMaxFluidPa, "-5e4 to 1e5", "fluid_pressure_kpa", 1e3, false)  \
  F(fluid_conductance_m3_per_pa_s, 0, kMaxConductanceM3PerPaS, "0 to 1e-4",                        \
    "fluid_conductance_mm3_per_s_kpa", 1e-12, false)                                               \
  F(fluid_viscosity_pa_s, 0, kMaxViscosityPaS, "0 to 10", "fluid_viscosity_mpa_s", 1e-3, false)

#define STYLET_MATERIAL_FIELD(field, ...) float field;
struct Material {
  const char* name;
  const char* source;  // where the numbers come from
  STYLET_MATERIAL_NUMBERS(STYLET_MATERIAL_FIELD)
};
#undef STYLET_MATERIAL_FIELD

struct MaterialNumber {
  const char* name;  // of the field
  float Material::*field;
  float least, most;
  const char* expected;
  const char* key;
  double si_per_unit;
  bool must_be_given;
};

#define STYLET_MATERIAL_NUMBER(field, least, most, expected, key, si_per_unit, must_be_given) \
  {#field, &Material::field, least, most, expected, key, si_per_unit, must_be_given},
inline constexpr MaterialNumber kMaterialNumbers[] = {
    STYLET_MATERIAL_NUMBERS(STYLET_MATERIAL_NUMBER)};
#undef STYLET_MATERIAL_NUMBER

}  // namespace stylet
