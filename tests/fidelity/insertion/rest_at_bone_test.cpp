// SPDX-License-Identifier: Apache-2.0
// Contact with bone is part of the needle's equilibrium: whatever the geometry, a needle that rests
// at bone rests, bends and buckles as beam theory says, and gives the hand no energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "draw.h"
#include "needle/obstacle.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kY = 17e-3F, kZ = 18e-3F;  // of the handle and of a straight needle
constexpr double kPi = 3.14159265358979323846;

struct Gauge {
  double radius_m, bending_nm2;
};
constexpr Gauge k18G = {0.635e-3, 20.7e-3}, k22G = {0.359e-3, 2.318e-3};

NeedleConfig needle_of(const Gauge& gauge) {
  NeedleConfig needle;
  needle.outer_radius_m = static_cast<float>(gauge.radius_m);
  needle.bending_nm2 = static_cast<float>(gauge.bending_nm2);
  needle.rods = 40;
  return needle;
}

// Clamped at the handle, its tip held in place: PHYSICS 6.2.
double euler_load_n(const Gauge& gauge) {
  const double length = static_cast<double>(NeedleConfig{}.length_m);
  return 20.19 * gauge.bending_nm2 / (length * length);
}

Rig rig_of(const TinyOrgan& tiny, const Gauge& gauge, const ObstacleConfig& body) {
  Config config;
  config.needle[0] = needle_of(gauge);
  Rig rig = make_rig(tiny, config);
  if (set_obstacles(rig.kernel(), {&body, 1}) != Status::kOk) std::abort();
  return rig;
}

// The tissue is far away: only bone is felt.
Rig in_air(const Gauge& gauge, const ObstacleConfig& body) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = 2;
  tiny.origin_m = {0.3F, 0, 0};
  return rig_of(tiny, gauge, body);
}

ObstacleConfig hard(ObstacleConfig body, double stiffness_n_per_m, double friction) {
  body.stiffness_n_per_m = static_cast<float>(stiffness_n_per_m);
  body.largest_force_n = 50;
  body.friction = static_cast<float>(friction);
  return body;
}

constexpr double kBallX = 30e-3;

// A ball with its centre `off_m` beside the needle's axis, on the side given by `way_rad`.
ObstacleConfig ball(double radius_m, double off_m, double way_rad) {
  ObstacleConfig body;
  make_sphere(body, static_cast<float>(radius_m));
  body.pose.position_m = {static_cast<float>(kBallX),
                          kY + static_cast<float>(off_m * std::cos(way_rad)),
                          kZ + static_cast<float>(off_m * std::sin(way_rad))};
  return body;
}

// A box whose face has its middle at `face_m`. The face is tilted by `tilt_rad` from square to the
// needle.
ObstacleConfig tilted_box(Vec3 face_m, double tilt_rad, double roll_rad) {
  ObstacleConfig body;
  make_box(body, {10e-3F, 30e-3F, 30e-3F});
  const double sine = std::sin(tilt_rad / 2);
  const Quat turn = {static_cast<float>(std::cos(tilt_rad / 2)), 0,
                     static_cast<float>(sine * std::sin(roll_rad)),
                     static_cast<float>(sine * std::cos(roll_rad))};
  body.pose.rotation = turn;
  body.pose.position_m = face_m + rotation_matrix(turn) * Vec3{10e-3F, 0, 0};
  return body;
}

// What a hand felt on its way and while it rested.
struct Felt {
  double most_n = 0, least_work_j = 0;
  double slack_j = 0;  // a sum of means over ticks may differ so far from the work
  double swing_n = 0;  // at rest
  Vec3 rest_n{};
};

class Hand {
 public:
  explicit Hand(Rig& rig) : rig_(rig) {}

  void move(Vec3 tip_m) {
    const Output out = move_tip(rig_, tip_m);
    felt.most_n = std::max(felt.most_n, norm_of(out.force_n));
    if (known_) felt.slack_j += 0.5 * norm_of(out.force_n - felt.rest_n) * norm_of(tip_m - tip_m_);
    felt.least_work_j = std::min(felt.least_work_j, rig_.view().state.head->work_by_hand_j);
    felt.rest_n = out.force_n;
    tip_m_ = tip_m;
    known_ = true;
  }
  void rest(Vec3 tip_m, int ticks) {
    Vec3 low{}, high{};
    for (int i = 0; i < ticks; ++i) {
      move(tip_m);
      const Vec3 f = felt.rest_n;
      low = i == 0 ? f : Vec3{std::min(low.x, f.x), std::min(low.y, f.y), std::min(low.z, f.z)};
      high = i == 0 ? f : Vec3{std::max(high.x, f.x), std::max(high.y, f.y), std::max(high.z, f.z)};
    }
    felt.swing_n = norm_of(high - low);
  }

  Felt felt;

 private:
  Rig& rig_;
  Vec3 tip_m_{};
  bool known_ = false;
};

// Goes forward along x, comes to rest for 100 ms, rests for 100 ms, and goes back.
Felt press_and_rest(Rig& rig, double from_m, double to_m, double speed_m_per_s) {
  Hand hand(rig);
  const double step = speed_m_per_s * 1e-3;
  const int ticks = static_cast<int>((to_m - from_m) / step);
  const auto at = [&](int i) { return Vec3{static_cast<float>(from_m + step * i), kY, kZ}; };
  for (int i = 0; i <= ticks; ++i) hand.move(at(i));
  for (int i = 0; i < 100; ++i) hand.move(at(ticks));
  hand.rest(at(ticks), 100);
  for (int i = ticks; i >= 0; --i) hand.move(at(i));
  return hand.felt;
}

// No load is more than 1.2 times that at which a resting needle buckles, apart from what builds up
// on the way of one tick, before the needle can give way.
void expect_rest(const Felt& felt, const Gauge& gauge, const ObstacleConfig& body,
                 double speed_m_per_s, const std::string& which) {
  const double in_a_tick_n = static_cast<double>(body.stiffness_n_per_m) * speed_m_per_s * 1e-3;
  EXPECT_LT(felt.swing_n, 1e-3) << which;
  EXPECT_LT(felt.most_n, 1.2 * euler_load_n(gauge) + in_a_tick_n) << which;
  EXPECT_GE(felt.least_work_j, -felt.slack_j) << which;
}

TEST(RestAtBone, OnBallsOfAnyPlace) {
  DoubleDraw draw(29);
  for (int i = 0; i < 16; ++i) {
    const Gauge& gauge = draw.between(0, 1) < 0.5 ? k22G : k18G;
    const double radius = draw.magnitude(1e-3, 10e-3), off = draw.between(0, 1.1 * radius);
    const double inside = radius * radius - off * off;
    const double face = kBallX - (inside > 0 ? std::sqrt(inside) : 0);
    const ObstacleConfig body = hard(ball(radius, off, draw.between(0, 2 * kPi)),
                                     draw.magnitude(5e3, 1e6), draw.between(0, 1));
    Rig rig = in_air(gauge, body);
    const double speed = draw.magnitude(10e-3, 40e-3), deep = draw.between(0.05e-3, 10e-3);
    expect_rest(press_and_rest(rig, kBallX - radius - 1e-3, face + deep, speed), gauge, body, speed,
                "ball " + std::to_string(i));
  }
}

TEST(RestAtBone, OnFacesOfAnyTilt) {
  DoubleDraw draw(31);
  for (int i = 0; i < 16; ++i) {
    const Gauge& gauge = draw.between(0, 1) < 0.5 ? k22G : k18G;
    const double tilt = draw.between(-0.7, 0.7), roll = draw.between(0, kPi);
    const double stiffness = draw.magnitude(5e3, 1e6), friction = draw.between(0, 1);
    const ObstacleConfig body = hard(tilted_box({20e-3F, kY, kZ}, tilt, roll), stiffness, friction);
    Rig rig = in_air(gauge, body);
    const double speed = draw.magnitude(10e-3, 40e-3), deep = draw.between(0.05e-3, 10e-3);
    expect_rest(press_and_rest(rig, 18e-3, 20e-3 + deep, speed), gauge, body, speed,
                "box " + std::to_string(i));
  }
}

// The tip slides off a smooth ball and the shaft leans on the ball's side: a cantilever that is
// pushed aside by `aside` at the arc length `arc` of the contact, F = 3 EI aside / arc^3.
TEST(RestAtBone, AShaftLeansOnABallAsABeam) {
  DoubleDraw draw(37);
  for (int i = 0; i < 8; ++i) {
    const Gauge& gauge = i % 2 == 0 ? k22G : k18G;
    const double radius = draw.between(2e-3, 8e-3), aside = draw.between(0.2e-3, 1.5e-3);
    const double beyond = draw.between(10e-3, 40e-3), way = draw.between(0, 2 * kPi);
    const ObstacleConfig body = hard(ball(radius, radius + gauge.radius_m - aside, way), 100e3, 0);
    Rig rig = in_air(gauge, body);
    const Felt felt = press_and_rest(rig, kBallX - radius - 1e-3, kBallX + beyond, 40e-3);
    const double length = static_cast<double>(NeedleConfig{}.length_m), arc = length - beyond;
    const double expected = 3 * gauge.bending_nm2 * aside / (arc * arc * arc);
    EXPECT_NEAR(norm_of(felt.rest_n), 0, 1e-6) << "back in the air";
    Hand hand(rig);
    for (double x = kBallX - radius - 1e-3; x < kBallX + beyond; x += 40e-6) {
      hand.move({static_cast<float>(x), kY, kZ});
    }
    hand.rest({static_cast<float>(kBallX + beyond), kY, kZ}, 100);
    EXPECT_NEAR(norm_of(hand.felt.rest_n), expected, 0.02 * expected) << i;
  }
}

// The tip sticks and is pressed just beyond buckling, at any stiffness of the bone.
TEST(RestAtBone, ATipThatSticksBucklesTheNeedleAtEulersLoad) {
  for (const double stiffness : {20e3, 200e3, 1e6}) {
    for (const Gauge& gauge : {k18G, k22G}) {
      Rig rig = in_air(gauge, hard(ball(4e-3, 0.4e-3, 0.3), stiffness, 0.5));
      Hand hand(rig);
      const double face = kBallX - 4e-3 - gauge.radius_m;
      const double to = face + euler_load_n(gauge) / stiffness + 0.1e-3;
      for (double x = face - 1e-3; x < to; x += 20e-6) {
        hand.move({static_cast<float>(x), kY, kZ});
      }
      hand.rest({static_cast<float>(to), kY, kZ}, 100);
      EXPECT_NEAR(norm_of(hand.felt.rest_n), euler_load_n(gauge), 0.02 * euler_load_n(gauge));
      EXPECT_LT(hand.felt.most_n, 1.2 * euler_load_n(gauge) + stiffness * 20e-6);
    }
  }
}

// On hard bone one tick's way, times the stiffness, is several times the load at which the needle
// buckles. The largest force felt is compared with what a hand of 5 um a tick feels. Not all ratios
// are below the bar of 1.2 (PHYSICS 18.6); the test bounds how many are above it.
TEST(RestAtBone, PressedFastOnHardBoneTheLoadIsThatOfASlowHand) {
  constexpr int kDraws = 48;
  DoubleDraw draw(5);
  int above = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Gauge& gauge = i % 2 == 0 ? k18G : k22G;
    const double radius = draw.magnitude(2e-3, 8e-3), off = draw.between(0, 0.6) * radius;
    const double stiffness = draw.magnitude(20e3, 1e6), friction = draw.between(0, 1);
    const ObstacleConfig body = hard(ball(radius, off, draw.between(0, 6.28)), stiffness, friction);
    const double reach = radius + gauge.radius_m;
    const double face = kBallX - std::sqrt(reach * reach - off * off);
    const double speed = draw.magnitude(2e-3, 50e-3);
    double most[2] = {};
    for (const bool slow : {false, true}) {
      Rig rig = in_air(gauge, body);
      Hand hand(rig);
      const double step = slow ? std::min(speed * 1e-3, 5e-6) : speed * 1e-3;
      const double to = face + euler_load_n(gauge) / stiffness + 1e-3;
      for (double x = face - 0.3e-3; x < to; x += step) {
        hand.move({static_cast<float>(x), kY, kZ});
      }
      most[slow ? 1 : 0] = hand.felt.most_n;
    }
    if (most[0] > 1.2 * std::max(most[1], 0.01 * euler_load_n(gauge))) ++above;
  }
  EXPECT_LE(above, kDraws / 16);
}

// To and fro across a ball at 12 mm/s, with the tip 1 mm in front of its middle.
TEST(RestAtBone, ToAndFroAcrossABallGivesNothing) {
  for (const double friction : {0.0, 0.3, 0.8}) {
    for (const double off : {0.0, 0.4e-3, 2e-3}) {
      Rig rig = in_air(k22G, hard(ball(4e-3, 0, 0), 20e3, friction));
      Hand hand(rig);
      constexpr int kTicks = 1333;  // 16 mm
      for (int i = 0; i < 4 * kTicks; ++i) {
        const int back = i % (2 * kTicks);
        const int at = back < kTicks ? back : 2 * kTicks - back;
        hand.move(
            {27e-3F, kY + static_cast<float>(-8e-3 + 12e-6 * at), kZ + static_cast<float>(off)});
      }
      const std::string which = "friction " + std::to_string(friction);
      EXPECT_LT(hand.felt.most_n, euler_load_n(k22G)) << which;
      EXPECT_GE(hand.felt.least_work_j, -hand.felt.slack_j) << which;
    }
  }
}

// In tissue, on a turned box: the tissue's forces are part of the same equilibrium. The tissue
// needs a second and a half to come to rest.
TEST(RestAtBone, InTissueOnATurnedBox) {
  DoubleDraw draw(41);
  for (int i = 0; i < 6; ++i) {
    TinyOrgan tiny;
    tiny.nx = 12;
    tiny.fixed_faces = kLowZ;
    tiny.materials[0].youngs_modulus_pa = 23000;
    tiny.materials[0].puncture_force_n = 0.2F;
    const float h = tiny.voxel_edge_m, y = h * 4.1F, z = h * 3.9F, face = h * 8;
    const double tilt = draw.between(10, 30) * kPi / 180, friction = draw.between(0.1, 0.6);
    const ObstacleConfig box =
        hard(tilted_box({face, y, z}, tilt, draw.between(0, kPi)), 20e3, friction);
    Rig rig = rig_of(tiny, i % 2 == 0 ? k18G : k22G, box);
    Hand hand(rig);
    float x = -2e-3F;
    for (; x < face + 0.6e-3F; x += 20e-6F) hand.move({x, y, z});
    ASSERT_GT(rig.view().state.needle->shaft_count, 0U) << "in the tissue";
    ASSERT_GT(rig.view().state.needle->touch_count, 0U) << "at bone";
    for (int tick = 0; tick < 1500; ++tick) hand.move({x, y, z});
    hand.rest({x, y, z}, 50);
    EXPECT_LT(hand.felt.swing_n, 1e-3) << i;
  }
}

}  // namespace
}  // namespace stylet::test
