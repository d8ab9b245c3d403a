// SPDX-License-Identifier: Apache-2.0
// V25: whatever the device sends, in any phase, the force is finite, every bad value is counted, no
// fault latches, and the tissue comes back to rest.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr Vec3 kMiddle = {0, 26e-3F, 24e-3F};

TinyOrgan soft_block() {  // a thousand voxels
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = 10;
  tiny.fixed_faces = kHighX | kLowZ;
  tiny.materials[0].youngs_modulus_pa = 15000;
  tiny.materials[0].puncture_force_n = 0.3F;
  tiny.materials[0].relaxing_fraction = 0.3F;
  tiny.materials[0].viscous_friction_n_s_per_m2 = 50;
  return tiny;
}

bool finite(const Output& out) {
  return std::isfinite(norm_of(out.force_n)) && std::isfinite(norm_of(out.torque_nm)) &&
         std::isfinite(norm_of(out.tip_m)) && std::isfinite(out.depth_m);
}

enum class Where { kFree, kContact, kInserted };

const char* name_of(Where where) {
  constexpr const char* kNames[] = {"Free", "Contact", "Inserted"};
  return kNames[static_cast<int>(where)];
}
void PrintTo(Where where, std::ostream* out) {
  *out << name_of(where);
}

Vec3 place_of(Where where) {
  const float x = where == Where::kFree ? -30e-3F : (where == Where::kContact ? 3e-3F : 30e-3F);
  return {x, kMiddle.y, kMiddle.z};
}

Rig rig_in(Where where) {
  Rig rig = make_rig(soft_block(), Config{});
  Output out = drive(rig, {-31e-3F, kMiddle.y, kMiddle.z}, place_of(where).x, 50e-3F);
  const Phase expected = where == Where::kFree
                             ? Phase::kFree
                             : (where == Where::kContact ? Phase::kContact : Phase::kInserted);
  EXPECT_EQ(out.phase, expected);
  return rig;
}

// Takes the needle away, waits, and measures what is left.
void expect_back_at_rest(Rig& rig, const std::string& after) {
  const Vec3 away = {-100e-3F, kMiddle.y, kMiddle.z};
  Output out = {};
  for (int i = 0; i < 4000; ++i) {
    out = move_tip(rig, away);
    ASSERT_TRUE(finite(out)) << after << ", leaving, tick " << i;
  }
  View view = rig.view();
  double largest = 0;
  for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
    largest = std::max(largest, norm_of({view.state.ux[i], view.state.uy[i], view.state.uz[i]}));
  }
  EXPECT_LT(largest, 1e-6) << after;
  EXPECT_EQ(out.phase, Phase::kFree) << after;
  EXPECT_EQ(norm_of(out.force_n), 0) << after;
  EXPECT_EQ(stats(rig.kernel()).fault, 0U) << after;
}

struct Bad {
  std::string name;
  float value;
  std::uint32_t flag_in_position, flag_in_rotation;  // 0: both are right
};

std::vector<Bad> bad_values() {
  using Limits = std::numeric_limits<float>;
  return {{"NaN", Limits::quiet_NaN(), kFlagInputNotFinite, kFlagInputNotFinite},
          {"infinity", Limits::infinity(), kFlagInputNotFinite, kFlagInputNotFinite},
          {"-infinity", -Limits::infinity(), kFlagInputNotFinite, kFlagInputNotFinite},
          {"1e30", 1e30F, kFlagInputClamped, kFlagInputNotFinite},
          {"-1e30", -1e30F, kFlagInputClamped, kFlagInputNotFinite},
          {"largest", Limits::max(), kFlagInputClamped, kFlagInputNotFinite},
          {"denormal", Limits::denorm_min(), 0, 0},
          {"-denormal", -1e-40F, 0, 0},
          {"-0", -0.0F, 0, 0}};
}

float& field_of(Pose& pose, int index) {
  float* fields[7] = {&pose.position_m.x, &pose.position_m.y, &pose.position_m.z, &pose.rotation.w,
                      &pose.rotation.x,   &pose.rotation.y,   &pose.rotation.z};
  return *fields[index];
}

// Runs of 20 bad samples, each field in turn, with good ones between.
class V25Abuse : public testing::TestWithParam<Where> {};

TEST_P(V25Abuse, BadNumberInAnyField) {
  Rig rig = rig_in(GetParam());
  const Input good = along_x(place_of(GetParam()), rig.length_m);
  for (const Bad& bad : bad_values()) {
    for (int field = 0; field < 7; ++field) {
      const Stats before = stats(rig.kernel());
      Input input = good;
      field_of(input.handle, field) = bad.value;
      for (int i = 0; i < 20; ++i) {
        const Output out = checked_tick(rig, input);
        ASSERT_TRUE(finite(out)) << bad.name << " in field " << field << ", tick " << i;
        ASSERT_EQ(out.flags & kFlagFault, 0U);
        const std::uint32_t flag = field < 3 ? bad.flag_in_position : bad.flag_in_rotation;
        if (flag != 0) {
          ASSERT_EQ(out.flags & (kFlagInputNotFinite | kFlagInputClamped), flag)
              << bad.name << " in field " << field;
        }
      }
      const Stats after = stats(rig.kernel());
      const std::uint32_t flag = field < 3 ? bad.flag_in_position : bad.flag_in_rotation;
      if (flag == kFlagInputNotFinite) {
        EXPECT_EQ(after.input_not_finite - before.input_not_finite, 20U);
      }
      if (flag == kFlagInputClamped) {
        EXPECT_EQ(after.input_clamped - before.input_clamped, 20U);
      }
      for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(finite(checked_tick(rig, good))) << "after " << bad.name << ", tick " << i;
      }
    }
  }
  expect_back_at_rest(rig, "bad numbers");
}

TEST_P(V25Abuse, NoDirectionInTheRotation) {
  Rig rig = rig_in(GetParam());
  Input input = along_x(place_of(GetParam()), rig.length_m);
  const Output before = checked_tick(rig, input);
  for (const float size : {0.0F, -0.0F, 1e-45F, 1e-30F}) {
    input.handle.rotation = {size, size, -size, size};
    const Output out = checked_tick(rig, input);
    ASSERT_TRUE(finite(out));
    EXPECT_EQ(out.flags, kFlagInputNotFinite) << size;
    EXPECT_EQ(norm_of(out.tip_m - before.tip_m), 0) << "the last pose is kept";
  }
  EXPECT_EQ(stats(rig.kernel()).input_not_finite, 4U);
}

TEST_P(V25Abuse, MissingSamplesKeepTheLastPose) {
  Rig rig = rig_in(GetParam());
  Input input = along_x(place_of(GetParam()), rig.length_m);
  const Output before = checked_tick(rig, input);
  input.valid = 0;
  input.handle.position_m = {std::numeric_limits<float>::quiet_NaN(), 1e30F, -1};
  for (int i = 0; i < 1000; ++i) {
    const Output out = checked_tick(rig, input);
    ASSERT_TRUE(finite(out));
    ASSERT_EQ(out.flags, kFlagInputMissing);
    ASSERT_EQ(norm_of(out.tip_m - before.tip_m), 0);
  }
  EXPECT_EQ(stats(rig.kernel()).input_missing, 1000U);
}

TEST_P(V25Abuse, JumpsAndTeleports) {
  for (const float jump : {0.3F, -0.3F, 1.0F, -1.0F, 1e3F}) {  // 1e3 m in a tick: 1e6 m/s
    for (int axis = 0; axis < 3; ++axis) {
      Rig rig = rig_in(GetParam());
      Input input = along_x(place_of(GetParam()), rig.length_m);
      Input far = input;
      field_of(far.handle, axis) += jump;
      const std::string what =
          "jump of " + std::to_string(jump) + " m, axis " + std::to_string(axis);
      std::uint64_t clamped = 0;
      Vec3 last = checked_tick(rig, input).tip_m;
      const auto send = [&](const Input& sample, int ticks) {
        for (int i = 0; i < ticks; ++i) {
          const Output out = checked_tick(rig, sample);
          ASSERT_TRUE(finite(out)) << what << ", tick " << i;
          ASSERT_EQ(out.flags & kFlagFault, 0U) << what;
          clamped += (out.flags & kFlagInputClamped) != 0 ? 1 : 0;
          ASSERT_LE(norm_of(out.tip_m - last), 1.001e-3 * static_cast<double>(kMaxHandleSpeedMPerS))
              << what;
          last = out.tip_m;
        }
      };
      send(far, 1);
      send(input, 50);
      send(far, 500);
      send(input, 500);
      EXPECT_EQ(stats(rig.kernel()).input_clamped, clamped) << what;
      EXPECT_GT(clamped, 50U) << what;
      expect_back_at_rest(rig, what);
    }
  }
}

TEST_P(V25Abuse, SpinsAndFlips) {
  Rig rig = rig_in(GetParam());
  const Input good = along_x(place_of(GetParam()), rig.length_m);
  const Quat turns[] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}};
  for (const Quat& turn : turns) {
    Input input = good;
    input.handle.rotation = turn;
    for (int i = 0; i < 100; ++i) {
      const Output out = checked_tick(rig, input);
      ASSERT_TRUE(finite(out)) << "tick " << i;
    }
  }
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(finite(checked_tick(rig, good)));
  expect_back_at_rest(rig, "spins");
}

TEST_P(V25Abuse, HugeLateralDrag) {
  Rig rig = rig_in(GetParam());
  const Vec3 from = place_of(GetParam());
  for (int i = 0; i < 400; ++i) {  // 1 m to the side and back
    const float way = 5e-3F * static_cast<float>(i < 200 ? i : 400 - i);
    const Output out = move_tip(rig, {from.x, from.y + way, from.z - 0.5F * way});
    ASSERT_TRUE(finite(out)) << "tick " << i;
    ASSERT_EQ(out.flags & kFlagFault, 0U);
  }
  expect_back_at_rest(rig, "lateral drag");
}

// Numbers that a snapshot may contain, but whose sums leave the range of floats: they give a fault
// and no force, and no number on the way is converted outside the range of its type (which the
// sanitizers would see). In paper mode slips are whole units.
TEST(V25AbuseState, InfiniteSumsAreAFault) {
  for (const Mode mode : {Mode::kPhysical, Mode::kPaper}) {
    Config config;
    config.mode = mode;
    Rig rig = make_rig(soft_block(), config);
    (void)drive(rig, {-31e-3F, kMiddle.y, kMiddle.z}, 30e-3F, 50e-3F);
    ASSERT_GT(rig.view().state.needle->shaft_count, 1U);
    constexpr float kLargest = std::numeric_limits<float>::max();
    std::mt19937 random(79);
    for (std::uint32_t i = 0; i < rig.view().state.needle->shaft_count; ++i) {
      Particle& p = rig.view().state.shaft[i];
      const auto any = [&random] { return random() % 2 == 0 ? kLargest : -kLargest; };
      p.memory_m = {any(), any(), any()};
      p.slack_m = {any(), any(), any()};
      p.axial_way_m = {any(), any(), any()};
    }
    Output out = {};
    for (int i = 0; i < 3; ++i) {
      out = tick(rig.kernel(), along_x({30e-3F, kMiddle.y, kMiddle.z}, rig.length_m));
    }
    EXPECT_NE(out.flags & kFlagFault, 0U);
    EXPECT_EQ(norm_of(out.force_n), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(AllPhases, V25Abuse,
                         testing::Values(Where::kFree, Where::kContact, Where::kInserted),
                         [](const auto& each) { return name_of(each.param); });

// 1e5 ticks of a needle shaken in every direction, with every kind of bad sample among them; seed
// 25. What was sent is counted outside, and must be what the kernel counted.
TEST(V25AbuseLong, ShakenHundredThousandTicks) {
  Rig rig = make_rig(soft_block(), Config{});
  std::mt19937 random(25);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::uint64_t missing = 0, not_finite = 0, clamped = 0;
  Vec3 aim = kMiddle;
  for (int i = 0; i < 100000; ++i) {
    if (i % 50 == 0) {
      aim = {0.02F + 0.06F * uniform(random), kMiddle.y + 0.03F * uniform(random),
             kMiddle.z + 0.03F * uniform(random)};
    }
    const float shake = 0.02F * static_cast<float>(i % 7 == 0);
    Input input = along_x({aim.x + shake * uniform(random), aim.y + shake * uniform(random),
                           aim.z + shake * uniform(random)},
                          rig.length_m);
    input.handle.rotation.x += 0.2F * uniform(random);
    input.handle.rotation.z += 0.2F * uniform(random);
    if (i % 97 == 5) input.handle.rotation.y = std::numeric_limits<float>::quiet_NaN();
    if (i % 89 == 7) input.valid = 0;
    missing += input.valid == 0 ? 1 : 0;
    not_finite += input.valid != 0 && i % 97 == 5 ? 1 : 0;
    const Output out = checked_tick(rig, input);
    ASSERT_TRUE(finite(out)) << "tick " << i;
    ASSERT_EQ(out.flags & kFlagFault, 0U) << "tick " << i;
    clamped += (out.flags & kFlagInputClamped) != 0 ? 1 : 0;
  }
  const Stats s = stats(rig.kernel());
  EXPECT_EQ(s.ticks, 100000U);
  EXPECT_EQ(s.input_missing, missing);
  EXPECT_EQ(s.input_not_finite, not_finite);
  EXPECT_EQ(s.input_clamped, clamped);
  EXPECT_EQ(s.fault, 0U);
  EXPECT_GT(rig.view().state.head->event_count, 20U) << "it did touch and enter the tissue";
  expect_back_at_rest(rig, "shaking");
}

}  // namespace
}  // namespace stylet::test
