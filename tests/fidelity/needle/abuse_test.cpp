// SPDX-License-Identifier: Apache-2.0
// Whatever the loads and the hand do, a needle is finite, has the right length, and soon comes to
// rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

struct Draw {
  std::mt19937_64 random;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  double power(double low, double high) { return std::pow(10, between(low, high)); }
  Vec3d within(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  std::uint32_t count(std::uint32_t low, std::uint32_t high) {
    return low + static_cast<std::uint32_t>(random() % (high - low + 1));
  }
};

bool finite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expect_sound(const Needle& n, int context) {
  ASSERT_TRUE(finite(n.result.force_n) && finite(n.result.torque_nm)) << context;
  for (std::uint32_t j = 0; j < n.model.rods; ++j) {
    const Vec3d rod = n.result.node_m[j + 1] - n.result.node_m[j];
    ASSERT_NEAR(norm(rod) / n.model.rod_m, 1, 1e-12) << context << " rod " << j;
    ASSERT_NEAR(norm(n.shape.direction[j]), 1, 1e-12) << context << " rod " << j;
  }
}

std::unique_ptr<Needle> any_needle(Draw& draw) {
  std::vector<RodKink> rest;
  const std::uint32_t rods = draw.count(1, kMaxRods);
  if (draw.count(0, 1) == 1) rest.resize(rods);
  for (RodKink& kink : rest) kink = {draw.between(-0.05, 0.05), draw.between(-0.05, 0.05)};
  const double length_m = draw.between(0.03, 0.3), bending_nm2 = draw.power(-3.8, -1);
  return needle(rods, length_m, bending_nm2, rest);
}

// A spring along a random direction, or along all.
Sym3d any_spring(Draw& draw, double stiffness) {
  const Vec3d v = draw.within(1);
  if (draw.count(0, 1) == 1) return stiffness * kIsotropic;
  return stiffness * Sym3d{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

// Forces up to 30 N on needles from 26G to 14G, and springs as stiff as tissue and bone that pull
// them centimetres aside.
void load_hard(Needle& n, Draw& draw) {
  n.loads.count = 0;
  const std::uint32_t count = draw.count(0, 30);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double arc = draw.between(0, n.length_m);
    const Vec3d place = Vec3d{0, 0, -arc} + draw.within(0.03);
    n.hold(arc, turned(n.handle, place), any_spring(draw, draw.power(0, 4)));
  }
  n.push(n.length_m, draw.within(30));
}

TEST(Abuse, HardLoadsComeToRest) {
  Draw draw{std::mt19937_64(1)};
  int slowest = 0, late = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto n = any_needle(draw);
    const Vec3d axis = draw.within(1);
    n->handle = turn_about(axis, draw.between(0, 3));
    load_hard(*n, draw);
    int ticks = 0;
    do {
      n->tick();
      expect_sound(*n, i);
    } while (++ticks < 200 && n->result.last_turn_rad > 1e-8);
    EXPECT_LT(n->result.last_turn_rad, 1e-8) << i;
    slowest = std::max(slowest, ticks);
    late += ticks > 20;
  }
  EXPECT_LE(late, 10);
  RecordProperty("late", late);
  RecordProperty("slowest_ticks", slowest);
}

TEST(Abuse, TeleportsAndAbsurdNumbersStayFinite) {
  Draw draw{std::mt19937_64(2)};
  const double huge[] = {1e3, 1e9, 1e38, 1e160, std::numeric_limits<double>::max()};
  for (int i = 0; i < 1000; ++i) {
    const auto n = any_needle(draw);
    const double size = huge[i % 5];
    for (int tick = 0; tick < 10; ++tick) {
      const Vec3d axis = draw.within(1);
      n->handle = turn_about(axis, draw.between(-3, 3));
      n->loads.count = 0;
      while (n->loads.count < kMaxRodLoads) {
        RodLoad& load = n->add(draw.between(-1, 2) * n->length_m);
        load.place_m = size * draw.within(1);
        load.force_n = size * draw.within(1);
        load.stiffness_n_per_m = any_spring(draw, size);
      }
      n->tick();
      expect_sound(*n, i);
    }
  }
}

// A needle is pushed on its tip, through its buckling load and far beyond, then released.
TEST(Abuse, ThinNeedleUnderThirtyNewtonsBucklesOnceAndComesBack) {
  const auto n = needle(64, 0.12, 6.425e-4);
  n->push(0.12, {1e-3, 0, 0});
  for (int tick = 0; tick < 300; ++tick) {
    n->loads.load[0].force_n.z = 0.1 * tick;
    n->tick();
    expect_sound(*n, tick);
  }
  EXPECT_GT(n->tip().z, 0.1);  // folded over, pulled straight from its clamp
  ASSERT_TRUE(n->settle(1e-12));
  n->loads.count = 0;
  ASSERT_TRUE(n->settle(1e-12));
  EXPECT_LT(norm(n->tip() - Vec3d{0, 0, -0.12}), 1e-10);
}

// A tip is held while the handle comes nearer: the needle bows to one side and stays there. Its
// energy falls until it rests, and it does not flip afterwards.
TEST(Abuse, SnapThroughEndsAndNeverFlipsBack) {
  const auto n = needle(64, 0.15, 2.318e-3);
  n->hold(0.15, {0, 0, -0.15}, 1e4 * kIsotropic);
  n->push(0.075, {1e-3, 0, 0});
  for (int tick = 0; tick < 200; ++tick) {
    n->loads.load[0].place_m.z += 1e-4;
    n->tick();
  }
  ASSERT_TRUE(n->settle(1e-12));
  const double bow = n->result.node_m[32].x;
  EXPECT_GT(bow, 0.01);
  n->loads.load[1].force_n.x = -3;  // over to the other side
  ASSERT_TRUE(n->settle(1e-12));
  n->loads.load[1].force_n.x = 0;
  ASSERT_TRUE(n->settle(1e-12));
  EXPECT_NEAR(n->result.node_m[32].x, -bow, 1e-3 * bow);
  for (int tick = 0; tick < 1000; ++tick) {
    n->tick();
    ASSERT_LT(n->result.last_turn_rad, 1e-11) << tick;
  }
}

// A needle is pressed along its axis far beyond its buckling load, with Newton steps as short as
// after one that failed. It ends as the elastica: under (2 K / pi)^2 of Euler's load the tip is at
// 2 E / K - 1 of the length (Timoshenko and Gere, Theory of Elastic Stability, 2.7).
TEST(Abuse, CarefulStepsUnderManyTimesTheBucklingLoadFindTheElastica) {
  const double length_m = 0.15, bending_nm2 = 2.6e-3;
  // At most 5 mm a step; the weight of a rod of 3 mm of 22G steel, over a millisecond squared.
  const RodCare care = {5e-3, 10};
  for (const double sine : {0.9, 0.99, 0.997}) {  // of half the angle at the tip
    const double k = std::comp_ellint_1(sine), e = std::comp_ellint_2(sine);
    const double load_n = k * k * bending_nm2 / (length_m * length_m);
    for (const double share : {0.5, 0.25}) {
      const auto n = needle(50, length_m, bending_nm2);
      n->push(length_m, {1e-4 * load_n, 0, load_n});
      n->shape.compression_fraction = share;
      RodFaces none{};
      carry_rod(n->model, n->handle.wxyz, n->shape, n->scratch, n->result);
      bool rests = false;
      for (int call = 0; call < 400 && !rests; ++call) {
        bend_rod(n->model, n->handle.wxyz, n->loads, none, care, n->shape, n->scratch, n->result);
        rests = n->result.last_turn_rad < 1e-7;
      }
      EXPECT_TRUE(rests) << sine << " " << share;
      expect_sound(*n, 0);
      EXPECT_LT(worst_moment_error(*n), 1e-6 * load_n * length_m);
      EXPECT_NEAR(-n->tip().z / length_m, 2 * e / k - 1, 2e-3);
    }
  }
}

}  // namespace
}  // namespace stylet::test
