// SPDX-License-Identifier: Apache-2.0
// The tip in contact is the rigid cone that goes over into a cylinder of Sneddon 1965, for any
// needle, tissue and voxel, and all of it relaxes as the material says.
//
// With E* = E / (1 - nu^2), radius R and half angle a: F = (2 / pi) E* tan(a) d^2 until contact is
// as wide as the needle, at l = pi R / (2 tan a), then 2 R E* more for each metre. The half space
// is a block of 24 voxels a side, held at its far face.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kYoungsPa = 10000;

struct Press {
  double radius_m, half_angle_rad, edge_m, poisson, depth_m, youngs_pa = kYoungsPa;
  Vec3 place = {};  // of the tip beside the middle, in voxel edges

  double shear_pa() const { return youngs_pa / (2 * (1 + poisson)); }
  double sneddon_n(double depth) const {
    const double plane = youngs_pa / (1 - poisson * poisson);
    const double wide = kPi * radius_m / (2 * std::tan(half_angle_rad));
    const double cone = std::min(depth, wide);
    return 2 / kPi * plane * std::tan(half_angle_rad) * cone * cone +
           2 * radius_m * plane * (depth - cone);
  }
  // Forces that press a voxel to a fraction of its height are some of these.
  double crush_n() const { return shear_pa() * edge_m * edge_m; }
};

Rig rig_of(const Press& p, std::uint16_t voxels, TinyMaterial m = {}) {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = voxels;
  tiny.voxel_edge_m = static_cast<float>(p.edge_m);
  tiny.fixed_faces = kHighX;
  m.youngs_modulus_pa = static_cast<float>(p.youngs_pa);
  m.poisson_ratio = static_cast<float>(p.poisson);
  m.puncture_force_n = 1000;
  tiny.materials = {m};
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

// At rest, pressed in slowly.
double force_at_rest(Rig& rig, Vec3 start_m, double depth_m) {
  const auto depth = static_cast<float>(depth_m);
  // 50 um in a tick are pressed in to the first; of less, up to 20 um are not noticed.
  constexpr float kFirstM = 50e-6F;
  drive(rig, start_m, kFirstM, 0.05F);
  drive(rig, {kFirstM, start_m.y, start_m.z}, depth, 0.05F);
  return -static_cast<double>(hold(rig, {depth, start_m.y, start_m.z}, 600).force_n.x);
}

struct Draw {
  std::mt19937_64 engine;
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11U) * 0x1p-53;
  }
};

TEST(Contact, IsSneddonsConeForAnyNeedleTissueAndVoxel) {
  constexpr std::uint16_t kVoxels = 24;
  Draw draw = {std::mt19937_64(1)};
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

// Along a line of nodes, of edge midpoints, of voxel centres and between; in voxel edges.
constexpr Vec3 kPlaces[] = {
    {0, 0, 0}, {0, 0, 0.5F}, {0, 0.25F, 0.25F}, {0, 0.5F, 0.25F}, {0, 0.5F, 0.5F}};

// The usual needle; the same depth in voxels twice and four times as fine.
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

// Long before contact is as wide as the needle, it is that of a cone: force with the tangent of the
// half angle.
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

// How far a force presses the lattice in, over the force, in 1 / (G h); the force in G h^2; the
// sums of the squared weights, and of these times how far beside the voxel's middle they act.
struct Give {
  double per_force, force, squares, beside;
};

Give give_of(double poisson, Vec3 place, double depth_in_edges, std::uint16_t voxels) {
  constexpr double kEdgeM = 5e-3;
  const Press p = {kEdgeM / 4, 80 * kPi / 180, kEdgeM, poisson, 0, kYoungsPa, place};
  Rig rig = rig_of(p, voxels);
  const double force = force_at_rest(rig, start_of(p, voxels), depth_in_edges * kEdgeM);
  const View view = needle_view(rig.view(), 0);
  Give give = {0, force / p.crush_n(), 0, 0};
  for (std::uint32_t i = 0; i < view.state.tip->share_count; ++i) {
    const Share& s = view.state.tip->share[i];
    const double w = static_cast<double>(s.weight), y = static_cast<double>(s.offset_m.y);
    const double z = static_cast<double>(s.offset_m.z);
    const Vec3 centre = rest_centre(view, s.slot, view.model.row[s.row]);
    give.per_force += w * static_cast<double>(s.goal_m.x - centre.x - s.offset_m.x);
    give.squares += w * w;
    give.beside += w * w * (y * y + z * z) / (kEdgeM * kEdgeM);
  }
  give.per_force *= p.shear_pa() * kEdgeM / force;
  return give;
}

// The constants of coupling.cpp, kSurfaceGive and those behind it: what the lattice itself gives
// under a small force, in a block of 12 and of 24 voxels, and from both in one without an end.
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

// A ramp, then held: the missing force follows phi F by the written time.
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
        const bool moving = ++ticks < 100;  // of the tissue: its inertia is felt
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
