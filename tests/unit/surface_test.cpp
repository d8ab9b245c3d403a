// SPDX-License-Identifier: Apache-2.0
// The sphere tree against brute force: ray casts on the rest surface, and first contact on a
// deformed one.

#include "coupling/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "session.h"
#include "state/layout.h"
#include "tiny_organ.h"

namespace stylet::test {
namespace {

struct Vector {
  double x, y, z;
};
Vector wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vector minus(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector cross_of(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot_of(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Where a line crosses a triangle: the plane first, then three edge tests. `margin` is how far
// inside the triangle the crossing lies, relative to its height; negative: outside.
struct Crossing {
  double at, margin;
};
std::optional<Crossing> crossing(Vector from, Vector way, Vector a, Vector b, Vector c) {
  const Vector normal = cross_of(minus(b, a), minus(c, a));
  const double along = dot_of(normal, way);
  if (std::fabs(along) < 1e-3 * std::sqrt(dot_of(normal, normal))) return std::nullopt;
  const double at = dot_of(normal, minus(a, from)) / along;
  const Vector p = {from.x + at * way.x, from.y + at * way.y, from.z + at * way.z};
  const double whole = dot_of(normal, normal);
  double margin = 1;
  const Vector corner[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const Vector e = minus(corner[(i + 1) % 3], corner[i]);
    margin = std::min(margin, dot_of(cross_of(e, minus(p, corner[i])), normal) / whole);
  }
  return Crossing{at, margin};
}

struct Hit {
  double at = 0;
  bool found = false, doubtful = false;  // doubtful: an edge is grazed, and both answers are right
};

enum class Which { kFirst, kLast };

Hit brute_force(const std::vector<Vec3>& places, std::span<const OrganTriangle> triangles,
                Vec3 from, Vec3 way, double to_at, Which which) {
  Hit best;
  for (const OrganTriangle& t : triangles) {
    const auto hit =
        crossing(wide(from), wide(way), wide(places[t.a]), wide(places[t.b]), wide(places[t.c]));
    if (!hit) continue;
    if (std::fabs(hit->margin) < 1e-3 || std::fabs(hit->at) < 1e-5 ||
        std::fabs(hit->at - to_at) < 1e-5) {
      if (hit->margin > -1e-3) best.doubtful = true;
      continue;
    }
    if (hit->margin < 0 || hit->at < 0 || hit->at > to_at) continue;
    const bool better = (which == Which::kFirst) == (hit->at < best.at);
    if (!best.found || better) best.at = hit->at;
    best.found = true;
  }
  return best;
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const Vec3 v = {normal(random), normal(random), normal(random)};
  return (1 / norm(v)) * v;
}

TinyOrgan block() {
  TinyOrgan tiny;
  tiny.nx = 6;
  tiny.ny = 5;
  tiny.nz = 4;
  tiny.origin_m = {0.01F, -0.02F, 0.03F};
  tiny.fixed_faces = kLowZ;
  return tiny;
}

std::vector<Vec3> surface_of(const Kernel& kernel, const Organ& organ) {
  std::vector<Vec3> places(organ.vertices.size());
  EXPECT_EQ(surface(kernel, places), places.size());
  return places;
}

// The vertex's position, trilinear in the corners of its voxel.
Vec3 moved_by_particles(const Organ& organ, std::span<const std::uint32_t> corners,
                        std::span<const Vec3> moved_m, std::size_t vertex) {
  const OrganVertex& v = organ.vertices[vertex];
  const float f[3] = {static_cast<float>(v.fx) / 65535, static_cast<float>(v.fy) / 65535,
                      static_cast<float>(v.fz) / 65535};
  Vec3 sum = {};
  for (std::uint32_t c = 0; c < 8; ++c) {
    float weight = 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      weight *= ((c >> axis) & 1U) != 0 ? f[axis] : 1 - f[axis];
    }
    sum = sum + weight * moved_m[corners[8 * v.voxel + c]];
  }
  return sum;
}

// The block is full, so voxel i is the i-th of its lattice, x first.
TEST(Particles, VerticesOfTheOrganLieWhereTheirVoxelSays) {
  const TinyOrgan tiny = block();
  const auto organ = open_organ(tiny_organ(tiny));
  Session session = make_session(organ->organ, Config{});
  const std::vector<Vec3> rest = surface_of(session.kernel, organ->organ);
  const Vector origin_m = wide(tiny.origin_m);
  const double edge_m = static_cast<double>(tiny.voxel_edge_m);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const OrganVertex& v = organ->organ.vertices[i];
    const std::uint32_t x = v.voxel % tiny.nx, y = v.voxel / tiny.nx % tiny.ny,
                        z = v.voxel / tiny.nx / tiny.ny;
    const Vector place_m = {origin_m.x + edge_m * (x + v.fx / 65535.0),
                            origin_m.y + edge_m * (y + v.fy / 65535.0),
                            origin_m.z + edge_m * (z + v.fz / 65535.0)};
    for (const Vec3 found_m : {organ_vertex_place(organ->organ, x, y, z, v), rest[i]}) {
      const Vector off = minus(wide(found_m), place_m);
      EXPECT_LT(std::sqrt(dot_of(off, off)), 1e-8) << "vertex " << i;  // rounding of 5 cm
    }
  }
}

// A breath moves every particle with the attachments, and a needle moves some of them besides.
TEST(Particles, CarryTheSurface) {
  const auto organ = open_organ(tiny_organ(block()));
  Config config;
  config.breathing.amplitude_m = {0, 0.01F, 0};
  config.breathing.period_s = 0.5F;
  Session session = make_session(organ->organ, config);
  const std::vector<Vec3> rest = surface_of(session.kernel, organ->organ);
  std::vector<std::uint32_t> corners(std::size_t{8} * organ->organ.voxel_count);
  ASSERT_EQ(voxel_corners(session.kernel, corners), corners.size());
  std::vector<Vec3> moved(particle_count(session.kernel));
  for (int i = 0; i < 150; ++i) {
    const float depth = 0.0002F * static_cast<float>(i);
    (void)tick(session.kernel,
               {{{0.02F, -0.01F, 0.06F + config.needle[0].length_m - depth}, {1, 0, 0, 0}}, 1});
  }
  ASSERT_EQ(particles(session.kernel, moved), moved.size());
  std::vector<Vec3> fewer(3), more(moved.size() + 1);
  ASSERT_EQ(particles(session.kernel, fewer), 3U) << "as many as there is room for";
  ASSERT_EQ(particles(session.kernel, more), moved.size()) << "as many as there are";
  EXPECT_EQ(norm(fewer[2] - moved[2]) + norm(more[2] - moved[2]), 0);
  const std::vector<Vec3> now = surface_of(session.kernel, organ->organ);
  float most = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vec3 way = now[i] - rest[i];
    EXPECT_LT(norm(way - moved_by_particles(organ->organ, corners, moved, i)), 1e-7F);
    most = std::max(most, norm(way));
  }
  EXPECT_GT(most, 1e-3F);
}

// 20 000 rays, half of them aimed at the block, seed 5.
TEST(OrganRaycast, FindsWhatBruteForceFinds) {
  const auto organ = open_organ(tiny_organ(block()));
  Session session = make_session(organ->organ, Config{});
  const std::vector<Vec3> places = surface_of(session.kernel, organ->organ);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  int hits = 0, misses = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 target = {0.01F + 0.03F * uniform(random), -0.02F + 0.025F * uniform(random),
                         0.03F + 0.02F * uniform(random)};
    const Vec3 from = target + 0.06F * random_direction(random);
    Vec3 way = random_direction(random);
    if (i % 2 == 0) way = (1 / norm(target - from)) * (target - from);
    const Hit wanted = brute_force(places, organ->organ.triangles, from, way, 1e9, Which::kFirst);
    if (wanted.doubtful) continue;
    float distance = -1;
    ASSERT_EQ(organ_raycast(organ->organ, from, way, distance), wanted.found) << "ray " << i;
    (wanted.found ? hits : misses) += 1;
    if (!wanted.found) continue;
    ASSERT_NEAR(static_cast<double>(distance), wanted.at, 1e-6) << "ray " << i;
  }
  EXPECT_GT(hits, 5000);
  EXPECT_GT(misses, 5000);
}

// Random smooth and rough deformations, 50 of them with 200 needles each, seed 6.
TEST(FindContact, FindsWhatBruteForceFindsOnADeformedSurface) {
  const auto organ = open_organ(tiny_organ(block()));
  Session session = make_session(organ->organ, Config{});
  View view = view_of(session.kernel);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int hits = 0, misses = 0, spent = 0;
  for (int shape = 0; shape < 50; ++shape) {
    const float size = 1e-3F * static_cast<float>(shape % 4);
    float largest = 0;
    for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
      for (float* u : {&view.state.ux[i], &view.state.uy[i], &view.state.uz[i]}) {
        *u = size * uniform(random);
        largest = std::max(largest, std::fabs(*u));
      }
    }
    view.state.head->max_displacement_m = largest;
    const std::vector<Vec3> places = surface_of(session.kernel, organ->organ);
    for (int i = 0; i < 200; ++i) {
      const Vec3 tip = {0.025F + 0.02F * uniform(random), -0.0075F + 0.0175F * uniform(random),
                        0.04F + 0.015F * uniform(random)};
      const Vec3 way = random_direction(random);
      const double reach = 0.02, skin = 2e-5;  // behind the tip; in front of it
      const Hit wanted = brute_force(places, organ->organ.triangles, tip - 0.02F * way, way,
                                     reach - skin, Which::kLast);
      if (wanted.doubtful) continue;
      Vec3 rest = {}, place = {};
      std::uint32_t flags = 0;
      const Contact contact = find_contact(view.model, view.state, tip, way,
                                           contact_reach_m(view.model), {}, rest, place, flags);
      const bool found = contact == Contact::kFound;
      if (flags != 0) {  // more triangles than a tick may test: a late answer, not a wrong one
        ASSERT_EQ(flags, static_cast<std::uint32_t>(kFlagContactBudget));
        ASSERT_FALSE(found);
        ++spent;
        continue;
      }
      ASSERT_EQ(found, wanted.found) << "shape " << shape << ", needle " << i;
      (found ? hits : misses) += 1;
      if (!found) continue;
      const Vector off = minus(wide(place), wide(tip - 0.02F * way));
      ASSERT_NEAR(std::sqrt(dot_of(off, off)), wanted.at, 2e-6);
      // The rest position belongs to the crossing: it is at most as far from it as tissue has
      // moved.
      ASSERT_LE(norm(rest - place), 1.75F * largest + 1e-7F);
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 2000);
  EXPECT_EQ(static_cast<std::uint64_t>(spent), stats(session.kernel).contact_budget);
  EXPECT_LT(spent, 1000) << "of 10 000";
}

TinyOrgan fine_plate() {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = 110;
  tiny.nz = 1;
  tiny.voxel_edge_m = 2e-4F;
  return tiny;
}

// A needle that lies in a fine surface meets more triangles than a tick may test. This is counted
// and flagged, and the needle goes no farther.
TEST(FindContact, CountsWhenItsBudgetIsSpent) {
  const auto organ = open_organ(tiny_organ(fine_plate()));
  Session session = make_session(organ->organ, Config{});
  Input input = {{{0.0215F - 0.15F, 0.011F, 2e-4F}, {0.70710678F, 0, -0.70710678F, 0}}, 1};
  float& moved_m = view_of(session.kernel).state.head->max_displacement_m;  // elsewhere
  moved_m = 1e-3F;
  Output out = tick(session.kernel, input);
  EXPECT_EQ(out.flags, static_cast<std::uint32_t>(kFlagContactBudget));
  EXPECT_EQ(stats(session.kernel).contact_budget, 1U);
  EXPECT_EQ(out.phase, Phase::kFree);
  const Vec3 before = out.tip_m;
  input.handle.position_m.x += 1e-4F;
  moved_m = 1e-3F;
  out = tick(session.kernel, input);
  EXPECT_EQ(out.flags, static_cast<std::uint32_t>(kFlagContactBudget | kFlagInputClamped));
  EXPECT_EQ(out.tip_m.x, before.x);
  input.handle.position_m.z += 0.05F;  // away from the surface it is free
  for (int i = 0; i < 20; ++i) out = tick(session.kernel, input);
  EXPECT_EQ(out.flags & kFlagContactBudget, 0U);
}

// A needle lies nearly in the surface and goes through it, at a random distance behind its tip:
// either the surface is found, or a flag says that it is not known; there is no third outcome.
TEST(FindContact, TakesWhatItFoundWithinItsBudget) {
  const auto organ = open_organ(tiny_organ(fine_plate()));
  Session session = make_session(organ->organ, Config{});
  const float length_m = Config{}.needle[0].length_m;
  std::mt19937 random(12);
  std::uint32_t found = 0, unknown = 0;
  for (int i = 0; i < 300; ++i) {
    const auto part = [&] { return static_cast<float>(random() % 10000U) * 1e-4F; };
    const float slope = 1e-3F + 5e-3F * part(), behind_m = 15e-3F * part();
    const float turn = 0.5F * (-1.57079633F + slope);  // half of that about y
    const Vec3 tip_m = {0.0215F, 0.011F, 2e-4F - slope * behind_m};
    const Vec3 base_m = tip_m - length_m * Vec3{std::cos(slope), 0, -std::sin(slope)};
    reset(session.kernel);
    view_of(session.kernel).state.head->max_displacement_m = 1e-3F;  // elsewhere
    const Output out = tick(session.kernel, {{base_m, {std::cos(turn), 0, std::sin(turn), 0}}, 1});
    const bool told = (out.flags & kFlagContactBudget) != 0;
    if (slope * behind_m < 1e-6F) continue;  // within the skin
    EXPECT_EQ(out.phase, told ? Phase::kFree : Phase::kContact) << behind_m << ", " << slope;
    (told ? unknown : found) += 1;
  }
  EXPECT_GT(found, 0U);
  EXPECT_GT(unknown, 0U);
}

}  // namespace
}  // namespace stylet::test
