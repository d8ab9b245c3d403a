// SPDX-License-Identifier: Apache-2.0
// V18, V19: a needle in an elastic foundation of springs; and the handle carries all loads.
#include <gtest/gtest.h>

#include <random>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kFoundation = 9400;  // N/m per m of needle
constexpr double k18G = 2.07e-2, k22G = 2.318e-3;

// Springs in the middle of the rods beyond free_m, at rest on the straight line below the handle.
// The handle itself has moved sideways.
void embed(Needle& n, double free_m, double handle_x_m) {
  for (std::uint32_t j = 0; j < n.model.rods; ++j) {
    const double arc = (j + 0.5) * n.model.rod_m;
    if (arc < free_m) continue;
    n.hold(arc, {-handle_x_m, 0, -arc}, kFoundation * n.model.rod_m * kLateral);
  }
}

// Force and moment (N, Nm) that the hand needs for a small sideways motion or turn of the handle.
struct Answer {
  double force_n, moment_nm;
};
Answer moved(std::uint32_t rods, double length_m, double bending, double x_m, double turn_rad) {
  const auto n = needle(rods, length_m, bending);
  n->handle = turn_about({0, 1, 0}, turn_rad);
  embed(*n, 0, x_m);
  EXPECT_TRUE(n->settle());
  return {-n->result.force_n.x, -n->result.torque_nm.y};
}

TEST(Foundation, FreeBeamLoadedAtItsEnd) {
  struct Row {
    double bending, length_m, y_mm, turn_rad;
  };
  for (const Row& row : {Row{k18G, 0.05, 8.5679, -0.26162}, Row{k18G, 0.10, 4.6827, -0.08759},
                         Row{k18G, 0.15, 3.9690, -0.07203}, Row{k22G, 0.10, 6.7736, -0.21423}}) {
    const double beta = std::sqrt(std::sqrt(kFoundation / (4 * row.bending)));
    const double u = beta * row.length_m;
    const double sh = std::sinh(u), ch = std::cosh(u), si = std::sin(u), co = std::cos(u);
    const double bottom = sh * sh - si * si;
    const double y = 2 * beta / kFoundation * (sh * ch - si * co) / bottom;
    const double turn = -2 * beta * beta / kFoundation * (sh * sh + si * si) / bottom;
    EXPECT_NEAR(y * 1e3 / row.y_mm, 1, 1e-4);
    EXPECT_NEAR(turn / row.turn_rad, 1, 1e-4);

    // The handle is a clamp; a free end is a motion of the handle that needs no moment.
    const double x_m = 1e-6, turn_rad = 1e-5;
    const Answer a = moved(40, row.length_m, row.bending, x_m, 0);
    const Answer b = moved(40, row.length_m, row.bending, 0, turn_rad);
    const double ratio = -a.moment_nm / b.moment_nm;
    const double force = a.force_n + ratio * b.force_n;
    EXPECT_NEAR(x_m / force / y, 1, 5e-3) << row.length_m;
    EXPECT_NEAR(-ratio * turn_rad / force / turn, 1, 5e-3) << row.length_m;
  }
}

TEST(Foundation, HandleStiffnessOfANeedlePartlyInside) {
  struct Row {
    double bending, free_m, inside_m, n_per_m;
    std::uint32_t rods;
  };
  for (const Row& row : {Row{k18G, 0.05, 0.05, 131.82, 40}, Row{k18G, 0.05, 0.10, 152.47, 42},
                         Row{k18G, 0.10, 0.05, 40.58, 42}, Row{k22G, 0.05, 0.05, 38.99, 40},
                         Row{k22G, 0.05, 0.10, 45.98, 42}, Row{k22G, 0.10, 0.05, 10.31, 42}}) {
    const auto n = needle(row.rods, row.free_m + row.inside_m, row.bending);
    const double x_m = 1e-6;
    embed(*n, row.free_m, x_m);
    ASSERT_TRUE(n->settle());
    EXPECT_NEAR(-n->result.force_n.x / x_m / row.n_per_m, 1, 5e-3)
        << row.free_m << " " << row.inside_m;
  }
}

// A needle bent far by springs and forces in all directions.
void load_anyhow(Needle& n, std::mt19937_64& random) {
  const auto draw = [&](double size) {
    return std::uniform_real_distribution<double>(-size, size)(random);
  };
  for (int i = 0; i < 20; ++i) {
    const double arc = n.length_m * (0.5 + 0.5 * draw(1));
    n.push(arc, {draw(0.2), draw(0.2), draw(0.2)});
    n.hold(arc, {draw(0.02), draw(0.02), draw(0.02) - arc}, 50 * kIsotropic);
  }
}

TEST(Wrench, EveryJointCarriesTheLoadsBeyondIt) {
  std::mt19937_64 random(19);
  for (int i = 0; i < 50; ++i) {
    RodKink rest[64] = {};
    for (int j = 40; j < 64; ++j) rest[j] = {0.02 * (i % 3), 0.01};  // a third of them straight
    if (i % 3 == 0) rest[40] = {};
    const auto n = needle(64, 0.15, k22G, i % 3 == 0 ? std::span<const RodKink>{} : rest);
    n->handle = turn_about({0.3, 0.2, 1}, 0.1 * i);
    load_anyhow(*n, random);
    ASSERT_TRUE(n->settle()) << i;
    Vec3d force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (std::uint32_t k = 0; k < n->loads.count; ++k) {
      const Vec3d at = rod_point(n->model, n->result, n->loads.load[k].arc_m).place_m;
      force = force + n->result.load_n[k];
      torque = torque + cross(at, n->result.load_n[k]);
      size += norm(at) * norm(n->result.load_n[k]);
    }
    EXPECT_LT(norm(n->result.force_n - force), 1e-8 * norm(force));
    EXPECT_LT(norm(n->result.torque_nm - torque), 1e-8 * size);
    EXPECT_LT(worst_moment_error(*n), 1e-8 * size) << i;
  }
}

}  // namespace
}  // namespace stylet::test
