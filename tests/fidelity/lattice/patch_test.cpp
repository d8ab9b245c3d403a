// SPDX-License-Identifier: Apache-2.0
// V8 to V11: bars and plates. The tissue has the modulus, Poisson ratio and bending stiffness that
// its material states, whatever the voxel edge and the step.

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <random>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kStretch = 0.05;

struct Elasticity {
  double youngs_modulus_pa, poisson_ratio;
};

// Holds a bar at its low z face, pulls its high z face; the low x and y faces are planes of
// symmetry, the rest is free.
void pull_bar(Rig& rig) {
  View view = rig.view();
  const ModelHead& head = *view.model.head;
  const double length = static_cast<double>(head.edge_m) * head.size_z;
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    if (node.z == 0) hold(rig, i, 2, 0);
    if (node.z == head.size_z) hold(rig, i, 2, kStretch * length);
    if (node.x == 0) hold(rig, i, 0, 0);
    if (node.y == 0) hold(rig, i, 1, 0);
  });
}

// What a testing machine would measure on the pulled bar: the force on the clamp over its area, and
// the narrowing of the side.
Elasticity read_bar(const Rig& rig) {
  View view = rig.view();
  const ModelHead& head = *view.model.head;
  const double edge = static_cast<double>(head.edge_m);
  double force = 0;
  for (const Hold& held : rig.holds) {
    if (held.axis == 2 && held.displacement_m > 0) force -= held.force_n;
  }
  double narrowing = 0;
  for (std::uint32_t y = 0; y <= head.size_y; ++y) {
    const std::uint32_t i = node_index(view, {head.size_x, y, head.size_z / 2U});
    narrowing -= static_cast<double>(view.state.ux[i]) / (head.size_y + 1);
  }
  return {force / (edge * edge * head.size_x * head.size_y * kStretch),
          narrowing / (edge * head.size_x * kStretch)};
}

// ---- V8

TEST(FidelityV8, UniaxialPatchReturnsYoungsModulusAndPoissonRatioInDouble) {
  for (const double poisson : {0.0, 0.3, 0.45}) {
    ReferenceVoxel voxel = resting_voxel(0.005, 10);  // k = G h, so G = 2 kPa
    voxel.volume_ratio = poisson / (1 - 2 * poisson);
    const Vec stretch(1 - poisson * kStretch, 1 - poisson * kStretch, 1 + kStretch);
    for (Vec& x : voxel.corner) x = stretch.cwiseProduct(x);
    const VoxelForces forces = voxel_forces(voxel);
    const double youngs_modulus = 2 * 2000 * (1 + poisson);
    double axial = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      axial += i < 4 ? 0 : -forces.corner[i].z();
      EXPECT_NEAR(forces.corner[i].x(), 0, 1e-6 * youngs_modulus * kStretch * 2.5e-5);
      EXPECT_NEAR(forces.corner[i].y(), 0, 1e-6 * youngs_modulus * kStretch * 2.5e-5);
    }
    EXPECT_NEAR(axial / (2.5e-5 * kStretch) / youngs_modulus, 1, 1e-6);
  }
}

TEST(FidelityV8, UniaxialPatchReturnsYoungsModulusAndPoissonRatio) {
  for (const float hourglass : {1.0F, 1.0F / 3}) {
    for (const float poisson : {0.0F, 0.3F, 0.45F}) {
      const TinyMaterial material = elastic(2000, poisson);
      Rig rig = make_rig(block_of(3, 4, 8, material), resting_config(hourglass, poisson, 8));
      pull_bar(rig);
      settle(rig);
      const Elasticity read = read_bar(rig);
      EXPECT_NEAR(read.youngs_modulus_pa / static_cast<double>(material.youngs_modulus_pa), 1, 3e-5)
          << "nu " << poisson;
      EXPECT_NEAR(read.poisson_ratio, static_cast<double>(poisson), 3e-5);
    }
  }
}

double lambda_of(const Elasticity& e) {
  return e.youngs_modulus_pa * e.poisson_ratio /
         ((1 + e.poisson_ratio) * (1 - 2 * e.poisson_ratio));
}

// A bar of skin throughout, one voxel thick or several. In tension its modulus is the tissue's plus
// the skin's modulus times thickness over the edge, for any Poisson ratio of the tissue. Its
// lambda, and so the speed of pressure waves, is the tissue's.
TEST(FidelityV8, SkinAddsToTensionAloneWhateverTheVoxelAndTheTissue) {
  std::mt19937 random(29);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 12; ++round) {
    const double edge = between(2e-3, 7e-3), skin = between(50, 2000);
    const auto poisson = static_cast<float>(between(0, 0.47));
    TinyMaterial material = elastic(static_cast<float>(between(1e3, 2e4)), poisson);
    const double tissue = static_cast<double>(material.youngs_modulus_pa);
    material.membrane_n_per_m = static_cast<float>(skin);
    const auto thick = static_cast<std::uint16_t>(1 + round % 3);
    Rig rig = make_rig(block_of(3, thick, 6, material, static_cast<float>(edge)),
                       resting_config(1.0F / 3, poisson, 6));
    pull_bar(rig);
    settle(rig);
    const Elasticity read = read_bar(rig);
    EXPECT_NEAR(read.youngs_modulus_pa / (tissue + skin / edge), 1, 1e-4)
        << edge << " m, " << skin << " N/m, nu " << poisson << ", tissue " << tissue << " Pa";
    EXPECT_NEAR(lambda_of(read), lambda_of({tissue, static_cast<double>(poisson)}),
                1e-4 * (tissue + skin / edge));
  }
}

// ---- V9

TEST(FidelityV9, ModulusDependsNeitherOnVoxelEdgeNorOnStep) {
  TinyMaterial material = elastic(1800, 0);
  material.density_kg_per_m3 = 1060;
  for (const float edge : {0.0025F, 0.005F}) {
    for (const float step_s : {0.25e-3F, 0.5e-3F, 1e-3F}) {
      const auto across = static_cast<std::uint16_t>(0.0201F / edge);
      const auto along = static_cast<std::uint16_t>(2 * across);
      Config config = sweep_config();
      config.period_s = step_s;
      config.surround_drag_per_s = 100;
      Rig rig = make_rig(block_of(across, across, along, material, edge), config);
      pull_bar(rig);
      settle(rig, 1e-7);
      EXPECT_NEAR(read_bar(rig).youngs_modulus_pa / 3600, 1, 1e-4)
          << "edge " << edge << " m, step " << step_s << " s";
    }
  }
}

// E = alpha rho h^2 / (4 dt^2), whatever the material says: the artefact of averaged goals.
TEST(FidelityV9b, PaperModeHasTheModulusOfAveragedGoals) {
  TinyMaterial material;
  material.density_kg_per_m3 = 1060;
  Config config = sweep_config();
  config.mode = Mode::kPaper;
  config.tissue_damping_s = 0;
  config.surround_drag_per_s = 100;
  Rig rig = make_rig(block_of(4, 4, 8, material), config);
  pull_bar(rig);
  settle(rig, 1e-7);
  const Elasticity read = read_bar(rig);
  EXPECT_NEAR(read.youngs_modulus_pa / 3312.5, 1, 1e-4);
  EXPECT_NEAR(read.poisson_ratio, 0, 1e-4);
}

// ---- V10

TEST(FidelityV10, LayersInSeriesGiveTheHarmonicMean) {
  TinyOrgan tiny = block_of(3, 3, 10, elastic(1000, 0));
  tiny.materials.push_back(elastic(10000, 0));
  tiny.material_at = [](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return static_cast<std::uint8_t>(z % 5 < 2 ? 1 : 0);
  };
  Rig rig = make_rig(tiny, resting_config(1.0F / 3, 0, 10));
  pull_bar(rig);
  settle(rig);
  EXPECT_NEAR(read_bar(rig).youngs_modulus_pa * (0.6 / 2000 + 0.4 / 20000), 1, 1e-4);
}

// ---- V11

// Bends a plate one voxel wide and `layers` thick by turning its end faces against each other.
// Returns the moment over that of Euler and Bernoulli.
double bending_ratio(int layers, float hourglass) {
  constexpr std::uint16_t kLength = 8;
  constexpr double kShear = 2000;
  Rig rig = make_rig(block_of(kLength, 1, static_cast<std::uint16_t>(layers),
                              elastic(static_cast<float>(kShear), 0)),
                     resting_config(hourglass, 0, kLength));
  View view = rig.view();
  const double edge = static_cast<double>(view.model.head->edge_m);
  const double curvature = 1e-3 / edge;
  const auto place_of = [&](Node node) {  // from the middle of the plate
    return Vec(edge * (in_edges(node) - Vec(kLength / 2.0, 0, layers / 2.0)));
  };
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    const Vec p = place_of(node);
    place(view, i, Vec(curvature * p.x() * p.z(), 0, -0.5 * curvature * p.x() * p.x()));
    if (node.x == 0 || node.x == kLength) hold(rig, i, 0, curvature * p.x() * p.z());
    if (node.y == 0) hold(rig, i, 1, 0);
    if (node.x == kLength / 2 && node.z == 0) hold(rig, i, 2, 0);
  });
  settle(rig);
  double moment = 0;
  std::size_t at = 0;
  for_each_node(view, [&](Node node) {
    if (node.x != kLength) return;
    while (rig.holds[at].node != node_index(view, node) || rig.holds[at].axis != 0) ++at;
    moment -= rig.holds[at].force_n * place_of(node).z();
  });
  const double thickness = edge * layers;
  return moment / (2 * kShear * edge * std::pow(thickness, 3) / 12 * curvature);
}

TEST(FidelityV11, PlateBendsAsThePlainOrWeightedHourglassTermSays) {
  for (const float hourglass : {1.0F, 1.0F / 3}) {
    for (const int layers : {1, 2, 3, 4, 6}) {
      const double square = layers * layers;
      const double wanted = 1 - 1 / square + 3 * static_cast<double>(hourglass) / square;
      EXPECT_NEAR(bending_ratio(layers, hourglass) / wanted, 1, 5e-4)
          << layers << " layers, chi " << hourglass;
    }
  }
}

}  // namespace
}  // namespace stylet::test
