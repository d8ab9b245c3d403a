// SPDX-License-Identifier: Apache-2.0
// V20, V21 and steering by a bevel: the rule of the cut against the unicycle's closed forms
// (Webster et al. 2006), and how the whole kernel follows it.

#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979;

struct Path {
  Vec3 place = {}, cut = {1, 0, 0};
};

// A tip in stiff tissue: the needle follows its cut, and is rolled by `roll_rad(length)`.
template <typename Roll>
Path follow(double curvature, double length_m, double unit_m, Roll roll_rad) {
  Path path;
  Vec3 up = {0, 0, 1};  // carried along the path
  const auto bevel = static_cast<float>(curvature);
  const int steps = static_cast<int>(std::lround(length_m / unit_m));
  for (int i = 0; i < steps; ++i) {
    const double roll = roll_rad((i + 0.5) * unit_m);
    const auto turn = [&] {
      up = up - dot(up, path.cut) * path.cut;
      up = (1 / norm(up)) * up;
      const Vec3 across = cross(path.cut, up);
      Needle needle = {};
      needle.tip_direction = path.cut;
      needle.side =
          static_cast<float>(std::cos(roll)) * up + static_cast<float>(std::sin(roll)) * across;
      path.cut = turn_cut(path.cut, needle, bevel, static_cast<float>(0.5 * unit_m));
    };
    turn();
    path.place = path.place + static_cast<float>(unit_m) * path.cut;
    turn();
  }
  return path;
}

TEST(V20Bevel, CutsTheArcOfItsCurvature) {
  for (const auto& [unit_m, within_m] : {std::pair{5e-3, 0.2e-3}, {1e-3, 0.02e-3}}) {
    const Path path = follow(5, 0.1, unit_m, [](double) { return 0.0; });
    EXPECT_NEAR(static_cast<double>(path.place.x), 95.885e-3, within_m);
    EXPECT_NEAR(static_cast<double>(path.place.z), 24.483e-3, within_m);
    EXPECT_NEAR(static_cast<double>(path.place.y), 0, 1e-6);
  }
}

// Rolled by tau a metre, a path of curvature kappa is a helix.
TEST(V21Bevel, SpinMakesAHelix) {
  const double kappa = 5, tau = 20, turn_m = 2 * kPi / std::sqrt(kappa * kappa + tau * tau);
  const auto roll = [tau](double s) { return tau * s; };
  const Path once = follow(kappa, turn_m, 2e-5, roll),
             half = follow(kappa, 0.5 * turn_m, 2e-5, roll);
  const double pitch = 2 * kPi * tau / (kappa * kappa + tau * tau);
  const double radius = kappa / (kappa * kappa + tau * tau);
  EXPECT_NEAR(norm_of(once.place) / pitch, 1, 0.01);
  // After half a turn: across the helix, and half its pitch onwards.
  const double across = 2 * radius, on = 0.5 * pitch;
  EXPECT_NEAR(norm_of(half.place) / std::sqrt(across * across + on * on), 1, 0.01);
}

// A needle that is spun for a fraction of every 2 mm bends by the other fraction (Minhas et al.
// 2007).
TEST(V21Bevel, DutyCycleScalesTheCurvature) {
  for (const double duty : {0.25, 0.5, 0.75}) {
    const double period_m = 2e-3;
    const auto roll = [=](double s) {
      const double part = s / period_m - std::floor(s / period_m);
      return part < duty ? 2 * kPi * part / duty : 0.0;
    };
    const Path path = follow(5, 0.1, 1e-5, roll);
    const double turned = std::acos(static_cast<double>(path.cut.x));
    EXPECT_NEAR(turned / 0.1 / 5, 1 - duty, 0.01) << duty;
  }
}

struct Steered {
  Vec3 tip;
  double worst_sum = 0;  // of the forces reported against the force on the hand
};

// 22G with a bevel, 80 mm into a block, rolled half way if `flip`.
Steered steer(float youngs_modulus_pa, float curvature, bool flip, float bending_nm2 = 2.318e-3F) {
  TinyOrgan tiny;
  tiny.nx = 22;
  tiny.ny = tiny.nz = 9;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials[0].youngs_modulus_pa = youngs_modulus_pa;
  tiny.materials[0].puncture_force_n = 0.3F;
  Config config;
  config.needle[0].outer_radius_m = 0.359e-3F;
  config.needle[0].bending_nm2 = bending_nm2;
  config.needle[0].bevel_per_m = curvature;
  Rig rig = make_rig(tiny, config);
  Steered result;
  const Vec3 start = {-1e-3F, 22.5e-3F, 22.5e-3F};
  for (int i = 0; i < 4050; ++i) {
    Input input = along_x(start + Vec3{20e-6F * static_cast<float>(i), 0, 0}, rig.length_m);
    if (flip && i > 2000) {  // half a turn about the needle, z of the handle
      const Quat q = input.handle.rotation;
      input.handle.rotation = {-q.z, q.y, -q.x, q.w};
    }
    const Output out = checked_tick(rig, input);
    ConstraintParticle list[kMaxConstraintParticles + 1];
    const std::uint32_t count = constraint_particles(rig.kernel(), list);
    Vec3 sum = {}, moment = {};
    double size = 1e-6;
    for (std::uint32_t p = 0; p < count; ++p) {
      sum = sum + list[p].force_on_needle_n;
      moment =
          moment + cross(list[p].position_m - input.handle.position_m, list[p].force_on_needle_n);
      size += norm_of(list[p].force_on_needle_n);
    }
    const double arm = static_cast<double>(rig.length_m);
    result.worst_sum = std::max({result.worst_sum, norm_of(sum - out.force_n) / size,
                                 norm_of(moment - out.torque_nm) / (size * arm)});
    result.tip = out.tip_m - start;
  }
  return result;
}

TEST(Steering, HandleFeelsTheSumOfTheParticles) {
  EXPECT_LT(steer(20000, 5, false).worst_sum, 1e-6);
  EXPECT_LT(steer(20000, 5, false, 0).worst_sum, 1e-6);
}

// The handle's +x is world +z here (rig.h turns -z onto +x).
TEST(Steering, BevelSteersToItsSideAndTheMoreTheStifferTheTissue) {
  const float straight = steer(40000, 0, false).tip.z;
  const float soft = steer(10000, 5, false).tip.z - straight;
  const float middle = steer(40000, 5, false).tip.z - straight;
  const float stiff = steer(160000, 5, false).tip.z - straight;
  EXPECT_GT(soft, 0.5e-3F);
  EXPECT_GT(middle, 1.3F * soft);
  EXPECT_GT(stiff, 1.3F * middle);
  // In tissue that gives way the needle never bends more than the arc of the bevel.
  EXPECT_LT(stiff, (1 - std::cos(5 * 0.08F)) / 5);
  // A tenth of the bevel's curvature bends a tenth as much.
  const float weak = steer(160000, 0.5F, false).tip.z - straight;
  EXPECT_NEAR(static_cast<double>(weak / stiff), 0.1, 0.01);
  // Rolled by half a turn, the path is mirrored.
  EXPECT_LT(steer(40000, 5, true).tip.z, 0.7F * middle);
}

TEST(Steering, ARigidNeedleGoesStraight) {
  EXPECT_NEAR(static_cast<double>(steer(40000, 5, false, 0).tip.z), 0, 1e-6);
}

}  // namespace
}  // namespace stylet::test
