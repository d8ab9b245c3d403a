// SPDX-License-Identifier: Apache-2.0
// V28: a CP is displaced in one step and held; its force decays as the material says, F(t) = F_0 (1
// - phi + phi exp(-t / tau)), however soft the voxels are that lie in series with it: with attached
// corners, a CP of spring s is in series with corner springs of 8 k.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kTolerance = 0.02;
constexpr float kFraction = 0.4F, kTimeS = 0.8F;
constexpr float kEdgeM = 4e-3F;  // less than the needle unit: one CP only

TinyMaterial relaxing() {
  TinyMaterial m;
  m.youngs_modulus_pa = 20000;
  m.poisson_ratio = 0.45F;
  m.puncture_force_n = 1000;
  m.relaxing_fraction = kFraction;
  m.relaxation_time_s = kTimeS;
  return m;
}

struct Decay {
  double fraction, time_s, worst;  // worst deviation from the exponential, over the first force
};

// Fits F = F_inf + (F_0 - F_inf) exp(-t / T) to the beginning and the end of the force.
Decay decay_of(const std::vector<double>& force, double period_s) {
  const double first = force.front(), last = force.back();
  Decay decay = {1 - last / first, 0, 0};
  std::vector<double> time, logarithm;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double left = (force[i] - last) / (first - last);
    if (left < 0.1) break;
    time.push_back(period_s * static_cast<double>(i));
    logarithm.push_back(std::log(left));
  }
  decay.time_s = -1 / fit_line(time, logarithm).slope;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double model =
        last + (first - last) * std::exp(-period_s * static_cast<double>(i) / decay.time_s);
    decay.worst = std::max(decay.worst, std::fabs(force[i] - model) / first);
  }
  return decay;
}

std::vector<double> forces_held(Rig& rig, Vec3 tip_m, int ticks) {
  std::vector<double> force;
  for (int i = 0; i < ticks; ++i) {
    force.push_back(-static_cast<double>(move_tip(rig, tip_m).force_n.x));
  }
  return force;
}

// Contact at the surface, pressed in within a few ticks and held.
std::vector<double> press_and_hold(Rig& rig, int ticks) {
  const Vec3 centre = {-1e-3F, 0.5F * kEdgeM, 0.5F * kEdgeM};
  drive(rig, centre, 2e-3F, 2.0F);
  return forces_held(rig, {2e-3F, centre.y, centre.z}, ticks);
}

// The needle is so thin that the lattice's compliance is negligible beside its own, so that only
// the material's fraction and time are seen.
TEST(V28Relaxation, DecaysByTheFractionAndTimeWritten) {
  TinyOrgan tiny;
  tiny.nx = 4;
  tiny.ny = tiny.nz = 1;
  tiny.materials = {relaxing()};
  Config config;
  config.needle[0].outer_radius_m = 1e-5F;
  Rig rig = make_rig(tiny, config, Tissue::kFixed);
  const Decay decay = decay_of(press_and_hold(rig, 8000), 1e-3);
  EXPECT_NEAR(decay.fraction / static_cast<double>(kFraction), 1, kTolerance);
  EXPECT_NEAR(decay.time_s / static_cast<double>(kTimeS), 1, kTolerance);
  EXPECT_LT(decay.worst, kTolerance);
}

// Any spring and Maxwell branch, one CP in the middle of one voxel. With 100 N/m in series with
// eight corners of 28 N/m each, spring and corners give way; with 100 times as much, mostly the
// corners.
TEST(V28Relaxation, StepOfOneShaftParticleRelaxesAllOfItsForce) {
  for (const double spring : {100.0, 10000.0}) {
    for (const double share : {0.2, 0.5, 0.8}) {
      TinyOrgan tiny;
      tiny.nx = tiny.ny = tiny.nz = 1;
      tiny.voxel_edge_m = kEdgeM;
      tiny.materials = {relaxing()};
      tiny.materials[0].coulomb_friction_n_per_m = 10000;
      tiny.materials[0].static_friction_n_per_m = 10000;
      Rig rig = make_rig(tiny, Config{}, Tissue::kFixed);
      const double corners = 8 * 20000 / 2.9 * static_cast<double>(kEdgeM), time_s = 0.5;
      const Vec3 centre = {kEdgeM / 2, kEdgeM / 2, kEdgeM / 2};
      const Vec3 tip = hold_one_shaft_particle(rig, centre, static_cast<float>(spring));
      Particle& p = rig.view().state.shaft[0];
      p.relaxing_fraction = static_cast<float>(share);
      p.memory_keep = static_cast<float>(std::exp(-1e-3 / time_s));
      const double step = 1e-3, first = spring * corners / (spring + corners) * step;
      const std::vector<double> force = forces_held(rig, tip + Vec3{1e-3F, 0, 0}, 10000);
      for (std::size_t i = 0; i < force.size(); i += 100) {
        const double left = std::exp(-1e-3 * static_cast<double>(i) / time_s);
        ASSERT_NEAR(force[i] / (first * (1 - share + share * left)), 1, kTolerance)
            << "spring " << spring << ", share " << share << ", tick " << i;
      }
    }
  }
}

// An 18G needle is pressed on tissue that gives way: CP and lattice together must relax as written.
TEST(V28Relaxation, WholeContactRelaxesAsWritten) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = 9;
  tiny.materials = {relaxing()};
  tiny.fixed_faces = kHighX;
  Rig rig = make_rig(tiny, Config{});
  const Vec3 centre = {-1e-3F, 22.5e-3F, 22.5e-3F};
  drive(rig, centre, 2e-3F, 0.2F);
  std::vector<double> force = forces_held(rig, {2e-3F, centre.y, centre.z}, 6000);
  force.erase(force.begin(), force.begin() + 50);  // the tissue's own motion
  const Decay decay = decay_of(force, 1e-3);
  const double missed = 1 - std::exp(-0.06 / static_cast<double>(kTimeS));  // relaxed before
  const double all = static_cast<double>(kFraction);
  EXPECT_NEAR(decay.fraction, 1 - (1 - all) / (1 - all * missed), 0.1 * all);
  EXPECT_NEAR(decay.time_s / static_cast<double>(kTimeS), 1, 0.1);
}

// The same for a needle that has been pushed in and rests: tip and shaft together.
TEST(V28Relaxation, InsertedNeedleRelaxesAsWritten) {
  TinyOrgan tiny;
  tiny.nx = 12;
  tiny.ny = tiny.nz = 9;
  tiny.materials = {relaxing()};
  tiny.materials[0].puncture_force_n = 0.3F;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  Rig rig = make_rig(tiny, Config{});
  const Vec3 start = {-1e-3F, 22e-3F, 23e-3F};
  drive(rig, start, 40e-3F, 20e-3F);
  const std::vector<double> force = forces_held(rig, {40e-3F, start.y, start.z}, 6000);
  const Decay decay = decay_of(force, 1e-3);
  EXPECT_NEAR(decay.fraction / static_cast<double>(kFraction), 1, 0.1);
  EXPECT_NEAR(decay.time_s / static_cast<double>(kTimeS), 1, 0.1);
}

// Tissue that another needle holds aside relaxes there, and does not pull at a needle that comes to
// it later. A twentieth of the other needle's force is allowed; when the tissue's displacement was
// taken for the needle's way, it pulled with an eighth.
TEST(Relaxation, NeedleInTissueThatAnotherHoldsAsideIsNotPulled) {
  TinyOrgan tiny;
  tiny.nx = 14;
  tiny.ny = tiny.nz = 10;
  tiny.voxel_edge_m = kEdgeM;
  tiny.fixed_faces = kLowX | kHighX | kLowY | kHighY | kLowZ;
  tiny.materials = {relaxing()};
  tiny.materials[0].puncture_force_n = tiny.materials[0].cutting_force_n = 0.05F;
  tiny.materials[0].coulomb_friction_n_per_m = tiny.materials[0].static_friction_n_per_m = 5;
  Config config;
  config.needle_count = 2;
  const auto opened = open_organ(tiny_organ(tiny));
  for (const float apart_m : {6e-3F, 8.5e-3F, 12e-3F}) {
    Session session = make_session(opened->organ, config);
    Vec3 tip_m[2] = {{0.02F, 0.0205F, 0.042F}, {0.02F + apart_m, 0.0203F, 0.06F}};
    Output out[2];
    const auto go = [&](int ticks, std::size_t needle, Vec3 step_m) {
      for (int i = 0; i < ticks; ++i) {
        tip_m[needle] = tip_m[needle] + step_m;
        Input in[2];
        for (std::size_t n = 0; n < 2; ++n) {
          in[n] = {{tip_m[n] + Vec3{0, 0, config.needle[n].length_m}, {1, 0, 0, 0}}, 1};
        }
        tick(session.kernel, in, out);
      }
    };
    go(1600, 0, {0, 0, -2e-5F});
    go(200, 0, {1e-5F, 0, 0});
    go(1000, 1, {0, 0, -2e-5F});
    go(1500, 1, {0, 0, -2e-5F});
    go(4000, 1, {});
    const double held_n = static_cast<double>(out[0].force_n.x);
    EXPECT_LT(held_n, -0.2) << "the first needle holds the tissue";
    EXPECT_LT(std::abs(static_cast<double>(out[1].force_n.x)), 0.05 * std::abs(held_n)) << apart_m;
  }
}

// Values that fade become zero and do not stay denormal, because processors may flush denormal
// numbers. A needle goes in a little askew and is then turned along x, so that nothing pulls across
// x any more.
TEST(Relaxation, WhatFadesEndsAtZero) {
  TinyOrgan tiny;
  tiny.nx = 8;
  tiny.ny = tiny.nz = 5;
  tiny.materials = {relaxing()};
  tiny.materials[0].puncture_force_n = 0.05F;
  Rig rig = make_rig(tiny, Config{}, Tissue::kFixed);
  const Vec3 end = {25e-3F, 12e-3F, 13e-3F};
  Input input = along_x({}, rig.length_m);
  input.handle.rotation = {0.7069F, 0.02F, -0.7069F, 0.02F};
  const Vec3 askew = rotation_matrix(input.handle.rotation) * Vec3{0, 0, -1};
  for (int i = 0; i <= 2000; ++i) {
    input.handle.position_m = end + (-rig.length_m - 2e-5F * static_cast<float>(2000 - i)) * askew;
    checked_tick(rig, input);
  }
  View view = needle_view(rig.view(), 0);
  ASSERT_GT(view.state.needle->shaft_count, 2U);
  ASSERT_NE(view.state.shaft[1].axial_way_m.y, 0.0F);
  for (int i = 0; i < 1000; ++i) {
    move_tip(rig, end);
    for (const Vec3 v : {view.state.shaft[1].axial_way_m, view.state.shaft[1].memory_m,
                         view.state.shaft[1].memory_n, view.state.shaft[1].slack_m,
                         view.state.tip->memory_m, view.state.tip->memory_n}) {
      for (const float part : {v.x, v.y, v.z}) ASSERT_NE(std::fpclassify(part), FP_SUBNORMAL);
    }
  }
  EXPECT_LT(std::fabs(view.state.shaft[1].axial_way_m.y), 1e-11F);
}

// A shaft is pulled along by 20 um and held. Returns which fraction of the remaining way a tick
// leaves, on average from the first tick until a twentieth is left.
double left_in_a_tick(float period_s) {
  TinyOrgan tiny;
  tiny.nx = 8;
  tiny.ny = tiny.nz = 5;
  tiny.materials = {relaxing()};
  tiny.materials[0].relaxing_fraction = 0;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.materials[0].coulomb_friction_n_per_m = tiny.materials[0].static_friction_n_per_m = 9e3F;
  Config config;
  config.period_s = period_s;
  Rig rig = make_rig(tiny, config, Tissue::kFixed);
  Vec3 tip_m = {-1e-3F, 12.3e-3F, 13.1e-3F};
  for (; tip_m.x < 25e-3F; tip_m.x += 2e-5F) move_tip(rig, tip_m);
  for (int i = 0; i < 200; ++i) move_tip(rig, tip_m);
  const View view = needle_view(rig.view(), 0);
  EXPECT_GT(view.state.needle->shaft_count, 2U);
  const auto axial_way_m = [&] { return static_cast<double>(view.state.shaft[1].axial_way_m.x); };
  const double before_m = axial_way_m();
  tip_m.x += 2e-5F;
  std::vector<double> gone_m;
  for (int i = 0; i < 200; ++i) {
    move_tip(rig, tip_m);
    gone_m.push_back(axial_way_m() - before_m);
  }
  EXPECT_GT(gone_m.back(), 1e-6) << period_s;
  const auto missing = [&](std::size_t i) { return 1 - gone_m[i] / gone_m.back(); };
  std::size_t last = 1;
  while (missing(last) > 0.05) ++last;
  return std::pow(missing(last) / missing(0), 1 / static_cast<double>(last));
}

// A damper of 1 ms (PHYSICS 11.3) is equally slow at any period of the tick. A tick of T takes the
// fraction T / (T + 1 ms) of the way that is left, times the spring's fraction of the compliance of
// spring and held voxels together, which is the same at all periods.
TEST(Relaxation, ShaftGivesWayAlongInTheSameTimeAtAnyPeriod) {
  std::vector<double> springs;
  for (const float period_s : {2.5e-4F, 5e-4F, 1e-3F, 2e-3F, 4e-3F}) {
    const double ticks = static_cast<double>(period_s) / 1e-3;
    springs.push_back((1 - left_in_a_tick(period_s)) * (1 + ticks) / ticks);
    EXPECT_NEAR(springs.back() / springs.front(), 1, 0.02) << period_s;
  }
  EXPECT_GT(springs.front(), 0.5);
  EXPECT_LT(springs.front(), 1);
}

}  // namespace
}  // namespace stylet::test
