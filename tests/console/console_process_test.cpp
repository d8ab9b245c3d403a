// SPDX-License-Identifier: Apache-2.0
// What the console's process may tell the loop's process, even after it has gone wrong.
#include "hal/console/console_process.h"

#include <gtest/gtest.h>

#include <random>

#include "hal/console/limits.h"

namespace stylet::console {
namespace {

std::string any_text(std::mt19937& random, std::size_t most) {
  std::string text(random() % (most + 1), ' ');
  for (char& each : text) each = static_cast<char>(' ' + random() % 95);
  return text;
}

Order any_order(std::mt19937& random) {
  const auto verb = static_cast<Verb>(random() % 10);
  return {verb, any_text(random, kMaxNameBytes), random(), static_cast<float>(random()),
          static_cast<std::uint32_t>(random())};
}

// What the session relies on.
bool within_bounds(const Order& order) {
  for (const char letter : order.text) {
    const auto each = static_cast<unsigned char>(letter);
    if (order.verb == Verb::kMark && (each < ' ' || each == 0x7F)) return false;
  }
  return order.verb >= Verb::kStart && order.verb <= Verb::kAcknowledge &&
         order.text.size() <= kMaxMessageBytes;
}

TEST(Wishes, AreReadAsTheyWereMeant) {
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const Order order = any_order(random);
    const Wish wish = wish_of(wish_message(order));
    const auto* read = std::get_if<Order>(&wish);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->verb, order.verb);
    EXPECT_EQ(read->text, order.text);
    EXPECT_EQ(read->tick, order.tick);
    EXPECT_EQ(read->speed, order.speed);
    EXPECT_EQ(read->needle, order.needle);
  }
  const Wish wish = wish_of(wish_message(PointerMoved{2, {{1, 2, 3}, {1, 0, 0, 0}}, 7}));
  EXPECT_EQ(std::get<PointerMoved>(wish).pose.position_m.y, 2);
  EXPECT_TRUE(std::holds_alternative<PointerLeft>(wish_of(wish_message(PointerLeft{}))));
}

TEST(Wishes, MutatedOnesAreWithinBoundsOrRefused) {
  std::mt19937 random(6);
  int refused = 0, read = 0;
  for (int i = 0; i < 200'000; ++i) {
    hal::Bytes bytes = wish_message(any_order(random));
    for (std::uint32_t hit = 0; hit <= random() % 4; ++hit) {
      bytes[random() % std::min<std::size_t>(bytes.size(), 24)] = std::byte(random());
    }
    bytes.resize(random() % 4 == 0 ? random() % (bytes.size() + 1) : bytes.size());
    try {
      const Wish wish = wish_of(bytes);
      if (const auto* order = std::get_if<Order>(&wish); order != nullptr) {
        ASSERT_TRUE(within_bounds(*order));
      }
      ++read;
    } catch (const hal::PackingError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace stylet::console
