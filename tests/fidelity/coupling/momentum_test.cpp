// SPDX-License-Identifier: Apache-2.0
// Action and reaction: the tissue gets the force and torque that the hand feels, and both are the
// sums over the CPs.

#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace stylet::test {
namespace {

struct Vec3d {
  double x = 0, y = 0, z = 0;
};
Vec3d wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vec3d plus(Vec3d a, Vec3d b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3d minus(Vec3d a, Vec3d b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3d times(double s, Vec3d a) {
  return {s * a.x, s * a.y, s * a.z};
}
Vec3d cross_of(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double size(Vec3d a) {
  return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

struct Momentum {
  Vec3d linear, angular;  // about the world's origin
};

// Over the particles of all voxel rows; a particle that rows share is marked, so that it counts
// once.
Momentum momentum(const View& view) {
  Momentum sum = {};
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles, false);
  const double edge = static_cast<double>(head.edge_m);
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t n = 0; n < 4; ++n) {
      for (std::uint32_t i = 0; i <= row.count; ++i) {
        const std::uint32_t p = row.node[n] + i;
        if (seen[p]) continue;
        seen[p] = true;
        const double kg = static_cast<double>(head.substep_s / view.model.step_per_mass[p]);
        const Vec3d rest = {edge * (row.x0 + i), edge * (row.y + (n & 1U)),
                            edge * (view.model.plane[row.plane].z + (n >> 1U))};
        const Vec3d place =
            plus(rest, wide({view.state.ux[p], view.state.uy[p], view.state.uz[p]}));
        const Vec3d push = times(kg, wide({view.state.vx[p], view.state.vy[p], view.state.vz[p]}));
        sum.linear = plus(sum.linear, push);
        sum.angular = plus(sum.angular, cross_of(place, push));
      }
    }
  }
  return sum;
}

// One substep a tick, no drag, no damping, no attachment, no relaxation: a free body that only the
// needle touches.
Rig free_body() {
  TinyOrgan tiny;
  tiny.nx = 6;
  tiny.ny = tiny.nz = 5;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.materials[0].cutting_force_n = 0.05F;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].density_kg_per_m3 = 20000;  // heavy enough to be entered while free
  Config config;
  config.substeps = 1;
  config.tissue_damping_s = 0;
  config.surround_drag_per_s = 0;
  return make_rig(tiny, config);
}

// Force and torque about the origin on the tissue, from what the interface says of each CP.
Momentum impulse_on_tissue(const Kernel& kernel, double period_s) {
  ConstraintParticle list[kMaxConstraintParticles + 1];
  const std::uint32_t count = constraint_particles(kernel, list);
  Momentum sum = {};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d push = times(-period_s, wide(list[i].force_on_needle_n));
    sum.linear = plus(sum.linear, push);
    sum.angular = plus(sum.angular, cross_of(wide(list[i].position_m), push));
  }
  return sum;
}

TEST(Momentum, ForceOnTheNeedleIsTheReactionOfTheTissue) {
  Rig rig = free_body();
  Momentum before = momentum(rig.view());
  double summed = 0, linear_off = 0, angular_off = 0, angular_summed = 0;
  for (int i = 0; i < 900; ++i) {
    const float t = static_cast<float>(i);
    move_tip(rig, {-2e-3F + 40e-6F * t, 12.2e-3F + 2e-6F * t, 13.1e-3F - 1e-6F * t});
    const Momentum now = momentum(rig.view());
    const Momentum impulse = impulse_on_tissue(rig.kernel(), 1e-3);
    linear_off += size(minus(minus(now.linear, before.linear), impulse.linear));
    angular_off += size(minus(minus(now.angular, before.angular), impulse.angular));
    summed += size(impulse.linear);
    angular_summed += size(impulse.angular);
    before = now;
  }
  EXPECT_GE(rig.view().state.needle->shaft_count, 2U);
  EXPECT_LT(linear_off / summed, 1e-4);
  EXPECT_LT(angular_off / angular_summed, 1e-3);
}

TEST(Momentum, WrenchIsTheSumOverTheParticles) {
  TinyOrgan tiny;
  tiny.nx = 8;
  tiny.ny = tiny.nz = 6;
  tiny.fixed_faces = kHighX | kLowZ;
  tiny.materials[0].relaxing_fraction = 0.3F;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].puncture_force_n = 0.1F;
  tiny.materials[0].cutting_force_n = 0.05F;
  Rig rig = make_rig(tiny, Config{});
  for (int i = 0; i < 2500; ++i) {
    const float t = static_cast<float>(i);
    const float side = i > 1500 ? 3e-6F * (t - 1500) : 0;
    const Input input = along_x({-2e-3F + 15e-6F * t, 13e-3F + side, 14e-3F}, rig.length_m);
    const Output out = checked_tick(rig, input);
    ConstraintParticle list[kMaxConstraintParticles + 1];
    const std::uint32_t count = constraint_particles(rig.kernel(), list);
    ASSERT_EQ(count, out.constraint_particles);
    Vec3d force, torque;
    double sizes = 1e-9, arms = 1e-9;
    for (std::uint32_t j = 0; j < count; ++j) {
      const Vec3d f = wide(list[j].force_on_needle_n);
      const Vec3d arm = minus(wide(list[j].position_m), wide(input.handle.position_m));
      force = plus(force, f);
      torque = plus(torque, cross_of(arm, f));
      sizes += size(f);
      arms += size(arm) * size(f);
    }
    ASSERT_LE(size(minus(wide(out.force_n), force)), 1e-6 * sizes) << "tick " << i;
    ASSERT_LE(size(minus(wide(out.torque_nm), torque)), 1e-6 * arms) << "tick " << i;
    Vec3d causes = wide(out.cause.stiffness_n);
    for (const Vec3 part :
         {out.cause.cutting_n, out.cause.friction_n, out.cause.clamping_n, out.cause.obstacle_n}) {
      causes = plus(causes, wide(part));
    }
    ASSERT_LE(size(minus(wide(out.force_n), causes)), 1e-6 * sizes) << "tick " << i;
  }
  EXPECT_GT(rig.view().state.needle->shaft_count, 4U);
}

}  // namespace
}  // namespace stylet::test
