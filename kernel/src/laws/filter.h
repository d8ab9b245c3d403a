// SPDX-License-Identifier: Apache-2.0
// True mass at a long step: a polynomial that slows the short waves of the lattice and leaves the
// long ones alone.
//
// An explicit step is stable while no wave is faster than 4 / (dt (dt + 2 tau)), as a squared
// frequency. Let b_c be the stiffness of voxel c's stiffest motion, k (1 + 3 lambda / (2 G)) per
// corner, and
//     (L u)_i = sum over the voxels c of node i of  b_c (u_i - mean of u over the corners of c).
// No voxel is stiffer than its part of L, so no organ is stiffer than L, whatever its materials.
// Springs of constraint particles hold a voxel as a whole, which L does not contain: they add a
// bound of their own to the diagonal at each corner, at most k (match.cpp). With S = M^-1 L, whose
// largest eigenvalue s is at most the largest sum of b_c + k over m_i, the step
//     w += dt f / m,   v = p(S) w,   u += dt v
// is stable if x p(x) stays below that limit for x in [0, s]. p is the polynomial of Chebyshev
// with damping, p(0) = 1: with n passes of L it divides s by up to 3.6, 7.9, 13.9, 21.7,
// 31.2, 42.4 or 55.3 (n = 1 to 7; undamped it would be (n + 1)^2). So
//  - at rest nothing changes: without forces there is no motion;
//  - long waves (S w small) have the mass that tissue has;
//  - momentum is that of m w, exactly, and so is its moment;
//  - w . M v / 2 is the kinetic energy, exactly: p(S) is symmetric in M.
// If p is written as a product or by Horner's scheme, the passes have coefficients of thousands and
// lose a float's digits; the recurrence of Chebyshev's polynomials has none above 4.
//
// Promises: this file's part happens at creation, in a fixed order; the passes are in
// lattice/filter_passes.h. Units SI. Source: Carle, Hochbruck and Sturm 2020
// (leapfrog-Chebyshev), with L in place of the stiffness. PHYSICS 3.4.
#pragma once

#include <cstdint>

#include "stylet/limits.h"

namespace stylet {

// Factors of the next iterate: of the last one, of w, of the one before, and of S times the last.
// In pass 1, `last` alone counts: w is the last one, and none is before.
struct FilterPass {
  float last, first, before, bound_s2;
};

struct Filter {
  std::uint32_t passes;
  float limit_per_s2;  // bound of x p(x)
  FilterPass pass[kMaxFilterPasses];
};

// The limit of a step; below, the largest d / m that kMaxFilterPasses passes can bring to it.
float wave_limit_per_s2(float step_s, float tau_s);
float most_filtered_per_s2(float limit_per_s2);
// The fewest passes that bring `fastest_per_s2`, the largest d / m, to the limit; all passes if no
// number does.
Filter choose_filter(float limit_per_s2, float fastest_per_s2);

}  // namespace stylet
