// SPDX-License-Identifier: Apache-2.0
// The tissue step shared with helper threads: the same bits with any number of them, whether on
// time, late or absent; memory predicted to the byte.
#include "lattice/team.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "helper_threads.h"
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
std::string name_of(const Case& of) {
  return std::string(of.variant.name) + "_" + setup_name(of.setup);
}
void PrintTo(const Case& of, std::ostream* out) {
  *out << name_of(of);
}

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
    bool helped = false;
    // On a busy machine the helpers may come too late: then it is tried again.
    for (int attempt = 0; attempt < 20 && !helped; ++attempt) {
      Session shared = session();
      const Block memory = make_block(team_bytes(shared.kernel, helpers), std::byte{0xFF});
      ASSERT_EQ(set_team(shared.kernel, helpers, memory.span()), Status::kOk);
      const Helpers threads(shared.kernel, helpers);
      EXPECT_EQ(hash_after(shared, script_), expected) << helpers << " helpers";
      helped = threads.helped() > 0;
    }
    EXPECT_TRUE(helped) << "no helper ever came, so this proves nothing";
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
                         [](const auto& made) { return name_of(made.param); });

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

TEST(Team, UsesThePredictedBytesAndNoOthers) {
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

TEST(Team, RefusalsChangeNothing) {
  const auto opened = block_organ(4, 4, 4);
  Session session = make_session(opened->organ, Setup::kPhysical);
  const std::size_t bytes = team_bytes(session.kernel, 2);
  Block memory = make_block(bytes + kBlockAlignment, std::byte{0xA5});
  EXPECT_EQ(set_team(session.kernel, 2, memory.span().first(bytes - 1)), Status::kMemoryTooSmall);
  EXPECT_EQ(set_team(session.kernel, 2, memory.span().subspan(4, bytes)),
            Status::kMemoryNotAligned);
  EXPECT_EQ(set_team(session.kernel, kMaxHelpers + 1, memory.span()),
            Status::kConfigValueOutOfRange);
  EXPECT_FALSE(has_team(session.kernel));
  for (const std::byte byte : memory.span()) ASSERT_EQ(byte, std::byte{0xA5});
}

TEST(Team, SlabsOfAbsentHelpersAreSweptByTheCaller) {
  const auto opened = block_organ(10, 10, 10);
  for (const std::uint32_t helpers : {1U, 3U}) {
    Session session = make_session(opened->organ, Setup::kPhysical);
    const Block memory = make_block(team_bytes(session.kernel, helpers));
    ASSERT_EQ(set_team(session.kernel, helpers, memory.span()), Status::kOk);
    tick(session.kernel, Input{});
    const Team& team = *team_of(session.kernel);
    ASSERT_EQ(team.slab_count, helpers + 1);
    std::uint32_t plane = 0;
    for (std::uint32_t s = 0; s < team.slab_count; ++s) {
      EXPECT_EQ(team.part[s].begin, plane);
      EXPECT_EQ(team.part[team.slab_count + s].planes, 0U) << "nobody was late with it";
      plane += team.part[s].planes;
    }
    EXPECT_EQ(plane, 10U);
  }
}

TEST(Team, HelpsOnlyWithSlabsThatAreBegunAndFarFromDone) {
  Slab slab = {};
  slab.begin = 5;
  slab.end = 15;
  Part own = {}, helping = {};
  own.slab = helping.slab = &slab;
  helping.helping = true;
  EXPECT_FALSE(take_plane(helping)) << "its voxels are not fitted yet";
  slab.begun.store(1);
  std::uint32_t helped = 0, left = 0;
  while (take_plane(helping)) ++helped;
  while (take_plane(own)) ++left;
  EXPECT_EQ(left, kLeftAlone);
  EXPECT_EQ(1 + helped + left, slab.end - slab.begin);
}

// Takes all parts but the caller's slab at once, and sweeps only a few planes of its own slab, as a
// thread that is held up; then it helps with the others, as another thread would. So the same parts
// are done by the same threads in the same order each time.
class HeldUp {
 public:
  explicit HeldUp(const Kernel& kernel)
      : team_(*team_of(kernel)), thread_([this, &kernel] {
          while (!stop_.load()) sweep(kernel);
        }) {}
  ~HeldUp() {
    stop_.store(true);
    thread_.join();
  }
  HeldUp(const HeldUp&) = delete;
  HeldUp& operator=(const HeldUp&) = delete;
  std::uint64_t steps() const { return steps_.load(); }

 private:
  void sweep(const Kernel& kernel) {
    std::uint32_t work = team_.work.load();
    if (work % 256 != 1) return;  // the caller has taken its slab, and nobody the others
    if (!team_.work.compare_exchange_strong(work, work + 3)) return;
    Slab& slab = team_.slab[1];
    const std::uint32_t after_first = slab.end - slab.begin - 1;
    slab.taken.store(kHelped);
    team_.sweep(kernel, team_.part[1]);
    slab.taken.store(after_first - kHelped - kLeftAlone);
    team_.sweep(kernel, team_.part[2]);
    team_.sweep(kernel, team_.part[3]);
    if (team_.part[3].planes == kHelped) steps_.fetch_add(1);
    team_.done.fetch_add(3);
  }

  static constexpr std::uint32_t kHelped = 4;
  Team& team_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> steps_ = 0;
  std::thread thread_;
};

TEST(Team, BitsAreTheSameWhenSlabsAreSweptInTwoParts) {
  const auto opened = block_organ(8, 8, 30);
  const Script script = block_script(opened->organ, config_of(Setup::kPhysical));
  for (const Variant& variant : variants_here()) {
    Session alone = make_session(opened->organ, Setup::kPhysical);
    Session shared = make_session(opened->organ, Setup::kPhysical);
    alone.kernel.step = shared.kernel.step = variant.step;
    const Block memory = make_block(team_bytes(shared.kernel, 1));
    ASSERT_EQ(set_team(shared.kernel, 1, memory.span()), Status::kOk);
    const HeldUp helper(shared.kernel);
    // Repeats until the helper has come often enough: other programs may hold it up, too.
    std::uint64_t ticks = 0;
    for (; ticks < kTicks || (helper.steps() < 50 && ticks < 100'000); ticks += 100) {
      run(shared.kernel, script, ticks, 100);
    }
    run(alone.kernel, script, 0, ticks);
    ASSERT_EQ(difference(alone.kernel, shared.kernel).field, nullptr) << variant.name;
    EXPECT_GE(helper.steps(), 50U) << "slabs were not swept in two parts, so this proves nothing";
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
