// SPDX-License-Identifier: Apache-2.0
// The tip in contact: a cone that becomes a cylinder, and the relaxation of the tissue under it.
//
// Contact widens as the cone sinks in, until at the depth l it is as wide as the needle. From there
// on the law is that of a flat punch (Sneddon 1965: rigid, frictionless, on a half space). With the
// punch's stiffness k = 2 a E / (1 - nu^2) and l = pi a / (2 tan(half angle)):
//   F(d) = k d^2 / (2 l),  U(d) = k d^3 / (6 l)                          up to d = l,
//   F(d) = k (d - l / 2),  U(d) = k (d^2 / 2 - l d / 2 + l^2 / 6)        beyond.
// A thin skin resists its point from the start (film.h): there a part s of k is a plain spring,
// k s d, and the rest that cone. Below, 1 - s and s are left out.
//
// This is the law of all the tissue. The lattice gives way by itself, by a part c of the punch's
// 1 / k. The tip's own spring keeps y = d - c F(d) / k: the same force at a smaller depth, with
// the energy U(d) - c F^2 / (2 k). A cone of its own for the spring made the whole law depend on
// the voxel.
//
// Under larger forces the lattice gives way faster: by c / k (F + g F^2) up to a force F_end, and
// beyond it with the slope at F_end. To first order in g the spring then carries F + c w / (1 - c
// w) g F^2, with F as above and w = min(d / l, 1), and stores c / k g F^3 / 3 more.
//
// Relaxed, the whole law is that of a cone with (1 - phi) k. The lattice does not relax, so the
// spring's relaxed law is what the lattice leaves of that cone, with the part (1 - phi) c. Q(y) is
// the difference of the spring's two laws. The missing force q follows Q in time (as in Fung's
// quasi-linear law), and the spring carries F - q. If z is the depth with Q(z) = q, the spring's
// energy is U(y) - (U_Q(z) + q (y - z)), which creep can only lower. As vectors, F and Q point
// along the displacement they belong to.
//
// Promises: no branch on hardware, no allocation. Units SI. PHYSICS 8.1.
#pragma once

#include "base/math.h"
#include "stylet/kernel.h"

namespace stylet {

struct Cone {
  float stiffness_n_per_m;  // of the punch on all the tissue, k
  float length_m;           // l
  float lattice_part;       // c, below 1
  float growth_per_n;       // g
  float growth_end_n;       // F_end
  float start;              // s, below 1
};

// pi a / (2 tan(half angle)) of a needle's tip.
inline float cone_length_m(const NeedleConfig& needle) {
  constexpr float kPi = 3.14159265F;
  const float half_turns = needle.tip_half_angle_rad / kPi;
  const float cosine = sine_of_half_turns(0.5F - half_turns);
  return 0.5F * kPi * needle.outer_radius_m * cosine / sine_of_half_turns(half_turns);
}

// Of the half angle, from that length.
inline float cone_cotangent(float radius_m, float cone_m) {
  constexpr float kPi = 3.14159265F;
  return 2 * cone_m / (kPi * radius_m);
}

// Depth of all the tissue over the spring's own depth, at least 1.
inline float cone_ratio(const Cone& c, float own_m) {
  const float l = c.length_m, part = c.lattice_part, rest = 1 - c.start;
  if (own_m > (1 - 0.5F * part * (1 + c.start)) * l) {
    return (own_m - 0.5F * part * rest * l) / ((1 - part) * own_m);
  }
  const float left = 1 - part * c.start;
  return 2 / (left + std::sqrt(left * left - 2 * part * rest * (own_m / l)));
}

// Width of contact at that depth, over the needle's width: the slope of F over k.
inline float cone_width(const Cone& c, float own_m) {
  return c.start + (1 - c.start) * min_of(cone_ratio(c, own_m) * own_m / c.length_m, 1);
}

// F over the spring's own depth.
inline float cone_secant(const Cone& c, float own_m) {
  const float ratio = cone_ratio(c, own_m), depth = ratio * own_m;
  const float width = min_of(depth / c.length_m, 1), whole = c.stiffness_n_per_m * ratio;
  const float cone = whole * width * (1 - 0.5F * c.length_m / max_of(depth, c.length_m));
  return c.start * whole + (1 - c.start) * cone;
}

// Force of the spring at that depth, over F: more where the lattice has given way more.
inline float cone_growth(const Cone& c, float own_m) {
  const float part = c.lattice_part * cone_width(c, own_m);
  const float force = cone_secant(c, own_m) * own_m, most = min_of(force, c.growth_end_n);
  if (!(force > 0)) return 1;
  return 1 + part / (1 - part) * c.growth_per_n * most * (2 - most / force);
}

// Derivative of that force by the spring's own depth.
inline float cone_tangent(const Cone& c, float own_m) {
  const float width = cone_width(c, own_m), left = 1 - c.lattice_part * width;
  const float force = cone_secant(c, own_m) * own_m, most = min_of(force, c.growth_end_n);
  const float widening = width < 1 ? (1 - c.start) * c.lattice_part * most * (2 * force - most) /
                                         (c.length_m * left * left)
                                   : 0.0F;
  const float slope = c.stiffness_n_per_m * width;
  return (slope + c.growth_per_n * (widening + 2 * most * slope * (1 - left) / left)) / left;
}

// Energy of a spring that carries F.
inline double cone_energy(const Cone& c, float own_m) {
  const float x = cone_ratio(c, own_m) * own_m / c.length_m, width = min_of(x, 1);
  const float cone = width * (0.5F * x * (x - width) + width * width * (1.0F / 6));
  const float whole = c.start * 0.5F * x * x + (1 - c.start) * cone;
  const float force = c.start * x + (1 - c.start) * width * (x - 0.5F * width);  // over k l
  const float unit = c.stiffness_n_per_m * c.length_m * c.length_m;
  return static_cast<double>(unit) *
         static_cast<double>(whole - 0.5F * c.lattice_part * force * force);
}

// Energy of what it carries beyond F.
inline double cone_growth_energy(const Cone& c, float own_m) {
  const float force = cone_secant(c, own_m) * own_m, most = min_of(force, c.growth_end_n);
  const float sum = most * (most * most * (1.0F / 3) + force * (force - most));
  return static_cast<double>(c.lattice_part * c.growth_per_n / c.stiffness_n_per_m * sum);
}

// The immediate force of a contact, and the part of it that relaxes.
struct ContactLaw {
  Cone now, relaxed;
  float fraction;  // phi
};

inline ContactLaw contact_law(const Cone& c, float fraction) {
  const float rest = 1 - fraction;
  Cone relaxed = c;
  relaxed.stiffness_n_per_m = rest * c.stiffness_n_per_m;
  relaxed.lattice_part = rest * c.lattice_part;
  return {c, relaxed, fraction};
}

// Force of the spring over its own depth, with no force missing.
inline float contact_secant(const ContactLaw& law, float own_m) {
  return cone_secant(law.now, own_m) * cone_growth(law.now, own_m);
}

// Q over the spring's own depth.
inline float missing_secant(const ContactLaw& law, float own_m) {
  return cone_secant(law.now, own_m) - cone_secant(law.relaxed, own_m);
}

// The spring's own depth at which Q has this value. With d and e the depths of all the tissue by
// the two laws, Q = (d - e) k / c. Cases: d <= l; else e <= l; else beyond, where Q is linear.
inline float missing_depth(const ContactLaw& law, float missing_n) {
  if (!(missing_n > 0)) return 0;
  const Cone& c = law.now;
  const float l = c.length_m, part = c.lattice_part, left = law.relaxed.lattice_part;
  const float start = c.start, rest = 1 - start, kept = 1 - law.fraction;
  const float q_m = missing_n / c.stiffness_n_per_m, apart_m = part * q_m;
  const float edge_m = (1 - 0.5F * part * (1 + start)) * l;  // where d = l
  if (missing_n <= missing_secant(law, edge_m) * edge_m) {
    const float square = 2 * l * q_m * ((1 - start * part) / rest - part * apart_m / (2 * l));
    const float by = law.fraction * start / rest * l + apart_m;
    const float e = square / (by + std::sqrt(by * by + law.fraction * square));
    return e - left * start * e - rest * left / (2 * l) * e * e;
  }
  if ((1 - part) * q_m <= 0.5F * law.fraction * l * (1 + start)) {
    const float sum = (1 - part) * q_m + 0.5F * rest * l, by = 1 - kept * start;
    const float e = 2 * sum / (by + std::sqrt(by * by - 2 * kept * rest * sum / l));
    return (1 - part) * (e + apart_m) + 0.5F * part * rest * l;
  }
  return 0.5F * rest * l + q_m * (1 - part) * (1 - left) / law.fraction;
}

// How much faster than the whole the spring's missing force must follow: the lattice takes up the
// spring's creep.
inline float relaxation_pace(const ContactLaw& law, float own_m) {
  return (1 - law.now.lattice_part * cone_width(law.now, own_m)) /
         (1 - law.relaxed.lattice_part * cone_width(law.relaxed, own_m));
}

// Energy at the spring's displacement with the force q missing.
inline double contact_energy(const ContactLaw& law, Vec3 displacement_m, Vec3 missing_n) {
  const float q = norm(missing_n), z = missing_depth(law, q);
  const double left = static_cast<double>(dot(missing_n, displacement_m) - q * z);
  const float own = norm(displacement_m);
  return cone_energy(law.now, own) + cone_growth_energy(law.now, own) -
         ((cone_energy(law.now, z) - cone_energy(law.relaxed, z)) + left);
}

}  // namespace stylet
