// SPDX-License-Identifier: Apache-2.0
// The same bits whatever the processor's mode, the instruction set, the content of scratch, the
// bytes that were in the blocks before, and the address of the blocks.

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#if defined(__x86_64__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "state/layout.h"
#include "session.h"
#include "variants.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kTicks = 9000;  // two insertions, and tissue left to come to rest

// A block whose skin the session's script punctures in either mode.
std::unique_ptr<OpenOrgan> entered_block() {
  TinyOrgan tiny;
  tiny.nx = 6;
  tiny.ny = 5;
  tiny.nz = 8;
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.materials[0].cutting_force_n = 0.05F;
  tiny.materials[0].relaxing_fraction = 0.3F;
  return open_organ(tiny_organ(tiny));
}

struct Result {
  std::vector<std::uint64_t> hashes;  // every hundred ticks
  std::vector<float> force;
};

// `before_tick(kernel, tick)` may do anything that must not change the result.
template <typename Before>
Result run_with(Session& session, const Organ& organ, const Config& config, Before before_tick) {
  const Script script = block_script(organ, config);
  Result result;
  for (std::uint64_t i = 0; i < kTicks; ++i) {
    before_tick(session.kernel, i);
    const Output out = tick(session.kernel, scripted_input(script, i));
    result.force.insert(result.force.end(), {out.force_n.x, out.force_n.y, out.force_n.z});
    if (i % 100 == 99) result.hashes.push_back(hash(session.kernel));
  }
  return result;
}

class Determinism : public testing::TestWithParam<Setup> {
 protected:
  std::unique_ptr<OpenOrgan> organ_ = entered_block();
  Config config_ = config_of(GetParam());
  Session reference_ = make_session(organ_->organ, GetParam());
  Result expected_ = run_with(reference_, organ_->organ, config_, [](Kernel&, std::uint64_t) {});

  template <typename Before>
  void expect_same(Session& session, const char* what, Before before_tick) {
    const Result result = run_with(session, organ_->organ, config_, before_tick);
    for (std::size_t i = 0; i < result.hashes.size(); ++i) {
      ASSERT_EQ(result.hashes[i], expected_.hashes[i]) << what << ", tick " << 100 * (i + 1);
    }
    ASSERT_EQ(std::memcmp(result.force.data(), expected_.force.data(),
                          result.force.size() * sizeof(float)),
              0)
        << what;
    const Difference d = difference(session.kernel, reference_.kernel);
    EXPECT_EQ(d.field, nullptr) << what << ": " << d.field << "[" << d.index << "]";
  }
};

TEST_P(Determinism, TheRunIsWorthComparing) {
  EXPECT_GT(view_of(reference_.kernel).state.needle->shaft_max, 3U);
  EXPECT_GT(stats(reference_.kernel).tracks.used, 0U);
  EXPECT_NE(expected_.hashes.front(), expected_.hashes.back());
}

TEST_P(Determinism, SameBitsForEveryInstructionSet) {
  for (const Variant& variant : variants_here()) {
    Session session = make_session(organ_->organ, GetParam());
    session.kernel.step = variant.step;
    expect_same(session, variant.name, [](Kernel&, std::uint64_t) {});
  }
}

TEST_P(Determinism, ScratchDoesNotMatter) {
  Session session = make_session(organ_->organ, GetParam());
  std::mt19937 random(7);
  expect_same(session, "scratch", [&random](Kernel& kernel, std::uint64_t i) {
    const int patterns[] = {0x00, 0xFF, 0x7F, 0xA5, static_cast<int>(random() & 0xFFU)};
    std::memset(kernel.scratch, patterns[i % std::size(patterns)], kernel.sizes.scratch_bytes);
  });
}

TEST_P(Determinism, BytesBeforeCreateDoNotMatter) {
  Sizes need = {};
  ASSERT_EQ(sizes(organ_->organ, config_, need), Status::kOk);
  for (const unsigned pattern : {0xFFU, 0xA5U, 0x7FU}) {
    const auto fill = static_cast<std::byte>(pattern);
    Session session = {make_block(need.model_bytes, fill),
                       make_block(need.state_bytes, fill),
                       make_block(need.scratch_bytes, fill),
                       {}};
    const Memory memory = {session.model.span(), session.state.span(), session.scratch.span()};
    ASSERT_EQ(create(organ_->organ, config_, memory, session.kernel), Status::kOk);
    ASSERT_EQ(set_obstacles(session.kernel, obstacles_of(organ_->organ, GetParam())), Status::kOk);
    expect_same(session, "bytes before create", [](Kernel&, std::uint64_t) {});
  }
}

TEST_P(Determinism, BlocksMayMove) {
  Session session = make_session(organ_->organ, GetParam());
  Session other = make_session(organ_->organ, GetParam());
  expect_same(session, "moved blocks", [&](Kernel& kernel, std::uint64_t i) {
    if (i % 500 != 250) return;
    const bool at_home = kernel.state == session.state.bytes.get();
    Session& to = at_home ? other : session;
    std::memcpy(to.state.bytes.get(), kernel.state, kernel.sizes.state_bytes);
    std::memcpy(to.model.bytes.get(), kernel.model, kernel.sizes.model_bytes);
    kernel.state = to.state.bytes.get();
    kernel.model = to.model.bytes.get();
  });
}

#if defined(__x86_64__)
// Runs two kernels side by side, one with denormals flushed to zero; names the first difference.
void expect_same_when_flushed(Kernel& plain, Kernel& flushed, std::span<const Input> inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    tick(plain, inputs[i]);
    const unsigned mode = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    tick(flushed, inputs[i]);
    _mm_setcsr(mode);
    const Difference d = difference(plain, flushed);
    ASSERT_EQ(d.field, nullptr) << "tick " << i << ": " << d.field << "[" << d.index << "]";
  }
}

TEST_P(Determinism, FlushToZeroDoesNotMatter) {
  const Script script = block_script(organ_->organ, config_);
  std::vector<Input> inputs;
  for (std::uint64_t i = 0; i < kTicks; ++i) inputs.push_back(scripted_input(script, i));
  for (const Variant& variant : variants_here()) {
    Session plain = make_session(organ_->organ, GetParam());
    Session flushed = make_session(organ_->organ, GetParam());
    plain.kernel.step = flushed.kernel.step = variant.step;
    expect_same_when_flushed(plain.kernel, flushed.kernel, inputs);
  }
}

// A needle rests in the tissue for 6 s: all that decays has time to become tiny.
TEST_P(Determinism, FlushToZeroDoesNotMatterInALongRest) {
  const Script script = block_script(organ_->organ, config_);
  std::vector<Input> inputs;
  for (std::uint64_t i = 0; i < kPauseBegin; ++i) inputs.push_back(scripted_input(script, i));
  for (int i = 0; i < 6000; ++i) inputs.push_back(scripted_input(script, kPauseBegin));
  Session plain = make_session(organ_->organ, GetParam());
  Session flushed = make_session(organ_->organ, GetParam());
  expect_same_when_flushed(plain.kernel, flushed.kernel, inputs);
}
#endif

std::string name_of(const testing::TestParamInfo<Setup>& setup) {
  return setup_name(setup.param);
}
INSTANTIATE_TEST_SUITE_P(Setups, Determinism, testing::ValuesIn(kSetups), name_of);

}  // namespace
}  // namespace stylet::test
