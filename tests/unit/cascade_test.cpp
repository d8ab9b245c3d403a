// SPDX-License-Identifier: Apache-2.0
// True mass on a graded lattice: each level moves its own short waves, within its part of the
// step's limit (lattice/shadow.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "graded.h"
#include "graded_parts.h"
#include "lattice/hanging.h"
#include "lattice/shadow.h"
#include "lattice/voxel.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

// The bounds on the lattice's stiffness as an operator on its particles, in doubles and written
// from PHYSICS 3.4: each voxel times the difference of its corners from their mean. Nodes of the
// cascade that are level 0's own come after the others.
class Bounds {
 public:
  explicit Bounds(const View& view) : model_(view.model), shadows_(view.model.head->shadows) {}

  // The largest eigenvalue of a level's mobilities times the stiffness of what they move, found by
  // power iteration: at most what it really is.
  double largest(std::uint32_t level) {
    const std::size_t count = model_.head->counts.cascade + shadows_.first_particle;
    std::vector<double> x(count), y;
    std::mt19937 random(level + 1);
    std::normal_distribution<double> draw;
    for (double& value : x) value = draw(random);
    double size = 0;
    for (int i = 0; i < 300; ++i) {
      for (std::size_t k = 0; k < count; ++k) x[k] *= mobility(level, k);
      y = stiffness_of(x);
      size = 0;
      for (std::size_t k = 0; k < count; ++k) {
        if (!(mobility(level, k) > 0)) y[k] = 0;
        size = std::max(size, std::fabs(y[k]));
      }
      if (!(size > 0)) return 0;
      for (std::size_t k = 0; k < count; ++k) x[k] = y[k] / size;
    }
    return size;
  }

 private:
  std::size_t node_of(std::uint32_t particle) const {
    if (particle >= shadows_.first_particle) return particle - shadows_.first_particle;
    const std::uint32_t* const first = model_.border;
    const std::uint32_t* const end = first + (shadows_.border_end - shadows_.border_begin);
    const std::uint32_t* const at = std::find(first, end, particle);
    if (at != end) return shadows_.border_begin + static_cast<std::size_t>(at - first);
    return model_.head->counts.cascade + particle;
  }

  bool is_own(std::uint32_t level, std::size_t node) const {
    const Shadows& g = shadows_;
    if (level == 0) {
      return (node >= g.border_begin && node < g.shadow_begin[1]) ||
             node >= model_.head->counts.cascade;
    }
    return (node >= g.fine_begin[level] && node < g.fine_begin[level + 1]) ||
           (node >= g.shadow_begin[level] && node < g.shadow_begin[level + 1]);
  }

  double mobility(std::uint32_t level, std::size_t node) const {
    if (!is_own(level, node)) return 0;
    const std::size_t count = model_.head->counts.cascade;
    if (node >= count) {
      return static_cast<double>(model_.step_per_mass[node - count] / model_.head->substep_s);
    }
    const float limit = level == 0 ? shadows_.fastest_per_s2 : shadows_.limit_per_s2[level];
    return static_cast<double>(std::min(model_.cascade_mobility[node],
                                        limit / std::max(model_.cascade_bound[node], 1e-20F)));
  }

  // From the nodes to all that follows from them, through the voxels, and back.
  std::vector<double> stiffness_of(std::vector<double> x) const {
    const HangingShare* const end = model_.up_share + shadows_.up_begin[kMaxLevels];
    for (const HangingShare* s = model_.up_share; s != end;) {
      const HangingShare* const behind = s + s->count;
      for (const std::uint32_t to = s->to; s != behind; ++s) {
        x[to] += static_cast<double>(s->share) * x[s->from];
      }
    }
    std::vector<double> y(x.size());
    for (std::uint32_t voxel = 0; voxel < model_.head->counts.voxels; ++voxel) {
      const Row& row = model_.row[model_.voxel_row[voxel]];
      const std::uint32_t slot = model_.voxel_slot[voxel];
      std::size_t node[8];
      double mean = 0;
      for (std::uint32_t c = 0; c < 8; ++c) {
        node[c] = node_of(particle_of(model_, row.node[c >> 1U] + slot - row.slot + (c & 1U)));
        mean += x[node[c]] / 8;
      }
      const double bound = 8 * static_cast<double>(model_.slot_bound[slot]);
      for (const std::size_t n : node) y[n] += bound * (x[n] - mean);
    }
    for (std::uint32_t p = 0; has_slides(model_) && p < model_.head->counts.particles; ++p) {
      const std::size_t n = node_of(p);
      y[n] += static_cast<double>(model_.slide_room[p]) * x[n];  // what contact may add
    }
    const HangingShare* const down_end = model_.down_share + shadows_.down_begin[0];
    for (const HangingShare* s = model_.down_share; s != down_end;) {
      const HangingShare* const behind = s + s->count;
      for (const std::uint32_t to = s->to; s != behind; ++s) {
        y[to] += static_cast<double>(s->share) * y[s->from];
      }
    }
    return y;
  }

  const Model& model_;
  const Shadows& shadows_;
};

TEST(Cascade, EachLevelStaysWithinItsPartOfTheLimit) {
  // Rounded to floats, bounds and masses are some 1e-4 off.
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 3;
    graded.nx = graded.ny = 3;
    graded.nz = graded.levels == 4 ? 1 : 2;
    graded.split = at_random(seed, 0.4);
    if (seed % 2 == 0) graded.fixed_faces = kLowZ;
    Body body = make(graded, Config{});
    const View view = view_of(body.session.kernel);
    const Shadows& shadows = view.model.head->shadows;
    ASSERT_EQ(shadows.on, 1U) << seed;
    Bounds bounds(view);
    const double coarse = bounds.largest(0) / static_cast<double>(shadows.fastest_per_s2);
    EXPECT_LT(coarse, 1.001) << seed;
    float all_per_s2 = view.model.head->filter.limit_per_s2;
    for (std::uint32_t level = 1; level < graded.levels; ++level) {
      const double limit = static_cast<double>(shadows.limit_per_s2[level]);
      const double part = bounds.largest(level) / limit;
      EXPECT_LT(part, 1.001) << seed << " level " << level;
      EXPECT_GT(part, 0.8) << seed << " level " << level;  // no slower than it must be
      all_per_s2 += shadows.limit_per_s2[level];
    }
    const Config config;
    const float limit = wave_limit_per_s2(view.model.head->substep_s, config.tissue_damping_s);
    EXPECT_LT(all_per_s2, 1.0001F * limit) << seed;
  }
}

// So it is where sheets, tied or apart, have shadows of their own.
TEST(Cascade, EachLevelStaysWithinItsPartInSheets) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 2;
    graded.nx = graded.ny = 3;
    graded.nz = 2;
    graded.split = at_random(seed, 0.5);
    graded.cut = static_cast<std::uint16_t>(1 + seed / 2 % 2);
    graded.joined = seed <= 4;
    Body body = make(graded, Config{});
    const View view = view_of(body.session.kernel);
    const Shadows& shadows = view.model.head->shadows;
    ASSERT_EQ(shadows.on, 1U) << seed;
    const Counts& counts = view.model.head->counts;  // what there is room for
    EXPECT_LE(shadows.shadow_begin[kMaxLevels], counts.cascade) << seed;
    EXPECT_LE(shadows.up_begin[kMaxLevels], counts.shadow_shares) << seed;
    Bounds bounds(view);
    EXPECT_LT(bounds.largest(0) / static_cast<double>(shadows.fastest_per_s2), 1.001) << seed;
    for (std::uint32_t level = 1; level < graded.levels; ++level) {
      const double part = bounds.largest(level) / static_cast<double>(shadows.limit_per_s2[level]);
      EXPECT_LT(part, 1.001) << seed << " level " << level;
      EXPECT_GT(part, 0.1) << seed << " level " << level;
    }
  }
}

// So it is with all that contact of parts that slide may add.
TEST(Cascade, EachLevelStaysWithinItsPartWherePartsSlide) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    GradedParts graded;
    graded.parts.floor_x = graded.parts.lid_x = 3;
    graded.parts.floor_y = graded.parts.lid_y = 3;
    graded.parts.height = 4;
    graded.parts.plane = 1.6F + 0.15F * static_cast<float>(seed);
    graded.parts.slope_x = 0.1F;
    graded.levels = 2 + seed % 2;
    graded.split = at_random(seed, 0.3);
    const std::unique_ptr<OpenOrgan> organ = packed(*graded_parts(graded));
    const Session session = make_session(organ->organ, Config{});
    const View view = view_of(session.kernel);
    const Shadows& shadows = view.model.head->shadows;
    ASSERT_EQ(shadows.on, 1U) << seed;
    Bounds bounds(view);
    EXPECT_LT(bounds.largest(0) / static_cast<double>(shadows.fastest_per_s2), 1.001) << seed;
    for (std::uint32_t level = 1; level < graded.levels; ++level) {
      const double part = bounds.largest(level) / static_cast<double>(shadows.limit_per_s2[level]);
      EXPECT_LT(part, 1.001) << seed << " level " << level;
    }
  }
}

// Tissue so stiff that one level takes six passes: with three, none of it is heavier than it is.
TEST(Cascade, StiffTissueKeepsItsMass) {
  Graded graded;
  graded.nx = graded.ny = graded.nz = 3;
  graded.materials[0].youngs_modulus_pa = 55e3F;
  const auto passes_and_mass = [&](double part) {
    graded.split = at_random(7, part);
    graded.levels = part > 0 ? 3 : 2;
    Body body = make(graded, Config{});
    const MassReport mass = mass_report(body.session.kernel, 0);
    EXPECT_NEAR(mass.stepped_kg, mass.real_kg, 1e-5F * mass.real_kg) << part;
    return filter_passes(body.session.kernel);
  };
  EXPECT_GE(passes_and_mass(0), 6U);
  EXPECT_LE(passes_and_mass(0.3), kMaxFilterPasses);
}

// A body falls as it should: no level adds or takes mass. (A shadow at the edge of the tissue may
// have a sliver of mass, with the stiffness of a whole cell: what such nodes move less or more.)
TEST(Cascade, ABodyInFreeFlightHasItsMass) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 3;
    graded.nx = graded.ny = graded.nz = graded.levels == 4 ? 2 : 3;
    graded.split = at_random(seed, 0.5);
    Config config;
    config.surround_drag_per_s = 0;
    config.gravity_m_per_s2 = {0.03F, -0.07F, 0.11F};
    Body body = make(graded, config);
    const View view = view_of(body.session.kernel);
    double nodes = 0, sum = 0;
    for (int i = 0; i < 2000; ++i) (void)tick(body.session.kernel, Input{});
    const ModelHead& head = *view.model.head;
    double slowest = 1e9, fastest = 0;
    for (std::uint32_t voxel = 0; voxel < head.counts.voxels; ++voxel) {
      const std::uint32_t p = view.model.row[view.model.voxel_row[voxel]].node[0] +
                              view.model.voxel_slot[voxel] -
                              view.model.row[view.model.voxel_row[voxel]].slot;
      const double v = static_cast<double>(view.state.vz[p]);
      slowest = std::min(slowest, v);
      fastest = std::max(fastest, v);
      if (hangs(view.model, p)) continue;
      nodes += 1;
      sum += v;
    }
    // Gravity comes in over the first second: half of it counts there.
    const double wanted = 0.11 * 1.5;
    EXPECT_NEAR(sum / nodes, wanted, 0.03 * wanted) << seed;
    EXPECT_GT(slowest, 0.95 * wanted) << seed;
    EXPECT_LT(fastest, 1.05 * wanted) << seed;
  }
}

// Force swing at the hand while it moves by 1 mm to either side, 12 mm deep, at `hz`.
double swing_n(Kernel& kernel, const Input& held, const Vec3& way, double hz) {
  const int period = static_cast<int>(1000 / hz);
  float low = 1e9F, high = -1e9F;
  for (int i = 0; i < 3 * period; ++i) {
    const auto s = static_cast<float>(std::sin(2 * 3.14159265358979 * hz * i * 1e-3));
    Input input = held;
    input.handle.position_m = held.handle.position_m + s * way;
    const float force_n = dot(tick(kernel, input).force_n, way) / norm(way);
    if (i < 2 * period) continue;
    low = std::min(low, force_n);
    high = std::max(high, force_n);
  }
  return static_cast<double>(high - low);
}

TEST(Cascade, AMovingHandFeelsTheMassOfTheTissue) {
  Graded graded;
  graded.nx = graded.ny = 7;
  graded.nz = 5;
  graded.levels = 3;
  graded.fixed_faces = kLowX | kHighX | kLowY | kHighY | kLowZ;  // as in a box
  graded.materials[0].puncture_force_n = 0.05F;
  graded.materials[0].cutting_force_n = 0.03F;
  graded.split = [](std::uint32_t level, int x, int y, int) {
    const double edges = level == 0 ? 1 : 2, reach = level == 0 ? 1.6 : 0.8;
    return std::fabs((x + 0.5) / edges - 3.4) < reach && std::fabs((y + 0.5) / edges - 3.7) < reach;
  };
  const Vec3 ways[] = {{1e-3F, 0, 0}, {0, 1e-3F, 0}, {0, 0, 1e-3F}};
  double felt[2][3][2] = {};
  for (const bool converged : {false, true}) {
    Config config;
    config.substeps = converged ? 16 : 1;
    config.needle[0].unit_m = 2.5e-3F;
    Body body = make(graded, config);
    Kernel& kernel = body.session.kernel;
    EXPECT_EQ(view_of(kernel).model.head->shadows.on, 1U);
    const float top_m = graded.voxel_edge_m * graded.nz, length_m = config.needle[0].length_m;
    const Script script = {{3.4F * graded.voxel_edge_m, 3.7F * graded.voxel_edge_m, top_m},
                           length_m};
    Input input = scripted_input(script, 0);
    for (int i = 0; i < 1500; ++i) {  // 20 mm/s to 12 mm, and rest
      const float depth_m = std::min(-3e-3F + 2e-5F * static_cast<float>(i), 12e-3F);
      input.handle.position_m.z = top_m + length_m - depth_m;
      (void)tick(kernel, input);
    }
    EXPECT_GT(view_of(kernel).state.needle->shaft_count, 2U);
    for (int way = 0; way < 3; ++way) {
      for (int k = 0; k < 2; ++k) {
        felt[converged][way][k] = swing_n(kernel, input, ways[way], k == 0 ? 4 : 8);
      }
    }
  }
  for (int way = 0; way < 3; ++way) {
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(felt[0][way][k], felt[1][way][k], 0.05 * felt[1][way][k]) << way << " " << k;
    }
  }
}

}  // namespace
}  // namespace stylet::test
