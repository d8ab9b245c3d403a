// SPDX-License-Identifier: Apache-2.0
// V13, V14: how stiff the tissue feels to one constraint particle, and to a line of them.
//
// Infinite bodies are balls whose outside is fixed, with two radii R; the compliance at the middle
// is extrapolated linearly in 1 / R. Stiffness is in units of G h.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr float kEdge = 0.005F, kShear = 2000;
constexpr double kSpring = static_cast<double>(kShear * kEdge);  // G h
constexpr float kPush = 0.01F * kEdge;
// Goals are rounded to 1e-7 of an edge, which is 1e-5 of the push, and tissue moves by a quarter of
// the push.
constexpr double kStill = 4e-5;

// The origin for which a given place, in voxel edges, lies at 0. The needle's positions are world
// coordinates as floats: near 0 their rounding does not matter in these small pushes.
Vec3 middle_at(const Vec& centre) {
  return -kEdge * Vec3{static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                       static_cast<float>(centre.z())};
}

// Force over displacement, in G h, of the constraint particle as the last step left it.
double stiffness_felt(const Rig& rig, const Particle& p, std::size_t axis, float push_m = kPush) {
  View seen = rig.view();
  measure_forces(seen.model, seen.state);
  const float force[3] = {p.force_n.x, p.force_n.y, p.force_n.z};
  return static_cast<double>(force[axis]) / static_cast<double>(push_m) / kSpring;
}

// ---- V13

enum class Body { kInfinite, kHalfSpace };

struct PointCase {
  const char* name;
  Body body;
  Vec3 offset;  // of the particle from its voxel's centre, in voxel edges
  float poisson;
  float weight;
  double wanted;
};

// The ball's middle is the particle; a half ball ends at the top of the particle's voxel.
double point_stiffness(const PointCase& c, std::uint32_t radius) {
  const bool infinite = c.body == Body::kInfinite;
  const auto across = static_cast<std::uint16_t>(2 * radius + 1);
  const auto high = static_cast<std::uint16_t>(infinite ? 2 * radius + 1 : radius + 1);
  const Node voxel = {radius, radius, infinite ? radius : high - 1U};
  const Vec centre = in_edges(voxel) + Vec(0.5, 0.5, infinite ? 0.5 : 1);
  TinyOrgan tiny = block_of(across, across, high, elastic(kShear, c.poisson));
  tiny.origin_m = middle_at(centre);
  Rig rig = make_rig(tiny, resting_config(1, c.poisson, radius));
  fix_beyond(rig, centre, radius);
  const Particle& p = hold_constraint_particle(rig, voxel, kEdge * c.offset, {0, 0, -kPush},
                                               c.weight * kShear * kEdge);
  settle(rig, kStill);
  return -stiffness_felt(rig, p, 2);
}

void PrintTo(const PointCase& c, std::ostream* out) {
  *out << c.name << ", nu " << c.poisson << ", weight " << c.weight;
}

class FidelityV13 : public testing::TestWithParam<PointCase> {};

TEST_P(FidelityV13, StiffnessOfOneConstraintParticle) {
  constexpr std::uint32_t kNear = 8, kFar = 14;
  const PointCase& c = GetParam();
  const double near = 1 / point_stiffness(c, kNear), far = 1 / point_stiffness(c, kFar);
  const double beyond = (far - near) / (1.0 / kNear - 1.0 / kFar) / kFar;
  const double stiffness = 1 / (far + beyond);
  EXPECT_NEAR(stiffness / c.wanted, 1, 0.03);
}

constexpr Vec3 kMiddle = {0, 0, 0}, kCorner = {0.5F, 0.5F, 0.5F}, kTopFace = {0, 0, 0.5F};
constexpr PointCase kPointTable[] = {
    {"InsideMiddle", Body::kInfinite, kMiddle, 0, 1, 0.833},
    {"InsideMiddle", Body::kInfinite, kMiddle, 0, 8, 3.07},
    {"InsideMiddle", Body::kInfinite, kMiddle, 0, 100, 4.74},
    {"InsideCorner", Body::kInfinite, kCorner, 0, 1, 0.742},
    {"InsideCorner", Body::kInfinite, kCorner, 0, 8, 2.21},
    {"InsideCorner", Body::kInfinite, kCorner, 0, 100, 3.07},
    {"InsideMiddle", Body::kInfinite, kMiddle, 0.45F, 1, 0.842},
    {"InsideMiddle", Body::kInfinite, kMiddle, 0.45F, 8, 3.20},
    {"InsideMiddle", Body::kInfinite, kMiddle, 0.45F, 100, 5.07},
    {"SurfaceMiddle", Body::kHalfSpace, kMiddle, 0, 1, 0.774},
    {"SurfaceMiddle", Body::kHalfSpace, kMiddle, 0, 8, 2.40},
    {"SurfaceMiddle", Body::kHalfSpace, kMiddle, 0, 100, 3.31},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0, 1, 0.774},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0, 8, 2.40},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0, 100, 3.31},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0.45F, 1, 0.805},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0.45F, 8, 2.72},
    {"SurfaceTopFace", Body::kHalfSpace, kTopFace, 0.45F, 100, 3.96},
    {"SurfaceCorner", Body::kHalfSpace, kCorner, 0.45F, 1, 0.713},
    {"SurfaceCorner", Body::kHalfSpace, kCorner, 0.45F, 8, 1.99},
    {"SurfaceCorner", Body::kHalfSpace, kCorner, 0.45F, 100, 2.66}};
INSTANTIATE_TEST_SUITE_P(Table, FidelityV13, testing::ValuesIn(kPointTable),
                         [](const testing::TestParamInfo<PointCase>& row) {
                           const PointCase& c = row.param;
                           return c.name +
                                  ("Nu" + std::to_string(static_cast<int>(c.poisson * 100))) +
                                  "Weight" + std::to_string(static_cast<int>(c.weight));
                         });

// All corners are held: this is what the hand feels in the first instant. At the centre 8 w / (8 +
// w).
TEST(FidelityV13Frozen, InstantaneousStiffnessOfOneConstraintParticle) {
  struct Case {
    Vec3 offset;
    float weight;
    double wanted;
  };
  const Case table[] = {{kMiddle, 1, 8.0 / 9}, {kMiddle, 8, 4},    {kMiddle, 100, 800.0 / 108},
                        {kCorner, 1, 0.804},   {kCorner, 8, 2.86}, {kCorner, 100, 4.54}};
  for (const Case& c : table) {
    TinyOrgan tiny = block_of(3, 3, 3, elastic(kShear, 0));
    tiny.origin_m = middle_at(Vec::Constant(1.5));
    Rig rig = make_rig(tiny, resting_config(1, 0, 3));
    fix_beyond(rig, Vec(0, 0, 0), 0);
    constexpr float kSmall = 5e-4F * kEdge;  // linear only if small: the voxel turns
    const Particle& p = hold_constraint_particle(rig, {1, 1, 1}, kEdge * c.offset, {0, 0, -kSmall},
                                                 c.weight * kShear * kEdge);
    step(rig);
    const double stiffness = -stiffness_felt(rig, p, 2, kSmall);
    EXPECT_NEAR(stiffness / c.wanted, 1, 0.002) << "weight " << c.weight;
  }
}

// ---- V14

// Per length, in G: a rigid cylinder of radius a in an annulus fixed at b.
double annulus_stiffness(double a, double b, double poisson) {
  const double n = 3 - 4 * poisson;
  return 8 * M_PI * (1 - poisson) * n /
         (n * n * std::log(b / a) - (b * b - a * a) / (b * b + a * a));
}

// One constraint particle in every voxel of a line: by symmetry a slice one voxel thick is enough,
// whose nodes cannot move along the line. The line is along z, the push along x.
double line_stiffness(std::uint32_t radius, float poisson, float weight) {
  const auto across = static_cast<std::uint16_t>(2 * radius + 1);
  const Vec centre = Vec::Constant(radius + 0.5);
  TinyOrgan tiny = block_of(across, across, 1, elastic(kShear, poisson));
  tiny.origin_m = middle_at(centre);
  Rig rig = make_rig(tiny, resting_config(1, poisson, radius));
  View view = rig.view();
  fix_beyond(rig, centre, radius, {1, 1, 0});
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    if (view.model.step_per_mass[i] > 0) hold(rig, i, 2, 0);
  });
  const Particle& p = hold_constraint_particle(rig, {radius, radius, 0}, {0, 0, 0}, {kPush, 0, 0},
                                               weight * kShear * kEdge);
  settle(rig, kStill);
  return stiffness_felt(rig, p, 0);
}

TEST(FidelityV14, LineOfConstraintParticlesIsASeriesOfSprings) {
  for (const std::uint32_t radius : {5U, 15U}) {
    for (const float poisson : {0.0F, 0.45F}) {
      for (const float weight : {1.0F, 8.0F, 100.0F}) {
        const double wanted =
            1 / (1 / annulus_stiffness(0.68, radius, static_cast<double>(poisson)) + 1.0 / 8 +
                 1 / static_cast<double>(weight));
        const double stiffness = line_stiffness(radius, poisson, weight);
        EXPECT_NEAR(stiffness / wanted, 1, 0.02)
            << "radius " << radius << ", nu " << poisson << ", weight " << weight;
      }
    }
  }
}

}  // namespace
}  // namespace stylet::test
