// SPDX-License-Identifier: Apache-2.0
// Layers in one lattice: each is punctured on its own on the way in, not again in a track, and
// again elsewhere; and the loss of resistance behind a ligament is felt within a tick.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

enum Layer : std::uint8_t { kSkin, kFat, kLigament, kEpidural };

// Along x: skin 5 mm, fat 15 mm, ligament 25 mm, epidural fat 30 mm.
TinyOrgan back() {
  TinyOrgan tiny;
  tiny.nx = 15;
  tiny.ny = tiny.nz = 9;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  const auto tissue = [](const char* name, float modulus, float puncture, float cutting,
                         float friction) {
    TinyMaterial m;
    m.name = name;
    m.youngs_modulus_pa = modulus;
    m.puncture_force_n = puncture;
    m.cutting_force_n = cutting;
    m.recut_fraction = 0.2F;
    m.coulomb_friction_n_per_m = m.static_friction_n_per_m = friction;
    return m;
  };
  tiny.materials = {tissue("skin", 100000, 1.5F, 0.6F, 15), tissue("fat", 15000, 0.2F, 0.2F, 5),
                    tissue("ligament", 150000, 3.0F, 1.5F, 30),
                    tissue("epidural fat", 8000, 0.1F, 0.1F, 3)};
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x < 1 ? kSkin
                                           : (x < 4 ? kFat : (x < 9 ? kLigament : kEpidural)));
  };
  return tiny;
}

std::vector<Event> events_of(const Kernel& kernel) {
  std::vector<Event> list(kMaxEvents);
  list.resize(events(kernel, list));
  return list;
}

std::vector<Event> of_kind(const Kernel& kernel, EventKind kind) {
  std::vector<Event> list = events_of(kernel);
  std::erase_if(list, [kind](const Event& e) { return e.kind != kind; });
  return list;
}

constexpr Vec3 kStart = {-1e-3F, 21e-3F, 23e-3F};

TEST(Layers, EachIsPuncturedOnTheWayIn) {
  Rig rig = make_rig(back(), Config{});
  drive(rig, kStart, 72e-3F, 20e-3F);
  const std::vector<Event> punctures = of_kind(rig.kernel(), EventKind::kPuncture);
  ASSERT_EQ(punctures.size(), 2U);
  EXPECT_EQ(punctures[0].layer, kSkin);
  EXPECT_NEAR(static_cast<double>(punctures[0].force_n), 1.5, 0.1);
  EXPECT_EQ(punctures[1].layer, kLigament);
  EXPECT_NEAR(static_cast<double>(punctures[1].force_n), 3.0, 0.1);
  EXPECT_NEAR(static_cast<double>(punctures[1].depth_m), 20e-3, 0.5e-3);
  const std::vector<Event> entered = of_kind(rig.kernel(), EventKind::kLayer);
  ASSERT_EQ(entered.size(), 2U);  // soft ones, without a surface to break
  EXPECT_EQ(entered[0].layer, kFat);
  EXPECT_EQ(entered[1].layer, kEpidural);
}

// Pressed against a stiff layer, the tip has the spring of that layer, not of the soft tissue in
// which it lies: fat of 3 kPa under the tip must not hide a ligament of 1 MPa.
TEST(Layers, AStiffLayerBehindASoftOneIsReached) {
  TinyOrgan tiny = back();
  tiny.materials[kFat].youngs_modulus_pa = 3000;
  tiny.materials[kLigament].youngs_modulus_pa = 1e6F;
  Rig rig = make_rig(tiny, Config{});
  float at_m = 0;
  drive(rig, kStart, 60e-3F, 20e-3F, [&](const Output& out) {
    if (at_m > 0 || out.layer != kLigament) return;
    at_m = out.tip_m.x;
  });
  EXPECT_GT(at_m, 0) << "never punctured";
  EXPECT_LT(at_m, 35e-3F) << "15 mm beyond the ligament's surface at rest";
}

// Spring of the tip in the ligament, after it has gone through the layers before it.
float spring_in_ligament(const TinyOrgan& tiny) {
  Rig rig = make_rig(tiny, Config{});
  float spring_n_per_m = 0;
  drive(rig, kStart, 40e-3F, 20e-3F, [&](const Output& out) {
    if (out.layer == kLigament) spring_n_per_m = rig.view().state.tip->stiffness_n_per_m;
  });
  return spring_n_per_m;
}

TEST(Layers, TheTipHasTheSpringOfTheLayerItIsIn) {
  TinyOrgan all = back();
  all.material_at = [](std::uint16_t, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(kLigament);
  };
  const float alone = spring_in_ligament(all), behind_fat = spring_in_ligament(back());
  EXPECT_GT(alone, 0);
  EXPECT_EQ(behind_fat, alone);
}

// The kernel looks one by one at the voxels that hold the needle: two of them lie in air, with
// nothing beside or between them.
TEST(Layers, ASingleVoxelSaysWhichTissueItIs) {
  TinyOrgan tiny = back();
  tiny.nx = 3;
  tiny.ny = tiny.nz = 1;
  tiny.inside = [](std::uint16_t x, std::uint16_t, std::uint16_t) { return x != 1; };
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x == 0 ? kFat : kEpidural);
  };
  Rig rig = make_rig(tiny, Config{}, Tissue::kFixed);
  int seen = 0;
  const Vec3 start = {-1e-3F, 2.5e-3F, 2.5e-3F};
  const Output out = drive(rig, start, 25e-3F, 20e-3F, [&](const Output&) {
    const Particle& tip = *rig.view().state.tip;
    if (tip.support_count == 0 || tip.rest_m.x < 10.1e-3F) return;
    EXPECT_EQ(tip.support_count, 1U);
    EXPECT_EQ(tip.material, static_cast<std::uint32_t>(kEpidural)) << tip.rest_m.x;
    ++seen;
  });
  EXPECT_GT(seen, 30);
  const double expected = 5e-3 * (5 + 3);
  EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x), expected, 0.05 * expected);
}

TEST(Layers, TheSameTissueBehindAnotherIsALayerAgain) {
  TinyOrgan tiny = back();
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x < 1 ? kSkin : (x >= 4 && x < 9 ? kLigament : kFat));
  };
  Rig rig = make_rig(tiny, Config{});
  const Output in = drive(rig, kStart, 72e-3F, 20e-3F);
  EXPECT_EQ(in.layer, kFat);
  EXPECT_EQ(of_kind(rig.kernel(), EventKind::kPuncture).size(), 2U);
  std::vector<Event> soft = of_kind(rig.kernel(), EventKind::kLayer);
  ASSERT_EQ(soft.size(), 2U);
  EXPECT_EQ(soft[0].layer, kFat);
  EXPECT_EQ(soft[1].layer, kFat);
  // On the way back each layer is passed once more, and none of them pushes.
  drive(rig, {72e-3F, kStart.y, kStart.z}, 15e-3F, 20e-3F);
  const Output still = hold(rig, {15e-3F, kStart.y, kStart.z}, 500);
  EXPECT_EQ(still.phase, Phase::kRetracting) << "a hand that rests does not insert";
  EXPECT_EQ(still.layer, kFat);
  soft = of_kind(rig.kernel(), EventKind::kLayer);
  ASSERT_EQ(soft.size(), 4U);
  EXPECT_EQ(soft[2].layer, kLigament);
  for (const Event& each : soft) EXPECT_GE(each.force_n, 0) << each.depth_m;
}

// However the units of the shaft lie across the layers, its friction is the sum over its stretches
// in each layer.
TEST(Layers, FrictionIsThatOfTheStretchInEach) {
  for (const float unit_m : {2.5e-3F, 5e-3F, 7e-3F, 11e-3F}) {
    Config config;
    config.needle[0].unit_m = unit_m;
    Rig rig = make_rig(back(), config);
    const Output out = drive(rig, kStart, 72e-3F, 20e-3F);
    const double behind = static_cast<double>(out.depth_m) - 45e-3;
    const double expected = 15 * 5e-3 + 5 * 15e-3 + 30 * 25e-3 + 3 * behind;
    EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x), expected, 0.02 * expected)
        << "unit " << unit_m;
  }
}

// Shaft CPs that hold tissue whose rest place lies between these along x.
int held_between(const Rig& rig, float low_m, float high_m) {
  View view = needle_view(rig.view(), 0);
  int count = 0;
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    const float x = view.state.shaft[i].rest_m.x;
    count += x > low_m && x < high_m ? 1 : 0;
  }
  return count;
}

// Two organs with a gap of three units between them: both hold the needle, and nothing holds it in
// the gap. The same once more after it has been drawn back into the first.
TEST(Layers, WhatLiesBehindAGapHoldsTheNeedle) {
  TinyOrgan tiny = back();
  tiny.materials = {tiny.materials[kFat]};
  tiny.material_at = {};
  tiny.inside = [](std::uint16_t x, std::uint16_t, std::uint16_t) { return x < 4 || x > 6; };
  Rig rig = make_rig(tiny, Config{});
  float from_x_m = kStart.x;
  for (int time = 0; time < 2; ++time) {
    const Output out = drive(rig, {from_x_m, kStart.y, kStart.z}, 65e-3F, 20e-3F);
    EXPECT_EQ(held_between(rig, 20e-3F, 35e-3F), 0);
    EXPECT_EQ(held_between(rig, 35e-3F, 65e-3F), 6);
    const double expected = 5 * (static_cast<double>(out.depth_m) - 15e-3);
    EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x), expected, 0.05 * expected);
    from_x_m = 10e-3F;
    drive(rig, {65e-3F, kStart.y, kStart.z}, from_x_m, 20e-3F);
  }
}

// A needle has come out at the far face and is drawn back through it, fast and slow: the tissue
// that it drags along lets go of it and is met again in alternate ticks. The log names no layer
// twice within half a millimetre, keeps earlier events, and ends with the layer in which the tip
// is.
TEST(Layers, ATipDrawnBackThroughTheFarFaceIsLoggedOnce) {
  std::mt19937 random(3);
  for (int time = 0; time < 6; ++time) {
    const auto draw = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    TinyOrgan tiny = back();
    tiny.fixed_faces = kLowX | kLowY | kLowZ;
    Rig rig = make_rig(tiny, Config{});
    const Vec3 at = {kStart.x, kStart.y + draw(-4e-3F, 4e-3F), kStart.z + draw(-4e-3F, 4e-3F)};
    const float speed = draw(0.02F, 0.3F), far_m = 75e-3F + draw(5e-3F, 15e-3F);
    drive(rig, at, far_m, 0.05F);
    Output out = drive(rig, {far_m, at.y, at.z}, 60e-3F, speed);
    out = hold(rig, {60e-3F, at.y, at.z}, 300);
    const std::vector<Event> told = of_kind(rig.kernel(), EventKind::kLayer);
    ASSERT_GT(told.size(), 2U);
    for (std::size_t i = 2; i < told.size(); ++i) {
      const bool back_again = told[i].layer == told[i - 2].layer;
      const float since = std::fabs(told[i].depth_m - told[i - 1].depth_m);
      EXPECT_FALSE(back_again && since < 0.5e-3F) << time << ": " << i << " at " << speed;
    }
    EXPECT_EQ(told.back().layer, out.layer) << time << " at " << speed;
    EXPECT_EQ(of_kind(rig.kernel(), EventKind::kPuncture).size(), 2U);
  }
}

// Every voxel of the plane `x` is of `material` on one side of a plane across x in it.
std::vector<format::Mixed> mixed_planes(const TinyOrgan& tiny, std::uint16_t x,
                                        std::uint16_t material, float normal_x, float limit) {
  std::vector<format::Mixed> mixed;
  std::uint32_t voxel = 0;
  for (std::uint16_t z = 0; z < tiny.nz; ++z) {
    for (std::uint16_t y = 0; y < tiny.ny; ++y) {
      for (std::uint16_t at = 0; at < tiny.nx; ++at) {
        if (tiny.inside && !tiny.inside(at, y, z)) continue;
        if (at == x) mixed.emplace_back(voxel, material, 0, normal_x, 0.0F, 0.0F, limit);
        ++voxel;
      }
    }
  }
  return mixed;
}

// Where two tissues meet within a voxel, the needle meets the second one at that place, not at the
// voxel's face.
TEST(Layers, AFaceWithinAVoxelIsMetWhereItIs) {
  for (const float fat_in_voxel : {0.1F, 0.4F, 0.9F}) {
    TinyOrgan tiny = back();
    tiny.mixed = mixed_planes(tiny, 4, kFat, -1, -fat_in_voxel);  // of 20 to 25 mm
    Rig rig = make_rig(tiny, Config{});
    const Output out = drive(rig, kStart, 72e-3F, 20e-3F);
    const double face_m = 20e-3 + 5e-3 * static_cast<double>(fat_in_voxel);
    const std::vector<Event> punctures = of_kind(rig.kernel(), EventKind::kPuncture);
    ASSERT_EQ(punctures.size(), 2U);
    EXPECT_EQ(punctures[1].layer, kLigament);
    EXPECT_NEAR(static_cast<double>(punctures[1].depth_m), face_m, 0.2e-3);
    const double behind = static_cast<double>(out.depth_m) - 45e-3;
    const double expected = 15 * 5e-3 + 5 * (face_m - 5e-3) + 30 * (45e-3 - face_m) + 3 * behind;
    EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x), expected, 0.02 * expected);
  }
}

// Tissue that ends within a voxel holds the needle as far as the tissue goes.
TEST(Layers, TissueEndsWithinAVoxel) {
  TinyOrgan tiny = back();
  tiny.materials = {tiny.materials[kFat]};
  tiny.material_at = {};
  tiny.inside = [](std::uint16_t x, std::uint16_t, std::uint16_t) { return x < 4 || x > 6; };
  tiny.mixed = mixed_planes(tiny, 3, kNoTissue, 1, 0.4F);  // up to 17 mm
  const std::vector<format::Mixed> far = mixed_planes(tiny, 7, kNoTissue, -1, -0.6F);  // from 38 mm
  tiny.mixed.insert(tiny.mixed.end(), far.begin(), far.end());
  std::sort(tiny.mixed.begin(), tiny.mixed.end(),
            [](const format::Mixed& a, const format::Mixed& b) { return a.voxel() < b.voxel(); });
  for (const float unit_m : {5e-3F, 2.5e-3F, 1.25e-3F}) {
    Config config;
    config.needle[0].unit_m = unit_m;
    Rig rig = make_rig(tiny, config);
    const Output out = drive(rig, kStart, 65e-3F, 20e-3F);
    EXPECT_EQ(held_between(rig, 17e-3F, 38e-3F), 0);
    const double expected = 5 * (17e-3 + static_cast<double>(out.depth_m) - 38e-3);
    EXPECT_NEAR(-static_cast<double>(out.cause.friction_n.x), expected, 0.05 * expected) << unit_m;
  }
}

// A block whose face on the low side of x lies within its outermost voxels. Their planes lie `off`
// edges farther in.
Rig rig_filled(TinyOrgan tiny, float fill, float off) {
  tiny.fill_at = [fill](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return x > 0 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::lround(255 * fill));
  };
  tiny.mixed = mixed_planes(tiny, 0, kNoTissue, -1, fill - 1 - off);
  std::vector<std::byte> bytes = tiny_organ(tiny);
  const auto face = static_cast<std::uint16_t>(std::lround(65535 * (1 - fill)));
  for (const format::Vertex* v : *format::GetOrgan(bytes.data())->vertices()) {
    if (v->voxel() % tiny.nx > 0 || v->fx() > 0) continue;
    const_cast<format::Vertex&>(*v) = {v->voxel(), face, v->fy(), v->fz(), 0};
  }
  auto organ = open_organ(std::move(bytes));
  const Config config;
  Session session = make_session(organ->organ, config);
  return {std::move(organ), std::move(session), config.needle[0].length_m};
}

// A needle that comes to a capsule meets the capsule, however little of its voxel is full. (Builds
// know the plane within a voxel to an eighth of an edge. Where a place of the surface lay beyond
// the plane, and the voxel was less than about a quarter full, the needle met the liver below.)
TEST(Layers, ACapsuleIsMetHoweverLittleOfItsVoxelsIsFull) {
  DoubleDraw draw(12);
  for (int i = 0; i < 16; ++i) {
    const auto fill = static_cast<float>(draw.between(0.05, 1));
    TinyOrgan tiny;
    tiny.nx = 10;
    tiny.ny = tiny.nz = 12;
    tiny.fixed_faces = kHighX;
    TinyMaterial liver;
    liver.youngs_modulus_pa = 23200;
    liver.puncture_force_n = liver.cutting_force_n = 0.3F;
    TinyMaterial capsule = liver;
    capsule.membrane_n_per_m = 1000;
    capsule.puncture_force_n = static_cast<float>(draw.between(0.5, 0.9));
    tiny.materials = {liver, capsule};
    tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
      return static_cast<std::uint8_t>(x == 0 ? 1 : 0);
    };
    Rig rig = rig_filled(tiny, fill, static_cast<float>(draw.between(-0.125, 0.125)));
    const Vec3 start_m = {-1e-3F, static_cast<float>(draw.between(25e-3, 35e-3)),
                          static_cast<float>(draw.between(25e-3, 35e-3))};
    drive(rig, start_m, 18e-3F, 10e-3F);
    const std::vector<Event> punctures = of_kind(rig.kernel(), EventKind::kPuncture);
    ASSERT_FALSE(punctures.empty()) << "fill " << fill;
    EXPECT_EQ(punctures[0].layer, 1U) << "fill " << fill;
    EXPECT_NEAR(static_cast<double>(punctures[0].force_n / capsule.puncture_force_n), 1, 0.02)
        << "fill " << fill;
  }
}

// The force that breaks a surface falls with speed as the material says: (v / 10 mm/s)^-m.
TEST(Layers, PunctureTakesLessForceWhenFaster) {
  for (const float speed : {2e-3F, 10e-3F, 50e-3F}) {
    TinyOrgan tiny = back();
    tiny.materials[kSkin].puncture_velocity_exponent = 0.1F;
    Rig rig = make_rig(tiny, Config{});
    drive(rig, kStart, 25e-3F, speed);
    const std::vector<Event> punctures = of_kind(rig.kernel(), EventKind::kPuncture);
    ASSERT_EQ(punctures.size(), 1U);
    const double expected = 1.5 * std::pow(static_cast<double>(speed) / 10e-3, -0.1);
    EXPECT_NEAR(static_cast<double>(punctures[0].force_n) / expected, 1, 0.03) << speed;
  }
}

TEST(Layers, LayersArePuncturedAgainElsewhereButNotInATrack) {
  Rig rig = make_rig(back(), Config{});
  const auto in_and_out = [&rig](Vec3 start) {
    drive(rig, start, 72e-3F, 20e-3F);
    drive(rig, {72e-3F, start.y, start.z}, -20e-3F, 40e-3F);
    hold(rig, {-20e-3F, start.y, start.z}, 1500);
  };
  in_and_out(kStart);
  ASSERT_EQ(of_kind(rig.kernel(), EventKind::kPuncture).size(), 2U);
  in_and_out(kStart);
  EXPECT_EQ(of_kind(rig.kernel(), EventKind::kPuncture).size(), 2U) << "in its own track";
  EXPECT_EQ(of_kind(rig.kernel(), EventKind::kReentry).size(), 1U);
  in_and_out(kStart + Vec3{0, 6e-3F, 0});
  EXPECT_EQ(of_kind(rig.kernel(), EventKind::kPuncture).size(), 4U);
}

// The tip's force falls from the ligament's to the fat's within the tick of the event.
TEST(Layers, LossOfResistanceIsFeltWithinATick) {
  Rig rig = make_rig(back(), Config{});
  double before = 0, last = 0;
  bool found = false;
  drive(rig, kStart, 72e-3F, 5e-3F, [&](const Output& out) {
    const double cutting = -static_cast<double>(out.cause.cutting_n.x);
    if (!found && out.phase == Phase::kInserted && out.layer == kEpidural) {
      found = true;
      EXPECT_GT(before, 1.2) << "in the ligament";
      EXPECT_LT(cutting, 0.4) << "one tick later";
    }
    before = last = cutting;
  });
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace stylet::test
