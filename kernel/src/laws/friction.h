// SPDX-License-Identifier: Apache-2.0
// Friction of a shaft in tissue: the law, per metre of shaft.
//
// Coulomb friction, static friction that fades over the Stribeck speed, and a viscous part:
//     f(v) = f_c + (f_s - f_c) exp(-(v / v_s)^2) + f_v v.
// Speeds have no sign; the return map knows the direction.
//
// Promises: no branch on hardware, no allocation; same bits everywhere. Units SI.
// Source: Okamura, Simone, O'Leary 2004 (needle friction by the modified Karnopp model); Stribeck's
// curve as in Armstrong-Helouvry, Dupont, Canudas de Wit 1994. PHYSICS 12.1.
//
// To change it (kernel/own_law.md): another law with these numbers changes friction_n_per_m and
// least_friction_n_per_m. One more number is also a line of the list below, and if no material has
// it yet, a line in stylet/material.h. A law that a tissue chooses is added to the first: each law
// has lines of its own in the list, whose forces are 0 in tissues of the other law. So a shaft in
// two tissues has each law on its part of the length. (A choice by name would have no mean over the
// two.) tests/unit/add_law_test.py finds the two functions by the text of their first lines: change
// its LAW and LEAST together with them.
#pragma once

#include "base/math.h"
#include "stylet/material.h"

namespace stylet {

// F(number, is_force, of): a number of the friction of a metre of shaft; whether it is a force, or
// one per speed, so that it grows in proportion to friction; how it follows from the material m.
// None is below 0. Along a shaft in several tissues each is the mean over the length, begun with 0.
// So the Stribeck speed, by which the law divides, is there as its inverse.
#define STYLET_FRICTION_NUMBERS(F)                                    \
  F(coulomb_n_per_m, true, m.coulomb_friction_n_per_m)                \
  F(static_n_per_m, true, m.static_friction_n_per_m)                  \
  F(inverse_stribeck_s_per_m, false, 1 / m.stribeck_velocity_m_per_s) \
  F(viscous_n_s_per_m2, true, m.viscous_friction_n_s_per_m2)

#define STYLET_FRICTION_FIELD(number, is_force, of) float number;
struct Friction {
  STYLET_FRICTION_NUMBERS(STYLET_FRICTION_FIELD)
};
#undef STYLET_FRICTION_FIELD

#define STYLET_FRICTION_PLACE(number, is_force, of) &Friction::number,
inline constexpr float Friction::*kFrictionNumbers[] = {
    STYLET_FRICTION_NUMBERS(STYLET_FRICTION_PLACE)};
#undef STYLET_FRICTION_PLACE

// Of the material, its forces multiplied by the factor.
#define STYLET_FRICTION_OF(number, is_force, of) (is_force ? factor : 1.0F) * (of),
inline Friction friction_of(const Material& m, float factor = 1) {
  return {STYLET_FRICTION_NUMBERS(STYLET_FRICTION_OF)};
}
#undef STYLET_FRICTION_OF

// The same dependence on speed for another Coulomb friction; a tissue that has none written gets
// it at any speed, besides what is viscous.
inline Friction friction_with_coulomb(Material m, float coulomb_n_per_m) {
  if (m.coulomb_friction_n_per_m > 0) {
    return friction_of(m, coulomb_n_per_m / m.coulomb_friction_n_per_m);
  }
  m.static_friction_n_per_m = m.coulomb_friction_n_per_m = coulomb_n_per_m;
  return friction_of(m);
}

// Friction per metre of shaft at a slip speed: Coulomb, static (Stribeck), viscous.
inline float friction_n_per_m(const Friction& f, float speed_m_per_s) {
  const float s = speed_m_per_s * f.inverse_stribeck_s_per_m;
  return f.coulomb_n_per_m +
         (f.static_n_per_m - f.coulomb_n_per_m) * exp_minus(min_of(s * s, 80.0F)) +
         f.viscous_n_s_per_m2 * speed_m_per_s;
}

// Its least value over all speeds, because no static friction is below Coulomb's. A particle with a
// smaller force sticks, whatever the law.
inline float least_friction_n_per_m(const Friction& f) {
  return f.coulomb_n_per_m;
}

// The mean over a length, of which `part` has the friction `next`.
#define STYLET_FRICTION_MEAN(number, is_force, of) mean.number + part*(next.number - mean.number),
inline Friction mixed(const Friction& mean, const Friction& next, float part) {
  return {STYLET_FRICTION_NUMBERS(STYLET_FRICTION_MEAN)};
}
#undef STYLET_FRICTION_MEAN

}  // namespace stylet
