// SPDX-License-Identifier: Apache-2.0
// Sine and cosine without libm, against libm.
#include "hal/base/angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylet::hal {
namespace {

TEST(Angle, IsThatOfLibmToTheLastPlaces) {
  using Wide = long double;
  Wide worst = 0;
  for (int i = -40000; i <= 40000; ++i) {
    const double turns = i / 400.0 + 1e-5;
    const Wide angle = static_cast<Wide>(turns) * 2 * std::numbers::pi_v<Wide>;
    const SineCosine found = sine_cosine(turns);
    worst = std::max({worst, std::fabs(static_cast<Wide>(found.sine) - std::sin(angle)),
                      std::fabs(static_cast<Wide>(found.cosine) - std::cos(angle))});
  }
  EXPECT_LT(static_cast<double>(worst), 1e-15);
}

TEST(Angle, QuarterTurnsAreExact) {
  for (int i = -400; i <= 400; ++i) {
    const SineCosine found = sine_cosine(0.25 * i);
    const int quarter = (i % 4 + 4) % 4;
    EXPECT_EQ(found.sine, quarter == 1 ? 1 : quarter == 3 ? -1 : 0) << i;
    EXPECT_EQ(found.cosine, quarter == 0 ? 1 : quarter == 2 ? -1 : 0) << i;
  }
}

TEST(Angle, IsOnTheUnitCircle) {
  for (int i = 0; i < 100000; ++i) {
    const SineCosine found = sine_cosine(i * 1.234567e-3);
    ASSERT_NEAR(found.sine * found.sine + found.cosine * found.cosine, 1, 5e-16) << i;
  }
}

}  // namespace
}  // namespace stylet::hal
