// SPDX-License-Identifier: Apache-2.0
// A stuck needle is as stiff across its axis as the needle is, not as the grid is.
//
// An 18G needle stands 20 mm deep in the block of tests/fidelity/calculix (40 mm, E 10 kPa, fixed
// bottom) and is moved sideways by 20 um. CalculiX's force is that of columns 5 and 2.5 mm wide, at
// the needle's radius by its logarithm. The needle enters almost without force and is then stuck by
// its friction. What is measured is the row of CPs alone: it ends in half a unit at the surface and
// at the tip, so that it is as long as the needle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kDepthM = 0.02F, kMoveM = 20e-6F;
constexpr double kCalculixN = 4 * 0.436e-3;  // nu 0.45

struct Grid {
  float edge_m, unit_m;
};

// Along a line of nodes, of edge midpoints, of voxel centres and between; in voxel edges.
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

// Half a unit at either end of the row, and friction nothing overcomes.
void stick(Rig& rig) {
  const View view = rig.view();
  MaterialModel& m = view.model.head->material[0];
  m.coulomb_n_per_m = m.static_n_per_m = m.cutting_n = 1e4F;
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

}  // namespace
}  // namespace stylet::test
