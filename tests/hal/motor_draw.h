// SPDX-License-Identifier: Apache-2.0
// What random sessions of motors are made of: random numbers that are the same everywhere, and a
// thread or machine that does nothing for a while.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "draw.h"
#include "stylet/units.h"
#include "vectors.h"

namespace stylet::hal {

constexpr std::int64_t kMs = 1'000'000;

using test::number_from;

// The command that runs this session of the current test by itself.
inline std::string alone(std::uint64_t seed) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return "STYLET_MOTOR_FIRST=" + std::to_string(seed) +
         " STYLET_MOTOR_SESSIONS=1 build/release/bin/hal_motor_backends --gtest_filter=" +
         test.test_suite_name() + "." + test.name();
}

using test::size;

struct Draw : test::DoubleDraw {
  using test::DoubleDraw::DoubleDraw;
  std::int64_t ms(double low, double high) {
    return static_cast<std::int64_t>(between(low, high) * 1e6);
  }
};

// Something that does nothing until a given time: at random, or periodically.
struct Stalls {
  double share = 0;           // fraction of wake-ups that begin a stall
  std::int64_t every_ns = 0;  // 0: only at random
  std::int64_t longest_ns = 0;
  std::int64_t until_ns = 0, next_ns = 0;

  static Stalls drawn(Draw& draw) {
    Stalls out;
    if (draw.chance(0.3)) return out;
    // Short and long stalls alike: 0.5 to 300 ms, evenly over the logarithm.
    out.longest_ns = static_cast<std::int64_t>(0.5e6 * std::pow(600.0, draw.unit()));
    if (draw.chance(0.3)) {
      out.every_ns = out.longest_ns + draw.ms(0.5, 40);
    } else {
      out.share = draw.between(0.0005, 0.02);
    }
    return out;
  }
  bool busy(Draw& draw, std::int64_t now_ns) {
    if (now_ns < until_ns) return true;
    const bool due = every_ns != 0 && now_ns >= next_ns;
    if (!due && !draw.chance(share)) return false;
    next_ns = now_ns + every_ns;
    until_ns =
        now_ns + (due ? longest_ns
                      : static_cast<std::int64_t>(draw.unit() * static_cast<double>(longest_ns)));
    return until_ns > now_ns;
  }
};

}  // namespace stylet::hal
