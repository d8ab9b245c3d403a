// SPDX-License-Identifier: Apache-2.0
// Numbers in messages of the C interface are those of printf's %g.

#include "hal/hosts/c/short_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "draw.h"

namespace stylet::test {
namespace {

std::string by_printf(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

TEST(ShortNumber, IsThatOfPrintf) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, -0.0, 1.0, -2.5, 0.0001, 1e-5, 100000.0, 1e6, 123456.0, 8e6, 0.49,
                             1e-4, 5e-324, 1.7e308, inf, -inf}) {
    EXPECT_EQ(c::ShortNumber(value).text(), by_printf(value));
  }
  EXPECT_STREQ(c::ShortNumber(std::nan("")).text(), "nan");
}

// Of random numbers the sixth digit may differ where the seventh is a five.
TEST(ShortNumber, IsRightToHalfOfTheLastDigit) {
  DoubleDraw draw(17);
  int same = 0;
  constexpr int kNumbers = 100000;
  for (int i = 0; i < kNumbers; ++i) {
    const double value = (draw.chance(0.5) ? -1 : 1) * draw.magnitude(1e-12, 1e12);
    const std::string text = c::ShortNumber(value).text();
    same += text == by_printf(value) ? 1 : 0;
    const double unit = std::pow(10, std::floor(std::log10(std::fabs(value))) - 5);
    ASSERT_NEAR(std::strtod(text.c_str(), nullptr), value, 0.5001 * unit) << text;
  }
  EXPECT_GT(same, kNumbers - 10);
}

}  // namespace
}  // namespace stylet::test
