// SPDX-License-Identifier: Apache-2.0
// Puncture, cutting and friction of a needle in a tissue, computed once for each pair of them.
//
// Written forces are used as they are. If a tissue has a toughness J, forces follow from that. The
// tip tears a crack of the length c and the shank spreads it to a hole as wide as itself (Shergold
// and Fleck 2004; Azar and Hayward 2008; Barnett, Lee, Moore 2015):
//   F_c = J c + F_h (1 + mu cot(alpha)),   F_h = (pi / 4) E* a^2.
// F_h is the energy of a straight crack in linear elasticity (plane strain), under an even pressure
// p = E* / 2 at which it is an ellipse as wide as it is long: the needle's section, for a crack as
// long as the needle is wide. The cone of half angle alpha rubs at that pressure as it goes in.
// Friction per length of shaft is mu p 2 pi a. In an existing hole nothing is torn.
//
// A surface is punctured when pressing it in has taken as much work as cutting to that depth would
// have, U(d) = F_c d (Fregonese and Bacca 2021): with the law of contact (cone.h) at 2 to 3 times
// F_c, by the film's power law (film.h) at 8/3 of it.
//
// A shaft that is dragged sideways cuts as a wire does (Kamyab, Chakrabarti, Williams 1998): per
// length of it J + (1 + mu) sigma d, where sigma, the stress at which the wire parts its material,
// is taken to be that pressure p. Its tip cuts aside at F_c, as ahead.
//
// Promises: no allocation, no branch on hardware. Units SI. PHYSICS 9.6.
#pragma once

#include <cmath>

#include "base/math.h"
#include "laws/cone.h"
#include "laws/film.h"
#include "laws/friction.h"
#include "laws/stiff_tip.h"
#include "stylet/kernel.h"

namespace stylet {

// Speed for which a material's puncture force and its toughness are given.
constexpr float kGivenSpeedMPerS = 0.01F;

struct NeedleForces {
  float puncture_n;  // breaks the surface of an organ
  float layer_n;     // the same of a tissue behind another
  float cutting_n;   // at the tip in fresh tissue; of it `tearing_n` goes with speed
  float tearing_n, tearing_exponent;
  float recut_n;           // at the tip in a track
  float sideways_n_per_m;  // per length of shaft; 0: neither shaft nor tip cuts sideways
  Friction friction;
  Film film;  // where contact follows the thin skin
};

// A speed over the given one, as far as powers of it are taken.
inline float relative_speed(float speed_m_per_s) {
  constexpr float kSlowest = 0.01F, kFastest = 100.0F;
  return clamp(speed_m_per_s / kGivenSpeedMPerS, kSlowest, kFastest);
}

// E* of a tissue without its skin.
inline float plane_modulus_pa(const Material& m) {
  return m.youngs_modulus_pa / (1 - m.poisson_ratio * m.poisson_ratio);
}

inline float circumference_m(float radius_m) {
  constexpr float kPi = 3.14159265F;
  return 2 * kPi * radius_m;
}

// On the shaft, of tissue that was torn open for it.
inline float shaft_pressure_pa(float plane_pa) {
  return 0.5F * plane_pa;
}

// Work per length of opening a crack to a hole of this radius: half of pressure times area.
inline float spreading_n(float plane_pa, float radius_m) {
  return 0.25F * shaft_pressure_pa(plane_pa) * circumference_m(radius_m) * radius_m;
}

// Friction of that opening on a cone, over its work. `cone_m`: see cone_length_m.
inline float cone_friction(float coefficient, float radius_m, float cone_m) {
  return coefficient * cone_cotangent(radius_m, cone_m);
}

// The force at which the work of the contact, over its depth, is `cutting_n`: see cone.h.
inline float piercing_n(float cutting_n, float punch_n_per_m, float cone_m) {
  const float far_m = cutting_n / punch_n_per_m;
  if (6 * far_m <= cone_m) return 3 * cutting_n;  // contact is still narrower than the needle
  const float sum_m = cone_m + 2 * far_m;
  const float depth_m = 0.5F * (sum_m + std::sqrt(sum_m * sum_m - 4.0F / 3 * cone_m * cone_m));
  return punch_n_per_m * (depth_m - 0.5F * cone_m);
}

// The same under a thin skin, where force goes as depth^(5/3).
inline float film_piercing_n(float cutting_n) {
  return 8.0F / 3 * cutting_n;
}

// The numbers that follow from a toughness instead of the written ones.
inline void tear(const Material& m, const NeedleConfig& needle, float cone_m, NeedleForces& out) {
  const float plane_pa = plane_modulus_pa(m), radius_m = needle.outer_radius_m;
  const float torn_m = needle.torn_diameters * (2 * radius_m);
  const float spread_n = spreading_n(plane_pa, radius_m) *
                         (1 + cone_friction(m.needle_friction_coefficient, radius_m, cone_m));
  out.recut_n = min_of(spread_n, kMaxTipForceN);
  out.cutting_n = min_of(m.fracture_toughness_j_per_m2 * torn_m + spread_n, kMaxTipForceN);
  out.tearing_n = out.cutting_n - out.recut_n;
  out.tearing_exponent = m.toughness_velocity_exponent;
  out.sideways_n_per_m =
      min_of(m.fracture_toughness_j_per_m2 +
                 (1 + m.needle_friction_coefficient) * shaft_pressure_pa(plane_pa) * (2 * radius_m),
             kMaxFrictionNPerM);
  // Tissue that stiffens presses back by the same law of contact as in wanted_punch.
  const StifferTip stiffer =
      stiffer_tip(m.strain_stiffening, cone_cotangent(radius_m, cone_m), m.poisson_ratio);
  const bool skin = m.membrane_n_per_m > 0;
  const float pierced_n = skin ? film_piercing_n(out.cutting_n)
                               : piercing_n(out.cutting_n, 2 * radius_m * plane_pa * stiffer.deep,
                                            cone_m * (stiffer.deep / stiffer.shallow));
  out.puncture_n = min_of(pierced_n, kMaxTipForceN);
  // For a tip that comes from other tissue the crack already exists. A skin is still whole.
  out.layer_n = skin ? out.puncture_n : out.cutting_n;
}

// `cone_m`: that of the needle, cone_length_m.
inline NeedleForces needle_forces(const Material& m, const NeedleConfig& needle, float cone_m) {
  NeedleForces out = {};
  out.puncture_n = out.layer_n = m.puncture_force_n;
  out.cutting_n = m.cutting_force_n;
  out.recut_n = m.cutting_force_n * m.recut_fraction;
  out.friction = friction_of(m);
  if (m.fracture_toughness_j_per_m2 > 0) tear(m, needle, cone_m, out);
  if (m.needle_friction_coefficient > 0) {
    const float pressed_n_per_m = m.needle_friction_coefficient *
                                  shaft_pressure_pa(plane_modulus_pa(m)) *
                                  circumference_m(needle.outer_radius_m);
    out.friction = friction_with_coulomb(m, min_of(pressed_n_per_m, kMaxFrictionNPerM));
  }
  if (m.membrane_n_per_m > 0) {
    out.film = film_at(plane_modulus_pa(m), m.membrane_n_per_m, out.puncture_n);
  }
  return out;
}

// At the tip in fresh tissue, for a tip that has lately moved on at this speed.
inline float cutting_n(const NeedleForces& forces, float speed_m_per_s) {
  if (!(forces.tearing_exponent > 0)) return forces.cutting_n;
  const float faster = power(relative_speed(speed_m_per_s), forces.tearing_exponent);
  return min_of(forces.recut_n + forces.tearing_n * faster, kMaxTipForceN);
}

}  // namespace stylet
