// SPDX-License-Identifier: Apache-2.0
// Organs that are not plain blocks: without a surface, with holes, with rows that are shorter than
// others or missing. Needles go through all of them, and every promise holds.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "state/layout.h"
#include "owned_organ.h"
#include "promises.h"
#include "session.h"
#include "set_speed.h"
#include "lattice/voxel.h"

namespace stylet::test {
namespace {

constexpr std::uint16_t kNx = 7, kNy = 5, kNz = 5;

std::unique_ptr<Owner> block() {
  TinyOrgan tiny;
  tiny.nx = kNx;
  tiny.ny = kNy;
  tiny.nz = kNz;
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].puncture_force_n = 0.05F;
  return std::unique_ptr<Owner>(format::GetOrgan(tiny_organ(tiny).data())->UnPack());
}

bool gone(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  if (z == 3 && y == 2) return true;          // a whole row
  if (z == 3 && y == 1) return x < 2;         // the low end of a row
  if (z == 2 && y == 2) return x > 4;         // the high end
  return z == 3 && y == 3 && x > 1 && x < 5;  // a hole in the middle
}

// A surface vertex whose voxel was removed is given to the next voxel that exists.
std::unique_ptr<OpenOrgan> ragged() {
  const std::unique_ptr<Owner> owner = block();
  std::vector<std::uint32_t> now;
  std::vector<std::uint8_t> fixed;
  owner->runs.clear();
  std::uint32_t voxel = 0, kept = 0;
  for (std::uint16_t z = 0; z < kNz; ++z) {
    for (std::uint16_t y = 0; y < kNy; ++y) {
      std::uint16_t x = 0;
      while (x < kNx) {
        const std::uint16_t first = x;
        while (x < kNx && !gone(x, y, z)) {
          now.push_back(kept++);
          fixed.push_back(owner->voxel_fixed[voxel++]);
          ++x;
        }
        if (x > first) {
          owner->runs.emplace_back(first, y, z, static_cast<std::uint16_t>(x - first));
        }
        for (; x < kNx && gone(x, y, z); ++x, ++voxel) now.push_back(kept);
      }
    }
  }
  owner->voxel_material.resize(kept);
  owner->voxel_fill.resize(kept);
  owner->voxel_fixed = fixed;
  for (format::Vertex& v : owner->vertices) {
    v = format::Vertex(now[v.voxel()], v.fx(), v.fy(), v.fz(), 0);
  }
  return packed(*owner);
}

TEST(OddOrgan, WithoutASurfaceNothingIsTouched) {
  const std::unique_ptr<Owner> owner = block();
  owner->vertices.clear();
  owner->triangles.clear();
  owner->sphere_nodes.clear();
  const auto opened = packed(*owner);
  float distance_m = 0;
  EXPECT_FALSE(organ_raycast(opened->organ, {0.01F, 0.01F, 1}, {0, 0, -1}, distance_m));
  Session session = make_session(opened->organ, Config{});
  run(session.kernel, block_script(opened->organ, Config{}), 0, 1500);
  EXPECT_EQ(stats(session.kernel).constraint_particles.used_max, 0U);
  std::vector<Vec3> places(3);
  EXPECT_EQ(surface(session.kernel, places), 0U);
}

TEST(OddOrgan, ARayFromInsideSeesOnlyWhatIsAhead) {
  const auto opened = packed(*block());
  float distance_m = 0;
  ASSERT_TRUE(organ_raycast(opened->organ, {0.0176F, 0.0127F, 0.02F}, {0, 0, -1}, distance_m));
  EXPECT_NEAR(static_cast<double>(distance_m), 0.02, 1e-6);
  ASSERT_TRUE(organ_raycast(opened->organ, {0.0176F, 0.0127F, 0.02F}, {0, 0, 1}, distance_m));
  EXPECT_NEAR(static_cast<double>(distance_m), 0.005, 1e-6);
}

TEST(OddOrgan, NeedlesThroughHolesAndShortRows) {
  const auto opened = ragged();
  Config config;
  config.needle[0].unit_m = 2e-3F;
  std::uint32_t inserted = 0;
  for (int place = 0; place < 35; ++place) {
    Session session = make_session(opened->organ, config);
    Vec3 tip = {0.0025F + 0.005F * static_cast<float>(place % 7) + 0.0007F,
                0.0025F + 0.005F * static_cast<float>(place / 7) + 0.0004F, 0.0265F};
    for (int i = 0; i < 400; ++i) {
      const Vec3 base = {tip.x, tip.y, tip.z + config.needle[0].length_m};
      const Output out = tick(session.kernel, {{base, {1, 0, 0, 0}}, 1});
      const char* broken = broken_promise(session.kernel, {&out, 1});
      ASSERT_EQ(broken, nullptr) << broken << ", place " << place << ", tick " << i;
      tip.z += i < 250 ? -1e-4F : 2e-4F;
      if (i >= 150 && i < 250) tip.x += 0.4e-4F;
    }
    inserted += stats(session.kernel).constraint_particles.used_max > 2 ? 1 : 0;
    EXPECT_GE(energy(session.kernel).elastic, 0);
    std::vector<Vec3> places(opened->organ.vertices.size() + 5);
    EXPECT_EQ(surface(session.kernel, places), opened->organ.vertices.size());
  }
  EXPECT_GT(inserted, 35U / 2);  // others meet holes; with 32 substeps 20 of 35 are inserted
}

// Two blocks with a gap between them, and a surface over all three.
std::unique_ptr<OpenOrgan> bridged() {
  constexpr std::uint16_t kRow = 6, kRows = 4;  // voxels of both blocks in a row
  TinyOrgan tiny;
  tiny.nx = 12;
  tiny.ny = tiny.nz = kRows;
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.inside = [](std::uint16_t x, std::uint16_t, std::uint16_t) { return x < 3 || x > 8; };
  const std::unique_ptr<Owner> owner(format::GetOrgan(tiny_organ(tiny).data())->UnPack());
  owner->vertices.clear();
  owner->triangles.clear();
  for (const std::uint32_t column : {0U, 2U, 3U, 5U}) {  // voxels of a row: the ends of the blocks
    const auto fx = static_cast<std::uint16_t>(column == 0 || column == 3 ? 0 : 65535);
    const std::uint32_t top = (kRows - 1) * kRows * kRow + column;
    owner->vertices.emplace_back(top, fx, std::uint16_t{0}, std::uint16_t{65535}, std::uint16_t{0});
    owner->vertices.emplace_back(top + (kRows - 1) * kRow, fx, std::uint16_t{65535},
                                 std::uint16_t{65535}, std::uint16_t{0});
  }
  for (std::uint32_t quad = 0; quad < 6; quad += 2) {
    owner->triangles.emplace_back(quad, quad + 2, quad + 3);
    owner->triangles.emplace_back(quad, quad + 3, quad + 1);
  }
  owner->sphere_nodes = {{0.03F, 0.01F, 0.01F, 0.04F, 0, 6}};
  return packed(*owner);
}

// A surface that goes on over a gap, as other tools may write it: under it there is nothing that
// could hold a needle. A needle that begins there is free, however deep. For a needle that is moved
// anywhere, in and out of both blocks and the gap, every promise holds.
TEST(OddOrgan, ASurfaceOverNothingIsNotFelt) {
  const auto opened = bridged();
  const float length_m = Config{}.needle[0].length_m;
  const auto at = [&](Vec3 tip_m) {
    return Input{{{tip_m.x, tip_m.y, tip_m.z + length_m}, {1, 0, 0, 0}}, 1};
  };
  for (const float depth_m : {1e-4F, 1e-3F, 9e-3F}) {
    Session session = make_session(opened->organ, Config{});
    for (int i = 0; i < 20; ++i) {
      const Output out = tick(session.kernel, at({0.03F, 0.01F, 0.02F - depth_m}));
      ASSERT_EQ(out.phase, Phase::kFree) << depth_m;
      ASSERT_EQ(dot(out.force_n, out.force_n), 0) << depth_m;
    }
  }
  std::mt19937_64 random(6);
  const auto part = [&] { return static_cast<float>(random() >> 40U) * 0x1p-24F; };
  std::uint32_t contacts = 0, inserted = 0;
  for (int round = 0; round < 30; ++round) {
    Session session = make_session(opened->organ, Config{});
    Vec3 tip_m = {0.06F * part(), 0.01F, 0.022F};
    for (int stroke = 0; stroke < 60; ++stroke) {
      const Vec3 to_m = {0.06F * part(), 0.002F + 0.016F * part(), 0.012F + 0.012F * part()};
      const int ticks = 2 + static_cast<int>(30 * part());
      const Vec3 step_m = (1 / static_cast<float>(ticks)) * (to_m - tip_m);
      for (int i = 0; i < ticks; ++i) {
        tip_m = tip_m + step_m;
        const Output out = tick(session.kernel, at(tip_m));
        const char* broken = broken_promise(session.kernel, {&out, 1});
        ASSERT_EQ(broken, nullptr) << broken << ", round " << round << ", stroke " << stroke;
        contacts += out.phase == Phase::kContact ? 1 : 0;
        inserted += out.phase == Phase::kInserted ? 1 : 0;
      }
    }
  }
  EXPECT_GT(contacts, 0U);
  EXPECT_GT(inserted, 0U);
}

TEST(OddOrgan, InsideEndsAtEachSideOfTheLattice) {
  const auto opened = packed(*block());
  Session session = make_session(opened->organ, Config{});
  View view = view_of(session.kernel);
  const Vec3 size_m = {kNx * 5e-3F, kNy * 5e-3F, kNz * 5e-3F}, middle = 0.5F * size_m;
  EXPECT_TRUE(inside_lattice(view.model, middle));
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      Vec3 place = middle;
      float* at[] = {&place.x, &place.y, &place.z};
      const float* end[] = {&size_m.x, &size_m.y, &size_m.z};
      *at[axis] = high ? *end[axis] - 1e-5F : 1e-5F;
      EXPECT_TRUE(inside_lattice(view.model, place)) << axis << high;
      *at[axis] = high ? *end[axis] + 1e-5F : -1e-5F;
      EXPECT_FALSE(inside_lattice(view.model, place)) << axis << high;
    }
  }
}

// Two rows that share no node along x: the tissue between them is two pieces that never meet.
TEST(OddOrgan, RowsFarApart) {
  const std::unique_ptr<Owner> owner = block();
  owner->size_x = 60;
  owner->runs = {format::Run(0, 0, 0, 2), format::Run(50, 1, 0, 2)};
  owner->voxel_material.resize(4);
  owner->voxel_fill.resize(4);
  owner->voxel_fixed.clear();
  owner->vertices.clear();
  owner->triangles.clear();
  owner->sphere_nodes.clear();
  const auto opened = packed(*owner);
  Session session = make_session(opened->organ, Config{});
  View view = view_of(session.kernel);
  const Row& near = view.model.row[0];
  set_speed(view, near.node[0], {0.1F, 0, 0});
  for (int i = 0; i < 20; ++i) (void)tick(session.kernel, Input{});
  const Row& far = view.model.row[1];
  EXPECT_GT(std::fabs(view.state.ux[near.node[0] + 2]), 0.0F);
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    for (std::uint32_t x = 0; x < 3; ++x) EXPECT_EQ(view.state.ux[far.node[corner] + x], 0.0F);
  }
}

TEST(OddOrgan, TooManyVoxelsAreRefused) {
  const std::unique_ptr<Owner> owner = block();
  owner->voxel_material.resize(kMaxVoxels + 1);
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(bytes_of(*owner), organ, &refusal), Status::kOrganValueOutOfRange);
  EXPECT_STREQ(refusal.expected, "1 to 4000000 voxels");
}

// Rows of one plane begin and end at other voxels than their neighbours: a place beside a row is
// outside, even if other rows reach that far.
TEST(OddOrgan, PlacesBesideAShortRowAreOutside) {
  TinyOrgan tiny;
  tiny.nx = 6;
  tiny.ny = 2;
  tiny.nz = 2;
  tiny.inside = [](std::uint16_t x, std::uint16_t y, std::uint16_t) {
    return y == 0 ? x < 3 : x >= 2;
  };
  const auto opened = open_organ(tiny_organ(tiny));
  const Session session = make_session(opened->organ, Config{});
  View view = view_of(session.kernel);
  const auto is_inside = [&](float x, float y) {
    Vec3 place = {};
    return present_place(view.model, view.state, tiny.voxel_edge_m * Vec3{x, y, 0.5F}, place);
  };
  EXPECT_TRUE(is_inside(2.5F, 0.5F));
  EXPECT_FALSE(is_inside(3.5F, 0.5F)) << "behind the end of a row";
  EXPECT_TRUE(is_inside(3.5F, 1.5F));
  EXPECT_FALSE(is_inside(1.5F, 1.5F)) << "before the begin of a row";
}

}  // namespace
}  // namespace stylet::test
