// SPDX-License-Identifier: Apache-2.0
// Contact with an obstacle: its law, friction, continuity over faces and edges, energy, abuse.
#include <functional>
#include <limits>

#include "obstacle_rig.h"

namespace stylet::test {
namespace {

constexpr Vec3 kHalf = {5e-3F, 5e-3F, 5e-3F};
constexpr double kTopM = 5e-3 + static_cast<double>(kNeedleRadiusM);  // axis of a touching needle
constexpr double kStiffness = 20e3, kLargestForceN = 20, kFriction = 0.2;  // of bone()

Obstacle box(float friction = 0) {
  ObstacleConfig config = bone_box(kHalf);
  config.friction = friction;
  return prepared(config);
}

NeedlePiece tip_at(double x, double y, double z) {
  const Vec3 at = to_float({x, y, z});
  return {at, at, kNeedleRadiusM};
}

// Of a contact's normal in a step of a millisecond.
constexpr double kTurnRad = static_cast<double>(kMaxNormalTurnRadPerS * 1e-3F);

// A contact, together with its state of the last step.
struct Touching {
  Obstacle body;
  ObstacleContact state = {};
  double turn_rad = kTurnRad;
  Segment before_m = {};
  bool known = false;

  ObstacleLoad step(const NeedlePiece& piece) {
    const Segment axis = {to_double(piece.a_m), to_double(piece.b_m)};
    ObstacleContact next;
    const ObstacleLoad load =
        obstacle_load(body, piece, known ? before_m : axis, turn_rad, state, next);
    state = next;
    before_m = axis;
    known = true;
    return load;
  }
};

double length_of(Vec3 v) {
  return norm(to_double(v));
}

// ---- the law ------------------------------------------------------------------------------------

TEST(Law, ForceIsLinearFromTheFirstTouchToTheLargestForce) {
  for (double depth : {1e-6, 1e-5, 1e-4, 1e-3, 3e-3}) {
    Touching touch = {box()};
    ObstacleLoad load = {};
    for (int i = 0; i <= 100; ++i) load = touch.step(tip_at(1e-3, 2e-3, kTopM - depth * i / 100));
    const double u = kStiffness * depth / kLargestForceN, root = std::sqrt(1 + u * u);
    const double rounding = 1e-9 * kStiffness;  // of float positions
    EXPECT_NEAR(static_cast<double>(load.force_n.z), kStiffness * depth / root, rounding);
    EXPECT_NEAR(static_cast<double>(load.stiffness_n_per_m.m[2][2]), kStiffness / std::pow(root, 3),
                1e-4 * kStiffness);
    EXPECT_NEAR(static_cast<double>(load.elastic_j),
                kLargestForceN * kLargestForceN / kStiffness * (root - 1), 1e-9 * kLargestForceN);
    EXPECT_LT(std::hypot(load.force_n.x, load.force_n.y), 1e-4F);
    EXPECT_LT(length_of(load.force_n), kLargestForceN);
  }
}

TEST(Law, IsSilentOutOfTouch) {
  Touching touch = {box()};
  const ObstacleLoad load = touch.step(tip_at(0, 0, kTopM + 1e-7));
  EXPECT_EQ(load.depth_m, 0);
  EXPECT_EQ(length_of(load.force_n), 0);
  EXPECT_EQ(length_of(touch.state.normal), 0);
}

TEST(Law, LinearLoadPredictsTheNextForce) {
  PlaceDraw draw;
  for (int i = 0; i < 2000; ++i) {
    ObstacleConfig config = bone_box(kHalf);
    config.pose = {draw.vector(0.05), draw.rotation()};
    Touching touch = {prepared(config)};
    const auto place = [&](Vec3 v) {
      const Vec3 at = touch.body.rotation * v + config.pose.position_m;
      return NeedlePiece{at, at, kNeedleRadiusM};
    };
    const Vec3 near = to_float(
        {draw.between(-4e-3, 4e-3), draw.between(-4e-3, 4e-3), kTopM - draw.between(1e-5, 3e-4)});
    (void)touch.step(place(near));
    const ObstacleLoad before = touch.step(place(near));
    const NeedlePiece moved = place(near + to_float(1e-7 * to_double(draw.vector(1))));
    const ObstacleLoad after = touch.step(moved);
    const Vec3d change = to_double(moved.a_m) - to_double(before.at_m);
    Vec3d predicted = to_double(before.force_n);
    double* out[] = {&predicted.x, &predicted.y, &predicted.z};
    for (int row = 0; row < 3; ++row) {
      const float* k = before.stiffness_n_per_m.m[row];
      *out[row] -= dot(to_double({k[0], k[1], k[2]}), change);
      for (int col = 0; col < row; ++col) EXPECT_EQ(k[col], before.stiffness_n_per_m.m[col][row]);
    }
    ASSERT_LT(norm(to_double(after.force_n) - predicted), 2e-5);
    ASSERT_EQ(after.slips, 0U);
  }
}

TEST(Law, RefusesBodiesThatAreInvalid) {
  Obstacle body = {};
  const auto refused = [&](const std::function<void(ObstacleConfig&)>& spoil) {
    ObstacleConfig config = bone_box(kHalf);
    spoil(config);
    return obstacle_prepare(config, body) == Status::kConfigValueOutOfRange;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(refused([](ObstacleConfig&) {}));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.vertex_count = 0; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.vertex_count = kMaxHullVertices + 1; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.vertices_m[7].y = kNan; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.pose.position_m.x = kNan; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.pose.rotation = {0, 0, 0, 0}; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.stiffness_n_per_m = 0; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.largest_force_n = -1; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.friction = kNan; }));
  EXPECT_TRUE(refused([](ObstacleConfig& c) { c.rounding_m = -1e-3F; }));
}

// ---- continuity ---------------------------------------------------------------------------------

// Largest change of force and place from one step to the next along a path, with t from 0 to 1.
struct Jumps {
  double force_n = 0, place = 0;
  double largest_force_n = 0;
};

Jumps largest_jumps(const Obstacle& body, int steps,
                    const std::function<NeedlePiece(double)>& path) {
  Touching touch = {body};
  ObstacleLoad last = touch.step(path(0));
  Jumps jumps;
  for (int i = 1; i <= steps; ++i) {
    const ObstacleLoad load = touch.step(path(static_cast<double>(i) / steps));
    jumps.force_n = std::max(jumps.force_n, length_of(load.force_n - last.force_n));
    if (load.depth_m > 0 && last.depth_m > 0) {
      jumps.place = std::max(jumps.place, std::fabs(static_cast<double>(load.place - last.place)));
    }
    jumps.largest_force_n = std::max(jumps.largest_force_n, length_of(load.force_n));
    last = load;
  }
  return jumps;
}

// With half the step a continuous force changes half as much; a jump stays as large.
void expect_continuous(const char* name, const Obstacle& body,
                       const std::function<NeedlePiece(double)>& path, int steps = 1000) {
  const Jumps coarse = largest_jumps(body, steps, path);
  const Jumps fine = largest_jumps(body, 4 * steps, path);
  std::printf("%-28s force to %6.3f N, largest change %.4f N, a quarter of the step %.4f N\n", name,
              coarse.largest_force_n, coarse.force_n, fine.force_n);
  EXPECT_GT(coarse.largest_force_n, 0.3) << name;
  EXPECT_LT(fine.force_n, 0.35 * coarse.force_n) << name;
}

TEST(Continuity, SlidingAlongAFaceChangesNothing) {
  Touching touch = {box()};
  const ObstacleLoad first = touch.step(tip_at(-4e-3, 1e-3, kTopM - 1e-4));
  for (double x = -4e-3; x < 4.9e-3; x += 2e-5) {
    const ObstacleLoad load = touch.step(tip_at(x, 1e-3 + 0.3 * x, kTopM - 1e-4));
    ASSERT_LT(length_of(load.force_n - first.force_n), 1e-9 * kStiffness);
  }
}

TEST(Continuity, OverAnEdgeWithTheTip) {
  for (const double depth : {2e-5, 1e-4, 2e-4}) {
    expect_continuous("tip over an edge", box(),
                      [depth](double t) { return tip_at(4e-3 + 2e-3 * t, 1e-3, kTopM - depth); });
    expect_continuous("tip over a corner", box(), [depth](double t) {
      return tip_at(4e-3 + 2e-3 * t, 4.2e-3 + 1.5e-3 * t, kTopM - depth);
    });
  }
}

TEST(Continuity, OverAnEdgeWithTheShaft) {
  // The piece leans over the edge x = 5 mm, z = 5 mm. When it moves along its own axis, the force
  // stays the same and its place moves along the piece.
  const Jumps along_itself = largest_jumps(box(), 1000, [](double t) {
    const Vec3d along = {0.8, 0, -0.6};
    const Vec3d over =
        Vec3d{5e-3, 0, 5e-3} + (static_cast<double>(kNeedleRadiusM) - 1e-4) * Vec3d{0.6, 0, 0.8};
    const Vec3d a = over + (-9e-3 + 8e-3 * t) * along;
    return NeedlePiece{to_float(a), to_float(a + 10e-3 * along), kNeedleRadiusM};
  });
  EXPECT_GT(along_itself.largest_force_n, 1.9);
  EXPECT_LT(along_itself.force_n, 1e-8 * kStiffness);
  EXPECT_LT(along_itself.place, 1.5e-3);
  expect_continuous("shaft rolls over the edge", box(), [](double t) {
    const double lean = 0.2 + 1.1 * t, c = std::cos(lean), s = std::sin(lean);
    const double out = static_cast<double>(kNeedleRadiusM) - 1e-4;
    const Vec3d over = {5e-3 + out * s, 0, 5e-3 + out * c};
    const Vec3d along = {c, 0.1, -s};
    return NeedlePiece{to_float(over - 3e-3 * along), to_float(over + 3e-3 * along),
                       kNeedleRadiusM};
  });
}

TEST(Continuity, FromATouchToDeepInside) {
  expect_continuous("tip into a face", box(), [](double t) {
    return tip_at(1e-3 + 1e-3 * t, 1e-3, kTopM + 1e-4 - 3e-3 * t);
  });
  expect_continuous("shaft into an edge", box(), [](double t) {
    const Vec3d at = (5.3e-3 - 2e-3 * t) * Vec3d{1, 0, 1} + Vec3d{0, 1e-3 * t, 0};
    const Vec3d along = {0.6, 0.5, -0.6};
    return NeedlePiece{to_float(at - 4e-3 * along), to_float(at + 4e-3 * along), kNeedleRadiusM};
  });
}

TEST(Continuity, DeepInsideTheForceTurnsSlowlyWhereverTheNeedleLeaves) {
  // 2 mm below the top, out through the side at 50 mm/s: the force must not flip from up to
  // sideways.
  const Jumps jumps = largest_jumps(box(), 100, [](double t) {
    const double down = std::min(1.0, 3 * t), side = std::max(0.0, 3 * t - 1);
    return tip_at(3e-3 + 2.5e-3 * side, 0, kTopM - 2e-3 * down);
  });
  const double depth = 2e-3 + static_cast<double>(kNeedleRadiusM), motion = 7.5e-5;
  const double allowed = kLargestForceN * kTurnRad + kStiffness * (depth * kTurnRad + motion);
  std::printf("deep, out through the side: largest change %.2f N\n", jumps.force_n);
  EXPECT_GT(jumps.largest_force_n, 0.85 * kLargestForceN);
  EXPECT_LT(jumps.force_n, allowed);
}

// A shaft of ten pieces rocks on a face: the sum of their forces has no jump, and that of their
// torques none beyond one piece's length.
TEST(Continuity, AFlatShaftOfShortPieces) {
  constexpr int kPieces = 10, kSteps = 4000;
  constexpr double kPieceM = 0.8e-3;
  std::array<ObstacleContact, kPieces> contacts = {};
  const Obstacle body = box();
  double force_last = 0, torque_last = 0, force_jump = 0, torque_jump = 0, largest = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double tilt = 2e-3 * std::sin(24 * 3.14159265358979323846 * i / kSteps);
    double force = 0, torque = 0;
    for (int piece = 0; piece < kPieces; ++piece) {
      const double a = kPieceM * (piece - 0.5 * kPieces), b = a + kPieceM, z = kTopM - 5e-5;
      const Segment axis = {{a, 0, z + tilt * a}, {b, 0, z + tilt * b}};
      ObstacleContact next;
      const ObstacleLoad load =
          obstacle_load(body, {to_float(axis.a_m), to_float(axis.b_m), kNeedleRadiusM}, axis,
                        kTurnRad, contacts[static_cast<std::size_t>(piece)], next);
      contacts[static_cast<std::size_t>(piece)] = next;
      force += static_cast<double>(load.force_n.z);
      torque += static_cast<double>(load.force_n.z * load.at_m.x);
    }
    if (i > 0) {
      force_jump = std::max(force_jump, std::fabs(force - force_last));
      torque_jump = std::max(torque_jump, std::fabs(torque - torque_last));
    }
    largest = std::max(largest, force);
    force_last = force;
    torque_last = torque;
  }
  EXPECT_GT(largest, 9);
  EXPECT_LT(force_jump, 5e-3 * largest);
  EXPECT_LT(torque_jump, 1.2 * kPieceM * largest);
}

// ---- friction -----------------------------------------------------------------------------------

TEST(Friction, SticksUpToTheConeThenSlips) {
  Touching touch = {box(0.2F)};
  constexpr double kDepth = 5e-5;
  const double normal = static_cast<double>(touch.step(tip_at(0, 0, kTopM - kDepth)).force_n.z);
  const double limit = kFriction * normal, give = limit / kStiffness;
  for (double x = 0; x < 3 * give; x += give / 40) {
    const ObstacleLoad load = touch.step(tip_at(x, 0, kTopM - kDepth));
    ASSERT_NEAR(static_cast<double>(load.force_n.x), -std::min(kStiffness * x, limit),
                1e-3 * limit);
    if (std::fabs(x - give) > give / 20) {
      ASSERT_EQ(load.slips, x > give ? 1U : 0U);
      ASSERT_EQ(load.stiffness_n_per_m.m[0][0] > 0, x < give);
    }
  }
}

TEST(Friction, LoopAreaIsThatOfTheReturnMap) {
  Touching touch = {box(0.2F)};
  constexpr double kDepth = 5e-5, kAmplitude = 2e-4, kPi = 3.14159265358979323846;
  ObstacleLoad last = touch.step(tip_at(0, 0, kTopM - kDepth));
  const double limit = kFriction * static_cast<double>(last.force_n.z), give = limit / kStiffness;
  double work = 0, dissipated = 0, x_last = 0;
  constexpr int kSteps = 20000;
  for (int i = 1; i <= 3 * kSteps; ++i) {
    const double x = kAmplitude * std::sin(2 * kPi * i / kSteps);
    const ObstacleLoad load = touch.step(tip_at(x, 0, kTopM - kDepth));
    if (i > 2 * kSteps) {
      work -= 0.5 * static_cast<double>(load.force_n.x + last.force_n.x) * (x - x_last);
      dissipated += static_cast<double>(load.dissipated_j);
    }
    last = load;
    x_last = x;
  }
  const double area = 4 * limit * (kAmplitude - give);
  EXPECT_NEAR(work, area, 2e-3 * area);
  EXPECT_NEAR(dissipated, area, 2e-3 * area);
}

TEST(Friction, DoesNotDriftBelowTheLimit) {
  Touching touch = {box(0.2F)};
  const auto at = [](int i) { return tip_at((i & 1) != 0 ? 2e-6 : 0, 0, kTopM - 5e-5); };
  const Vec3 first = touch.step(at(0)).force_n;
  ObstacleLoad load = {};
  for (int i = 1; i <= 100000; ++i) load = touch.step(at(i));
  EXPECT_LT(length_of(load.force_n - first), 1e-3);
}

// ---- energy -------------------------------------------------------------------------------------

// A smooth path of a piece through first touch, slip, edges and deep penetration, which ends where
// it began.
struct Walk {
  Vec3d middle, middle_swing[3], along, along_swing[3];

  NeedlePiece at(double t, double radius_out) const {
    const double phase = 2 * 3.14159265358979323846 * t;
    Vec3d m = middle, a = along;
    for (int i = 0; i < 3; ++i) {
      m = m + std::sin(phase * (i + 1)) * middle_swing[i];
      a = a + std::sin(phase * (i + 1)) * along_swing[i];
    }
    // Comes in from far away, and goes out again.
    m = (1 + radius_out * std::pow(std::cos(phase / 2), 8)) * m;
    return {to_float(m - a), to_float(m + a), kNeedleRadiusM};
  }
};

Walk draw_walk(PlaceDraw& draw, double deep) {
  Walk walk = {};
  const auto vector = [&](double size) { return to_double(draw.vector(size)); };
  walk.middle = vector(1);
  walk.middle = ((7.5e-3 - deep) / norm(walk.middle)) * walk.middle;
  walk.along = vector(2e-3);
  for (int i = 0; i < 3; ++i) {
    walk.middle_swing[i] = vector(1e-3);
    walk.along_swing[i] = vector(1e-3);
  }
  return walk;
}

struct Books {
  double work = 0, dissipated = 0, through = 0, elastic_at_end = 0, least_balance = 0;
};

// Work of the hand against the contact, by the trapezoidal rule at the point of contact.
Books keep_books(const Obstacle& body, const Walk& walk, int steps) {
  Touching touch = {body};
  NeedlePiece last_piece = walk.at(0, 2);
  ObstacleLoad last = touch.step(last_piece);
  Books books;
  for (int i = 1; i <= steps; ++i) {
    const NeedlePiece piece = walk.at(static_cast<double>(i) / steps, 2);
    const ObstacleLoad load = touch.step(piece);
    const Segment moved = {to_double(piece.a_m) - to_double(last_piece.a_m),
                           to_double(piece.b_m) - to_double(last_piece.b_m)};
    const auto work_of = [&moved](const ObstacleLoad& at) {
      return -dot(to_double(at.force_n), point_on(moved, static_cast<double>(at.place)));
    };
    const double step_work = 0.5 * (work_of(last) + work_of(load));
    books.work += step_work;
    books.through += std::fabs(step_work);
    books.dissipated += static_cast<double>(load.dissipated_j);
    books.least_balance = std::min(books.least_balance, books.work);
    last = load;
    last_piece = piece;
  }
  books.elastic_at_end = static_cast<double>(last.elastic_j);
  return books;
}

void expect_books_close(const char* name, float friction, double deep, double tolerance) {
  PlaceDraw draw;
  double worst = 0, least = 1, through = 0, dissipated = 0;
  for (int i = 0; i < 100; ++i) {
    const Books books = keep_books(box(friction), draw_walk(draw, deep), 20000);
    EXPECT_EQ(books.elastic_at_end, 0);
    if (!(books.through > 1e-5)) continue;
    worst = std::max(worst, std::fabs(books.work - books.dissipated) / books.through);
    least = std::min(least, books.work / books.through);
    through += books.through;
    dissipated += books.dissipated;
  }
  std::printf("%-24s error of the books %.2e, least return %.2e, dissipated %.1f %%\n", name, worst,
              least, 100 * dissipated / through);
  EXPECT_GT(through, 1e-3);
  EXPECT_LT(worst, tolerance);
  EXPECT_GT(least, -1e-3);
}

TEST(Energy, BooksCloseAndNothingIsGained) {
  expect_books_close("touch, no friction", 0, 0.5e-3, 2e-3);
  expect_books_close("touch, friction 0.2", 0.2F, 0.5e-3, 2e-3);
  expect_books_close("deep, friction 0.2", 0.2F, 2e-3, 2e-3);
}

// ---- the first touch ----------------------------------------------------------------------------

// A hand may take a piece from outside to well inside a body in one tick. Back along its way it is
// out again, so the body cannot lie deeper over it than it has come.
TEST(FirstTouch, IsNoDeeperThanThePieceHasCome) {
  PlaceDraw draw;
  int inside = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 size = {draw.uniform_f(1e-3, 8e-3), draw.uniform_f(1e-3, 8e-3),
                       draw.uniform_f(1e-3, 8e-3)};
    ObstacleConfig config =
        i % 2 == 0 ? bone_box(size) : bone_hull_of_sphere(16, static_cast<double>(size.x));
    config.pose = {draw.vector(0.01), draw.rotation()};
    Touching touch = {prepared(config)};
    const Vec3 a = config.pose.position_m + draw.vector(0.02);
    const Vec3 b = a + draw.vector(0.1);
    if (touch.step({a, b, kNeedleRadiusM}).depth_m > 0) continue;
    const Vec3 way_a = draw.vector(3e-3), way_b = draw.vector(3e-3);
    const ObstacleLoad load = touch.step({a + way_a, b + way_b, kNeedleRadiusM});
    if (!(load.depth_m > 2 * kNeedleRadiusM)) continue;
    ++inside;
    ASSERT_LE(static_cast<double>(load.depth_m),
              std::max(length_of(way_a), length_of(way_b)) + 1e-7)
        << i;
  }
  EXPECT_GT(inside, 500);
}

// ---- abuse --------------------------------------------------------------------------------------

void expect_bounded(const Obstacle& body, const ObstacleLoad& load, const ObstacleContact& state) {
  ASSERT_TRUE(all_finite(load));
  ASSERT_TRUE(is_finite(state.normal) && is_finite(state.bristle_m) && is_finite(state.place));
  const double friction = static_cast<double>(body.config.friction);
  ASSERT_LE(length_of(load.force_n), static_cast<double>(body.config.largest_force_n) *
                                         std::sqrt(1 + friction * friction) * (1 + 1e-6));
  ASSERT_TRUE(load.place >= 0 && load.place <= 1);
}

TEST(Abuse, AnyJumpGivesAFiniteBoundedForceAndAValidStiffnessBound) {
  PlaceDraw draw;
  for (int body = 0; body < 400; ++body) {
    ObstacleConfig config = bone();
    config.pose = {draw.vector(0.01), draw.rotation()};
    config.vertex_count = static_cast<std::uint32_t>(1 + draw.bits() % kMaxHullVertices);
    const double size = std::pow(10, draw.between(-9, -1));
    const Vec3 flat = {1, draw.bits() % 3 == 0 ? 0.0F : 1.0F, draw.bits() % 2 == 0 ? 0.0F : 1.0F};
    for (std::uint32_t v = 0; v < config.vertex_count; ++v) {
      const Vec3 p = draw.vector(size);
      config.vertices_m[v] = {p.x * flat.x, p.y * flat.y, p.z * flat.z};
    }
    if (draw.bits() % 4 == 0) config.rounding_m = draw.uniform_f(0, 0.01);
    Touching touch = {prepared(config)};
    for (int i = 0; i < 200; ++i) {
      const double reach_m = i % 7 == 0 ? 1 : 0.012;
      const Vec3 a = draw.vector(reach_m), b = i % 3 == 0 ? a : draw.vector(reach_m);
      const ObstacleLoad load = touch.step({a, b, kNeedleRadiusM});
      expect_bounded(touch.body, load, touch.state);
      const Vec3 x = i % 2 == 0 ? draw.vector(1) : load.normal;
      ASSERT_GE(dot(x, load.stiffness_n_per_m * x), 0);
    }
  }
}

TEST(Abuse, AppearsInsideAndIsPushedOut) {
  PlaceDraw draw;
  for (int i = 0; i < 2000; ++i) {
    Touching touch = {prepared(i % 2 == 0 ? bone_box(kHalf) : bone_hull_of_sphere(64, 6e-3))};
    Vec3 at = draw.vector(2e-3);
    const Vec3 half = draw.vector(1e-3);
    ObstacleLoad load = touch.step({at - half, at + half, kNeedleRadiusM});
    // The middle lies at least 2 mm inside both bodies.
    ASSERT_GT(length_of(load.force_n), kStiffness * 2e-3 / std::sqrt(1 + 2.0 * 2.0));
    int steps = 0;
    for (; load.depth_m > 1e-6F && steps < 3000; ++steps) {
      at = at + 1e-6F * load.force_n;
      load = touch.step({at - half, at + half, kNeedleRadiusM});
    }
    ASSERT_LT(steps, 3000);
  }
}

TEST(Abuse, BreaksThroughAThinPlateAndStaysFinite) {
  ObstacleConfig plate = bone_box({20e-3F, 20e-3F, 0.2e-3F});
  Touching touch = {prepared(plate)};
  ObstacleLoad load = {};
  for (double z = 2e-3; z > -3e-3; z -= 2e-5) {
    load = touch.step(tip_at(1e-3, 1e-3, z));
    expect_bounded(touch.body, load, touch.state);
  }
  EXPECT_EQ(load.depth_m, 0);
}

TEST(Abuse, NotANumberIsNoContact) {
  Touching touch = {box(0.2F)};
  (void)touch.step(tip_at(0, 0, kTopM - 1e-4));
  NeedlePiece piece = tip_at(0, 0, kTopM - 1e-4);
  piece.b_m.y = std::numeric_limits<float>::quiet_NaN();
  const ObstacleLoad load = touch.step(piece);
  EXPECT_TRUE(all_finite(load));
  EXPECT_EQ(load.depth_m, 0);
  EXPECT_GT(touch.step(tip_at(0, 0, kTopM - 1e-4)).depth_m, 0);
}

// ---- the same bits ------------------------------------------------------------------------------

TEST(Bits, AreTheSameFromEveryCompiler) {
  PlaceDraw draw;
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&hash](float value) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211ULL;
  };
  Touching touch = {prepared(bone_box(kHalf))};
  Vec3 at = {0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    at = i % 50 == 0 ? draw.vector(7e-3) : at + draw.vector(5e-5);
    const Vec3 half = draw.vector(2e-3);
    const ObstacleLoad load = touch.step({at - half, at + half, kNeedleRadiusM});
    for (const float v : {load.force_n.x, load.force_n.y, load.force_n.z, load.place, load.depth_m,
                          load.elastic_j, load.dissipated_j}) {
      mix(v);
    }
  }
#if defined(__x86_64__)
  EXPECT_EQ(hash, 0x6f7500bdb34e1c16U);
#else
  GTEST_SKIP() << "libccd for this processor may fuse products; hash " << hash;
#endif
}

}  // namespace
}  // namespace stylet::test
