// SPDX-License-Identifier: Apache-2.0
#include "hal/device/vendor_pose.h"

#include <algorithm>
#include <cmath>

namespace stylet::hal {

Quat rotation_of(const double (&m)[3][3]) {
  const double four[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2],
                          1 - m[0][0] + m[1][1] - m[2][2], 1 - m[0][0] - m[1][1] + m[2][2]};
  const double* largest = std::max_element(four, four + 4);
  const double s = 2 * std::sqrt(std::max(*largest, 1e-12));
  const double yz = (m[2][1] - m[1][2]) / s, zx = (m[0][2] - m[2][0]) / s,
               xy = (m[1][0] - m[0][1]) / s;
  const double sum_xy = (m[0][1] + m[1][0]) / s, sum_zx = (m[0][2] + m[2][0]) / s,
               sum_yz = (m[1][2] + m[2][1]) / s;
  const auto quat = [](double w, double x, double y, double z) {
    return Quat{static_cast<float>(w), static_cast<float>(x), static_cast<float>(y),
                static_cast<float>(z)};
  };
  switch (largest - four) {
    case 0:
      return quat(s / 4, yz, zx, xy);
    case 1:
      return quat(yz, s / 4, sum_xy, sum_zx);
    case 2:
      return quat(zx, sum_xy, s / 4, sum_yz);
    default:
      return quat(xy, sum_zx, sum_yz, s / 4);
  }
}

}  // namespace stylet::hal
