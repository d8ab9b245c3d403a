// SPDX-License-Identifier: Apache-2.0
// The rotation of a cluster: one step of an eigenvector iteration that starts from the last
// rotation and never moves away from the solution.
//
// The best rotation of A (paper section IV, Mueller et al. 2005) is the largest eigenvector of
// Davenport's 4 x 4 matrix K(A). Seen from the last rotation R, with B = R^T A, K has the corner
// rho = tr B, the side a = axial vector of B and the block S = B + B^T - rho I. For a shift lambda
// the correction quaternion is (det M, adj(M) a), M = lambda I - S. It is exact for
// lambda = lambda_max; any lambda above it moves towards the answer, never away from it.
//
// The shift is the larger eigenvalue of [[rho, |a|], [|a|, mu]], with mu an upper bound of the
// block's largest eigenvalue (mean plus sqrt(2/3) of the deviator's norm). The shift exceeds
// lambda_max, but only by O(|a|^2), so the error shrinks with the third power.
// Measured against double-precision SVD, stretches 0.2 to 2, start 0.1 rad away: one step 9e-5 rad
// (median), two steps 1e-7 rad in float. The simpler bound sqrt(3) |A| leaves half of the error at
// strong stretch; Newton without a bound locks 180 degrees wrong in violent motion.
//
// Promise: no branch, no iteration count; finite for finite A, also for collapsed and inverted
// clusters. At rest A is near the identity, or near the lattice's 4 h times that: a constant
// that keeps M regular (`tiny`) has the same scale. PHYSICS 2.2.
#pragma once

namespace stylet {

// Internal linkage throughout: this header is compiled for several instruction sets, and the linker
// must not merge their copies.
static inline float root(float x) {
  return __builtin_sqrtf(x);
}
static inline double root(double x) {
  return __builtin_sqrt(x);
}

// K(A) as seen from the last rotation: side, block, corner.
template <typename T>
struct Davenport {
  T ax, ay, az, sx, sy, sz, sxy, sxz, syz, rho;
};

template <typename T>
static inline Davenport<T> davenport(T a00, T a01, T a02, T a10, T a11, T a12, T a20, T a21, T a22,
                                     T qw, T qx, T qy, T qz) {
  const T x2 = qx + qx, y2 = qy + qy, z2 = qz + qz;
  const T xx = qx * x2, yy = qy * y2, zz = qz * z2;
  const T xy = qx * y2, xz = qx * z2, yz = qy * z2;
  const T wx = qw * x2, wy = qw * y2, wz = qw * z2;
  const T r00 = 1 - (yy + zz), r01 = xy - wz, r02 = xz + wy;
  const T r10 = xy + wz, r11 = 1 - (xx + zz), r12 = yz - wx;
  const T r20 = xz - wy, r21 = yz + wx, r22 = 1 - (xx + yy);

  const T b00 = r00 * a00 + r10 * a10 + r20 * a20;
  const T b01 = r00 * a01 + r10 * a11 + r20 * a21;
  const T b02 = r00 * a02 + r10 * a12 + r20 * a22;
  const T b10 = r01 * a00 + r11 * a10 + r21 * a20;
  const T b11 = r01 * a01 + r11 * a11 + r21 * a21;
  const T b12 = r01 * a02 + r11 * a12 + r21 * a22;
  const T b20 = r02 * a00 + r12 * a10 + r22 * a20;
  const T b21 = r02 * a01 + r12 * a11 + r22 * a21;
  const T b22 = r02 * a02 + r12 * a12 + r22 * a22;

  const T rho = b00 + b11 + b22;
  return {b21 - b12,       b02 - b20, b10 - b01, b00 + b00 - rho, b11 + b11 - rho,
          b22 + b22 - rho, b01 + b10, b02 + b20, b12 + b21,       rho};
}

// Upper bound of the largest eigenvalue of the block; the block's trace is -rho.
template <typename T>
static inline T block_bound(const Davenport<T>& k) {
  const T mean = k.rho * T(-1.0 / 3.0);
  const T dx = k.sx - mean, dy = k.sy - mean, dz = k.sz - mean;
  const T deviator =
      dx * dx + dy * dy + dz * dz + T(2) * (k.sxy * k.sxy + k.sxz * k.sxz + k.syz * k.syz);
  return mean + root(deviator * T(2.0 / 3.0));
}

// Refined: Newton from above on the block's characteristic cubic, for inverted clusters, whose two
// largest eigenvalues lie close together.
template <int Refinements, typename T>
static inline T refined_bound(const Davenport<T>& k, T mu) {
  for (int i = 0; i < 3 * Refinements; ++i) {
    const T exx = mu - k.sx, eyy = mu - k.sy, ezz = mu - k.sz;
    const T kxx = eyy * ezz - k.syz * k.syz, kyy = exx * ezz - k.sxz * k.sxz;
    const T kzz = exx * eyy - k.sxy * k.sxy;
    const T det =
        exx * kxx - k.sxy * (k.sxy * ezz + k.sxz * k.syz) - k.sxz * (k.sxy * k.syz + eyy * k.sxz);
    mu = mu - (det > 0 ? det : T(0)) / (kxx + kyy + kzz + T(1e-12));
  }
  return mu;
}

// The shift lambda from corner, side and a bound `mu` of the block.
template <typename T>
static inline T shift_for(T rho, T ax, T ay, T az, T mu, T tiny = T(1e-5)) {
  const T half = (rho - mu) * T(0.5);
  // The constant keeps M regular when the cluster has collapsed to a point.
  return (rho + mu) * T(0.5) + root(half * half + (ax * ax + ay * ay + az * az)) + tiny;
}

// The largest eigenvector as a quaternion of any length, for M = lambda I - S and side a.
template <typename T>
struct Correction {
  T w, x, y, z;
};
template <typename T>
static inline Correction<T> correction(T mxx, T myy, T mzz, T sxy, T sxz, T syz, T ax, T ay, T az) {
  const T cxx = myy * mzz - syz * syz;
  const T cxy = sxz * syz + sxy * mzz;
  const T cxz = sxy * syz + sxz * myy;
  const T cyy = mxx * mzz - sxz * sxz;
  const T cyz = sxy * sxz + syz * mxx;
  const T czz = mxx * myy - sxy * sxy;
  return {mxx * cxx - (sxy * cxy + sxz * cxz), cxx * ax + cxy * ay + cxz * az,
          cxy * ax + cyy * ay + cyz * az, cxz * ax + cyz * ay + czz * az};
}

// q times the correction: a quaternion of any length.
template <typename T>
static inline Correction<T> product(const Correction<T>& by, T qw, T qx, T qy, T qz) {
  // Below zero only by rounding. A cluster without any direction, v = 0, does not turn; one smaller
  // than a thousandth of its size at rest turns slowly.
  const T w = by.w > T(1e-17) ? by.w : T(1e-17);
  return {
      qw * w - (qx * by.x + qy * by.y + qz * by.z), qw * by.x + qx * w + (qy * by.z - qz * by.y),
      qw * by.y + qy * w + (qz * by.x - qx * by.z), qw * by.z + qz * w + (qx * by.y - qy * by.x)};
}
template <typename T>
static inline T length(const Correction<T>& p) {
  return root((p.w * p.w + p.x * p.x) + (p.y * p.y + p.z * p.z));
}
// Of unit length. The product is normalised, not the factor: else errors of 1e-7 in length would
// add up tick by tick.
template <typename T>
static inline Correction<T> unit(const Correction<T>& p, T length_of_p) {
  const T inverse = 1 / length_of_p;
  const T w = p.w * inverse, x = p.x * inverse, y = p.y * inverse, z = p.z * inverse;
  // One Newton step on the rounded root, added part by part, for the last digit.
  const T e = T(0.5) - T(0.5) * ((w * w + x * x) + (y * y + z * z));
  return {w + e * w, x + e * x, y + e * y, z + e * z};
}

// `Refinements`: how many Rayleigh quotients sharpen lambda before the step (0 in the lattice
// sweep, 1 where constraint particles make the match anisotropic).
template <int Refinements, typename T>
static inline void rotation_step(T a00, T a01, T a02, T a10, T a11, T a12, T a20, T a21, T a22,
                                 T& qw, T& qx, T& qy, T& qz) {
  const Davenport<T> k = davenport(a00, a01, a02, a10, a11, a12, a20, a21, a22, qw, qx, qy, qz);
  const T mu = refined_bound<Refinements>(k, block_bound(k));
  T lambda = shift_for(k.rho, k.ax, k.ay, k.az, mu);
  Correction<T> by = {};
  for (int refinement = 0; refinement <= Refinements; ++refinement) {
    by = correction(lambda - k.sx, lambda - k.sy, lambda - k.sz, k.sxy, k.sxz, k.syz, k.ax, k.ay,
                    k.az);
    if (refinement < Refinements) {
      // Rayleigh quotient; K (w, v) = (rho w + a.v, lambda v) because M v = w a.
      const T vv = by.x * by.x + by.y * by.y + by.z * by.z;
      const T av = k.ax * by.x + k.ay * by.y + k.az * by.z;
      const T quotient = (by.w * (k.rho * by.w + av) + lambda * vv) / (by.w * by.w + vv);
      // A bound from below may fall under S: never closer to it than to the old shift.
      lambda = quotient > mu ? quotient + (lambda - quotient) * T(1e-6) : lambda;
    }
  }
  const Correction<T> p = product(by, qw, qx, qy, qz);
  const Correction<T> q = unit(p, length(p));
  qw = q.w;
  qx = q.x;
  qy = q.y;
  qz = q.z;
}

}  // namespace stylet
