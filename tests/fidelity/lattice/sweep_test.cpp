// SPDX-License-Identifier: Apache-2.0
// V4 for a whole lattice against single voxels in double precision: rows of any length, longer and
// shorter than the group of voxels that the sweep matches at a time, with holes, and with ends at
// different places.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

#include "reference_cluster.h"
#include "rig.h"
#include "variants.h"

namespace stylet::test {
namespace {

constexpr float kEdge = 0.005F;
constexpr double kEdgeD = static_cast<double>(kEdge);
constexpr float kShear = 2000;
constexpr double kSpring = static_cast<double>(kShear) * kEdgeD;
constexpr float kHourglassWeight = 1.0F / 3;

struct RowPlan {
  std::uint32_t begin, count, hole;  // 37 voxels and a hole of so many, in turn
};

// Rows (y, z) that begin anywhere; some are empty, some are one voxel, some are in pieces.
struct Lattice {
  static constexpr std::uint16_t kNx = 420, kNy = 9, kNz = 4;
  RowPlan row[kNz][kNy];

  bool holds(std::uint16_t x, std::uint16_t y, std::uint16_t z) const {
    const RowPlan& r = row[z][y];
    const bool hole = x % (37 + r.hole) >= 37 && r.count > 40;
    return x >= r.begin && x < r.begin + r.count && !hole;
  }
};

Lattice draw_lattice(std::mt19937_64& random) {
  constexpr std::uint32_t kCounts[] = {0, 1, 15, 16, 17, 31, 127, 128, 129, 144, 260, 400};
  constexpr std::uint32_t kHoles[] = {0, 1, 2, 6, 7, 8, 9, 15, 16, 17, 40, 80};
  Lattice lattice = {};
  for (auto& plane : lattice.row) {
    for (RowPlan& row : plane) {
      row.count = kCounts[random() % std::size(kCounts)];
      row.begin = static_cast<std::uint32_t>(random() % (Lattice::kNx - row.count));
      row.hole = kHoles[random() % std::size(kHoles)];
    }
  }
  lattice.row[1][3] = {10, 130, 1};  // the organ has voxels in each plane
  for (auto& plane : lattice.row) plane[4] = {5, 33, 0};
  return lattice;
}

Rig rig_of(const Lattice& lattice) {
  TinyOrgan tiny = block_of(Lattice::kNx, Lattice::kNy, Lattice::kNz, elastic(kShear, 0.3F), kEdge);
  tiny.inside = [lattice](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return lattice.holds(x, y, z);
  };
  return make_rig(tiny, resting_config(kHourglassWeight, 0.3F, 4));
}

Vec residuals(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> any(-size, size);
  return {any(random), any(random), any(random)};
}

// Forces on the corners of all voxels, and on the constraint particles that are in every 80th
// voxel.
struct Expected {
  std::vector<Vec> node, held;
};

template <typename Visit>
void for_each_voxel(const Lattice& lattice, Visit visit) {
  for (std::uint16_t z = 0; z < Lattice::kNz; ++z) {
    for (std::uint16_t y = 0; y < Lattice::kNy; ++y) {
      for (std::uint16_t x = 0; x < Lattice::kNx; ++x) {
        if (lattice.holds(x, y, z)) visit(Node{x, y, z});
      }
    }
  }
}

// Moves all nodes at random, by up to a quarter of an edge.
Expected load(Rig& rig, const Lattice& lattice, std::mt19937_64& random) {
  View view = rig.view();
  std::vector<Vec> moved(view.model.head->counts.particles);
  for (std::uint32_t i = 0; i < moved.size(); ++i) {
    moved[i] = residuals(random, kEdgeD / 4);
    if (view.model.particle_kg[i] > 0) place(view, i, moved[i]);
  }
  Expected wanted = {std::vector<Vec>(moved.size(), Vec::Zero()), {}};
  std::uint32_t voxels = 0;
  for_each_voxel(lattice, [&](Node at) {
    ReferenceVoxel voxel = resting_voxel(kEdgeD, kSpring);
    voxel.hourglass_weight = static_cast<double>(kHourglassWeight);
    voxel.volume_ratio = 0.75;  // nu / (1 - 2 nu)
    const Row& row = view.model.row[voxel_row_of(view, at)];
    std::uint32_t node[8];
    for (std::uint32_t i = 0; i < 8; ++i) {
      node[i] = row.node[i >> 1U] + at.x - row.x0 + (i & 1U);
      voxel.corner[i] += moved[node[i]];
    }
    if (++voxels % 80 == 0) {
      const Vec rest = residuals(random, 0.4 * kEdgeD), to = residuals(random, 0.2 * kEdgeD);
      hold_constraint_particle(rig, at, to_float(rest), to_float(to),
                               static_cast<float>(3 * kSpring));
      voxel.held.push_back({rest, rest + to, 3 * kSpring});
    }
    const VoxelForces forces = voxel_forces(voxel);
    for (std::uint32_t i = 0; i < 8; ++i) wanted.node[node[i]] += forces.corner[i];
    for (const Vec& force : forces.held) wanted.held.push_back(force);
  });
  return wanted;
}

TEST(FidelityV4, SweepAddsUpWhatEveryVoxelSends) {
  // A node adds up the forces of eight voxels, each as near the reference as a single one
  // (cluster_test.cpp).
  constexpr double kTolerance = 8 * 3e-6 * 3 * kSpring * kEdgeD;
  // The place of a constraint particle is a float, at most two metres from the origin.
  constexpr double kHeldTolerance = kTolerance + 3 * kSpring * Lattice::kNx * kEdgeD * 1.2e-7;
  std::mt19937_64 random(2011);
  for (int draw = 0; draw < 6; ++draw) {
    const Lattice lattice = draw_lattice(random);
    for (const Variant& variant : variants_here()) {
      Rig rig = rig_of(lattice);
      rig.session.kernel.step = variant.step;
      const Expected wanted = load(rig, lattice, random);
      ASSERT_GT(wanted.held.size(), 5U);
      let_rotations_follow(rig);
      const std::vector<Vec> forces = node_forces(rig);
      View seen = rig.view();
      measure_forces(seen.model, seen.state);
      double worst = 0;
      for (std::size_t i = 0; i < forces.size(); ++i) {
        if (rig.view().model.particle_kg[i] > 0) {
          worst = std::max(worst, (forces[i] - wanted.node[i]).norm());
        }
      }
      EXPECT_LT(worst, kTolerance) << variant.name << ", draw " << draw;
      for (std::size_t p = 0; p < wanted.held.size(); ++p) {
        const Vec felt = to_vec(rig.view().state.shaft[p].force_n);
        EXPECT_LT((felt - wanted.held[p]).norm(), kHeldTolerance) << variant.name << ", held " << p;
      }
    }
  }
}

// The sweep keeps the sums of a few rows at a time. A window that only one row reaches must not
// read where the sums of another row would be. (It once did, masked, and so read before the sums,
// and in large organs beyond the memory.)
TEST(FidelityV4, WindowsOfOneRowReadNoOther) {
  std::mt19937_64 random(2012);
  const Rig rig = rig_of(draw_lattice(random));
  View view = rig.view();
  const Counts& counts = view.model.head->counts;
  std::uint32_t of_one = 0;
  for (std::uint32_t list = 0; list < 2; ++list) {
    const Window* const window = list == 0 ? view.model.window8 : view.model.window16;
    for (std::uint32_t i = 0; i < counts.windows[list]; ++i) {
      if (window[i].lanes[0] != 0 && window[i].lanes[1] != 0) continue;
      EXPECT_EQ(window[i].slot[0], window[i].slot[1]) << list << ", window " << i;
      ++of_one;
    }
  }
  EXPECT_GT(of_one, 100U);
}

}  // namespace
}  // namespace stylet::test
