// SPDX-License-Identifier: Apache-2.0
// Where a needle piece touches a body: closed forms, brute force, degenerate bodies, budgets.
#include <ccd/ccd.h>

#include "obstacle_rig.h"

namespace stylet::test {
namespace {

constexpr Vec3 kHalf = {5e-3F, 8e-3F, 12e-3F};
constexpr int kPoses = 20000;
// The result is a float; everything before it is in double precision.
constexpr double kPositionM = 2e-9;

struct Posed {
  Obstacle obstacle;
  Segment axis;  // in the body's frame
  NeedlePiece piece;
};

// A piece near the surface of the box with half sizes `kHalf`; the box lies anywhere within 0.1 m.
Posed draw_pose(PlaceDraw& draw, const ObstacleConfig& shape, double length_m) {
  ObstacleConfig config = shape;
  config.pose = {draw.vector(0.1), draw.rotation()};
  const Obstacle obstacle = prepared(config);
  const Vec3 middle = {draw.uniform_f(-0.008, 0.008), draw.uniform_f(-0.011, 0.011),
                       draw.uniform_f(-0.018, 0.018)};
  const Vec3 along = draw.vector(1);
  const Vec3 half = (static_cast<float>(length_m) / 2 / norm(along)) * along;
  const auto to_world = [&](Vec3 v) { return obstacle.rotation * v + config.pose.position_m; };
  const NeedlePiece piece = {to_world(middle - half), to_world(middle + half), kNeedleRadiusM};
  return {obstacle, {to_body(obstacle, piece.a_m), to_body(obstacle, piece.b_m)}, piece};
}

// ---- box ----------------------------------------------------------------------------------------

TEST(Gap, OfASphereAndABoxIsTheClosedFormAtFacesEdgesAndCorners) {
  PlaceDraw draw;
  const Vec3d half = to_double(kHalf);
  std::array<int, 4> regions = {};
  double worst = 0, worst_turn = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Posed p = draw_pose(draw, bone_box(kHalf), 0);
    const Vec3d at = p.axis.a_m;
    const double expected = box_distance(half, at);
    if (expected < 1e-6) continue;
    const Gap gap = gap_of(p.obstacle, p.piece);
    worst = std::max(worst, std::fabs(static_cast<double>(gap.separation_m) -
                                      (expected - static_cast<double>(kNeedleRadiusM))));
    const Vec3d nearest = {std::clamp(at.x, -half.x, half.x), std::clamp(at.y, -half.y, half.y),
                           std::clamp(at.z, -half.z, half.z)};
    const Vec3d normal = to_double(transposed_times(p.obstacle.rotation, gap.normal));
    if (expected > 1e-4) {
      worst_turn = std::max(worst_turn, angle_between(normal, at - nearest));
    }
    const auto clamped = [](double a, double b) { return std::fabs(a) > b ? 1U : 0U; };
    ++regions[clamped(at.x, half.x) + clamped(at.y, half.y) + clamped(at.z, half.z)];
  }
  EXPECT_LT(worst, kPositionM);
  EXPECT_LT(worst_turn, 1e-6);
  for (const std::size_t axes : {1U, 2U, 3U}) EXPECT_GT(regions[axes], 500);
  std::printf("sphere and box: worst distance %.1f nm, worst normal %.1e rad\n", worst * 1e9,
              worst_turn);
}

TEST(Gap, OfACapsuleAndABoxIsTheLeastOverTheAxis) {
  PlaceDraw draw;
  double worst = 0, worst_place = 0;
  int outside = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Posed p = draw_pose(draw, bone_box(kHalf), draw.between(1e-3, 20e-3));
    const Vec3d half = to_double(kHalf);
    const double expected = box_distance(half, p.axis);
    if (expected < 1e-6) continue;
    ++outside;
    const Gap gap = gap_of(p.obstacle, p.piece);
    const double at_place = box_distance(half, point_on(p.axis, static_cast<double>(gap.place)));
    worst = std::max(worst,
                     std::fabs(static_cast<double>(gap.separation_m + kNeedleRadiusM) - expected));
    worst_place = std::max(worst_place, at_place - expected);
  }
  EXPECT_GT(outside, kPoses / 4);
  EXPECT_LT(worst, kPositionM);
  EXPECT_LT(worst_place, kPositionM);
  std::printf("capsule and box: worst distance %.1f nm over %d poses\n", worst * 1e9, outside);
}

TEST(Gap, InsideABoxIsADepthAlongWhichThePieceCanLeave) {
  PlaceDraw draw;
  int inside = 0, least = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Posed p = draw_pose(draw, bone_box(kHalf), 2e-3);
    const Vec3d half = to_double(kHalf);
    if (box_distance(half, p.axis) > -1e-6) continue;
    ++inside;
    const Gap gap = gap_of(p.obstacle, p.piece);
    ASSERT_LT(gap.separation_m, -kNeedleRadiusM);
    const Vec3 out = -(gap.separation_m - 1e-6F) * gap.normal;
    const NeedlePiece moved = {p.piece.a_m + out, p.piece.b_m + out, kNeedleRadiusM};
    const Segment left = {to_body(p.obstacle, moved.a_m), to_body(p.obstacle, moved.b_m)};
    ASSERT_GT(box_distance(half, left), static_cast<double>(kNeedleRadiusM) - 1e-7);
    const double depth =
        std::max({-box_distance(half, p.axis.a_m), -box_distance(half, p.axis.b_m)});
    least += -static_cast<double>(gap.separation_m + kNeedleRadiusM) < depth + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
  std::printf("inside: %d poses, least depth of the faces in %d\n", inside, least);
}

// ---- spheres and hulls --------------------------------------------------------------------------

TEST(Gap, OfASphereIsTheClosedForm) {
  PlaceDraw draw;
  constexpr float kRadius = 7e-3F;
  ObstacleConfig ball = bone();
  make_sphere(ball, kRadius);
  double worst = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Posed p = draw_pose(draw, ball, draw.between(0, 20e-3));
    const Vec3d along = p.axis.b_m - p.axis.a_m;
    const double length2 = dot(along, along);
    const double t = length2 > 0 ? std::clamp(-dot(p.axis.a_m, along) / length2, 0.0, 1.0) : 0;
    const Vec3d nearest = point_on(p.axis, t);
    const Gap gap = gap_of(p.obstacle, p.piece);
    const double expected =
        norm(nearest) - static_cast<double>(kRadius) - static_cast<double>(kNeedleRadiusM);
    worst = std::max(worst, std::fabs(static_cast<double>(gap.separation_m) - expected));
    ASSERT_LT(angle_between(to_double(transposed_times(p.obstacle.rotation, gap.normal)), nearest),
              1e-6);
  }
  EXPECT_LT(worst, kPositionM);
}

TEST(Gap, PointsInsideAndOnAHullDoNotMatter) {
  PlaceDraw draw;
  ObstacleConfig filled = bone_box(kHalf);
  while (filled.vertex_count < kMaxHullVertices) {
    Vec3 v = {draw.uniform_f(-1, 1) * kHalf.x, draw.uniform_f(-1, 1) * kHalf.y,
              draw.uniform_f(-1, 1) * kHalf.z};
    if (filled.vertex_count % 2 == 0) v.z = kHalf.z;
    filled.vertices_m[filled.vertex_count++] = v;
  }
  double worst = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Posed p = draw_pose(draw, filled, draw.between(0, 20e-3));
    const double expected = box_distance(to_double(kHalf), p.axis);
    if (expected < 1e-6) continue;
    const Gap gap = gap_of(p.obstacle, p.piece);
    worst = std::max(worst,
                     std::fabs(static_cast<double>(gap.separation_m + kNeedleRadiusM) - expected));
  }
  EXPECT_LT(worst, kPositionM);
}

TEST(Gap, OfAHullOfASphereIsNearTheSphere) {
  PlaceDraw draw;
  constexpr double kRadius = 10e-3;
  const Obstacle hull = prepared(bone_hull_of_sphere(kMaxHullVertices, kRadius));
  // Every direction has a vertex within this angle: the hull lies between the sphere and the sphere
  // scaled by the angle's cosine.
  double widest = 0;
  for (int i = 0; i < kPoses; ++i) {
    const Vec3d direction = to_double(draw.vector(1));
    double nearest = 10;
    for (std::uint32_t v = 0; v < kMaxHullVertices; ++v) {
      nearest = std::min(nearest, angle_between(direction, to_double(hull.config.vertices_m[v])));
    }
    widest = std::max(widest, nearest);
  }
  const double between_draws = 2 * std::sqrt(3.14159265358979323846 / kPoses);
  const double sagitta = kRadius * (1 - std::cos(widest + between_draws));
  EXPECT_LT(sagitta, 0.07 * kRadius);
  for (int i = 0; i < kPoses; ++i) {
    const Vec3 at = draw.vector(20e-3);
    const double from_sphere = norm(to_double(at)) - kRadius;
    const double from_hull =
        static_cast<double>(gap_of(hull, {at, at, kNeedleRadiusM}).separation_m) +
        static_cast<double>(kNeedleRadiusM);
    if (from_sphere < 1e-6) continue;
    ASSERT_GT(from_hull, from_sphere - kPositionM);
    ASSERT_LT(from_hull, from_sphere + sagitta);
  }
}

// ---- degenerate bodies --------------------------------------------------------------------------

TEST(Gap, FlatCollinearAndPointHullsAreBodiesToo) {
  ObstacleConfig plate = bone(), rod = bone(), point = bone();
  plate.vertex_count = 4;
  for (std::uint32_t i = 0; i < 4; ++i) {
    plate.vertices_m[i] = {(i & 1U) != 0 ? 0.01F : -0.01F, (i & 2U) != 0 ? 0.01F : -0.01F, 0};
  }
  rod.vertex_count = 5;
  for (std::uint32_t i = 0; i < 5; ++i) {
    rod.vertices_m[i] = {-0.01F + 0.005F * static_cast<float>(i), 0, 0};
  }
  point.vertex_count = kMaxHullVertices;  // all the same
  const Vec3d half[] = {{0.01, 0.01, 0}, {0.01, 0, 0}, {0, 0, 0}};
  const ObstacleConfig bodies[] = {plate, rod, point};
  for (std::size_t body = 0; body < 3; ++body) {
    PlaceDraw draw;
    for (int i = 0; i < kPoses; ++i) {
      const Posed p = draw_pose(draw, bodies[body], i % 4 == 0 ? 0 : 5e-3);
      const double expected = box_distance(half[body], p.axis);
      if (expected < 1e-6) continue;
      const Gap gap = gap_of(p.obstacle, p.piece);
      ASSERT_NEAR(static_cast<double>(gap.separation_m + kNeedleRadiusM), expected, kPositionM);
      ASSERT_NEAR(static_cast<double>(norm(gap.normal)), 1, 1e-5);
    }
  }
}

TEST(Gap, AxesThroughOrInTouchWithDegenerateBodiesHaveANormal) {
  std::vector<ObstacleConfig> bodies;
  for (std::uint32_t count : {1U, 2U, 3U, 4U, 64U}) {
    ObstacleConfig body = bone();
    body.vertex_count = count;
    for (std::uint32_t i = 0; i < count; ++i) {
      body.vertices_m[i] = {1e-3F * static_cast<float>(i % 3), 1e-3F * static_cast<float>(i / 3),
                            0};
    }
    bodies.push_back(body);
  }
  bodies.push_back(bone_box({1e-3F, 1e-3F, 1e-3F}));
  bodies.push_back(bone_box({1e-9F, 1e-2F, 1e-2F}));
  for (const ObstacleConfig& config : bodies) {
    const Obstacle body = prepared(config);
    for (std::uint32_t i = 0; i < config.vertex_count; ++i) {
      for (const Vec3 half : {Vec3{0, 0, 0}, Vec3{0, 0, 5e-3F}, Vec3{5e-3F, 0, 0},
                              Vec3{1e-3F, 2e-3F, 0}, Vec3{1e-20F, 0, 0}}) {
        const Vec3 at = config.vertices_m[i];
        const Gap gap = gap_of(body, {at - half, at + half, kNeedleRadiusM});
        ASSERT_NEAR(static_cast<double>(norm(gap.normal)), 1, 1e-5);
        ASSERT_TRUE(is_finite(gap.separation_m));
        ASSERT_LE(gap.separation_m, 0);
        ASSERT_TRUE(gap.place >= 0 && gap.place <= 1);
      }
    }
  }
}

// ---- budgets ------------------------------------------------------------------------------------

TEST(WayOut, HoldsItsBudgetAndAlwaysAnswers) {
  PlaceDraw draw;
  int square = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto vertices = static_cast<std::uint32_t>(1 + draw.bits() % kMaxHullVertices);
    ObstacleConfig config = bone();
    config.vertex_count = vertices;
    for (std::uint32_t v = 0; v < vertices; ++v) config.vertices_m[v] = draw.vector(1e-2);
    const Obstacle body = prepared(config);
    const ConvexHull hull = {{body.config.vertices_m, vertices}, to_double(body.centre_m)};
    const Segment axis = {to_double(draw.vector(5e-3)), to_double(draw.vector(5e-3))};
    const auto budget = static_cast<std::uint32_t>(draw.bits() % (kMaxEscapeSupports + 1));
    const Vec3d out = way_out(hull, axis, budget);
    ASSERT_NEAR(norm(out), 1, 1e-9);
    square += std::fabs(dot(out, axis.b_m - axis.a_m)) < 1e-12 ? 1 : 0;
  }
  EXPECT_GT(square, 100);     // some ran out of budget, or did not overlap
  EXPECT_LT(square, 190000);  // and some did not
}

TEST(Closest, NeedsFewerStepsThanItsBound) {
  PlaceDraw draw;
  const Obstacle ball = prepared(bone_hull_of_sphere(kMaxHullVertices, 10e-3));
  const ConvexHull hull = {{ball.config.vertices_m, kMaxHullVertices}, to_double(ball.centre_m)};
  for (int i = 0; i < 100000; ++i) {
    const Segment axis = {to_double(draw.vector(2e-2)), to_double(draw.vector(2e-2))};
    const Closest c = closest(hull, axis);
    if (!(c.distance_m > 0)) continue;
    // The nearest point has been found if no vertex lies farther along the normal.
    const double bound = dot(c.normal, point_on(axis, c.place)) - reach(hull, c.normal);
    const double ends =
        std::min(dot(c.normal, axis.a_m), dot(c.normal, axis.b_m)) - reach(hull, c.normal);
    ASSERT_NEAR(bound, c.distance_m, 1e-12);
    ASSERT_NEAR(ends, c.distance_m, 1e-9 * 1e-2 + 1e-9 * c.distance_m);
  }
}

// ---- why libccd does not measure contacts -------------------------------------------------------

struct Shape {
  const ConvexHull* hull;
  const Segment* axis;
  double radius;
};

void shape_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Shape& s = *static_cast<const Shape*>(object);
  const Vec3d d = {direction->v[0], direction->v[1], direction->v[2]};
  Vec3d best = {0, 0, 0};
  if (s.hull != nullptr) {
    double most = -1e9;
    for (const Vec3& v : s.hull->vertices_m) {
      if (dot(d, to_double(v)) > most) {
        most = dot(d, to_double(v));
        best = to_double(v);
      }
    }
  } else {
    best = (dot(d, s.axis->b_m - s.axis->a_m) > 0 ? s.axis->b_m : s.axis->a_m) +
           (s.radius / norm(d)) * d;
  }
  *point = {{best.x, best.y, best.z}};
}

void shape_centre(const void* object, ccd_vec3_t* centre) {
  const Shape& s = *static_cast<const Shape*>(object);
  const Vec3d c = s.hull != nullptr ? s.hull->centre_m : point_on(*s.axis, 0.5);
  *centre = {{c.x, c.y, c.z}};
}

// A needle tip lies 0.1 mm deep on a box's top and slides towards its edge. Portal refinement takes
// the face that the ray from the box's centre meets, so it answers with the box's side long before
// the tip is there. If this test fails, the library has become good enough to be used alone.
TEST(PortalRefinement, TakesTheWrongFaceNearAnEdge) {
  const Obstacle box = prepared(bone_box({5e-3F, 5e-3F, 5e-3F}));
  const ConvexHull hull = {{box.config.vertices_m, 8}, to_double(box.centre_m)};
  double largest = 0, turn = 0;
  Vec3d last = {0, 0, 1};
  const double radius = static_cast<double>(kNeedleRadiusM), depth = 1e-4;
  for (double x = 0; x < 5e-3; x += 5e-5) {
    const Vec3d at = {x, 1e-4, 5e-3 + radius - depth};
    const Segment axis = {at, at + Vec3d{0, 0, 2e-3}};
    const Shape body = {&hull, nullptr, 0}, needle = {nullptr, &axis, radius};
    ccd_t ccd = {};
    ccd.support1 = ccd.support2 = shape_support;
    ccd.center1 = ccd.center2 = shape_centre;
    ccd.max_iterations = 100;
    ccd.mpr_tolerance = 1e-9;
    ccd_real_t found = 0;
    ccd_vec3_t direction = {}, point = {};
    ASSERT_EQ(ccdMPRPenetration(&body, &needle, &ccd, &found, &direction, &point), 0) << x;
    largest = std::max(largest, found / depth);
    const Vec3d normal = {direction.v[0], direction.v[1], direction.v[2]};
    turn = std::max(turn, angle_between(last, normal));
    last = normal;
    const NeedlePiece piece = {to_float(axis.a_m), to_float(axis.b_m), kNeedleRadiusM};
    EXPECT_NEAR(static_cast<double>(gap_of(box, piece).separation_m), -depth, 1e-9);
  }
  EXPECT_GT(largest, 1.1);
  EXPECT_GT(turn, 0.1);
  std::printf("portal refinement alone: up to %.2f times the depth, turns by %.2f rad in 50 um\n",
              largest, turn);
}

}  // namespace
}  // namespace stylet::test
