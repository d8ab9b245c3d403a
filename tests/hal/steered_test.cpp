// SPDX-License-Identifier: Apache-2.0
// The steering hand, on a needle that follows its bevel exactly (arcs of Webster et al. 2006) and
// in the loop with the kernel.
#include "hal/device/drivers/steered.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/base/rotation.h"
#include "rig.h"

namespace stylet::hal {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr float kLengthM = 0.15F;

double of(float value) {
  return static_cast<double>(value);
}
double distance(Vec3 a, Vec3 b) {
  return std::hypot(of(a.x) - of(b.x), of(a.y) - of(b.y), of(a.z) - of(b.z));
}

Steered steered_to(std::vector<Vec3> targets) {
  Steered steered;
  steered.config.targets_m = std::move(targets);
  steered.config.speed_m_per_s = 0.01F;
  steered.config.curvature_per_m = 8;
  return steered;
}

// A tip that moves where it points, and turns towards the bevel by `curvature` for each metre.
struct Path {
  Vec3 end;
  double nearest_via_m = 1;
};
Path follow(Steered& steered, double curvature, bool rolls, Vec3 via = {}) {
  const Device device = steered_device(steered, {"steered", 8, 2000});
  double p[3] = {0, 0, -of(kLengthM)}, t[3] = {0, 0, -1};
  double depth = 0;
  Path path;
  const std::uint64_t ticks = steered_ticks(steered.config, kLengthM, kPeriodS);
  for (std::uint64_t i = 0; i < ticks; ++i) {
    Sample sample{};
    EXPECT_TRUE(device.read(device.self, 0, sample));
    const double advance = -of(sample.pose.position_m.z) - depth;
    depth += advance;
    const Vec3 side = rotate(rolls ? sample.pose.rotation : Quat{1, 0, 0, 0}, {1, 0, 0});
    const double b[3] = {of(side.x), of(side.y), of(side.z)};
    const double along = b[0] * t[0] + b[1] * t[1] + b[2] * t[2];
    double length = 0;
    for (int k = 0; k < 3; ++k) {
      p[k] += advance * t[k];
      t[k] += advance * curvature * (b[k] - along * t[k]);
      length += t[k] * t[k];
    }
    for (double& each : t) each /= std::sqrt(length);
    path.end = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    path.nearest_via_m = std::min(path.nearest_via_m, distance(path.end, via));
    device.write(device.self,
                 {{},
                  path.end,
                  {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])}});
  }
  return path;
}

TEST(Steered, ReachesTargetsAllAroundThatAnUnrolledNeedleMisses) {
  for (const Vec3 off : {Vec3{0.015F, 0, 0}, Vec3{-0.015F, 0, 0}, Vec3{0, 0.012F, 0},
                         Vec3{-0.008F, -0.008F, 0}, Vec3{0, 0, 0}, Vec3{0.004F, -0.001F, 0}}) {
    const Vec3 target = {off.x, off.y, -kLengthM - 0.1F};
    Steered steered = steered_to({target}), unrolled = steered_to({target});
    EXPECT_LT(distance(follow(steered, 8, true).end, target), 1e-3) << off.x << " " << off.y;
    EXPECT_GT(distance(follow(unrolled, 8, false).end, target), 10e-3) << off.x << " " << off.y;
    EXPECT_LT(steered.rolls, 30U);
  }
}

// Soft tissue bends the path less than the hand assumes, and other needles bend more.
TEST(Steered, ToleratesAnotherCurvatureThanItAssumes) {
  for (const double curvature : {5.0, 6.5, 11.0}) {
    const Vec3 target = {0.008F, 0.003F, -kLengthM - 0.1F};
    Steered steered = steered_to({target});
    EXPECT_LT(distance(follow(steered, curvature, true).end, target), 1.5e-3) << curvature;
  }
}

TEST(Steered, PassesAViaPointOnTheWay) {
  // This is possible: at the via point the tip heads outwards by 11 mm more than the opposite arc
  // brings back.
  const Vec3 via = {0.004F, 0, -kLengthM - 0.05F}, target = {0, 0, -kLengthM - 0.12F};
  Steered steered = steered_to({via, target});
  const Path path = follow(steered, 8, true, via);
  EXPECT_LT(path.nearest_via_m, 1e-3);
  EXPECT_LT(distance(path.end, target), 1.5e-3);
}

TEST(Steered, StopsAtTheTargetAndKeepsTheLimitOfRoll) {
  Steered steered = steered_to({{0.01F, 0, -kLengthM - 0.05F}});
  (void)follow(steered, 8, true);
  EXPECT_NEAR(steered.depth_m, 0.05, 2e-3);
  Steered quick = steered_to({{-0.01F, 0, -kLengthM - 0.05F}});
  const Device device = steered_device(quick, {"steered", 8, 2000});
  device.write(device.self, {{}, {0, 0, -kLengthM}, {0, 0, -1}});
  double last = 0;
  for (int i = 0; i < 400; ++i) {
    Sample sample{};
    EXPECT_TRUE(device.read(device.self, 0, sample));
    const double angle =
        2 * std::fabs(std::atan2(of(sample.pose.rotation.z), of(sample.pose.rotation.w)));
    EXPECT_LE(std::fabs(angle - last), 0.012 * 1.001) << i;
    last = angle;
  }
  EXPECT_NEAR(last, 3.14159, 1e-3);
}

// ---- in the loop: scene, kernel, device
// ---------------------------------------------------------

constexpr const char* kScene = R"([needle]
gauge = "nitinol-0.58"
flexible = true
rods = 40
tip = "bevel"
curvature_per_m = 10
[approach]
direction = [1, 0, 0]
point_mm = [0, 30, 30]
start_mm = 5
[device]
kind = "steered"
[steering]
target_mm = [85, 36, 24]
curvature_per_m = 5
speed_mm_per_s = 20
hold_s = 0.1
)";

struct Reached {
  double miss_m;
  std::uint32_t rolls;
};

Reached steer_in_tissue(bool rolls) {
  test::TinyOrgan tiny;
  tiny.nx = 20;
  tiny.ny = tiny.nz = 12;
  tiny.fixed_faces = test::kHighX | test::kLowY | test::kHighY | test::kLowZ | test::kHighZ;
  tiny.materials[0].youngs_modulus_pa = 60e3F;
  tiny.materials[0].puncture_force_n = 0.2F;
  tiny.materials[0].cutting_force_n = 0.05F;
  tiny.materials[0].coulomb_friction_n_per_m = tiny.materials[0].static_friction_n_per_m = 1;
  const std::vector<std::byte> bytes = test::tiny_organ(tiny);
  Organ organ;
  EXPECT_EQ(organ_open(bytes, organ), Status::kOk);
  const Scene scene = parse_scene(kScene, "steered.toml");
  KernelInstance instance(organ, scene.config);
  LoopConfig config;
  config.hand[0].mapping = place_needle(scene, organ).mapping;
  config.hand[0].guard = scene.hands[0].guard;
  Steered steered;
  steered.config = scene.hands[0].steering;
  if (!rolls) steered.config.roll_rad_per_s = 0;
  for (Vec3& each : steered.config.targets_m) each = place_in_device(config.hand[0].mapping, each);
  config.ticks = steered_ticks(steered.config, scene.config.needle[0].length_m, 1e-3);
  LoopState state;
  VirtualTime time;
  const Device device = steered_device(steered, scene.hands[0].limits);
  run_loop(config, instance.kernel, std::span(&device, 1), virtual_clock(time), {}, state);
  return {distance(state.hand[0].output.tip_m, scene.hands[0].steering.targets_m[0]),
          steered.rolls};
}

// A needle that is not rolled shows the curvature of the path in this tissue: half of the needle's
// own.
TEST(Steered, ReachesATargetInTissueOnlyByRolling) {
  const Reached rolled = steer_in_tissue(true), unrolled = steer_in_tissue(false);
  RecordProperty("miss_um", static_cast<int>(1e6 * rolled.miss_m));
  RecordProperty("miss_without_um", static_cast<int>(1e6 * unrolled.miss_m));
  EXPECT_LT(rolled.miss_m, 2e-3);
  EXPECT_GE(rolled.rolls, 2U);
  EXPECT_GT(unrolled.miss_m, 5e-3);
}

}  // namespace
}  // namespace stylet::hal
