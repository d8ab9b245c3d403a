// SPDX-License-Identifier: Apache-2.0
// The first resonance, which reports name: against beams in closed form, and against the kernel's
// own lattice after a push, with added and with true mass, of one and of several levels.

#include "stylet/resonance.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "graded.h"
#include "rig.h"
#include "set_speed.h"

namespace stylet::test {
namespace {

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// A beam held at its low z end.
TinyOrgan beam(std::uint16_t nx, std::uint16_t ny, std::uint16_t nz, const TinyMaterial& material,
               double edge_m) {
  TinyOrgan tiny = block_of(nx, ny, nz, material, static_cast<float>(edge_m));
  tiny.fixed_faces = kLowZ;
  return tiny;
}

// Bernoulli's cantilever with Timoshenko's shear by Dunkerley's rule: 1 / f^2 is the sum of those
// of bending (1.875^2 / (2 pi L^2) sqrt(E I / (rho A))) and of shear (sqrt(5/6 G / rho) / (4 L)).
TEST(Resonance, OfABeamIsItsClosedForm) {
  std::mt19937 random(5);
  for (int round = 0; round < 8; ++round) {
    const double edge_m = between(random, 2e-3, 6e-3);
    TinyMaterial tissue = elastic(static_cast<float>(between(random, 1e3, 3e4)), 0);
    tissue.density_kg_per_m3 = static_cast<float>(between(random, 800, 1200));
    const auto thin = static_cast<std::uint16_t>(3 + random() % 2);
    const auto wide = static_cast<std::uint16_t>(thin + 2),
               nz = static_cast<std::uint16_t>(6 * thin + random() % 12);
    const bool turned = random() % 2 == 0;
    const TinyOrgan tiny =
        turned ? beam(thin, wide, nz, tissue, edge_m) : beam(wide, thin, nz, tissue, edge_m);
    const Rig rig = make_rig(tiny, Config{});
    const double e = static_cast<double>(tissue.youngs_modulus_pa), length = nz * edge_m;
    const double rho = static_cast<double>(tissue.density_kg_per_m3), depth = thin * edge_m;
    const double bending = 1.8751 * 1.8751 / (2 * std::numbers::pi * length * length) *
                           std::sqrt(e * depth * depth / 12 / rho);
    const double shear = std::sqrt(5.0 / 6 * e / 2 / rho) / (4 * length);
    const double expected = 1 / std::hypot(1 / bending, 1 / shear);
    EXPECT_NEAR(first_resonance(rig.session.kernel).real_hz / expected, 1, 0.03)
        << round << ": " << thin << " of " << nz << " voxels";
  }
}

// The lowest frequency at which the body sways after a push, by the peak of its spectrum.
double swaying_hz(Kernel& kernel, Vec3 push, double expected_hz) {
  View view = view_of(kernel);
  const Counts& counts = view.model.head->counts;
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    if (view.model.step_per_mass[i] > 0) set_speed(view, i, push);
  }
  const double dt = static_cast<double>(view.model.head->substep_s);
  const auto steps = static_cast<int>(16 / (expected_hz * dt));
  std::vector<double> sway;
  for (int i = 0; i < steps; ++i) {
    kernel.step(kernel);
    double sum = 0;
    for (std::uint32_t p = 0; p < counts.particles; ++p) {
      sum += static_cast<double>(dot(push, {view.state.ux[p], view.state.uy[p], view.state.uz[p]}));
    }
    sway.push_back(sum);
  }
  double best_hz = 0, most = 0;
  for (double hz = 0.5 * expected_hz; hz < 2 * expected_hz; hz *= 1.002) {
    std::complex<double> sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double window = 1 - std::cos(2 * std::numbers::pi * i / steps);  // Hann's
      sum += window * sway[static_cast<std::size_t>(i)] *
             std::polar(1.0, -2 * std::numbers::pi * hz * dt * i);
    }
    if (std::abs(sum) > most) best_hz = hz;
    most = std::max(most, std::abs(sum));
  }
  return best_hz;
}

TinyMaterial drawn_tissue(std::mt19937& random) {
  TinyMaterial tissue = elastic(static_cast<float>(between(random, 3e3, 3e4)),
                                static_cast<float>(between(random, 0, 0.45)));
  tissue.density_kg_per_m3 = static_cast<float>(between(random, 800, 1200));
  return tissue;
}
TinyMaterial stiffer(std::mt19937& random, TinyMaterial tissue) {
  tissue.youngs_modulus_pa *= static_cast<float>(between(random, 1, 8));
  tissue.density_kg_per_m3 *= static_cast<float>(between(random, 0.7, 1.3));
  return tissue;
}

void expect_it_sways(Kernel& kernel, double bar) {
  const Resonance of = first_resonance(kernel);
  EXPECT_LE(of.stepped_hz, 1.0001 * of.real_hz);
  const double swaying = swaying_hz(kernel, {0.01F, 0, 0}, of.stepped_hz);
  EXPECT_NEAR(of.stepped_hz / swaying, 1, bar) << "really " << of.real_hz << " Hz";
}

// Random beams of two tissues, pushed along the axis in which they are thin. The last one has so
// many voxels that a cell of the estimate holds eight of them.
TEST(Resonance, IsTheFrequencyOfTheLatticeAfterAPush) {
  std::mt19937 random(17);
  for (int round = 0; round < 9; ++round) {
    const bool large = round == 8;
    const TinyMaterial tissue = drawn_tissue(random);
    TinyOrgan tiny = large ? beam(8, 12, 26, tissue, 3e-3)
                           : beam(3, 5, static_cast<std::uint16_t>(9 + random() % 6), tissue,
                                  between(random, 3e-3, 8e-3));
    tiny.materials.push_back(stiffer(random, tissue));
    const auto from = static_cast<std::uint16_t>(random() % tiny.nz);
    tiny.material_at = [from](std::uint16_t, std::uint16_t, std::uint16_t z) {
      return static_cast<std::uint8_t>(z >= from ? 1 : 0);
    };
    Config config;
    config.inertia = round % 2 == 0 ? Inertia::kAddedMass : Inertia::kTrueMass;
    config.substeps = 1 + random() % 2;
    config.surround_drag_per_s = 0;
    Rig rig = make_rig(tiny, config);
    SCOPED_TRACE(round);
    expect_it_sways(rig.session.kernel, large ? 0.05 : 0.02);
  }
}

// Beams with finer voxels here and there, of two tissues.
TEST(Resonance, OfLevelsIsTheFrequencyOfTheirLatticeAfterAPush) {
  std::mt19937 random(29);
  for (unsigned round = 0; round < 8; ++round) {
    const TinyMaterial tissue = drawn_tissue(random), stiff = stiffer(random, tissue);
    Graded graded;
    graded.levels = 2 + round % 2;
    graded.nx = 2, graded.ny = 4, graded.nz = static_cast<std::uint16_t>(6 + random() % 5);
    graded.voxel_edge_m = static_cast<float>(between(random, 4e-3, 8e-3));
    graded.materials = {tissue, stiff};
    const auto from = static_cast<int>(random() % graded.nz);
    graded.material_at = [from](std::uint32_t level, int, int, int z) {
      return static_cast<std::uint8_t>(z >> level >= from ? 1 : 0);
    };
    graded.split = at_random(round, between(random, 0.1, 0.6));
    graded.fixed_faces = kLowZ;
    Config config;
    config.inertia = round / 2 % 2 == 0 ? Inertia::kTrueMass : Inertia::kAddedMass;
    config.substeps = 1 + random() % 2;
    config.surround_drag_per_s = 0;
    Body body = make(graded, config);
    SCOPED_TRACE(round);
    expect_it_sways(body.session.kernel, 0.02);
  }
}

TEST(Resonance, AFreeBodyHasNone) {
  const Rig rig = make_rig(block_of(3, 4, 5, elastic(1e4F, 0.3F)), Config{});
  const Resonance of = first_resonance(rig.session.kernel);
  EXPECT_EQ(of.real_hz, 0);
  EXPECT_FALSE(of.departs_hz < kFastestHandHz);
}

// Nor has a body that is held at every corner.
TEST(Resonance, ABodyThatCannotMoveHasNone) {
  TinyOrgan tiny = beam(3, 3, 1, elastic(1e4F, 0.3F), 5e-3);
  tiny.fixed_faces = kLowZ | kHighZ;
  for (const Inertia inertia : {Inertia::kAddedMass, Inertia::kTrueMass}) {
    Config config;
    config.inertia = inertia;
    const Rig rig = make_rig(tiny, config);
    const Resonance of = first_resonance(rig.session.kernel);
    EXPECT_EQ(of.real_hz, 0);
    EXPECT_EQ(of.stepped_hz, 0);
    EXPECT_FALSE(of.departs_hz < kFastestHandHz);
    Graded graded;
    graded.nx = graded.ny = 3, graded.nz = 1;
    graded.split = [](std::uint32_t, int x, int y, int) { return x == 1 && y == 1; };
    graded.fixed_faces = kLowZ | kHighZ;
    Body body = make(graded, config);
    EXPECT_FALSE(first_resonance(body.session.kernel).departs_hz < kFastestHandHz);
  }
}

// A free piece beside one that is held changes nothing.
TEST(Resonance, LeavesOutFreePieces) {
  TinyOrgan tiny = beam(3, 3, 9, elastic(1e4F, 0.3F), 5e-3);
  const double alone_hz = first_resonance(make_rig(tiny, Config{}).session.kernel).real_hz;
  tiny.nx = 8;
  tiny.inside = [](std::uint16_t x, std::uint16_t, std::uint16_t z) {
    return x < 3 || (x > 4 && z > 2);
  };
  const double beside_hz = first_resonance(make_rig(tiny, Config{}).session.kernel).real_hz;
  EXPECT_NEAR(beside_hz / alone_hz, 1, 1e-6);
}

}  // namespace
}  // namespace stylet::test
