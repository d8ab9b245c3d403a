// SPDX-License-Identifier: Apache-2.0
// V15, V16, V17: the cantilever, the elastica and buckling, against closed forms and tables.
#include <gtest/gtest.h>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kLength = 0.15, kBending = 2.07e-2;  // 18G

TEST(Cantilever, SmallDeflectionIsTheClosedFormOfTheChain) {
  for (const std::uint32_t rods : {10U, 20U, 40U, 128U}) {
    const auto n = needle(rods, kLength, kBending);
    const double force = 1e-5;
    n->push(kLength, {0, force, 0});
    ASSERT_TRUE(n->settle());
    const double expected = force * kLength * kLength * kLength / (3 * kBending) *
                            (1 + 0.5 / (rods * static_cast<double>(rods)));
    EXPECT_NEAR(n->tip().y / expected, 1, 1e-6) << rods;
    EXPECT_NEAR(bending_energy(n->model, n->shape) / (0.5 * force * expected), 1, 1e-6) << rods;
  }
}

// Clamped at the base, dead load across the tip: physics of Bisshopp and Drucker 1945.
struct Elastica {
  double a, tip_rad, shortening, deflection;
};
constexpr Elastica kElastica[] = {
    {0.10, 0.04995, 0.00067, 0.03330}, {0.25, 0.12429, 0.00412, 0.08275},
    {0.50, 0.24453, 0.01592, 0.16214}, {1.00, 0.46135, 0.05643, 0.30172},
    {1.50, 0.63954, 0.10794, 0.41098}, {2.00, 0.78175, 0.16064, 0.49346},
    {3.00, 0.98602, 0.25442, 0.60325}, {4.00, 1.12124, 0.32894, 0.66996},
    {5.00, 1.21537, 0.38763, 0.71379}, {7.50, 1.35593, 0.48957, 0.77670},
    {10.0, 1.43029, 0.55500, 0.81061}};
constexpr double kLastDigit = 0.5e-5;

TEST(Cantilever, LargeDeflectionIsTheElastica) {
  for (const Elastica& row : kElastica) {
    const auto n = needle(40, kLength, kBending);
    n->push(kLength, {row.a * kBending / (kLength * kLength), 0, 0});
    ASSERT_TRUE(n->settle()) << row.a;
    const Vec3d last = n->result.direction[39];
    EXPECT_NEAR(n->tip().x / kLength, row.deflection, 1e-3 * row.deflection + kLastDigit) << row.a;
    EXPECT_NEAR(1 + n->tip().z / kLength, row.shortening, 1e-3 * row.shortening + kLastDigit)
        << row.a;
    EXPECT_NEAR(std::asin(last.x), row.tip_rad, 1e-3 * row.tip_rad + kLastDigit) << row.a;
  }
}

// A moment at the tip, as a pair of forces across the last rod that turns with it. (With a pair
// that keeps its direction, a needle that is turned by more than a right angle slips out of the
// plane.)
TEST(Cantilever, EndMomentBendsItToACircle) {
  constexpr std::uint32_t kRods = 40;
  const double turn_rad = 1.5, moment = turn_rad * kBending / kLength;
  const auto n = needle(kRods, kLength, kBending);
  for (int i = 0; i < 20; ++i) {
    const Vec3d t = i == 0 ? Vec3d{0, 0, -1} : n->result.direction[kRods - 1];
    const Vec3d pair = (moment / n->model.rod_m) * Vec3d{-t.z, 0, t.x};
    n->loads.count = 0;
    n->push(kLength, pair);
    n->push(kLength - n->model.rod_m, -1.0 * pair);
    n->tick();
  }
  const double kink = moment * n->model.rod_m / kBending;
  for (std::uint32_t j = 0; j < kRods; ++j) {
    const Vec3d before = j == 0 ? Vec3d{0, 0, -1} : n->result.direction[j - 1];
    EXPECT_NEAR(std::asin(norm(cross(before, n->result.direction[j]))), j == 0 ? 0.5 * kink : kink,
                2e-6 * kink)
        << j;
  }
  // Every joint feels the moment; the clamp, twice as stiff, turns by half.
  EXPECT_NEAR(bending_energy(n->model, n->shape) / (0.5 * moment * kink * (kRods - 0.5)), 1, 4e-6);
  const Vec3d last = n->result.direction[kRods - 1];
  EXPECT_NEAR(std::atan2(last.x, -last.z), turn_rad * (1 - 0.5 / kRods), 2e-6 * turn_rad);
}

// The axial force at which a straight needle's second derivative stops being positive.
double buckling_n(std::uint32_t rods, double lateral_n_per_m) {
  double stable = 0, unstable = 400;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (stable + unstable);
    const auto n = needle(rods, kLength, kBending);
    n->push(kLength, {0, 0, middle});
    n->hold(kLength, {0, 0, 0}, lateral_n_per_m * kLateral);
    n->tick();
    (n->result.least_pivot > 0 ? stable : unstable) = middle;
  }
  return stable;
}

TEST(Buckling, ClampedFreeIsHenckysChain) {
  for (const std::uint32_t rods : {5U, 10U, 20U, 40U}) {
    const double s = std::sin(kPi / (4 * rods));
    const double chain_n = 4.0 * rods * rods * kBending / (kLength * kLength) * s * s;
    EXPECT_NEAR(buckling_n(rods, 0) / chain_n, 1, 1e-6) << rods;
  }
  const double euler_n = kPi * kPi * kBending / (4 * kLength * kLength);
  EXPECT_NEAR(buckling_n(40, 0) / euler_n, 1, 1e-3);
}

// A chain pinned at both ends is two clamped-free ones, back to back: the half rod at the clamp is
// half of its middle rod. Ratios to Euler's load with 10, 20 and 40 rods.
TEST(Buckling, PinnedPinnedIsTwoClampedFreeChains) {
  const double euler_n = kPi * kPi * kBending / (4 * kLength * kLength);
  EXPECT_NEAR(buckling_n(5, 0) / euler_n, 0.99180, 1e-5);
  EXPECT_NEAR(buckling_n(10, 0) / euler_n, 0.99795, 1e-5);
  EXPECT_NEAR(buckling_n(20, 0) / euler_n, 0.99949, 1e-5);
}

TEST(Buckling, ClampedPinnedIsEulers) {
  const double euler_n = 20.1907 * kBending / (kLength * kLength);
  for (const std::uint32_t rods : {64U, 128U}) {
    EXPECT_NEAR(buckling_n(rods, 1e6) / euler_n, 1, 1e-3) << rods;
  }
}

TEST(Buckling, AboveTheLoadTheNeedleBendsBelowItStaysStraight) {
  const double euler_n = kPi * kPi * kBending / (4 * kLength * kLength);
  for (const double share : {0.98, 1.05}) {
    const auto n = needle(40, kLength, kBending);
    n->push(kLength, {1e-9, 0, share * euler_n});
    ASSERT_TRUE(n->settle(1e-12)) << share;
    EXPECT_GT(n->result.least_pivot, 0) << share;
    if (share < 1) {
      EXPECT_LT(n->tip().x, 1e-6);
    } else {  // P / Pe = (2 K(k) / pi)^2 gives k = 0.306, tip at 2 k L / K(k)
      EXPECT_NEAR(n->tip().x / kLength, 0.380, 0.004);
    }
  }
}

TEST(Rigid, IsAStiffNeedle) {
  const auto n = needle(64, kLength, kRigidBendingNm2);
  n->push(kLength, {5, 3, 20});
  n->push(0.5 * kLength, {-10, 4, 0});
  ASSERT_TRUE(n->settle(1e-9));
  EXPECT_LT(norm(n->tip() - Vec3d{0, 0, -kLength}), 1e-7);
  EXPECT_NEAR(n->result.torque_nm.x, 3 * kLength + 4 * 0.5 * kLength, 1e-6);
}

}  // namespace
}  // namespace stylet::test
