// SPDX-License-Identifier: Apache-2.0
// Any bytes as a snapshot are refused, or are a harmless state of this organ and configuration. And
// what may differ between two kernels that exchange snapshots.
#include "state/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lattice/voxel.h"
#include "session.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

// Written over a word: for a float or the upper half of a double a value that is not finite, for a
// count more than any array holds.
constexpr std::uint32_t kNoNumber = 0x7FF80001U;

std::vector<std::byte> saved_of(const Kernel& kernel) {
  std::vector<std::byte> bytes(snapshot_bytes(kernel));
  EXPECT_EQ(snapshot(kernel, bytes), Status::kOk);
  return bytes;
}

// As an attacker would do it.
void sign(const Kernel& kernel, std::vector<std::byte>& bytes) {
  const SnapshotHeader header = snapshot_header(kernel, bytes.data() + sizeof(SnapshotHeader));
  std::memcpy(bytes.data(), &header, sizeof header);
}

// Two needles, one on bone, each with a syringe, in tissue of true mass with a membrane: all
// that has fields of its own; and a snapshot.
struct Taken {
  std::unique_ptr<OpenOrgan> organ;
  Config config = config_of(Setup::kElastic);
  Session session, other;
  std::vector<std::byte> bytes;

  explicit Taken(std::unique_ptr<OpenOrgan> of = block_organ(6, 5, 8, {0, true}))
      : organ(std::move(of)), session(make()), other(make()) {
    const Script script = block_script(organ->organ, config);
    for (std::uint64_t i = 0; i < 1300; ++i) {
      Input inputs[2] = {scripted_input(script, i), scripted_input(script, i)};
      inputs[1].handle.position_m.x += 6e-3F;
      Output outputs[2];
      tick(session.kernel, inputs, outputs);
    }
    bytes = saved_of(session.kernel);
  }
  Session make() {
    config.needle_count = 2;
    config.needle[1].torsion_nm2 = 1e-3F;
    config.needle[1].hub = Hub::kSyringe;
    Session made = make_session(organ->organ, config);
    EXPECT_EQ(set_obstacles(made.kernel, obstacles_of(organ->organ, Setup::kElastic)), Status::kOk);
    return made;
  }
};

// Words that may have any value: counters, and the lower halves of doubles.
bool free_word(const std::string& field, std::size_t offset) {
  if (field == "fluid") return offset % 8 == 0 && offset < offsetof(FluidState, plunger_n);
  if (field == "slide_books") return offset % 8 == 0;
  if (field == "event") return offset < offsetof(Event, kind);
  if (field == "rod_shape") return offset % 8 == 0;
  if (field == "touch") {
    constexpr std::size_t kAt = offsetof(Touch, contact) + offsetof(ObstacleContact, at_m);
    return offset >= kAt && offset < kAt + sizeof(Vec3d) && offset % 8 == 0;
  }
  if (field != "head") return false;
  const auto within = [offset](std::size_t first, std::size_t end) {
    return offset >= first && offset < end;
  };
  const bool double_low = offset >= offsetof(StateHead, work_by_hand_j) && offset % 8 == 0;
  return double_low || within(offsetof(StateHead, tick), offsetof(StateHead, latched_fault)) ||
         within(offsetof(StateHead, event_count), offsetof(StateHead, coupled_max)) ||
         within(offsetof(StateHead, input_not_finite), offsetof(StateHead, work_by_hand_j));
}

void change_every_word(Taken t, std::size_t& words_io, std::set<std::string>& tried_io) {
  const std::vector<std::byte>& good = t.bytes;
  ASSERT_EQ(restore(t.other.kernel, good), Status::kOk);
  const Counts& c = counts_of(t.session.kernel);
  State view = state_of(t.session.kernel.state, c);
  const auto try_field = [&](const std::string& name, const auto* field, std::size_t count) {
    if (count == 0) return;
    tried_io.insert(name);
    const std::size_t first = sizeof(SnapshotHeader) +
                              static_cast<std::size_t>(reinterpret_cast<const std::byte*>(field) -
                                                       t.session.kernel.state);
    for (const std::size_t at : {std::size_t{0}, count / 2, count - 1}) {
      for (std::size_t offset = 0; offset < sizeof(*field); offset += 4, ++words_io) {
        if (free_word(name, offset)) continue;
        std::vector<std::byte> bytes = good;
        std::memcpy(bytes.data() + first + at * sizeof(*field) + offset, &kNoNumber, 4);
        sign(t.session.kernel, bytes);
        ASSERT_EQ(restore(t.other.kernel, bytes), Status::kSnapshotDamaged)
            << name << at << " + " << offset;
      }
    }
  };
#define STYLET_TRY_FIELD(name, type, count) \
  try_field(#name, &view.name[0], static_cast<std::size_t>(count));
  STYLET_STATE_FIELDS(STYLET_TRY_FIELD)
#undef STYLET_TRY_FIELD
}

TEST(Snapshot, EveryWordOfEveryFieldIsChecked) {
  std::size_t words = 0;
  std::set<std::string> tried;
  change_every_word(Taken(), words, tried);
  change_every_word(Taken(sliding_organ()), words, tried);
  EXPECT_GT(words, 2000U);
#define STYLET_WAS_TRIED(name, type, count) EXPECT_TRUE(tried.contains(#name)) << #name;
  STYLET_STATE_FIELDS(STYLET_WAS_TRIED)
#undef STYLET_WAS_TRIED
}

// Changes each index and count to the first number that is too large.
struct Wrong {
  const char* what;
  std::function<void(State&)> change;
};

TEST(Snapshot, IndicesAndCountsAreCheckedAgainstTheModel) {
  Taken t;
  View view = view_of(t.session.kernel);
  const Counts& c = counts_of(t.session.kernel);
  const std::uint32_t materials = view.model.head->material_count;
  ASSERT_GT(view.state.needle->shaft_count, 1U);
  ASSERT_GT(view.state.shaft[0].support_count, 1U);
  const std::vector<Wrong> all = {
      {"shaft_count", [](State& s) { s.needle->shaft_count = kMaxConstraintParticles + 1; }},
      {"far shaft_count", [](State& s) { s.needle->shaft_count = 100000; }},
      {"shaft_max", [](State& s) { s.needle->shaft_max = s.needle->shaft_count - 1; }},
      {"no shaft", [](State& s) { s.needle->shaft_count = 0; }},
      {"phase", [](State& s) { s.needle->phase = static_cast<Phase>(4); }},
      {"other phase", [](State& s) { s.needle->phase = Phase::kFree; }},
      {"no tip", [](State& s) { s.needle->tip_alive = 0; }},
      {"tip_alive", [](State& s) { s.needle->tip_alive = 2; }},
      {"layer", [=](State& s) { s.needle->layer = materials; }},
      {"spring_layer", [=](State& s) { s.needle->spring_layer = materials; }},
      {"track_current", [](State& s) { s.needle->track_current = kMaxTracks; }},
      {"track not there", [](State& s) { s.needle->track_current = s.head->track_count; }},
      {"touch_max", [](State& s) { s.needle->touch_count = s.needle->touch_max + 1; }},
      {"touch_count", [](State& s) { s.needle->touch_count = kMaxTouches + 1; }},
      {"handle", [](State& s) { s.needle->handle.rotation.w = 2; }},
      {"slot", [&](State& s) { s.shaft->support[0].slot = c.slots; }},
      {"slot of another row", [](State& s) { ++s.shaft->support[0].row; }},
      {"slot before its row",
       [&](State& s) {
         s.shaft->support[0].slot = view.model.row[s.shaft->support[0].row].slot - 1;
       }},
      {"row", [&](State& s) { s.shaft->support[0].row = c.rows; }},
      {"weight", [](State& s) { s.shaft->support[0].weight += 0.1F; }},
      {"no turn", [](State& s) { s.shaft->support[0].turn = {}; }},
      {"support_count", [](State& s) { s.shaft->support_count = kSupportsPerParticle + 1; }},
      {"fewer shares", [](State& s) { --s.shaft->support_count; }},
      {"no spring", [](State& s) { s.shaft->stiffness_n_per_m = 0; }},
      {"no full spring", [](State& s) { s.shaft->full_stiffness_n_per_m = 0; }},
      {"more than all", [](State& s) { s.shaft->relaxing_fraction = 1.1F; }},
      {"more than whole", [](State& s) { s.rod_shape->step_length = 1.1; }},
      {"material", [=](State& s) { s.tip->material = materials; }},
      {"rod", [](State& s) { s.rod_shape->direction[3].y += 0.5; }},
      {"touch.rod", [&](State& s) { s.touch->rod = view.model.rod->rods; }},
      {"touch.obstacle", [](State& s) { s.touch->obstacle = kMaxObstacles; }},
      {"track_next", [](State& s) { s.head->track_next = kMaxTracks; }},
      {"track_count", [](State& s) { s.head->track_count = kMaxTracks + 1; }},
      {"latched_fault", [](State& s) { s.head->latched_fault = 2; }},
      {"event.kind", [](State& s) { s.event->kind = static_cast<EventKind>(9); }},
      {"event.needle", [](State& s) { s.event->needle = 2; }},
      {"huge", [](State& s) { s.vy[40] = 1e13F; }},
      {"huge sum", [](State& s) { s.head->friction_j = 1e300; }},
      {"below nothing", [](State& s) { s.head->max_displacement_m = -1; }},
      {"infinite", [](State& s) { s.uz[40] = std::numeric_limits<float>::infinity(); }},
  };
  const std::uint64_t before = hash(t.other.kernel);
  for (const Wrong& wrong : all) {
    ASSERT_EQ(restore(t.session.kernel, t.bytes), Status::kOk);
    wrong.change(view.state);
    EXPECT_EQ(restore(t.other.kernel, saved_of(t.session.kernel)), Status::kSnapshotDamaged)
        << wrong.what;
    EXPECT_EQ(hash(t.other.kernel), before) << wrong.what;
  }
}

// A row also stores short holes; no particle may be in a hole.
TEST(Snapshot, NoParticleMayBeInAHole) {
  TinyOrgan tiny;
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.inside = [](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return x != 6 || y != 4 || z != 4;
  };
  const auto organ = open_organ(tiny_organ(tiny));
  Session session = make_session(organ->organ, Config{});
  run(session.kernel, block_script(organ->organ, Config{}), 0, 1300);
  View view = view_of(session.kernel);
  ASSERT_GT(view.state.needle->shaft_count, 0U);
  const std::uint32_t row = row_at(view.model, 6, 4, 4);
  ASSERT_NE(row, kNoRow);
  std::uint32_t refused = 0;
  for (std::uint32_t slot = 0; slot < view.model.row[row].count; ++slot) {
    Support& share = view.state.shaft->support[0];
    share.slot = view.model.row[row].slot + slot;
    share.row = row;
    const Status status = restore(session.kernel, saved_of(session.kernel));
    refused += status == Status::kSnapshotDamaged ? 1 : 0;
    EXPECT_EQ(status != Status::kOk, slot == 6) << slot;
  }
  EXPECT_EQ(refused, 1U);
}

// A snapshot from each phase goes on with the same bits; if its needle is in contact with nothing,
// it is damaged.
TEST(Snapshot, IsTakenInEveryPhase) {
  const auto organ = block_organ(6, 5, 8);
  const Script script = block_script(organ->organ, Config{});
  Session session = make_session(organ->organ, Config{});
  Session other = make_session(organ->organ, Config{});
  const NeedleState& own = *view_of(session.kernel).state.needle;
  std::array<bool, 4> seen = {};
  for (std::uint64_t i = 0; i < kCycleTicks; ++i) {
    const Input input = scripted_input(script, i);
    (void)tick(session.kernel, input);
    if (i == 0 || std::exchange(seen.at(static_cast<std::size_t>(own.phase)), true)) continue;
    ASSERT_EQ(restore(other.kernel, saved_of(session.kernel)), Status::kOk) << i;
    (void)tick(session.kernel, scripted_input(script, ++i));
    (void)tick(other.kernel, scripted_input(script, i));
    ASSERT_EQ(hash(other.kernel), hash(session.kernel)) << i;
    if (own.phase != Phase::kContact) continue;
    view_of(other.kernel).state.tip->support_count = 0;
    EXPECT_EQ(restore(other.kernel, saved_of(other.kernel)), Status::kSnapshotDamaged);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 4);
}

TEST(Snapshot, OneFlippedBitAnywhereIsNoticed) {
  Taken t;
  const std::uint64_t before = hash(t.other.kernel);
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    std::vector<std::byte> bytes = t.bytes;
    bytes[random() % bytes.size()] ^= std::byte(1U << random() % 8U);
    EXPECT_NE(restore(t.other.kernel, bytes), Status::kOk);
  }
  EXPECT_EQ(hash(t.other.kernel), before);
}

TEST(Snapshot, ComesFromBytesAtAnyAddress) {
  Taken t;
  std::vector<std::byte> moved(t.bytes.size() + 1);
  std::copy(t.bytes.begin(), t.bytes.end(), moved.begin() + 1);
  ASSERT_EQ(restore(t.other.kernel, std::span(moved).subspan(1)), Status::kOk);
  EXPECT_EQ(hash(t.other.kernel), hash(t.session.kernel));
}

// A kernel that has latched a fault may hold any numbers: force stays zero until reset.
TEST(Snapshot, OfAFaultIsAFault) {
  Taken t;
  View view = view_of(t.session.kernel);
  for (std::uint32_t i = 0; i < counts_of(t.session.kernel).particles; ++i) {
    view.state.ux[i] = std::numeric_limits<float>::quiet_NaN();
  }
  (void)tick(t.session.kernel, Input{});
  const std::vector<std::byte> bytes = saved_of(t.session.kernel);
  ASSERT_EQ(restore(t.other.kernel, bytes), Status::kOk);
  for (int i = 0; i < 3; ++i) {
    const Output out = tick(t.other.kernel, Input{});
    EXPECT_EQ(out.flags, kFlagFault);
    EXPECT_EQ(out.events, view.state.head->event_count) << "the log is still there to be read";
    EXPECT_GT(out.events, 0U);
  }
}

// Such bytes are needles beyond needle_count, vertices beyond vertex_count, and the sign of a zero.
TEST(Snapshot, FitsAKernelThatDiffersInBytesThatDoNotMatter) {
  Taken t;
  Config config = t.config;
  config.needle[2].length_m = 0.3F;
  config.needle[3].unit_m = std::numeric_limits<float>::quiet_NaN();
  config.needle[0].torsion_nm2 = -0.0F;
  config.breathing.amplitude_m.x = -0.0F;
  std::vector<ObstacleConfig> obstacles = obstacles_of(t.organ->organ, Setup::kElastic);
  obstacles[0].vertices_m[0].y = -0.0F;
  obstacles[0].vertices_m[5] = {1, 2, 3};
  Session alike = make_session(t.organ->organ, config);
  ASSERT_EQ(set_obstacles(alike.kernel, obstacles), Status::kOk);
  ASSERT_EQ(restore(alike.kernel, t.bytes), Status::kOk);
  EXPECT_EQ(difference(alike.kernel, t.session.kernel).field, nullptr);
  const Script script = block_script(t.organ->organ, config);
  run(alike.kernel, script, 1300, 300);
  run(t.session.kernel, script, 1300, 300);
  EXPECT_EQ(hash(alike.kernel), hash(t.session.kernel));
  obstacles[0].friction = 0.3F;
  Session unlike = make_session(t.organ->organ, config);
  ASSERT_EQ(set_obstacles(unlike.kernel, obstacles), Status::kOk);
  EXPECT_EQ(restore(unlike.kernel, t.bytes), Status::kSnapshotDoesNotMatch);
}

TEST(Difference, OfOtherOrgansAndConfigurationsIsNamed) {
  const auto small = block_organ(2, 2, 2), large = block_organ(12, 12, 12);
  Config other;
  other.needle[0].unit_m = 4e-3F;
  Session a = make_session(large->organ, Config{}), b = make_session(small->organ, Config{});
  Session c = make_session(large->organ, other);
  EXPECT_STREQ(difference(a.kernel, b.kernel).field, "organ");
  EXPECT_STREQ(difference(b.kernel, a.kernel).field, "organ");
  EXPECT_STREQ(difference(a.kernel, c.kernel).field, "config");
}

TEST(Obstacles, AreTakenBeforeTheFirstTickOnly) {
  const auto organ = block_organ(3, 3, 3);
  Session session = make_session(organ->organ, Setup::kElastic);
  const std::vector<ObstacleConfig> ball = obstacles_of(organ->organ, Setup::kElastic);
  (void)tick(session.kernel, Input{});
  EXPECT_EQ(set_obstacles(session.kernel, {}), Status::kObstaclesTooLate);
  EXPECT_EQ(view_of(session.kernel).model.head->obstacle_count, 1U);
  reset(session.kernel);
  EXPECT_EQ(set_obstacles(session.kernel, {}), Status::kOk);
}

// The second of two bodies is refused, and the one from before stays.
TEST(Obstacles, AreRefusedByNameNumberAndLimits) {
  const auto organ = block_organ(3, 3, 3);
  Session session = make_session(organ->organ, Setup::kElastic);
  std::vector<ObstacleConfig> two(2, obstacles_of(organ->organ, Setup::kElastic)[0]);
  two[1].friction = -0.5F;
  ConfigRefusal why = {"what was there", 7, 1, 2, 3};
  EXPECT_EQ(set_obstacles(session.kernel, two, &why), Status::kConfigValueOutOfRange);
  EXPECT_STREQ(why.field, "obstacle.friction");
  EXPECT_EQ(std::tuple(why.index, why.value, why.least), std::tuple(1U, -0.5, 0.0));
  EXPECT_EQ(view_of(session.kernel).model.head->obstacle_count, 1U);
  EXPECT_EQ(set_obstacles(session.kernel, std::vector(kMaxObstacles + 1, two[0]), &why),
            Status::kConfigValueOutOfRange);
  EXPECT_STREQ(why.field, "obstacles");
  EXPECT_EQ(std::tuple(why.value, why.most), std::tuple(kMaxObstacles + 1.0, 1.0 * kMaxObstacles));
  two[1].friction = 0.5F;
  make_box(two[1], {1e-3F, 2e-3F, 3e-3F});
  two[1].vertices_m[6] = {3e8F, 0, 4e8F};
  EXPECT_EQ(set_obstacles(session.kernel, two, &why), Status::kConfigValueOutOfRange);
  EXPECT_STREQ(why.field, "obstacle.vertices_m");
  EXPECT_EQ(std::tuple(why.index, why.vertex, why.value), std::tuple(1U, 6U, 5e8));
  make_box(two[1], {1e-3F, 2e-3F, 3e-3F});
  EXPECT_EQ(set_obstacles(session.kernel, two, &why), Status::kOk);
  EXPECT_STREQ(why.field, "") << "nothing was refused";
  EXPECT_EQ(view_of(session.kernel).model.head->obstacle_count, 2U);
}

// As in managed languages: the Organ is moved, and its old memory is used for something else.
TEST(Kernel, NeedsOnlyTheBytesOfItsOrgan) {
  const auto opened = block_organ(6, 5, 8);
  const Script script = block_script(opened->organ, Config{});
  Session expected = make_session(opened->organ, Config{});
  run(expected.kernel, script, 0, 1300);
  auto elsewhere = std::make_unique<Organ>(opened->organ);
  Session session = make_session(*elsewhere, Config{});
  std::memset(static_cast<void*>(elsewhere.get()), 0xA5, sizeof(Organ));
  elsewhere.reset();
  run(session.kernel, script, 0, 1300);
  EXPECT_EQ(hash(session.kernel), hash(expected.kernel));
  std::vector<Vec3> places(opened->organ.vertices.size());
  EXPECT_EQ(surface(session.kernel, places), places.size());
}

TEST(Kernel, ACopyMadeBeforeItsTeamIsTheSameKernel) {
  const auto opened = block_organ(6, 5, 8);
  Session session = make_session(opened->organ, Config{});
  Kernel copy = session.kernel;
  EXPECT_FALSE(help(copy, 3)) << "without a team";
  Block memory = make_block(team_bytes(session.kernel, 1));
  ASSERT_EQ(set_team(session.kernel, 1, memory.span()), Status::kOk);
  EXPECT_TRUE(has_team(copy));
  EXPECT_FALSE(help(copy, 3)) << "nothing to do yet";
  (void)tick(copy, Input{});
  EXPECT_EQ(hash(copy), hash(session.kernel));
  ASSERT_EQ(set_team(copy, 0, {}), Status::kOk);
  memory = {};
  EXPECT_FALSE(help(session.kernel, 3));
  (void)tick(session.kernel, Input{});
}

}  // namespace
}  // namespace stylet::test
