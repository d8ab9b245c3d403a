// SPDX-License-Identifier: Apache-2.0
// The tip in contact is Sneddon's rigid cone that goes over into a cylinder (1965), for any needle,
// tissue and voxel, and all of it relaxes as the material says.
//
// With E* = E / (1 - nu^2), radius R and half angle a: F = (2 / pi) E* tan(a) d^2 until contact is
// as wide as the needle, at l = pi R / (2 tan a); from there on 2 R E* more for each metre. The
// half space is a block of 24 voxels a side, held at its far face. With a thin skin the expected
// force is a film's, computed by film.py.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "draw.h"
#include "laws/stiff_tip.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kYoungsPa = 10000;

struct Press {
  double radius_m, half_angle_rad, edge_m, poisson, depth_m, youngs_pa = kYoungsPa;
  Vec3 place = {};  // of the tip beside the middle, in voxel edges
  double skin_n_per_m = 0;

  double shear_pa() const { return youngs_pa / (2 * (1 + poisson)); }
  double sneddon_n(double depth) const {
    const double plane = youngs_pa / (1 - poisson * poisson);
    const double wide = kPi * radius_m / (2 * std::tan(half_angle_rad));
    const double cone = std::min(depth, wide);
    return 2 / kPi * plane * std::tan(half_angle_rad) * cone * cone +
           2 * radius_m * plane * (depth - cone);
  }
  // A few times this force presses a voxel to a fraction of its height.
  double crush_n() const { return shear_pa() * edge_m * edge_m; }
};

// The uppermost `thick` layers of voxels have the skin and are `upper` times as stiff.
Rig rig_of(const Press& p, std::uint16_t voxels, TinyMaterial m = {}, double upper = 1,
           std::uint16_t thick = 1) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = voxels;
  tiny.voxel_edge_m = static_cast<float>(p.edge_m);
  tiny.fixed_faces = kHighX;
  m.youngs_modulus_pa = static_cast<float>(p.youngs_pa);
  m.poisson_ratio = static_cast<float>(p.poisson);
  if (!(m.puncture_force_n > 0)) m.puncture_force_n = 1000;
  tiny.materials = {m, m};
  tiny.materials[1].membrane_n_per_m = static_cast<float>(p.skin_n_per_m);
  tiny.materials[1].youngs_modulus_pa *= static_cast<float>(upper);
  tiny.material_at = [thick](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x < thick ? 1 : 0);
  };
  Config config;
  config.surround_drag_per_s = 20;
  config.needle[0].outer_radius_m = static_cast<float>(p.radius_m);
  config.needle[0].tip_half_angle_rad = static_cast<float>(p.half_angle_rad);
  return make_rig(tiny, config);
}

Vec3 start_of(const Press& p, std::uint16_t voxels) {
  const auto edge = static_cast<float>(p.edge_m);
  const float middle = 0.5F * static_cast<float>(voxels) * edge;
  return Vec3{-1e-3F, middle, middle} + edge * p.place;
}

// If the tip moves 50 um in a tick, contact begins where it first touches; if it moves less,
// contact may begin up to 20 um later.
constexpr float kFirstM = 50e-6F;

// At rest, pressed in slowly.
double force_at_rest(Rig& rig, Vec3 start_m, double depth_m) {
  const auto depth = static_cast<float>(depth_m);
  drive(rig, start_m, kFirstM, 0.05F);
  drive(rig, {kFirstM, start_m.y, start_m.z}, depth, 0.05F);
  return -static_cast<double>(hold(rig, {depth, start_m.y, start_m.z}, 600).force_n.x);
}

TEST(Contact, IsSneddonsConeForAnyNeedleTissueAndVoxel) {
  constexpr std::uint16_t kVoxels = 24;
  DoubleDraw draw(1);
  for (int i = 0; i < 32; ++i) {
    Press p = {draw.between(0.2e-3, 1.5e-3), draw.between(8, 40) * kPi / 180,
               draw.between(2.5e-3, 10e-3), draw.between(0.3, 0.48), draw.between(1e-3, 10e-3)};
    p.place = {0, static_cast<float>(draw.between(0, 0.5)),
               static_cast<float>(draw.between(0, 0.5))};
    const double expected = p.sneddon_n(p.depth_m), crush = expected / p.crush_n();
    if (crush > 5) continue;
    Rig rig = rig_of(p, kVoxels);
    const double force = force_at_rest(rig, start_of(p, kVoxels), p.depth_m);
    EXPECT_NEAR(force / expected, 1, crush < 3 ? 0.03 : 0.1)
        << "draw " << i << ": radius " << p.radius_m << " m, half angle " << p.half_angle_rad
        << ", voxel " << p.edge_m << " m, nu " << p.poisson << ", depth " << p.depth_m
        << " m, force " << crush << " G h^2";
  }
}

// A thin skin on tissue, pressed in by a point (film.h).
double film_n(const Press& p, double depth_m) {
  const double plane = p.youngs_pa / (1 - p.poisson * p.poisson);
  return 0.69 * std::cbrt(plane * plane * p.skin_n_per_m) * std::pow(depth_m, 5.0 / 3) /
         (1 + 0.3 * std::sqrt(plane * depth_m / p.skin_n_per_m));
}

TEST(Contact, FilmIsThatOfFiniteElements) {
  std::ifstream table(STYLET_FILM_TABLE);
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  ASSERT_EQ(line, "youngs_pa,poisson,membrane_n_per_m,depth_m,force_n");
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    Press p = {};
    double depth_m = 0, force_n = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &p.youngs_pa, &p.poisson,
                          &p.skin_n_per_m, &depth_m, &force_n),
              5);
    EXPECT_NEAR(film_n(p, depth_m) / force_n, 1, 0.05) << line;
    const double plane_pa = p.youngs_pa / (1 - p.poisson * p.poisson);
    const float kernel_n =
        film_force_n(static_cast<float>(plane_pa), static_cast<float>(p.skin_n_per_m),
                     static_cast<float>(depth_m));
    EXPECT_NEAR(static_cast<double>(kernel_n) / film_n(p, depth_m), 1, 1e-5) << line;
  }
  EXPECT_EQ(rows, 60);
}

// Force on a tip in tissue that stiffens, over that in tissue that does not, by finite elements
// (stiff_tip.py): for Poisson's ratio, stiffening times the square of the cotangent of the half
// angle, and depth over that at which contact is as wide as the needle.
struct StiffTip {
  double poisson, strained, depth, ratio;
};

std::vector<StiffTip> stiff_tips() {
  std::vector<StiffTip> rows;
  std::ifstream table(STYLET_STIFF_TIP_TABLE);
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "poisson,stiffening,depth,ratio");
  while (std::getline(table, line)) {
    StiffTip& row = rows.emplace_back();
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &row.poisson, &row.strained, &row.depth,
                          &row.ratio),
              4);
  }
  return rows;
}

TEST(Contact, StiffTipIsThatOfFiniteElements) {
  const std::vector<StiffTip> rows = stiff_tips();
  ASSERT_EQ(rows.size(), 128U);
  for (const StiffTip& row : rows) {
    const StifferTip of =
        stiffer_tip(static_cast<float>(row.strained), 1, static_cast<float>(row.poisson));
    const double shallow = static_cast<double>(of.shallow), deep = static_cast<double>(of.deep);
    // Over the force of unit slope at unit depth.
    const auto law = [&](double steep, double slope) {
      const double wide = std::min(row.depth, slope / steep);
      return steep * wide * wide / 2 + slope * (row.depth - wide);
    };
    const double ratio = law(shallow, deep) / law(1, 1);
    EXPECT_NEAR(ratio / row.ratio, 1, row.depth > 4 ? 0.26 : 0.17)
        << "nu " << row.poisson << ", b cot^2 " << row.strained << ", depth " << row.depth;
  }
  const StifferTip none = stiffer_tip(0, 3.7F, 0.45F);
  EXPECT_EQ(none.shallow, 1);
  EXPECT_EQ(none.deep, 1);
}

TEST(Contact, TissueThatStiffensIsFeltAtTheTipWhateverTheVoxel) {
  constexpr std::uint16_t kVoxels = 24;
  const std::vector<StiffTip> rows = stiff_tips();
  DoubleDraw draw(2);
  int seen = 0;
  for (int i = 0; i < 100; ++i) {
    const StiffTip& row = rows[draw.bits() % rows.size()];
    Press p = {draw.between(0.2e-3, 1.5e-3), draw.between(8, 40) * kPi / 180,
               draw.between(2.5e-3, 7e-3), row.poisson, 0};
    p.place = {0, static_cast<float>(draw.between(0, 0.5)),
               static_cast<float>(draw.between(0, 0.5))};
    const double tangent = std::tan(p.half_angle_rad);
    p.depth_m = row.depth * kPi * p.radius_m / (2 * tangent);
    TinyMaterial m;
    m.strain_stiffening = static_cast<float>(row.strained * tangent * tangent);
    const double expected = row.ratio * p.sneddon_n(p.depth_m), crush = expected / p.crush_n();
    if (crush > 3 || p.depth_m > 12e-3 || p.depth_m < 0.5e-3 || m.strain_stiffening > 100 ||
        row.depth > 4) {
      continue;
    }
    Rig rig = rig_of(p, kVoxels, m);
    const double force = force_at_rest(rig, start_of(p, kVoxels), p.depth_m);
    EXPECT_NEAR(force / expected, 1, 0.17)
        << "draw " << i << ": radius " << p.radius_m << " m, half angle " << p.half_angle_rad
        << ", voxel " << p.edge_m << " m, nu " << p.poisson << ", depth " << p.depth_m << " m, b "
        << m.strain_stiffening << ", force " << crush << " G h^2";
    ++seen;
  }
  EXPECT_GT(seen, 25);
}

// Under a thin skin, too, tissue that stiffens more is never softer. (Where the bare tissue would
// have carried the force of puncture at a smaller depth the skin was forgotten.)
TEST(Contact, StiffeningMoreIsNeverSofterUnderAThinSkin) {
  constexpr std::uint16_t kVoxels = 16;
  DoubleDraw draw(8);
  for (int i = 0; i < 4; ++i) {
    Press p = {draw.between(0.4e-3, 0.8e-3), 15 * kPi / 180, 5e-3, 0.45, draw.between(1e-3, 3e-3)};
    p.youngs_pa = 23200;
    p.skin_n_per_m = draw.between(50, 200);
    TinyMaterial m;
    m.puncture_force_n = static_cast<float>(draw.between(0.5, 0.9));
    double before = 0;
    for (const float stiffening : {0.0F, 5.0F, 10.0F, 20.0F, 44.0F, 200.0F}) {
      m.strain_stiffening = stiffening;
      Rig rig = rig_of(p, kVoxels, m);
      const double force = force_at_rest(rig, start_of(p, kVoxels), p.depth_m);
      EXPECT_GT(force, 0.99 * before) << "draw " << i << ", b " << stiffening;
      before = force;
    }
  }
}

// A skin's contact is a film's, whatever its tissue: so what holds a tip in it must not be stiffer
// either. (In a skin of 20 N/mm an elastic needle got 10 kN and gave energy to the hand.)
TEST(Contact, ATipInASkinIsHeldAsIfNothingStiffened) {
  Press p = {0.6e-3, 15 * kPi / 180, 5e-3, 0.45, 0};
  p.skin_n_per_m = 20000;
  float held_n_per_m[2] = {};
  for (const bool stiffens : {false, true}) {
    TinyMaterial m;
    m.strain_stiffening = stiffens ? 44 : 0;
    Rig rig = rig_of(p, 4, m);
    View view = view_of(rig.session.kernel);
    Particle tip = {};
    tip.material = 1;
    set_stiffness(view.model, view.state, tip, Role::kTip);
    held_n_per_m[stiffens] = tip.stiffness_n_per_m;
  }
  EXPECT_GT(held_n_per_m[0], 0);
  EXPECT_EQ(held_n_per_m[1], held_n_per_m[0]);
}

// The last moment of contact before a slow needle punctures the skin. Beyond 12 G h^2 voxels are
// softer than the film (PHYSICS 18.4).
TEST(Contact, ThinSkinIsPuncturedAtTheDepthOfAFilmWhateverTheVoxelItIsSpreadOver) {
  constexpr std::uint16_t kVoxels = 24;
  DoubleDraw draw(3);
  int seen = 0;
  for (int i = 0; i < 64; ++i) {
    Press p = {draw.between(0.2e-3, 1.5e-3), draw.between(8, 40) * kPi / 180,
               draw.between(2.5e-3, 7e-3), draw.between(0.3, 0.48), draw.between(1e-3, 10e-3)};
    p.place = {0, static_cast<float>(draw.between(0, 0.5)),
               static_cast<float>(draw.between(0, 0.5))};
    p.youngs_pa = draw.between(5e3, 60e3);
    p.skin_n_per_m = std::exp(draw.between(std::log(30), std::log(5000)));
    TinyMaterial m;
    m.puncture_force_n = static_cast<float>(std::max(film_n(p, p.depth_m), p.sneddon_n(p.depth_m)));
    const double crush = static_cast<double>(m.puncture_force_n) / p.crush_n();
    if (crush > 12) continue;
    Rig rig = rig_of(p, kVoxels, m);
    double force = 0, depth = 0;
    drive(rig, start_of(p, kVoxels), static_cast<float>(1.2 * p.depth_m), 0.01F,
          [&](const Output& out) {
            if (out.phase != Phase::kContact) return;
            force = -static_cast<double>(out.force_n.x);
            depth = static_cast<double>(out.tip_m.x);
          });
    const double expected = std::max(film_n(p, depth), p.sneddon_n(depth));
    EXPECT_NEAR(force / expected, 1, 0.05)
        << "draw " << i << ": radius " << p.radius_m << " m, half angle " << p.half_angle_rad
        << ", voxel " << p.edge_m << " m, nu " << p.poisson << ", E " << p.youngs_pa << " Pa, skin "
        << p.skin_n_per_m << " N/m, depth " << depth << " m, force " << crush << " G h^2";
    ++seen;
  }
  EXPECT_GT(seen, 40);
}

// On the way there it is a film's, too, from a tenth of that depth on: over the expected force, the
// least and the most. Beyond 12 G h^2 voxels are softer.
struct Range {
  double least = 10, most = 0;
};

Range followed_film(const Press& p, std::uint16_t voxels) {
  TinyMaterial m;
  m.puncture_force_n = static_cast<float>(film_n(p, p.depth_m));
  Rig rig = rig_of(p, voxels, m);
  Range range;
  const Vec3 start_m = start_of(p, voxels), touched_m = {kFirstM, start_m.y, start_m.z};
  drive(rig, start_m, kFirstM, 0.05F);
  drive(rig, touched_m, static_cast<float>(p.depth_m), 0.01F, [&](const Output& out) {
    const double depth = static_cast<double>(out.tip_m.x);
    if (out.phase != Phase::kContact || depth < 0.1 * p.depth_m) return;
    if (film_n(p, depth) > 12 * p.crush_n()) return;
    const double ratio = -static_cast<double>(out.force_n.x) / film_n(p, depth);
    range = {std::min(range.least, ratio), std::max(range.most, ratio)};
  });
  EXPECT_GT(range.most, 0);
  return range;
}

TEST(Contact, ThinSkinIsAFilmOnTheWayToItsPuncture) {
  constexpr std::uint16_t kVoxels = 24;
  DoubleDraw draw(6);
  int seen = 0;
  for (int i = 0; i < 48; ++i) {
    Press p = {draw.between(0.2e-3, 1.5e-3), draw.between(8, 40) * kPi / 180,
               draw.between(2.5e-3, 7e-3), draw.between(0.3, 0.48), draw.between(2e-3, 10e-3)};
    p.place = {0, static_cast<float>(draw.between(0, 0.5)),
               static_cast<float>(draw.between(0, 0.5))};
    p.youngs_pa = draw.between(5e3, 60e3);
    p.skin_n_per_m = std::exp(draw.between(std::log(30), std::log(5000)));
    const double crush = film_n(p, p.depth_m) / p.crush_n();
    if (crush > 12 || film_n(p, p.depth_m) < p.sneddon_n(p.depth_m)) continue;
    const Range range = followed_film(p, kVoxels);
    std::printf("film %d: %.3f to %.3f\n", i, range.least, range.most);
    EXPECT_GT(range.least, 0.93) << "draw " << i;
    EXPECT_LT(range.most, 1.07) << "draw " << i << ": voxel " << p.edge_m << " m, E " << p.youngs_pa
                                << " Pa, skin " << p.skin_n_per_m << " N/m, depth " << p.depth_m
                                << " m, force " << crush << " G h^2";
    ++seen;
  }
  EXPECT_GT(seen, 30);
}

// The usual needle on a liver's capsule, wherever it is in the voxels.
TEST(Contact, LiversCapsuleIsAFilmWhateverTheVoxel) {
  DoubleDraw draw(7);
  for (const double edge_m : {7e-3, 5e-3, 3.3e-3, 2.5e-3}) {
    for (const double depth_m : {3e-3, 5e-3}) {
      Press p = {0.635e-3, 15 * kPi / 180, edge_m, 0.45, depth_m, 23200};
      p.place = {0, static_cast<float>(draw.between(0, 0.5)),
                 static_cast<float>(draw.between(0, 0.5))};
      p.skin_n_per_m = 1000;
      const Range range = followed_film(p, 24);
      EXPECT_GT(range.least, 0.95) << edge_m << " m, to " << depth_m << " m";
      EXPECT_LT(range.most, 1.05) << edge_m << " m, to " << depth_m << " m";
      std::printf("%g mm, %g mm deep: %.3f to %.3f\n", 1e3 * edge_m, 1e3 * depth_m, range.least,
                  range.most);
    }
  }
}

// A layer of 10 mm over tissue that is softer or stiffer, from one voxel thick to four: the tissue
// below adds its own compliance.
TEST(Contact, ALayerIsFeltAlikeWhateverTheVoxel) {
  DoubleDraw draw(5);
  for (int i = 0; i < 12; ++i) {
    const double upper = std::exp(draw.between(std::log(0.1), std::log(10)));
    const Vec3 place = {0, static_cast<float>(draw.between(0, 0.5)),
                        static_cast<float>(draw.between(0, 0.5))};
    const double radius = draw.between(0.3e-3, 0.8e-3), depth = draw.between(1e-3, 5e-3);
    double force[3] = {};
    for (int fine = 0; fine < 3; ++fine) {
      const std::uint16_t voxels[] = {8, 16, 32}, thick[] = {1, 2, 4};
      const Press p = {radius, 15 * kPi / 180, 80e-3 / voxels[fine], 0.45, depth, 20e3, place};
      Rig rig = rig_of(p, voxels[fine], {}, upper, thick[fine]);
      force[fine] = force_at_rest(rig, start_of(p, voxels[fine]), depth);
    }
    EXPECT_NEAR(force[0] / force[2], 1, 0.03) << upper << " times, " << depth << " m deep";
    EXPECT_NEAR(force[1] / force[2], 1, 0.03) << upper << " times, " << depth << " m deep";
  }
}

// On lines of nodes, of edge midpoints, of voxel centres, and between them; in voxel edges.
constexpr Vec3 kPlaces[] = {
    {0, 0, 0}, {0, 0, 0.5F}, {0, 0.25F, 0.25F}, {0, 0.5F, 0.25F}, {0, 0.5F, 0.5F}};

// The usual needle, pressed to the same depth in voxels that are twice and four times as fine.
TEST(Contact, NeitherVoxelNorPlaceIsFelt) {
  for (const double edge_m : {10e-3, 5e-3, 2.5e-3}) {
    for (const Vec3 place : kPlaces) {
      for (const double depth_m : {1e-3, 2e-3, 4e-3}) {
        const Press p = {0.635e-3, 15 * kPi / 180, edge_m, 0.45, depth_m, kYoungsPa, place};
        Rig rig = rig_of(p, 20);
        EXPECT_NEAR(force_at_rest(rig, start_of(p, 20), depth_m) / p.sneddon_n(depth_m), 1, 0.03)
            << "voxel " << edge_m << " m, depth " << depth_m << " m, at " << place.y << ", "
            << place.z;
      }
    }
  }
}

// Long before contact is as wide as the needle it is that of a cone: the force is proportional to
// the tangent of the half angle.
TEST(Contact, ShallowOneGoesAsTheTangentOfTheHalfAngle) {
  for (const double degrees : {5.0, 15.0, 40.0, 60.0, 80.0}) {
    const Press p = {1.5e-3, degrees * kPi / 180, 5e-3, 0.45, 0.2e-3};
    Rig rig = rig_of(p, 12);
    const double force = force_at_rest(rig, start_of(p, 12), p.depth_m);
    const double cone = 2 / kPi * kYoungsPa / (1 - 0.45 * 0.45) * std::tan(p.half_angle_rad) *
                        p.depth_m * p.depth_m;
    EXPECT_NEAR(force / cone, 1, 0.03) << degrees << " degrees";
  }
}

// How far a force presses the lattice in, divided by the force, in 1 / (G h); the force, in G h^2;
// the sum of the squared weights, and the sum of these times the distance from the voxel's middle
// at which they act.
struct Give {
  double per_force, force, squares, beside;
};

Give give_of(double poisson, Vec3 place, double depth_in_edges, std::uint16_t voxels,
             double upper = 1) {
  constexpr double kEdgeM = 5e-3;
  const Press p = {kEdgeM / 4, 80 * kPi / 180, kEdgeM, poisson, 0, kYoungsPa, place};
  Rig rig = rig_of(p, voxels, {}, upper);
  const double force = force_at_rest(rig, start_of(p, voxels), depth_in_edges * kEdgeM);
  View view = needle_view(rig.view(), 0);
  Give give = {0, force / p.crush_n(), 0, 0};
  for (std::uint32_t i = 0; i < view.state.tip->support_count; ++i) {
    const Support& s = view.state.tip->support[i];
    const double w = static_cast<double>(s.weight), y = static_cast<double>(s.offset_m.y);
    const double z = static_cast<double>(s.offset_m.z);
    const Vec3 centre = rest_centre(view.model, s.slot, view.model.row[s.row]);
    give.per_force += w * static_cast<double>(s.goal_m.x - centre.x - s.offset_m.x);
    give.squares += w * w;
    give.beside += w * w * (y * y + z * z) / (kEdgeM * kEdgeM);
  }
  give.per_force *= p.shear_pa() * kEdgeM / force;
  return give;
}

// The constants kSurfaceGive and those after it (PHYSICS 8.4): how far the lattice itself gives way
// under a small force, in blocks of 16 and of 32 voxels, and, extrapolated from both, in an
// infinite one.
TEST(Contact, LatticeGivesWayAsTheFormulaSays) {
  for (const double poisson : {0.3, 0.39, 0.48}) {
    for (const Vec3 place : kPlaces) {
      const Give coarse = give_of(poisson, place, 0.05, 16),
                 fine = give_of(poisson, place, 0.05, 32);
      const double endless = 2 * fine.per_force - coarse.per_force;
      const double formula = 0.170 - 0.101 * poisson + 0.097 * fine.squares + 0.281 * fine.beside;
      EXPECT_NEAR(formula / endless, 1, 0.015)
          << "nu " << poisson << ", at " << place.y << ", " << place.z;
      for (const double depth : {0.5, 1.0, 1.5}) {  // to 3 G h^2
        const Give pressed = give_of(poisson, place, depth, 12);
        const double grown = 1 + (0.06 - 0.1 * fine.squares) * pressed.force;
        EXPECT_NEAR(pressed.per_force / coarse.per_force / grown, 1, 0.03)
            << "nu " << poisson << ", at " << place.y << ", " << place.z << ", " << pressed.force
            << " G h^2";
      }
    }
  }
}

// And how far it gives way under a layer of voxels that is stiffer or softer (kPlaceMean and the
// constants after it); the sums of squares and places are those of a single tissue.
TEST(Contact, LatticeGivesWayBelowAnotherLayerAsTheFormulaSays) {
  DoubleDraw draw(4);
  for (int i = 0; i < 24; ++i) {
    const double poisson = draw.between(0.3, 0.48);
    const double upper = std::exp(draw.between(std::log(0.1), std::log(50)));
    const Vec3 place = {0, static_cast<float>(draw.between(0, 0.5)),
                        static_cast<float>(draw.between(0, 0.5))};
    const Give even = give_of(poisson, place, 0.05, 16);
    const Give coarse = give_of(poisson, place, 0.05, 16, upper);
    const Give fine = give_of(poisson, place, 0.05, 32, upper);
    const double endless = 2 * fine.per_force - coarse.per_force;
    const double at = 0.097 * even.squares + 0.281 * even.beside;
    const double part = std::clamp(1 - 0.43 * std::log(upper), 0.0, 2.0);
    const double formula = (0.170 - 0.101 * poisson + 0.03 + part * (at - 0.03)) /
                           std::pow((1 + 2.3 * std::sqrt(upper)) / 3.3, 0.58);
    EXPECT_NEAR(formula / endless, 1, 0.06)
        << "nu " << poisson << ", at " << place.y << ", " << place.z << ", " << upper << " times";
  }
}

// A ramp, then a hold: the part that has relaxed approaches phi F with the material's time.
TEST(Contact, AllOfItRelaxesAsWritten) {
  constexpr std::uint16_t kVoxels = 12;
  TinyMaterial relaxing;
  relaxing.relaxing_fraction = 0.5F;
  relaxing.relaxation_time_s = 0.4F;
  for (const double youngs_pa : {5e3, 20e3, 60e3}) {
    for (const float speed_m_per_s : {0.002F, 0.02F, 0.1F}) {
      const Press p = {0.635e-3, 15 * kPi / 180, 5e-3, 0.45, 4e-3, youngs_pa};
      Rig rig = rig_of(p, kVoxels, relaxing);
      const Vec3 start = start_of(p, kVoxels);
      double missing = 0, worst = 0;
      int ticks = 0;
      const auto see = [&](const Output& out) {
        const double whole = p.sneddon_n(std::max(static_cast<double>(out.tip_m.x), 0.0));
        missing += (1 - std::exp(-1e-3 / 0.4)) * (0.5 * whole - missing);
        const bool moving = ++ticks < 100;  // of the tissue, whose inertia is felt
        const double off = -static_cast<double>(out.force_n.x) - (whole - missing);
        if (out.tip_m.x > 3.999e-3F && !moving) worst = std::max(worst, std::fabs(off));
      };
      drive(rig, start, 4e-3F, speed_m_per_s, see);
      ticks = 0;
      for (int i = 0; i < 2000; ++i) see(move_tip(rig, {4e-3F, start.y, start.z}));
      EXPECT_LT(worst / p.sneddon_n(p.depth_m), 0.03)
          << youngs_pa << " Pa at " << speed_m_per_s << " m/s";
    }
  }
}

}  // namespace
}  // namespace stylet::test
