// SPDX-License-Identifier: Apache-2.0
// The skin of an organ counts by the area of its surface in each voxel, however the surface runs
// through the lattice; and a needle feels it as a film wherever its face lies.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "draw.h"
#include "lattice/voxel.h"
#include "laws/film.h"
#include "offline_support.h"
#include "pose.h"
#include "session.h"
#include "state/layout.h"
#include "voxels/attach.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Vec;

// A box about its middle, turned by a drawn rotation.
struct Turned {
  Vec half_m, middle_m;
  Vec axes[3];

  Vec place(Vec p) const { return middle_m + axes[0] * p.x + axes[1] * p.y + axes[2] * p.z; }
};

Turned drawn_box(DoubleDraw& draw, Vec half_m) {
  const double w = draw.between(-1, 1), x = draw.between(-1, 1), y = draw.between(-1, 1),
               z = draw.between(-1, 1), n = std::sqrt(w * w + x * x + y * y + z * z);
  const double a = w / n, b = x / n, c = y / n, d = z / n;
  Turned box = {half_m, {}, {}};
  box.middle_m = {draw.between(-0.01, 0.01), draw.between(-0.01, 0.01), draw.between(-0.01, 0.01)};
  box.axes[0] = {a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)};
  box.axes[1] = {2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)};
  box.axes[2] = {2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d};
  return box;
}

Mesh mesh_of(const Turned& box) {
  Mesh mesh = box_mesh(box.half_m * -1, box.half_m);
  for (Vec& p : mesh.points) p = box.place(p);
  return mesh;
}

offline::BuildOptions options_of(double edge_m) {
  offline::BuildOptions options;
  options.voxel_edge_m = edge_m;
  options.capsule = "liver_capsule";
  return options;
}

TEST(Skins, CountByTheAreaOfTheSurface) {
  DoubleDraw draw(20261128);
  for (int i = 0; i < 12; ++i) {
    const Turned box = drawn_box(
        draw, {draw.between(0.01, 0.03), draw.between(0.01, 0.03), draw.between(0.01, 0.03)});
    const double edge_m = draw.between(2e-3, 7e-3);
    const auto built = build_quietly({input_of(mesh_of(box), 1)}, options_of(edge_m));
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.format_version, 6U);
    double area = 0, most = 0;
    for (const OrganSkin& skin : organ.skins) {
      area += static_cast<double>(skin.area) * edge_m * edge_m;
      most = std::max(most, static_cast<double>(skin.area));
      EXPECT_GT(organ_material(organ, organ.voxel_material[skin.voxel]).membrane_n_per_m, 0);
    }
    const Vec h = box.half_m;
    EXPECT_NEAR(area / (8 * (h.x * h.y + h.y * h.z + h.z * h.x)), 1, 2e-3) << "draw " << i;
    // A corner of the box and the cube of a voxel, seen along the corner's diagonal: its three
    // faces do not hide each other, and have sqrt(3) times the area of their picture, which is at
    // most the cube's, sqrt(3).
    EXPECT_LT(most, 3.001) << "draw " << i;
  }
}

// A face between two layers of cells belongs to the voxels that it covers, and to them alone.
TEST(Skins, OfAFaceBetweenCellsAreWholeInTheVoxelsBelow) {
  const auto built =
      build_quietly({input_of(box_mesh({0, 0, 0}, {0.03, 0.04, 0.05}), 1)}, options_of(5e-3));
  const Organ organ = opened(built.bytes);
  ASSERT_EQ(organ.voxel_count, 6U * 8 * 10);
  ASSERT_EQ(organ.skins.size(), 480U - 4 * 6 * 8);
  int faces[4] = {};
  for (const OrganSkin& skin : organ.skins) {
    const auto area = static_cast<int>(std::lround(skin.area));
    EXPECT_NEAR(static_cast<double>(skin.area), area, 0.01);
    ++faces[area];
  }
  EXPECT_EQ(faces[1], 2 * (4 * 6 + 4 * 8 + 6 * 8));
  EXPECT_EQ(faces[2], 4 * (4 + 6 + 8));
  EXPECT_EQ(faces[3], 8);
}

TEST(Skins, AreWrittenOnlyWhereAMaterialHasOne) {
  offline::BuildOptions options = options_of(5e-3);
  options.capsule = "";
  const auto built = build_quietly({input_of(box_mesh({0, 0, 0}, {0.03, 0.04, 0.05}), 1)}, options);
  const Organ organ = opened(built.bytes);
  EXPECT_TRUE(organ.skins.empty());
  EXPECT_EQ(organ.format_version, 2U);
}

constexpr double kHalfM = 0.04;  // of the pressed cube
constexpr double kRingM = 0.025;

// How far the face has sunk at a ring around its middle, m.
double ring_sinks_m(const View& view, const Turned& box) {
  constexpr int kPlaces = 12;
  double sum_m = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPlaces;
    const Vec at = box.place({-kHalfM + 1e-3, kRingM * std::cos(angle), kRingM * std::sin(angle)});
    const Vec3 rest_m = {static_cast<float>(at.x), static_cast<float>(at.y),
                         static_cast<float>(at.z)};
    Vec3 now_m = rest_m;
    EXPECT_TRUE(present_place(view.model, view.state, rest_m, now_m));
    const Vec moved = {static_cast<double>(now_m.x - rest_m.x),
                       static_cast<double>(now_m.y - rest_m.y),
                       static_cast<double>(now_m.z - rest_m.z)};
    sum_m += dot(moved, box.axes[0]);
  }
  return sum_m / kPlaces;
}

// Half-spaces that hold what lies more than half of the cube behind the pressed face.
std::vector<std::string> behind(const Turned& box) {
  std::vector<std::string> regions;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double n = box.axes[0][axis];
    if (std::abs(n) < 0.5) continue;
    regions.push_back(fmt::format("{}{}{:.6f}", "xyz"[axis], n > 0 ? '>' : '<',
                                  1e3 * (box.middle_m[axis] + 0.6 * kHalfM * n)));
  }
  return regions;
}

// How much deeper than a film on a half-space an 18G needle is when it punctures a liver's capsule,
// over that depth. What the whole body gives is left out by measuring from a ring around the
// needle, where a half-space sinks by (1 - nu^2) F / (pi E r) (Boussinesq).
double too_deep(const Turned& box, double edge_m) {
  offline::BuildOptions options = options_of(edge_m);
  options.held = offline::parse_regions(behind(box), {1});
  const auto built = build_quietly({input_of(mesh_of(box), 1)}, options);
  const Organ organ = opened(built.bytes);
  Material capsule = {};
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    const Material m = organ_material(organ, i);
    if (m.membrane_n_per_m > 0) capsule = m;
  }
  Session session = make_session(organ, Config{});
  const Vec way = box.axes[0];
  const Vec face = box.place({-kHalfM, 0, 0});
  const double length_m = static_cast<double>(Config{}.needle[0].length_m);
  const Quat turn =
      towards({static_cast<float>(way.x), static_cast<float>(way.y), static_cast<float>(way.z)});
  constexpr double kStepM = 1e-5;
  for (double deep_m = -1e-3; deep_m < 0.02; deep_m += kStepM) {
    const Vec hand = face + way * (deep_m - length_m);
    Input input = {};
    input.handle = {
        {static_cast<float>(hand.x), static_cast<float>(hand.y), static_cast<float>(hand.z)}, turn};
    input.valid = 1;
    const Output out = tick(session.kernel, input);
    if (out.phase != Phase::kInserted) continue;
    const double nu = static_cast<double>(capsule.poisson_ratio);
    const double youngs = static_cast<double>(capsule.youngs_modulus_pa);
    const double force_n = static_cast<double>(capsule.puncture_force_n);
    const double film_m = static_cast<double>(
        film_at(plane_modulus_pa(capsule), capsule.membrane_n_per_m, capsule.puncture_force_n)
            .depth_m);
    const double sinks_m = (1 - nu * nu) * force_n / (std::numbers::pi * youngs * kRingM);
    const double ring_m = ring_sinks_m(view_of(session.kernel), box);
    return ((deep_m - ring_m) - (film_m - sinks_m)) / film_m;
  }
  ADD_FAILURE() << "not punctured";
  return 1;
}

TEST(Skins, ArePuncturedWhereAFilmIsHoweverTheFaceRunsThroughTheVoxels) {
  DoubleDraw draw(20261129);
  double sum = 0, squares = 0;
  constexpr int kFaces = 16;
  for (int i = 0; i < kFaces; ++i) {
    const Turned box = drawn_box(draw, {kHalfM, kHalfM, kHalfM});
    const double edge_m = draw.between(2.5e-3, 7e-3);
    const double off = too_deep(box, edge_m);
    std::printf("voxels of %.2f mm, face along %.2f %.2f %.2f: %+.3f of the depth\n", 1e3 * edge_m,
                box.axes[0].x, box.axes[0].y, box.axes[0].z, off);
    EXPECT_NEAR(off, 0, 0.15);
    sum += off;
    squares += off * off;
  }
  std::printf("mean %+.3f, rms %.3f\n", sum / kFaces, std::sqrt(squares / kFaces));
  EXPECT_NEAR(sum / kFaces, 0, 0.05);
}

}  // namespace
}  // namespace stylet::test
