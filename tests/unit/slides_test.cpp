// SPDX-License-Identifier: Apache-2.0
// Parts that slide on each other, against the statics and dynamics of blocks: planes of random
// height and slope between blocks of random tissue. PHYSICS 2.8.
#include "coupling/slides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "draw.h"
#include "set_speed.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

constexpr double kGravity = 9.81;

struct Bodies {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
};
Bodies make(const TwoParts& parts, const Config& config) {
  Bodies out = {two_parts(parts), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

TinyMaterial drawn_tissue(Draw& draw) {
  TinyMaterial tissue;
  tissue.youngs_modulus_pa = draw.magnitude(3e3, 60e3);
  tissue.poisson_ratio = draw.between(0.3, 0.47);
  tissue.density_kg_per_m3 = draw.between(900, 1200);
  return tissue;
}

// Heights within voxels, slopes up to 1 in 5.
TwoParts drawn_parts(Draw& draw) {
  TwoParts parts;
  parts.plane = draw.between(3.2, 4.5);
  parts.slope_x = draw.between(-0.2, 0.2);
  parts.slope_y = draw.between(-0.2, 0.2);
  parts.voxel_edge_m = draw.between(2.5e-3, 7e-3);
  parts.floor = drawn_tissue(draw);
  parts.lid = drawn_tissue(draw);
  return parts;
}

// So soft that the step adds no mass to a body that is thrown.
TwoParts drawn_soft_parts(Draw& draw) {
  TwoParts parts = drawn_parts(draw);
  parts.voxel_edge_m = draw.between(4e-3, 7e-3);
  parts.floor.youngs_modulus_pa = draw.magnitude(2e3, 6e3);
  parts.lid.youngs_modulus_pa = draw.magnitude(2e3, 6e3);
  parts.floor.poisson_ratio = parts.lid.poisson_ratio = 0.4F;
  return parts;
}

void wait(Bodies& bodies, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(bodies.session.kernel, Input{});
}

// Momenta are those of the step, which adds mass where tissue is too stiff for it.
struct Sum {
  double kg = 0, stepped_kg = 0;
  double moved[3] = {};     // mean displacement, m
  double momentum[3] = {};  // kg m/s
  double moment[3] = {};    // of momentum, about the origin, kg m^2/s
};

// Calls visit(particle, place at rest) for all of one part, 0: floor, 1: lid, or of both, 2.
template <typename Visit>
void each_particle(const Kernel& kernel, std::uint32_t part, Visit visit) {
  const View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles);
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    if (part < 2 && row.y / head.sheet_rows != part) continue;
    for (std::uint32_t i = 0; i < 4 * (row.count + 1U); ++i) {
      const std::uint32_t corner = i % 4, along = i / 4, p = row.node[corner] + along;
      if (seen[p]) continue;
      seen[p] = true;
      const auto at = [&](std::uint32_t cell) { return head.edge_m * static_cast<float>(cell); };
      visit(p, Vec3{at(row.x0 + along), at(row.y % head.sheet_rows + (corner & 1U)),
                    at(view.model.plane[row.plane].z + (corner >> 1U))});
    }
  }
}

Sum sum_of(const Kernel& kernel, std::uint32_t part) {
  const View view = view_of(kernel);
  const State& s = view.state;
  Sum sum;
  each_particle(kernel, part, [&](std::uint32_t p, Vec3 rest) {
    const auto kg = static_cast<double>(view.model.particle_kg[p]);
    const float per_mass = view.model.step_per_mass[p];
    const auto stepped_kg =
        static_cast<double>(per_mass > 0 ? view.model.head->substep_s / per_mass : 0);
    const float* const at_rest[3] = {&rest.x, &rest.y, &rest.z};
    const float* const moved[3] = {s.ux, s.uy, s.uz};
    const float* const speed[3] = {s.wx, s.wy, s.wz};
    double x[3], v[3];
    sum.kg += kg;
    sum.stepped_kg += stepped_kg;
    for (int a = 0; a < 3; ++a) {
      const auto u = static_cast<double>(moved[a][p]);
      x[a] = static_cast<double>(*at_rest[a]) + u;
      v[a] = stepped_kg * static_cast<double>(speed[a][p]);
      sum.moved[a] += kg * u;
      sum.momentum[a] += v[a];
    }
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      sum.moment[a] += x[b] * v[c] - x[c] * v[b];
    }
  });
  for (double& moved : sum.moved) moved /= sum.kg;
  return sum;
}

double speed_of(const Sum& sum) {
  return std::hypot(sum.momentum[0], sum.momentum[1], sum.momentum[2]) / sum.stepped_kg;
}

void throw_part(Bodies& bodies, std::uint32_t part, Vec3 speed) {
  const View view = view_of(bodies.session.kernel);
  each_particle(bodies.session.kernel, part,
                [&](std::uint32_t p, Vec3) { set_speed(view, p, speed); });
}

// The force on the lid along z, and how many points touch.
struct Touch {
  double force_n = 0;
  std::uint32_t points = 0;
};
Touch touch_of(const Kernel& kernel) {
  const View view = view_of(kernel);
  Touch touch;
  for (std::uint32_t i = 0; i < view.model.head->counts.slide_points; ++i) {
    const SlideContact& c = view.scratch.slide_contact[i];
    if (!(c.depth_m > 0)) continue;
    const SlideState& own = view.state.slide[i];
    touch.points += 1;
    touch.force_n += static_cast<double>(own.stiffness_n_per_m) *
                     static_cast<double>(c.depth_m * c.slope.z - own.stretch_m.z);
  }
  return touch;
}

TEST(Slides, RestIsRest) {
  Draw draw(1);
  for (int i = 0; i < 20; ++i) {
    TwoParts parts = drawn_parts(draw);
    parts.friction = 0.3F;
    Bodies bodies = make(parts, Config{});
    wait(bodies, 50);
    EXPECT_LT(view_of(bodies.session.kernel).state.head->max_displacement_m, 1e-8F) << i;
  }
}

// The weight of the lid, whatever the plane: with friction above the slope it lies there.
TEST(Slides, AFloorCarriesTheWeight) {
  Draw draw(2);
  for (int i = 0; i < 10; ++i) {
    TwoParts parts = drawn_parts(draw);
    parts.friction = 0.6F;
    parts.floor.youngs_modulus_pa += 10e3F;  // else it yields
    Config config;
    config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
    Bodies bodies = make(parts, config);
    wait(bodies, 3000);
    const double weight_n = kGravity * sum_of(bodies.session.kernel, 1).kg;
    const Touch touch = touch_of(bodies.session.kernel);
    EXPECT_NEAR(touch.force_n, weight_n, 0.01 * weight_n) << i;
    EXPECT_LT(speed_of(sum_of(bodies.session.kernel, 1)), 1e-4) << i;
  }
}

// In the paper's mode, too.
TEST(Slides, AFloorCarriesTheWeightInPaperMode) {
  TwoParts parts;
  parts.friction = 0.5F;
  Config config;
  config.mode = Mode::kPaper;
  config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
  Bodies bodies = make(parts, config);
  wait(bodies, 3000);
  const double weight_n = kGravity * sum_of(bodies.session.kernel, 1).kg;
  EXPECT_NEAR(touch_of(bodies.session.kernel).force_n, weight_n, 0.02 * weight_n);
}

// A lid that is thrown along a floor loses by friction what friction's force is times the way.
TEST(Slides, TheBooksHaveWhatFrictionTakes) {
  Draw draw(9);
  for (const float friction : {0.0F, 0.05F, 0.2F}) {
    for (const float period_s : {1e-3F, 0.25e-3F}) {
      TwoParts parts;
      parts.floor_x = 24;
      parts.friction = friction;
      parts.plane = draw.between(3.2, 3.8);
      parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 15e3F;
      Config config;
      config.period_s = period_s;
      config.surround_drag_per_s = 0;
      config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
      Bodies bodies = make(parts, config);
      const auto ticks = [&](double s) {
        return static_cast<int>(std::lround(s / double{period_s}));
      };
      wait(bodies, ticks(2));
      throw_part(bodies, 1, {0.3F, 0, 0});
      const Sum before = sum_of(bodies.session.kernel, 1);
      const double spent_j = energy(bodies.session.kernel).sliding;
      wait(bodies, ticks(0.05));
      const Sum after = sum_of(bodies.session.kernel, 1);
      const double way_m = after.moved[0] - before.moved[0];
      const double expected_j = static_cast<double>(friction) * kGravity * after.kg * way_m;
      const double booked_j = energy(bodies.session.kernel).sliding - spent_j;
      EXPECT_NEAR(booked_j, expected_j, 0.05 * expected_j + 1e-9) << friction << " " << period_s;
    }
  }
}

// A lid that is dragged over a gap in its floor is carried by what lies beyond.
TEST(Slides, PointsFindTheNextPieceOfTheirGround) {
  TwoParts parts;
  parts.floor_x = 24;
  parts.gap_x = 9;
  parts.gap_width = 3;
  parts.friction = 0;
  parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 30e3F;
  Config config;
  config.surround_drag_per_s = 0;
  config.gravity_m_per_s2 = {0, 0, -static_cast<float>(kGravity)};
  Bodies bodies = make(parts, config);
  const Kernel& kernel = bodies.session.kernel;
  wait(bodies, 1500);
  throw_part(bodies, 1, {0.5F, 0, 0});
  while (sum_of(kernel, 1).moved[0] < 0.060) wait(bodies, 1);  // 12 columns: it is beyond
  double force_n = 0;
  for (int t = 0; t < 20; ++t) {
    wait(bodies, 1);
    force_n += touch_of(kernel).force_n / 20;
  }
  const double weight_n = kGravity * sum_of(kernel, 1).kg;
  EXPECT_NEAR(force_n, weight_n, 0.3 * weight_n);  // it still swings
  EXPECT_GT(sum_of(kernel, 1).moved[2], -2e-3);
}

// What scratch holds between ticks changes nothing.
TEST(Slides, ScratchBetweenTicksIsNothing) {
  Draw draw(10);
  TwoParts parts = drawn_parts(draw);
  Config config;
  config.gravity_m_per_s2 = {1, 1, -9};
  Bodies clean = make(parts, config), spoiled = make(parts, config);
  for (int i = 0; i < 400; ++i) {
    const std::span<std::byte> scratch = spoiled.session.scratch.span();
    std::fill(scratch.begin(), scratch.end(), std::byte{0xFF});
    wait(clean, 1);
    wait(spoiled, 1);
  }
  EXPECT_EQ(hash(clean.session.kernel), hash(spoiled.session.kernel));
}

// On a slope of drawn direction, given by the direction of gravity: a block stays below the angle
// of friction and goes with g (sin a - mu cos a) above it.
TEST(Slides, ASlopeHoldsBelowTheAngleOfFriction) {
  Draw draw(3);
  for (int i = 0; i < 10; ++i) {
    TwoParts parts;
    parts.floor_x = parts.floor_y = 30;
    parts.at_x = parts.at_y = 11;
    parts.plane = draw.between(2.1, 3.9);
    parts.height = 7;
    parts.friction = draw.between(0.15, 0.4);
    parts.floor.youngs_modulus_pa = parts.lid.youngs_modulus_pa = 30e3F;
    const bool holds = i % 2 == 0;
    const double slope = static_cast<double>(parts.friction) * (holds ? 0.9 : 1.1);
    const double way = 6.28 * draw.unit(), down = kGravity / std::sqrt(1 + slope * slope);
    Config config;
    config.surround_drag_per_s = 0;
    config.gravity_m_per_s2 = {static_cast<float>(down * slope * std::cos(way)),
                               static_cast<float>(down * slope * std::sin(way)),
                               -static_cast<float>(down)};
    Bodies bodies = make(parts, config);
    wait(bodies, 1000);
    const Sum before = sum_of(bodies.session.kernel, 1);
    wait(bodies, 100);
    const Sum after = sum_of(bodies.session.kernel, 1);
    const auto along = [&](const Sum& sum) {
      return (sum.momentum[0] * std::cos(way) + sum.momentum[1] * std::sin(way)) / sum.stepped_kg;
    };
    const double gained = (along(after) - along(before)) / 0.1;
    const double expected = down * (slope - static_cast<double>(parts.friction));
    if (holds) {
      EXPECT_LT(std::abs(along(after)), 2e-3) << i;
      continue;
    }
    EXPECT_NEAR(gained, expected, 0.05 * expected) << i;
    // It is heavier by the room that its surface has for contact, at most 2 G dt^2 / h per area.
    const double edge_m = static_cast<double>(parts.voxel_edge_m), area = 8 * 6 * edge_m * edge_m;
    const double shear_pa = 30e3 / (2 * (1 + static_cast<double>(parts.lid.poisson_ratio)));
    const double added_kg = 2 * shear_pa * 1e-6 / edge_m * area;
    const double went = (after.moved[0] - before.moved[0]) * std::cos(way) +
                        (after.moved[1] - before.moved[1]) * std::sin(way);
    const double told = 0.1 * (along(before) + along(after)) / 2;
    EXPECT_LT(went, told) << i;
    EXPECT_GT(went, told / (1 + added_kg / after.kg)) << i;
  }
}

// Two free blocks meet: momentum and its moment stay, and energy only falls.
TEST(Slides, FreeBlocksKeepMomentumAndItsMoment) {
  Draw draw(4);
  for (int i = 0; i < 10; ++i) {
    TwoParts parts = drawn_parts(draw);
    parts.held = false;
    parts.friction = draw.between(0, 0.5);
    Config config;
    config.surround_drag_per_s = 0;
    Bodies bodies = make(parts, config);
    throw_part(bodies, 1,
               {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.2, -0.05)});
    wait(bodies, 1);  // a velocity that is set is a momentum after the first step
    const Sum before = sum_of(bodies.session.kernel, 2);
    const auto held_j = [&] {
      const Energy e = energy(bodies.session.kernel);
      return e.elastic + e.kinetic;
    };
    const double first_j = held_j();
    double most_j = first_j, touched = 0;
    for (int t = 0; t < 50; ++t) {
      wait(bodies, 2);
      touched += touch_of(bodies.session.kernel).points;
      most_j = std::max(most_j, held_j());
    }
    EXPECT_GT(touched, 0) << i;
    const Sum after = sum_of(bodies.session.kernel, 2);
    const double size = speed_of(before) * before.stepped_kg;
    const double arm = static_cast<double>(parts.voxel_edge_m) * parts.height;
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(after.momentum[a], before.momentum[a], 1e-3 * size) << i;
      EXPECT_NEAR(after.moment[a], before.moment[a], 1e-3 * size * arm) << i;
    }
    const Energy e = energy(bodies.session.kernel);
    EXPECT_LT(most_j, 1.03 * first_j) << i;  // within an impact it is not that of one moment
    EXPECT_LT(held_j(), first_j) << i;
    EXPECT_GE(e.sliding, 0) << i;
  }
}

// A lid that is thrown off goes: nothing holds it.
TEST(Slides, PartsSeparateFreely) {
  Draw draw(5);
  for (int i = 0; i < 10; ++i) {
    TwoParts parts = drawn_soft_parts(draw);
    parts.friction = 0.5F;
    Config config;
    config.surround_drag_per_s = 0;
    Bodies bodies = make(parts, config);
    const Vec3 speed = {draw.between(-0.02, 0.02), draw.between(-0.02, 0.02), 0.05F};
    throw_part(bodies, 1, speed);
    wait(bodies, 100);
    const Sum lid = sum_of(bodies.session.kernel, 1);
    EXPECT_NEAR(lid.momentum[0] / lid.stepped_kg, static_cast<double>(speed.x), 1e-5) << i;
    EXPECT_NEAR(lid.momentum[1] / lid.stepped_kg, static_cast<double>(speed.y), 1e-5) << i;
    EXPECT_NEAR(lid.momentum[2] / lid.stepped_kg, 0.05, 1e-5) << i;
    EXPECT_EQ(touch_of(bodies.session.kernel).points, 0) << i;
  }
}

// A gap that is open at rest closes when the parts come together, at the time that its width says.
TEST(Slides, AGapClosesWhereTheSurfacesMeet) {
  Draw draw(6);
  for (int i = 0; i < 10; ++i) {
    TwoParts parts = drawn_soft_parts(draw);
    parts.gap = draw.between(0.2, 0.9);
    Config config;
    config.surround_drag_per_s = 0;
    Bodies bodies = make(parts, config);
    throw_part(bodies, 1, {0, 0, -0.1F});
    const Kernel& kernel = bodies.session.kernel;
    for (int t = 0; t < 200 && touch_of(kernel).points == 0; ++t) wait(bodies, 1);
    const double gap_m = static_cast<double>(parts.gap * parts.voxel_edge_m);
    EXPECT_NEAR(-sum_of(kernel, 1).moved[2], gap_m, 3e-4) << i;
    wait(bodies, 300);
    EXPECT_GT(sum_of(kernel, 1).momentum[2], 0) << i;  // it is turned back
  }
}

// The forces on a needle that is pushed through both parts, every millimetre, after the lid has
// slid by `slid_m`.
std::vector<Vec3> forces_through(const TwoParts& parts, Vec3 slid_m) {
  Config config;
  config.needle[0].length_m = 0.1F;
  Bodies bodies = make(parts, config);
  View view = view_of(bodies.session.kernel);
  each_particle(bodies.session.kernel, 1, [&](std::uint32_t p, Vec3) {
    view.state.ux[p] = view.state.ex[p] = slid_m.x;
    view.state.uy[p] = view.state.ey[p] = slid_m.y;
  });
  std::vector<Vec3> forces;
  for (int t = 0; t < 2200; ++t) {
    Input input{};
    input.valid = 1;
    input.handle = {{0.0387F, 0.0363F, 0.155F - 2e-5F * static_cast<float>(t)}, {1, 0, 0, 0}};
    const Output out = tick(bodies.session.kernel, input);
    if (t % 50 == 0) forces.push_back(out.force_n);
  }
  return forces;
}

// On a plane that is level, a lid that has slid meets the needle with the same forces: the tissue
// is the same everywhere.
TEST(Slides, ANeedleCrossesPartsThatHaveSlid) {
  TwoParts parts;
  parts.floor_x = parts.floor_y = parts.lid_x = parts.lid_y = 15;
  parts.plane = 5.37F;
  parts.height = 10;
  for (TinyMaterial* tissue : {&parts.floor, &parts.lid}) {
    tissue->puncture_force_n = 0.02F;
    tissue->cutting_force_n = 0.01F;
    tissue->coulomb_friction_n_per_m = tissue->static_friction_n_per_m = 2;
  }
  const std::vector<Vec3> unslid = forces_through(parts, {});
  ASSERT_GT(unslid.back().z, 0.08F);
  Draw draw(8);
  for (int i = 0; i < 4; ++i) {
    const Vec3 slid_m = {draw.between(-0.014, 0.014), draw.between(-0.014, 0.014), 0};
    const std::vector<Vec3> forces = forces_through(parts, slid_m);
    float sideways_n = 0, axial_n = 0;
    for (std::size_t at = 0; at < forces.size(); ++at) {
      const Vec3 other = forces[at] - unslid[at];
      axial_n = std::max(axial_n, std::abs(other.z));
      sideways_n = std::max(sideways_n, std::hypot(other.x, other.y));
    }
    EXPECT_LT(axial_n, 4e-3F) << i;
    EXPECT_LT(sideways_n, 4e-3F) << i;
  }
}

// A state that is restored goes on with the same bits.
TEST(Slides, SnapshotsHoldContacts) {
  Draw draw(7);
  TwoParts parts = drawn_parts(draw);
  parts.friction = 0.6F;
  Config config;
  config.gravity_m_per_s2 = {2, 1, -9};
  Bodies bodies = make(parts, config), other = make(parts, config);
  wait(bodies, 500);
  ASSERT_GT(touch_of(bodies.session.kernel).points, 0);
  std::vector<std::byte> saved(snapshot_bytes(bodies.session.kernel));
  ASSERT_EQ(snapshot(bodies.session.kernel, saved), Status::kOk);
  ASSERT_EQ(restore(other.session.kernel, saved), Status::kOk);
  wait(bodies, 300);
  wait(other, 300);
  EXPECT_EQ(hash(bodies.session.kernel), hash(other.session.kernel));
}

}  // namespace
}  // namespace stylet::test
