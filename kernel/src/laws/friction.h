// SPDX-License-Identifier: Apache-2.0
// Friction of a shaft in tissue: the law, per metre of shaft.
//
// Coulomb friction, static friction that fades over the Stribeck speed, and a viscous part:
//     f(v) = f_c + (f_s - f_c) exp(-(v / v_s)^2) + c v.
// Speeds have no sign; the return map knows the direction. Another law with these numbers changes
// friction_n_per_m and least_friction_n_per_m. One more number is also one more field of Friction,
// its mean in `mixed`, its source in material_model (kernel.cpp) and its bounds in snapshot.cpp.
//
// Promises: no branch on hardware, no allocation; same bits everywhere. Units SI.
// Source: Okamura, Simone, O'Leary 2004 (needle friction by the modified Karnopp model); Stribeck's
// curve as in Armstrong-Helouvry, Dupont, Canudas de Wit 1994. PHYSICS 12.1.
#pragma once

#include "base/math.h"

namespace stylet {

// Friction of a shaft, per metre of it.
struct Friction {
  float coulomb_n_per_m, static_n_per_m, inverse_stribeck_s_per_m, viscous_n_s_per_m2;
};

// Friction per metre of shaft at a slip speed: Coulomb, static (Stribeck), viscous.
inline float friction_n_per_m(const Friction& f, float speed_m_per_s) {
  const float s = speed_m_per_s * f.inverse_stribeck_s_per_m;
  return f.coulomb_n_per_m +
         (f.static_n_per_m - f.coulomb_n_per_m) * exp_minus(min_of(s * s, 80.0F)) +
         f.viscous_n_s_per_m2 * speed_m_per_s;
}

// Its least value (no material's static friction is below Coulomb's): a smaller force needs no look
// at the law.
inline float least_friction_n_per_m(const Friction& f) {
  return f.coulomb_n_per_m;
}

// The mean over a length, of which `part` has the friction `next`.
inline Friction mixed(const Friction& mean, const Friction& next, float part) {
  const auto towards = [part](float from, float to) { return from + part * (to - from); };
  return {towards(mean.coulomb_n_per_m, next.coulomb_n_per_m),
          towards(mean.static_n_per_m, next.static_n_per_m),
          towards(mean.inverse_stribeck_s_per_m, next.inverse_stribeck_s_per_m),
          towards(mean.viscous_n_s_per_m2, next.viscous_n_s_per_m2)};
}

}  // namespace stylet
