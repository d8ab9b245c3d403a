// SPDX-License-Identifier: Apache-2.0
// Parts that slide in voxels of several sizes, against closed forms, conservation, and the same
// parts in fine voxels throughout: random refinements, planes and tissues. PHYSICS 2.8, 2.9.
#include "graded_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "coupling/slides.h"
#include "draw.h"
#include "felt.h"
#include "lattice/hanging.h"
#include "same_bits.h"
#include "set_speed.h"
#include "step_energy.h"

namespace stylet::test {
namespace {

constexpr double kGravity = 9.81;

struct Bodies {
  std::unique_ptr<OpenOrgan> organ;
  Session session;

  Kernel& kernel() { return session.kernel; }
};
Bodies make(const GradedParts& graded, const Config& config) {
  Bodies out = {packed(*graded_parts(graded)), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

bool split_all(std::uint32_t, int, int, int) {
  return true;
}

// A drawn tissue; Poisson's ratio up to `most`.
TinyMaterial drawn_tissue(Draw& draw, double most = 0.47) {
  TinyMaterial tissue;
  tissue.youngs_modulus_pa = draw.magnitude(3e3, 60e3);
  tissue.poisson_ratio = draw.between(0.2, most);
  tissue.density_kg_per_m3 = draw.between(900, 1200);
  return tissue;
}

// Small blocks, two or three levels, refined at random, on a plane of any height and slope.
GradedParts drawn_parts(Draw& draw, unsigned seed) {
  GradedParts graded;
  TwoParts& parts = graded.parts;
  parts.floor_x = parts.lid_x = 5;
  parts.floor_y = parts.lid_y = 4;
  parts.height = 6;
  parts.plane = draw.between(2.3, 3.4);
  parts.slope_x = draw.between(-0.15, 0.15);
  parts.slope_y = draw.between(-0.15, 0.15);
  parts.voxel_edge_m = draw.between(4e-3, 8e-3);
  parts.floor = drawn_tissue(draw);
  parts.lid = drawn_tissue(draw);
  graded.levels = 2 + seed % 2;
  graded.split = at_random(seed, static_cast<double>(draw.between(0.2, 0.6)));
  return graded;
}

void wait(Bodies& bodies, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(bodies.kernel(), Input{});
}

// Calls visit(particle, place at rest) for each node of the floor, 0, the lid, 1, or of both, 2.
template <typename Visit>
void each_node(const View& view, std::uint32_t part, Visit visit) {
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles);
  for (std::uint32_t voxel = 0; voxel < head.counts.voxels; ++voxel) {
    const Row& row = view.model.row[view.model.voxel_row[voxel]];
    const std::uint32_t slot = view.model.voxel_slot[voxel], x = row.x0 + (slot - row.slot);
    if (part < 2 && view.model.slot_material[slot] != part) continue;
    const Plane& plane = view.model.plane[row.plane];
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const std::uint32_t p = row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U);
      if (seen[p]) continue;
      seen[p] = true;
      visit(p, head.level[plane.level].edge_m *
                   Vec3{static_cast<float>(x + (corner & 1U)),
                        static_cast<float>(row.y % head.sheet_rows + ((corner >> 1U) & 1U)),
                        static_cast<float>(plane.z_in_level + (corner >> 2U))});
    }
  }
}

// Momentum, its moment, mass of the step, and the sum of the sizes of all momenta.
struct Sum {
  double kg = 0, size = 0;
  std::array<double, 3> momentum{}, moment{};
};
Sum sum_of(const View& view, std::uint32_t part) {
  Sum sum;
  each_node(view, part, [&](std::uint32_t p, Vec3 rest) {
    if (hangs(view.model, p) || !(view.model.step_per_mass[p] > 0)) return;
    const State& s = view.state;
    const double kg = static_cast<double>(view.model.head->substep_s / view.model.step_per_mass[p]);
    const double x[3] = {static_cast<double>(rest.x + s.ux[p]),
                         static_cast<double>(rest.y + s.uy[p]),
                         static_cast<double>(rest.z + s.uz[p])};
    const double m[3] = {kg * static_cast<double>(s.wx[p]), kg * static_cast<double>(s.wy[p]),
                         kg * static_cast<double>(s.wz[p])};
    sum.kg += kg;
    sum.size += std::hypot(m[0], m[1], m[2]);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      sum.momentum[a] += m[a];
      sum.moment[a] += x[b] * m[c] - x[c] * m[b];
    }
  });
  return sum;
}

void throw_part(const View& view, std::uint32_t part, Vec3 speed) {
  each_node(view, part, [&](std::uint32_t p, Vec3) {
    if (!hangs(view.model, p) && view.model.step_per_mass[p] > 0) set_speed(view, p, speed);
  });
}

// What the points press, over quarters of the lid: forces along z, and depths weighted by areas.
struct Pressed {
  std::array<double, 4> force_n{}, depth{}, area{};
  double all_n = 0, depth_m = 0;
  std::uint32_t points = 0;
};
Pressed pressed(const Kernel& kernel, const TwoParts& parts) {
  const View view = view_of(kernel);
  Pressed out;
  double areas = 0;
  const float edge_m = parts.voxel_edge_m;
  for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
    const SlidePoint& point = view.model.slide_point[i];
    const SlideContact& c = view.scratch.slide_contact[i];
    const SlideState& own = view.state.slide[i];
    const bool right = point.rest_m.x > edge_m * (parts.at_x + 0.5F * parts.lid_x);
    const bool high = point.rest_m.y > edge_m * (parts.at_y + 0.5F * parts.lid_y);
    const std::size_t quarter = (right ? 1U : 0U) + (high ? 2U : 0U);
    const auto area = static_cast<double>(point.stiffness_n_per_m);  // in proportion to it
    const double force_n = static_cast<double>(own.stiffness_n_per_m) *
                           static_cast<double>(c.depth_m * c.slope.z - own.stretch_m.z);
    out.area[quarter] += area;
    areas += area;
    out.depth[quarter] += area * static_cast<double>(c.depth_m);
    out.depth_m += area * static_cast<double>(c.depth_m);
    if (!(c.depth_m > 0)) continue;
    ++out.points;
    out.force_n[quarter] += force_n;
    out.all_n += force_n;
  }
  for (std::size_t q = 0; q < 4; ++q) out.depth[q] /= out.area[q];
  out.depth_m /= areas;
  return out;
}

TEST(PartsInLevels, RestIsRest) {
  Draw draw(1);
  for (unsigned seed = 1; seed <= 9; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    graded.parts.friction = 0.3F;
    Bodies bodies = make(graded, Config{});
    const View view = view_of(bodies.kernel());
    EXPECT_GT(view.model.head->counts.hanging, 50U) << seed;
    EXPECT_GT(view.model.head->counts.slide_points, 20U) << seed;
    wait(bodies, 50);
    EXPECT_LT(view.state.head->max_displacement_m, 1e-8F) << seed;
  }
}

// Moves what holds the lid down, and waits until it is at rest.
void press_down(Bodies& bodies, const TwoParts& parts, float way_m, int ticks) {
  View view = view_of(bodies.kernel());
  const float high_m = parts.voxel_edge_m * parts.height;
  each_node(view, 2, [&](std::uint32_t p, Vec3 rest) {
    const bool held = !(view.model.step_per_mass[p] > 0);
    // Held nodes stay where they are put; the others begin with the strain of one body.
    view.state.uz[p] = view.state.ez[p] =
        -way_m * (held ? (rest.z > 0.5F * high_m ? 1.0F : 0.0F) : rest.z / high_m);
  });
  wait(bodies, ticks);
}

// Two tissues under one pressure, on a plane between voxels of any sizes: displacements
// that are linear in each, with a step at the plane of the pressure's depth, are at rest. (At lower
// Poisson's ratios contact is softer, see kRoom.)
TEST(PartsInLevels, APatchBearsAUniformPressure) {
  constexpr std::uint32_t kSides = kLowX | kHighX | kLowY | kHighY;
  Draw draw(2);
  for (unsigned seed = 1; seed <= 9; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    TwoParts& parts = graded.parts;
    parts.plane = 2 + static_cast<float>(draw.below(2));
    parts.slope_x = parts.slope_y = 0;
    parts.floor.poisson_ratio = draw.between(0.37, 0.47);
    parts.lid.poisson_ratio = draw.between(0.37, 0.47);
    parts.friction = draw.between(0, 0.5);
    graded.floor_held = kLowZ | kSides;
    graded.lid_held = kHighZ | kSides;
    const auto shear = [](const TinyMaterial& m) {
      return static_cast<double>(m.youngs_modulus_pa) /
             (2 + 2 * static_cast<double>(m.poisson_ratio));
    };
    const auto across = [&](const TinyMaterial& m) {  // without a change of width
      const auto nu = static_cast<double>(m.poisson_ratio);
      return shear(m) * (2 - 2 * nu) / (1 - 2 * nu);
    };
    const double h = static_cast<double>(parts.voxel_edge_m),
                 plane_m = h * static_cast<double>(parts.plane);
    const double strain = 1e-3;  // of the softer one; small
    const double pressure = strain * std::min(across(parts.floor), across(parts.lid));
    const double depth = pressure * h / 4 / std::min(shear(parts.floor), shear(parts.lid));
    Bodies bodies = make(graded, Config{});
    View view = view_of(bodies.kernel());
    for (std::uint32_t part = 0; part < 2; ++part) {
      each_node(view, part, [&](std::uint32_t p, Vec3 rest) {
        const double z = static_cast<double>(rest.z), low = pressure / across(parts.floor);
        const double above = plane_m * low + depth + (z - plane_m) * pressure / across(parts.lid);
        view.state.uz[p] = view.state.ez[p] = -static_cast<float>(part == 0 ? z * low : above);
      });
    }
    wait(bodies, 1000);
    const Pressed now = pressed(bodies.kernel(), parts);
    const double area = parts.lid_x * h * parts.lid_y * h;
    double worst = 0;
    for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
      const auto of_point = static_cast<double>(view.scratch.slide_contact[i].depth_m);
      worst = std::max(worst, std::fabs(of_point / depth - 1));
    }
    EXPECT_NEAR(now.all_n, pressure * area, 3 * strain * pressure * area) << seed;
    EXPECT_LT(worst, 3 * strain) << seed;
  }
}

// On a plane of any height and slope: what the points press in each quarter of the lid, and how
// deep they are, is what it is where all voxels are fine.
TEST(PartsInLevels, PressureAndGapAreThoseOfFineVoxels) {
  Draw draw(3);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    TwoParts& parts = graded.parts;
    parts.friction = draw.between(0, 1);
    parts.floor_x = parts.lid_x = 6;
    parts.floor.poisson_ratio = draw.between(0.37, 0.47);
    parts.lid.poisson_ratio = draw.between(0.37, 0.47);
    graded.levels = 2;
    graded.lid_held = kHighZ;
    Config config;
    config.surround_drag_per_s = 30;
    Pressed found[2];
    for (const bool fine : {false, true}) {
      if (fine) graded.split = split_all;
      Bodies bodies = make(graded, config);
      press_down(bodies, parts, 0.15F * parts.voxel_edge_m, 1500);
      found[fine ? 1 : 0] = pressed(bodies.kernel(), parts);
    }
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(found[0].force_n[q], found[1].force_n[q], 0.05 * found[1].force_n[q]) << seed;
      EXPECT_NEAR(found[0].depth[q], found[1].depth[q], 0.05 * found[1].depth[q]) << seed;
    }
  }
}

// A lid that slides is braked by the coefficient of friction times what presses it on, whatever
// that is.
TEST(PartsInLevels, FrictionIsCoulombs) {
  Draw draw(4);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    TwoParts& parts = graded.parts;
    parts.floor_x = 14;
    parts.at_x = 2;
    parts.slope_x = parts.slope_y = 0;
    parts.friction = draw.between(0.1, 0.3);
    parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 30e3F;
    for (const double pressed_by : {0.5, 2.0}) {
      Config config;
      config.surround_drag_per_s = 0;
      config.gravity_m_per_s2 = {0, 0, -static_cast<float>(pressed_by * kGravity)};
      Bodies bodies = make(graded, config);
      wait(bodies, 1300);
      throw_part(view_of(bodies.kernel()), 1, {0.4F, 0, 0});
      wait(bodies, 20);
      double along = 0, on = 0;
      for (int t = 0; t < 20; ++t) {
        wait(bodies, 1);
        const View view = view_of(bodies.kernel());
        for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
          const SlideContact& c = view.scratch.slide_contact[i];
          const SlideState& own = view.state.slide[i];
          if (!(c.depth_m > 0)) continue;
          const Vec3 pushed = (own.stiffness_n_per_m * c.depth_m) * c.slope;
          const Vec3 held = own.stiffness_n_per_m * own.stretch_m;
          along += static_cast<double>(norm(held));
          on += static_cast<double>(norm(pushed));
        }
      }
      const double mu = static_cast<double>(parts.friction);
      EXPECT_NEAR(along / on, mu, 1e-3 * mu) << seed << " " << pressed_by;
    }
  }
}

// Two free blocks meet: forces on both add up to nothing, momentum and its moment stay, and energy
// only falls.
TEST(PartsInLevels, FreeBlocksKeepMomentumAndGainNoEnergy) {
  Draw draw(5);
  for (unsigned seed = 1; seed <= 12; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    graded.floor_held = 0;
    graded.parts.friction = draw.between(0, 0.5);
    Config config;
    config.surround_drag_per_s = 0;
    Bodies bodies = make(graded, config);
    const View view = view_of(bodies.kernel());
    throw_part(view, 1,
               {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.2, -0.05)});
    wait(bodies, 1);
    const Sum before = sum_of(view, 2);
    const auto held_j = [&] { return tissue_energy(bodies.kernel(), energy(bodies.kernel())); };
    const double first_j = held_j();
    double most_j = first_j, worst = 0;
    std::uint32_t touched = 0;
    for (int t = 0; t < 100; ++t) {
      wait(bodies, 1);
      most_j = std::max(most_j, held_j());
      touched += pressed(bodies.kernel(), graded.parts).points;
      const std::size_t axis = view.model.head->counts.slid_particles;
      for (std::size_t a = 0; a < 3; ++a) {
        double sum = 0, size = 0;
        each_node(view, 2, [&](std::uint32_t p, Vec3) {
          const auto f = static_cast<double>(view.scratch.slide_force[a * axis + p]);
          sum += f;
          size += std::fabs(f);
        });
        if (size > 0) worst = std::max(worst, std::fabs(sum) / size);
      }
    }
    EXPECT_GT(touched, 0U) << seed;
    EXPECT_LT(worst, 1e-6) << seed;
    const Sum after = sum_of(view, 2);
    const double arm = static_cast<double>(graded.parts.voxel_edge_m) * graded.parts.height;
    double off = 0, turned = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      off = std::max(off, std::fabs(after.momentum[a] - before.momentum[a]) / before.size);
      turned = std::max(turned, std::fabs(after.moment[a] - before.moment[a]) / before.size / arm);
    }
    EXPECT_LT(off, 1e-4) << seed;
    EXPECT_LT(turned, 1e-3) << seed;
    EXPECT_LT(most_j, 1.0001 * first_j) << seed;
    EXPECT_LT(held_j(), first_j) << seed;
  }
}

// A lid that is thrown along a floor, over voxels of all sizes, gains no energy, and what friction
// takes is in the books.
TEST(PartsInLevels, ALidThatSlidesGainsNoEnergy) {
  Draw draw(6);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    GradedParts graded = drawn_parts(draw, seed);
    TwoParts& parts = graded.parts;
    parts.floor_x = 16;
    parts.slope_x = parts.slope_y = 0;
    parts.friction = 0.5F;  // until it lies there
    const float friction = seed % 3 == 0 ? 0 : draw.between(0.02, 0.2);
    parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 15e3F;
    parts.floor.poisson_ratio = parts.lid.poisson_ratio = 0.45F;
    Config config;
    config.surround_drag_per_s = 0;
    config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
    Bodies bodies = make(graded, config);
    View view = view_of(bodies.kernel());
    wait(bodies, 1300);
    for (std::uint32_t k = 0; k < view.model.head->counts.slide_points; ++k) {
      view.model.slide_point[k].friction = friction;
    }
    const auto held_j = [&] {
      const Energy e = energy(bodies.kernel());
      double height_j = 0;
      each_node(view, 2, [&](std::uint32_t p, Vec3) {
        height_j += kGravity * static_cast<double>(view.model.particle_kg[p]) *
                    static_cast<double>(view.state.uz[p]);
      });
      return e.elastic + e.kinetic + height_j;
    };
    const double rest_j = held_j();
    throw_part(view, 1, {0.4F, 0, 0});
    wait(bodies, 2);
    const double first_j = held_j() - rest_j;
    const double before_j = energy(bodies.kernel()).sliding;
    double most_j = first_j;
    for (int t = 0; t < 100; ++t) {
      wait(bodies, 1);
      most_j = std::max(most_j, held_j() - rest_j);
    }
    EXPECT_LT(most_j, 1.01 * first_j) << seed;
    const double lost_j = first_j - (held_j() - rest_j);
    const double booked_j = energy(bodies.kernel()).sliding - before_j;
    EXPECT_GE(booked_j, 0) << seed;
    EXPECT_LT(booked_j, 1.05 * lost_j + 0.01 * first_j) << seed;
  }
}

// A lid that is carried over a gap in its floor, to a piece of it in voxels of another size and in
// a sheet of its own, lies on that.
TEST(PartsInLevels, PointsFindTheNextPieceOfTheirGround) {
  for (const bool fine_first : {false, true}) {
    GradedParts graded;
    graded.pieces_apart = true;
    TwoParts& parts = graded.parts;
    parts.floor_x = 20;
    parts.gap_x = 8;
    parts.gap_width = 3;
    parts.lid_x = 7;
    parts.lid_y = parts.floor_y = 4;
    parts.height = 6;
    parts.friction = 0.3F;
    parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 30e3F;
    graded.split = [=](std::uint32_t, int x, int, int) { return (x < 10) == fine_first; };
    Config config;
    config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
    Bodies bodies = make(graded, config);
    View view = view_of(bodies.kernel());
    for (int t = 1; t <= 60; ++t) {
      const float gone_m = 0.06F * static_cast<float>(t) / 60;  // 12 columns in all
      each_node(view, 1, [&](std::uint32_t p, Vec3) {
        set_speed(view, p, {});
        view.state.ux[p] = view.state.ex[p] = gone_m;
        view.state.uz[p] = view.state.ez[p] = 2e-4F;
      });
      wait(bodies, 1);
    }
    wait(bodies, 2500);
    double weight_n = 0;
    each_node(view, 1, [&](std::uint32_t p, Vec3) {
      weight_n += kGravity * static_cast<double>(view.model.particle_kg[p]);
    });
    EXPECT_NEAR(pressed(bodies.kernel(), parts).all_n, weight_n, 0.01 * weight_n) << fine_first;
    for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
      EXPECT_EQ(view.model.ground[view.state.slide[i].ground].level, fine_first ? 0 : 1);
    }
  }
}

// The needle of the script goes through a lid into the floor; the lid lies on a slope and is
// dragged along. Fine voxels around its way.
GradedParts with_needle(double reach) {
  GradedParts graded;
  TwoParts& parts = graded.parts;
  parts.floor_x = parts.lid_x = parts.floor_y = parts.lid_y = 7;
  parts.height = 7;
  parts.plane = 4.3F;
  parts.slope_x = 0.06F;
  parts.slope_y = -0.04F;
  parts.friction = 0.4F;
  for (TinyMaterial* tissue : {&parts.floor, &parts.lid}) {
    tissue->puncture_force_n = 0.05F;
    tissue->cutting_force_n = 0.03F;
    tissue->coulomb_friction_n_per_m = tissue->static_friction_n_per_m = 2;
    tissue->relaxing_fraction = 0.3F;
  }
  parts.lid.youngs_modulus_pa = 12e3F;
  graded.split = [=](std::uint32_t, int x, int y, int) {
    return std::fabs(x - 3) < reach && std::fabs(y - 3) < reach;
  };
  return graded;
}

Config needle_config() {
  Config config;
  config.needle[0].unit_m = 2.5e-3F;
  config.gravity_m_per_s2 = {0.3F, -0.2F, -2};
  return config;
}

Script script_of(const GradedParts& graded, const Config& config) {
  const float edge_m = graded.parts.voxel_edge_m;
  return {{3.5F * edge_m + 0.8e-3F, 3.5F * edge_m - 0.6e-3F, edge_m * graded.parts.height},
          config.needle[0].length_m};
}

std::vector<Vec3> felt_n(const GradedParts& graded) {
  const Config config = needle_config();
  Bodies bodies = make(graded, config);
  return felt_n(bodies.kernel(), script_of(graded, config));
}

// With fine voxels near its way alone a needle feels what it feels where all are fine.
TEST(PartsInLevels, ANeedleCrossesBothParts) {
  const std::vector<Vec3> coarse = felt_n(with_needle(0)), near = felt_n(with_needle(2.5)),
                          fine = felt_n(with_needle(10));
  EXPECT_GT(off(coarse, fine), 0.05);
  EXPECT_LT(off(near, fine), 0.05);
}

TEST(PartsInLevels, HelpersInstructionSetsAndOldScratchChangeNoBit) {
  GradedParts graded = with_needle(1.5);
  graded.levels = 3;
  graded.split = at_random(5, 0.15);
  const Config config = needle_config();
  const Script script = script_of(graded, config);
  expect_same_bits([&] { return make(graded, config); }, script, 1000);
}

TEST(PartsInLevels, ASnapshotGoesOnToTheBit) {
  GradedParts graded = with_needle(2.5);
  graded.levels = 3;
  const Config config = needle_config();
  const Script script = script_of(graded, config);
  Bodies bodies = make(graded, config), other = make(graded, config);
  run(bodies.kernel(), script, 0, 700);
  ASSERT_GT(pressed(bodies.kernel(), graded.parts).points, 0U);
  std::vector<std::byte> saved(snapshot_bytes(bodies.kernel()));
  ASSERT_EQ(snapshot(bodies.kernel(), saved), Status::kOk);
  ASSERT_EQ(restore(other.kernel(), saved), Status::kOk);
  run(bodies.kernel(), script, 700, 200);
  run(other.kernel(), script, 700, 200);
  EXPECT_EQ(hash(bodies.kernel()), hash(other.kernel()));
}

// What organ_open says after a change, as "place[index]: expected".
TEST(PartsInLevels, RefusedWithTheirPlace) {
  const auto refusal = [](const std::function<void(Owner&)>& change) {
    GradedParts graded;
    graded.parts.height = 4;
    graded.parts.plane = 2;
    graded.split = at_random(1, 0.3);
    const std::unique_ptr<Owner> owner = graded_parts(graded);
    change(*owner);
    return refusal_text(*owner);
  };
  EXPECT_EQ(refusal([](Owner&) {}), "");
  EXPECT_EQ(refusal([](Owner& o) { o.format_version = 5; }),
            "slides[0]: format version 6 where parts slide and there are levels");
  const char* const bodies =
      "slides.bodies[0]: one for each ground where there are levels, else none";
  EXPECT_EQ(refusal([](Owner& o) { o.slides->bodies.pop_back(); }), bodies);
  EXPECT_EQ(refusal([](Owner& o) { o.slides->bodies.clear(); }), bodies);
}

}  // namespace
}  // namespace stylet::test
