// SPDX-License-Identifier: Apache-2.0
// V30: weight (PHYSICS 4.6). Free bodies fall as all bodies do, hanging bars are as long as their
// weight makes them, and what weight begins it also brings to rest.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rig.h"

namespace stylet::test {
namespace {

struct Draw {
  std::mt19937_64 random;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec direction() {
    Vec out;
    do {
      out = Vec(between(-1, 1), between(-1, 1), between(-1, 1));
    } while (out.norm() < 0.1 || out.norm() > 1);
    return out.normalized();
  }
};

TinyMaterial tissue(double youngs_pa, double poisson, double density) {
  TinyMaterial out =
      elastic(static_cast<float>(youngs_pa / (2 * (1 + poisson))), static_cast<float>(poisson));
  out.density_kg_per_m3 = static_cast<float>(density);
  return out;
}

void run_ticks(Session& session, int ticks) {
  for (int i = 0; i < ticks; ++i) tick(session.kernel, Input{});
}

// Momentum over mass of a body of true mass: weight has come in as 3 x^2 - 2 x^3 of the first
// second. (After a second the body is so far from its rest place that floats hold its forces
// coarsely.)
TEST(FidelityV30, FreeBodiesFallAlikeWhateverTheirTissue) {
  Draw draw{std::mt19937_64(30)};
  for (int i = 0; i < 12; ++i) {
    // Soft enough for the filter, so that no mass is added.
    TinyOrgan tiny = block_of(3, 2, 4, tissue(draw.between(2e3, 2e4), draw.between(0, 0.45), 1000));
    tiny.materials.push_back(tissue(draw.between(2e3, 2e4), draw.between(0, 0.45), 1400));
    tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t z) {
      return static_cast<std::uint8_t>((x + z) % 2);
    };
    Config config;
    config.surround_drag_per_s = 0;
    config.substeps = static_cast<std::uint32_t>(1 + i % 3);
    const Vec g = draw.between(0.5, 10) * draw.direction();
    config.gravity_m_per_s2 = to_float(g);
    const auto opened = open_organ(tiny_organ(tiny));
    Session session = make_session(opened->organ, config);
    const int ticks = 100 + 20 * i;
    run_ticks(session, ticks);
    const View view = view_of(session.kernel);
    Vec momentum = Vec::Zero();
    double mass = 0;
    for (std::uint32_t p = 0; p < view.model.head->counts.particles; ++p) {
      const double kg = static_cast<double>(view.model.particle_kg[p]);
      momentum += kg * to_vec({view.state.wx[p], view.state.wy[p], view.state.wz[p]});
      mass += kg;
    }
    double fallen = 0;
    for (int t = 1; t <= ticks; ++t) {  // a tick has the weight of its end
      const double x = 1e-3 * t;
      fallen += 1e-3 * x * x * (3 - 2 * x);
    }
    const Vec wanted = fallen * g;
    EXPECT_LT((momentum / mass - wanted).norm(), 2e-4 * wanted.norm()) << "draw " << i;
  }
}

// A bar that hangs from its end, or stands on it: at the distance z from there its own weight has
// moved it by rho g (L z - z^2 / 2) / E.
TEST(FidelityV30, HangingBarIsAsLongAsItsWeightMakesIt) {
  Draw draw{std::mt19937_64(31)};
  for (int i = 0; i < 8; ++i) {
    const double density = draw.between(800, 1200),
                 pull = (i % 2 == 0 ? -1 : 1) * draw.between(3, 15);
    const double youngs = draw.between(3e3, 2e4), edge = draw.between(2e-3, 5e-3);
    TinyOrgan tiny = block_of(2, 2, 8, tissue(youngs, 0, density), static_cast<float>(edge));
    tiny.fixed_faces = kLowZ;
    Config config;
    config.surround_drag_per_s = 30;
    config.inertia = i % 4 < 2 ? Inertia::kTrueMass : Inertia::kAddedMass;
    config.gravity_m_per_s2 = {0, 0, static_cast<float>(pull)};
    const auto opened = open_organ(tiny_organ(tiny));
    Session session = make_session(opened->organ, config);
    run_ticks(session, 3000);
    const View view = view_of(session.kernel);
    const double length = 8 * edge;
    double farthest = 0;
    for (std::uint32_t z = 1; z <= 8; ++z) {
      const double at = z * edge;
      const double wanted = density * pull * (length * at - at * at / 2) / youngs;
      const double moved = static_cast<double>(view.state.uz[node_index(view, {1, 1, z})]);
      EXPECT_NEAR(moved / wanted, 1, 2e-3) << "draw " << i << ", z " << z;
      farthest = moved;
    }
    // It was there almost from the end of the first second on.
    reset(session.kernel);
    run_ticks(session, 1000);
    double most = 0;
    for (int t = 0; t < 1000; ++t) {
      run_ticks(session, 1);
      const double moved = static_cast<double>(view.state.uz[node_index(view, {1, 1, 8})]);
      most = std::max(most, std::abs(moved / farthest - 1));
    }
    EXPECT_LT(most, 0.05) << "draw " << i;
  }
}

// A cantilever that sinks under its weight, of tissue without Poisson's ratio: there every motion
// of every voxel is at the bound on its stiffness, and the filter has all its passes. Bending and
// shear: rho g L^2 (3 L^2 / (2 E h^2) + 3 / (5 G)).
TEST(FidelityV30, CantileverComesToRestWherePoissonsRatioIsZero) {
  constexpr double kEdge = 2.5e-3, kLength = 40 * kEdge, kHeight = 8 * kEdge;
  constexpr double kYoungs = 200e3, kDensity = 1000, kPull = 0.5;
  TinyOrgan tiny = block_of(40, 8, 8, tissue(kYoungs, 0, kDensity), static_cast<float>(kEdge));
  tiny.fixed_faces = kLowX;
  Config config;
  config.surround_drag_per_s = 12;
  config.gravity_m_per_s2 = {0, 0, static_cast<float>(-kPull)};
  const auto opened = open_organ(tiny_organ(tiny));
  Session session = make_session(opened->organ, config);
  run_ticks(session, 3000);
  const View view = view_of(session.kernel);
  const double moved = -static_cast<double>(view.state.uz[node_index(view, {40, 4, 4})]);
  const double wanted =
      kDensity * kPull * kLength * kLength *
      (1.5 * kLength * kLength / (kYoungs * kHeight * kHeight) + 0.6 / (0.5 * kYoungs));
  EXPECT_NEAR(moved / wanted, 1, 0.03);
  EXPECT_LT(energy(session.kernel).kinetic, 1e-10);
}

// What lies as it lay when its shape was taken has no weight: the same bits as before there was
// any.
TEST(FidelityV30, NoGravityIsNoForce) {
  TinyOrgan tiny = block_of(3, 3, 3, tissue(5e3, 0.4, 1000));
  tiny.fixed_faces = kLowZ;
  const auto opened = open_organ(tiny_organ(tiny));
  Session session = make_session(opened->organ, Config{});
  run_ticks(session, 100);
  const View view = view_of(session.kernel);
  EXPECT_EQ(view.state.head->max_displacement_m, 0);
}

}  // namespace
}  // namespace stylet::test
