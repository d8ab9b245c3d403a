// SPDX-License-Identifier: Apache-2.0
// Rest shapes, roll, frames, and how closely the shape follows a moving hand.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kLength = 0.12, k22G = 2.318e-3;
constexpr std::uint32_t kRods = 60;

// Straight except for the last third, which bends to the handle's x by the same angle at each
// joint.
std::vector<RodKink> bent_tip(double kink_rad) {
  std::vector<RodKink> rest(kRods);
  for (std::uint32_t j = 40; j < kRods; ++j) rest[j] = {std::sin(kink_rad), 0};
  return rest;
}

TEST(RestShape, IsKeptWithoutLoad) {
  const double kink = 0.02;
  const auto n = needle(kRods, kLength, k22G, bent_tip(kink));
  n->tick();
  EXPECT_LT(n->result.last_turn_rad, 1e-14);
  EXPECT_NEAR(n->result.direction[kRods - 1].x, std::sin(20 * kink), 1e-13);
  EXPECT_NEAR(n->result.direction[kRods - 1].z, -std::cos(20 * kink), 1e-13);
  EXPECT_NEAR(n->result.direction[39].z, -1, 1e-15);
}

TEST(RestShape, IsReachedFromAnyOtherShape) {
  const auto n = needle(kRods, kLength, k22G, bent_tip(0.02));
  n->push(kLength, {0.2, 0.3, 0.4});
  ASSERT_TRUE(n->settle());
  EXPECT_GT(std::abs(n->tip().y), 1e-3);
  n->loads.count = 0;
  ASSERT_TRUE(n->settle());
  EXPECT_NEAR(n->result.direction[kRods - 1].x, std::sin(0.4), 1e-12);
  EXPECT_NEAR(n->tip().y, 0, 1e-12);
}

TEST(RestShape, HelixOfKinksInTheMaterialsFrame) {
  // Kinks that turn about the shaft by a fixed angle from joint to joint: a discrete helix, in
  // which all triples of neighbouring rods have the same shape.
  std::vector<RodKink> rest(kRods);
  for (std::uint32_t j = 1; j < kRods; ++j) {
    rest[j] = {0.1 * std::cos(0.3 * j), 0.1 * std::sin(0.3 * j)};
  }
  const auto n = needle(kRods, kLength, k22G, rest);
  n->tick();
  EXPECT_LT(n->result.last_turn_rad, 1e-13);
  const auto volume = [&](std::uint32_t j) {
    const Vec3d* t = n->result.direction + j;
    return dot(t[0], cross(t[1], t[2]));
  };
  for (std::uint32_t j = 1; j + 2 < kRods; ++j) EXPECT_NEAR(volume(j), volume(1), 1e-13) << j;
  EXPECT_GT(std::abs(volume(1)), 1e-4);
}

TEST(Roll, TurnsThePlaneOfThePreBentNeedle) {
  const auto n = needle(kRods, kLength, k22G, bent_tip(0.02));
  n->tick();
  const Vec3d before = n->tip();
  for (const double roll : {0.5, 2.0, 3.1}) {
    n->handle = turn_about({0, 0, 1}, roll);
    n->tick();
    EXPECT_LT(norm(n->tip() - turned(n->handle, before)), 1e-13);
    EXPECT_NEAR(std::atan2(n->tip().y, n->tip().x), roll, 1e-12);
  }
}

// Tissue around the needle, in the handle's frame.
void embed(Needle& n, double stiffness_n_per_m) {
  for (double arc = 0.04; arc < kLength; arc += 5e-3) {
    n.hold(arc, {0.002 * std::sin(90 * arc), 0.001, -arc}, stiffness_n_per_m * kIsotropic);
  }
}

TEST(Frames, AnyHandlePoseGivesTheSameLocalShape) {
  const auto n = needle(kRods, kLength, k22G, bent_tip(0.02));
  embed(*n, 40);
  n->push(kLength, {0.05, 0.1, 0.2});
  const RodShape rest = n->shape;
  ASSERT_TRUE(n->settle());
  const RodShape settled = n->shape;
  std::mt19937_64 random(5);
  std::normal_distribution<double> draw;
  for (int i = 0; i < 20; ++i) {
    const auto m = std::make_unique<Needle>(*n);
    m->shape = rest;
    m->handle = turn_about({draw(random), draw(random), draw(random)}, 3 * draw(random));
    for (std::uint32_t k = 0; k < m->loads.count; ++k) {
      m->loads.load[k].place_m = turned(m->handle, n->loads.load[k].place_m);
      m->loads.load[k].force_n = turned(m->handle, n->loads.load[k].force_n);
    }
    ASSERT_TRUE(m->settle());
    for (std::uint32_t j = 0; j < kRods; ++j) {
      EXPECT_LT(norm(m->shape.direction[j] - settled.direction[j]), 1e-12) << j;
    }
    EXPECT_LT(norm(m->result.torque_nm - turned(m->handle, n->result.torque_nm)), 1e-12);
  }
}

TEST(Loads, BetweenNodesActByTheLever) {
  const auto n = needle(10, 0.1, k22G);
  n->push(0.0537, {0.1, 0, 0});
  ASSERT_TRUE(n->settle());
  const auto m = needle(10, 0.1, k22G);
  m->push(0.05, {0.063, 0, 0});
  m->push(0.06, {0.037, 0, 0});
  ASSERT_TRUE(m->settle());
  EXPECT_LT(norm(n->tip() - m->tip()), 1e-14);
  EXPECT_GT(n->tip().x, 1e-4);
  const Vec3d inner = rod_point(n->model, n->result, 0.0537).place_m;
  const Vec3d lever = 0.63 * n->result.node_m[5] + 0.37 * n->result.node_m[6];
  EXPECT_LT(norm(inner - lever), 1e-15);
}

// A 22G needle 80 mm in tissue, its handle swung and rolled as fast as a hand can: each tick's
// shape is compared with the equilibrium of that tick.
TEST(WarmStart, FollowsAHandWithinAMicrometre) {
  const auto n = needle(kRods, kLength, k22G, bent_tip(0.01));
  double worst_m = 0, largest_motion_m = 0;
  Vec3d before{0, 0, -kLength};
  for (int tick = 0; tick < 1000; ++tick) {
    const double s = 1e-3 * tick;
    const Vec3d handle{0.02 * std::sin(12 * s), 0.01 * std::sin(17 * s), 0.01 * std::sin(9 * s)};
    n->handle = turn_about({0.2 * std::sin(11 * s), 0.2 * std::cos(7 * s), 1}, 10 * s);
    n->loads.count = 0;
    for (double arc = 0.04; arc < kLength; arc += 4e-3) {
      n->hold(arc, Vec3d{0, 0, -arc} - handle, 40 * kIsotropic);
    }
    n->tick();
    const auto exact = std::make_unique<Needle>(*n);
    ASSERT_TRUE(exact->settle(1e-12)) << tick;
    worst_m = std::max(worst_m, norm(n->tip() - exact->tip()));
    largest_motion_m = std::max(largest_motion_m, norm(n->tip() - before));
    before = n->tip();
  }
  EXPECT_LT(worst_m, 1e-6);
  EXPECT_GT(largest_motion_m, 1e-4);
  RecordProperty("worst_um", std::to_string(worst_m * 1e6));
}

}  // namespace
}  // namespace stylet::test
