// SPDX-License-Identifier: Apache-2.0
#include "hal/base/channel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace stylet::hal {
namespace {

// Wide enough that a torn copy would be noticed.
struct Wide {
  std::uint64_t words[24];
};

Wide wide(std::uint64_t value) {
  Wide item;
  for (std::uint64_t& word : item.words) word = value;
  return item;
}

bool torn(const Wide& item) {
  for (const std::uint64_t word : item.words) {
    if (word != item.words[0]) return true;
  }
  return false;
}

TEST(Ring, KeepsOrderAndSaysWhenItIsFull) {
  Ring<int> ring(3);
  EXPECT_EQ(ring.capacity(), 3U);
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(ring.push(10 * round + i));
    EXPECT_FALSE(ring.push(99));
    int item = -1;
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(ring.pop(item));
      EXPECT_EQ(item, 10 * round + i);
    }
    EXPECT_FALSE(ring.pop(item));
  }
}

TEST(Ring, LosesAndTearsNothingBetweenThreads) {
  constexpr std::uint64_t kItems = 200'000;
  Ring<Wide> ring(64);
  std::thread writer([&ring] {
    for (std::uint64_t i = 0; i < kItems; ++i) {
      while (!ring.push(wide(i))) std::this_thread::yield();
    }
  });
  std::uint64_t expected = 0, faults = 0;
  while (expected < kItems) {
    Wide item;
    if (!ring.pop(item)) {
      std::this_thread::yield();
      continue;
    }
    if (torn(item) || item.words[0] != expected) ++faults;
    ++expected;
  }
  writer.join();
  EXPECT_EQ(faults, 0U);
}

TEST(Latest, GivesTheNewestOnce) {
  Latest<int> latest;
  int item = -1;
  EXPECT_FALSE(latest.take(item));
  for (int i = 0; i < 5; ++i) latest.publish(i);
  ASSERT_TRUE(latest.take(item));
  EXPECT_EQ(item, 4);
  EXPECT_FALSE(latest.take(item));
  latest.publish(5);
  ASSERT_TRUE(latest.take(item));
  EXPECT_EQ(item, 5);
}

TEST(Latest, NeverGoesBackAndNeverTears) {
  constexpr std::uint64_t kItems = 200'000;
  Latest<Wide> latest;
  std::thread writer([&latest] {
    for (std::uint64_t i = 1; i <= kItems; ++i) latest.publish(wide(i));
  });
  std::uint64_t newest = 0, faults = 0;
  while (newest < kItems) {
    Wide item;
    if (!latest.take(item)) {
      std::this_thread::yield();
      continue;
    }
    if (torn(item) || item.words[0] <= newest) ++faults;
    newest = item.words[0];
  }
  writer.join();
  EXPECT_EQ(faults, 0U);
}

}  // namespace
}  // namespace stylet::hal
