// SPDX-License-Identifier: Apache-2.0
// Memory that two processes share, when one of them writes nonsense into it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include "hal/base/channel.h"
#include "hal/base/follower.h"
#include "hal/base/packing.h"

namespace stylet::hal {
namespace {

struct Item {
  std::uint64_t words[5];
};

Item item(std::uint64_t value) {
  return {{value, value, value, value, value}};
}

bool whole(const Item& each) {
  return std::all_of(each.words, each.words + 5, [&](auto w) { return w == each.words[0]; });
}

// Memory on a cache line, with guard bytes on both sides.
struct Room {
  static constexpr std::size_t kGuard = 4096;
  explicit Room(std::size_t bytes) : bytes_(bytes), all(2 * kGuard + bytes + kCacheLine) {
    std::fill(all.begin(), all.end(), std::byte{0xA5});
    const auto at = reinterpret_cast<std::uintptr_t>(all.data() + kGuard);
    offset = kGuard + (kCacheLine - at % kCacheLine) % kCacheLine;
    std::fill(inside().begin(), inside().end(), std::byte{0});
  }
  std::span<std::byte> inside() { return std::span(all).subspan(offset, bytes_); }
  bool untouched_around() const {
    const auto guard = [](std::byte b) { return b == std::byte{0xA5}; };
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(offset);
    return std::all_of(all.begin(), begin, guard) &&
           std::all_of(begin + static_cast<std::ptrdiff_t>(bytes_), all.end(), guard);
  }
  std::size_t bytes_;
  std::vector<std::byte> all;
  std::size_t offset = 0;
};

TEST(SharedRing, TwoSidesKeepOrder) {
  Room room(Ring<Item>::bytes(7));
  Ring<Item> writer(room.inside()), reader(room.inside());
  std::mt19937 random(3);
  std::uint64_t pushed = 0, popped = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (random() % 2 == 0) {
      EXPECT_EQ(writer.push(item(pushed)), pushed - popped < 7);
      pushed += pushed - popped < 7 ? 1 : 0;
    } else {
      Item got = {};
      ASSERT_EQ(reader.pop(got), popped < pushed);
      if (popped < pushed) {
        EXPECT_EQ(got.words[0], popped++);
      }
    }
  }
  EXPECT_TRUE(room.untouched_around());
}

TEST(SharedRing, AnyBytesFromTheOtherSideOnlyLoseItems) {
  std::mt19937_64 random(28);
  for (int round = 0; round < 2000; ++round) {
    Room room(Ring<Item>::bytes(5));
    Ring<Item> writer(room.inside()), reader(room.inside());
    for (int step = 0; step < 30; ++step) {
      const std::uint64_t word = random() % 2 == 0 ? random() : random() % 12 - 6;
      const std::size_t at = random() % (room.inside().size() / 8) * 8;
      std::memcpy(room.inside().data() + at, &word, sizeof word);
      (void)writer.push(item(random()));
      Item got = {};
      (void)reader.pop(got);
    }
    ASSERT_TRUE(room.untouched_around()) << round;
  }
}

TEST(SharedLatest, AnyBytesFromTheOtherSideGiveAnOldItemAtWorst) {
  std::mt19937_64 random(28);
  for (int round = 0; round < 2000; ++round) {
    Room room(SharedLatest<Item>::bytes());
    SharedLatest<Item> writer(room.inside()), reader(room.inside());
    for (int step = 0; step < 30; ++step) {
      const auto word = static_cast<std::uint32_t>(random() % 2 == 0 ? random() : random() % 9);
      std::memcpy(room.inside().data(), &word, sizeof word);
      writer.draft() = item(random());
      writer.publish();
      (void)reader.take();
    }
    ASSERT_TRUE(room.untouched_around()) << round;
  }
}

TEST(SharedLatest, GivesTheNewest) {
  Room room(SharedLatest<Item>::bytes());
  SharedLatest<Item> writer(room.inside()), reader(room.inside());
  EXPECT_EQ(reader.take(), nullptr);
  for (std::uint64_t i = 1; i < 10; ++i) {
    writer.draft() = item(i);
    writer.publish();
    if (i % 3 != 0) continue;
    const Item* newest = reader.take();
    ASSERT_NE(newest, nullptr);
    EXPECT_EQ(newest->words[0], i);
    EXPECT_EQ(reader.take(), nullptr);
  }
}

TEST(Follower, SeesWholeItemsInOrderWhoeverTakesThem) {
  Ring<Item> ring(64);
  Follower<Item> follower(ring);
  constexpr std::uint64_t kItems = 200'000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kItems;) {
      if (ring.push(item(i))) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::thread reader([&] {
    Item got;
    for (std::uint64_t taken = 0; taken < kItems;) taken += ring.pop(got) ? 1U : 0U;
  });
  std::uint64_t last = 0, seen = 0;
  for (Item got; last < kItems;) {
    if (!follower.next(got)) continue;
    ASSERT_TRUE(whole(got));
    ASSERT_GT(got.words[0], last);
    last = got.words[0];
    ++seen;
  }
  writer.join();
  reader.join();
  EXPECT_EQ(seen + follower.lost(), kItems);
}

TEST(Packing, AnyBytesAreRefusedOrRead) {
  Packer packer;
  packer.put(std::string("needle")).put(3.5).put(std::vector<int>{1, 2, 3});
  std::mt19937 random(28);
  for (int round = 0; round < 5000; ++round) {
    Bytes bytes(packer.bytes().begin(), packer.bytes().end());
    if (round > 0) bytes.resize(random() % (bytes.size() + 1));
    for (int i = 0; round > 0 && i < 3 && !bytes.empty(); ++i) {
      bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    }
    std::string text;
    double number = 0;
    std::vector<int> numbers;
    try {
      Unpacker unpacker(bytes);
      unpacker.get(text);
      unpacker.get(number);
      unpacker.get(numbers);
    } catch (const PackingError&) {
      ASSERT_NE(round, 0);
    }
    if (round == 0) {
      EXPECT_EQ(text, "needle");
      EXPECT_EQ(number, 3.5);
      EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3}));
    }
    ASSERT_LE(text.size() + sizeof(int) * numbers.size(), packer.bytes().size());
  }
}

}  // namespace
}  // namespace stylet::hal
