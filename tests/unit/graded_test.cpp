// SPDX-License-Identifier: Apache-2.0
// Graded lattices: levels of voxels with half the edge of the one before, joined by hanging nodes.
#include "graded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include "felt.h"
#include "lattice/hanging.h"
#include "lattice/voxel.h"
#include "same_bits.h"
#include "set_speed.h"
#include "state/layout.h"
#include "step_energy.h"

namespace stylet::test {
namespace {

void let_go(Session& session, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(session.kernel, Input{});
}

// Calls visit(place at rest, particle) once for each node of the lattice.
template <typename Visit>
void each_node(const View& view, Visit visit) {
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles);
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    const Plane& plane = view.model.plane[row.plane];
    for (std::uint32_t i = 0; i < row.count; ++i) {
      if (!(view.model.slot_k[row.slot + i] > 0)) continue;
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint32_t p = row.node[corner >> 1U] + i + (corner & 1U);
        if (seen[p]) continue;
        seen[p] = true;
        const float h = head.level[plane.level].edge_m;
        visit(h * Vec3{static_cast<float>(row.x0 + i + (corner & 1U)),
                       static_cast<float>(row.y % head.sheet_rows + ((corner >> 1U) & 1U)),
                       static_cast<float>(plane.z_in_level + (corner >> 2U))},
              p);
      }
    }
  }
}

// Splits each cell with this probability, the same for the same cell.
// A linear displacement is a state of no force within, whatever the levels.
TEST(Graded, PatchTest) {
  for (unsigned seed = 1; seed <= 9; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 3;
    graded.nx = graded.levels == 4 ? 3 : 4;
    graded.split = at_random(seed, 0.4);
    graded.cut = seed % 2 == 0 ? 2 : 0;  // tied sheets
    Config config;
    config.surround_drag_per_s = 0;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(-1e-2F, 1e-2F);
    float a[9];
    for (float& each : a) each = part(random);
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      view.state.ux[p] = view.state.ex[p] = a[0] * at.x + a[1] * at.y + a[2] * at.z;
      view.state.uy[p] = view.state.ey[p] = a[3] * at.x + a[4] * at.y + a[5] * at.z;
      view.state.uz[p] = view.state.ez[p] = a[6] * at.x + a[7] * at.y + a[8] * at.z;
    });
    let_go(body.session, 1);
    const float size_m[3] = {graded.nx * graded.voxel_edge_m, graded.ny * graded.voxel_edge_m,
                             graded.nz * graded.voxel_edge_m};
    double inside = 0, outside = 0;
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      const float per_mass = view.model.step_per_mass[p];
      if (hangs(view.model, p)) return;
      const float f = norm(Vec3{view.state.wx[p], view.state.wy[p], view.state.wz[p]}) / per_mass;
      const float x[3] = {at.x, at.y, at.z};
      bool within = true;
      for (int i = 0; i < 3; ++i) within = within && x[i] > 1e-5F && x[i] < size_m[i] - 1e-5F;
      (within ? inside : outside) = std::max(within ? inside : outside, static_cast<double>(f));
    });
    EXPECT_GT(view.model.head->counts.hanging, 100U) << seed;
    EXPECT_LT(inside, 1e-5 * outside) << seed;
  }
}

// Momentum and its moment, and the sum of the sizes of all momenta.
struct Sum {
  double p[3] = {}, moment[3] = {};
  double size = 0;
};
Sum sum_of(const View& view) {
  Sum sum;
  each_node(view, [&](Vec3 at, std::uint32_t i) {
    if (hangs(view.model, i)) return;
    const double kg = static_cast<double>(view.model.head->substep_s / view.model.step_per_mass[i]);
    const double x[3] = {static_cast<double>(at.x + view.state.ux[i]),
                         static_cast<double>(at.y + view.state.uy[i]),
                         static_cast<double>(at.z + view.state.uz[i])};
    const double p[3] = {kg * static_cast<double>(view.state.wx[i]),
                         kg * static_cast<double>(view.state.wy[i]),
                         kg * static_cast<double>(view.state.wz[i])};
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      sum.p[a] += p[a];
      sum.moment[a] += x[b] * p[c] - x[c] * p[b];
    }
    sum.size += std::hypot(p[0], p[1], p[2]);
  });
  return sum;
}

double energy_now(const Kernel& kernel) {
  return tissue_energy(kernel, energy(kernel));
}

// Where a node is held or hangs, its momentum counts for nothing.
template <typename Speed>
void push(const View& view, Speed speed) {
  each_node(view, [&](Vec3 at, std::uint32_t p) {
    if (hangs(view.model, p) || !(view.model.step_per_mass[p] > 0)) return;
    set_speed(view, p, speed(at));
  });
}

TEST(Graded, MomentumIsKeptAndEnergyFalls) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 2;
    graded.nx = graded.ny = graded.nz = 3;
    graded.split = at_random(seed, 0.4);
    Config config;
    config.surround_drag_per_s = 0;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::mt19937 random(seed);
    std::normal_distribution<float> speed(0, 0.02F);
    push(view, [&](Vec3) { return Vec3{speed(random), speed(random), speed(random)}; });
    const Sum before = sum_of(view);
    let_go(body.session, 1);
    const double first = energy_now(body.session.kernel);
    double last = first;
    for (int i = 0; i < 150; ++i) {
      let_go(body.session, 1);
      const double now = energy_now(body.session.kernel);
      EXPECT_LT(now, last + 1e-6 * first) << seed << " " << i;
      last = now;
    }
    EXPECT_LT(last, 0.5 * first) << seed;
    // What is lost is rounding, as in a lattice of one level.
    const Sum after = sum_of(view);
    const double size_m = 3 * static_cast<double>(graded.voxel_edge_m);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(after.p[a], before.p[a], 3e-5 * before.size) << seed;
      EXPECT_NEAR(after.moment[a], before.moment[a], 1e-4 * before.size * size_m) << seed;
    }
  }
}

// How far a bar that is held at one end sinks under its weight.
double deflection_m(const Graded& graded) {
  Config config;
  config.gravity_m_per_s2 = {0, 0, -0.5F};
  config.surround_drag_per_s = 30;
  Body body = make(graded, config);
  View view = view_of(body.session.kernel);
  let_go(body.session, 2000);
  double lowest_m = 0;
  each_node(view, [&](Vec3, std::uint32_t p) {
    lowest_m = std::max(lowest_m, -static_cast<double>(view.state.uz[p]));
  });
  return lowest_m;
}

TEST(Graded, ABarBendsAsIfAllOfItWereFine) {
  Graded graded;
  graded.nx = 12;
  graded.ny = graded.nz = 3;
  graded.fixed_faces = kLowX;
  graded.split = [](std::uint32_t, int, int, int) { return true; };
  const double fine_m = deflection_m(graded);
  EXPECT_GT(fine_m, 5e-3);
  graded.split = [](std::uint32_t, int x, int y, int) { return x < 4 || (x > 6 && y == 1); };
  EXPECT_NEAR(deflection_m(graded), fine_m, 0.005 * fine_m);
  graded.levels = 3;
  EXPECT_NEAR(deflection_m(graded), fine_m, 0.005 * fine_m);
}

// A small body of drawn materials, and how cells are split.
Graded drawn_body(unsigned seed, std::mt19937& random) {
  std::uniform_real_distribution<float> part(0, 1);
  Graded graded;
  graded.levels = 2 + seed % 2;
  graded.nx = graded.ny = graded.nz = 3;
  graded.voxel_edge_m = 0.002F + 0.006F * part(random);
  graded.fixed_faces = seed % 3 == 0 ? kLowZ : 0U;
  graded.split = at_random(seed, 0.2 + 0.5 * static_cast<double>(part(random)));
  graded.materials.clear();
  for (int i = 0; i < 5; ++i) {
    TinyMaterial m;
    m.youngs_modulus_pa = std::pow(10.0F, 3 + 3 * part(random));
    m.poisson_ratio = 0.49F * part(random);
    m.density_kg_per_m3 = 500 + 1000 * part(random);
    m.strain_stiffening = seed % 4 == 0 ? 50 * part(random) : 0;
    graded.materials.push_back(m);
  }
  graded.material_at = [=](std::uint32_t level, int x, int y, int z) {
    std::seed_seq place = {
        seed, level, static_cast<unsigned>(x), static_cast<unsigned>(y), static_cast<unsigned>(z),
        7U};
    return static_cast<std::uint8_t>(std::mt19937(place)() % 5);
  };
  return graded;
}

// Neighbouring nodes thrown against each other, a tenth of an edge a step, in any tissue.
TEST(Graded, AnyTissueComesToRest) {
  for (unsigned seed = 1; seed <= 15; ++seed) {
    std::mt19937 random(seed);
    const Graded graded = drawn_body(seed, random);
    Config config;
    config.surround_drag_per_s = 0;
    config.inertia = seed % 5 == 0 ? Inertia::kAddedMass : Inertia::kTrueMass;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::normal_distribution<float> speed(0, 0.3F);
    push(view, [&](Vec3) { return Vec3{speed(random), speed(random), speed(random)}; });
    let_go(body.session, 1);
    const double first = energy_now(body.session.kernel);
    double last = first;
    for (int i = 0; i < 30; ++i) {
      let_go(body.session, 5);
      const double now = energy_now(body.session.kernel);
      EXPECT_LT(now, last + 1e-2 * first) << seed << " " << i;
      last = now;
    }
    EXPECT_LT(last, first) << seed;  // a free body goes on
  }
}

// A block that hangs on its low face.
Graded block() {
  Graded graded;
  graded.nx = graded.ny = graded.nz = 8;
  graded.fixed_faces = kLowZ;
  graded.materials[0].puncture_force_n = 0.05F;
  graded.materials[0].cutting_force_n = 0.03F;
  graded.split = [](std::uint32_t, int, int, int) { return false; };
  return graded;
}

Script script_of(const Graded& graded, const Config& config) {
  const float size_m = graded.voxel_edge_m * graded.nz;
  return {{size_m / 2 - 4.7e-3F, size_m / 2 + 1.3e-3F, size_m}, config.needle[0].length_m};
}

Config with_unit(float unit_m) {
  Config config;
  config.needle[0].unit_m = unit_m;
  return config;
}

std::vector<Vec3> felt_n(const Graded& graded) {
  const Config config = with_unit(2.5e-3F);
  Body body = make(graded, config);
  std::vector<Vec3> felt = felt_n(body.session.kernel, script_of(graded, config));
  EXPECT_GT(view_of(body.session.kernel).state.needle->shaft_max, 5U);
  return felt;
}

// Fine around the needle alone (10 mm to each side) it feels what it would feel if all were fine.
// What is left is what the coarse rest yields.
TEST(Graded, ANeedleFeelsTheFineTissueAroundIt) {
  Graded graded = block();
  const std::vector<Vec3> coarse = felt_n(graded);
  graded.split = [](std::uint32_t, int, int, int) { return true; };
  const std::vector<Vec3> fine = felt_n(graded);
  graded.split = [](std::uint32_t, int x, int y, int) { return x > 0 && x < 5 && y > 1 && y < 6; };
  const std::vector<Vec3> mixed = felt_n(graded);
  EXPECT_GT(off(coarse, fine), 0.05);
  EXPECT_LT(off(mixed, fine), 0.02);
  for (const bool low : {false, true}) {  // from coarse into fine tissue, and the other way
    graded.split = [=](std::uint32_t, int, int, int z) { return (z < 6) == low; };
    EXPECT_LT(off(felt_n(graded), fine), 0.065) << low;
  }
}

TEST(Graded, HelpersInstructionSetsAndOldScratchChangeNoBit) {
  Graded graded = block();
  graded.nx = graded.ny = graded.nz = 5;
  graded.levels = 3;
  graded.cut = 2;
  graded.split = at_random(5, 0.2);
  const Config config = with_unit(2.5e-3F);
  const Script script = script_of(graded, config);
  expect_same_bits([&] { return make(graded, config); }, script, 1100);
}

// A body in two sheets, tied along a cut that crosses levels, moves as in one sheet.
TEST(Graded, TiedSheetsMoveAsTheWhole) {
  Graded graded;
  graded.levels = 3;
  graded.fixed_faces = kLowZ;
  graded.split = at_random(3, 0.4);
  std::map<std::tuple<long, long, long>, Vec3> moved;
  double largest = 0, worst = 0;
  for (const bool cut : {false, true}) {
    graded.cut = cut ? 2 : 0;
    Body body = make(graded, Config{});
    View view = view_of(body.session.kernel);
    EXPECT_EQ(view.model.head->counts.ties > 0, cut);
    push(view, [](Vec3 at) { return Vec3{20 * at.x * at.z, 3 * at.y, -2 * at.x}; });
    let_go(body.session, 40);
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      const auto whole = [](float x) { return std::lround(x / 1e-5F); };
      const Vec3 u = {view.state.ux[p], view.state.uy[p], view.state.uz[p]};
      Vec3& wanted = moved[{whole(at.x), whole(at.y), whole(at.z)}];
      if (!cut) wanted = u;
      largest = std::max(largest, static_cast<double>(norm(u)));
      worst = std::max(worst, static_cast<double>(norm(u - wanted)));
    });
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(worst, 1e-3 * largest);
}

// Where sheets are not joined, one body takes no notice of the other, also where both are fine: it
// moves as it does alone.
TEST(Graded, SheetsThatAreNotJoinedAreTwoBodies) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::map<std::tuple<long, long, long>, Vec3> alone;
    double largest = 0, worst = 0, other = 0;
    for (const bool both : {false, true}) {
      Graded graded;
      graded.nx = both ? 4 : 2;
      graded.ny = graded.nz = 3;
      graded.cut = both ? 2 : 0;
      graded.joined = false;
      graded.split = at_random(seed, 0.6);
      Body body = make(graded, Config{});
      View view = view_of(body.session.kernel);
      EXPECT_EQ(view.model.head->shadows.on, 1U);
      EXPECT_EQ(view.model.head->counts.ties, 0U);
      const float cut_m = 2 * graded.voxel_edge_m;
      push(view, [&](Vec3 at) {
        return std::max(cut_m - at.x, 0.0F) * Vec3{2000 * at.z, 300 * at.y, -200 * at.x};
      });
      let_go(body.session, 40);
      each_node(view, [&](Vec3 at, std::uint32_t p) {
        const auto whole = [](float x) { return std::lround(x / 1e-5F); };
        const Vec3 u = {view.state.ux[p], view.state.uy[p], view.state.uz[p]};
        const double size = static_cast<double>(norm(u));
        if (at.x > cut_m + 1e-5F) other = std::max(other, size);
        if (at.x > cut_m - 1e-5F) return;  // at the cut both have nodes
        Vec3& wanted = alone[{whole(at.x), whole(at.y), whole(at.z)}];
        if (!both) wanted = u;
        largest = std::max(largest, size);
        worst = std::max(worst, static_cast<double>(norm(u - wanted)));
      });
    }
    EXPECT_GT(largest, 1e-4) << seed;
    EXPECT_LT(worst, 1e-5 * largest) << seed;
    EXPECT_EQ(other, 0) << seed;
  }
}

// What holds a place, and where it is now, in a body that has been stretched: the finest voxel.
TEST(Graded, APlaceIsHeldByTheVoxelsAroundIt) {
  Graded graded;
  graded.levels = 3;
  graded.split = at_random(4, 0.4);
  Body body = make(graded, Config{});
  View view = view_of(body.session.kernel);
  each_node(view, [&](Vec3 at, std::uint32_t p) {
    view.state.ux[p] = 0.1F * at.x + 0.05F * at.y;
    view.state.uz[p] = -0.2F * at.z;
  });
  std::mt19937 random(1);
  std::uniform_real_distribution<float> part(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const float size_m = 4 * graded.voxel_edge_m;
    const Vec3 at = {size_m * part(random), size_m * part(random), size_m * part(random)};
    Vec3 now = {};
    ASSERT_TRUE(present_place(view.model, view.state, at, now));
    const Vec3 wanted = at + Vec3{0.1F * at.x + 0.05F * at.y, 0, -0.2F * at.z};
    EXPECT_LT(norm(now - wanted), 1e-7F);
    for (const Weighting weighting : {Weighting::kTent, Weighting::kEven}) {
      Support supports[kSupportsPerParticle];
      const std::uint32_t count = find_supports(view.model, at, supports, weighting);
      ASSERT_GT(count, 0U);
      ASSERT_LE(count, kSupportsPerParticle);
      float sum = 0, finest_m = 1;
      Vec3 mean = {};
      for (std::uint32_t s = 0; s < count; ++s) {
        const Row& row = view.model.row[supports[s].row];
        for (std::uint32_t t = 0; t < s; ++t) EXPECT_NE(supports[s].slot, supports[t].slot);
        sum += supports[s].weight;
        mean = mean + supports[s].weight * rest_centre(view.model, supports[s].slot, row);
        finest_m = std::min(finest_m, level_of(view.model, row).edge_m);
      }
      EXPECT_NEAR(sum, 1, 1e-5F);
      EXPECT_LT(norm(mean - at), 0.9F * graded.voxel_edge_m);
    }
  }
  EXPECT_FALSE(inside_lattice(view.model, {-1e-4F, 1e-3F, 1e-3F}));
  EXPECT_FALSE(inside_lattice(view.model, {1e-3F, 1e-3F, 4.01F * graded.voxel_edge_m}));
}

TEST(Graded, ARayMeetsTheSurfaceOfEveryLevel) {
  Graded graded;
  graded.levels = 3;
  graded.split = at_random(6, 0.4);
  const auto organ = packed(*graded_organ(graded));
  const float size_m = 4 * graded.voxel_edge_m;
  for (float x = 0.03F; x < 1; x += 0.06F) {
    for (float y = 0.05F; y < 1; y += 0.07F) {
      float distance_m = 0;
      ASSERT_TRUE(organ_raycast(organ->organ, {x * size_m, y * size_m, size_m + 0.01F}, {0, 0, -1},
                                distance_m));
      EXPECT_NEAR(distance_m, 0.01F, 1e-6F);
    }
  }
}

TEST(Graded, ASnapshotGoesOnToTheBit) {
  Graded graded = block();
  graded.split = [](std::uint32_t, int x, int y, int) { return x > 1 && x < 5 && y > 2 && y < 6; };
  const Config config = with_unit(2.5e-3F);
  const Script script = script_of(graded, config);
  Body body = make(graded, config), other = make(graded, config);
  run(body.session.kernel, script, 0, 900);
  std::vector<std::byte> saved(snapshot_bytes(body.session.kernel));
  ASSERT_EQ(snapshot(body.session.kernel, saved), Status::kOk);
  ASSERT_EQ(restore(other.session.kernel, saved), Status::kOk);
  run(body.session.kernel, script, 900, 200);
  run(other.session.kernel, script, 900, 200);
  EXPECT_EQ(hash(body.session.kernel), hash(other.session.kernel));
}

// What organ_open says about a graded organ after a change, as "place[index]: expected".
std::string refusal_of(const std::function<void(Owner&)>& change, std::uint16_t cut = 0) {
  Graded graded;
  graded.nx = graded.ny = graded.nz = 2;
  graded.cut = cut;
  graded.split = [](std::uint32_t, int, int, int z) { return z == 0; };
  const std::unique_ptr<Owner> owner = graded_organ(graded);
  change(*owner);
  return refusal_text(*owner);
}

TEST(Graded, RefusedWithTheirPlace) {
  const auto hang = [](format::Hanging with) {
    return [=](Owner& o) { o.levels->hanging[3] = with; };
  };
  EXPECT_EQ(refusal_of([](Owner&) {}), "");
  EXPECT_EQ(refusal_of([](Owner&) {}, 1), "");
  EXPECT_EQ(refusal_of([](Owner& o) { o.format_version = 4; }),
            "levels[0]: format version 5 where there are levels");
  for (const int count : {0, 1, 5}) {
    const auto wrong = static_cast<std::uint8_t>(count);
    EXPECT_EQ(refusal_of([=](Owner& o) { o.levels->count = wrong; }), "levels.count[0]: 2 to 4");
  }
  const char* const planes =
      "levels.planes[0]: planes of level 0: size_z is count - 1 + planes (2^count - 1)";
  EXPECT_EQ(refusal_of([](Owner& o) { o.levels->planes = 0; }), planes);
  EXPECT_EQ(refusal_of([](Owner& o) { o.levels->planes = 3; }), planes);
  EXPECT_EQ(refusal_of([](Owner& o) { ++o.size_z; }), planes);
  EXPECT_EQ(refusal_of([](Owner& o) {
              o.runs[1] = {0, 0, 2, 2};
            }),
            "runs[1]: the plane between two levels empty");
  EXPECT_EQ(refusal_of([](Owner& o) {
              o.runs[0] = {1, 0, 1, 2};
            }),
            "runs[0]: a run inside the space of the finest level");
  EXPECT_EQ(refusal_of([](Owner& o) {
              o.runs[1] = {0, 2, 1, 2};
            }),
            "runs[1]: a run inside the space of the finest level");
  EXPECT_EQ(refusal_of([](Owner& o) { std::swap(o.levels->hanging[3], o.levels->hanging[4]); }),
            "levels.hanging[4]: nodes sorted by z, y, x, each once");
  // Nodes of level 1 are those from z = 3 on; its face to level 0 is z = 5.
  EXPECT_EQ(refusal_of(hang({9, 0, 5, 1, 0, 1})),
            "levels.hanging[3]: a node and a voxel of the lattice");
  EXPECT_EQ(refusal_of(hang({3, 0, 5, 1, 0, 0})),
            "levels.hanging[3]: a node and a voxel of the lattice");
  const char* const off_surface =
      "levels.hanging[3]: a node on the surface of a voxel of the next coarser level";
  EXPECT_EQ(refusal_of(hang({3, 0, 5, 0, 0, 1})), off_surface);
  EXPECT_EQ(refusal_of(hang({3, 0, 5, 1, 1, 1})), off_surface);
  EXPECT_EQ(refusal_of(hang({3, 0, 5, 2, 0, 4})), off_surface);
  EXPECT_EQ(refusal_of([](Owner& o) { o.sheets->ties.emplace_back(2, 5, 5, 0); }, 1),
            "levels.hanging[15]: a node that is not tied");
  const auto tie_one = [](Owner& o) {
    o.levels->hanging.erase(o.levels->hanging.begin() + 15);
    o.sheets->ties.emplace_back(2, 5, 5, 0);
  };
  EXPECT_EQ(refusal_of(tie_one, 1), "sheets.ties[16]: a node that does not hang");
}

// Level 0 has 2 x 2 x 2 cells, level 1 twice as many each way, from plane 3 to 6.
TEST(Graded, MembranesAreRefusedWithTheirPlace) {
  using Cell = format::MembraneCell;
  const auto refusal = [](Cell cell) {
    return refusal_of([=](Owner& o) {
      o.membranes = std::make_unique<format::MembranesT>();
      o.membranes->points.resize(3);
      o.membranes->triangles.emplace_back(0, 1, 2);
      o.membranes->cells.push_back(cell);
    });
  };
  EXPECT_EQ(refusal({1, 1, 1, 0, 0, 1, 1}), "");
  EXPECT_EQ(refusal({3, 3, 6, 0, 0, 0, 1}), "");
  const char* const no_cell = "membranes.cells[0]: a cell of the lattice";
  EXPECT_EQ(refusal({2, 1, 1, 0, 0, 1, 1}), no_cell);
  EXPECT_EQ(refusal({1, 2, 1, 0, 0, 1, 1}), no_cell);
  EXPECT_EQ(refusal({1, 1, 2, 0, 0, 1, 1}), no_cell) << "the plane between levels";
  EXPECT_EQ(refusal({4, 3, 6, 0, 0, 0, 1}), no_cell);
  EXPECT_EQ(refusal({3, 4, 6, 0, 0, 0, 1}), no_cell);
  EXPECT_EQ(refusal({3, 3, 7, 0, 0, 0, 1}), no_cell);
  EXPECT_EQ(refusal({0, 0, 65535, 0, 0, 0, 1}), no_cell);
  const char* const triangles =
      "membranes.cells.first[0]: triangles of the list, at least 1; none at a finer level";
  EXPECT_EQ(refusal({1, 1, 1, 0, 0, 0, 1}), triangles);
  EXPECT_EQ(refusal({3, 3, 6, 0, 0, 1, 1}), triangles);
}

}  // namespace
}  // namespace stylet::test
