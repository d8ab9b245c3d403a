// SPDX-License-Identifier: Apache-2.0
// The friction that a report reads off a curve is that of the material, also in soft tissue, where
// the needle takes the tissue along for many millimetres before it slides.

#include <cmath>
#include <random>
#include <vector>

#include "hal/score/stages.h"
#include "rig.h"

namespace stylet::test {
namespace {

// A block of tissue held at its far end: 60 mm in, a rest, and out.
struct Scene {
  float youngs_pa, puncture_n, friction_n_per_m, edge_m, y_m, z_m, speed_m_per_s;
};

// Stages in and out that are deep enough: not where tissue springs back onto the tip that has left
// it.
std::vector<hal::StageRow> strokes_of(const Scene& s) {
  TinyOrgan tiny;
  tiny.voxel_edge_m = s.edge_m;
  const auto voxels = [&](float length_m) {
    return static_cast<std::uint16_t>(std::lround(length_m / s.edge_m));
  };
  tiny.nx = voxels(0.09F);
  tiny.ny = tiny.nz = voxels(0.06F);
  tiny.fixed_faces = kHighX;
  TinyMaterial& tissue = tiny.materials[0];
  tissue.youngs_modulus_pa = s.youngs_pa;
  tissue.puncture_force_n = s.puncture_n;
  tissue.cutting_force_n = 0.5F * s.puncture_n;
  tissue.coulomb_friction_n_per_m = tissue.static_friction_n_per_m = s.friction_n_per_m;
  tissue.relaxing_fraction = 0;
  Rig rig = make_rig(tiny, Config{});
  std::vector<hal::TrackPoint> track;
  const auto see = [&](const Output& out) {
    track.push_back({track.size(), -out.force_n.x, out.depth_m, out.tip_m.x, out.phase});
  };
  drive(rig, {-2e-3F, s.y_m, s.z_m}, 0.06F, s.speed_m_per_s, see);
  drive(rig, {0.06F, s.y_m, s.z_m}, 0.06F + 1e-6F, 2e-6F, see);
  drive(rig, {0.06F, s.y_m, s.z_m}, 0, s.speed_m_per_s, see);
  std::vector<hal::StageRow> strokes;
  for (const hal::StageRow& row : hal::find_stages(track, 1e-3, 5e-3F)) {
    const bool moves = row.stage == hal::Stage::kInsertion || row.stage == hal::Stage::kRetraction;
    if (moves && row.depth_m >= 10e-3F) strokes.push_back(row);
  }
  return strokes;
}

// The slope over the friction: 1 on the way in, -1 on the way out.
void expect_friction(const Scene& s, const hal::StageRow& row, double tolerance) {
  const auto friction = static_cast<double>(s.friction_n_per_m) * 1e-3;
  EXPECT_NEAR(static_cast<double>(row.slope_n_per_mm) / friction,
              row.stage == hal::Stage::kInsertion ? 1 : -1, tolerance)
      << s.youngs_pa << " Pa, " << friction << " N/mm, " << s.speed_m_per_s << " m/s, slides after "
      << row.presliding_m << " m";
}

struct Drawn {
  std::mt19937 random{1000};
  float between(double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
  }
};

// Drawn tissues of 6 to 30 kPa. Where a needle takes the tissue along to its end, there is no
// slope.
TEST(Slope, IsTheFrictionOfTheMaterialOnceTheShaftSlides) {
  Drawn draw;
  int rows = 0, none = 0;
  for (int round = 0; round < 20; ++round) {
    Scene s = {};
    s.edge_m = draw.between(3.5e-3, 5.5e-3);
    s.youngs_pa = draw.between(6e3, 30e3);
    s.puncture_n = 0.2F;
    s.friction_n_per_m = draw.between(5, 40);
    s.y_m = draw.between(0.025, 0.035);
    s.z_m = draw.between(0.025, 0.035);
    s.speed_m_per_s = draw.between(5e-3, 20e-3);
    for (const hal::StageRow& row : strokes_of(s)) {
      ++rows;
      if (std::isnan(row.slope_n_per_mm)) {
        ++none;
      } else {
        expect_friction(s, row, 0.05);
      }
    }
  }
  EXPECT_EQ(rows, 40);
  EXPECT_LE(none, rows / 10);
}

// Of 3 to 6 kPa, which break at a dimple of 8 mm (Sneddon's punch of an 18G needle; a force that
// presses such tissue to the bottom of the block lets it spring back by centimetres, and a slope
// over that is none of the friction). Where the whole shaft slides within 25 mm, the
// slope is the friction. Elsewhere needle and tissue go together for most of it.
TEST(Slope, IsThatOfSoftTissueToo) {
  Drawn draw;
  int slid = 0;
  for (int round = 0; round < 20; ++round) {
    Scene s = {};
    s.edge_m = draw.between(3.5e-3, 5.5e-3);
    s.youngs_pa = draw.between(3e3, 6e3);
    s.puncture_n = 2 * 0.635e-3F * s.youngs_pa / (1 - 0.45F * 0.45F) * 8e-3F;
    s.friction_n_per_m = draw.between(5, 40);
    s.y_m = draw.between(0.025, 0.035);
    s.z_m = draw.between(0.025, 0.035);
    s.speed_m_per_s = draw.between(5e-3, 20e-3);
    for (const hal::StageRow& row : strokes_of(s)) {
      if (std::isnan(row.slope_n_per_mm) || row.presliding_m > 0.025F) continue;
      ++slid;
      expect_friction(s, row, 0.01);
    }
  }
  EXPECT_GE(slid, 20);
}

}  // namespace
}  // namespace stylet::test
