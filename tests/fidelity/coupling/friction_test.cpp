// SPDX-License-Identifier: Apache-2.0
// V22: friction of the shaft, measured on the hand. One shaft CP in one attached voxel has a closed
// form: its spring w in series with the eight corner springs k = G h, K_t = 8 k w / (8 k + w).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kEdgeM = 4e-3F, kUnitM = 5e-3F;
constexpr double kUnit = 5e-3;  // the same, for expected values
constexpr float kSpring = 50;
constexpr double kStiffness = 80.0 * 50 / (80 + 50);  // k = 2500 Pa * 4 mm = 10 N/m
constexpr double kTolerance = 0.01;

TinyMaterial rubbing(float coulomb, float fixed, float viscous) {
  TinyMaterial m;
  m.youngs_modulus_pa = 5000;
  m.poisson_ratio = 0;
  m.coulomb_friction_n_per_m = coulomb;
  m.static_friction_n_per_m = fixed;
  m.viscous_friction_n_s_per_m2 = viscous;
  m.stribeck_velocity_m_per_s = 1e-3F;
  return m;
}

Config short_needle() {
  Config config;
  config.needle[0].length_m = 0.05F;
  config.needle[0].unit_m = kUnitM;
  return config;
}

struct OneParticle {
  Rig rig;
  Vec3 tip_m;

  double force_at(double advance_m) {
    const Vec3 tip = {static_cast<float>(static_cast<double>(tip_m.x) + advance_m), tip_m.y,
                      tip_m.z};
    return -static_cast<double>(move_tip(rig, tip).force_n.x);
  }
};

OneParticle one_particle(const TinyMaterial& material, std::uint32_t substeps = Config{}.substeps) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = 1;
  tiny.voxel_edge_m = kEdgeM;
  tiny.materials = {material};
  Config config = short_needle();
  config.inertia = Inertia::kAddedMass;  // so that attached tissue keeps its velocity
  config.substeps = substeps;
  config.surround_drag_per_s = 0;
  OneParticle one = {make_rig(tiny, config, Tissue::kFixed), {}};
  one.tip_m = hold_one_shaft_particle(one.rig, {kEdgeM / 2, kEdgeM / 2, kEdgeM / 2}, kSpring);
  return one;
}

// Advances at a speed until the force is steady; returns that force.
double slide(OneParticle& one, double speed, double way_m, double* peak_out = nullptr) {
  const int ticks = static_cast<int>(way_m / (std::fabs(speed) * 1e-3));
  double force = 0, peak = 0;
  for (int i = 1; i <= ticks; ++i) {
    force = one.force_at(speed * 1e-3 * i);
    peak = std::max(peak, std::fabs(force));
  }
  if (peak_out != nullptr) *peak_out = peak;
  return force;
}

TEST(V22Friction, StickingSlopeIsTheSeriesStiffness) {
  for (const double direction : {1.0, -1.0}) {
    OneParticle one = one_particle(rubbing(10, 12, 0));
    std::vector<double> x, f;
    for (int i = 0; i <= 800; ++i) {  // to 0.41 of static friction
      x.push_back(direction * 1e-6 * i);
      f.push_back(one.force_at(x.back()));
    }
    EXPECT_NEAR(fit_line(x, f).slope / kStiffness, 1, kTolerance);
    EXPECT_NEAR(f.back() / (kStiffness * x.back()), 1, kTolerance);
  }
}

TEST(V22Friction, BreaksAwayAtStaticFriction) {
  for (const double direction : {1.0, -1.0}) {
    OneParticle one = one_particle(rubbing(10, 14, 0));
    double peak = 0;
    slide(one, direction * 1e-4, 4e-3, &peak);
    EXPECT_NEAR(peak / (14.0 * kUnit), 1, kTolerance);
  }
}

TEST(V22Friction, SlidesAtCoulombPlusViscousFriction) {
  for (const double speed : {5e-3, 10e-3, 50e-3, -5e-3, -10e-3, -50e-3}) {
    OneParticle one = one_particle(rubbing(10, 14, 20));
    const double expected = (10 + 20 * std::fabs(speed)) * kUnit;
    const double way = std::fabs(speed) > 0.02 ? 15e-3 : 8e-3;
    EXPECT_NEAR(slide(one, speed, way) / std::copysign(expected, speed), 1, kTolerance)
        << "at " << speed << " m/s";
  }
}

// Near the Stribeck velocity the static part has decayed by exp(-(v / v_s)^2). The viscous part is
// so large that friction grows with speed; otherwise sliding on a spring would be stick-slip, not
// steady.
TEST(V22Friction, StribeckPartDecaysWithTheSlipSpeed) {
  for (const double ratio : {0.25, 0.5, 1.0, 2.0}) {
    TinyMaterial material = rubbing(10, 14, 400);
    material.stribeck_velocity_m_per_s = 1e-2F;
    OneParticle one = one_particle(material);
    const double expected = (10 + 4 * std::exp(-ratio * ratio) + 4 * ratio) * kUnit;
    EXPECT_NEAR(slide(one, 1e-2 * ratio, 12e-3) / expected, 1, kTolerance) << "v / v_s " << ratio;
  }
}

TEST(V22Friction, HysteresisLoopHasTheAreaOfDrySliding) {
  OneParticle one = one_particle(rubbing(10, 10, 0));
  const double most = 10.0 * kUnit, presliding = most / kStiffness;
  const double amplitude = 4e-3;
  constexpr int kTicks = 20000;
  double area = 0, last_x = 0, last_f = 0;
  for (int i = 1; i <= 2 * kTicks; ++i) {
    const double x = amplitude * std::sin(2 * std::numbers::pi * i / kTicks);
    const double f = one.force_at(x);
    if (i > kTicks) area += 0.5 * (f + last_f) * (x - last_x);
    last_x = x;
    last_f = f;
  }
  EXPECT_NEAR(area / (4 * most * (amplitude - presliding)), 1, kTolerance);
}

TEST(V22Friction, DoesNotDriftUnderAForceBelowStaticFriction) {
  OneParticle one = one_particle(rubbing(10, 12, 0));
  const double amplitude = 0.9 * 12.0 * kUnit / kStiffness;
  const float arc_before = one.rig.view().state.shaft[0].arc_m;
  const double force_before = one.force_at(0);
  double largest = 0;
  for (int i = 1; i <= 60000; ++i) {  // 60 s at 1 Hz
    largest = std::max(largest,
                       std::fabs(one.force_at(amplitude * std::sin(2e-3 * std::numbers::pi * i))));
  }
  EXPECT_NEAR(largest / (0.9 * 12.0 * kUnit), 1, kTolerance);
  const double drift =
      static_cast<double>(one.rig.view().state.shaft[0].arc_m) - static_cast<double>(arc_before);
  EXPECT_LT(std::fabs(drift), 1e-9);
  // The position of the tissue relative to the needle, from the force: the handle's position as a
  // float has steps of 4e-9 m.
  EXPECT_LT(std::fabs(one.force_at(0) - force_before) / kStiffness, 1e-9);
}

// A needle in a block of 40 mm that resists it only by friction.
Rig friction_block() {
  TinyOrgan tiny;
  tiny.nx = 8;
  tiny.ny = tiny.nz = 3;
  tiny.materials = {rubbing(10, 14, 20)};
  tiny.materials[0].cutting_force_n = 0;
  tiny.materials[0].puncture_force_n = 0.01F;
  return make_rig(tiny, Config{}, Tissue::kFixed);
}
constexpr Vec3 kBeforeBlock = {-2e-3F, 7.5e-3F, 7.5e-3F};

TEST(V22Friction, NeedleInTheTissueIsHeldByItsDepth) {
  Rig rig = friction_block();
  const Output out = drive(rig, kBeforeBlock, 33e-3F, 10e-3F);
  const double expected = (10 + 20 * 10e-3) * static_cast<double>(out.depth_m);
  EXPECT_NEAR(static_cast<double>(out.depth_m), 33e-3, 1e-3);
  EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x) / expected, 1, kTolerance);
}

TEST(V22Friction, NeedleThroughTheOrganIsHeldByTheLengthInTissue) {
  Rig rig = friction_block();
  const Output out = drive(rig, kBeforeBlock, 70e-3F, 10e-3F);
  const double expected = (10 + 20 * 10e-3) * 8 * 5e-3;
  EXPECT_NEAR(-static_cast<double>(out.force_n.x) / expected, 1, kTolerance);
}

// The same rule when the needle rests and the tissue moves. Attached particles keep a velocity that
// they are given (no force and no drag acts on them): the organ is then carried past the needle.
TEST(V22Friction, TissueThatMovesOverARestingNeedleSlidesByTheSameRule) {
  for (const float speed : {10e-3F, -10e-3F}) {
    OneParticle one = one_particle(rubbing(10, 14, 20));
    View view = one.rig.view();
    std::fill_n(&view.state.vx[0], view.model.head->counts.particles, speed);
    double force = 0;
    for (int i = 0; i < 800; ++i) force = -one.force_at(0);
    const double expected = std::copysign((10 + 20 * 10e-3) * kUnit, static_cast<double>(speed));
    EXPECT_NEAR(force / expected, 1, kTolerance) << "tissue at " << speed << " m/s";
  }
}

// Another part of the needle may drag tissue within a tick farther than friction holds. The match
// that finds it there pulls with at most twice the friction of a unit, and the rest is lost in a
// slip; in the next ticks it pulls with the friction.
TEST(V22Friction, TissueDraggedPastARestingNeedleSlipsBeyondTwiceItsFriction) {
  constexpr double kFrictionN = 2 * kUnit;
  for (const double way : {0.2e-3, -0.4e-3, 1e-3, -1.5e-3}) {
    OneParticle one = one_particle(rubbing(2, 2, 0), 1);
    View view = one.rig.view();
    std::fill_n(&view.state.vx[0], view.model.head->counts.particles,
                static_cast<float>(way * 1e3));
    one.force_at(0);
    std::fill_n(&view.state.vx[0], view.model.head->counts.particles, 0.0F);
    const double stuck = kStiffness * way;
    const double expected = std::copysign(std::min(std::fabs(stuck), 2 * kFrictionN), way);
    EXPECT_NEAR(-one.force_at(0) / expected, 1, kTolerance) << way;
    const double slip = (stuck - expected) / static_cast<double>(kSpring);
    EXPECT_NEAR(energy(one.rig.kernel()).friction, slip * (stuck + expected) / 2,
                kTolerance * kFrictionN * std::fabs(way));
    double after = 0;
    for (int i = 0; i < 20; ++i) after = -one.force_at(0);
    EXPECT_NEAR(after / std::copysign(std::min(std::fabs(stuck), kFrictionN), way), 1, kTolerance);
  }
}

// The same for a tip at rest: it pulls with at most twice its cutting force, in whatever direction
// the tissue is dragged.
TEST(V22Friction, TissueDraggedAtARestingTipPullsWithTwiceItsCutAtMost) {
  constexpr double kCutN = 5e-3;
  for (const double way : {0.2e-3, -0.2e-3, 1e-3, -1e-3}) {
    TinyOrgan tiny;
    tiny.nx = tiny.ny = tiny.nz = 1;
    tiny.voxel_edge_m = kEdgeM;
    tiny.materials = {rubbing(0, 0, 0)};
    tiny.materials[0].cutting_force_n = static_cast<float>(kCutN);
    Config config = short_needle();
    config.inertia = Inertia::kAddedMass;
    config.substeps = 1;
    config.surround_drag_per_s = 0;
    Rig rig = make_rig(tiny, config, Tissue::kFixed);
    const Vec3 centre = {kEdgeM / 2, kEdgeM / 2, kEdgeM / 2};
    const Vec3 tip_m = hold_tip(rig, centre, kSpring);
    View view = rig.view();
    ASSERT_EQ(view.state.tip->support_count, 1U);
    const auto force = [&] { return static_cast<double>(move_tip(rig, tip_m).force_n.x); };
    std::fill_n(&view.state.vx[0], view.model.head->counts.particles,
                static_cast<float>(way * 1e3));
    force();
    std::fill_n(&view.state.vx[0], view.model.head->counts.particles, 0.0F);
    const double stuck = kStiffness * way;
    const double expected = std::copysign(std::min(std::fabs(stuck), 2 * kCutN), way);
    EXPECT_NEAR(force() / expected, 1, kTolerance) << way;
  }
}

// The force that drives a particle in each substep of a tick.
std::vector<Vec3> places_seen;
void (*step_below)(const Kernel&) = nullptr;
void note_place(const Kernel& kernel) {
  step_below(kernel);
  places_seen.push_back(view_of(kernel).scratch.place[0]);
}

TEST(V22Friction, HandsStepPullsEvenlyOverTheSubsteps) {
  OneParticle one = one_particle(rubbing(1000, 1000, 0), 4);  // holds
  one.force_at(0);
  step_below = one.rig.kernel().step;
  one.rig.kernel().step = note_place;
  places_seen.clear();
  one.force_at(0.4e-3);
  ASSERT_EQ(places_seen.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const double moved = static_cast<double>(places_seen[i].x) - static_cast<double>(kEdgeM) / 2;
    EXPECT_NEAR(moved, 0.1e-3 * static_cast<double>(i + 1), 1e-8);
  }
}

// Voxels may be larger than the radius over which a needle's field dies out. Even then the springs
// of its particles are finite and positive, and its friction is that of the material.
TEST(V22Friction, VoxelsLargerThanTheFarFieldHoldTheNeedle) {
  TinyOrgan tiny;
  tiny.nx = 3;
  tiny.ny = tiny.nz = 1;
  tiny.voxel_edge_m = 0.1F;
  tiny.materials = {rubbing(10, 10, 0)};
  tiny.materials[0].puncture_force_n = 0.1F;
  Rig rig = make_rig(tiny, Config{}, Tissue::kFixed);
  // Stiffness of a unit of a cylinder in an annulus of 25 mm. With the lattice's compliance in
  // series, the particle's spring must be stiffer than that.
  const double n = 3, b = 25e-3, a = 0.635e-3, b2 = b * b, a2 = a * a;
  const double cylinder = 2500 * static_cast<double>(rig.view().model.needle_config().unit_m) * 8 *
                          std::numbers::pi * n / (n * n * std::log(b / a) - (b2 - a2) / (b2 + a2));
  const Output out = drive(rig, {-1e-3F, 49e-3F, 51e-3F}, 0.1F, 0.1F);
  View view = rig.view();
  ASSERT_GT(view.state.needle->shaft_count, 10U);
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    const Particle& p = view.state.shaft[i];
    EXPECT_GT(static_cast<double>(p.full_stiffness_n_per_m), cylinder) << i;
    EXPECT_TRUE(p.axial_fraction >= 0 && p.axial_fraction < 1) << i << ": " << p.axial_fraction;
  }
  EXPECT_NEAR(
      -static_cast<double>(out.cause.friction_n.x) / (10 * static_cast<double>(out.depth_m)), 1,
      0.01);
}

}  // namespace
}  // namespace stylet::test
