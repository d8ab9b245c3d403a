// SPDX-License-Identifier: Apache-2.0
// The contact of a needle's tip with tissue that stiffens (stiffening.h).
//
// Under a cone strains go with the cotangent of its half angle, however deep it is; under the
// cylinder that follows they grow with the depth. So the law of contact stays a parabola and a line
// (cone.h): the parabola is steeper by `shallow`, and goes on until the line has `deep` times the
// slope. Both come from finite elements (tests/fidelity/coupling/stiff_tip.py) and meet them within
// a tenth at Poisson's ratios of 0.3 to 0.49, down to four times the depth at which contact is as
// wide as the needle; at eight times the law is up to a quarter too soft.
//
// Promises: no allocation, no branch on hardware. PHYSICS 8.7.
#pragma once

#include "base/math.h"

namespace stylet {

struct StifferTip {
  float shallow, deep;  // over tissue that does not stiffen, at least 1
};

// `stiffening` of the tissue; `cotangent` of the tip's half angle. Poisson's ratio counts from
// 0.45.
inline StifferTip stiffer_tip(float stiffening, float cotangent, float poisson) {
  constexpr float kShallow = 3.0F, kShallowSlope = -34.0F;
  constexpr float kShallowPower = 0.206F, kShallowPowerSlope = 0.142F;
  constexpr float kDeep = 25.3F, kDeepSlope = -37.3F, kDeepPower = 0.645F;
  constexpr float kDeepMost = 6.03F, kDeepMostSlope = 45.8F, kDeepMostSquare = 213.0F;
  const float n = clamp(poisson, 0.3F, 0.49F) - 0.45F,
              strained = stiffening * cotangent * cotangent;
  if (!(strained > 0)) return {1, 1};
  const float shallow =
      power(1 + strained / (kShallow + kShallowSlope * n), kShallowPower + kShallowPowerSlope * n);
  // Below 1, where the finite elements begin, in proportion.
  const float v =
      min_of(strained, 1) * power(max_of(strained, 1) / (kDeep + kDeepSlope * n), kDeepPower);
  const float most = kDeepMost + (kDeepMostSlope + kDeepMostSquare * n) * n;
  return {shallow, max_of(shallow, 1 + most * (v / (1 + v)))};
}

}  // namespace stylet
