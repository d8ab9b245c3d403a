// SPDX-License-Identifier: Apache-2.0
#pragma once
// How near the comparisons of a test come to their bars. A build with STYLET_MARGINS includes this
// header before each source of a test; its programs then print, at their end, one line for each
// comparison of numbers: test, file and line, how often it was made, and the value that came
// nearest to its bar, with that bar. The results in section 17 of kernel/PHYSICS.md were read off
// these lines.
//
// EXPECT_NEAR gives the distance of the two numbers; EXPECT_LT and LE give the left number, GT and
// GE too. Integers, sizes and pointers are not recorded. One thread.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <type_traits>

namespace margins {

struct Margin {
  double value = 0.0, bar = 0.0, slack = 0.0;
  long count = 0;
};

// Prints what was recorded when the program ends.
class Record {
 public:
  ~Record() {
    for (const auto& [place, margin] : margins_)
      std::printf("margin %s  %.4g of %.4g  (%ld)\n", place.c_str(), margin.value, margin.bar,
                  margin.count);
  }
  // `slack` is what is left to the bar as a part of it: below zero where the comparison fails.
  void add(const char* file, int line, double value, double bar, double slack) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string whole(file);
    const std::string name = test == nullptr
                                 ? std::string("-")
                                 : std::string(test->test_suite_name()) + "." + test->name();
    Margin& margin =
        margins_[name + " " + whole.substr(whole.rfind('/') + 1) + ":" + std::to_string(line)];
    if (margin.count++ == 0 || slack < margin.slack)
      margin = {value, bar, slack, margin.count};
  }

 private:
  std::map<std::string, Margin> margins_;
};

inline Record& record() {
  static Record all;
  return all;
}

struct Near {
  const char* file;
  int line;
  testing::AssertionResult operator()(const char* a, const char* b, const char* c, double value,
                                      double wanted, double bar) const {
    const double off = std::fabs(value - wanted);
    record().add(file, line, off, bar, bar > 0.0 ? 1.0 - off / bar : -off);
    return testing::internal::DoubleNearPredFormat(a, b, c, value, wanted, bar);
  }
};

// `kSign` is 1 where the left number must be below the bar, -1 where it must be above.
template <int kSign>
struct Order {
  const char* file;
  int line;
  bool strict;
  template <class A, class B>
  testing::AssertionResult operator()(const char* a, const char* b, const A& value,
                                      const B& bar) const {
    if constexpr (std::is_floating_point_v<A> && std::is_arithmetic_v<B>) {
      const double size = std::fabs(static_cast<double>(bar));
      const double left = kSign * (static_cast<double>(bar) - static_cast<double>(value));
      record().add(file, line, value, bar, size > 0.0 ? left / size : left);
    }
    if constexpr (kSign > 0)
      return strict ? testing::internal::CmpHelperLT(a, b, value, bar)
                    : testing::internal::CmpHelperLE(a, b, value, bar);
    else
      return strict ? testing::internal::CmpHelperGT(a, b, value, bar)
                    : testing::internal::CmpHelperGE(a, b, value, bar);
  }
};

}  // namespace margins

// clang-format off
#undef EXPECT_NEAR
#undef ASSERT_NEAR
#undef EXPECT_LT
#undef ASSERT_LT
#undef EXPECT_LE
#undef ASSERT_LE
#undef EXPECT_GT
#undef ASSERT_GT
#undef EXPECT_GE
#undef ASSERT_GE
#define STYLET_NEAR (margins::Near{__FILE__, __LINE__})
#define STYLET_ORDER(sign, strict) (margins::Order<sign>{__FILE__, __LINE__, strict})
#define EXPECT_NEAR(a, b, c) EXPECT_PRED_FORMAT3(STYLET_NEAR, a, b, c)
#define ASSERT_NEAR(a, b, c) ASSERT_PRED_FORMAT3(STYLET_NEAR, a, b, c)
#define EXPECT_LT(a, b) EXPECT_PRED_FORMAT2(STYLET_ORDER(1, true), a, b)
#define ASSERT_LT(a, b) ASSERT_PRED_FORMAT2(STYLET_ORDER(1, true), a, b)
#define EXPECT_LE(a, b) EXPECT_PRED_FORMAT2(STYLET_ORDER(1, false), a, b)
#define ASSERT_LE(a, b) ASSERT_PRED_FORMAT2(STYLET_ORDER(1, false), a, b)
#define EXPECT_GT(a, b) EXPECT_PRED_FORMAT2(STYLET_ORDER(-1, true), a, b)
#define ASSERT_GT(a, b) ASSERT_PRED_FORMAT2(STYLET_ORDER(-1, true), a, b)
#define EXPECT_GE(a, b) EXPECT_PRED_FORMAT2(STYLET_ORDER(-1, false), a, b)
#define ASSERT_GE(a, b) ASSERT_PRED_FORMAT2(STYLET_ORDER(-1, false), a, b)
// clang-format on
