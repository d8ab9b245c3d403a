// SPDX-License-Identifier: Apache-2.0
// Membranes as surfaces of their own (PHYSICS 9.7): each holds the needle's tip where it lies,
// whatever the voxels are, until the tip presses as hard as its tissue says. Places are compared
// with the planes and spheres themselves, tents with the film's law.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "laws/fracture.h"
#include "membrane_scenes.h"

namespace stylet::test {
namespace {

enum Layer : std::uint32_t { kGel1, kDura, kArachnoid };

// A block of 50 mm, held but for the side at which needles enter. Forces follow its modulus, so
// that all are reached a few millimetres behind the surface that is pressed.
TinyOrgan block(float edge_m, float modulus_pa) {
  TinyOrgan tiny;
  tiny.voxel_edge_m = edge_m;
  tiny.nx = tiny.ny = tiny.nz = static_cast<std::uint16_t>(std::ceil(0.05F / edge_m));
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial gel;
  gel.youngs_modulus_pa = modulus_pa;
  gel.puncture_force_n = 5e-6F * modulus_pa;
  gel.cutting_force_n = 3e-6F * modulus_pa;
  gel.coulomb_friction_n_per_m = gel.static_friction_n_per_m = 1e-4F * modulus_pa;
  TinyMaterial dura = gel, arachnoid = gel;
  dura.name = "dura";
  dura.puncture_force_n = 1.6e-5F * modulus_pa;
  arachnoid.name = "arachnoid";
  arachnoid.puncture_force_n = 1e-5F * modulus_pa;
  tiny.materials = {gel, dura, arachnoid};
  return tiny;
}

struct Scene {
  TinyOrgan tiny;
  Vec3 start_m;
  float depth_m;  // of the membrane on the needle's way
};
Scene draw_scene(Chance& chance) {
  const float edge_m = chance.between(2.5e-3F, 7e-3F);
  Scene scene = {block(edge_m, chance.between(10000, 30000)), {}, chance.between(8e-3F, 20e-3F)};
  const float size_m = edge_m * static_cast<float>(scene.tiny.nx);
  scene.start_m = {-1e-3F, size_m * chance.between(0.4F, 0.6F),
                   size_m * chance.between(0.4F, 0.6F)};
  return scene;
}
Scene draw_plane(Chance& chance) {
  Scene scene = draw_scene(chance);
  Vec3 across = chance.direction();
  across.x = 1;  // up to 55 degrees beside the needle
  scene.tiny.membranes = {
      {kDura, sheet({scene.depth_m, scene.start_m.y, scene.start_m.z}, across, 0.03F)}};
  return scene;
}

TEST(Membranes, HoldTheTipWhereTheyLie) {
  Chance chance = {std::mt19937_64(41)};
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = draw_plane(chance);
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 12e-3F, chance.between(2e-3F, 50e-3F));
    const std::vector<Puncture> found = watch.of(kDura);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(ratio(found[0].event.force_n, scene.tiny.materials[kDura].puncture_force_n), 1,
                0.03);
    const std::array<Vec3, 3>& t = scene.tiny.membranes[0].triangles[0];
    const Vec3 across = cross(t[1] - t[0], t[2] - t[0]);
    const float off_m = dot(found[0].rest_m - t[0], (1 / norm(across)) * across);
    EXPECT_NEAR(static_cast<double>(off_m) * 1e3, 0, kPlaceMm);
  }
}

// A vessel, a cyst: its near and its far wall are met where the sphere is.
TEST(Membranes, HoldTheTipWhereTheyLieIfTheyAreCurved) {
  Chance chance = {std::mt19937_64(42)};
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_scene(chance);
    const float radius_m = chance.between(2e-3F, 8e-3F);
    const Vec3 centre_m = {radius_m + scene.depth_m,
                           scene.start_m.y + radius_m * chance.between(-0.5F, 0.5F),
                           scene.start_m.z + radius_m * chance.between(-0.5F, 0.5F)};
    scene.tiny.membranes = {{kDura, sphere(centre_m, radius_m)}};
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 2 * radius_m + 12e-3F);
    const std::vector<Puncture> found = watch.of(kDura);
    ASSERT_EQ(found.size(), 2U);
    for (const Puncture& p : found) {
      EXPECT_NEAR(static_cast<double>(norm(p.rest_m - centre_m) - radius_m) * 1e3, 0, kPlaceMm);
    }
    EXPECT_LT(found[0].rest_m.x, centre_m.x);
    EXPECT_GT(found[1].rest_m.x, centre_m.x);
  }
}

// However fast the hand, and across however many voxels in one tick.
TEST(Membranes, NoneIsPassedByAFastNeedle) {
  Chance chance = {std::mt19937_64(44)};
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = draw_plane(chance);
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 12e-3F, chance.between(0.2F, 2));
    hold(rig, {scene.depth_m + 12e-3F, scene.start_m.y, scene.start_m.z}, 20);
    watch(rig);
    EXPECT_EQ(watch.of(kDura).size(), 1U);
  }
}

TEST(Membranes, StayOpenInATrack) {
  Chance chance = {std::mt19937_64(45)};
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = draw_plane(chance);
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    const float deep_m = scene.depth_m + 10e-3F;
    const auto to = [&](float from_x_m, float x_m) {
      push(rig, watch, {from_x_m, scene.start_m.y, scene.start_m.z}, x_m);
    };
    to(-1e-3F, deep_m);
    to(deep_m, scene.depth_m - 4e-3F);  // back through the membrane, and once more
    to(scene.depth_m - 4e-3F, deep_m);
    EXPECT_EQ(watch.of(kDura).size(), 1U);
    to(deep_m, -15e-3F);  // out, and into the same hole
    to(-15e-3F, deep_m);
    EXPECT_EQ(watch.of(kDura).size(), 1U);
    to(deep_m, -15e-3F);
    const Vec3 beside = {-1e-3F, scene.start_m.y + 8e-3F, scene.start_m.z};
    push(rig, watch, beside, scene.depth_m + 25e-3F);
    EXPECT_EQ(watch.of(kDura).size(), 2U) << "8 mm beside it is whole";
  }
}

// A membrane that held, and was not pressed hard enough, holds again.
TEST(Membranes, HoldAgainWhereTheyHaveHeld) {
  Chance chance = {std::mt19937_64(46)};
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_plane(chance);
    scene.tiny.materials[kDura].puncture_force_n *= 2;
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    float at_m = -1e-3F;
    while (rig.view().state.membrane->held == 0 && at_m < scene.depth_m + 10e-3F) {
      at_m += 2e-5F;
      move_tip(rig, {at_m, scene.start_m.y, scene.start_m.z});
      watch(rig);
    }
    ASSERT_GT(rig.view().state.membrane->held, 0U);
    const auto to = [&](float x_m) {
      push(rig, watch, {at_m, scene.start_m.y, scene.start_m.z}, x_m);
      at_m = x_m;
    };
    to(at_m + 1e-3F);
    to(scene.depth_m - 5e-3F);
    EXPECT_EQ(rig.view().state.membrane->held, 0U);
    to(-15e-3F);
    EXPECT_EQ(watch.of(kDura).size(), 0U);
    to(scene.depth_m + 25e-3F);
    const std::vector<Puncture> found = watch.of(kDura);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(ratio(found[0].event.force_n, scene.tiny.materials[kDura].puncture_force_n), 1,
                0.03);
  }
}

// Dura and arachnoid lie on each other.
TEST(Membranes, TwoThatLieTogetherAreTwo) {
  Chance chance = {std::mt19937_64(47)};
  for (const float apart_m : {5e-5F, 1e-4F, 4e-4F, 2e-3F}) {
    SCOPED_TRACE(apart_m);
    Scene scene = draw_plane(chance);
    TinyMembrane second = scene.tiny.membranes[0];
    second.material = kArachnoid;
    for (std::array<Vec3, 3>& t : second.triangles) {
      for (Vec3& p : t) p.x += apart_m;
    }
    scene.tiny.membranes.push_back(second);
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 15e-3F);
    ASSERT_EQ(watch.of(kDura).size(), 1U);
    ASSERT_EQ(watch.of(kArachnoid).size(), 1U);
    EXPECT_LE(watch.of(kDura)[0].event.tick, watch.of(kArachnoid)[0].event.tick);
  }
}

// A hole made beside a membrane that was missed opens nothing: after a partial withdrawal the
// needle is turned about its entry, and meets what it had passed beside.
TEST(Membranes, AreWholeBesideAWayThatMissedThem) {
  Chance chance = {std::mt19937_64(51)};
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_scene(chance);
    const float turn_rad = chance.between(0.2F, 0.45F), depth_m = chance.between(14e-3F, 22e-3F);
    const Vec3 entry_m = {0, scene.start_m.y, scene.start_m.z};
    const Vec3 turned = {std::cos(turn_rad), std::sin(turn_rad), 0};
    // Small enough that the first way passes beside it.
    scene.tiny.membranes = {
        {kDura, sheet(entry_m + depth_m * turned, turned, 0.6F * depth_m * std::sin(turn_rad))}};
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, 30e-3F);
    push(rig, watch, {30e-3F, scene.start_m.y, scene.start_m.z}, 3e-3F);
    const auto pose = [&](float angle, float in_m) {
      const Vec3 d = {std::cos(angle), std::sin(angle), 0};
      const Vec3 handle = entry_m + (in_m - rig.length_m) * d;
      const float half = std::sqrt(0.5F), c = std::cos(angle / 2), s = std::sin(angle / 2);
      // About z by the angle, after the turn that leads from z to x.
      return Input{{handle, {half * c, half * s, -half * c, half * s}}, 1};
    };
    for (int k = 0; k <= 400; ++k) {
      (void)checked_tick(rig, pose(turn_rad * static_cast<float>(k) / 400, 3e-3F));
      watch(rig);
    }
    for (int k = 0; k <= 1800; ++k) {
      (void)checked_tick(rig, pose(turn_rad, 3e-3F + 2e-5F * static_cast<float>(k)));
      watch(rig);
    }
    EXPECT_EQ(watch.of(kDura).size(), 1U);
  }
}

// Once through the first, a tip jumps; the second is met where it lies all the same.
TEST(Membranes, TheSecondIsWhereItLies) {
  Chance chance = {std::mt19937_64(52)};
  for (int i = 0; i < 16; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_plane(chance);
    TinyMembrane second = scene.tiny.membranes[0];
    second.material = kArachnoid;
    const float apart_m = chance.between(0.1e-3F, 4e-3F);
    for (std::array<Vec3, 3>& t : second.triangles) {
      for (Vec3& p : t) p.x += apart_m;
    }
    scene.tiny.membranes.push_back(second);
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 18e-3F);
    for (const std::uint32_t layer : {std::uint32_t{kDura}, std::uint32_t{kArachnoid}}) {
      const std::vector<Puncture> found = watch.of(layer);
      ASSERT_EQ(found.size(), 1U);
      const std::array<Vec3, 3>& t = scene.tiny.membranes[layer - kDura].triangles[0];
      const Vec3 across = cross(t[1] - t[0], t[2] - t[0]);
      const float off_m = dot(found[0].rest_m - t[0], (1 / norm(across)) * across);
      EXPECT_NEAR(static_cast<double>(off_m) * 1e3, 0, kPlaceMm) << layer;
    }
  }
}

// Folds of one membrane, such as a collapsed vessel, are two on the way in, and open on the way
// back and in again.
TEST(Membranes, FoldsAreTwo) {
  Chance chance = {std::mt19937_64(53)};
  for (const float apart_m : {5e-5F, 3e-4F, 5e-4F}) {
    SCOPED_TRACE(apart_m);
    Scene scene = draw_plane(chance);
    TinyMembrane& both = scene.tiny.membranes[0];
    for (std::size_t k = 0; k < 2; ++k) {
      std::array<Vec3, 3> t = both.triangles[k];
      for (Vec3& p : t) p.x += apart_m;
      both.triangles.push_back(t);
    }
    Rig rig = make_rig(scene.tiny, Config{});
    Watch watch;
    const float deep_m = scene.depth_m + 15e-3F;
    push(rig, watch, scene.start_m, deep_m);
    EXPECT_EQ(watch.of(kDura).size(), 2U);
    push(rig, watch, {deep_m, scene.start_m.y, scene.start_m.z}, scene.depth_m - 5e-3F);
    push(rig, watch, {scene.depth_m - 5e-3F, scene.start_m.y, scene.start_m.z}, deep_m);
    EXPECT_EQ(watch.of(kDura).size(), 2U);
  }
}

// A membrane with tension gives way as a film on the tissue behind it does: at the force of its
// puncture the tip has come as far as the film's law says. (What voxels give was measured in other
// scenes, those of seed 43.)
TEST(Membranes, TentAsFilms) {
  Chance chance = {std::mt19937_64(50)};
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_scene(chance);
    scene.tiny.membranes = {
        {kDura, sheet({scene.depth_m, scene.start_m.y, scene.start_m.z}, {1, 0, 0}, 0.03F), 1.0F}};
    Material gel = kGel;
    gel.youngs_modulus_pa = scene.tiny.materials[kGel1].youngs_modulus_pa;
    TinyMaterial& dura = scene.tiny.materials[kDura];
    dura.membrane_n_per_m = chance.between(300, 4000);
    const float tent_m = chance.between(2e-3F, 5e-3F);
    dura.puncture_force_n = film_force_n(plane_modulus_pa(gel), dura.membrane_n_per_m, tent_m);
    Rig rig = make_rig(scene.tiny, Config{});
    float met_m = 0, met_n = 0, last_m = 0, broke_m = 0;
    Watch watch;
    drive(rig, scene.start_m, scene.depth_m + 20e-3F, 5e-3F, [&](const Output& out) {
      watch(rig);
      if (met_m == 0 && rig.view().state.membrane->held > 0) {
        met_m = out.tip_m.x;
        met_n = rig.view().state.tip->force_n.x;
      }
      if (broke_m == 0 && watch.of(kDura).size() == 1) broke_m = last_m;
      last_m = out.tip_m.x;
    });
    ASSERT_GT(broke_m, 0);
    // It is met by a tip that pushes tissue before it, and its spring is straight: on the whole way
    // the tent would be
    const double whole_m =
        static_cast<double>(broke_m - met_m) / (1 - ratio(met_n, dura.puncture_force_n));
    const double tents = whole_m / static_cast<double>(tent_m);
    // Beyond forces of 12 G h^2 the lattice is softer than a film, as below a skin (PHYSICS 18.4).
    const double unit_n = static_cast<double>(gel.youngs_modulus_pa) / 2.9 *
                          std::pow(static_cast<double>(scene.tiny.voxel_edge_m), 2);
    EXPECT_GT(tents, static_cast<double>(dura.puncture_force_n) < 12 * unit_n ? 0.93 : 0.75);
    EXPECT_LT(tents, 1.07);
  }
}

// At a puncture what was stored is spent, and no more is booked than that.
TEST(Membranes, TheBooksOfAPunctureClose) {
  Chance chance = {std::mt19937_64(54)};
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_plane(chance);
    TinyMaterial& dura = scene.tiny.materials[kDura];
    dura.membrane_n_per_m = chance.between(300, 4000);
    dura.puncture_force_n *= chance.between(1, 4);
    scene.tiny.membranes[0].area = 1;
    Config config;
    if (i % 2 == 1) config.inertia = Inertia::kAddedMass;
    Rig rig = make_rig(scene.tiny, config);
    Watch watch;
    Energy before = {};
    double most_j = 0, fall_j = 0, created_j = 0;
    const auto stored = [](const Energy& e) { return e.elastic + e.kinetic + e.coupling; };
    const auto booked = [](const Energy& e) { return e.friction + e.cutting + e.relaxation; };
    drive(rig, scene.start_m, scene.depth_m + 20e-3F, 40e-3F, [&](const Output&) {
      watch(rig);
      const Energy e = energy(rig.kernel());
      const double spent_j = e.work_by_hand - stored(e);
      most_j = std::max(most_j, spent_j);
      fall_j = std::max(fall_j, most_j - spent_j);
      created_j = std::max(created_j, (booked(e) - booked(before)) + (stored(e) - stored(before)) -
                                          (e.work_by_hand - before.work_by_hand));
      before = e;
    });
    ASSERT_EQ(watch.of(kDura).size(), 1U);
    EXPECT_LT(fall_j, 1e-6) << "of " << most_j;
    EXPECT_LT(created_j, 0.005 * most_j);  // a tick books the mean of its forces
  }
}

TEST(Membranes, TheSameBitsAfterASnapshotWhileOneHolds) {
  Chance chance = {std::mt19937_64(48)};
  const Scene scene = draw_plane(chance);
  Rig rig = make_rig(scene.tiny, Config{}), other = make_rig(scene.tiny, Config{});
  Watch watch;
  float at_m = -1e-3F;
  while (rig.view().state.membrane->held == 0 && at_m < scene.depth_m + 10e-3F) {
    at_m += 2e-5F;
    move_tip(rig, {at_m, scene.start_m.y, scene.start_m.z});
  }
  std::vector<std::byte> bytes(snapshot_bytes(rig.kernel()));
  ASSERT_EQ(snapshot(rig.kernel(), bytes), Status::kOk);
  ASSERT_EQ(restore(other.kernel(), bytes), Status::kOk);
  const Vec3 from_m = {at_m, scene.start_m.y, scene.start_m.z};
  drive(rig, from_m, scene.depth_m + 12e-3F, 20e-3F);
  drive(other, from_m, scene.depth_m + 12e-3F, 20e-3F);
  EXPECT_EQ(hash_state(rig.kernel()), hash_state(other.kernel()));
  rig.view().state.membrane->held = 4;  // there are three materials
  ASSERT_EQ(snapshot(rig.kernel(), bytes), Status::kOk);
  EXPECT_EQ(restore(other.kernel(), bytes), Status::kSnapshotDamaged);
}

TEST(Membranes, ThePaperKnowsNone) {
  Chance chance = {std::mt19937_64(49)};
  const Scene scene = draw_plane(chance);
  Config config;
  config.mode = Mode::kPaper;
  Rig rig = make_rig(scene.tiny, config);
  Watch watch;
  push(rig, watch, scene.start_m, scene.depth_m + 12e-3F);
  EXPECT_EQ(watch.of(kDura).size(), 0U);
}

}  // namespace
}  // namespace stylet::test
