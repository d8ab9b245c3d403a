// SPDX-License-Identifier: Apache-2.0
// Numbers in files: the bytes are made here by arithmetic and by the layout of IEEE 754.
#include "base/numbers.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>

namespace stylet::test {
namespace {

// Bytes of random integers, made by division, at any offset of a text.
template <typename T>
void expect_numbers(std::mt19937_64& engine) {
  for (int round = 0; round < 200; ++round) {
    const auto wanted = static_cast<std::make_unsigned_t<T>>(engine());
    std::string little, before(engine() % 9, 'b');
    std::uint64_t rest = wanted;
    for (std::size_t i = 0; i < sizeof(T); ++i, rest /= 256) {
      little += static_cast<char>(rest % 256);
    }
    const std::string big(little.rbegin(), little.rend());
    for (const auto& [bytes, order] :
         {std::pair(little, std::endian::little), std::pair(big, std::endian::big)}) {
      EXPECT_EQ(offline::number_at<T>(before + bytes + "a", before.size(), order),
                static_cast<T>(wanted));
    }
  }
}

TEST(NumbersInFiles, AreIntegersInEitherByteOrderAtAnyByte) {
  std::mt19937_64 engine(7);
  expect_numbers<std::int8_t>(engine);
  expect_numbers<std::uint8_t>(engine);
  expect_numbers<std::int16_t>(engine);
  expect_numbers<std::uint16_t>(engine);
  expect_numbers<std::int32_t>(engine);
  expect_numbers<std::uint32_t>(engine);
  expect_numbers<std::int64_t>(engine);
  expect_numbers<std::uint64_t>(engine);
}

// Sign, exponent and fraction as IEEE 754 lays them out.
TEST(NumbersInFiles, AreRealNumbersInEitherByteOrder) {
  using offline::number_at;
  const std::string one("\x3f\x80\0\0", 4), minus("\xc0\x04\0\0\0\0\0\0", 8);
  EXPECT_EQ(number_at<float>(one, 0, std::endian::big), 1.0F);
  EXPECT_EQ(number_at<double>(minus, 0, std::endian::big), -2.5);
  EXPECT_EQ(number_at<float>(std::string(one.rbegin(), one.rend()), 0, std::endian::little), 1.0F);
  EXPECT_EQ(number_at<double>(std::string(minus.rbegin(), minus.rend()), 0, std::endian::little),
            -2.5);
}

}  // namespace
}  // namespace stylet::test
