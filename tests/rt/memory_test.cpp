// SPDX-License-Identifier: Apache-2.0
// The kernel lives in the bytes it asked for: it uses all of them and no others, and what it leaves
// in scratch never matters.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "promises.h"
#include "session.h"
#include "worst_case.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kTicks = 2 * kCycleTicks;
#if defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kTicksInThreads = 700;  // contact, puncture, the first particles
#else
constexpr std::uint64_t kTicksInThreads = kTicks;
#endif

class Blocks : public testing::TestWithParam<Setup> {
 protected:
  std::unique_ptr<OpenOrgan> opened_ = block_organ(6, 6, 8);
  Config config_ = config_of(GetParam());
  Script script_ = block_script(opened_->organ, config_);

  Sizes sizes_of() const {
    Sizes bytes{};
    EXPECT_EQ(sizes(opened_->organ, config_, bytes), Status::kOk);
    return bytes;
  }
  std::uint64_t hash_after(std::uint64_t ticks) const {
    Session session = make_session(opened_->organ, GetParam());
    run(session.kernel, script_, 0, ticks);
    return hash(session.kernel);
  }
};

INSTANTIATE_TEST_SUITE_P(Modes, Blocks, testing::ValuesIn(kSetups),
                         [](const auto& instance) { return setup_name(instance.param); });

// A block between two guards as large as its alignment, everything filled with one byte.
struct Guarded {
  Block whole;
  std::size_t size;

  std::span<std::byte> inner() const { return whole.span().subspan(kBlockAlignment, size); }
  bool guards_hold(std::byte fill) const {
    const auto all = whole.span();
    const auto is_fill = [fill](std::byte b) { return b == fill; };
    return std::all_of(all.begin(), all.begin() + kBlockAlignment, is_fill) &&
           std::all_of(all.end() - kBlockAlignment, all.end(), is_fill);
  }
};

Guarded make_guarded(std::size_t size, std::byte fill) {
  return {make_block(size + 2 * kBlockAlignment, fill), size};
}

struct GuardedMemory {
  Guarded model, state, scratch;
  Memory memory() const { return {model.inner(), state.inner(), scratch.inner()}; }
};

GuardedMemory make_guarded_memory(const Sizes& bytes, std::byte fill) {
  return {make_guarded(bytes.model_bytes, fill), make_guarded(bytes.state_bytes, fill),
          make_guarded(bytes.scratch_bytes, fill)};
}

// The last byte in which two runs with different fillings agree was written by both runs.
std::size_t written_size(std::span<const std::byte> a, std::span<const std::byte> b) {
  std::size_t size = a.size();
  while (size > 0 && a[size - 1] != b[size - 1]) --size;
  return size;
}

TEST_P(Blocks, AreUsedAsPredicted) {
  const Sizes bytes = sizes_of();
  constexpr std::byte kFills[2] = {std::byte{0xA5}, std::byte{0x5A}};
  std::array<GuardedMemory, 2> used = {make_guarded_memory(bytes, kFills[0]),
                                       make_guarded_memory(bytes, kFills[1])};
  for (std::size_t i = 0; i < 2; ++i) {
    Kernel kernel;
    ASSERT_EQ(create(opened_->organ, config_, used[i].memory(), kernel), Status::kOk);
    run(kernel, script_, 0, kTicks);
    EXPECT_TRUE(used[i].model.guards_hold(kFills[i]));
    EXPECT_TRUE(used[i].state.guards_hold(kFills[i]));
    EXPECT_TRUE(used[i].scratch.guards_hold(kFills[i]));
  }
  // No memory was asked for in vain: the last written byte is in the last line of each block.
  // Scratch is as large as its pools, which a run need not fill.
  const auto expect_filled = [](const char* name, const Guarded& a, const Guarded& b) {
    EXPECT_GT(written_size(a.inner(), b.inner()) + kBlockAlignment, a.size) << name;
  };
  expect_filled("model", used[0].model, used[1].model);
  expect_filled("state", used[0].state, used[1].state);
}

// One line of memory.txt.
struct Committed {
  std::uint32_t nx = 0, ny = 0, nz = 0, needles = 0, helpers = 0;
  std::size_t model = 0, state = 0, scratch = 0, team = 0;
};

std::vector<Committed> committed_rows() {
  std::ifstream file(STYLET_MEMORY_ROWS);
  std::vector<Committed> rows;
  for (std::string line; std::getline(file, line);) {
    Committed row;
    std::istringstream words(line);
    if (line.empty() || line[0] == '#') continue;
    words >> row.nx >> row.ny >> row.nz >> row.needles >> row.helpers >> row.model >> row.state >>
        row.scratch >> row.team;
    EXPECT_FALSE(words.fail()) << line;
    rows.push_back(row);
  }
  return rows;
}

// The row as predicted now: it belongs in the file if the change is intended.
std::string line_of(const Committed& row, const Sizes& now, std::size_t team) {
  std::ostringstream text;
  text << row.nx << ' ' << row.ny << ' ' << row.nz << ' ' << row.needles << ' ' << row.helpers
       << ' ' << now.model_bytes << ' ' << now.state_bytes << ' ' << now.scratch_bytes << ' '
       << team;
  return text.str();
}

std::string line_of(const Committed& row) {
  return line_of(row, {row.model, row.state, row.scratch}, row.team);
}

// Returns the present row.
std::string expect_used(const Committed& row) {
  const auto opened =
      block_organ(static_cast<std::uint16_t>(row.nx), static_cast<std::uint16_t>(row.ny),
                  static_cast<std::uint16_t>(row.nz));
  Config config = config_of(Setup::kElastic);
  config.needle_count = row.needles;
  Sizes bytes{};
  EXPECT_EQ(sizes(opened->organ, config, bytes), Status::kOk);
  constexpr std::byte kFill{0xA5};
  const GuardedMemory given = make_guarded_memory(bytes, kFill);
  Kernel kernel;
  const Status created = create(opened->organ, config, given.memory(), kernel);
  EXPECT_EQ(created, Status::kOk);
  if (created != Status::kOk) return "";
  EXPECT_EQ(kernel.sizes.model_bytes, bytes.model_bytes);
  EXPECT_EQ(kernel.sizes.state_bytes, bytes.state_bytes);
  EXPECT_EQ(kernel.sizes.scratch_bytes, bytes.scratch_bytes);
  const std::size_t team = team_bytes(kernel, row.helpers);
  const Guarded helped = make_guarded(team, kFill);
  EXPECT_EQ(set_team(kernel, row.helpers, helped.inner()), Status::kOk);
  run(kernel, block_script(opened->organ, config), 0, 3);
  for (const Guarded* each : {&given.model, &given.state, &given.scratch, &helped}) {
    EXPECT_TRUE(each->guards_hold(kFill)) << line_of(row);
  }
  return line_of(row, bytes, team);
}

TEST(Memory, IsWhatIsCommitted) {
  const std::vector<Committed> rows = committed_rows();
  ASSERT_GE(rows.size(), 8U) << STYLET_MEMORY_ROWS;
  std::string committed, now;
  for (const Committed& row : rows) {
    committed += line_of(row) + '\n';
    now += expect_used(row) + '\n';
  }
  // A single failure, whose rows can be copied into the file.
  if (now != committed) {
    FAIL() << "if the change is meant, these are the rows of " << STYLET_MEMORY_ROWS << ":\n"
           << now;
  }
}

// Every pool full at once, and nothing beyond its end.
TEST(Memory, HoldsTheWorstCase) {
  const WorstCase worst = worst_case();
  Session session = make_session(worst.organ->organ, worst.config);
  ASSERT_EQ(set_obstacles(session.kernel, worst.obstacles), Status::kOk);
  std::array<Input, kMaxNeedles> inputs;
  std::array<Output, kMaxNeedles> outputs;
  for (std::uint64_t at = 0; at < kWorstTicks; ++at) {
    worst_inputs(worst, at, inputs);
    tick(session.kernel, inputs, outputs);
    const char* broken = broken_promise(session.kernel, outputs);
    ASSERT_EQ(broken, nullptr) << broken << ", tick " << at;
  }
  const Stats now = stats(session.kernel);
  EXPECT_EQ(now.constraint_particles.used, kMaxNeedles * kMaxConstraintParticles);
  EXPECT_EQ(now.coupled_voxels.used_max, kMaxNeedles * kMaxCoupledVoxels);
  EXPECT_EQ(now.obstacle_contacts.used, kMaxNeedles * kMaxTouches);
  EXPECT_GT(now.cp_pool_full, 0U);
  EXPECT_GT(now.cp_voxel_pool_full, 0U);
  EXPECT_GT(now.obstacle_pool_full, 0U);
}

TEST_P(Blocks, TooSmallByOneByteAreRefusedUntouched) {
  const Sizes bytes = sizes_of();
  constexpr std::byte kFill{0xA5};
  for (int which = 0; which < 3; ++which) {
    const GuardedMemory given = make_guarded_memory(bytes, kFill);
    Memory memory = given.memory();
    std::span<std::byte>* spans[3] = {&memory.model, &memory.state, &memory.scratch};
    *spans[which] = spans[which]->first(spans[which]->size() - 1);
    Kernel kernel;
    EXPECT_EQ(create(opened_->organ, config_, memory, kernel), Status::kMemoryTooSmall) << which;
    for (const auto& span : {memory.model, memory.state, memory.scratch}) {
      EXPECT_TRUE(std::all_of(span.begin(), span.end(), [](std::byte b) { return b == kFill; }));
    }
  }
}

TEST_P(Blocks, MisalignedAreRefused) {
  const Sizes bytes = sizes_of();
  for (int which = 0; which < 3; ++which) {
    for (const std::size_t shift : {std::size_t{1}, std::size_t{4}, kBlockAlignment / 2}) {
      const GuardedMemory given = make_guarded_memory(bytes, std::byte{0});
      Memory memory = given.memory();
      std::span<std::byte>* spans[3] = {&memory.model, &memory.state, &memory.scratch};
      *spans[which] = {spans[which]->data() + shift, spans[which]->size()};
      Kernel kernel;
      EXPECT_EQ(create(opened_->organ, config_, memory, kernel), Status::kMemoryNotAligned)
          << "block " << which << " shifted by " << shift;
    }
  }
}

TEST_P(Blocks, ScratchContentNeverMatters) {
  const std::uint64_t expected = hash_after(kTicks);
  const auto hash_with = [this](auto fill) {
    Session session = make_session(opened_->organ, GetParam());
    for (std::uint64_t i = 0; i < kTicks; ++i) {
      fill(session.scratch.span());
      run(session.kernel, script_, i, 1);
    }
    return hash(session.kernel);
  };
  EXPECT_EQ(hash_with([](auto scratch) { std::memset(scratch.data(), 0, scratch.size()); }),
            expected);
  EXPECT_EQ(hash_with([](auto scratch) { std::memset(scratch.data(), 0xFF, scratch.size()); }),
            expected);
  std::uint32_t random = 1;
  EXPECT_EQ(hash_with([&random](auto scratch) {
              for (std::byte& b : scratch) {
                random = random * 1664525U + 1013904223U;
                b = static_cast<std::byte>(random >> 24U);
              }
            }),
            expected);
}

TEST_P(Blocks, HashSeesTheState) {
  EXPECT_NE(hash_after(kCycleTicks / 2), hash_after(kCycleTicks / 2 + 1));
}

TEST_P(Blocks, SnapshotsContinueWithTheSameBits) {
  Session original = make_session(opened_->organ, GetParam());
  const std::uint64_t half = kCycleTicks / 2;  // the needle is in the tissue
  run(original.kernel, script_, 0, half);
  Block saved = make_block(snapshot_bytes(original.kernel));
  ASSERT_EQ(snapshot(original.kernel, saved.span()), Status::kOk);
  const std::uint64_t hash_saved = hash(original.kernel);

  Session copy = make_session(opened_->organ, GetParam());
  run(copy.kernel, script_, 77, 1234);  // first moved to somewhere else
  EXPECT_NE(difference(original.kernel, copy.kernel).field, nullptr);
  ASSERT_EQ(restore(copy.kernel, saved.span()), Status::kOk);
  EXPECT_EQ(hash(copy.kernel), hash_saved);
  EXPECT_EQ(difference(original.kernel, copy.kernel).field, nullptr);
  for (std::uint64_t i = half; i < half + kCycleTicks; ++i) {
    const Input input = scripted_input(script_, i);
    const Output a = tick(original.kernel, input), b = tick(copy.kernel, input);
    ASSERT_EQ(std::memcmp(&a.force_n, &b.force_n, sizeof a.force_n), 0) << "tick " << i;
    ASSERT_EQ(hash(original.kernel), hash(copy.kernel)) << "tick " << i;
  }
  EXPECT_EQ(difference(original.kernel, copy.kernel).field, nullptr);
}

TEST_P(Blocks, SnapshotsOfAnotherConfigurationOrSizeAreRefused) {
  Session here = make_session(opened_->organ, GetParam());
  Config other_config = config_;
  other_config.period_s = 0.5e-3F;
  Session other = make_session(opened_->organ, other_config);
  Block saved = make_block(snapshot_bytes(other.kernel));
  ASSERT_EQ(snapshot(other.kernel, saved.span()), Status::kOk);
  const std::uint64_t before = hash(here.kernel);
  EXPECT_EQ(restore(here.kernel, saved.span()), Status::kSnapshotDoesNotMatch);
  ASSERT_EQ(snapshot(here.kernel, saved.span()), Status::kOk);
  EXPECT_NE(restore(here.kernel, saved.span().first(saved.size - 1)), Status::kOk);
  EXPECT_NE(restore(here.kernel, saved.span().first(3)), Status::kOk);
  EXPECT_NE(snapshot(here.kernel, saved.span().first(saved.size - 1)), Status::kOk);
  EXPECT_EQ(hash(here.kernel), before);
}

TEST_P(Blocks, ResetIsTheBeginning) {
  Session session = make_session(opened_->organ, GetParam());
  const std::uint64_t at_start = hash(session.kernel);
  run(session.kernel, script_, 0, kTicks);
  EXPECT_NE(hash(session.kernel), at_start);
  reset(session.kernel);
  EXPECT_EQ(hash(session.kernel), at_start);
  run(session.kernel, script_, 0, kTicks);
  EXPECT_EQ(hash(session.kernel), hash_after(kTicks));
}

TEST_P(Blocks, KernelsShareAnOrganInTwoThreads) {
  const std::uint64_t expected = hash_after(kTicksInThreads);
  std::array<std::uint64_t, 2> seen{};
  std::array<std::thread, 2> threads;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads[i] = std::thread([this, i, &seen] { seen[i] = hash_after(kTicksInThreads); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(seen[0], expected);
  EXPECT_EQ(seen[1], expected);
}

}  // namespace
}  // namespace stylet::test
