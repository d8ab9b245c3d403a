// SPDX-License-Identifier: Apache-2.0
// first_membrane against a search of all triangles in double, on random membranes and ways.

#include "organ/membranes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "base/math.h"
#include "session.h"
#include "stylet/limits.h"
#include "tiny_organ.h"

namespace stylet::test {
namespace {

struct Chance {
  std::mt19937_64 engine;
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine);
  }
  Vec3 within(Vec3 low, Vec3 size) {
    return low + Vec3{between(0, size.x), between(0, size.y), between(0, size.z)};
  }
};

struct Vec {
  double x, y, z;
};
Vec wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vec minus(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec crossed(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dotted(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Where along the way (0 to 1) a triangle is crossed, by signed volumes; 2: nowhere. `clear_out`:
// how far the crossing is from the triangle's rim and from the way's ends, in parts of them.
double crossing(const std::array<Vec3, 3>& t, Vec3 from_m, Vec3 to_m, double& clear_out) {
  const Vec a = minus(wide(t[0]), wide(from_m)), b = minus(wide(t[1]), wide(from_m)),
            c = minus(wide(t[2]), wide(from_m)), way = minus(wide(to_m), wide(from_m));
  const double u = dotted(way, crossed(c, b)), v = dotted(way, crossed(a, c)),
               w = dotted(way, crossed(b, a)), sum = u + v + w;
  if (sum == 0) return 2;
  const Vec n = crossed(minus(b, a), minus(c, a));
  const double at = dotted(a, n) / dotted(way, n);
  const double parts[] = {u / sum, v / sum, w / sum, at, 1 - at};
  double least = 1;
  for (const double part : parts) least = std::min(least, part);
  clear_out = std::fabs(least);
  return least >= 0 ? at : 2;
}

TinyOrgan random_organ(Chance& chance) {
  TinyOrgan tiny;
  tiny.nx = 7;
  tiny.ny = 5;
  tiny.nz = 6;
  tiny.voxel_edge_m = chance.between(1e-3F, 8e-3F);
  tiny.origin_m = chance.within({-1, -1, -1}, {2, 2, 2});
  tiny.materials.resize(3);
  const Vec3 size = tiny.voxel_edge_m * Vec3{7, 5, 6};
  for (std::uint16_t material = 1; material < 3; ++material) {
    TinyMembrane membrane = {material, {}};
    for (int i = 0; i < 12; ++i) {
      // Also across the organ's border.
      const Vec3 low = tiny.origin_m - 0.2F * size;
      membrane.triangles.push_back({chance.within(low, 1.4F * size),
                                    chance.within(low, 1.4F * size),
                                    chance.within(low, 1.4F * size)});
    }
    tiny.membranes.push_back(membrane);
  }
  return tiny;
}

TEST(Membranes, TheFirstOnAWayIsThatOfAllTriangles) {
  Chance chance = {std::mt19937_64(61)};
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    const TinyOrgan tiny = random_organ(chance);
    const auto organ = open_organ(tiny_organ(tiny));
    const Vec3 size = tiny.voxel_edge_m * Vec3{7, 5, 6};
    for (int j = 0; j < 500; ++j) {
      const Vec3 from_m = chance.within(tiny.origin_m, size);
      Vec3 to_m = chance.within(tiny.origin_m, size);
      if (j % 2 == 0) to_m = from_m + 0.05F * (to_m - from_m);  // a tick's way
      double expected = 1, clear = 1;
      std::uint32_t material = kNoTissue;
      for (const TinyMembrane& membrane : tiny.membranes) {
        for (const auto& t : membrane.triangles) {
          double here = 1;
          const double at = crossing(t, from_m, to_m, here);
          clear = std::min(clear, here);
          if (at >= expected) continue;
          expected = at;
          material = membrane.material;
        }
      }
      if (clear < 1e-3) continue;  // at a rim or an end: rounding may decide
      const MembraneCrossing seen = first_membrane(organ->organ, {}, 0, from_m, to_m);
      ASSERT_EQ(seen.material, material) << i << ' ' << j;
      ASSERT_NEAR(static_cast<double>(seen.clear), expected, 1e-3) << i << ' ' << j;
      found += material != kNoTissue ? 1 : 0;
    }
  }
  EXPECT_GT(found, 1000);
}

// Two triangles share a side: no way goes between them.
TEST(Membranes, NoWayLeadsBetweenTwoTriangles) {
  Chance chance = {std::mt19937_64(62)};
  for (int i = 0; i < 20; ++i) {
    TinyOrgan tiny = random_organ(chance);
    const float edge = tiny.voxel_edge_m;
    const Vec3 low = tiny.origin_m + edge * Vec3{0.3F, 0.3F, 1}, high = low + edge * Vec3{6, 4, 3};
    const Vec3 b = {high.x, low.y, chance.between(low.z, high.z)};
    const Vec3 d = {low.x, high.y, chance.between(low.z, high.z)};
    const TinyMembrane sheet = {1, {{low, b, d}, {b, high, d}}};
    tiny.membranes = {sheet};
    const auto organ = open_organ(tiny_organ(tiny));
    for (int j = 0; j < 2000; ++j) {
      const Vec3 on = b + chance.between(0.02F, 0.98F) * (d - b);
      const Vec3 up = {edge * chance.between(-0.3F, 0.3F), edge * chance.between(-0.3F, 0.3F),
                       edge};
      const MembraneCrossing seen =
          first_membrane(organ->organ, {}, 0, on - 0.9F * up, on + 0.9F * up);
      ASSERT_EQ(seen.material, 1U) << i << ' ' << j;
    }
  }
}

// What is not searched is not called free.
TEST(Membranes, AWayThatIsTooLongIsFreeOnlyAsFarAsItIsSearched) {
  Chance chance = {std::mt19937_64(63)};
  TinyOrgan tiny = random_organ(chance);
  const Vec3 corner = tiny.origin_m;  // beside the way
  tiny.membranes = {{1, {{corner, corner + Vec3{1e-3F, 0, 0}, corner + Vec3{0, 1e-3F, 0}}}}};
  const auto organ = open_organ(tiny_organ(tiny));
  const Vec3 from_m = tiny.origin_m + tiny.voxel_edge_m * Vec3{3, 3, 3};
  const float edges = 4 * static_cast<float>(kMaxMembraneSteps);
  const MembraneCrossing seen =
      first_membrane(organ->organ, {}, 0, from_m, from_m + Vec3{0, 0, edges * tiny.voxel_edge_m});
  EXPECT_EQ(seen.material, kNoTissue);
  EXPECT_NEAR(static_cast<double>(seen.clear), 0.25, 1e-3);
}

// A hole is open for a way near it, and only in its own sheet.
TEST(Membranes, AHoleIsOpenWhereItIs) {
  Chance chance = {std::mt19937_64(64)};
  for (int i = 0; i < 200; ++i) {
    TinyOrgan tiny = random_organ(chance);
    const float edge = tiny.voxel_edge_m, mouth_m = chance.between(0.5e-3F, 2e-3F);
    const Vec3 low = tiny.origin_m + edge * Vec3{0.5F, 0.5F, 2}, side = {6 * edge, 0, edge};
    const Vec3 other = {0, 4 * edge, -edge}, fold = {0, 0, chance.between(1e-4F, 4e-4F)};
    const auto sheet = [&](Vec3 at) {
      return std::vector<std::array<Vec3, 3>>{{at, at + side, at + other},
                                              {at + side, at + side + other, at + other}};
    };
    TinyMembrane both = {1, sheet(low)};
    for (const auto& t : sheet(low + fold)) both.triangles.push_back(t);
    tiny.membranes = {both};
    const auto organ = open_organ(tiny_organ(tiny));
    const Vec3 hole_m =
        low + chance.between(0.3F, 0.7F) * side + chance.between(0.3F, 0.7F) * other;
    const Vec3 across = cross(side, other), normal = (1 / norm(across)) * across;
    const MembraneOpening hole = {hole_m, normal, 1};
    const auto met = [&](Vec3 at_m) {
      const Vec3 up = {0, 0, 1e-4F * 0.9F};
      return first_membrane(organ->organ, {&hole, 1}, mouth_m, at_m - up, at_m + up).material;
    };
    const Vec3 aside = (1 / norm(side)) * side;
    EXPECT_EQ(met(hole_m + 0.9F * mouth_m * aside), kNoTissue);
    EXPECT_EQ(met(hole_m + 1.1F * mouth_m * aside), 1U) << "beside it";
    EXPECT_EQ(met(hole_m + fold), 1U) << "the other fold";
  }
}

}  // namespace
}  // namespace stylet::test
