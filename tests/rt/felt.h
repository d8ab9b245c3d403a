// SPDX-License-Identifier: Apache-2.0
// What a hand feels in the first cycle of a script, and how far two such cycles differ. Units: N.
#pragma once

#include <cmath>
#include <vector>

#include "base/math.h"
#include "session.h"

namespace stylet::test {

// The forces of an insertion, a pause, a pull to the side and the way out.
inline std::vector<Vec3> felt_n(Kernel& kernel, const Script& script) {
  std::vector<Vec3> felt;
  for (std::uint64_t i = 0; i < kCycleTicks; ++i) {
    felt.push_back(tick(kernel, scripted_input(script, i)).force_n);
  }
  return felt;
}

// Root of the mean square of the difference, over that of what is wanted.
inline double off(const std::vector<Vec3>& felt, const std::vector<Vec3>& wanted) {
  double difference = 0, all = 0;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    const Vec3 d = felt[i] - wanted[i];
    difference += static_cast<double>(dot(d, d));
    all += static_cast<double>(dot(wanted[i], wanted[i]));
  }
  return std::sqrt(difference / all);
}

}  // namespace stylet::test
