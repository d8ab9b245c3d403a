// SPDX-License-Identifier: Apache-2.0
// The tissue step shared with helper threads: same bits for any number of them, on time, late or
// absent; memory predicted to the byte.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "helper_threads.h"
#include "lattice_team.h"
#include "session.h"
#include "variants.h"

namespace stylet::test {
namespace {

#if defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kTicks = 700;  // contact, puncture, the first particles
#else
constexpr std::uint64_t kTicks = 1800;  // and 27 mm of insertion, part of the pause
#endif

std::uint64_t hash_after(Session& session, const Script& script) {
  run(session.kernel, script, 0, kTicks);
  return hash(session.kernel);
}

struct Case {
  Variant variant;
  Setup setup;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Variant& variant : variants_here()) {
    for (const Setup setup : kSetups) all.push_back({variant, setup});
  }
  return all;
}

class TeamBits : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<OpenOrgan> opened_ = block_organ(10, 10, 10);
  Script script_ = block_script(opened_->organ, config_of(GetParam().setup));

  Session session() const {
    Session made = make_session(opened_->organ, GetParam().setup);
    made.kernel.step = GetParam().variant.step;
    return made;
  }
};

TEST_P(TeamBits, AreThoseOfOneThreadForAnyNumberOfHelpers) {
  Session alone = session();
  const std::uint64_t expected = hash_after(alone, script_);
  for (const std::uint32_t helpers : {1U, 2U}) {
    Session shared = session();
    const Block memory = make_block(team_bytes(shared.kernel, helpers), std::byte{0xFF});
    ASSERT_EQ(set_team(shared.kernel, helpers, memory.span()), Status::kOk);
    const Helpers threads(shared.kernel, helpers);
    EXPECT_EQ(hash_after(shared, script_), expected) << helpers << " helpers";
    EXPECT_GT(threads.helped(), 0U) << "no helper ever came, so this proves nothing";
  }
}

TEST_P(TeamBits, AreTheSameWhenNoHelperComes) {
  Session alone = session();
  const std::uint64_t expected = hash_after(alone, script_);
  for (const std::uint32_t helpers : {1U, 2U, 9U, kMaxHelpers}) {  // more than there are planes
    Session shared = session();
    const Block memory = make_block(team_bytes(shared.kernel, helpers), std::byte{0xFF});
    ASSERT_EQ(set_team(shared.kernel, helpers, memory.span()), Status::kOk);
    EXPECT_EQ(hash_after(shared, script_), expected) << helpers << " helpers";
  }
}

INSTANTIATE_TEST_SUITE_P(Rt, TeamBits, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& made) {
                           return std::string(made.param.variant.name) + "_" +
                                  setup_name(made.param.setup);
                         });

TEST(Team, MayComeAndGoBetweenTicks) {
  const auto opened = block_organ(10, 10, 10);
  const Script script = block_script(opened->organ, config_of(Setup::kPhysical));
  Session alone = make_session(opened->organ, Setup::kPhysical);
  Session shared = make_session(opened->organ, Setup::kPhysical);
  const Block memory = make_block(team_bytes(shared.kernel, 2));
  for (std::uint64_t tick = 0; tick < 1200; tick += 200) {
    const std::uint32_t helpers = static_cast<std::uint32_t>(tick / 200 % 3);
    ASSERT_EQ(set_team(shared.kernel, helpers, memory.span()), Status::kOk);
    run(shared.kernel, script, tick, 200);
    run(alone.kernel, script, tick, 200);
    ASSERT_EQ(difference(alone.kernel, shared.kernel).field, nullptr) << tick;
  }
}

TEST(Team, UsesTheBytesItSaysAndNoOthers) {
  const auto opened = block_organ(7, 6, 5);
  const Script script = block_script(opened->organ, config_of(Setup::kPhysical));
  constexpr std::size_t kGuard = 256;
  for (const std::uint32_t helpers : {1U, 3U, kMaxHelpers}) {
    Session session = make_session(opened->organ, Setup::kPhysical);
    const std::size_t bytes = team_bytes(session.kernel, helpers);
    Block memory = make_block(bytes + 2 * kGuard, std::byte{0xA5});
    ASSERT_EQ(set_team(session.kernel, helpers, memory.span().subspan(kGuard, bytes)), Status::kOk);
    run(session.kernel, script, 0, 1000);
    for (std::size_t i = 0; i < kGuard; ++i) {
      ASSERT_EQ(memory.span()[i], std::byte{0xA5}) << "before, at " << i;
      ASSERT_EQ(memory.span()[kGuard + bytes + i], std::byte{0xA5}) << "behind, at " << i;
    }
  }
}

TEST(Team, IsRefusedWithoutATrace) {
  const auto opened = block_organ(4, 4, 4);
  Session session = make_session(opened->organ, Setup::kPhysical);
  const std::size_t bytes = team_bytes(session.kernel, 2);
  Block memory = make_block(bytes + kBlockAlignment, std::byte{0xA5});
  EXPECT_EQ(set_team(session.kernel, 2, memory.span().first(bytes - 1)), Status::kMemoryTooSmall);
  EXPECT_EQ(set_team(session.kernel, 2, memory.span().subspan(4, bytes)),
            Status::kMemoryNotAligned);
  EXPECT_EQ(set_team(session.kernel, kMaxHelpers + 1, memory.span()),
            Status::kConfigValueOutOfRange);
  EXPECT_EQ(session.kernel.team, nullptr);
  for (const std::byte byte : memory.span()) ASSERT_EQ(byte, std::byte{0xA5});
}

// So that a late helper holds up a tick by a plane, and not by its share.
TEST(Team, PlanesOfAHelperWhoDoesNotComeAreSweptOnTheWay) {
  const auto opened = block_organ(10, 10, 10);
  for (const std::uint32_t helpers : {1U, 3U}) {
    Session session = make_session(opened->organ, Setup::kPhysical);
    const Block memory = make_block(team_bytes(session.kernel, helpers));
    ASSERT_EQ(set_team(session.kernel, helpers, memory.span()), Status::kOk);
    tick(session.kernel, Input{});
    const Team& team = team_of(session.kernel);
    ASSERT_EQ(team.slab_count, helpers + 1);
    for (std::uint32_t s = 0; s < team.slab_count; s += 2) {
      EXPECT_EQ(team.slab[s].begin, team.slab[s].first);
      EXPECT_EQ(team.slab[s + 1].begin, team.slab[s + 1].first) << "one plane alone";
      EXPECT_GT(team.slab[s + 1].first, team.slab[s].first + 1);
    }
  }
}

TEST(Team, HelperFindsNothingToDoBetweenTicks) {
  const auto opened = block_organ(4, 4, 4);
  Session session = make_session(opened->organ, Setup::kPhysical);
  const Block memory = make_block(team_bytes(session.kernel, 1));
  ASSERT_EQ(set_team(session.kernel, 1, memory.span()), Status::kOk);
  EXPECT_FALSE(help(session.kernel, 100));
  tick(session.kernel, Input{});
  EXPECT_FALSE(help(session.kernel, 100));
}

}  // namespace
}  // namespace stylet::test
