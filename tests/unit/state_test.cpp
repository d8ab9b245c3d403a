// SPDX-License-Identifier: Apache-2.0
// Snapshot, restore, hash, difference, events.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "session.h"
#include "state/events.h"
#include "state/invariants.h"
#include "state/layout.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

struct Pair {
  std::unique_ptr<OpenOrgan> organ = block_organ(6, 5, 8, {0, true});
  Session a = make_session(organ->organ, Config{}), b = make_session(organ->organ, Config{});
  Script script = block_script(organ->organ, Config{});
};

void expect_equal(const Kernel& a, const Kernel& b) {
  const Difference d = difference(a, b);
  EXPECT_EQ(d.field, nullptr) << d.field << "[" << d.index << "]";
  EXPECT_EQ(hash(a), hash(b));
}

TEST(Snapshot, ContinuesWithTheSameBits) {
  Pair p;
  run(p.a.kernel, p.script, 0, 1200);  // in the middle of an insertion
  std::vector<std::byte> saved(snapshot_bytes(p.a.kernel));
  ASSERT_EQ(snapshot(p.a.kernel, saved), Status::kOk);
  run(p.a.kernel, p.script, 1200, 3000);
  run(p.b.kernel, p.script, 7, 400);  // a different state
  ASSERT_EQ(restore(p.b.kernel, saved), Status::kOk);
  run(p.b.kernel, p.script, 1200, 3000);
  expect_equal(p.a.kernel, p.b.kernel);
}

TEST(Snapshot, RefusesOtherOrgansConfigsSizesAndBytes) {
  Pair p;
  run(p.a.kernel, p.script, 0, 100);
  std::vector<std::byte> saved(snapshot_bytes(p.a.kernel));
  EXPECT_EQ(snapshot(p.a.kernel, std::span(saved).first(saved.size() - 1)),
            Status::kMemoryTooSmall);
  ASSERT_EQ(snapshot(p.a.kernel, saved), Status::kOk);
  const std::uint64_t before = hash(p.b.kernel);
  EXPECT_EQ(restore(p.b.kernel, std::span(saved).first(saved.size() - 1)),
            Status::kSnapshotDoesNotMatch);
  EXPECT_EQ(restore(p.b.kernel, {}), Status::kSnapshotDoesNotMatch);
  for (std::size_t at = 0; at < 40; ++at) {  // the header, without the checksum
    std::vector<std::byte> damaged = saved;
    damaged[at] ^= std::byte{1};
    EXPECT_EQ(restore(p.b.kernel, damaged), Status::kSnapshotDoesNotMatch) << at;
  }
  std::vector<std::byte> damaged = saved;
  damaged[40] ^= std::byte{1};
  EXPECT_EQ(restore(p.b.kernel, damaged), Status::kSnapshotDamaged);
  Config other;
  other.needle[0].unit_m = 4e-3F;
  Session otherwise = make_session(p.organ->organ, other);
  EXPECT_EQ(restore(otherwise.kernel, saved), Status::kSnapshotDoesNotMatch);
  const auto bigger = block_organ(7, 5, 8);
  Session elsewhere = make_session(bigger->organ, Config{});
  EXPECT_EQ(restore(elsewhere.kernel, saved), Status::kSnapshotDoesNotMatch);
  EXPECT_EQ(hash(p.b.kernel), before);
}

// For a program that has another program's snapshot: the snapshot contains the number of its
// layout, and with another number it comes from another program.
TEST(Snapshot, OfAnotherLayoutIsRecognisedByItsNumber) {
  const Pair p;
  Kernel kernel = p.a.kernel;
  std::vector<std::byte> bytes(snapshot_bytes(kernel));
  ASSERT_EQ(snapshot(kernel, bytes), Status::kOk);
  const std::uint64_t mine = state_layout();
  constexpr std::size_t kAt = sizeof(std::uint64_t);  // after the file's mark
  EXPECT_EQ(std::memcmp(bytes.data() + kAt, &mine, sizeof mine), 0);
  ASSERT_EQ(restore(kernel, bytes), Status::kOk);
  const std::uint64_t other = mine + 1;
  std::memcpy(bytes.data() + kAt, &other, sizeof other);
  EXPECT_EQ(restore(kernel, bytes), Status::kSnapshotDoesNotMatch);
}

TEST(Reset, IsTheFirstState) {
  Pair p;
  run(p.a.kernel, p.script, 0, 2000);
  EXPECT_NE(hash(p.a.kernel), hash(p.b.kernel));
  reset(p.a.kernel);
  expect_equal(p.a.kernel, p.b.kernel);
}

// Changes one byte in the first, a middle and the last element of every field that the state of
// this organ has: the difference names field and element, and the hash changes.
void try_every_field(const Organ& organ, std::set<std::string>& tried_io) {
  Config config;
  config.inertia = Inertia::kTrueMass;  // this and a syringe have fields of their own
  config.needle[0].hub = Hub::kSyringe;
  Session a = make_session(organ, config), b = make_session(organ, config);
  const Script script = block_script(organ, config);
  run(a.kernel, script, 0, 1300);
  run(b.kernel, script, 0, 1300);
  expect_equal(a.kernel, b.kernel);
  const Counts& c = counts_of(b.kernel);
  State view = state_of(b.kernel.state, c);
  const std::uint64_t same = hash(b.kernel);
  const auto try_field = [&](const char* name, auto* values, std::size_t count) {
    if (count == 0) return;
    tried_io.insert(name);
    for (const std::size_t at : {std::size_t{0}, count / 2, count - 1}) {
      for (const std::size_t byte : {std::size_t{0}, sizeof(*values) - 1}) {
        auto* bytes = reinterpret_cast<unsigned char*>(&values[at]);
        bytes[byte] ^= 0x10U;
        const Difference d = difference(a.kernel, b.kernel);
        ASSERT_NE(d.field, nullptr) << name;
        EXPECT_STREQ(d.field, name);
        EXPECT_EQ(d.index, at) << name;
        EXPECT_NE(hash(b.kernel), same) << name;
        bytes[byte] ^= 0x10U;
      }
    }
  };
#define STYLET_TRY_FIELD(name, type, count) \
  try_field(#name, &view.name[0], static_cast<std::size_t>(count));
  STYLET_STATE_FIELDS(STYLET_TRY_FIELD)
#undef STYLET_TRY_FIELD
  expect_equal(a.kernel, b.kernel);
}

TEST(Difference, NamesEveryFieldAndElement) {
  std::set<std::string> tried;
  try_every_field(block_organ(6, 5, 8, {0, true})->organ, tried);
  try_every_field(sliding_organ()->organ, tried);
#define STYLET_WAS_TRIED(name, type, count) EXPECT_TRUE(tried.contains(#name)) << #name;
  STYLET_STATE_FIELDS(STYLET_WAS_TRIED)
#undef STYLET_WAS_TRIED
}

// Each invariant is broken in a state in the middle of an insertion; builds without assertions skip
// this.
TEST(InvariantsDeathTest, WhatMustHoldBetweenStepsIsAsserted) {
#ifdef STYLET_INVARIANTS
  Pair p;
  run(p.a.kernel, p.script, 0, 1200);
  const View good = view_of(p.a.kernel);
  ASSERT_GT(good.state.needle->shaft_count, 0U);
  assert_needle(good.model, good.state);
  const std::function<void(State&)> broken[] = {
      [](State& s) { s.needle->tip_alive = 0; },
      [](State& s) { s.needle->phase = Phase::kContact; },
      [](State& s) { s.needle->shaft_count = kMaxConstraintParticles + 1; },
      [](State& s) { s.needle->track_current = s.head->track_count; },
      [](State& s) { s.shaft->support[0].weight += 0.01F; },
      [](State& s) { ++s.shaft->support[0].row; },
      [](State& s) { s.tip->stiffness_n_per_m = -1; },
  };
  for (const auto& change : broken) {
    EXPECT_DEATH(
        {
          View view = view_of(p.a.kernel);
          change(view.state);
          assert_needle(view.model, view.state);
        },
        "assert_needle|assert_particle");
  }
#else
  GTEST_SKIP() << "the assertions are in debug, sanitizer and fuzzing builds";
#endif
}

TEST(Events, OldestIsOverwrittenAndOrderIsKept) {
  Pair p;
  View view = view_of(p.a.kernel);
  constexpr std::uint32_t kAll = kMaxEvents + 37;
  for (std::uint32_t i = 0; i < kAll; ++i) {
    view.state.head->tick = 1000 + i;
    add_event(view.state, EventKind::kLayer, static_cast<float>(i));
    Event list[kMaxEvents + 1];
    const std::uint32_t count = events(p.a.kernel, list);
    ASSERT_EQ(count, std::min(i + 1, kMaxEvents));
    for (std::uint32_t j = 0; j < count; ++j) {
      const std::uint32_t sequence = i + 1 - count + j;
      ASSERT_EQ(list[j].tick, 1000 + sequence);
      ASSERT_EQ(list[j].force_n, static_cast<float>(sequence));
    }
  }
  Event few[5];
  ASSERT_EQ(events(p.a.kernel, few), 5U);
  EXPECT_EQ(few[0].tick, 1000U + kAll - 5);
  EXPECT_EQ(few[4].tick, 1000U + kAll - 1);
  EXPECT_EQ(events(p.a.kernel, {}), 0U);
}

TEST(Events, EveryKindHasAName) {
  std::set<std::string> names;
  for (std::uint32_t kind = 0; kind <= static_cast<std::uint32_t>(EventKind::kLossOfResistance);
       ++kind) {
    EXPECT_TRUE(names.insert(event_name(static_cast<EventKind>(kind))).second) << kind;
  }
  EXPECT_EQ(names.count("unknown"), 0U);
  for (const std::uint32_t kind :
       {static_cast<std::uint32_t>(EventKind::kLossOfResistance) + 1, 99U}) {
    EXPECT_STREQ(event_name(static_cast<EventKind>(kind)), "unknown");
  }
}

// The numbers are those of status.h, which programs store; no other number has a name.
TEST(Status, EveryOneHasAName) {
  const std::set<std::uint32_t> all = {0,   100, 101, 102, 103, 104, 105, 106,
                                       107, 108, 200, 201, 300, 301, 302, 303};
  std::set<std::string> names;
  for (std::uint32_t status = 0; status < 1000; ++status) {
    const std::string name = status_name(static_cast<Status>(status));
    EXPECT_EQ(name != "unknown status", all.count(status) == 1) << status;
    if (all.count(status) == 1) {
      EXPECT_TRUE(names.insert(name).second) << status;
    }
  }
}

}  // namespace
}  // namespace stylet::test
