// SPDX-License-Identifier: Apache-2.0
// V23: the six phases of a needle's force curve (PHYSICS 17.7), on a liver-like block with a stiff
// layer one voxel thick. The needle is moved by position: 10 mm/s in, 3 s of rest, 10 mm/s out.
// Bands are those given there; the bounds on the slope and ripple of the insertion are tighter.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kSpeed = 10e-3;
constexpr float kStartM = -2e-3F, kDeepestM = 60e-3F;

TinyMaterial liver(float youngs_modulus_pa) {
  TinyMaterial m;
  m.density_kg_per_m3 = 1060;
  m.youngs_modulus_pa = youngs_modulus_pa;
  m.poisson_ratio = 0.45F;
  m.puncture_force_n = 0.7F;
  m.cutting_force_n = 0.3F;
  m.relaxing_fraction = 0.5F;
  m.relaxation_time_s = 1;
  m.coulomb_friction_n_per_m = 10;
  m.static_friction_n_per_m = 12;
  m.viscous_friction_n_s_per_m2 = 20;
  return m;
}

struct Curve {
  std::vector<Output> out;       // one a tick
  std::vector<double> force, x;  // axial, against insertion; tip
  std::size_t hold_begin, hold_end, contact, puncture, through, exit;  // through all layers
};

std::vector<std::size_t> ticks_of(const Kernel& kernel, EventKind kind) {
  Event list[kMaxEvents];
  const std::uint32_t count = events(kernel, list);
  std::vector<std::size_t> ticks;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (list[i].kind == kind) ticks.push_back(list[i].tick - 1);
  }
  if (ticks.empty()) ticks.push_back(0);
  return ticks;
}

Curve run_curve() {
  TinyOrgan tiny;
  tiny.nx = 16;
  tiny.ny = tiny.nz = 11;
  tiny.materials = {liver(23200), liver(223200)};
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x == 0 ? 1 : 0);
  };
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  Rig rig = make_rig(tiny, Config{});
  Curve curve = {};
  const Vec3 start = {kStartM, 26e-3F, 28.5e-3F};
  const Vec3 deepest = {kDeepestM, start.y, start.z};
  const auto keep = [&curve](const Output& out) {
    curve.out.push_back(out);
    curve.force.push_back(-static_cast<double>(out.force_n.x));
    curve.x.push_back(static_cast<double>(out.tip_m.x));
  };
  drive(rig, start, kDeepestM, static_cast<float>(kSpeed), keep);
  curve.hold_begin = curve.out.size();
  for (int i = 0; i < 3000; ++i) keep(move_tip(rig, deepest));
  curve.hold_end = curve.out.size();
  drive(rig, deepest, -20e-3F, static_cast<float>(kSpeed), keep);
  for (int i = 0; i < 500; ++i) keep(move_tip(rig, {-20e-3F, start.y, start.z}));
  curve.contact = ticks_of(rig.kernel(), EventKind::kContact).front();
  curve.puncture = ticks_of(rig.kernel(), EventKind::kPuncture).front();
  curve.through = ticks_of(rig.kernel(), EventKind::kPuncture).back();
  curve.exit = ticks_of(rig.kernel(), EventKind::kExit).front();
  return curve;
}

class V23PhaseCurve : public testing::Test {
 protected:
  static void SetUpTestSuite() { curve_ = new Curve(run_curve()); }
  static void TearDownTestSuite() {
    delete curve_;
    curve_ = nullptr;
  }
  void SetUp() override {
    ASSERT_GT(curve_->contact, 0U);
    ASSERT_GT(curve_->puncture, curve_->contact);
    ASSERT_LT(curve_->puncture, curve_->hold_begin);
    ASSERT_GT(curve_->exit, curve_->hold_end);
  }
  static Curve* curve_;
};
Curve* V23PhaseCurve::curve_ = nullptr;

TEST_F(V23PhaseCurve, RisesMonotonicallyToThePunctureForce) {
  const Curve& c = *curve_;
  EXPECT_EQ(c.force[c.contact - 1], 0);
  for (std::size_t i = c.contact; i + 1 < c.puncture; ++i) {
    ASSERT_GT(c.force[i + 1], c.force[i] - 1e-4) << "at tick " << i;
  }
  const double peak = c.force[c.puncture - 1];
  const double indentation = c.x[c.puncture - 1] - c.x[c.contact];
  EXPECT_NEAR(peak, 0.7, 0.02);
  EXPECT_GE(indentation, 4e-3);
  EXPECT_LE(indentation, 12e-3);
  const double slope = peak / indentation;
  EXPECT_GE(slope, 50);
  EXPECT_LE(slope, 200);
}

// Convex or linear: in no quarter of the way is the slope lower than in the quarter before by more
// than a tenth of the mean.
TEST_F(V23PhaseCurve, RiseIsConvexOrLinear) {
  const Curve& c = *curve_;
  const std::size_t quarter = (c.puncture - 1 - c.contact) / 4;
  double last = 0;
  const double mean = c.force[c.puncture - 1] / (c.x[c.puncture - 1] - c.x[c.contact]);
  for (std::size_t q = 0; q < 4; ++q) {
    const std::size_t from = c.contact + q * quarter, to = from + quarter;
    const double slope = (c.force[to] - c.force[from]) / (c.x[to] - c.x[from]);
    EXPECT_GE(slope, last - 0.1 * mean) << "quarter " << q;
    last = slope;
  }
}

TEST_F(V23PhaseCurve, DropsAtThePuncture) {
  const Curve& c = *curve_;
  const auto from = c.force.begin() + static_cast<std::ptrdiff_t>(c.puncture);
  const double lowest = *std::min_element(from, from + 50);
  EXPECT_LE(lowest, 0.7 * c.force[c.puncture - 1]);
  EXPECT_GT(lowest, 0);
}

TEST_F(V23PhaseCurve, InsertionGrowsWithDepthByTheFrictionWritten) {
  const Curve& c = *curve_;
  std::vector<double> depth, force;
  // The tissue's recoil from the last puncture counts as part of the phase before, which therefore
  // gets 0.2 s more.
  for (std::size_t i = c.through + 200; i < c.hold_begin; ++i) {
    if (c.out[i].depth_m < 10e-3F) continue;
    depth.push_back(static_cast<double>(c.out[i].depth_m));
    force.push_back(c.force[i]);
  }
  const Line line = fit_line(depth, force);
  EXPECT_GE(line.slope, 5);
  EXPECT_LE(line.slope, 50);
  EXPECT_NEAR(line.slope / (10 + 20 * kSpeed), 1, 0.02);
  double square = 0, mean = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double off = force[i] - (line.offset + line.slope * depth[i]);
    square += off * off / static_cast<double>(depth.size());
    mean += force[i] / static_cast<double>(depth.size());
  }
  EXPECT_LT(std::sqrt(square) / mean, 0.02);
}

TEST_F(V23PhaseCurve, RelaxesOnHoldToAPlateau) {
  const Curve& c = *curve_;
  const double begin = c.force[c.hold_begin - 1], end = c.force[c.hold_end - 1];
  EXPECT_GE(1 - end / begin, 0.2);
  EXPECT_LE(1 - end / begin, 0.6);
  EXPECT_GT(end, 0.05);
  // Time constant: the time until 1 - 1/e of the observed decay has passed.
  std::size_t at = c.hold_begin;
  while (c.force[at] > end + (begin - end) * std::exp(-1.0)) ++at;
  const double time_s = 1e-3 * static_cast<double>(at - c.hold_begin);
  EXPECT_GE(time_s, 0.3);
  EXPECT_LE(time_s, 3);
  // No oscillation: after a fall the force never rises by more than this.
  double lowest = begin, rise = 0;
  for (std::size_t i = c.hold_begin; i < c.hold_end; ++i) {
    lowest = std::min(lowest, c.force[i]);
    rise = std::max(rise, c.force[i] - lowest);
  }
  EXPECT_LT(rise, 0.02);
}

TEST_F(V23PhaseCurve, RetractionReversesTheSignWithinPresliding) {
  const Curve& c = *curve_;
  std::size_t at = c.hold_end;
  while (at < c.exit && c.force[at] > 0) ++at;
  // Bristle mode: the distance that the stuck needle must go back to unload, (f at hold + friction)
  // / K, with K = 2 pi G / ln(b / a) per metre of shaft that sticks; G = 8 kPa, b = 25 mm.
  const double stiffness = 2 * 3.14159 * 8000 / std::log(25 / 0.635) * 60e-3;
  EXPECT_LT(c.x[c.hold_end - 1] - c.x[at], c.force[c.hold_begin - 1] / stiffness);
}

TEST_F(V23PhaseCurve, RetractionFallsLinearlyWithDepthAndIsWeakerThanInsertion) {
  const Curve& c = *curve_;
  std::vector<double> depth, force;
  const double friction_in = -static_cast<double>(c.out[c.hold_begin - 1].cause.friction_n.x);
  for (std::size_t i = c.hold_end; i < c.exit; ++i) {
    ASSERT_GE(c.force[i], -friction_in * 1.2) << "static friction over sliding friction";
    const double d = static_cast<double>(c.out[i].depth_m);
    if (d < 5e-3 || d > 45e-3) continue;
    depth.push_back(d);
    force.push_back(-c.force[i]);
  }
  const Line line = fit_line(depth, force);
  EXPECT_NEAR(line.slope / (10 + 20 * kSpeed), 1, 0.05);
  const double largest = *std::max_element(force.begin(), force.end());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    ASSERT_NEAR(force[i], line.offset + line.slope * depth[i], 0.1 * largest)
        << "at depth " << depth[i];
  }
}

TEST_F(V23PhaseCurve, NothingIsLeftAfterTheExit) {
  const Curve& c = *curve_;
  for (std::size_t i = c.exit + 50; i < c.force.size(); ++i) {
    ASSERT_LT(norm_of(c.out[i].force_n), 0.01) << "tick " << i;
  }
  EXPECT_EQ(norm_of(c.out.back().force_n), 0);
}

}  // namespace
}  // namespace stylet::test
