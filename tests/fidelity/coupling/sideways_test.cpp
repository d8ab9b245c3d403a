// SPDX-License-Identifier: Apache-2.0
// A needle that is dragged across tissue of some toughness cuts it: the hand feels no more than the
// closed form of PHYSICS 9.8, written here once more in double precision, and gets no energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Scene {
  TinyOrgan tiny;
  Config config;
  Vec3 start_m;
  float depth_m, speed_m_per_s;
};

Scene draw_scene(Draw& draw) {
  Scene scene;
  TinyMaterial m;
  m.youngs_modulus_pa = draw.magnitude(6000, 20000);
  m.fracture_toughness_j_per_m2 = draw.magnitude(20, 100);
  m.needle_friction_coefficient = draw.between(0.05, 0.3);
  m.relaxing_fraction = draw.chance(0.5) ? draw.between(0, 0.4) : 0;
  scene.tiny.voxel_edge_m = draw.between(3e-3, 6e-3);
  scene.tiny.nx = static_cast<std::uint16_t>(0.09F / scene.tiny.voxel_edge_m);
  scene.tiny.ny = scene.tiny.nz = static_cast<std::uint16_t>(0.08F / scene.tiny.voxel_edge_m);
  scene.tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  scene.tiny.materials = {m};
  NeedleConfig& needle = scene.config.needle[0];
  needle.outer_radius_m = draw.between(0.3e-3, 1e-3);
  needle.unit_m = draw.between(2e-3, 6e-3);
  scene.start_m = {-1e-3F, draw.between(25e-3, 30e-3), draw.between(33e-3, 45e-3)};
  scene.depth_m = draw.between(30e-3, 45e-3);
  scene.speed_m_per_s = draw.magnitude(3e-3, 40e-3);
  return scene;
}

struct Limits {
  double shaft_n_per_m, tip_n;
};
Limits expected(const TinyMaterial& m, const NeedleConfig& needle) {
  const double plane_pa = static_cast<double>(m.youngs_modulus_pa) /
                          (1 - std::pow(static_cast<double>(m.poisson_ratio), 2));
  const double a = static_cast<double>(needle.outer_radius_m);
  const double mu = static_cast<double>(m.needle_friction_coefficient);
  const double tough = static_cast<double>(m.fracture_toughness_j_per_m2);
  const double tangent = std::tan(static_cast<double>(needle.tip_half_angle_rad));
  return {tough + (1 + mu) * plane_pa / 2 * 2 * a,
          tough * static_cast<double>(needle.torn_diameters) * 2 * a +
              kPi / 4 * plane_pa * a * a * (1 + mu / tangent)};
}

// In, then aside by `way_m` along y; returns the force across at the end.
template <typename Visit>
double drag(Rig& rig, const Scene& scene, float way_m, Visit visit) {
  drive(rig, scene.start_m, scene.depth_m, 20e-3F, visit);
  Output out = {};
  const float step_m = scene.speed_m_per_s * 1e-3F;
  const int ticks = static_cast<int>(way_m / step_m);
  for (int i = 1; i <= ticks; ++i) {
    const float y = scene.start_m.y + step_m * static_cast<float>(i);
    out = move_tip(rig, {scene.depth_m, y, scene.start_m.z});
    visit(out);
  }
  return std::fabs(static_cast<double>(out.force_n.y));
}

TEST(Sideways, AHandFeelsNoMoreThanCuttingTakes) {
  Draw draw(91);
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = draw_scene(draw);
    const Limits limits = expected(scene.tiny.materials[0], scene.config.needle[0]);
    for (const Tissue tissue : {Tissue::kFixed, Tissue::kMoves}) {
      Rig rig = make_rig(scene.tiny, scene.config, tissue);
      double least = 1e9, most = 0, sum = 0;
      int ticks = 0;
      (void)drag(rig, scene, 24e-3F, [&](const Output& out) {
        const double depth_m = static_cast<double>(rig.view().state.needle->tissue_track_m);
        const double cut_n = limits.shaft_n_per_m * depth_m + limits.tip_n;
        const double felt = std::fabs(static_cast<double>(out.force_n.y)) / cut_n;
        most = std::max(most, felt);
        if (out.tip_m.y < scene.start_m.y + 12e-3F) return;
        least = std::min(least, felt);
        sum += felt;
        ++ticks;
      });
      ASSERT_GT(rig.view().state.needle->shaft_count, 3U);
      EXPECT_NEAR(sum / ticks, 1, 0.02);
      EXPECT_GT(least, 0.95) << "where voxels are taken up and let go";
      EXPECT_LT(most, 1.01);
    }
  }
}

// Dragged to and fro, in random directions, also along: what the hand has spent and nothing stores
// any more does not fall. (By a thousandth for a tick: a voxel that is dragged inside out has two
// rotations, and the report, which matches it anew, may take the other.)
TEST(Sideways, NoEnergyFromNowhere) {
  Draw draw(92);
  for (int round = 0, inserted = 0; inserted < 4; ++round) {
    SCOPED_TRACE(round);
    ASSERT_LT(round, 12);
    const Scene scene = draw_scene(draw);
    Rig rig = make_rig(scene.tiny, scene.config);
    double most_j = 0, fall_j = 0;
    const auto look = [&](const Output& out) {
      if (out.tick % 16 != 0) return;  // the books take longer than a tick
      const Energy e = energy(rig.kernel());
      const double spent_j = e.work_by_hand - (e.elastic + e.kinetic + e.coupling);
      most_j = std::max(most_j, spent_j);
      fall_j = std::max(fall_j, most_j - spent_j);
    };
    drive(rig, scene.start_m, scene.depth_m, 20e-3F, look);
    if (rig.view().state.needle->shaft_count == 0) continue;  // too tough to enter
    ++inserted;
    Vec3 at_m = {scene.depth_m, scene.start_m.y, scene.start_m.z};
    for (int leg = 0; leg < 10; ++leg) {
      const Vec3 to_m = {scene.depth_m + draw.between(-8e-3, 8e-3), draw.between(15e-3, 60e-3),
                         draw.between(15e-3, 60e-3)};
      const float way_m = norm(to_m - at_m), speed = draw.magnitude(20e-3, 0.3);
      const int ticks = 1 + static_cast<int>(way_m / (speed * 1e-3F));
      for (int i = 1; i <= ticks; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(ticks);
        look(move_tip(rig, at_m + part * (to_m - at_m)));
      }
      at_m = to_m;
    }
    EXPECT_GT(most_j, 1e-3);
    EXPECT_LT(fall_j, 1e-3 * most_j);
  }
}

// Out through the side of a free block: then nothing holds the needle, and nothing is wrong.
TEST(Sideways, ANeedleMayCutItsWayOut) {
  Draw draw(93);
  for (int round = 0; round < 3; ++round) {
    SCOPED_TRACE(round);
    Scene scene = draw_scene(draw);
    scene.tiny.fixed_faces = kHighX | kLowY | kLowZ;
    Rig rig = make_rig(scene.tiny, scene.config);
    const double last_n = drag(rig, scene, 110e-3F, [](const Output& out) {
      ASSERT_EQ(out.flags & kFlagFault, 0U);
      ASSERT_LT(norm(out.force_n), 50);
    });
    EXPECT_LT(last_n, 1e-3);
  }
}

// Written forces say nothing of tearing: such tissue is dragged along, as before.
TEST(Sideways, TissueWithoutToughnessIsNotCut) {
  Draw draw(94);
  Scene scene = draw_scene(draw);
  TinyMaterial& m = scene.tiny.materials[0];
  const Limits limits = expected(m, scene.config.needle[0]);
  m.fracture_toughness_j_per_m2 = 0;
  Rig rig = make_rig(scene.tiny, scene.config);
  const double felt_n = drag(rig, scene, 24e-3F, [](const Output&) {});
  EXPECT_GT(felt_n, 2 * (limits.shaft_n_per_m * static_cast<double>(scene.depth_m)));
}

}  // namespace
}  // namespace stylet::test
