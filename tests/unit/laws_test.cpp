// SPDX-License-Identifier: Apache-2.0
// The laws of kernel/src/laws, one by one, against their closed forms in double precision, with
// random numbers. How tissue and needle follow them is tested in tests/fidelity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>

#include "draw.h"
#include "laws/cone.h"
#include "laws/film.h"
#include "laws/filter.h"
#include "laws/friction.h"
#include "laws/touch.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kDraws = 1000;

double wide(float value) {
  return static_cast<double>(value);
}

using Law = std::function<double(double)>;

// Five-point rules, which are exact for polynomials of the fourth degree.
double slope_of(const Law& law, double at, double step) {
  return (8 * (law(at + step) - law(at - step)) - (law(at + 2 * step) - law(at - 2 * step))) /
         (12 * step);
}
double integral_of(const Law& law, double end) {
  constexpr int kParts = 100;
  const double part = end / (4 * kParts);
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double at = 4 * i * part;
    sum += 7 * (law(at) + law(at + 4 * part)) + 32 * (law(at + part) + law(at + 3 * part)) +
           12 * law(at + 2 * part);
  }
  return sum * 2 * part / 45;
}

// ---- cone ---------------------------------------------------------------------------------------
// A cone on tissue whose lattice gives way by itself, as cone.h writes it, solved by bisection.
struct Reference {
  double k, l, first, first_width, part, growth, end;

  double width(double depth) const {
    if (depth < first) return first_width * depth / first;
    return std::min(first_width + (1 - first_width) * (depth - first) / (l - first), 1.0);
  }
  double whole_n(double depth) const {  // the area under the width: trapezia
    double sum = 0, from = 0;
    for (const double to : {std::min(depth, first), std::min(depth, l), depth}) {
      sum += 0.5 * (width(from) + width(to)) * (to - from);
      from = to;
    }
    return k * sum;
  }
  double depth_of(double own) const {  // the depth d with own = d - c F(d) / k
    double low = own, high = own + part * l + part / (1 - part) * own + l;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (middle - part * whole_n(middle) / k < own ? low : high) = middle;
    }
    return high;
  }
  double own_slope(double depth) const { return 1 - part * width(depth); }
  double growth_n(double depth) const {  // what the lattice's growth adds
    const double force = whole_n(depth), most = std::min(force, end), left = own_slope(depth);
    return (1 - left) / left * growth * (2 * force * most - most * most);
  }
  double plain_n(double own) const { return whole_n(depth_of(own)); }
  double beyond_n(double own) const { return growth_n(depth_of(own)); }
  // Work of the two on the way to this depth of the spring.
  double plain_j(double own) const {
    return integral_of([this](double d) { return whole_n(d) * own_slope(d); }, depth_of(own));
  }
  double beyond_j(double own) const {
    return integral_of([this](double d) { return growth_n(d) * own_slope(d); }, depth_of(own));
  }
};

struct DrawnCone {
  Cone cone;
  Reference is;
  double own_m;
};

DrawnCone drawn_cone(Draw& draw) {
  DrawnCone out = {};
  Cone& c = out.cone;
  c.stiffness_n_per_m = draw.magnitude(10, 1e4);
  c.widening = straight(draw.magnitude(1e-4, 1e-2));
  if (draw.between(0, 1) < 0.5F) {  // else a bare cone
    c.widening.first_m = draw.between(0.02, 0.9) * c.widening.length_m;
    c.widening.first_width = draw.between(wide(c.widening.first_m / c.widening.length_m), 1);
  }
  c.lattice_part = draw.between(0, 0.95);
  c.growth_end_n = draw.magnitude(0.1, 10) * c.stiffness_n_per_m * c.widening.length_m;
  c.growth_per_n = draw.between(0, 0.5) / c.growth_end_n;
  out.is = {wide(c.stiffness_n_per_m),    wide(c.widening.length_m), wide(c.widening.first_m),
            wide(c.widening.first_width), wide(c.lattice_part),      wide(c.growth_per_n),
            wide(c.growth_end_n)};
  out.own_m = wide(draw.magnitude(1e-2, 5) * c.widening.length_m);
  return out;
}

// Sneddon 1965: F = 2 E tan(half angle) d^2 / (pi (1 - nu^2)) for a cone, whatever the needle's
// radius; beyond, the slope of a flat punch, 2 a E / (1 - nu^2).
TEST(ConeLaw, IsSneddonsConeAndThenAPunch) {
  Draw draw(1);
  for (int i = 0; i < kDraws; ++i) {
    NeedleConfig needle = {};
    needle.outer_radius_m = draw.between(1e-4, 2e-3);
    needle.tip_half_angle_rad = draw.between(wide(kMinTipHalfAngleRad), wide(kMaxTipHalfAngleRad));
    const double plane_pa = wide(draw.magnitude(1e3, 1e6)), radius_m = wide(needle.outer_radius_m);
    const double tangent = std::tan(wide(needle.tip_half_angle_rad));
    const double length_m = wide(cone_length_m(needle));
    const Cone cone = {static_cast<float>(2 * radius_m * plane_pa), straight(cone_length_m(needle)),
                       0, 0, 0};
    EXPECT_NEAR(length_m * tangent / (kPi / 2 * radius_m), 1, 2e-6);
    const double narrow_m = wide(draw.between(0.01, 0.99)) * length_m;
    const auto own = static_cast<float>(narrow_m);
    EXPECT_NEAR(
        wide(cone_secant(cone, own) * own) / (2 * plane_pa * tangent * narrow_m * narrow_m / kPi),
        1, 4e-6);
    const auto wider = static_cast<float>(2 * length_m);
    EXPECT_NEAR(wide(cone_tangent(cone, wider)) / (2 * radius_m * plane_pa), 1, 1e-6);
    EXPECT_NEAR(wide(cone_secant(cone, wider) * wider) / (2 * radius_m * plane_pa * 1.5 * length_m),
                1, 1e-6);
  }
}

TEST(ConeLaw, LeavesToTheSpringWhatTheLatticeDoesNotCarry) {
  Draw draw(2);
  for (int i = 0; i < kDraws; ++i) {
    const DrawnCone d = drawn_cone(draw);
    const auto own = static_cast<float>(d.own_m);
    const double plain = d.is.plain_n(d.own_m), all = plain + d.is.beyond_n(d.own_m);
    EXPECT_NEAR(wide(cone_point(d.cone, own).depth_m()) / d.is.depth_of(d.own_m), 1, 2e-5) << i;
    EXPECT_NEAR(wide(cone_secant(d.cone, own) * own) / plain, 1, 2e-5) << i;
    EXPECT_NEAR(wide(cone_secant(d.cone, own) * cone_growth(d.cone, own) * own) / all, 1, 5e-5)
        << i;
  }
}

TEST(ConeLaw, HasTheSlopeAndTheEnergyOfItsForce) {
  Draw draw(3);
  for (int i = 0; i < kDraws / 10; ++i) {
    const DrawnCone d = drawn_cone(draw);
    const auto own = static_cast<float>(d.own_m);
    const Law plain = [&](double y) { return d.is.plain_n(y); };
    const Law beyond = [&](double y) { return d.is.beyond_n(y); };
    const Law all = [&](double y) { return plain(y) + beyond(y); };
    const double step = 1e-4 * d.own_m, slope = slope_of(all, d.own_m, step);
    // If two pieces of the law meet within the rule, the slope has no closed form.
    if (std::fabs(slope_of(all, d.own_m, 2 * step) / slope - 1) < 1e-7) {
      EXPECT_NEAR(wide(cone_tangent(d.cone, own)) / slope, 1, 1e-4) << i;
    }
    EXPECT_NEAR(cone_energy(d.cone, own) / d.is.plain_j(d.own_m), 1, 1e-4) << i;
    const double energy = d.is.plain_j(d.own_m) + d.is.beyond_j(d.own_m);
    EXPECT_NEAR((cone_energy(d.cone, own) + cone_growth_energy(d.cone, own)) / energy, 1, 1e-4)
        << i;
  }
}

TEST(ContactLaw, ForceInTheEndIsThatOfRelaxedTissue) {
  Draw draw(4);
  for (int i = 0; i < kDraws; ++i) {
    const DrawnCone d = drawn_cone(draw);
    const float fraction = draw.between(0.05, 0.95);
    const ContactLaw law = contact_law(d.cone, fraction);
    Reference relaxed = d.is;
    relaxed.k *= 1 - wide(fraction);
    relaxed.part *= 1 - wide(fraction);
    const auto own = static_cast<float>(d.own_m);
    const double plain = d.is.plain_n(d.own_m), missing = plain - relaxed.plain_n(d.own_m);
    EXPECT_NEAR(wide(missing_secant(law, own) * own) / plain, missing / plain, 2e-5) << i;
    EXPECT_NEAR(wide(missing_depth(law, static_cast<float>(missing))) / d.own_m, 1, 2e-4) << i;
    const double pace =
        d.is.own_slope(d.is.depth_of(d.own_m)) / relaxed.own_slope(relaxed.depth_of(d.own_m));
    EXPECT_NEAR(wide(relaxation_pace(law, own)), pace, 1e-4) << i;
    // If no force is missing, everything is stored; if all of it is, what the relaxed law stores.
    const double stored = relaxed.plain_j(d.own_m) + d.is.beyond_j(d.own_m);
    const double at_once = cone_energy(d.cone, own) + cone_growth_energy(d.cone, own);
    EXPECT_DOUBLE_EQ(contact_energy(law, {own, 0, 0}, {}), at_once) << i;
    EXPECT_NEAR(contact_energy(law, {0, own, 0}, {0, static_cast<float>(missing), 0}) / at_once,
                stored / at_once, 1e-4)
        << i;
  }
}

// ---- film ---------------------------------------------------------------------------------------
TEST(FilmLaw, IsWithinATwentiethOfFiniteElements) {
  std::ifstream table(STYLET_FILM_TABLE);
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    double youngs_pa = 0, poisson = 0, skin_n_per_m = 0, depth_m = 0, force_n = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &youngs_pa, &poisson, &skin_n_per_m,
                          &depth_m, &force_n),
              5);
    const auto plane_pa = static_cast<float>(youngs_pa / (1 - poisson * poisson));
    EXPECT_NEAR(wide(film_force_n(plane_pa, static_cast<float>(skin_n_per_m),
                                  static_cast<float>(depth_m))) /
                    force_n,
                1, 0.05)
        << line;
  }
  EXPECT_EQ(rows, 60);
}

// E*^(2/3) M^(1/3) d^(5/3): what the energies of skin and tissue give, while the skin is flat.
TEST(FilmLaw, GrowsAsTheMinimumOfEnergyRequires) {
  Draw draw(5);
  for (int i = 0; i < kDraws; ++i) {
    const double skin = wide(draw.magnitude(100, 1e5)), depth = wide(draw.magnitude(1e-4, 1e-2));
    const double plane = skin / depth * wide(draw.magnitude(1e-8, 1e-6));
    const auto force = [](double plane_pa, double skin_n_per_m, double depth_m) {
      return wide(film_force_n(static_cast<float>(plane_pa), static_cast<float>(skin_n_per_m),
                               static_cast<float>(depth_m)));
    };
    const double once = force(plane, skin, depth), factor = wide(draw.between(1.1, 3));
    EXPECT_NEAR(force(factor * plane, skin, depth) / once, std::pow(factor, 2.0 / 3), 1e-3);
    EXPECT_NEAR(force(plane, factor * skin, depth) / once, std::pow(factor, 1.0 / 3), 1e-3);
    EXPECT_NEAR(force(plane, skin, factor * depth) / once, std::pow(factor, 5.0 / 3), 3e-3);
  }
}

// The law of contact with a film's start, wherever the needle's point presses before it is through.
TEST(FilmLaw, IsFollowedFromATenthOfItsDepthOn) {
  Draw draw(7);
  for (int i = 0; i < kDraws; ++i) {
    const float plane = draw.magnitude(5e3, 1e5), skin = draw.magnitude(30, 5e3);
    const float depth = draw.between(1e-3, 9.9e-3);
    const Film film = film_at(plane, skin, film_force_n(plane, skin, depth));
    const Cone cone = {film_punch_n_per_m(film), film_widening(film), 0, 0, 0};
    for (const float share : {0.1F, kFilmShallow, draw.between(0.1, 1), 1.0F}) {
      const float at = share * film.depth_m;
      EXPECT_NEAR(wide(cone_secant(cone, at) * at / film_force_n(plane, skin, at)), 1,
                  share == kFilmShallow || share == 1 ? 1e-4 : 0.031)
          << i << ": at " << share << " of " << film.depth_m << " m, " << skin << " N/m on "
          << plane << " Pa";
    }
  }
}

TEST(FilmLaw, FindsTheDepthOfAForce) {
  constexpr double kHalved = 1e-8;  // 10 mm after 20 halvings
  Draw draw(6);
  for (int i = 0; i < kDraws; ++i) {
    const float plane = draw.magnitude(1e3, 1e6), skin = draw.magnitude(10, 1e5);
    const float depth = draw.between(2e-4, 9.9e-3);
    const Film film = film_at(plane, skin, film_force_n(plane, skin, depth));
    EXPECT_NEAR(wide(film.depth_m), wide(depth), 2 * kHalved + 1e-5 * wide(depth)) << i;
    EXPECT_EQ(film.force_n, film_force_n(plane, skin, film.depth_m));
    EXPECT_NEAR(wide(film_at(plane, skin, 0).depth_m), 1e-4, kHalved);
    EXPECT_NEAR(wide(film_at(plane, skin, 1e9F).depth_m), 1e-2, kHalved);
  }
}

// ---- friction -----------------------------------------------------------------------------------
Friction drawn_friction(Draw& draw) {
  Friction f{};
  f.coulomb_n_per_m = draw.magnitude(0.1, 100);
  f.static_n_per_m = f.coulomb_n_per_m * draw.between(1, 3);
  f.inverse_stribeck_s_per_m = 1 / draw.magnitude(1e-4, 1e-1);
  if (draw.chance(0.5)) f.viscous_n_s_per_m2 = draw.magnitude(1, 100);
  return f;
}

TEST(FrictionLaw, IsStaticAtRestAndCoulombPlusViscousFarBeyondTheStribeckSpeed) {
  Draw draw(7);
  for (int i = 0; i < kDraws; ++i) {
    const Friction f = drawn_friction(draw);
    EXPECT_EQ(friction_n_per_m(f, 0), f.coulomb_n_per_m + (f.static_n_per_m - f.coulomb_n_per_m));
    const double coulomb = wide(f.coulomb_n_per_m), more = wide(f.static_n_per_m) - coulomb;
    const double stribeck = 1 / wide(f.inverse_stribeck_s_per_m);
    for (const double speeds : {0.1, 1.0, 1.7, 5.0, 1e3}) {
      const double speed = speeds * stribeck;
      const double wanted =
          coulomb + more * std::exp(-speeds * speeds) + wide(f.viscous_n_s_per_m2) * speed;
      EXPECT_NEAR(wide(friction_n_per_m(f, static_cast<float>(speed))) / wanted, 1, 1e-6) << speeds;
    }
  }
}

TEST(FrictionLaw, WithoutViscosityFallsWithSpeedButNotBelowItsMinimum) {
  Draw draw(8);
  for (int i = 0; i < kDraws; ++i) {
    Friction f = drawn_friction(draw);
    const float stribeck = 1 / f.inverse_stribeck_s_per_m;
    float slow = draw.between(0, 4) * stribeck, fast = draw.between(0, 4) * stribeck;
    if (slow > fast) std::swap(slow, fast);
    EXPECT_GE(friction_n_per_m(f, slow), least_friction_n_per_m(f));
    f.viscous_n_s_per_m2 = 0;
    const double rounding = 1e-6 * wide(f.static_n_per_m);
    EXPECT_LE(wide(friction_n_per_m(f, fast)), wide(friction_n_per_m(f, slow)) + rounding) << i;
  }
}

TEST(FrictionLaw, MixesByLength) {
  Draw draw(9);
  for (int i = 0; i < kDraws; ++i) {
    const Friction a = drawn_friction(draw), b = drawn_friction(draw);
    const float part = draw.between(0, 1);
    const Friction m = mixed(a, b, part), first = mixed(a, b, 0), same = mixed(a, a, part);
    for (const auto field : kFrictionNumbers) {
      const double wanted = (1 - wide(part)) * wide(a.*field) + wide(part) * wide(b.*field);
      EXPECT_NEAR(wide(m.*field), wanted, 2e-7 * (wide(a.*field) + wide(b.*field)));
      EXPECT_EQ(first.*field, a.*field);
      EXPECT_EQ(same.*field, a.*field);
    }
  }
}

// ---- touch --------------------------------------------------------------------------------------
TEST(PressLaw, BeginsAsASpringEndsAtItsLargestForceAndIsThePotentialsSlope) {
  Draw draw(10);
  for (int i = 0; i < kDraws; ++i) {
    const double k = wide(draw.magnitude(10, 1e6)), most = wide(draw.magnitude(0.1, 100));
    const Law force = [&](double d) { return k * d / std::sqrt(1 + std::pow(k * d / most, 2)); };
    const double depth = wide(draw.magnitude(1e-3, 1e2)) * most / k;
    const Press p = press(k, most, depth);
    EXPECT_NEAR(p.force_n / force(depth), 1, 1e-12);
    EXPECT_NEAR(p.chord_n_per_m * depth / force(depth), 1, 1e-12);
    EXPECT_NEAR(p.stiffness_n_per_m / slope_of(force, depth, 1e-3 * depth), 1, 1e-7) << i;
    // The integral of F is F_max^2 / k (sqrt(1 + u^2) - 1) with u = k d / F_max.
    const double u = k * depth / most;
    EXPECT_NEAR(p.energy_j / (most * most / k * (u * u / (std::sqrt(1 + u * u) + 1))), 1, 1e-12);
    EXPECT_NEAR(press(k, most, 1e-6 * most / k).force_n / (1e-6 * most), 1, 1e-11);
    EXPECT_NEAR(press(k, most, 1e6 * most / k).force_n / most, 1, 1e-11);
    for (const double outside : {0.0, -depth}) {
      const Press none = press(k, most, outside);
      EXPECT_EQ(none.force_n + none.stiffness_n_per_m + none.energy_j + none.chord_n_per_m, 0);
    }
  }
}

// Before it slides a bristle is a spring; then it pulls with the limit along the same line. The
// potential of both is Huber's.
TEST(SlipLaw, SticksUpToTheLimitAndKeepsItBeyond) {
  Draw draw(11);
  for (int i = 0; i < kDraws; ++i) {
    const double k = wide(draw.magnitude(10, 1e6)), limit = wide(draw.magnitude(0.01, 10));
    const double turn = 2 * kPi * draw.unit(), up = 2 * draw.unit() - 1;
    const double flat = std::sqrt(1 - up * up);
    const Vec3d way = {flat * std::cos(turn), flat * std::sin(turn), up};
    const double yield_m = limit / k, inside = draw.unit(), beyond = 1 + 10 * draw.unit();
    const Slip stuck = slip(k, limit, inside * yield_m * way);
    EXPECT_FALSE(stuck.slips);
    EXPECT_NEAR(norm(stuck.bristle_m), inside * yield_m, 1e-12 * yield_m);
    EXPECT_NEAR(stuck.energy_j, 0.5 * inside * inside * limit * yield_m, 1e-12 * limit * yield_m);
    const Slip slid = slip(k, limit, beyond * yield_m * way);
    EXPECT_TRUE(slid.slips);
    EXPECT_NEAR(k * norm(slid.bristle_m) / limit, 1, 1e-12);
    EXPECT_NEAR(dot(slid.bristle_m, way) / yield_m, 1, 1e-12);
    EXPECT_NEAR(slid.energy_j / (limit * yield_m), beyond - 0.5, 1e-12 * beyond);
  }
}

// ---- filter -------------------------------------------------------------------------------------
// Chebyshev's polynomial of the first kind by its closed form, and its slope.
double chebyshev(int degree, double x) {
  if (x > 1) return std::cosh(degree * std::acosh(x));
  return x < -1 ? std::cos(degree * kPi) * std::cosh(degree * std::acosh(-x))
                : std::cos(degree * std::acos(x));
}
double chebyshev_slope(int degree, double x) {  // for x > 1
  const double angle = std::acosh(x);
  return degree * std::sinh(degree * angle) / std::sinh(angle);
}

// A motion with this squared frequency after the passes, over the motion before them.
double gain_of(const Filter& filter, double frequency_per_s2) {
  double before = 0, last = 1;
  for (std::uint32_t j = 0; j < filter.passes; ++j) {
    const FilterPass& pass = filter.pass[j];
    const double next = wide(pass.last) * last + wide(pass.first) + wide(pass.before) * before -
                        wide(pass.bound_s2) * frequency_per_s2 * last;
    before = last;
    last = next;
  }
  return last;
}

// Largest z p(z), where T_n is -1.
double fraction_left(int degree, double damping) {
  const double w = 1 + damping / (degree * degree);
  return (1 + chebyshev(degree, w)) / ((1 + w) * chebyshev_slope(degree, w));
}

// p(z) = (T_n(w) - T_n(w - (1 + w) z)) / (z (1 + w) T_n'(w)), n one more than the passes and
// w = 1 + d / n^2 (Carle, Hochbruck and Sturm 2020); d is 2, or what leaves the limit, at least 1.
TEST(FilterLaw, HasTheGainOfChebyshevsPolynomialAtEveryFrequency) {
  Draw draw(12);
  int least_damped = 0, between = 0, most_damped = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double limit = wide(draw.magnitude(1e4, 1e8));
    const double fastest = limit * wide(draw.magnitude(1.01, 56));
    const Filter filter = choose_filter(static_cast<float>(limit), static_cast<float>(fastest));
    ASSERT_GT(filter.passes, 0U);
    const int degree = static_cast<int>(filter.passes) + 1;
    double damping = 1;
    for (double step = 1; step > 1e-7; step /= 2) {
      if (damping + step <= 2 && fraction_left(degree, damping + step) * fastest <= limit) {
        damping += step;
      }
    }
    ++(damping == 1 ? least_damped : damping == 2 ? most_damped : between);
    const double w = 1 + damping / (degree * degree), top = chebyshev(degree, w);
    EXPECT_NEAR(gain_of(filter, 0), 1, 1e-5) << degree;
    for (const double z : {draw.unit(), draw.unit() * draw.unit(), 1.0}) {
      const double wanted =
          (top - chebyshev(degree, w - (1 + w) * z)) / (z * (1 + w) * chebyshev_slope(degree, w));
      const double gain = gain_of(filter, z * fastest);
      EXPECT_NEAR(gain, wanted, 1e-5) << degree << " " << z;
      EXPECT_GT(gain, 0.0066) << degree << " " << z;
      // What seven passes cannot do is left to added mass.
      if (fastest < 55 * limit) {
        EXPECT_LE(z * fastest * gain, limit * (1 + 1e-5)) << degree << " " << z;
      }
    }
  }
  EXPECT_GT(least_damped, 0);
  EXPECT_GT(between, kDraws / 10);
  EXPECT_GT(most_damped, kDraws / 10);
}

// The factor by which each number of passes divides, as in filter.h; undamped it would be (n +
// 1)^2.
TEST(FilterLaw, TakesTheFewestPassesThatSlowEnough) {
  constexpr double kDivides[] = {1, 3.6, 7.9, 13.9, 21.7, 31.2, 42.4, 55.3};
  constexpr float kLimit = 1e6F;
  for (std::uint32_t passes = 0; passes < kMaxFilterPasses; ++passes) {
    const double most = kDivides[passes] * wide(kLimit);
    EXPECT_EQ(choose_filter(kLimit, static_cast<float>(most * 0.98)).passes, passes);
    EXPECT_EQ(choose_filter(kLimit, static_cast<float>(most * 1.02)).passes, passes + 1);
  }
  EXPECT_NEAR(wide(most_filtered_per_s2(kLimit)) / wide(kLimit), kDivides[kMaxFilterPasses], 0.05);
  EXPECT_EQ(choose_filter(kLimit, 1e3F * kLimit).passes, kMaxFilterPasses);
}

// 4 / (dt (dt + 2 tau)), PHYSICS 3.1.
TEST(FilterLaw, LimitsTheStepToWhatIsStable) {
  Draw draw(13);
  for (int i = 0; i < kDraws; ++i) {
    const float step = draw.magnitude(1e-5, 1e-2), tau = draw.chance(0.2) ? 0 : draw.between(0, 1);
    const double stable = 4 / (wide(step) * (wide(step) + 2 * wide(tau)));
    EXPECT_NEAR(wide(wave_limit_per_s2(step, tau)) / stable, 1, 1e-7);
  }
}

}  // namespace
}  // namespace stylet::test
