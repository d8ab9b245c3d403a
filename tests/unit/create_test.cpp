// SPDX-License-Identifier: Apache-2.0
// `sizes` and `create`: exact memory, alignment, and every bound of the configuration.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "session.h"
#include "state/layout.h"
#include "stylet/limits.h"
#include "tiny_organ.h"

namespace stylet::test {
namespace {

std::unique_ptr<OpenOrgan> organ() {
  return block_organ(3, 2, 2);
}

struct Blocks {
  Sizes need;
  Block model, state, scratch;

  explicit Blocks(const Organ& organ) {
    EXPECT_EQ(sizes(organ, Config{}, need), Status::kOk);
    model = make_block(need.model_bytes + 64, std::byte{0xA5});
    state = make_block(need.state_bytes + 64, std::byte{0xA5});
    scratch = make_block(need.scratch_bytes + 64, std::byte{0xA5});
  }
  Memory memory() const {
    return {model.span().subspan(0, need.model_bytes), state.span().subspan(0, need.state_bytes),
            scratch.span().subspan(0, need.scratch_bytes)};
  }
  bool untouched() const {
    for (const Block* block : {&model, &state, &scratch}) {
      const auto span = block->span();
      if (std::any_of(span.begin(), span.end(), [](std::byte b) { return b != std::byte{0xA5}; })) {
        return false;
      }
    }
    return true;
  }
};

TEST(Create, AcceptsExactlyTheBytesAsked) {
  const auto opened = organ();
  Blocks blocks(opened->organ);
  Kernel kernel;
  EXPECT_EQ(create(opened->organ, Config{}, blocks.memory(), kernel), Status::kOk);
  for (const auto& [block, size] : {std::pair{&blocks.model, blocks.need.model_bytes},
                                    std::pair{&blocks.state, blocks.need.state_bytes},
                                    std::pair{&blocks.scratch, blocks.need.scratch_bytes}}) {
    const auto behind = block->span().subspan(size, 64);
    EXPECT_TRUE(std::all_of(behind.begin(), behind.end(),
                            [](std::byte b) { return b == std::byte{0xA5}; }));
  }
}

TEST(Create, RefusesOneByteTooFewInAnyBlock) {
  const auto opened = organ();
  for (int which = 0; which < 3; ++which) {
    Blocks blocks(opened->organ);
    Memory memory = blocks.memory();
    std::span<std::byte>* spans[] = {&memory.model, &memory.state, &memory.scratch};
    *spans[which] = spans[which]->subspan(0, spans[which]->size() - 1);
    Kernel kernel;
    EXPECT_EQ(create(opened->organ, Config{}, memory, kernel), Status::kMemoryTooSmall);
    EXPECT_EQ(kernel.state, nullptr);
    EXPECT_TRUE(blocks.untouched());
  }
}

TEST(Create, RefusesEveryMisalignment) {
  const auto opened = organ();
  for (int which = 0; which < 3; ++which) {
    for (std::size_t shift = 1; shift < kBlockAlignment; ++shift) {
      Blocks blocks(opened->organ);
      Memory memory = blocks.memory();
      const Block* owner[] = {&blocks.model, &blocks.state, &blocks.scratch};
      std::span<std::byte>* spans[] = {&memory.model, &memory.state, &memory.scratch};
      *spans[which] = owner[which]->span().subspan(shift, spans[which]->size());
      Kernel kernel;
      ASSERT_EQ(create(opened->organ, Config{}, memory, kernel), Status::kMemoryNotAligned)
          << which << " by " << shift;
      ASSERT_TRUE(blocks.untouched());
    }
  }
}

// A field of Config with its bounds; `set` writes a value into it.
struct Field {
  const char* name;
  std::function<void(Config&, float)> set;
  float low, high;
};

std::vector<Field> fields() {
  return {
      {"period_s", [](Config& c, float v) { c.period_s = v; }, kMinPeriodS, kMaxPeriodS},
      {"tissue_damping_s", [](Config& c, float v) { c.tissue_damping_s = v; }, 0, 1},
      {"surround_drag_per_s", [](Config& c, float v) { c.surround_drag_per_s = v; }, 0, 100},
      {"hourglass_weight", [](Config& c, float v) { c.hourglass_weight = v; }, 0.05F, 1},
      {"paper_alpha", [](Config& c, float v) { c.paper_alpha = v; }, 1e-3F, 1},
      {"length_m", [](Config& c, float v) { c.needle[0].length_m = v; }, 1e-3F, kMaxNeedleLengthM},
      {"outer_radius_m", [](Config& c, float v) { c.needle[0].outer_radius_m = v; }, 1e-5F, 0.01F},
      {"unit_m", [](Config& c, float v) { c.needle[0].unit_m = v; }, 1e-4F, 0.05F},
  };
}

Status status_of(const Config& config, ConfigRefusal* why = nullptr) {
  static const auto opened = organ();
  Sizes need = {};
  return sizes(opened->organ, config, need, why);
}

TEST(Config, AcceptsItsBoundsAndRefusesTheNextFloat) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Field& field : fields()) {
    for (const float good : {field.low, field.high}) {
      Config config;
      field.set(config, good);
      EXPECT_EQ(status_of(config), Status::kOk) << field.name << " = " << good;
    }
    for (const float bad :
         {std::nextafter(field.low, -kInfinity), std::nextafter(field.high, kInfinity), -1.0F,
          kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
      Config config;
      field.set(config, bad);
      ConfigRefusal why;
      EXPECT_EQ(status_of(config, &why), Status::kConfigValueOutOfRange)
          << field.name << " = " << bad;
      EXPECT_TRUE(std::string(why.field).ends_with(field.name)) << why.field;
      EXPECT_EQ(std::isnan(bad) ? std::isnan(why.value) : why.value == static_cast<double>(bad),
                true);
      EXPECT_EQ(why.least, static_cast<double>(field.low)) << field.name;
      EXPECT_EQ(why.most, static_cast<double>(field.high)) << field.name;
    }
  }
}

TEST(Config, RefusesOtherModesInertiasAndSubsteps) {
  for (const std::uint32_t mode : {2U, 7U, 0xFFFFFFFFU}) {
    Config config;
    config.mode = static_cast<Mode>(mode);
    EXPECT_EQ(status_of(config), Status::kConfigValueOutOfRange) << mode;
  }
  for (const std::uint32_t inertia : {2U, 0xFFFFFFFFU}) {
    Config config;
    config.inertia = static_cast<Inertia>(inertia);
    EXPECT_EQ(status_of(config), Status::kConfigValueOutOfRange) << inertia;
  }
  for (const std::uint32_t substeps : {0U, kMaxSubsteps + 1, 0xFFFFFFFFU}) {
    Config config;
    config.substeps = substeps;
    EXPECT_EQ(status_of(config), Status::kConfigValueOutOfRange) << substeps;
  }
  Config most;
  most.substeps = kMaxSubsteps;
  EXPECT_EQ(status_of(most), Status::kOk);
}

// The configuration runs at every combination of bounds: none gives a force that is not finite.
TEST(Config, EveryCornerRuns) {
  const auto opened = organ();
  const std::vector<Field> all = fields();
  for (std::uint32_t corner = 0; corner < 512; ++corner) {
    Config config;
    config.mode = (corner & 256U) != 0 ? Mode::kPaper : Mode::kPhysical;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].set(config, ((corner >> i) & 1U) != 0 ? all[i].high : all[i].low);
    }
    Session session = make_session(opened->organ, config);
    const float length = config.needle[0].length_m;
    for (int i = 0; i < 40; ++i) {
      const float depth = 5e-4F * static_cast<float>(i) - 2e-3F;
      const Output out =
          tick(session.kernel, {{{7e-3F, 5.5e-3F, 0.01F + length - depth}, {1, 0, 0, 0}}, 1});
      ASSERT_EQ(out.flags & kFlagFault, 0U) << "corner " << corner << ", tick " << i;
      ASSERT_TRUE(std::isfinite(out.force_n.z)) << "corner " << corner << ", tick " << i;
    }
  }
}

// A whole block moves at one speed. With added mass its mass is that of the step, with true mass
// that of the materials, and then the filter has as many passes as the stiffest tissue needs.
TEST(Inertia, KineticEnergyIsThatOfTheMovingMass) {
  TinyOrgan tiny;
  tiny.nx = 4;
  tiny.ny = 3;
  tiny.nz = 5;
  const auto opened = open_organ(tiny_organ(tiny));
  const Vec3 speed = {0.3F, -0.2F, 0.5F};  // m/s
  for (const Inertia inertia : {Inertia::kAddedMass, Inertia::kTrueMass}) {
    Config config;
    config.inertia = inertia;
    Session session = make_session(opened->organ, config);
    State state = view_of(session.kernel).state;
    for (std::uint32_t i = 0; i < particle_count(session.kernel); ++i) {
      state.vx[i] = speed.x;
      state.vy[i] = speed.y;
      state.vz[i] = speed.z;
      if (inertia == Inertia::kAddedMass) continue;  // its momentum is not filtered
      state.wx[i] = speed.x;
      state.wy[i] = speed.y;
      state.wz[i] = speed.z;
    }
    double real_kg = 0, stepped_kg = 0;
    for (std::uint32_t i = 0; i < opened->organ.material_count; ++i) {
      const MassReport mass = mass_report(session.kernel, i);
      real_kg += static_cast<double>(mass.real_kg);
      stepped_kg += static_cast<double>(mass.stepped_kg);
    }
    const double volume_m3 = 4 * 3 * 5 * std::pow(static_cast<double>(tiny.voxel_edge_m), 3);
    const double density = static_cast<double>(organ_material(opened->organ, 0).density_kg_per_m3);
    EXPECT_NEAR(real_kg, volume_m3 * density, 1e-6 * real_kg);
    const double moving_kg = inertia == Inertia::kTrueMass ? real_kg : stepped_kg;
    const double half_square = 0.5 * static_cast<double>(dot(speed, speed));
    EXPECT_NEAR(energy(session.kernel).kinetic, half_square * moving_kg, 1e-5 * moving_kg);
    if (inertia == Inertia::kAddedMass) {
      EXPECT_GT(stepped_kg, 2 * real_kg);
    }
    EXPECT_EQ(filter_passes(session.kernel) > 0, inertia == Inertia::kTrueMass);
    EXPECT_LE(filter_passes(session.kernel), kMaxFilterPasses);
  }
}

TEST(Sizes, RefuseAnOrganThatWasNotOpened) {
  Sizes need = {};
  EXPECT_NE(sizes(Organ{}, Config{}, need), Status::kOk);
}

#if defined(__x86_64__)
// Compared with what Linux says of this processor.
TEST(InstructionSet, IsTheWidestThatLinuxKnowsOfThisProcessor) {
  std::ifstream file("/proc/cpuinfo");
  std::set<std::string> has;
  for (std::string line; std::getline(file, line) && has.empty();) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word != "flags") continue;
    while (words >> word) has.insert(word);
  }
  if (has.empty()) GTEST_SKIP() << "/proc/cpuinfo names no instruction sets";
  const bool wide = has.count("avx512f") + has.count("avx512vl") + has.count("avx512dq") == 3;
  EXPECT_STREQ(instruction_set(), wide ? "avx512" : has.count("avx2") == 1 ? "avx2" : "baseline");
}
#endif

}  // namespace
}  // namespace stylet::test
