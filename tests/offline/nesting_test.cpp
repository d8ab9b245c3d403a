// SPDX-License-Identifier: Apache-2.0
// Which side of a surface is outside when bodies lie inside bodies: blobs of random shape, position
// and number, whose volumes are known. And malicious files are done with in bounded time.
#include <sys/resource.h>

#include <numbers>

#include "meshes/repair.h"
#include "offline_support.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Triangle;
using offline::Vec;

double six_volumes(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
  }
  return sum;
}

// A star-shaped body, faces outward, between 0.8 and 1 radius from its middle; poles anywhere.
Mesh blob(Draw& draw, Vec middle, double radius, int rings) {
  const Vec pole = draw.direction();
  const Vec across = cross(pole, draw.direction());
  const Vec u = across * (1 / length(across)), v = cross(pole, u);
  const Vec bump = draw.direction() * draw.between(1, 3);
  Mesh mesh;
  const auto add = [&](double polar, double around) {
    const Vec way =
        pole * std::cos(polar) + (u * std::cos(around) + v * std::sin(around)) * std::sin(polar);
    const double reach = radius * (0.9 + 0.1 * std::sin(3 * dot(bump, way)));
    mesh.points.push_back(middle + way * reach);
  };
  const auto across_count = static_cast<std::uint32_t>(2 * rings);
  add(0, 0);
  for (int ring = 1; ring < rings; ++ring) {
    for (std::uint32_t i = 0; i < across_count; ++i) {
      add(std::numbers::pi * ring / rings, 2 * std::numbers::pi * i / across_count);
    }
  }
  add(std::numbers::pi, 0);
  const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
  for (std::uint32_t i = 0; i < across_count; ++i) {
    const std::uint32_t j = (i + 1) % across_count;
    mesh.triangles.push_back({0, 1 + i, 1 + j});
    for (std::uint32_t ring = 0; ring + 2 < static_cast<std::uint32_t>(rings); ++ring) {
      const std::uint32_t a = 1 + ring * across_count, b = a + across_count;
      mesh.triangles.push_back({a + i, b + i, b + j});
      mesh.triangles.push_back({a + i, b + j, a + j});
    }
    mesh.triangles.push_back({last, last - across_count + j, last - across_count + i});
  }
  return mesh;
}

void turn(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

// Middles in a ball of radius 44, at least 5.5 apart, so that blobs of radius 2.6 do not touch.
std::vector<Vec> places_apart(Draw& draw, std::size_t count) {
  std::vector<Vec> places;
  while (places.size() < count) {
    const Vec at = draw.direction() * (44 * std::cbrt(draw.between(0, 1)));
    const bool apart = std::all_of(places.begin(), places.end(),
                                   [&](Vec other) { return length(at - other) > 5.5; });
    if (apart) places.push_back(at);
  }
  return places;
}

struct Nested {
  Mesh mesh;
  double signed_ml = 0;  // body and islands less cavities; tissue in tissue counts twice
  double tissue_ml = 0;
};

// A body of radius 60 with blobs in it: cavities, some of which hold an island, and tissue in
// tissue.
Nested nested(Draw& draw, std::size_t count, bool only_cavities) {
  std::vector<Mesh> shells = {blob(draw, {}, 60, 24)};
  Nested out;
  out.signed_ml = out.tissue_ml = six_volumes(shells[0]) / 6000;
  for (const Vec& at : places_apart(draw, count)) {
    const double radius = draw.between(1.8, 2.6);
    Mesh hole = blob(draw, at, radius, 5);
    const double ml = six_volumes(hole) / 6000;
    const bool is_tissue = !only_cavities && draw.below(4) == 0;
    out.signed_ml += is_tissue ? ml : -ml;
    out.tissue_ml -= is_tissue ? 0 : ml;
    if (!is_tissue && draw.below(3) == 0) {
      shells.push_back(blob(draw, at, 0.5 * radius, 4));
      const double island_ml = six_volumes(shells.back()) / 6000;
      out.signed_ml += island_ml;
      out.tissue_ml += island_ml;
    }
    if (!is_tissue) turn(hole);
    shells.push_back(std::move(hole));
  }
  if (draw.coin()) {
    for (Mesh& shell : shells) turn(shell);
  }
  draw.shuffle(shells);
  for (const Mesh& shell : shells) append(out.mesh, shell);
  draw.shuffle(out.mesh.triangles);
  return out;
}

double boundary_ml(const offline::Solid& solid) {
  Mesh mesh = {solid.surface.points, solid.boundary};
  return six_volumes(mesh) / 6000;
}

TEST(Nesting, CavitiesOfAnyNumberStayAlsoInsideOut) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    const std::size_t count = 1 + draw.below(300);
    const Nested body = nested(draw, count, false);
    const offline::Solid solid = offline::repair(body.mesh);
    EXPECT_NEAR(boundary_ml(solid) / body.signed_ml, 1, 1e-9) << seed << ": " << count;
  }
}

// Most faces are still right, so they outvote those that were turned at random.
TEST(Nesting, AFewTurnedFacesLoseNoCavity) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    Nested body = nested(draw, 1 + draw.below(80), true);
    for (Triangle& t : body.mesh.triangles) {
      if (draw.below(20) == 0) std::swap(t[1], t[2]);
    }
    EXPECT_NEAR(boundary_ml(offline::repair(body.mesh)) / body.signed_ml, 1, 1e-9) << seed;
  }
}

// If faces are turned without any rule, a body inside tissue is a cavity.
TEST(Nesting, FacesTurnedAtRandomLeaveCavities) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    Nested body = nested(draw, 1 + draw.below(80), true);
    for (Triangle& t : body.mesh.triangles) {
      if (draw.coin()) std::swap(t[1], t[2]);
    }
    EXPECT_NEAR(boundary_ml(offline::repair(body.mesh)) / body.signed_ml, 1, 1e-9) << seed;
  }
}

// Volume of the organ by its samples, each of which is 1/64 of a voxel. A cavity of a voxel or two
// is off by a fraction of its own volume; 200 of them together by 1 % of theirs, which is a
// thousandth of the whole.
TEST(Nesting, VolumeOfTheOrganIsThatOfItsTissue) {
  for (unsigned seed = 101; seed <= 104; ++seed) {
    Draw draw(seed);
    const Nested body = nested(draw, 100 + draw.below(200), false);
    offline::BuildOptions options;
    options.voxel_edge_m = draw.between(1.5, 2.5) * 1e-3;
    const auto bytes = build_quietly({input_of(body.mesh, 1e-3)}, options).bytes;
    EXPECT_NEAR(volume_m3(opened(bytes)) * 1e6 / body.tissue_ml, 1, 2e-3) << seed;
  }
}

// ---- time ---------------------------------------------------------------------------------------

double own_time_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

// Separate triangles with points of their own, as text with too few digits leaves them.
Mesh jittered(Draw& draw, int rings) {
  const Mesh whole = blob(draw, {}, 50, rings);
  Mesh mesh;
  for (const Triangle& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const std::uint32_t corner : t) {
      mesh.points.push_back(whole.points[corner] + draw.direction() * 1e-6);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Mesh onion(Draw& draw, std::size_t shells) {
  Mesh mesh;
  for (std::size_t i = 0; i < shells; ++i) {
    Mesh shell = blob(draw, {}, 1, 3);
    const double size = 10 + 0.001 * static_cast<double>(i);
    for (Vec& p : shell.points) p = p * (size / length(p));
    if (draw.coin()) turn(shell);
    append(mesh, shell);
  }
  return mesh;
}

// Tetrahedra, many of them around one edge, open ones, and randomly connected points.
Mesh soup(Draw& draw, std::size_t triangles) {
  Mesh mesh;
  for (std::size_t i = 0; i < triangles; ++i) mesh.points.push_back(draw.direction() * 40);
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto any = [&] { return static_cast<std::uint32_t>(draw.below(triangles)); };
    mesh.triangles.push_back(draw.coin() ? Triangle{0, 1, any()} : Triangle{any(), any(), any()});
  }
  return mesh;
}

// A file four times as large may take eight times as long: n log n with some room, but not n^2.
template <typename Make>
void expect_near_linear(const char* what, Make make) {
  const Mesh small = make(1), large = make(4);
  const double start = own_time_s();
  (void)offline::repair(small);
  const double middle = own_time_s();
  (void)offline::repair(large);
  const double small_s = middle - start, large_s = own_time_s() - middle;
  constexpr double kClockS = 0.2;
  EXPECT_LT(large_s, 8 * small_s + kClockS) << what << ": " << small_s << " s, " << large_s << " s";
  EXPECT_LT(large_s, 20) << what;
}

TEST(Time, OfARepairGrowsWithTheTriangles) {
  Draw draw(7);
  expect_near_linear("jittered", [&](int n) { return jittered(draw, n == 1 ? 80 : 160); });
  expect_near_linear("soup", [&](int n) { return soup(draw, 10000U * static_cast<unsigned>(n)); });
  expect_near_linear("cavities", [&](int n) {
    Mesh mesh = box_mesh({-1, -1, -1}, {200, 200, 200});
    for (int i = 0; i < 1500 * n; ++i) {
      Mesh hole =
          blob(draw, Vec{i % 40 * 4.9 + 3, i / 40 % 40 * 4.9 + 3, i / 1600 * 4.9 + 3}, 2, 3);
      turn(hole);
      append(mesh, hole);
    }
    return mesh;
  });
}

// Shells inside each other, each in the boxes of all others: a second or two.
TEST(Time, OfShellsInShellsIsBounded) {
  Draw draw(8);
  const Mesh mesh = onion(draw, 500);
  const double start = own_time_s();
  (void)offline::repair(mesh);
  EXPECT_LT(own_time_s() - start, 10);
}

}  // namespace
}  // namespace stylet::test
