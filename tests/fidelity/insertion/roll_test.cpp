// SPDX-License-Identifier: Apache-2.0
// The roll of the tip lags behind that of the hand as in a torsion bar that is held by friction.
// With f the friction per length, r the radius, d the depth and L the needle's length, the tip lags
// by
// f r (d (L - d) + d^2 / 2) / GJ
// when the shaft slips all along, and the hand then feels the torque f r d.
#include "coupling/roll.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/friction.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kDepthM = 40e-3F, kTorsionNm2 = 1e-4F, kFrictionNPerM = 30;
constexpr double kRadPerTick = 1e-3;

TinyOrgan gel() {
  TinyOrgan tiny;
  tiny.nx = 12;
  tiny.ny = tiny.nz = 6;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial& m = tiny.materials[0];
  m.youngs_modulus_pa = 20000;
  m.puncture_force_n = 0.2F;
  m.cutting_force_n = 0.1F;
  m.coulomb_friction_n_per_m = kFrictionNPerM;
  m.static_friction_n_per_m = kFrictionNPerM;
  m.viscous_friction_n_s_per_m2 = 0;
  m.relaxing_fraction = 0;
  return tiny;
}

// A needle that is in the tissue and rests without axial force, and can be rolled.
class Rolled : public testing::Test {
 protected:
  Rolled() : rig_(make_rig(gel(), config())) {
    const Vec3 start = {-1e-3F, 17e-3F, 16e-3F};
    drive(rig_, start, kDepthM + 4e-3F, 20e-3F);
    tip_m_ = {kDepthM + 4e-3F, start.y, start.z};
    // Draws it back until the shaft's springs no longer pull along it.
    for (int i = 0; i < 20000 && out_.force_n.x <= 0; ++i) {
      tip_m_.x -= 1e-6F;
      out_ = hold(rig_, tip_m_, 1);
    }
    out_ = hold(rig_, tip_m_, 200);
  }
  static Config config() {
    Config c;
    c.needle[0].torsion_nm2 = kTorsionNm2;
    c.needle[0].bevel_per_m = 5;
    return c;
  }

  void roll(double by_rad) {
    const int ticks = static_cast<int>(std::fabs(by_rad) / kRadPerTick);
    for (int i = 0; i < ticks; ++i) {
      hand_rad_ += by_rad / ticks;
      Input input = along_x(tip_m_, rig_.length_m);
      const Quat q = input.handle.rotation;
      const auto c = static_cast<float>(std::cos(hand_rad_ / 2));
      const auto s = static_cast<float>(std::sin(hand_rad_ / 2));
      input.handle.rotation = {q.w * c - q.z * s, q.x * c + q.y * s, q.y * c - q.x * s,
                               q.w * s + q.z * c};
      const double last_nm = torque_nm();
      out_ = checked_tick(rig_, input);
      work_j_ -= 0.5 * (last_nm + torque_nm()) * by_rad / ticks;
    }
  }
  // Torque on the hand, about the handle's z, which is -x here.
  double torque_nm() const { return -static_cast<double>(roll_torque_nm(rig_.view().state).x); }
  double lag_rad() const { return static_cast<double>(rig_.view().state.needle->twist_rad); }

  // The shaft as its particles represent it: f r, and sums over the stretches of the particles.
  double slipping_nm() const {
    return sum([](double, double hold) { return hold; });
  }
  double slipping_rad() const {
    return sum([this](double arc, double hold) {
             return hold * (static_cast<double>(rig_.length_m) - arc);
           }) /
           static_cast<double>(kTorsionNm2);
  }
  template <typename Of>
  double sum(Of of) const {
    View view = rig_.view();
    double total = 0;
    for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
      const Particle& p = view.state.shaft[i];
      const double limit = static_cast<double>(friction_limit_n(view.model, view.state, p));
      const double axial = static_cast<double>(p.force_n.x);
      const double left = std::sqrt(std::fmax(limit * limit - axial * axial, 0));
      total += of(static_cast<double>(p.arc_m),
                  left * static_cast<double>(view.model.needle_config().outer_radius_m));
    }
    return total;
  }

  Rig rig_;
  Vec3 tip_m_ = {};
  Output out_ = {};
  double hand_rad_ = 0, work_j_ = 0;
};

TEST_F(Rolled, LagsByTheTorsionBarsClosedForm) {
  roll(2.0);
  const double r = 0.635e-3, l = static_cast<double>(rig_.length_m);
  const double d = static_cast<double>(rig_.view().state.needle->tissue_track_m);
  const double f = static_cast<double>(kFrictionNPerM);
  const double whole_rad = f * r * (d * (l - d) + d * d / 2) / static_cast<double>(kTorsionNm2);
  EXPECT_GT(lag_rad(), 0.5);
  EXPECT_NEAR(lag_rad() / slipping_rad(), 1, 1e-3) << "what the axial forces leave of friction";
  EXPECT_NEAR(torque_nm() / -slipping_nm(), 1, 1e-3) << "against the roll";
  // At rest the shaft still carries a part of its friction along its axis.
  EXPECT_LT(lag_rad(), 1.02 * whole_rad);
  EXPECT_GT(lag_rad(), 0.6 * whole_rad);
}

TEST_F(Rolled, TurnsBackOnlyAfterTwiceTheLag) {
  roll(2.0);
  const double lag = lag_rad();
  const Vec3 faced =
      rolled_side(rig_.view().state, rotation_matrix(rig_.view().state.needle->handle.rotation));
  roll(-1.9 * lag);
  const Vec3 still =
      rolled_side(rig_.view().state, rotation_matrix(rig_.view().state.needle->handle.rotation));
  EXPECT_NEAR(static_cast<double>(dot(faced, still)), 1, 1e-4) << "the bevel has not turned";
  roll(-0.5 * lag);
  EXPECT_NEAR(lag_rad(), -lag, 0.01 * lag);
}

// A closed loop of rolling takes its area from the hand as work, and all of this work is in the
// energy books.
TEST_F(Rolled, LoopTakesItsAreaFromTheHand) {
  roll(2.0);
  const Energy before = energy(rig_.kernel());
  work_j_ = 0;
  roll(-3.0);
  roll(3.0);
  const double area = 2 * std::fabs(torque_nm()) * (3.0 - 2 * lag_rad());
  EXPECT_NEAR(work_j_ / area, 1, 0.01);
  const Energy after = energy(rig_.kernel());
  EXPECT_NEAR((after.friction - before.friction) / area, 1, 0.01);
}

// When the needle moves on, friction points along the shaft, and the tip follows the hand's roll.
TEST_F(Rolled, UnwindsAsTheNeedleMovesOn) {
  roll(2.0);
  const double lag = lag_rad();
  for (int i = 0; i < 1500; ++i) {
    tip_m_.x += 5e-6F;
    roll(kRadPerTick);
  }
  EXPECT_LT(lag_rad(), 0.25 * lag);
}

TEST_F(Rolled, TipFacesTheHandlesSideTurnedBackByTheLag) {
  const Mat3 handle = rotation_matrix(rig_.view().state.needle->handle.rotation);
  for (float lag = -kMaxTwistRad; lag <= kMaxTwistRad; lag += 0.1F) {
    rig_.view().state.needle->twist_rad = lag;
    const Vec3 faced = std::cos(lag) * column(handle, 0) - std::sin(lag) * column(handle, 1);
    EXPECT_LT(norm_of(rolled_side(rig_.view().state, handle) - faced), 1e-6) << "lag " << lag;
  }
}

TEST(Roll, IsTheHandsWithoutTorsion) {
  Rig rig = make_rig(gel(), Config{});
  drive(rig, {-1e-3F, 17e-3F, 16e-3F}, kDepthM, 20e-3F);
  EXPECT_EQ(rig.view().state.needle->twist_rad, 0);
  EXPECT_EQ(norm_of(roll_torque_nm(rig.view().state)), 0);
}

}  // namespace
}  // namespace stylet::test
