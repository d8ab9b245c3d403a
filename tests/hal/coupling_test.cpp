// SPDX-License-Identifier: Apache-2.0
// The virtual coupling: the stiffness felt, no lag in free space, and no energy for the hand.
#include "hal/loop/coupling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "rig.h"

namespace stylet::hal {
namespace {

double of(float value) {
  return static_cast<double>(value);
}

// A spring of stiffness `k` that gives `bound` as its bound on stiffness.
Output spring(double k, double bound, Vec3 base_m) {
  Output out = {};
  out.force_n.x = static_cast<float>(-k * of(base_m.x));
  out.stiffness_n_per_m = static_cast<float>(bound);
  return out;
}

struct Felt {
  double rest_n_per_m, largest_n_per_m;
};

// Pushes by 1 mm in one tick, then holds.
Felt push(const CouplingConfig& config, double k, double bound) {
  CouplingState state;
  Output out = spring(k, bound, coupled_base(config, state, {}, {}));
  double last = 0, largest = 0;
  const Vec3 device = {1e-3F, 0, 0};
  for (int i = 0; i < 20'000; ++i) {
    out = spring(k, bound, coupled_base(config, state, device, out));
    last = -of(coupled_force(config, state, device, out.force_n).x) / 1e-3;
    largest = std::max(largest, last);
  }
  return {last, largest};
}

TEST(Coupling, FeltStiffnessIsTheSeriesOfBothAndNeverMoreThanItsOwn) {
  const CouplingConfig config = {700};
  for (const double k : {0.0, 1.0, 100.0, 700.0, 20e3, 1e6}) {
    for (const double over : {1.0, 3.0, 10.0}) {
      const Felt felt = push(config, k, over * k);
      EXPECT_NEAR(felt.rest_n_per_m, 700 * k / (700 + k), 0.2) << k << " " << over;
      EXPECT_LE(felt.largest_n_per_m, 700.1) << k << " " << over;
    }
  }
}

TEST(Coupling, IsAbsentInFreeSpaceAndWithoutAStiffness) {
  CouplingState state;
  for (const float x : {0.0F, 0.01F, -0.02F}) {
    EXPECT_EQ(coupled_base({700}, state, {x, 0, 0}, {}).x, x);
    EXPECT_EQ(coupled_force({700}, state, {x, 0, 0}, {}).x, 0);
    EXPECT_EQ(coupled_base({0}, state, {x, 0, 0}, spring(1e4, 1e4, {x, 0, 0})).x, x);
    EXPECT_EQ(coupled_force({0}, state, {x, 0, 0}, {5, 0, 0}).x, 5);
  }
  // A stiffness far below the coupling's, 1 % of it, is felt to within 1 %.
  EXPECT_NEAR(push({700}, 7, 7).rest_n_per_m, 7, 0.07);
}

// A device that reports its position in steps goes in at constant speed, and the needle slides with
// the same `friction` at any speed. Returns the force felt at the end, and how far it swings on the
// way.
struct Slid {
  double felt_n, swing_n, behind_m;
};

Slid slide(const CouplingConfig& config, double m_per_s, double friction_n, double bound) {
  CouplingState state;
  Output out = {};
  double low = 1e9, high = 0, x = 0;
  Vec3 base = coupled_base(config, state, {}, out);
  for (int i = 1; i <= 2000; ++i) {
    x += m_per_s * 1e-3;
    const double told = 1e-5 * std::round(x / 1e-5);
    base = coupled_base(config, state, {static_cast<float>(told), 0, 0}, out);
    out.force_n.x = static_cast<float>(-friction_n);
    out.stiffness_n_per_m = static_cast<float>(bound);
    const double felt = -of(coupled_force(config, state, {static_cast<float>(told), 0, 0}, {}).x);
    if (i > 1000) low = std::min(low, felt), high = std::max(high, felt);
  }
  return {0.5 * (low + high), high - low, x - of(base.x)};
}

TEST(Coupling, ANeedleThatSlidesHasItsFrictionAndNoDragOfTheCouplings) {
  for (const double m_per_s : {0.002, 0.01, 0.03}) {
    for (const double bound : {1e3, 15e3, 60e3}) {
      const Slid slid = slide({3500}, m_per_s, 1, bound);
      EXPECT_NEAR(slid.felt_n, 1, 0.02) << m_per_s << " " << bound;
      EXPECT_LT(slid.swing_n, 0.04) << m_per_s << " " << bound;  // the reported steps are 35 mN
    }
  }
}

TEST(Coupling, PullsTheBaseAlongWhereTheHandCannotBeShownMore) {
  const Slid slid = slide({280, 3.3F}, 0.02, 20, 15e3);
  EXPECT_NEAR(slid.felt_n, 3.3, 1e-3);
  EXPECT_LT(slid.swing_n, 0.01);
  EXPECT_NEAR(slid.behind_m, 3.3 / 280, 2e-5);
  EXPECT_NEAR(slide({280, 3.3F}, 0.02, 2, 15e3).felt_n, 2, 0.02);  // unchanged below it
  EXPECT_NEAR(slide({280, 0.5F}, 0.02, 2, 15e3).felt_n, 0.5, 1e-3);
}

// The device moves in and out at constant speed, against a spring in all directions that reports a
// larger stiffness than it has. Returns the largest difference between the force felt and that of
// both springs in series.
double lag_n(const CouplingConfig& config, double k, double bound) {
  CouplingState state;
  Output out = {};
  double worst = 0, way = 0;
  for (int i = 0; i < 3000; ++i) {
    way += i < 2000 ? 1e-5 : -1e-5;  // 10 mm/s
    const auto part = static_cast<float>(way / std::sqrt(21));
    const Vec3 device = {part, -2 * part, 4 * part};
    const Vec3 base = coupled_base(config, state, device, out);
    const auto size = static_cast<float>(k);
    out.force_n = {-size * base.x, -size * base.y, -size * base.z};
    out.stiffness_n_per_m = static_cast<float>(bound);
    const Vec3 felt = coupled_force(config, state, device, out.force_n);
    const double along = (of(felt.x) - 2 * of(felt.y) + 4 * of(felt.z)) / std::sqrt(21);
    const auto own = of(config.stiffness_n_per_m);
    const bool settled = i % 2000 > 200;  // the velocity is averaged, so it lags here
    if (settled) worst = std::max(worst, std::fabs(along + own * k / (own + k) * way));
  }
  return worst;
}

TEST(Coupling, ASpringDoesNotLagBehindAHandThatMoves) {
  for (const double k : {100.0, 700.0, 5000.0}) {
    for (const double over : {1.0, 5.0, 20.0}) {
      EXPECT_LT(lag_n({700}, k, over * k), 5e-3) << k << " " << over;
    }
  }
}

// As at a puncture: the force falls with depth, by as much as the coupling is stiff. The base goes
// on with the hand; it neither turns back nor runs ahead.
TEST(Coupling, AForceThatFallsNeitherTurnsTheBaseBackNorThrowsItAhead) {
  CouplingState state;
  Output out = {};
  out.stiffness_n_per_m = 5000;
  float last = 0;
  for (int i = 0; i < 3000; ++i) {
    const float device = 1e-5F * static_cast<float>(i);
    const float base = coupled_base({700}, state, {device, 0, 0}, out).x;
    ASSERT_TRUE(i < 300 || (base >= last && base < device + 2e-5F)) << i;
    last = base;
    out.force_n.x = -720 * std::clamp(13e-3F - base, 0.0F, 3e-3F);
  }
  EXPECT_GT(last, 28e-3F);
}

// V26: a device of 0.1 kg with a damper of 0.5 N s/m, shaken at random by a hand, with ticks of 1
// ms between which the force is held. The energy that the hand gives is exact: it is the loss in
// the device's own damping plus the work against the force that is held.
struct Shaken {
  double least_j, pressed_n;
};

Shaken shake(const CouplingConfig& config, Kernel& kernel, const Mapping& mapping, unsigned seed) {
  constexpr double kMassKg = 0.1, kDamping = 0.5, kT = 1e-3, kHandStiffness = 300;
  std::mt19937 random(seed);
  CouplingState state;
  Output out = {};
  double x[3] = {}, v[3] = {}, target[3] = {}, energy = 0;
  Shaken shaken = {0, 0};
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 at =
        to_world(mapping,
                 {{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])},
                  {1, 0, 0, 0}})
            .position_m;
    const Vec3 base = coupled_base(config, state, at, out);
    out = tick(kernel, {{base, mapping.rotation}, 1});
    const Vec3 f = to_device(mapping, coupled_force(config, state, at, out.force_n));
    const double force[3] = {of(f.x), of(f.y), of(f.z)};
    shaken.pressed_n = std::max(shaken.pressed_n, std::hypot(force[0], force[1], force[2]));
    for (int k = 0; k < 3; ++k) {
      if (i % 50 == 0) {
        const double share = static_cast<double>(random()) / static_cast<double>(random.max());
        target[k] = k == 2 ? -12e-3 + 20e-3 * (share - 0.5) : 6e-3 * (share - 0.5);
      }
      const double hand = kHandStiffness * (target[k] - x[k]);
      v[k] = (v[k] + kT / kMassKg * (hand + force[k])) / (1 + kT * kDamping / kMassKg);
      const double step = kT * v[k];
      x[k] += step;
      energy += kDamping * v[k] * step - force[k] * step;
    }
    shaken.least_j = std::min(shaken.least_j, energy);
  }
  return shaken;
}

// A needle on bone, 0.5 mm above it at the start.
struct OnBone {
  Rig rig;
  std::unique_ptr<KernelInstance> instance;
  explicit OnBone(double stiffness_n_per_m) {
    ObstacleConfig bone;
    make_box(bone, {0.01F, 0.05F, 0.05F});
    const Course course = place_needle(rig.scene, rig.organ).course;
    bone.pose.position_m = course.entry_m;
    bone.pose.position_m.x += 0.01F;
    bone.stiffness_n_per_m = static_cast<float>(stiffness_n_per_m);
    bone.largest_force_n = 100;
    bone.friction = 0.3F;
    instance = std::make_unique<KernelInstance>(rig.organ, rig.scene.config, std::span(&bone, 1));
  }
};

TEST(Coupling, GivesTheHandNoEnergyOnTissueAndBone) {
  const CouplingConfig config = {
      static_cast<float>(kCouplingFraction * 1000)};  // 2 b / T of this device is 1000 N/m
  for (unsigned seed = 1; seed <= 5; ++seed) {
    OnBone bone(20e3);
    const Shaken on_bone =
        shake(config, bone.instance->kernel, bone.rig.config.hand[0].mapping, seed);
    EXPECT_GE(on_bone.least_j, -1e-6) << seed;
    EXPECT_GT(on_bone.pressed_n, 1) << seed;
    Rig tissue;
    const Shaken in_tissue =
        shake(config, tissue.instance->kernel, tissue.config.hand[0].mapping, seed);
    EXPECT_GE(in_tissue.least_j, -1e-6) << seed;
    EXPECT_GT(in_tissue.pressed_n, 0.1) << seed;
  }
}

TEST(Coupling, WithoutItBoneFeedsTheHand) {
  OnBone bone(20e3);
  EXPECT_LT(shake({0}, bone.instance->kernel, bone.rig.config.hand[0].mapping, 1).least_j, -1e-3);
}

}  // namespace
}  // namespace stylet::hal
