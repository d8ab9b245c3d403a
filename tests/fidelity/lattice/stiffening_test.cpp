// SPDX-License-Identifier: Apache-2.0
// V29: tissue that stiffens with its strain (PHYSICS 2.7). Forces are the slope of an energy that
// the reference computes from principal stretches; bars, sheared and swollen blocks have closed
// forms; no motion is stiffer than the step was made for; what a block swings with is kept.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "reference_cluster.h"
#include "rig.h"
#include "step_energy.h"

namespace stylet::test {
namespace {

constexpr double kMost = 10;  // limits.h, kMaxStiffer; PHYSICS 2.7

struct Draw {
  std::mt19937_64 random;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  double magnitude(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  Vec within(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Mat rotation(double most_rad) {
    return Eigen::AngleAxisd(between(0, most_rad), within(1).normalized()).toRotationMatrix();
  }
  // Principal stretches within `size` of 1, along any axes.
  Mat stretch(double size) {
    const Mat axes = rotation(3.1);
    return axes * (Vec::Ones() + within(size)).asDiagonal() * axes.transpose();
  }
};

struct Tissue {
  double shear_pa, poisson, stiffening;

  double lambda_pa() const { return 2 * shear_pa * poisson / (1 - 2 * poisson); }
  // Energy per volume of principal strains.
  double energy(const Vec& strain) const {
    const double shape = (strain - Vec::Constant(strain.mean())).squaredNorm();
    return shear_pa * (strain.squaredNorm() + stiffening_of(stiffening, shape)) +
           0.5 * lambda_pa() * strain.sum() * strain.sum();
  }
  // Slope of the energy along a direction.
  double stress(const Vec& strain, const Vec& along) const {
    constexpr double kStep = 1e-6;
    return (energy(strain + kStep * along) - energy(strain - kStep * along)) / (2 * kStep);
  }
};

// Soft, so that node_forces clamps no velocity; forces go with the modulus.
Tissue draw_tissue(Draw& draw) {
  return {draw.magnitude(2, 200), draw.between(0, 0.48), draw.magnitude(1, 500)};
}

TinyMaterial material_of(const Tissue& tissue) {
  TinyMaterial out =
      elastic(static_cast<float>(tissue.shear_pa), static_cast<float>(tissue.poisson));
  out.strain_stiffening = static_cast<float>(tissue.stiffening);
  return out;
}

// Displaces all nodes as a homogeneous deformation does.
void deform(Rig& rig, const Mat& gradient) {
  View view = rig.view();
  const double edge = static_cast<double>(view.model.head->edge_m);
  for_each_node(view, [&](Node node) {
    const Vec rest = edge * in_edges(node);
    place(view, node_index(view, node), gradient * rest - rest);
  });
}

// ---- forces

TEST(FidelityV29, ForcesAreTheSlopeOfTheEnergy) {
  Draw draw{std::mt19937_64(29)};
  for (int i = 0; i < 200; ++i) {
    const Tissue tissue = draw_tissue(draw);
    const double edge = draw.between(1e-3, 8e-3), spring = tissue.shear_pa * edge;
    ReferenceVoxel voxel = resting_voxel(edge, spring);
    voxel.hourglass_weight = 1.0 / 3;
    voxel.volume_ratio = tissue.lambda_pa() / (2 * tissue.shear_pa);
    voxel.stiffening = tissue.stiffening;
    const Mat turned = draw.rotation(3);
    for (Vec& x : voxel.corner) x = turned * x + draw.within(edge / 4);
    Rig rig = make_rig(block_of(1, 1, 1, material_of(tissue), static_cast<float>(edge)),
                       resting_config(1.0F / 3, static_cast<float>(tissue.poisson), 1));
    const auto node_of = [&](std::uint32_t c) {
      return node_index(rig.view(), {c & 1U, (c >> 1U) & 1U, c >> 2U});
    };
    for (std::uint32_t c = 0; c < 8; ++c) {
      place(rig.view(), node_of(c), voxel.corner[c] - corner_offset(c, edge));
    }
    let_rotations_follow(rig);
    const std::vector<Vec> forces = node_forces(rig);
    const double step = 1e-6 * edge;
    const double scale = (1 + voxel.volume_ratio + kMost) * spring * edge;
    for (std::uint32_t c = 0; c < 8; ++c) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        double& at = voxel.corner[c][axis];
        const double here = at;
        at = here + step;
        const double ahead = voxel_energy(voxel);
        at = here - step;
        const double behind = voxel_energy(voxel);
        at = here;
        ASSERT_NEAR(forces[node_of(c)][axis], (behind - ahead) / (2 * step), 1e-5 * scale)
            << "draw " << i << ", b " << tissue.stiffening << ", nu " << tissue.poisson;
      }
    }
  }
}

// The energy that the kernel reports is that energy.
TEST(FidelityV29, ReportedEnergyIsThatOfThePrincipalStrains) {
  Draw draw{std::mt19937_64(30)};
  for (int i = 0; i < 60; ++i) {
    const Tissue tissue = draw_tissue(draw);
    Rig rig = make_rig(block_of(2, 3, 2, material_of(tissue)),
                       resting_config(1.0F / 3, static_cast<float>(tissue.poisson), 3));
    const Mat stretch = draw.stretch(0.3);
    deform(rig, draw.rotation(2) * stretch);
    const Vec strain = Eigen::SelfAdjointEigenSolver<Mat>(stretch).eigenvalues() - Vec::Ones();
    const double volume = 12 * std::pow(0.005, 3);
    const double wanted = volume * tissue.energy(strain);
    EXPECT_NEAR(energy(rig.session.kernel).elastic / wanted, 1, 1e-3) << "draw " << i;
  }
}

// ---- bodies with closed forms

// A bar pulled by a drawn strain, its sides free: they give way until nothing presses on them.
TEST(FidelityV29, UniaxialBarFollowsItsLaw) {
  Draw draw{std::mt19937_64(31)};
  for (int i = 0; i < 16; ++i) {
    Tissue tissue = draw_tissue(draw);
    tissue.poisson = draw.between(0, 0.45);
    const double along = draw.between(-0.15, 0.25), edge = draw.between(2e-3, 7e-3);
    const auto sides = static_cast<std::uint16_t>(1 + i % 3);
    Rig rig = make_rig(block_of(sides, 2, 4, material_of(tissue), static_cast<float>(edge)),
                       resting_config(1.0F / 3, 0.45F, 8));
    View view = rig.view();
    for_each_node(view, [&](Node node) {
      const std::uint32_t at = node_index(view, node);
      if (node.z == 0) hold(rig, at, 2, 0);
      if (node.z == 4) hold(rig, at, 2, along * 4 * edge);
      if (node.x == 0) hold(rig, at, 0, 0);
      if (node.y == 0) hold(rig, at, 1, 0);
    });
    settle(rig);
    double force = 0;
    for (const Hold& held : rig.holds) {
      if (held.axis == 2 && held.displacement_m != 0) force -= held.force_n;
    }
    double across = -tissue.poisson * along;  // where the energy is least
    for (double size = 0.05; size > 1e-9; size /= 2) {
      const auto at = [&](double e) { return tissue.energy({e, e, along}); };
      if (at(across + size) < at(across)) across += size;
      if (at(across - size) < at(across)) across -= size;
    }
    const double wanted = tissue.stress({across, across, along}, {0, 0, 1});
    EXPECT_NEAR(force / (edge * edge * sides * 2) / wanted, 1, 1e-4)
        << "strain " << along << ", b " << tissue.stiffening << ", nu " << tissue.poisson;
  }
}

// A block sheared by g, every node of its surface held: the work of the next bit of shear.
TEST(FidelityV29, ShearedBlockFollowsItsLaw) {
  Draw draw{std::mt19937_64(32)};
  for (int i = 0; i < 16; ++i) {
    const Tissue tissue = draw_tissue(draw);
    const double shear = draw.between(-0.6, 0.6);
    Rig rig = make_rig(block_of(3, 3, 3, material_of(tissue)), resting_config(1.0F / 3, 0.45F, 3));
    const auto gradient_of = [](double g) {
      Mat f = Mat::Identity();
      f(0, 2) = g;
      return f;
    };
    deform(rig, gradient_of(shear));
    let_rotations_follow(rig);
    View view = rig.view();
    const std::vector<Vec> forces = node_forces(rig);
    double force = 0;
    for_each_node(view, [&](Node node) {
      if (node.z == 3) force -= forces[node_index(view, node)].x();
    });
    const auto energy_of = [&](double g) {
      return tissue.energy(Eigen::JacobiSVD<Mat>(gradient_of(g)).singularValues() - Vec::Ones());
    };
    const double wanted = (energy_of(shear + 1e-6) - energy_of(shear - 1e-6)) / 2e-6;
    EXPECT_NEAR(force / (225e-6 * wanted), 1, 1e-4)
        << "shear " << shear << ", b " << tissue.stiffening << ", nu " << tissue.poisson;
  }
}

// What swells or shrinks alike in all directions does not change its shape: it stays linear.
TEST(FidelityV29, ChangeOfVolumeAloneDoesNotStiffen) {
  Draw draw{std::mt19937_64(33)};
  for (int i = 0; i < 16; ++i) {
    const Tissue tissue = draw_tissue(draw);
    const double swelling = draw.between(-0.2, 0.3);
    Rig rig = make_rig(block_of(2, 2, 2, material_of(tissue)), resting_config(1.0F / 3, 0.45F, 2));
    deform(rig, (1 + swelling) * draw.rotation(2));
    let_rotations_follow(rig);
    const double bulk = 2 * tissue.shear_pa + 3 * tissue.lambda_pa();
    const double wanted = 8 * std::pow(0.005, 3) * 1.5 * bulk * swelling * swelling;
    EXPECT_NEAR(energy(rig.session.kernel).elastic / wanted, 1, 2e-3) << "swelling " << swelling;
    Vec sum = Vec::Zero();
    double size = 0;
    View view = rig.view();
    const std::vector<Vec> forces = node_forces(rig);
    for_each_node(view, [&](Node node) {
      const Vec f = forces[node_index(view, node)];
      sum += f;
      size += f.norm();
    });
    EXPECT_LT(sum.norm(), 1e-4 * size);
    // A corner of the block: three faces of a quarter of a voxel's face each.
    const double corner = bulk * std::abs(swelling) * 25e-6 / 4 * std::sqrt(3.0);
    EXPECT_NEAR(forces[node_index(view, {0, 0, 0})].norm() / corner, 1, 1e-4);
  }
}

// ---- the step

// PHYSICS 3.2: no motion of a strained voxel is stiffer than what the step is made for.
TEST(FidelityV29, NoMotionIsStifferThanTheBound) {
  Draw draw{std::mt19937_64(34)};
  double nearest = 0;
  for (int i = 0; i < 300; ++i) {
    const Tissue tissue = {1, draw.between(0, 0.49), draw.magnitude(1, 1000)};
    ReferenceVoxel voxel = resting_voxel(1, 1);
    voxel.hourglass_weight = 1.0 / 3;
    voxel.volume_ratio = tissue.lambda_pa() / 2;
    voxel.stiffening = tissue.stiffening;
    const Mat stretch = draw.rotation(3) * draw.stretch(0.3);
    for (Vec& x : voxel.corner) x = stretch * x;
    Eigen::Matrix<double, 24, 24> second;
    constexpr double kStep = 1e-4;
    const auto moved = [&](Eigen::Index a, double by_a, Eigen::Index b, double by_b) {
      ReferenceVoxel at = voxel;
      at.corner[static_cast<std::size_t>(a / 3)][a % 3] += by_a;
      at.corner[static_cast<std::size_t>(b / 3)][b % 3] += by_b;
      return voxel_energy(at);
    };
    for (Eigen::Index a = 0; a < 24; ++a) {
      for (Eigen::Index b = 0; b <= a; ++b) {
        second(a, b) = second(b, a) = (moved(a, kStep, b, kStep) - moved(a, kStep, b, -kStep) -
                                       moved(a, -kStep, b, kStep) + moved(a, -kStep, b, -kStep)) /
                                      (4 * kStep * kStep);
      }
    }
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>>;
    const double stiffest = Solver(second, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    const double bound = 1 + std::max(1.25 * kMost, 3 * voxel.volume_ratio);
    EXPECT_LT(stiffest, bound * (1 + 1e-4)) << "draw " << i << ", b " << tissue.stiffening;
    nearest = std::max(nearest, stiffest / bound);
  }
  EXPECT_GT(nearest, 0.9);  // a bound that is far away would be paid for by every tick
}

// A free block, deformed far and let go: no step adds energy, however stiff the tissue gets.
TEST(FidelityV29, SwingingBlockGainsNoEnergy) {
  Draw draw{std::mt19937_64(35)};
  for (int i = 0; i < 24; ++i) {
    Tissue tissue = draw_tissue(draw);
    tissue.shear_pa = draw.magnitude(500, 50000);
    TinyMaterial material = material_of(tissue);
    material.density_kg_per_m3 = 1000;
    Config config;
    config.inertia = i % 2 == 0 ? Inertia::kTrueMass : Inertia::kAddedMass;
    config.substeps = static_cast<std::uint32_t>(1 + i % 3);
    config.surround_drag_per_s = 0;
    Rig rig = make_rig(block_of(3, 4, 3, material), config);
    deform(rig, draw.rotation(2) * draw.stretch(0.25));
    let_rotations_follow(rig);
    const Kernel& kernel = rig.session.kernel;
    const double start = tissue_energy(kernel, energy(kernel));
    double before = start, most_gain = 0;
    for (int tick = 0; tick < 400; ++tick) {
      kernel.step(kernel);
      const double now = tissue_energy(kernel, energy(kernel));
      if (tick > 0) most_gain = std::max(most_gain, now - before);
      before = now;
    }
    EXPECT_LT(before, start) << "draw " << i;
    EXPECT_LT(most_gain, 0.02 * start) << "draw " << i << ", b " << tissue.stiffening;
  }
}

}  // namespace
}  // namespace stylet::test
