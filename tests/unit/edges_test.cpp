// SPDX-License-Identifier: Apache-2.0
// The edges of the interface: every bound of configuration and obstacle from both sides, poses with
// one bad number, arrays that are too small for the answer, and a kernel whose state is broken.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "gap.h"
#include "needle/obstacle.h"
#include "session.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <typename Value>
struct Edge {
  const char* name;
  std::function<void(Value&)> change;
  bool good;
};

TEST(Edges, EveryBoundOfTheConfiguration) {
  const auto organ = block_organ(2, 2, 2);
  const std::vector<Edge<Config>> edges = {
      {"unit low", [](Config& c) { c.needle[0].unit_m = 0.9e-4F; }, false},
      {"unit high", [](Config& c) { c.needle[0].unit_m = 0.051F; }, false},
      {"bending", [](Config& c) { c.needle[0].bending_nm2 = -1; }, false},
      {"no rods", [](Config& c) { c.needle[0].rods = 0; }, false},
      {"most rods", [](Config& c) { c.needle[0].rods = kMaxRods; }, true},
      {"too many rods", [](Config& c) { c.needle[0].rods = kMaxRods + 1; }, false},
      {"torsion", [](Config& c) { c.needle[0].torsion_nm2 = kMaxTorsionNm2 * 1.01F; }, false},
      {"bevel", [](Config& c) { c.needle[0].bevel_per_m = kMaxBevelPerM * 1.01F; }, false},
      {"whole needle bent", [](Config& c) { c.needle[0].bent_length_m = c.needle[0].length_m; },
       true},
      {"more than the needle bent", [](Config& c) { c.needle[0].bent_length_m = 1; }, false},
      {"angle", [](Config& c) { c.needle[0].bent_angle_rad = 1.1F; }, false},
      {"sharpest tip", [](Config& c) { c.needle[0].tip_half_angle_rad = kMinTipHalfAngleRad; },
       true},
      {"tip too sharp", [](Config& c) { c.needle[0].tip_half_angle_rad = 0.0872F; }, false},
      {"bluntest tip", [](Config& c) { c.needle[0].tip_half_angle_rad = kMaxTipHalfAngleRad; },
       true},
      {"tip too blunt", [](Config& c) { c.needle[0].tip_half_angle_rad = 1.3963F; }, false},
      {"tip without an angle", [](Config& c) { c.needle[0].tip_half_angle_rad = kNan; }, false},
      {"breath too quick", [](Config& c) { c.breathing.period_s = 0.05F; }, false},
      {"breath too deep",
       [](Config& c) {
         c.breathing.amplitude_m = {0.2F, 0, 0};
       },
       false},
      {"breath not a number",
       [](Config& c) {
         c.breathing.amplitude_m = {kNan, 0, 0};
       },
       false},
      {"drag", [](Config& c) { c.surround_drag_per_s = 101; }, false},
      {"hourglass", [](Config& c) { c.hourglass_weight = 0; }, false},
      {"alpha", [](Config& c) { c.paper_alpha = 0; }, false},
      {"no needle", [](Config& c) { c.needle_count = 0; }, false},
      {"most needles", [](Config& c) { c.needle_count = kMaxNeedles; }, true},
      {"too many needles", [](Config& c) { c.needle_count = kMaxNeedles + 1; }, false},
      {"second needle",
       [](Config& c) {
         c.needle_count = 2;
         c.needle[1].length_m = 0;
       },
       false},
      {"mode", [](Config& c) { c.mode = static_cast<Mode>(2); }, false},
  };
  for (const Edge<Config>& edge : edges) {
    Config config;
    edge.change(config);
    Sizes need = {};
    const Status expected = edge.good ? Status::kOk : Status::kConfigValueOutOfRange;
    EXPECT_EQ(sizes(organ->organ, config, need), expected) << edge.name;
    Kernel kernel;
    const Status made = create(organ->organ, config, {}, kernel);
    EXPECT_EQ(made, edge.good ? Status::kMemoryTooSmall : expected) << edge.name;
  }
  Sizes need = {};
  EXPECT_EQ(sizes(Organ{}, Config{}, need), Status::kConfigValueOutOfRange) << "no organ";
}

TEST(Edges, EveryBoundOfAnObstacle) {
  const auto organ = block_organ(2, 2, 2);
  Session session = make_session(organ->organ, Config{});
  using O = ObstacleConfig;
  const std::vector<Edge<O>> edges = {
      {"as it is", [](O&) {}, true},
      {"no vertex", [](O& o) { o.vertex_count = 0; }, false},
      {"too many vertices", [](O& o) { o.vertex_count = kMaxHullVertices + 1; }, false},
      {"position", [](O& o) { o.pose.position_m.y = kNan; }, false},
      {"rounding not a number", [](O& o) { o.rounding_m = kNan; }, false},
      {"stiffness not a number", [](O& o) { o.stiffness_n_per_m = kNan; }, false},
      {"force not a number", [](O& o) { o.largest_force_n = kNan; }, false},
      {"friction not a number", [](O& o) { o.friction = kNan; }, false},
      {"w not a number", [](O& o) { o.pose.rotation.w = kNan; }, false},
      {"z not a number", [](O& o) { o.pose.rotation.z = kNan; }, false},
      {"vertex not a number", [](O& o) { o.vertices_m[7].x = kNan; }, false},
      {"vertex far away", [](O& o) { o.vertices_m[0].x = 1e4F; }, false},
      {"far away", [](O& o) { o.pose.position_m.z = 1e4F; }, false},
      {"rotation too short",
       [](O& o) {
         o.pose.rotation = {0.9F, 0, 0, 0};
       },
       false},
      {"rotation too long",
       [](O& o) {
         o.pose.rotation = {1.1F, 0, 0, 0};
       },
       false},
      {"negative rounding", [](O& o) { o.rounding_m = -1e-3F; }, false},
      {"huge rounding", [](O& o) { o.rounding_m = 1e4F; }, false},
      {"no stiffness", [](O& o) { o.stiffness_n_per_m = 0; }, false},
      {"as stiff as a load may be", [](O& o) { o.stiffness_n_per_m = 1e6F; }, true},
      {"stiffer than a load may be", [](O& o) { o.stiffness_n_per_m = 1.000001e6F; }, false},
      {"no force", [](O& o) { o.largest_force_n = 0; }, false},
      {"negative friction", [](O& o) { o.friction = -0.1F; }, false},
  };
  for (const Edge<O>& edge : edges) {
    O obstacle;
    make_box(obstacle, {1e-3F, 2e-3F, 3e-3F});
    obstacle.stiffness_n_per_m = 1000;
    obstacle.largest_force_n = 10;
    edge.change(obstacle);
    EXPECT_EQ(set_obstacles(session.kernel, {&obstacle, 1}),
              edge.good ? Status::kOk : Status::kConfigValueOutOfRange)
        << edge.name;
  }
  const std::vector<O> many(kMaxObstacles + 1);
  EXPECT_EQ(set_obstacles(session.kernel, many), Status::kConfigValueOutOfRange);
}

// One bad number in each place of a pose, and a pose that is not valid.
TEST(Edges, EveryNumberOfAPose) {
  const auto organ = block_organ(3, 3, 3);
  Session session = make_session(organ->organ, Config{});
  EXPECT_EQ(tick(session.kernel, Input{}).flags, kFlagInputMissing) << "before the first pose";
  std::vector<Vec3> shape(2);
  EXPECT_EQ(needle_shape(session.kernel, 0, shape), 0U);
  const Pose good = {{0, 0, 0.2F}, {1, 0, 0, 0}};
  for (int field = 0; field < 7; ++field) {
    for (const float bad : {kNan, std::numeric_limits<float>::infinity()}) {
      Input input = {good, 1};
      float* fields[] = {&input.handle.position_m.x, &input.handle.position_m.y,
                         &input.handle.position_m.z, &input.handle.rotation.w,
                         &input.handle.rotation.x,   &input.handle.rotation.y,
                         &input.handle.rotation.z};
      *fields[field] = bad;
      EXPECT_EQ(tick(session.kernel, input).flags, kFlagInputNotFinite) << field;
    }
  }
  for (const Quat none : {Quat{0, 0, 0, 0}, Quat{1e7F, 0, 0, 0}, Quat{0, 0, 1e-7F, 0}}) {
    EXPECT_EQ(tick(session.kernel, {{good.position_m, none}, 1}).flags, kFlagInputNotFinite);
  }
  EXPECT_EQ(tick(session.kernel, {good, 1}).flags, 0U);
  EXPECT_EQ(needle_shape(session.kernel, 0, shape), 2U);
  EXPECT_EQ(needle_shape(session.kernel, 1, shape), 0U) << "there is no second needle";
  EXPECT_EQ(needle_shape(session.kernel, 0, std::span(shape).first(1)), 1U);
}

TEST(Edges, AQuaternionAndItsNegativeAreTheSameTurn) {
  const auto organ = block_organ(3, 3, 3);
  Session a = make_session(organ->organ, Config{}), b = make_session(organ->organ, Config{});
  for (int i = 0; i < 20; ++i) {
    const Quat q = {0.8F, 0.6F, 0, 0};
    const Quat sent = i % 2 == 0 ? q : Quat{-q.w, -q.x, -q.y, -q.z};
    const Vec3 place = {0, 0, 0.2F};
    EXPECT_EQ(tick(a.kernel, {{place, q}, 1}).flags, 0U) << i;
    EXPECT_EQ(tick(b.kernel, {{place, sent}, 1}).flags, 0U) << i;
  }
  EXPECT_EQ(hash(a.kernel), hash(b.kernel));
}

TEST(Edges, PosesTooFarAwayAreClampedOnEachAxis) {
  const auto organ = block_organ(3, 3, 3);
  for (int axis = 0; axis < 3; ++axis) {
    Session session = make_session(organ->organ, Config{});
    Vec3 far = {0, 0, 0.2F};
    float* place[] = {&far.x, &far.y, &far.z};
    *place[axis] = 3;
    EXPECT_EQ(tick(session.kernel, {{far, {1, 0, 0, 0}}, 1}).flags, kFlagInputClamped) << axis;
  }
}

// However long a tick is and however short the needle: the fastest hand that goes straight in is in
// contact in the tick that takes its tip through the surface.
TEST(Edges, TheFastestHandIsFeltAtEveryPeriod) {
  const auto organ = block_organ(3, 3, 14);
  for (const float period_s : {kMinPeriodS, 1e-3F, 3.7e-3F, kMaxPeriodS}) {
    for (const float length_m : {0.01F, 0.15F}) {
      Config config;
      config.period_s = period_s;
      config.needle[0].length_m = length_m;
      Session session = make_session(organ->organ, config);
      Vec3 base = block_script(organ->organ, config).entry_m;
      const float surface_m = base.z;
      base.x += 0.6e-3F;
      base.z += length_m + 1e-3F;
      Output out = tick(session.kernel, {{base, {1, 0, 0, 0}}, 1});
      for (int i = 0; i < 60 && out.tip_m.z > surface_m; ++i) {
        base.z -= 0.999F * kMaxHandleSpeedMPerS * period_s;
        out = tick(session.kernel, {{base, {1, 0, 0, 0}}, 1});
      }
      EXPECT_LT(out.tip_m.z, surface_m);
      EXPECT_NE(out.phase, Phase::kFree) << period_s << " s, " << length_m << " m";
    }
  }
}

// A needle with particles and a contact: a smaller array gets as many as fit.
TEST(Edges, AnswersIntoArraysThatAreTooSmall) {
  const auto organ = block_organ(5, 5, 6);
  Session session = make_session(organ->organ, Setup::kElastic);
  const Script script = block_script(organ->organ, config_of(Setup::kElastic));
  Input input = {{{}, {1, 0, 0, 0}}, 1};
  for (int i = 0; i < 545; ++i) {
    input.handle.position_m = script.entry_m;
    input.handle.position_m.z += script.needle_length_m - 4e-5F * static_cast<float>(i);
    (void)tick(session.kernel, input);
  }
  std::array<ConstraintParticle, kMaxConstraintParticles> particles;
  const std::uint32_t all = constraint_particles(session.kernel, particles);
  ASSERT_GT(all, 2U);
  EXPECT_EQ(constraint_particles(session.kernel, std::span(particles).first(2)), 2U);
  std::array<ObstacleTouch, kMaxTouches> touches;
  ASSERT_GT(obstacle_touches(session.kernel, touches), 0U) << "the needle is on the ball";
  EXPECT_EQ(obstacle_touches(session.kernel, std::span(touches).first(0)), 0U);
  std::array<Event, kMaxEvents> happened;
  const std::uint32_t count = events(session.kernel, happened);
  ASSERT_GT(count, 1U);
  std::array<Event, 1> newest;
  ASSERT_EQ(events(session.kernel, newest), 1U);
  EXPECT_EQ(newest[0].tick, happened[count - 1].tick);
  std::vector<Vec3> few(3);
  EXPECT_EQ(surface(session.kernel, few), 3U);
  EXPECT_EQ(stylet::particles(session.kernel, few), 3U);
  std::vector<std::uint32_t> corners(5);
  EXPECT_EQ(voxel_corners(session.kernel, corners), 5U);
  EXPECT_GT(mass_report(session.kernel, 0).real_kg, 0);
  EXPECT_GE(mass_report(session.kernel, 0).stepped_kg, mass_report(session.kernel, 0).real_kg);
  EXPECT_EQ(mass_report(session.kernel, 99).real_kg, 0);
}

// An elastic needle of many rods beside a wall, too stiff to bend away: more pieces touch it than
// there is room for.
TEST(Edges, MoreContactsThanRoom) {
  const auto organ = block_organ(2, 2, 2);
  Config config = config_of(Setup::kElastic);
  config.needle[0].rods = 2 * kMaxTouches;
  config.needle[0].bending_nm2 = 10;
  Session session = make_session(organ->organ, config);
  ObstacleConfig wall;
  make_box(wall, {5e-3F, 0.05F, 0.3F});
  wall.pose.position_m = {0.305F, 0, 0.1F};
  wall.stiffness_n_per_m = 100;
  wall.largest_force_n = 1;
  ASSERT_EQ(set_obstacles(session.kernel, {&wall, 1}), Status::kOk);
  std::uint32_t flags = 0, full_ticks = 0;
  for (int i = 0; i < 200; ++i) {
    const float x = 0.298F + 2e-5F * static_cast<float>(i);
    const Output out = tick(session.kernel, {{{x, 0, 0.2F}, {1, 0, 0, 0}}, 1});
    flags |= out.flags;
    full_ticks += (out.flags & kFlagObstaclePoolFull) != 0 ? 1 : 0;
    EXPECT_TRUE(std::isfinite(out.force_n.x));
  }
  EXPECT_NE(flags & kFlagObstaclePoolFull, 0U);
  EXPECT_EQ(stats(session.kernel).obstacle_contacts.used_max, kMaxTouches);
  EXPECT_GT(stats(session.kernel).obstacle_pool_full, 0U);
  // Every rod counts at most once a tick, however often it was looked at.
  EXPECT_LE(stats(session.kernel).obstacle_pool_full, full_ticks * kMaxTouches);
}

// Of all rods of a needle that leans on a wall, those that press most are kept, in whatever order
// they are looked at; expected depths are those of gap_of.
TEST(Edges, TheContactsThatPressLeastAreLeftOut) {
  const auto organ = block_organ(2, 2, 2);
  Config config = config_of(Setup::kElastic);
  config.breathing = {};
  config.needle[0].rods = 2 * kMaxTouches;
  config.needle[0].bending_nm2 = 10;          // so stiff that it does not bend away
  for (const float lean : {0.01F, -0.01F}) {  // tip first, handle first
    Session session = make_session(organ->organ, config);
    ObstacleConfig wall;
    make_box(wall, {20e-3F, 0.05F, 0.3F});
    wall.pose.position_m = {0.32F, 0, 0.1F};
    wall.stiffness_n_per_m = 10;
    wall.largest_force_n = 1;
    ASSERT_EQ(set_obstacles(session.kernel, {&wall, 1}), Status::kOk);
    const Quat turn = {std::sqrt(1 - lean * lean), 0, lean, 0};
    Output out = {};
    for (int i = 0; i < 560; ++i) {
      const float x = 0.296F + 1e-5F * static_cast<float>(i);
      out = tick(session.kernel, {{{x, 0, 0.2F}, turn}, 1});
    }
    ASSERT_NE(out.flags & kFlagObstaclePoolFull, 0U);
    std::array<ObstacleTouch, kMaxTouches> kept;
    ASSERT_EQ(obstacle_touches(session.kernel, kept), kMaxTouches);
    std::vector<Vec3> node(config.needle[0].rods + 1);
    ASSERT_EQ(needle_shape(session.kernel, 0, node), node.size());
    Obstacle body;
    ASSERT_EQ(obstacle_prepare(wall, body), Status::kOk);
    std::vector<float> depth_m;
    for (std::size_t i = 0; i + 1 < node.size(); ++i) {
      const float radius_m = config.needle[0].outer_radius_m;
      depth_m.push_back(-gap_of(body, {node[i], node[i + 1], radius_m}).separation_m);
    }
    std::sort(depth_m.begin(), depth_m.end(), std::greater<>());
    ASSERT_GT(depth_m[kMaxTouches], 0);
    const float most_left_out_n = wall.stiffness_n_per_m * depth_m[kMaxTouches];
    for (const ObstacleTouch& touch : kept) {
      const Vec3 f = touch.force_on_needle_n;
      EXPECT_GT(std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z), 0.98F * most_left_out_n) << lean;
    }
  }
}

// A needle between two walls loses all contacts with one of them in the tick in which it meets the
// other: the lost ones make room, and no new one is left out.
TEST(Edges, ContactsThatAreLostMakeRoom) {
  const auto organ = block_organ(2, 2, 2);
  Config config = config_of(Setup::kElastic);
  config.breathing = {};
  config.needle[0].rods = 2 * kMaxTouches;
  config.needle[0].bending_nm2 = 10;  // so stiff that both halves follow the handle
  Session session = make_session(organ->organ, config);
  const float radius_m = config.needle[0].outer_radius_m, half_m = 0.5F * config.needle[0].length_m;
  constexpr float kSideM = 5e-3F, kRoomM = 2e-4F, kDepthM = 1e-4F, kAtM = 0.3F, kTopM = 0.2F;
  std::array<ObstacleConfig, 2> walls;  // beside the upper half, and beside the lower
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const float way = i == 0 ? -1 : 1;
    make_box(walls[i], {kSideM, 0.05F, 0.49F * half_m});
    walls[i].pose.position_m = {kAtM + way * (radius_m + kRoomM / 2 + kSideM), 0,
                                kTopM - (i == 0 ? 0.5F : 1.5F) * half_m};
    walls[i].stiffness_n_per_m = 10;
    walls[i].largest_force_n = 1;
  }
  ASSERT_EQ(set_obstacles(session.kernel, walls), Status::kOk);
  std::array<ObstacleTouch, kMaxTouches> touches;
  const auto touched = [&](float x_m, std::uint32_t obstacle) {
    const Output out = tick(session.kernel, {{{kAtM + x_m, 0, kTopM}, {1, 0, 0, 0}}, 1});
    EXPECT_EQ(out.flags & kFlagObstaclePoolFull, 0U);
    const std::uint32_t count = obstacle_touches(session.kernel, touches);
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(touches[i].obstacle, obstacle);
    return count;
  };
  const float in_m = kRoomM / 2 + kDepthM;
  for (int i = 0; i < 10; ++i) (void)touched(0, 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(touched(-in_m, 0), kMaxTouches - 3) << i;
    EXPECT_GT(touched(in_m, 1), kMaxTouches - 3) << i;
  }
}

// A hole is entered again only along its own direction.
TEST(Edges, AnotherDirectionIsAnotherTrack) {
  const auto organ = block_organ(6, 6, 6);
  Config config;
  config.needle[0].length_m = 0.1F;
  Session session = make_session(organ->organ, config);
  const Vec3 entry = block_script(organ->organ, config).entry_m;
  const auto stroke = [&](float turn) {
    const Quat q = {std::sqrt(1 - turn * turn), 0, turn, 0};  // about y
    const Vec3 back = {2 * turn * q.w, 0, 1 - 2 * turn * turn};
    for (int i = -30; i <= 130; ++i) {  // 3 mm before to 10 mm behind and out again
      const float deep_m = 1e-4F * static_cast<float>(i < 100 ? i : 100 - 5 * (i - 100));
      const float along = config.needle[0].length_m - deep_m;
      const Vec3 base = {entry.x + along * back.x, entry.y, entry.z + along * back.z};
      (void)tick(session.kernel, {{base, q}, 1});
    }
    for (int i = 0; i < 300; ++i) (void)tick(session.kernel, Input{});
  };
  const auto count = [&](EventKind kind) {
    std::array<Event, kMaxEvents> all;
    const std::uint32_t happened = events(session.kernel, all);
    return std::count_if(all.begin(), all.begin() + happened,
                         [kind](const Event& e) { return e.kind == kind; });
  };
  stroke(0);
  EXPECT_EQ(count(EventKind::kPuncture), 1);
  stroke(0);
  EXPECT_EQ(count(EventKind::kPuncture), 1);
  EXPECT_EQ(count(EventKind::kReentry), 1);
  stroke(0.3F);
  EXPECT_EQ(count(EventKind::kPuncture), 2);
  EXPECT_EQ(count(EventKind::kReentry), 1);
}

TEST(Edges, APieceThatIsNotFiniteTouchesNothing) {
  ObstacleConfig config;
  make_sphere(config, 0.01F);
  config.stiffness_n_per_m = 1000;
  config.largest_force_n = 10;
  Obstacle obstacle;
  ASSERT_EQ(obstacle_prepare(config, obstacle), Status::kOk);
  const NeedlePiece good = {{-0.05F, 0, 0}, {0.05F, 0, 0}, 1e-3F};
  ObstacleContact next = {};
  const Segment far = {{0, 0, 1}, {0, 0, 2}};
  EXPECT_GT(obstacle_load(obstacle, good, far, 0.1, {}, next).depth_m, 0);
  for (int part = 0; part < 3; ++part) {
    NeedlePiece bad = good;
    (part == 0 ? bad.a_m.y : part == 1 ? bad.b_m.z : bad.radius_m) = kNan;
    EXPECT_EQ(obstacle_load(obstacle, bad, far, 0.1, {}, next).depth_m, 0) << part;
  }
}

// The longest of all needles of the configuration, and of no others.
TEST(Edges, TheLongestUnitIsGivenInVoxels) {
  const auto organ = block_organ(3, 3, 3);  // voxels of 5 mm
  Config config;
  config.needle[0].unit_m = 2e-3F;
  config.needle[1].unit_m = 8e-3F;
  EXPECT_FLOAT_EQ(stats(make_session(organ->organ, config).kernel).unit_in_voxels, 0.4F);
  config.needle_count = 2;
  EXPECT_FLOAT_EQ(stats(make_session(organ->organ, config).kernel).unit_in_voxels, 1.6F);
}

// Fewer inputs or outputs than needles.
TEST(Edges, NeedlesWithoutInputOrOutput) {
  const auto organ = block_organ(3, 3, 3);
  Config config;
  config.needle_count = 2;
  Session session = make_session(organ->organ, config);
  const Input input = {{{0, 0, 0.2F}, {1, 0, 0, 0}}, 1};
  std::array<Output, 3> outputs = {};
  tick(session.kernel, {&input, 1}, outputs);
  EXPECT_EQ(outputs[0].flags, 0U);
  EXPECT_EQ(outputs[1].flags, kFlagInputMissing);
  EXPECT_EQ(outputs[1].tip_m.z, 0) << "nobody knows where it is";
  EXPECT_EQ(outputs[2].tick, 0U) << "there is no third needle";
  tick(session.kernel, {&input, 1}, std::span(outputs).first(1));
  EXPECT_EQ(outputs[0].tick, 2U);
  EXPECT_EQ(outputs[1].tick, 1U);
}

// If somebody else wrote into the memory, the force must not follow that.
TEST(Edges, ABrokenStateLatchesAFaultUntilReset) {
  const auto organ = block_organ(4, 4, 4);
  Session session = make_session(organ->organ, Config{});
  const Script script = block_script(organ->organ, Config{});
  run(session.kernel, script, 0, 1200);
  View view = view_of(session.kernel);
  ASSERT_GT(view.state.needle->shaft_count, 0U);
  for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) view.state.ux[i] = kNan;
  Output out = {};
  for (int i = 0; i < 3; ++i) {
    out = tick(session.kernel, Input{});
    EXPECT_EQ(out.flags, kFlagFault);
    EXPECT_EQ(out.force_n.z, 0);
    EXPECT_EQ(out.torque_nm.z, 0);
  }
  EXPECT_EQ(out.layer, kNoLayer);
  EXPECT_EQ(out.tick, 1203U) << "time goes on";
  EXPECT_EQ(stats(session.kernel).fault, 1U);
  reset(session.kernel);
  EXPECT_EQ(tick(session.kernel, scripted_input(script, 0)).flags, 0U);
}

// Found by the fuzzer: tissue was torn apart after the needle had left it, so that no force showed
// it.
TEST(Edges, TissueThatIsNotFiniteLatchesAFaultThoughTheNeedleIsOutside) {
  for (const float odd : {kNan, std::numeric_limits<float>::infinity()}) {
    const auto organ = block_organ(4, 4, 4);
    Session session = make_session(organ->organ, Config{});
    const Input outside = {{{0, 0, 1}, {1, 0, 0, 0}}, 1};
    EXPECT_EQ(tick(session.kernel, outside).flags, 0U);
    View view = view_of(session.kernel);
    const std::uint32_t middle = view.model.head->counts.particles / 2;
    for (std::uint32_t i = middle; i < middle + 40; ++i) view.state.uy[i] = odd;
    EXPECT_EQ(tick(session.kernel, outside).flags, kFlagFault) << odd;
    EXPECT_EQ(stats(session.kernel).fault, 1U);
    reset(session.kernel);
    EXPECT_EQ(tick(session.kernel, outside).flags, 0U);
  }
}

}  // namespace
}  // namespace stylet::test
