// SPDX-License-Identifier: Apache-2.0
// The kernel's own exponential and logarithm against the library's, in double precision.

#include "base/math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace stylet {
namespace {

double relative_error(float got, double wanted) {
  return std::fabs(static_cast<double>(got) - wanted) / std::fabs(wanted);
}

TEST(WholePart, IsTowardZeroAndNeverMinusZero) {
  for (const float v : {-7.0F, -6.5F, -1.0F, -0.5F, -0.0F, 0.0F, 0.99F, 1.0F, 64.5F}) {
    volatile float hidden = v;
    const float whole = whole_part(static_cast<float>(hidden));
    EXPECT_EQ(whole, std::trunc(v));
    EXPECT_EQ(std::signbit(whole), whole < 0) << v;
  }
}

TEST(ExpMinus, IsWithinItsBoundOverItsRange) {
  double worst = 0;
  float at = 0;
  for (int i = 0; i < 800000; ++i) {  // 0 to 80 in steps of 1e-4
    const float x = 1e-4F * static_cast<float>(i);
    const double error = relative_error(exp_minus(x), std::exp(-static_cast<double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LT(worst, 2e-7) << "at " << at;
}

TEST(ExpMinus, IsExactAtZeroAndZeroFarOut) {
  EXPECT_EQ(exp_minus(0), 1);
  EXPECT_EQ(exp_minus(1e-30F), 1);
  EXPECT_EQ(exp_minus(80), 0);
  EXPECT_EQ(exp_minus(1e30F), 0);
  EXPECT_EQ(exp_minus(std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(exp_minus(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(ExpMinus, NeverLeavesZeroToOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000000; ++i) {  // any bit pattern except negative numbers
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0x7FFFFFFFU);
    const float y = exp_minus(x);
    ASSERT_TRUE(y >= 0 && y <= 1) << x;
  }
}

// Away from 1 the bound is relative. Near 1, where the logarithm vanishes, it is in units of log 2
// = 0.69.
TEST(NaturalLog, IsWithinItsBoundOverAllNormalNumbers) {
  std::mt19937 random(2);
  double worst = 0;
  float at = 0;
  for (int i = 0; i < 1000000; ++i) {
    const std::uint32_t bits =
        0x00800000U + static_cast<std::uint32_t>(random()) % (0x7F800000U - 0x00800000U);
    const float x = std::bit_cast<float>(bits);
    const double error = relative_error(natural_log(x), std::log(static_cast<double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LT(worst, 1e-6) << "at " << at;
}

TEST(NaturalLog, IsWithinItsBoundWhereTheKernelUsesIt) {
  double worst = 0;
  float at = 0;
  for (int i = 0; i < 1000000; ++i) {  // far field over radius: 1.5 to 2500
    const float x = 1.5F * std::exp(7.4e-6F * static_cast<float>(i));
    const double error = relative_error(natural_log(x), std::log(static_cast<double>(x)));
    if (error > worst) {
      worst = error;
      at = x;
    }
  }
  EXPECT_LT(worst, 1e-6) << "at " << at;
}

TEST(NaturalLog, OfOneIsZero) {
  EXPECT_EQ(natural_log(1), 0);
}

TEST(IsFinite, IsFalseForNaNAndInfinityOnly) {
  using Limits = std::numeric_limits<float>;
  for (const float v : {0.0F, -0.0F, Limits::denorm_min(), Limits::max(), Limits::lowest()}) {
    EXPECT_TRUE(is_finite(v)) << v;
  }
  for (const float v :
       {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), Limits::signaling_NaN()}) {
    EXPECT_FALSE(is_finite(v)) << v;
  }
}

TEST(RotationMatrix, TurnsLikeTheQuaternion) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 10000; ++i) {
    Quat q = {normal(random), normal(random), normal(random), normal(random)};
    const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    q = {q.w / size, q.x / size, q.y / size, q.z / size};
    const Vec3 v = {normal(random), normal(random), normal(random)};
    const Vec3 axis = {q.x, q.y, q.z};
    const Vec3 expected = v + 2.0F * cross(axis, cross(axis, v) + q.w * v);  // q v q*
    const Vec3 got = rotation_matrix(q) * v;
    ASSERT_LT(norm(got - expected), 1e-6F * (1 + norm(v)));
    ASSERT_LT(norm(transposed_times(rotation_matrix(q), got) - v), 1e-6F * (1 + norm(v)));
  }
}

}  // namespace
}  // namespace stylet
