// SPDX-License-Identifier: Apache-2.0
// How stiff needle and tissue are together depends on the needle, not on the grid: in contact with
// a skin, and when the needle is stuck.
//
// An 18G needle stands 20 mm deep in the block of tests/fidelity/calculix (40 mm, E 10 kPa, fixed
// bottom) and is moved sideways by 20 um. CalculiX's forces are those of columns 5 and 2.5 mm wide,
// extrapolated to the needle's radius over its logarithm. The needle enters almost without force
// and is then stuck by its friction. Only the row of CPs is measured: it ends with half a unit at
// the surface and at the tip, so that it is as long as the needle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kDepthM = 0.02F, kMoveM = 20e-6F;
constexpr double kCalculixN = 4 * 0.436e-3;  // nu 0.45

struct Grid {
  float edge_m, unit_m;
};

// On lines of nodes, of edge midpoints, of voxel centres, and between them; in voxel edges.
constexpr Vec3 kPlaces[] = {
    {0, 0, 0}, {0, 0, 0.5F}, {0, 0.25F, 0.25F}, {0, 0.5F, 0.25F}, {0, 0.5F, 0.5F}};

Rig insert_needle(Grid grid, float poisson, Vec3 tip_m) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = static_cast<std::uint16_t>(std::lround(0.04F / grid.edge_m));
  tiny.voxel_edge_m = grid.edge_m;
  tiny.fixed_faces = kHighX;
  TinyMaterial& m = tiny.materials[0];
  m.youngs_modulus_pa = 10000;
  m.poisson_ratio = poisson;
  m.puncture_force_n = m.cutting_force_n = 1e-3F;
  m.coulomb_friction_n_per_m = m.static_friction_n_per_m = 1e-3F;
  Config config;
  config.needle[0].unit_m = grid.unit_m;
  config.surround_drag_per_s = 60;
  Rig rig = make_rig(tiny, config);
  drive(rig, {-1e-3F, tip_m.y, tip_m.z}, tip_m.x, 0.1F);
  hold(rig, tip_m, 500);
  return rig;
}

// Lets the row end with half a unit at either end, and makes friction so large that nothing slips.
void stick(Rig& rig) {
  View view = needle_view(rig.view(), 0);
  view.model.forces[0].cutting_n = 1e4F;
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    Friction& friction = view.state.shaft[i].friction;
    friction.coulomb_n_per_m = friction.static_n_per_m = 1e4F;
  }
  Particle& entry = view.state.shaft[0];
  entry.full_stiffness_n_per_m = entry.full_stiffness_n_per_m / 2;
  view.state.tip->stiffness_n_per_m = entry.full_stiffness_n_per_m;
}

struct Sideways {
  double y_n, z_n, shortfall;
};

Sideways force_of(Grid grid, float poisson, Vec3 place) {
  const Vec3 tip = Vec3{kDepthM, 0.02F, 0.02F} + grid.edge_m * place;
  Rig rig = insert_needle(grid, poisson, tip);
  stick(rig);
  const Vec3 none = hold(rig, tip, 500).force_n;
  const Vec3 y = hold(rig, tip + Vec3{0, kMoveM, 0}, 500).force_n;
  const Vec3 z = hold(rig, tip + Vec3{0, 0, kMoveM}, 500).force_n;
  return {static_cast<double>(none.y - y.y), static_cast<double>(none.z - z.z),
          static_cast<double>(stats(rig.kernel()).coupling_shortfall)};
}

constexpr Grid kGrids[] = {{5e-3F, 5e-3F}, {5e-3F, 2.5e-3F}, {2.5e-3F, 2.5e-3F}};

TEST(Stiffness, StuckNeedleIsAsStiffAsInCalculix) {
  for (const Grid grid : kGrids) {
    for (const Vec3 place : kPlaces) {
      const Sideways f = force_of(grid, 0.45F, place);
      const testing::Message where = testing::Message()
                                     << "voxel " << grid.edge_m << " m, unit " << grid.unit_m
                                     << " m, at " << place.y << ", " << place.z;
      EXPECT_NEAR(f.y_n / kCalculixN, 1, 0.1) << where;
      EXPECT_NEAR(f.z_n / kCalculixN, 1, 0.1) << where;
      EXPECT_LT(f.shortfall, 0.01) << where;
    }
  }
}

TEST(Stiffness, NeitherVoxelNorUnitNorPlaceIsFelt) {
  for (const float poisson : {0.3F, 0.45F}) {
    std::vector<double> all;
    for (const Grid grid : kGrids) {
      for (const Vec3 place : kPlaces) {
        const Sideways f = force_of(grid, poisson, place);
        all.push_back(f.y_n);
        all.push_back(f.z_n);
      }
    }
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    EXPECT_LT(*most / *least, 1.05) << "nu " << poisson;
  }
}

// A tip holds the tissue at a place, in voxel edges from the middle of a block that is held on all
// sides: how far it takes the lattice along, divided by its force, in 1 / (G h).
struct Given {
  double per_force, squares;  // and the sum of the squared weights
};

Given given_inside(float poisson, Vec3 place, std::uint16_t voxels) {
  constexpr float kEdgeM = 5e-3F, kTakenM = 1e-3F, kSpringNPerM = 10;
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = voxels;
  tiny.voxel_edge_m = kEdgeM;
  tiny.fixed_faces = kLowX | kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial& m = tiny.materials[0];
  m.youngs_modulus_pa = 10000;
  m.poisson_ratio = poisson;
  m.puncture_force_n = m.cutting_force_n = 100;
  m.coulomb_friction_n_per_m = m.static_friction_n_per_m = 1e-6F;  // the tip alone
  Config config;
  config.surround_drag_per_s = 60;
  Rig rig = make_rig(tiny, config);
  const float middle = kEdgeM * static_cast<float>(voxels / 2);
  const Vec3 rest = Vec3{middle, middle, middle} + kEdgeM * place;
  hold(rig, hold_tip(rig, rest, kSpringNPerM) + Vec3{kTakenM, 0, 0}, 800);
  View view = needle_view(rig.view(), 0);
  const Particle& tip = *view.state.tip;
  Given given = {0, 0};
  for (std::uint32_t i = 0; i < tip.support_count; ++i) {
    const Support& s = tip.support[i];
    const double w = static_cast<double>(s.weight);
    const Vec3 centre = rest_centre(view.model, s.slot, view.model.row[s.row]);
    given.per_force += w * static_cast<double>(s.goal_m.x - centre.x - s.offset_m.x);
    given.squares += w * w;
  }
  const double shear_pa = 10000 / (2 * (1 + static_cast<double>(poisson)));
  given.per_force *= shear_pa * static_cast<double>(kEdgeM / tip.force_n.x);
  return given;
}

// How far the lattice itself gives way under a tip inside, in an infinite block: the formula of the
// tip's spring (kInsideGive, PHYSICS 11.2).
TEST(Stiffness, LatticeGivesWayToATipInsideAsItsWeightIsShared) {
  constexpr Vec3 kInside[] = {{0, 0, 0},          {0, 0, 0.5F},          {0, 0.25F, 0.25F},
                              {0, 0.5F, 0.5F},    {0.25F, 0.25F, 0.25F}, {0.5F, 0.5F, 0.5F},
                              {0.5F, 0.25F, 0.0F}};
  for (const float poisson : {0.0F, 0.3F, 0.45F}) {
    for (const Vec3 place : kInside) {
      const Given coarse = given_inside(poisson, place, 8), fine = given_inside(poisson, place, 16);
      const double endless = 2 * fine.per_force - coarse.per_force;
      const double formula = 0.104 - 0.040 * static_cast<double>(poisson) + 0.076 * fine.squares;
      EXPECT_NEAR(formula / endless, 1, 0.12)
          << "nu " << poisson << ", at " << place.x << ", " << place.y << ", " << place.z;
    }
  }
}

// A tip that has gone in to a random place is pulled back by less than it takes to let it slide.
// Force over way is that of a rigid sphere in an infinite medium. Nothing holds the shaft.
double stiffness_inside(Draw& draw, float edge_m, float poisson, float shear_pa) {
  constexpr float kBackM = 0.2e-3F;
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = 16;
  tiny.voxel_edge_m = edge_m;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial& m = tiny.materials[0];
  m.youngs_modulus_pa = 2 * shear_pa * (1 + poisson);
  m.poisson_ratio = poisson;
  m.puncture_force_n = 0.05F;
  m.cutting_force_n = 0.02F;
  m.coulomb_friction_n_per_m = m.static_friction_n_per_m = 1e-6F;
  m.relaxing_fraction = 0;
  Rig rig = make_rig(tiny, Config{});
  const Vec3 tip =
      edge_m * Vec3{draw.between(7.5, 8.5), draw.between(7.5, 8.5), draw.between(7.5, 8.5)};
  drive(rig, {-1e-3F, tip.y, tip.z}, tip.x, 0.02F);
  const float in_n = hold(rig, tip, 400).force_n.x;
  const float back_n = hold(rig, tip - Vec3{kBackM, 0, 0}, 400).force_n.x;
  return static_cast<double>((back_n - in_n) / kBackM);
}

TEST(Stiffness, TipInsideIsAsStiffAsASphereWhereverItIs) {
  Draw draw(71);
  for (const float edge_m : {3e-3F, 5e-3F, 7e-3F}) {
    for (const float poisson : {0.3F, 0.45F}) {
      constexpr float kShearPa = 3000;
      constexpr double kRadiusM = 0.635e-3;
      const auto nu = static_cast<double>(poisson);
      const double sphere = 24 * std::numbers::pi * static_cast<double>(kShearPa) * kRadiusM *
                            (1 - nu) / (5 - 6 * nu);
      double sum = 0;
      constexpr int kTips = 8;
      for (int i = 0; i < kTips; ++i) {
        const double ratio = stiffness_inside(draw, edge_m, poisson, kShearPa) / sphere;
        EXPECT_NEAR(ratio, 1, 0.1) << edge_m << " m, nu " << nu;
        sum += ratio;
      }
      EXPECT_NEAR(sum / kTips, 1, 0.05) << edge_m << " m, nu " << nu;
    }
  }
}

TinyOrgan soft_block(float edge_m, float size_m) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = static_cast<std::uint16_t>(std::lround(size_m / edge_m));
  tiny.voxel_edge_m = edge_m;
  tiny.fixed_faces = kHighX;
  tiny.materials[0].youngs_modulus_pa = 10000;
  return tiny;
}

// A thin skin of 1 N/mm, spread over the outermost voxels, over tissue as soft as liver.
double force_on_skin(float edge_m, Vec3 place, float depth_m) {
  TinyOrgan tiny = soft_block(edge_m, 0.08F);
  tiny.materials.resize(2);
  for (TinyMaterial& m : tiny.materials) {
    m.youngs_modulus_pa = 23200;
    m.puncture_force_n = 30;
  }
  tiny.materials[1].membrane_n_per_m = 1000;
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x == 0 ? 1 : 0);
  };
  Rig rig = make_rig(tiny, Config{});
  Vec3 tip = Vec3{-1e-3F, 0.04F, 0.04F} + edge_m * place;
  drive(rig, tip, depth_m, 0.02F);
  tip.x = depth_m;
  return -static_cast<double>(hold(rig, tip, 200).force_n.x);
}

TEST(Stiffness, ThinSkinIsFeltAlikeWhateverTheVoxelItIsSpreadOver) {
  for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{0, 0.25F, 0.25F}}) {
    for (const float depth_m : {0.5e-3F, 1e-3F}) {
      const double usual_n = force_on_skin(5e-3F, place, depth_m);
      for (const float edge_m : {10e-3F, 2.5e-3F}) {
        EXPECT_NEAR(force_on_skin(edge_m, place, depth_m) / usual_n, 1, 0.03)
            << "voxel " << edge_m << " m, depth " << depth_m;
      }
    }
  }
}

// Under a dimple that is several voxels deep, tissue is pressed to a fraction of its height, and
// finer voxels are softer: PHYSICS 18.1.
TEST(Stiffness, DeepDimplesAreSofterInFinerVoxelsByAnEighthAtMost) {
  for (const float depth_m : {8e-3F, 12e-3F}) {
    double force[2] = {};
    for (int fine = 0; fine < 2; ++fine) {
      TinyOrgan tiny = soft_block(fine != 0 ? 2.5e-3F : 5e-3F, 0.08F);
      tiny.materials[0].puncture_force_n = 30;
      Rig rig = make_rig(tiny, Config{});
      drive(rig, {-1e-3F, 0.04F, 0.04F}, depth_m, 0.02F);
      force[fine] = -static_cast<double>(hold(rig, {depth_m, 0.04F, 0.04F}, 200).force_n.x);
    }
    EXPECT_LT(force[1], force[0]);
    EXPECT_GT(force[1], 0.875 * force[0]) << depth_m;
  }
}

// A tip breaks through at the bottom of a dimple ten voxels deep, where tissue is pressed to a
// tenth of its height, and goes on into the tissue below.
TEST(Stiffness, TipStaysInTissueThatADeepDimpleHasCrushed) {
  TinyOrgan tiny = soft_block(2.5e-3F, 0.06F);
  tiny.materials[0].puncture_force_n = 0.3F;
  tiny.materials[0].coulomb_friction_n_per_m = tiny.materials[0].static_friction_n_per_m = 0.25F;
  Rig rig = make_rig(tiny, Config{});
  float last_m = 0, farthest_m = 0;
  const Output end = drive(rig, {-1e-3F, 0.03F, 0.03F}, 0.045F, 0.01F, [&](const Output& out) {
    farthest_m = std::max(farthest_m, out.depth_m - last_m);
    last_m = out.depth_m;
  });
  EXPECT_EQ(end.layer, 0U);
  EXPECT_LT(farthest_m, 25e-3F) << "in one tick: more than the dimple holds";
  EXPECT_NEAR(-end.force_n.x, 0.2F + 0.25F * end.depth_m, 0.02F);
}

}  // namespace
}  // namespace stylet::test
