// SPDX-License-Identifier: Apache-2.0
// V2 to V7: one voxel with its constraint particles, and a free block, against double precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "reference_cluster.h"
#include "reference_lattice.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kEdge = 0.005F;
constexpr double kEdgeD = static_cast<double>(kEdge);
constexpr float kShear = 2000;
constexpr double kSpring = static_cast<double>(kShear) * kEdgeD;
// Forces of the float kernel are compared on this scale: one spring stretched by one voxel edge.
constexpr double kForceScale = kSpring * kEdgeD;

struct Draw {
  std::mt19937_64 random{1407};

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec within(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Mat rotation(double most_rad) {
    return Eigen::AngleAxisd(between(0, most_rad), within(1).normalized()).toRotationMatrix();
  }
};

// A voxel in a random position and rotation, its corners and constraint particles displaced by up
// to a third of an edge.
ReferenceVoxel draw_voxel(Draw& draw, std::size_t particles) {
  ReferenceVoxel voxel = resting_voxel(kEdgeD, kSpring);
  const Mat turned = draw.rotation(2.5);
  const Vec moved = draw.within(3 * kEdgeD);
  const auto placed = [&](const Vec& rest) {
    return Vec(turned * rest + moved + draw.within(kEdgeD / 3));
  };
  for (std::size_t i = 0; i < 8; ++i) voxel.corner[i] = placed(corner_offset(i, kEdgeD));
  for (std::size_t i = 0; i < particles; ++i) {
    const Vec rest = draw.within(0.7 * kEdgeD);
    voxel.held.push_back({rest, placed(rest), kSpring * std::exp(draw.between(-1, 3.4))});
  }
  return voxel;
}

// The same voxel in the kernel, after its rotation has converged.
Rig rig_of(const ReferenceVoxel& voxel, float poisson) {
  const auto chi = static_cast<float>(voxel.hourglass_weight);
  Rig rig = make_rig(block_of(1, 1, 1, elastic(kShear, poisson)), resting_config(chi, poisson, 1));
  View view = rig.view();
  const Vec middle = Vec::Constant(kEdgeD / 2);
  for (std::uint32_t i = 0; i < 8; ++i) {
    place(view, node_index(view, {i & 1U, (i >> 1U) & 1U, i >> 2U}),
          voxel.corner[i] - corner_offset(i, kEdgeD) - middle);
  }
  for (const FitPoint& p : voxel.held) {
    hold_constraint_particle(rig, {0, 0, 0}, to_float(p.rest), to_float(p.place - p.rest - middle),
                             static_cast<float>(p.weight));
  }
  let_rotations_follow(rig);
  return rig;
}

std::array<Vec, 8> corner_forces(Rig& rig) {
  const std::vector<Vec> all = node_forces(rig);
  std::array<Vec, 8> out;
  for (std::uint32_t i = 0; i < 8; ++i) {
    out[i] = all[node_index(rig.view(), {i & 1U, (i >> 1U) & 1U, i >> 2U})];
  }
  View seen = rig.view();
  measure_forces(seen.model, seen.state);
  return out;
}

// ---- V2

// Largest deviation from orthonormal of the stored rotation of a stretched voxel that sways.
double worst_while_swaying(Draw& draw, int steps) {
  Rig rig = make_rig(block_of(1, 1, 1, elastic(kShear, 0)), resting_config(1, 0, 1));
  View view = rig.view();
  const Mat axes = draw.rotation(3);
  const Mat stretched = axes * Vec(1.1, 0.95, 1).asDiagonal() * axes.transpose();
  const Vec axis = draw.within(1).normalized();
  const std::uint32_t slot = view.model.voxel_slot[0];
  State& s = view.state;
  double worst = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.3 * std::sin(0.01 * i);
    const Mat placed = Eigen::AngleAxisd(angle, axis) * stretched - Mat::Identity();
    for (std::uint32_t c = 0; c < 8; ++c) {
      place(view, node_index(view, {c & 1U, (c >> 1U) & 1U, c >> 2U}),
            placed * corner_offset(c, kEdgeD));
    }
    rig.session.kernel.step(rig.session.kernel);
    if (i % 100 != 0) continue;
    const Mat r = Eigen::Quaternionf(s.qw[slot], s.qx[slot], s.qy[slot], s.qz[slot])
                      .cast<double>()
                      .toRotationMatrix();
    worst = std::max(worst, (r.transpose() * r - Mat::Identity()).cwiseAbs().maxCoeff());
  }
  return worst;
}

// Only the step itself keeps the stored quaternion at length 1, however long it runs.
TEST(FidelityV2, StoredRotationStaysOrthonormalInMovingTissue) {
  Draw draw;
  for (int i = 0; i < 8; ++i) EXPECT_LT(worst_while_swaying(draw, 300000), 1e-6) << "draw " << i;
}

// ---- V3

TEST(FidelityV3, RigidMotionStretchesNothingInDouble) {
  Draw draw;
  for (int i = 0; i < 200; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, 3);
    voxel.volume_ratio = 4.5;
    voxel.hourglass_weight = 1.0 / 3;
    const Mat turned = draw.rotation(3.14);
    const Vec moved = draw.within(3 * kEdgeD);
    for (std::size_t c = 0; c < 8; ++c) {
      voxel.corner[c] = turned * corner_offset(c, kEdgeD) + moved;
    }
    for (FitPoint& p : voxel.held) p.place = turned * p.rest + moved;
    const VoxelForces forces = voxel_forces(voxel);
    for (const Vec& f : forces.corner) ASSERT_LT(f.norm() / kSpring, 1e-12 * kEdgeD);
    for (const Vec& f : forces.held) ASSERT_LT(f.norm() / kSpring, 1e-12);
  }
}

TEST(FidelityV3, RigidMotionOfABlockMakesNoForceInTheKernel) {
  Draw draw;
  for (const float poisson : {0.0F, 0.45F}) {
    for (int i = 0; i < 20; ++i) {
      Rig rig = make_rig(block_of(4, 3, 5, elastic(kShear, poisson)),
                         resting_config(1.0F / 3, poisson, 4));
      View view = rig.view();
      const Mat turned = draw.rotation(3.0);
      const Vec middle = kEdgeD * Vec(2, 1.5, 2.5);
      const Vec moved = middle - turned * middle + draw.within(kEdgeD);
      for_each_node(view, [&](Node node) {
        const Vec rest = kEdgeD * in_edges(node);
        place(view, node_index(view, node), turned * rest + moved - rest);
      });
      const Vec rest = kEdgeD * Vec(1.7, 1.4, 2.6);
      hold_constraint_particle(rig, {1, 1, 2}, to_float(rest - kEdgeD * Vec(1.5, 1.5, 2.5)),
                               to_float(turned * rest + moved - rest), 8 * kShear * kEdge);
      let_rotations_follow(rig);
      // How far a particle is from the mean of its clusters' goals: force over the sum of springs.
      const std::vector<Vec> forces = node_forces(rig);
      double worst = 0;
      for_each_node(view, [&](Node node) {
        const std::uint32_t n = node_index(view, node);
        const float springs = view.model.hourglass_n_per_m[n] / view.model.head->hourglass_weight;
        worst = std::max(worst, forces[n].norm() / static_cast<double>(springs));
      });
      measure_forces(view.model, view.state);
      worst = std::max(worst, to_vec(view.state.shaft[0].force_n).norm() / (8 * kSpring));
      EXPECT_LT(worst, 8e-6 * kEdgeD) << "nu " << poisson << ", draw " << i;
    }
  }
}

// ---- V4

TEST(FidelityV4, ReferenceForcesAreTheGradientOfTheEnergy) {
  Draw draw;
  for (int i = 0; i < 50; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, 3);
    voxel.hourglass_weight = i % 2 == 0 ? 1 : 1.0 / 3;
    voxel.volume_ratio = i % 3 == 0 ? 0 : 4.5;
    const VoxelForces forces = voxel_forces(voxel);
    const double step = 1e-5 * kEdgeD;
    double scale = 0;
    for (const Vec& f : forces.corner) scale = std::max(scale, f.norm());
    const auto slope = [&](double& coordinate) {
      const double here = coordinate;
      coordinate = here + step;
      const double above = voxel_energy(voxel);
      coordinate = here - step;
      const double below = voxel_energy(voxel);
      coordinate = here;
      return (above - below) / (2 * step);
    };
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (std::size_t c = 0; c < 8; ++c) {
        ASSERT_NEAR(slope(voxel.corner[c][axis]), -forces.corner[c][axis], 1e-7 * scale);
      }
      for (std::size_t p = 0; p < voxel.held.size(); ++p) {
        ASSERT_NEAR(slope(voxel.held[p].place[axis]), forces.held[p][axis], 1e-7 * scale);
      }
    }
  }
}

// With the volume term, too, the kernel's matches and forces are those of the reference.
TEST(FidelityV4, KernelForcesAgreeWithTheReference) {
  Draw draw;
  for (int i = 0; i < 60; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, static_cast<std::size_t>(i % 5));
    const float poisson = i % 2 == 0 ? 0.0F : 0.3F;
    voxel.volume_ratio = i % 2 == 0 ? 0 : 0.75;
    voxel.hourglass_weight = i % 3 == 0 ? 1 : 1.0 / 3;
    Rig rig = rig_of(voxel, poisson);
    const VoxelForces wanted = voxel_forces(voxel);
    const std::array<Vec, 8> corner = corner_forces(rig);
    for (std::size_t c = 0; c < 8; ++c) {
      EXPECT_LT((corner[c] - wanted.corner[c]).norm() / kForceScale, 3e-6) << "draw " << i;
    }
    for (std::size_t p = 0; p < voxel.held.size(); ++p) {
      const double weight = std::max(1.0, voxel.held[p].weight / kSpring);
      EXPECT_LT((to_vec(rig.view().state.shaft[p].force_n) - wanted.held[p]).norm(),
                3e-6 * kForceScale * weight)
          << "draw " << i << ", particle " << p;
    }
  }
}

// ---- ghosts

TEST(FidelityGhosts, ClosedFormAgreesWithGhostsAsRealParticles) {
  Draw draw;
  for (int i = 0; i < 40; ++i) {
    const ReferenceVoxel voxel = draw_voxel(draw, 1 + static_cast<std::size_t>(i % 4));
    Rig rig = rig_of(voxel, 0);
    const Vec middle = Vec::Constant(kEdgeD / 2);
    const Fit ghosts = fit_with_ghosts(voxel, middle);
    const std::array<Vec, 8> corner = corner_forces(rig);
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec goal = ghosts.goal(corner_offset(c, kEdgeD));
      EXPECT_LT((corner[c] + kSpring * (voxel.corner[c] - goal)).norm() / kForceScale, 3e-6)
          << "draw " << i;
    }
    for (std::size_t p = 0; p < voxel.held.size(); ++p) {
      const Vec goal = to_vec(rig.view().state.shaft[p].support[0].goal_m);
      EXPECT_LT((goal - ghosts.goal(voxel.held[p].rest)).norm(), 3e-6 * kEdgeD)
          << "draw " << i << ", particle " << p;
    }
  }
}

// ---- V5

TEST(FidelityV5, ForceAndTorqueOfAVoxelBalanceInDouble) {
  Draw draw;
  for (int i = 0; i < 200; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, static_cast<std::size_t>(i % 5));
    voxel.volume_ratio = 4.5;
    voxel.hourglass_weight = 1.0 / 3;
    const VoxelForces forces = voxel_forces(voxel);
    Vec force = Vec::Zero(), torque = Vec::Zero();
    double size = 0, arm = 0;
    const auto add = [&](const Vec& x, const Vec& f) {
      force += f;
      torque += x.cross(f);
      size += f.norm();
      arm += x.norm() * f.norm();
    };
    for (std::size_t c = 0; c < 8; ++c) add(voxel.corner[c], forces.corner[c]);
    for (std::size_t p = 0; p < voxel.held.size(); ++p) {
      add(voxel.held[p].place, -forces.held[p]);
    }
    ASSERT_LT(force.norm(), 1e-13 * size);
    ASSERT_LT(torque.norm(), 1e-13 * arm);
  }
}

TEST(FidelityV5, WhatTheNeedleFeelsIsWhatTheTissueGets) {
  Draw draw;
  for (int i = 0; i < 60; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, 1 + static_cast<std::size_t>(i % 5));
    voxel.hourglass_weight = 1.0 / 3;
    Rig rig = rig_of(voxel, 0.45F);
    const std::array<Vec, 8> corner = corner_forces(rig);
    Vec force = Vec::Zero(), torque = Vec::Zero();
    double size = 0, arm = 0;
    const auto add = [&](const Vec& x, const Vec& f) {
      force += f;
      torque += x.cross(f);
      size += f.norm();
      arm += x.norm() * f.norm();
    };
    for (std::size_t c = 0; c < 8; ++c) add(voxel.corner[c], corner[c]);
    for (std::size_t p = 0; p < voxel.held.size(); ++p) {
      add(voxel.held[p].place, -to_vec(rig.view().state.shaft[p].force_n));
    }
    EXPECT_LT(force.norm(), 2e-6 * size) << "draw " << i;
    EXPECT_LT(torque.norm(), 2e-6 * arm) << "draw " << i;
  }
}

// ---- V6

struct Momentum {
  Vec linear = Vec::Zero(), angular = Vec::Zero();
  double size = 0, arm = 0;  // sums of magnitudes

  void add(double kg, const Vec& x, const Vec& v) {
    linear += kg * v;
    angular += kg * x.cross(v);
    size += kg * v.norm();
    arm += kg * x.norm() * v.norm();
  }
};

Vec velocity_of(const View& view, std::uint32_t i) {
  return {static_cast<double>(view.state.vx[i]), static_cast<double>(view.state.vy[i]),
          static_cast<double>(view.state.vz[i])};
}

Momentum momentum_of(const View& view) {
  Momentum sum;
  const double step_s = static_cast<double>(view.model.head->substep_s);
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    sum.add(step_s / static_cast<double>(view.model.step_per_mass[i]),
            kEdgeD * in_edges(node) + displacement_of(view, i), velocity_of(view, i));
  });
  return sum;
}

// Velocity at a place of a body that turns about `centre`.
Vec spin(const Vec& place, const Vec& centre) {
  return Vec(3, -2, 4).cross(place - centre);
}

// A free block, at rest or turning about its middle. Its particles are displaced at random, by up
// to a fraction of an edge.
Rig free_block(float damping_s, bool turning, double crumple = 0.1) {
  Config config = sweep_config();
  config.tissue_damping_s = damping_s;
  config.surround_drag_per_s = 0;
  TinyMaterial material = elastic(kShear, 0.3F);
  material.density_kg_per_m3 = 1060;
  Rig rig = make_rig(block_of(4, 4, 4, material), config);
  View view = rig.view();
  Draw draw;
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    place(view, i, draw.within(crumple * kEdgeD));
    const Vec where = kEdgeD * in_edges(node) + displacement_of(view, i);
    const Vec v = turning ? spin(where, Vec::Constant(2 * kEdgeD)) : Vec::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Motion m = motion(view, axis);
      m.v[i] = static_cast<float>(v[static_cast<Eigen::Index>(axis)]);
      m.e[i] = m.u[i] + damping_s * m.v[i];
    }
  });
  return rig;
}

struct Drift {
  double linear = 0, angular = 0;
};

// Largest change in 1000 steps, relative to the largest sum of magnitudes in these steps.
Drift drift_of(Rig rig) {
  const Momentum before = momentum_of(rig.view());
  Drift worst;
  double size = 0, arm = 0;
  for (int i = 0; i < 1000; ++i) {
    step(rig);
    const Momentum now = momentum_of(rig.view());
    size = std::max(size, now.size);
    arm = std::max(arm, now.arm);
    worst.linear = std::max(worst.linear, (now.linear - before.linear).norm());
    worst.angular = std::max(worst.angular, (now.angular - before.angular).norm());
  }
  return {worst.linear / size, worst.angular / arm};
}

TEST(FidelityV6, FreeBlockKeepsItsMomentaInDouble) {
  ReferenceVoxel material = resting_voxel(kEdgeD, kSpring);
  material.volume_ratio = 0.75;
  material.hourglass_weight = 1.0 / 3;
  ReferenceBlock block = reference_block(3, material, 1060 * kEdgeD * kEdgeD * kEdgeD / 8);
  Draw draw;
  for (std::size_t i = 0; i < block.place.size(); ++i) {
    block.place[i] += draw.within(0.1 * kEdgeD);
    block.velocity[i] = spin(block.place[i], Vec::Constant(1.5 * kEdgeD));
  }
  const auto momentum = [&] {
    Momentum sum;
    for (std::size_t i = 0; i < block.place.size(); ++i) {
      sum.add(block.kg[i], block.place[i], block.velocity[i]);
    }
    return sum;
  };
  const Momentum before = momentum();
  for (int i = 0; i < 1000; ++i) step_block(block, 5e-4);
  const Momentum after = momentum();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-10 * before.size);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.arm);
}

TEST(FidelityV6, FreeBlockAtRestKeepsItsMomentaInTheKernel) {
  const Drift drift = drift_of(free_block(0, false));
  EXPECT_LT(drift.linear, 1e-5);
  EXPECT_LT(drift.angular, 1e-5);
}

TEST(FidelityV6, TurningBlockKeepsItsMomentaInTheKernel) {
  const Drift drift = drift_of(free_block(0, true));
  EXPECT_LT(drift.linear, 1e-4);
  EXPECT_LT(drift.angular, 1e-4);
}

// Damping evaluates the clusters at u + tau v. Their forces have no torque about these positions;
// so about the particles they have -tau sum(v x f), which is small and known.
TEST(FidelityV6, DampingKeepsLinearMomentumAndHasNoTorqueAboutWhereItActs) {
  for (const bool turning : {false, true}) {
    Rig rig = free_block(Config{}.tissue_damping_s, turning);
    View view = rig.view();
    const double step_s = static_cast<double>(view.model.head->substep_s);
    const Momentum start = momentum_of(view);
    double drift = 0, size = 0, torque = 0, arm = 0;
    for (int i = 0; i < 1000; ++i) {
      std::vector<Vec> place, velocity;
      for_each_node(view, [&](Node node) {
        const std::uint32_t k = node_index(view, node);
        place.push_back(kEdgeD * in_edges(node) + Vec(static_cast<double>(view.state.ex[k]),
                                                      static_cast<double>(view.state.ey[k]),
                                                      static_cast<double>(view.state.ez[k])));
        velocity.push_back(velocity_of(view, k));
      });
      step(rig);
      Momentum pushed;  // given by the step, about where the damping acts
      std::size_t at = 0;
      for_each_node(view, [&](Node node) {
        const std::uint32_t k = node_index(view, node);
        pushed.add(step_s / static_cast<double>(view.model.step_per_mass[k]), place[at],
                   velocity_of(view, k) - velocity[at]);
        ++at;
      });
      torque = std::max(torque, pushed.angular.norm());
      arm = std::max(arm, pushed.arm);
      const Momentum now = momentum_of(view);
      drift = std::max(drift, (now.linear - start.linear).norm());
      size = std::max(size, now.size);
    }
    EXPECT_LT(drift, 1e-4 * size);
    EXPECT_LT(torque, 1e-6 * arm);
  }
}

// A block that turns at omega is pulled inwards by m omega^2 r: the torque above brakes it by
// dL/dt = -tau omega^2 L. An organ that swings by 1 rad/s loses a four-thousandth of that a second.
TEST(FidelityV6, DampingBrakesATurningBlockAsItsClosedFormSays) {
  for (const double tau : {0.25e-3, 1e-3}) {
    Rig rig = free_block(static_cast<float>(tau), true, 0);
    for (int i = 0; i < 200; ++i) step(rig);  // the block settles to its stretch
    const double before = momentum_of(rig.view()).angular.norm();
    for (int i = 0; i < 1000; ++i) step(rig);
    const double after = momentum_of(rig.view()).angular.norm();
    const double omega_square = 3 * 3 + 2 * 2 + 4 * 4;
    EXPECT_NEAR(-std::log(after / before) / (tau * omega_square * 1.0), 1, 0.05) << tau;
  }
}

// ---- V7

TEST(FidelityV7, NeutralInsertionChangesNothingInDouble) {
  Draw draw;
  for (int i = 0; i < 200; ++i) {
    ReferenceVoxel voxel = draw_voxel(draw, 0);
    const std::vector<FitPoint> before = points_of(voxel);
    const Fit fit = fit_points(before);
    std::vector<FitPoint> after = before;
    const Vec place = fit.centre + draw.within(kEdgeD);
    after.push_back({fit.rest_centre + fit.rotation.transpose() * (place - fit.centre), place,
                     kSpring * draw.between(0.1, 32)});
    const Fit now = fit_points(after);
    ASSERT_LT((now.rotation - fit.rotation).norm(), 1e-12);
    for (const FitPoint& p : after) {
      ASSERT_LT((now.goal(p.rest) - fit.goal(p.rest)).norm(), 1e-12 * kEdgeD);
    }
    ASSERT_NEAR(fit_energy(after) / fit_energy(before), 1, 1e-12);
  }
}

// The kernel's own insertion: when a needle takes hold of strained tissue, neither feels a force,
// although eight voxels share the new particle, around a place an edge deeper.
TEST(FidelityV7, NeutralInsertionChangesNoForceInTheKernel) {
  Draw draw;
  for (int i = 0; i < 20; ++i) {
    Rig rig = make_rig(block_of(6, 6, 6, elastic(kShear, 0.3F)), resting_config(1.0F / 3, 0.3F, 6));
    View view = rig.view();
    const Mat turned = draw.rotation(2.0);
    for_each_node(view, [&](Node node) {
      const Vec rest = kEdgeD * in_edges(node);
      place(view, node_index(view, node), turned * rest - rest + draw.within(0.1 * kEdgeD));
    });
    let_rotations_follow(rig);
    const std::vector<Vec> before = node_forces(rig);
    const Vec rest = kEdgeD * (Vec::Constant(3) + draw.within(1));
    const Vec where = turned * rest + draw.within(0.2 * kEdgeD);
    const Vec3 tip = to_float(where);
    Needle needle = {};
    needle.tip_m = tip;
    needle.tip_direction = {1, 0, 0};
    begin_contact(view.model, view.state, view.scratch, needle, to_float(rest), tip, 0);
    ASSERT_EQ(view.state.tip->support_count, kSupportsPerParticle);
    gather_coupled(view.model, view.state, view.scratch);
    const std::vector<Vec> after = node_forces(rig);
    let_rotations_follow(rig, 1);  // makes the match from which forces are measured
    measure_forces(view.model, view.state);
    const double weight = static_cast<double>(view.state.tip->stiffness_n_per_m) / kSpring;
    EXPECT_LT(to_vec(view.state.tip->force_n).norm(), 3e-6 * kForceScale * weight);
    double worst = 0;
    for (std::size_t n = 0; n < after.size(); ++n) {
      worst = std::max(worst, (after[n] - before[n]).norm());
    }
    EXPECT_LT(worst, 3e-6 * kForceScale) << "draw " << i;
  }
}

}  // namespace
}  // namespace stylet::test
