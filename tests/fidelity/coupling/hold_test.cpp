// SPDX-License-Identifier: Apache-2.0
// A needle that is held in the tissue, after its insertion or after a step to the side, relaxes as
// the material says, for any tissue, voxel, needle, way and speed.
//
// Expected is the quasi-linear law (Fung): the force of a displacement d is that of the elastic
// tissue at d - phi m, m' = (d - m) / tau. While it is held all of this decays exponentially with
// tau; how far depends on what has relaxed before. After a ramp of the duration T:
//   m = d (1 - g), g = tau / T (1 - exp(-T / tau)).
// For a needle that slides at the speed v, each length L of slip renews the tissue it touches
// (kRenewalLengthM), while friction and cutting force stay as they are:
//   m' = (d - m) / tau - v / L m = 0, and d - phi m is what carries the force.
// Of the force at the end of the ramp the fraction phi g / (1 - phi + phi g) relaxes, of that of
// the insertion phi x / (1 - phi + x), with x = v tau / L.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

double along(Vec3 a, Vec3 b) {
  return static_cast<double>(dot(a, b));
}

// Needle along a direction that is not -z, with its tip at a place.
Input needle_at(Vec3 direction, Vec3 tip_m, float length_m) {
  const Vec3 axis = cross(Vec3{0, 0, -1}, direction);
  const float w = 1 - direction.z, size = std::sqrt(w * w + dot(axis, axis));
  return {{tip_m - length_m * direction, {w / size, axis.x / size, axis.y / size, axis.z / size}},
          1};
}

struct Scene {
  double youngs_pa, poisson, edge_m, fraction, time_s, radius_m, in_m_per_s, across_m_per_s,
      across_m;
  double pressed_m;  // depth at which it punctures, about
  double dragged_m;  // what friction drags the tissue along, about
  Vec3 start_m, direction, across;
};

Scene drawn_scene(DoubleDraw& draw) {
  Scene s = {};
  s.youngs_pa = draw.magnitude(5e3, 60e3);
  s.poisson = draw.between(0.3, 0.49);
  s.edge_m = draw.between(2.5e-3, 7e-3);
  s.fraction = draw.between(0.1, 0.7);
  s.time_s = draw.magnitude(0.2, 3);
  s.in_m_per_s = draw.magnitude(2e-3, 0.1);
  s.across_m_per_s = draw.magnitude(2e-3, 0.1);
  s.radius_m = draw.magnitude(0.3e-3, 1.2e-3);
  s.across_m = draw.between(0.5e-3, 2e-3);
  s.pressed_m = draw.between(2e-3, 6e-3);
  s.dragged_m = draw.between(0.2e-3, 0.9e-3);
  const auto part = [&] { return static_cast<float>(draw.between(-1, 1)); };
  s.start_m = Vec3{-1e-3F, 22.5e-3F, 22.5e-3F} + 5e-3F * Vec3{0, part(), part()};
  s.direction = Vec3{1, 0, 0} + 0.3F * Vec3{0, part(), part()};
  s.direction = (1 / norm(s.direction)) * s.direction;
  const Vec3 any = {part(), part(), part()};
  s.across = any - dot(any, s.direction) * s.direction;
  s.across = (1 / norm(s.across)) * s.across;
  return s;
}

// Forces by its stiffness: of a punch, and of a cylinder that is pulled along in an annulus.
TinyMaterial tissue_of(const Scene& s, double youngs_pa) {
  const double shear_pa = youngs_pa / (2 * (1 + s.poisson));
  TinyMaterial m;
  m.youngs_modulus_pa = static_cast<float>(youngs_pa);
  m.poisson_ratio = static_cast<float>(s.poisson);
  m.relaxing_fraction = static_cast<float>(s.fraction);
  m.relaxation_time_s = static_cast<float>(s.time_s);
  m.puncture_force_n = static_cast<float>(2.4 * youngs_pa * s.radius_m * s.pressed_m);
  m.cutting_force_n = 0.5F * m.puncture_force_n;
  m.coulomb_friction_n_per_m = m.static_friction_n_per_m =
      static_cast<float>(2 * 3.14 * shear_pa / std::log(0.025 / s.radius_m) * s.dragged_m);
  return m;
}

Rig rig_of(const Scene& s, bool layered) {
  TinyOrgan tiny;
  const auto voxels = [&](double m) {
    return static_cast<std::uint16_t>(std::lround(m / s.edge_m));
  };
  tiny.nx = voxels(60e-3);
  tiny.ny = tiny.nz = voxels(45e-3);
  tiny.voxel_edge_m = static_cast<float>(s.edge_m);
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials = {tissue_of(s, s.youngs_pa), tissue_of(s, 0.2 * s.youngs_pa)};
  if (layered) {
    tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
      return static_cast<std::uint8_t>(x / 2 % 2);
    };
  }
  Config config;
  config.surround_drag_per_s = 20;
  config.needle[0].outer_radius_m = static_cast<float>(s.radius_m);
  config.needle[0].unit_m = static_cast<float>(std::min(5e-3, s.edge_m));
  return make_rig(tiny, config);
}

struct Decay {
  double fraction, time_s;
};

// Least squares by f = a + b exp(-t / T). In the first tenth of a second the tissue's inertia is
// felt.
Decay decay_of(const std::vector<double>& force_n) {
  constexpr std::size_t kFirst = 100, kStep = 4;
  double a = 0, b = 0;
  const auto error = [&](double time_s) {
    double n = 0, e = 0, ee = 0, f = 0, fe = 0, square = 0;
    const auto shape = [&](std::size_t i) {
      return std::exp(-1e-3 * static_cast<double>(i) / time_s);
    };
    for (std::size_t i = kFirst; i < force_n.size(); i += kStep) {
      n += 1;
      e += shape(i);
      ee += shape(i) * shape(i);
      f += force_n[i];
      fe += force_n[i] * shape(i);
    }
    b = (n * fe - e * f) / (n * ee - e * e);
    a = (f - b * e) / n;
    for (std::size_t i = kFirst; i < force_n.size(); i += kStep) {
      square += std::pow(force_n[i] - a - b * shape(i), 2);
    }
    return square;
  };
  double low = 0.02, high = 30;
  for (int i = 0; i < 60; ++i) {  // golden section
    const double one = low * std::pow(high / low, 0.381966),
                 two = low * std::pow(high / low, 0.618034);
    (error(one) < error(two) ? high : low) = error(one) < error(two) ? two : one;
  }
  (void)error(low);
  return {b / (a + b), low};
}

// Moves the tip straight on by `way_m`, then holds it for five times tau. Returns the force on the
// tissue along the way while it is held, less `before_n`.
std::vector<double> move_and_hold(Rig& rig, const Scene& s, Vec3& tip_m, Vec3 way, double way_m,
                                  double m_per_s, double before_n) {
  const Vec3 from = tip_m;
  Output out = {};
  for (double x = 0; x < way_m;) {
    x = std::min(way_m, x + 1e-3 * m_per_s);
    tip_m = from + static_cast<float>(x) * way;
    out = checked_tick(rig, needle_at(s.direction, tip_m, rig.length_m));
  }
  std::vector<double> force;
  for (int i = 0; i < static_cast<int>(5000 * s.time_s) + 100; ++i) {
    out = checked_tick(rig, needle_at(s.direction, tip_m, rig.length_m));
    force.push_back(-along(out.force_n, way) - before_n);
  }
  return force;
}

// Fractions and times, divided by what is expected.
struct Held {
  Scene scene;
  bool inserted, layered;
  bool slides;  // not: the tip had just come to a layer that stops it, so that it is no endless
                // slide
  double slid;  // v tau / L of the insertion
  Decay in, across;
};

Held hold(const Scene& s, bool layered) {
  Rig rig = rig_of(s, layered);
  Vec3 tip = s.start_m;
  Held held = {s, false, layered, false, 0, {}, {}};
  held.slid = s.in_m_per_s * s.time_s / static_cast<double>(kRenewalLengthM);
  held.in = decay_of(move_and_hold(rig, s, tip, s.direction, 34e-3, s.in_m_per_s, 0));
  const State state = rig.view().state;
  held.inserted = state.needle->phase == Phase::kInserted;
  held.slides = state.tip->material == state.needle->layer;
  const Output out = checked_tick(rig, needle_at(s.direction, tip, rig.length_m));
  held.across = decay_of(move_and_hold(rig, s, tip, s.across, s.across_m, s.across_m_per_s,
                                       -along(out.force_n, s.across)));
  const double ramp_s = s.across_m / s.across_m_per_s, rest = 1 - s.fraction;
  const double ramp = s.fraction * s.time_s / ramp_s * (1 - std::exp(-ramp_s / s.time_s));
  held.in.fraction /= s.fraction * held.slid / (rest + held.slid);
  held.across.fraction /= ramp / (rest + ramp);
  held.in.time_s /= s.time_s;
  held.across.time_s /= s.time_s;
  return held;
}

std::vector<Held> drawn_holds(std::uint64_t seed, int count, bool layered) {
  DoubleDraw draw(seed);
  std::vector<Held> all;
  for (int i = 0; i < count; ++i) all.push_back(hold(drawn_scene(draw), layered));
  return all;
}

void expect_as_written(const std::vector<Held>& all, double tolerance) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Held& h = all[i];
    const Scene& s = h.scene;
    EXPECT_TRUE(h.inserted) << "draw " << i;
    // In layers each part of a slow needle has its own tissue's way to relax, and its neighbours'.
    if (h.slides) {
      EXPECT_NEAR(h.in.fraction, 1, h.layered && h.slid < 5 ? 0.06 : tolerance)
          << "draw " << i << ", v tau / L " << h.slid << ", phi " << s.fraction;
    }
    EXPECT_NEAR(h.in.time_s, 1, tolerance) << "draw " << i << ", tau " << s.time_s;
    EXPECT_NEAR(h.across.fraction, 1, tolerance) << "draw " << i << ", phi " << s.fraction;
    EXPECT_NEAR(h.across.time_s, 1, tolerance) << "draw " << i << ", tau " << s.time_s;
  }
}

TEST(Hold, RelaxesAsWrittenAfterInsertionAndStepAside) {
  expect_as_written(drawn_holds(1, 16, false), 0.02);
}

// Layers of two voxels, every other one five times as soft and as smooth as its neighbours, so that
// stiff tissue drags soft tissue along.
TEST(Hold, RelaxesAsWrittenAcrossLayers) {
  expect_as_written(drawn_holds(1, 8, true), 0.03);
}

// In one random case of twenty, one of the four figures is 2 to 3 % off.
TEST(HoldExhaustive, RelaxesAsWritten) {
  expect_as_written(drawn_holds(2, 100, false), 0.03);
  expect_as_written(drawn_holds(3, 50, true), 0.03);
}

}  // namespace
}  // namespace stylet::test
