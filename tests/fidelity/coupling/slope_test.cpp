// SPDX-License-Identifier: Apache-2.0
// The friction that a report reads off a curve is that of the material, also in soft tissue, where
// the needle takes the tissue along for many millimetres before it slides.

#include <cmath>
#include <random>
#include <vector>

#include "hal/score/phases.h"
#include "rig.h"

namespace stylet::test {
namespace {

// Random tissues of 6 to 30 kPa, held at the far end: 60 mm in, a rest, and out. If a needle takes
// the tissue along until its end, there is no slope.
TEST(Slope, IsTheFrictionOfTheMaterialOnceTheShaftSlides) {
  std::mt19937 random(1000);
  const auto between = [&](double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
  };
  int rows = 0, none = 0;
  for (int round = 0; round < 20; ++round) {
    TinyOrgan tiny;
    tiny.voxel_edge_m = between(3.5e-3, 5.5e-3);
    const auto voxels = [&](float length_m) {
      return static_cast<std::uint16_t>(std::lround(length_m / tiny.voxel_edge_m));
    };
    tiny.nx = voxels(0.09F);
    tiny.ny = tiny.nz = voxels(0.06F);
    tiny.fixed_faces = kHighX;
    TinyMaterial& tissue = tiny.materials[0];
    tissue.youngs_modulus_pa = between(6e3, 30e3);
    tissue.puncture_force_n = 0.2F;
    tissue.cutting_force_n = 0.1F;
    tissue.coulomb_friction_n_per_m = between(5, 40);
    tissue.static_friction_n_per_m = tissue.coulomb_friction_n_per_m;
    tissue.relaxing_fraction = 0;
    Rig rig = make_rig(tiny, Config{});
    std::vector<hal::TrackPoint> track;
    const auto see = [&](const Output& out) {
      track.push_back({track.size(), -out.force_n.x, out.depth_m, out.tip_m.x, out.phase});
    };
    const Vec3 entry = {-2e-3F, between(0.025, 0.035), between(0.025, 0.035)};
    const float speed = between(5e-3, 20e-3);
    drive(rig, entry, 0.06F, speed, see);
    drive(rig, {0.06F, entry.y, entry.z}, 0.06F + 1e-6F, 2e-6F, see);
    drive(rig, {0.06F, entry.y, entry.z}, 0, speed, see);
    for (const hal::PhaseRow& row : hal::find_phases(track, 1e-3, 5e-3F)) {
      const bool in = row.stage == hal::Stage::kInsertion;
      if (!in && row.stage != hal::Stage::kRetraction) continue;
      if (row.depth_m < 10e-3F) continue;  // tissue that springs back onto the tip that has left it
      ++rows;
      if (std::isnan(row.slope_n_per_mm)) {
        ++none;
        continue;
      }
      const auto friction = static_cast<double>(tissue.coulomb_friction_n_per_m) * 1e-3;
      EXPECT_NEAR(static_cast<double>(row.slope_n_per_mm) / friction, in ? 1 : -1, 0.05)
          << round << ": " << tissue.youngs_modulus_pa << " Pa, " << friction << " N/mm, " << speed
          << " m/s, slides after " << row.presliding_m << " m";
    }
  }
  EXPECT_EQ(rows, 40);
  EXPECT_LE(none, rows / 10);
}

}  // namespace
}  // namespace stylet::test
