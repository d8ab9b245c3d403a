// SPDX-License-Identifier: Apache-2.0
// Scalar mathematics of the kernel: vectors, rotations, exponential and logarithm.
//
// Promise: only + - * / and square root in a written order, so the same bits everywhere; no libm
// function but sqrt, which IEEE 754 rounds exactly. Eigen's products are not used because Eigen
// chooses their order of summation; here the order is part of the result.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "stylet/units.h"

namespace stylet {

// What returns a vector is always inlined: where vectors are returned in memory, as in WebAssembly,
// a call takes more code than the sums (9 kB of a page's library of 200 kB).
[[gnu::always_inline]] constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] constexpr Vec3 operator*(float s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}

// Row-major 3 x 3 matrix.
struct Mat3 {
  float m[3][3];
};

constexpr Vec3 operator*(const Mat3& a, Vec3 v) {
  return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
          a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
          a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}
constexpr Vec3 transposed_times(const Mat3& a, Vec3 v) {
  return {a.m[0][0] * v.x + a.m[1][0] * v.y + a.m[2][0] * v.z,
          a.m[0][1] * v.x + a.m[1][1] * v.y + a.m[2][1] * v.z,
          a.m[0][2] * v.x + a.m[1][2] * v.y + a.m[2][2] * v.z};
}
[[gnu::always_inline]] constexpr Vec3 column(const Mat3& a, int j) {
  return {a.m[0][j], a.m[1][j], a.m[2][j]};
}

constexpr Mat3 rotation_matrix(Quat q) {
  const float x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const float xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const float xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const float wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{{1 - (yy + zz), xy - wz, xz + wy},
           {xy + wz, 1 - (xx + zz), yz - wx},
           {xz - wy, yz + wx, 1 - (xx + yy)}}};
}

constexpr float clamp(float value, float low, float high) {
  return value < low ? low : (value > high ? high : value);
}
constexpr float max_of(float a, float b) {
  return a > b ? a : b;
}
constexpr float min_of(float a, float b) {
  return a < b ? a : b;
}

// The number without its fraction, for numbers within 2^31; never -0. On processors that truncate
// in one step, GCC 12 compiles two bare conversions to that step, and the sign of a zero survives.
template <typename Real>
Real whole_part(Real v) {
  const auto whole = static_cast<std::int32_t>(v);
  return whole == 0 ? Real{0} : static_cast<Real>(whole);
}

// Decaying values must end at zero, not among denormals, which processors may flush: sets values
// below 2e-12 to zero.
inline float settle(float v) {
  return (v + 1.52587890625e-05F) - 1.52587890625e-05F;
}
[[gnu::always_inline]] inline Vec3 settle(Vec3 v) {
  return {settle(v.x), settle(v.y), settle(v.z)};
}

// Finite: the exponent is not all ones. A bit test, so that it works with any compiler setting.
inline bool is_finite(float value) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7F800000U) != 0x7F800000U;
}
inline bool is_finite(Vec3 v) {
  return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// e^-x for x >= 0, relative error below 2e-7; 0 beyond 80. Range reduction to |r| <= ln(2)/2, then
// the Taylor series to r^7.
inline float exp_minus(float x) {
  if (!(x < 80.0F)) return 0.0F;
  const float n = static_cast<float>(static_cast<std::int32_t>(x * 1.44269504F + 0.5F));
  const float r = -((x - n * 0.693359375F) + n * 2.12194440e-4F);
  float p = 1.0F / 5040.0F;
  p = p * r + 1.0F / 720.0F;
  p = p * r + 1.0F / 120.0F;
  p = p * r + 1.0F / 24.0F;
  p = p * r + 1.0F / 6.0F;
  p = p * r + 0.5F;
  p = p * r + 1.0F;
  p = p * r + 1.0F;
  const std::uint32_t scale = static_cast<std::uint32_t>(127 - static_cast<std::int32_t>(n)) << 23U;
  return p * std::bit_cast<float>(scale);
}

// sin(pi x) for 0 <= x <= 1, error below 2e-7: the series to x^11 about the nearer end.
inline float sine_of_half_turns(float x) {
  const float near = x < 0.5F ? x : 1 - x;
  const float a = 3.14159265F * near, a2 = a * a;
  float p = -1.0F / 39916800.0F;
  p = p * a2 + 1.0F / 362880.0F;
  p = p * a2 - 1.0F / 5040.0F;
  p = p * a2 + 1.0F / 120.0F;
  p = p * a2 - 1.0F / 6.0F;
  p = p * a2 + 1.0F;
  return a * p;
}

// Natural logarithm of a normal positive number, relative error below 1e-6: exponent plus the
// series of 2 artanh((m - 1) / (m + 1)), m in [0.75, 1.5).
inline float natural_log(float x) {
  std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  std::int32_t exponent = static_cast<std::int32_t>(bits >> 23U) - 127;
  float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U);
  if (m >= 1.5F) {
    m = m * 0.5F;
    ++exponent;
  }
  const float s = (m - 1.0F) / (m + 1.0F);
  const float s2 = s * s;
  float p = 1.0F / 9.0F;
  p = p * s2 + 1.0F / 7.0F;
  p = p * s2 + 0.2F;
  p = p * s2 + 1.0F / 3.0F;
  p = p * s2 + 1.0F;
  return static_cast<float>(exponent) * 0.693147181F + 2.0F * s * p;
}

// For a positive, normal base.
inline float power(float base, float exponent) {
  const float x = exponent * natural_log(base);
  return x < 0 ? exp_minus(-x) : 1 / exp_minus(x);
}

}  // namespace stylet
