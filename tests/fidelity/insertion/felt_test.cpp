// SPDX-License-Identifier: Apache-2.0
// A needle is felt wherever it goes in: no state of the rest of the organ hides it.
//
// Judged by brute force: the number of triangles that rays from a tip cross says whether it is
// inside the deformed surface. The kernel's own search is not used.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

// Random numbers that are the same everywhere; those of the standard library's distributions are
// not.
struct Draw {
  std::mt19937_64 engine;
  float between(float low, float high) {
    const auto part = static_cast<float>(static_cast<double>(engine() >> 11U) * 0x1p-53);
    return low + (high - low) * part;
  }
  bool chance(float share) { return between(0, 1) < share; }
  Vec3 direction() {
    Vec3 d;
    do {
      d = {between(-1, 1), between(-1, 1), between(-1, 1)};
    } while (norm(d) < 0.1F || norm(d) > 1);
    return (1 / norm(d)) * d;
  }
};

// A needle along any direction, with its tip at a given position.
Input along(Vec3 direction, Vec3 tip_m, float length_m) {
  // The turn from -z to the direction: half-way quaternion.
  Vec3 axis = cross(Vec3{0, 0, -1}, direction);
  float w = 1 - direction.z;
  if (w < 1e-6F) {
    axis = {1, 0, 0};
    w = 0;
  }
  const float size = std::sqrt(w * w + dot(axis, axis));
  return {{tip_m - length_m * direction, {w / size, axis.x / size, axis.y / size, axis.z / size}},
          1};
}

using Point = std::array<double, 3>;
Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point times(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double with(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point point(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Squared distance from the origin to a segment.
double square_to(const Point& a, const Point& b) {
  const Point along = minus(b, a);
  const double length2 = with(along, along);
  const double part = length2 > 0 ? std::clamp(-with(a, along) / length2, 0.0, 1.0) : 0;
  Point foot;
  for (std::size_t k = 0; k < 3; ++k) foot[k] = a[k] + part * along[k];
  return with(foot, foot);
}

// Squared distance from the origin to a triangle: to its plane where that is within it, else to its
// sides.
double square_to(const Point& a, const Point& b, const Point& c) {
  const Point n = times(minus(b, a), minus(c, a));
  const double n2 = with(n, n);
  const bool over =
      with(n, times(a, b)) >= 0 && with(n, times(b, c)) >= 0 && with(n, times(c, a)) >= 0;
  if (n2 > 0 && over) return with(a, n) * with(a, n) / n2;
  return std::min({square_to(a, b), square_to(b, c), square_to(c, a)});
}

struct Judge {
  std::vector<Vec3> places;
  const Organ& organ;

  int crossings(Vec3 from_m, Vec3 way) const {
    int count = 0;
    const Point from = point(from_m), d = point(way);
    for (const OrganTriangle& t : organ.triangles) {
      const Point a = point(places[t.a]), ab = minus(point(places[t.b]), a);
      const Point ac = minus(point(places[t.c]), a), gap = minus(from, a);
      const Point p = times(d, ac), q = times(gap, ab);
      const double det = with(ab, p);
      if (std::fabs(det) < 1e-18) continue;
      const double u = with(gap, p) / det, v = with(d, q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && with(ac, q) / det >= 0) ++count;
    }
    return count;
  }

  double depth_m(Vec3 tip_m) const {
    const Point tip = point(tip_m);
    double square = 1;
    for (const OrganTriangle& t : organ.triangles) {
      square =
          std::min(square, square_to(minus(point(places[t.a]), tip), minus(point(places[t.b]), tip),
                                     minus(point(places[t.c]), tip)));
    }
    return std::sqrt(square);
  }

  // Inside if all three rays say so, and farther than this from the surface.
  bool inside(Vec3 tip_m, double skin_m) const {
    for (const Vec3 way :
         {Vec3{0.91F, 0.31F, 0.27F}, {-0.43F, 0.83F, 0.36F}, {0.22F, -0.3F, 0.93F}}) {
      if (crossings(tip_m, way) % 2 == 0) return false;
    }
    return depth_m(tip_m) > skin_m;
  }
};

struct Stroke {
  float speed_m_per_s, to_m;
};

// One stroke after the other; the needle is swept aside during the first.
struct Way {
  Vec3 start_m, direction, aside_m_per_s;
  std::vector<Stroke> strokes;
  int begin;  // tick
  float gone_m = 0;
  std::size_t done = 0;

  Vec3 tip_m(float period_s, int tick) {
    if (tick <= begin || done == strokes.size()) return start_m + gone_m * direction;
    const Stroke& now = strokes[done];
    const float step = now.speed_m_per_s * period_s, left = now.to_m - gone_m;
    gone_m += std::clamp(left, -step, step);
    if (gone_m == now.to_m) ++done;
    const float aside_s = done == 0 ? period_s * static_cast<float>(tick - begin) : 0;
    return start_m + gone_m * direction + aside_s * aside_m_per_s;
  }
};

struct Scene {
  TinyOrgan tiny;
  Config config;
  std::vector<Way> ways;
};

// A block of soft tissue under a tough skin, one needle that dents it, and up to three others that
// come from anywhere while the dent is there.
Scene drawn_scene(std::uint64_t seed) {
  Draw draw{std::mt19937_64(seed)};
  Scene scene;
  TinyOrgan& tiny = scene.tiny;
  tiny.voxel_edge_m = draw.between(1.5e-3F, 7e-3F);
  const auto cells = [&](float low, float high) {
    return static_cast<std::uint16_t>(
        std::clamp(draw.between(low, high) / tiny.voxel_edge_m, 4.0F, 22.0F));
  };
  tiny.nx = cells(0.02F, 0.05F);
  tiny.ny = cells(0.04F, 0.09F);
  tiny.nz = cells(0.04F, 0.09F);
  tiny.fixed_faces = kHighX;
  TinyMaterial skin = {.name = "skin", .youngs_modulus_pa = draw.between(20e3F, 60e3F)};
  skin.puncture_force_n = draw.between(2, 8);
  TinyMaterial fat = {.name = "fat", .youngs_modulus_pa = draw.between(1e3F, 4e3F)};
  tiny.materials = {skin, fat};
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x == 0 ? 0 : 1);
  };
  scene.config.needle_count = 1 + static_cast<std::uint32_t>(draw.between(0, 3.999F));
  if (draw.chance(0.4F)) {
    scene.config.breathing.amplitude_m = draw.between(1e-3F, 15e-3F) * draw.direction();
    scene.config.breathing.period_s = draw.between(0.5F, 4);
  }
  const float h = tiny.voxel_edge_m;
  const Vec3 size = {h * tiny.nx, h * tiny.ny, h * tiny.nz};
  const auto somewhere = [&](float margin) {
    return Vec3{0, size.y * draw.between(margin, 1 - margin),
                size.z * draw.between(margin, 1 - margin)};
  };
  // The first one dents, slowly enough for the tissue to follow, and then rests.
  scene.ways.push_back({somewhere(0.2F) - Vec3{2e-3F, 0, 0},
                        {1, 0, 0},
                        {},
                        {{0.05F, 2e-3F + draw.between(2e-3F, 9e-3F)}},
                        0});
  for (std::uint32_t i = 1; i < scene.config.needle_count; ++i) {
    Vec3 direction = draw.direction();
    if (direction.x < 0) direction.x = -direction.x;
    const float speed = 0.02F * std::pow(100.0F, draw.between(0, 1));  // to 2 m/s
    const Vec3 through = somewhere(0.1F) + Vec3{size.x * draw.between(0, 0.7F), 0, 0};
    const float run_up = draw.between(0.02F, 0.06F) + norm(size);
    const Vec3 aside =
        draw.chance(0.5F) ? draw.between(0, 1) * cross(direction, draw.direction()) : Vec3{};
    scene.ways.push_back({through - run_up * direction,
                          direction,
                          aside,
                          {{speed, 2 * run_up}},
                          250 + static_cast<int>(draw.between(0, 100))});
  }
  return scene;
}

// The same, but each needle stops somewhere on its way and goes back and forth from there.
Scene drawn_back(std::uint64_t seed) {
  Scene scene = drawn_scene(seed);
  Draw draw{std::mt19937_64(~seed)};
  for (Way& way : scene.ways) {
    const float far_m = way.strokes[0].to_m;
    float at_m = far_m * draw.between(0.3F, 1);
    way.strokes[0].to_m = at_m;
    for (int i = 0; i < 8; ++i) {
      const float speed = 0.02F * std::pow(50.0F, draw.between(0, 1));  // to 1 m/s
      at_m = i % 2 == 0 ? at_m * draw.between(0, 1) : at_m + (far_m - at_m) * draw.between(0, 1);
      way.strokes.push_back({speed, at_m});
    }
  }
  return scene;
}

// A ball of gel held on one side; needles, bending or rigid, go into it and out again, thrice. Gel
// that the shaft has drawn along springs back over the tip when that has come out.
Scene drawn_out(std::uint64_t seed) {
  Draw draw{std::mt19937_64(~(seed << 20U))};
  Scene scene;
  TinyOrgan& tiny = scene.tiny;
  tiny.voxel_edge_m = draw.between(2e-3F, 7e-3F);
  const float across_m = draw.between(0.03F, 0.06F), h = tiny.voxel_edge_m;
  const auto cells = static_cast<std::uint16_t>(across_m / h);
  tiny.nx = tiny.ny = tiny.nz = cells;
  tiny.fixed_faces = kHighX;
  const float middle = 0.5F * static_cast<float>(cells);
  tiny.inside = [middle](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    const auto from = [middle](std::uint16_t i) { return static_cast<float>(i) + 0.5F - middle; };
    return from(x) * from(x) + from(y) * from(y) + from(z) * from(z) <= middle * middle;
  };
  tiny.materials = {TinyMaterial{.youngs_modulus_pa = draw.between(3e3F, 20e3F)}};
  tiny.materials[0].puncture_force_n = draw.between(0.3F, 3);
  tiny.materials[0].coulomb_friction_n_per_m = draw.between(5, 60);
  tiny.materials[0].static_friction_n_per_m = tiny.materials[0].coulomb_friction_n_per_m;
  scene.config.needle_count = 1 + static_cast<std::uint32_t>(draw.between(0, 2.999F));
  for (std::uint32_t i = 0; i < scene.config.needle_count; ++i) {
    auto& needle = scene.config.needle[i];
    if (draw.chance(0.5F)) {
      needle.bending_nm2 = draw.between(2e-3F, 3e-2F);
      needle.rods = 16;
    }
    const float radius_m = h * middle, run_up_m = radius_m + draw.between(2e-3F, 10e-3F);
    Vec3 direction = draw.direction();
    if (direction.x < 0) direction.x = -direction.x;  // not from the side that is held
    const Vec3 through = Vec3{radius_m, radius_m, radius_m} + 0.5F * radius_m * draw.direction();
    Way way = {through - run_up_m * direction, direction, {}, {}, 0};
    for (int stroke = 0; stroke < 3; ++stroke) {
      const float in = 0.02F * std::pow(50.0F, draw.between(0, 1));  // to 1 m/s
      const float out = 0.02F * std::pow(50.0F, draw.between(0, 1));
      way.strokes.push_back({in, run_up_m + draw.between(-0.5F, 0.7F) * radius_m});
      way.strokes.push_back({out, 0});
    }
    scene.ways.push_back(way);
  }
  return scene;
}

// Ticks in which a needle was inside and felt nothing. They are judged by the surface at the start
// of the tick, by which the kernel decided: within a tick tissue may move over a tip by more than
// the depth allowed here (by more than 0.1 mm in 3 of 800 scenes); the next tick then finds the
// tip.
void expect_felt(std::uint64_t seed, Scene scene) {
  Rig rig = make_rig(scene.tiny, scene.config);
  const std::uint32_t needles = scene.config.needle_count;
  std::vector<Input> inputs(needles);
  std::vector<Output> outputs(needles);
  std::vector<bool> met(needles, false);
  Judge judge{{}, rig.organ->organ};
  judge.places.resize(judge.organ.vertices.size());
  for (int t = 0; t < 900; ++t) {
    for (std::uint32_t i = 0; i < needles; ++i) {
      Way& way = scene.ways[i];
      inputs[i] = along(way.direction, way.tip_m(scene.config.period_s, t),
                        scene.config.needle[i].length_m);
    }
    surface(rig.kernel(), judge.places);
    tick(rig.kernel(), inputs, outputs);
    for (std::uint32_t i = 0; i < needles; ++i) {
      if (outputs[i].phase != Phase::kFree) {
        met[i] = true;
        continue;
      }
      // A needle that was in and came out again may lie in the mouth of its own hole. For others
      // 0.1 mm is allowed for rounding and skin.
      const double mouth_m = 3 * static_cast<double>(scene.config.needle[i].outer_radius_m);
      const double skin_m = met[i] ? mouth_m + 1e-4 : 1e-4;
      ASSERT_FALSE(judge.inside(outputs[i].tip_m, skin_m))
          << "seed " << seed << ": needle " << i << " of " << needles << " in tick " << t
          << ", voxels of " << 1e3F * scene.tiny.voxel_edge_m << " mm";
    }
  }
}

TEST(Felt, NoTipIsInTissueInPhaseFree) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    expect_felt(seed, drawn_scene(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Felt, NoTipIsInTissueInPhaseFreeOnItsWayBack) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    expect_felt(seed, drawn_back(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Felt, NoTipIsInTissueInPhaseFreeWhenItHasJustLeft) {
  std::vector<std::uint64_t> seeds = {1057, 1101};  // 19 and 49 ticks without a force, once
  for (std::uint64_t seed = 1; seed <= 12; ++seed) seeds.push_back(seed);
  for (const std::uint64_t seed : seeds) {
    expect_felt(seed, drawn_out(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(FeltExhaustive, NoTipIsInTissueInPhaseFree) {
  for (std::uint64_t seed = 1000; seed < 1400; ++seed) {
    expect_felt(seed, drawn_scene(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(FeltExhaustive, NoTipIsInTissueInPhaseFreeOnItsWayBack) {
  for (std::uint64_t seed = 1000; seed < 1400; ++seed) {
    expect_felt(seed, drawn_back(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(FeltExhaustive, NoTipIsInTissueInPhaseFreeWhenItHasJustLeft) {
  for (std::uint64_t seed = 1000; seed < 1400; ++seed) {
    expect_felt(seed, drawn_out(seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

// A needle whose first pose lies in tissue, as when a program starts again with the hand still in:
// such a needle was once felt only within 20 mm below the skin, and never where it was deeper.
TEST(Felt, AFirstPoseDeepInTissue) {
  Draw draw{std::mt19937_64(7)};
  for (int round = 0; round < 24; ++round) {
    Scene scene = drawn_scene(900 + static_cast<std::uint64_t>(round));
    scene.config.needle_count = 1;
    const TinyOrgan& tiny = scene.tiny;
    const float h = tiny.voxel_edge_m;
    const Vec3 size = {h * tiny.nx, h * tiny.ny, h * tiny.nz};
    const Vec3 tip = {size.x * draw.between(0.3F, 0.9F), size.y * draw.between(0.2F, 0.8F),
                      size.z * draw.between(0.2F, 0.8F)};
    const float lean_y = draw.between(-0.5F, 0.5F), lean_z = draw.between(-0.5F, 0.5F);
    const float length = std::sqrt(1 + lean_y * lean_y + lean_z * lean_z);
    const Vec3 direction = {1 / length, lean_y / length, lean_z / length};
    const float speed = draw.chance(0.5F) ? draw.between(0.01F, 0.2F) : draw.between(-0.2F, -0.01F);
    Rig rig = make_rig(tiny, scene.config);
    float most_n = 0;
    for (int t = 0; t < 40; ++t) {
      const float on_m = 1e-3F * speed * static_cast<float>(t);
      const Input input = along(direction, tip + on_m * direction, scene.config.needle[0].length_m);
      Output out = {};
      tick(rig.kernel(), {&input, 1}, {&out, 1});
      ASSERT_NE(out.phase, Phase::kFree) << "round " << round << ", tick " << t;
      most_n = std::max(most_n, norm(out.force_n));
    }
    EXPECT_TRUE(std::isfinite(most_n));
    EXPECT_TRUE(speed < 0 || most_n > 0) << "round " << round << ": " << most_n;
  }
}

// A case that an independent check found: fat under skin, voxels of 3 mm, a dent of 8 mm, and a
// second needle 15 to 45 mm away that went in 45 mm deep without a force.
TEST(Felt, ASecondNeedleBesideADent) {
  for (const float apart_m : {15e-3F, 30e-3F, 45e-3F}) {
    TinyOrgan tiny;
    tiny.nx = 18;
    tiny.ny = 16;
    tiny.nz = 26;
    tiny.voxel_edge_m = 3e-3F;
    tiny.fixed_faces = kHighX;
    TinyMaterial skin = {.name = "skin", .youngs_modulus_pa = 40e3F};
    skin.puncture_force_n = 3;
    tiny.materials = {skin, TinyMaterial{.name = "fat", .youngs_modulus_pa = 2e3F}};
    tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
      return static_cast<std::uint8_t>(x == 0 ? 0 : 1);
    };
    Config config;
    config.needle_count = 2;
    Rig rig = make_rig(tiny, config);
    const Vec3 first = {0, 24e-3F, 15e-3F}, second = {0, 24e-3F, 15e-3F + apart_m};
    double felt_n = 0;
    for (int t = 0; t < 4000; ++t) {
      const float dent = std::min(7.8e-3F, 10e-6F * static_cast<float>(t));
      const float deep = std::min(45e-3F, 15e-6F * static_cast<float>(std::max(t - 1000, 0)));
      const std::array<Input, 2> in = {along_x(first + Vec3{dent, 0, 0}, rig.length_m),
                                       along_x(second + Vec3{deep - 2e-3F, 0, 0}, rig.length_m)};
      std::array<Output, 2> out = {};
      checked_tick(rig, in, out);
      felt_n = std::max(felt_n, norm_of(out[1].force_n));
      ASSERT_TRUE(deep < 12e-3F || out[1].phase != Phase::kFree) << apart_m << " tick " << t;
    }
    EXPECT_GT(felt_n, 0.5) << apart_m;
    EXPECT_EQ(stats(rig.kernel()).contact_budget, 0U) << apart_m;
  }
}

}  // namespace
}  // namespace stylet::test
