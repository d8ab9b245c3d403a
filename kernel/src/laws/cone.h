// SPDX-License-Identifier: Apache-2.0
// The tip in contact: a cone that becomes a cylinder, and the relaxation of the tissue under it.
//
// Contact widens as the cone sinks in, until at the depth l it is as wide as the needle. From there
// on the law is that of a flat punch (Sneddon 1965: rigid, frictionless, on a half space). With the
// punch's stiffness k = 2 a E / (1 - nu^2) and l = pi a / (2 tan(half angle)):
//   F(d) = k d^2 / (2 l),  U(d) = k d^3 / (6 l)                          up to d = l,
//   F(d) = k (d - l / 2),  U(d) = k (d^2 / 2 - l d / 2 + l^2 / 6)        beyond.
// In other words: the slope of F over k is a width w(d) that grows evenly from 0 to 1. Under a thin
// skin (film.h) it grows faster at first: up to a depth l1 evenly to w1, then evenly to 1. So the
// law has three pieces, each with F = F_j + k (w_j (d - l_j) + a_j (d - l_j)^2 / 2).
//
// This is the law of all the tissue. The compliance of the lattice is a part c of the punch's 1 /
// k. The tip's own spring keeps y = d - c F(d) / k: the same force at a smaller depth, with the
// energy U(d) - c F^2 / (2 k). A cone of its own for the spring made the whole law depend on the
// voxel.
//
// Under larger forces the lattice yields more than in proportion: by c / k (F + g F^2) up to a
// force F_end, and beyond it with the slope at F_end. To first order in g the spring then carries F
// + c w / (1 - c w) g F^2, with F as above, and stores c / k g F^3 / 3 more.
//
// The relaxed law of all the tissue is that of a cone with (1 - phi) k. The lattice does not relax,
// so the spring's relaxed law is that cone's less the compliance of the lattice, which is now the
// part (1 - phi) c. Q(y) is the difference of the spring's two laws. The lost force q follows Q in
// time (as in Fung's quasi-linear law), and the spring carries F - q. If z is the depth with Q(z) =
// q, the spring's energy is U(y) - (U_Q(z) + q (y - z)), which creep can only lower. As vectors, F
// and Q point along the displacement they belong to.
//
// Promises: no branch on hardware, no allocation. Units SI. PHYSICS 8.1.
#pragma once

#include "base/math.h"
#include "stylet/kernel.h"

namespace stylet {

// w(d): from 0 at no depth to w1 at l1, and to 1 at l. A bare cone's is straight.
struct Widening {
  float length_m;     // l
  float first_m;      // l1, above 0 and below l
  float first_width;  // w1
};
inline Widening straight(float length_m) {
  return {length_m, 0.5F * length_m, 0.5F};
}

// The same as far as it is at most `most`, over that.
inline Widening narrower(const Widening& w, float most) {
  if (most <= w.first_width) return straight(most / w.first_width * w.first_m);
  const float part = (most - w.first_width) / (1 - w.first_width);
  const float length_m = w.first_m + part * (w.length_m - w.first_m);
  return most < 1 ? Widening{length_m, w.first_m, w.first_width / most} : w;
}

struct Cone {
  float stiffness_n_per_m;  // of the punch on all the tissue, k
  Widening widening;
  float lattice_part;  // c, below 1
  float growth_per_n;  // g
  float growth_end_n;  // F_end
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

// One of the three pieces of a law: where it begins, and what the law is there, over k.
struct ConePiece {
  float depth_m;       // l_j
  float width;         // w_j
  float growth_per_m;  // a_j
  float force_m;       // F_j / k
  float energy_m2;     // U_j / k
};
constexpr std::uint32_t kConePieces = 3;

// Force and energy over k, so far beyond the beginning of a piece.
inline float piece_force_m(const ConePiece& p, float beyond_m) {
  return p.force_m + beyond_m * (p.width + 0.5F * p.growth_per_m * beyond_m);
}
inline float piece_energy_m2(const ConePiece& p, float beyond_m) {
  const float bent = 0.5F * p.width + (1.0F / 6) * p.growth_per_m * beyond_m;
  return p.energy_m2 + beyond_m * (p.force_m + beyond_m * bent);
}

struct ConePieces {
  ConePiece piece[kConePieces];
};
inline ConePieces cone_pieces(const Widening& w) {
  const float left_m = w.length_m - w.first_m;
  const ConePiece first = {0, 0, w.first_width / w.first_m, 0, 0};
  const ConePiece second = {w.first_m, w.first_width, (1 - w.first_width) / left_m,
                            piece_force_m(first, w.first_m), piece_energy_m2(first, w.first_m)};
  return {{first,
           second,
           {w.length_m, 1, 0, piece_force_m(second, left_m), piece_energy_m2(second, left_m)}}};
}

// The spring's own depth where a piece begins, if the lattice has this part.
inline float own_depth_m(const ConePiece& p, float part) {
  return p.depth_m - part * p.force_m;
}

// Where a law is: in which piece, and how far beyond its beginning.
struct ConePoint {
  ConePiece piece;
  float beyond_m;

  float depth_m() const { return piece.depth_m + beyond_m; }
  float width() const { return piece.width + piece.growth_per_m * beyond_m; }
  float force_m() const { return piece_force_m(piece, beyond_m); }
};
inline ConePoint cone_point(const Cone& c, float own_m) {
  const ConePieces pieces = cone_pieces(c.widening);
  const float part = c.lattice_part;
  std::uint32_t at = 0;
  for (std::uint32_t i = 1; i < kConePieces; ++i) {
    if (own_m > own_depth_m(pieces.piece[i], part)) at = i;
  }
  const ConePiece& piece = pieces.piece[at];
  const float own_beyond_m = own_m - own_depth_m(piece, part), left = 1 - part * piece.width;
  const float square = left * left - 2 * part * piece.growth_per_m * own_beyond_m;
  return {piece, 2 * own_beyond_m / (left + std::sqrt(square))};
}

// Width of contact at that depth, over the needle's width: the slope of F over k.
inline float cone_width(const Cone& c, float own_m) {
  return cone_point(c, own_m).width();
}

// F over the spring's own depth.
inline float cone_secant(const Cone& c, float own_m) {
  return own_m > 0 ? c.stiffness_n_per_m * (cone_point(c, own_m).force_m() / own_m) : 0;
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
  const ConePoint at = cone_point(c, own_m);
  const float width = at.width(), left = 1 - c.lattice_part * width;
  const float force = c.stiffness_n_per_m * at.force_m(), most = min_of(force, c.growth_end_n);
  const float widening =
      at.piece.growth_per_m * c.lattice_part * most * (2 * force - most) / (left * left);
  const float slope = c.stiffness_n_per_m * width;
  return (slope + c.growth_per_n * (widening + 2 * most * slope * (1 - left) / left)) / left;
}

// Energy of a spring that carries F.
inline double cone_energy(const Cone& c, float own_m) {
  const ConePoint at = cone_point(c, own_m);
  const float force_m = at.force_m(), whole_m2 = piece_energy_m2(at.piece, at.beyond_m);
  return static_cast<double>(c.stiffness_n_per_m) *
         static_cast<double>(whole_m2 - 0.5F * c.lattice_part * force_m * force_m);
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
// the two laws, Q = (d - e) k / c, and Q = F(d) - (1 - phi) F(e): a quadratic equation for e, once
// it is known in which pieces d and e lie.
inline float missing_depth(const ContactLaw& law, float missing_n) {
  if (!(missing_n > 0)) return 0;
  const Cone& c = law.now;
  const ConePieces pieces = cone_pieces(c.widening);
  const float part = c.lattice_part, left = law.relaxed.lattice_part, kept = 1 - law.fraction;
  std::uint32_t in_now = 0, in_relaxed = 0;
  for (std::uint32_t i = 1; i < kConePieces; ++i) {
    const float now_m = own_depth_m(pieces.piece[i], part);
    const float relaxed_m = own_depth_m(pieces.piece[i], left);
    if (missing_n > missing_secant(law, now_m) * now_m) in_now = i;
    if (missing_n > missing_secant(law, relaxed_m) * relaxed_m) in_relaxed = i;
  }
  const ConePiece &d = pieces.piece[in_now], &e = pieces.piece[in_relaxed];
  // At e = e.depth_m + x, d is x + ahead_m beyond its piece's beginning.
  const float missing_m = missing_n / c.stiffness_n_per_m;
  const float ahead_m = (e.depth_m - d.depth_m) + part * missing_m;
  const float lacks_m = missing_m - (piece_force_m(d, ahead_m) - kept * e.force_m);
  const float slope = d.width + d.growth_per_m * ahead_m - kept * e.width;
  const float bent = d.growth_per_m - kept * e.growth_per_m;
  const float x = 2 * lacks_m / (slope + std::sqrt(max_of(slope * slope + 2 * bent * lacks_m, 0)));
  return e.depth_m + x - left * piece_force_m(e, x);
}

// The factor by which the spring's lost force must follow faster than that of the whole, because
// the lattice takes up a part of the spring's creep.
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
