// SPDX-License-Identifier: Apache-2.0
#include "needle/obstacle.h"

#include <limits>

#include "laws/touch.h"
#include "stylet/first_outside.h"

namespace stylet {
namespace {

// If the axis is nearer to the body than this part of the rounding, it is viewed from outside along
// the last normal: a distance of zero has no direction.
constexpr double kCoreFraction = 0.25;
// If a normal turns by more than 120 degrees, the needle has passed through the body.
constexpr double kThroughCosine = -0.5;
// Least normal stiffness at a saturated force, so that rounding cannot make it negative.
constexpr double kLeastStiffnessFraction = 1e-5;

constexpr float kLargestConfigM = 10;
constexpr float kRotationTolerance = 1e-3F;

bool is_zero(Vec3 v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

// ---- the body's frame ---------------------------------------------------------------------------

Vec3d row(const Mat3& m, int i) {
  return to_double({m.m[i][0], m.m[i][1], m.m[i][2]});
}
Vec3d to_world(const Mat3& rotation, Vec3d v) {
  return {dot(row(rotation, 0), v), dot(row(rotation, 1), v), dot(row(rotation, 2), v)};
}
Vec3d to_body(const Mat3& rotation, Vec3d v) {
  return v.x * row(rotation, 0) + v.y * row(rotation, 1) + v.z * row(rotation, 2);
}

Vec3d in_body(const Obstacle& obstacle, Vec3d world_m) {
  return to_body(obstacle.rotation, world_m - to_double(obstacle.config.pose.position_m));
}
Segment in_body(const Obstacle& obstacle, const Segment& world_m) {
  return {in_body(obstacle, world_m.a_m), in_body(obstacle, world_m.b_m)};
}
Segment axis_of(const NeedlePiece& piece) {
  return {to_double(piece.a_m), to_double(piece.b_m)};
}

ConvexHull hull_of(const Obstacle& obstacle) {
  return {{obstacle.config.vertices_m, obstacle.config.vertex_count}, to_double(obstacle.centre_m)};
}

double rounding_of(const Obstacle& obstacle, double radius_m) {
  return static_cast<double>(obstacle.config.rounding_m) + radius_m;
}

// ---- where --------------------------------------------------------------------------------------

// The closest points with the axis moved to at least `margin` outside the body along `out`: they
// tell which side of the body is near a needle that is pressed into it.
Closest view_along(const ConvexHull& hull, const Segment& axis, Vec3d out, double margin) {
  const double depth = reach(hull, out) - min_of(dot(out, axis.a_m), dot(out, axis.b_m));
  const Vec3d shift = max_of(depth + margin, 0) * out;
  return closest(hull, {axis.a_m + shift, axis.b_m + shift});
}

// A piece that has come in since the last call leaves where it came in: no point of it is deeper
// along that direction than it has moved.
Vec3d first_way_out(const Obstacle& obstacle, const Segment& axis, const Segment& before_m) {
  const ConvexHull hull = hull_of(obstacle);
  const Vec3d back = closest(hull, in_body(obstacle, before_m)).normal;
  return dot(back, back) > 0 ? back : way_out(hull, axis);
}

Closest view(const Obstacle& obstacle, const Segment& axis, double margin, Vec3d last_normal,
             const Segment& before_m) {
  const ConvexHull hull = hull_of(obstacle);
  const bool remembers = dot(last_normal, last_normal) > 0;
  const Closest near = closest(hull, axis);
  if (near.distance_m >= margin || (!remembers && near.distance_m > 0)) return near;
  const Vec3d out = remembers ? last_normal : first_way_out(obstacle, axis, before_m);
  return view_along(hull, axis, out, margin);
}

double depth_along(const ConvexHull& hull, Vec3d normal, Vec3d point, double rounding) {
  return rounding + reach(hull, normal) - dot(normal, point);
}

// Turns towards `target`, by at most `most_rad` (to third order).
Vec3d turn(Vec3d from, Vec3d target, double most_rad) {
  const double along = dot(from, target);
  const Vec3d across = target - along * from;
  const double sine = norm(across);
  if (along < kThroughCosine || (along > 0 && sine <= most_rad * along)) return target;
  const Vec3d turned = from + (most_rad / sine) * across;
  return (1 / norm(turned)) * turned;
}

// True: no point of the axis can be within the rounding of the body.
bool is_far(const Obstacle& obstacle, const Segment& axis, double rounding) {
  const Vec3d centre = to_double(obstacle.centre_m);
  const Vec3d along = axis.b_m - axis.a_m, gap = centre - axis.a_m;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? max_of(0, min_of(1, dot(gap, along) / length2)) : 0;
  const double limit = static_cast<double>(obstacle.bound_m) + rounding;
  const Vec3d left = gap - t * along;
  return dot(left, left) > limit * limit;
}

// ---- what it does -------------------------------------------------------------------------------

Press press_of(const ObstacleConfig& config, double depth_m) {
  return press(static_cast<double>(config.stiffness_n_per_m),
               static_cast<double>(config.largest_force_n), depth_m);
}

Mat3 stiffness_matrix(Vec3 n, float normal, float across) {
  const float d = normal - across;
  return {{{across + d * n.x * n.x, d * n.x * n.y, d * n.x * n.z},
           {d * n.x * n.y, across + d * n.y * n.y, d * n.y * n.z},
           {d * n.x * n.z, d * n.y * n.z, across + d * n.z * n.z}}};
}

}  // namespace

void make_box(ObstacleConfig& config, Vec3 half_m) {
  config.vertex_count = 8;
  config.rounding_m = 0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    config.vertices_m[i] = {(i & 1U) != 0 ? half_m.x : -half_m.x,
                            (i & 2U) != 0 ? half_m.y : -half_m.y,
                            (i & 4U) != 0 ? half_m.z : -half_m.z};
  }
}

void make_sphere(ObstacleConfig& config, float radius_m) {
  config.vertex_count = 1;
  config.vertices_m[0] = {0, 0, 0};
  config.rounding_m = radius_m;
}

Status check_obstacle(const ObstacleConfig& c, std::uint32_t index, ConfigRefusal* refusal_out) {
  constexpr double kLeast = static_cast<double>(std::numeric_limits<float>::denorm_min());
  constexpr double kMost = static_cast<double>(std::numeric_limits<float>::max());
  const auto wide = [](float value) { return static_cast<double>(value); };
  FirstOutside first(index);
  first.check("obstacle.vertex_count", c.vertex_count, 1, kMaxHullVertices);
  for (std::uint32_t i = 0; first.good() && i < c.vertex_count; ++i) {
    first.check("obstacle.vertices_m", wide(norm(c.vertices_m[i])), 0, wide(kLargestConfigM), i);
  }
  first.check("obstacle.pose.position_m", wide(norm(c.pose.position_m)), 0, wide(kLargestConfigM));
  const Quat q = c.pose.rotation;
  const float length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  first.check("obstacle.pose.rotation", wide(length2), 1 - wide(kRotationTolerance),
              1 + wide(kRotationTolerance));
  first.check("obstacle.rounding_m", wide(c.rounding_m), 0, wide(kLargestConfigM));
  first.check("obstacle.stiffness_n_per_m", wide(c.stiffness_n_per_m), kLeast,
              kMaxRodStiffnessNPerM);
  first.check("obstacle.largest_force_n", wide(c.largest_force_n), kLeast, kMost);
  first.check("obstacle.friction", wide(c.friction), 0, kMost);
  return first.status(refusal_out);
}

Status obstacle_prepare(const ObstacleConfig& config, Obstacle& obstacle_out) {
  const Status status = check_obstacle(config, 0, nullptr);
  if (status != Status::kOk) return status;
  obstacle_out = {};
  obstacle_out.config = config;
  Quat& q = obstacle_out.config.pose.rotation;
  const float length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / length, q.x / length, q.y / length, q.z / length};
  obstacle_out.rotation = rotation_matrix(q);
  Vec3d sum = {0, 0, 0};
  for (std::uint32_t i = 0; i < config.vertex_count; ++i) {
    sum = sum + to_double(config.vertices_m[i]);
  }
  obstacle_out.centre_m = to_float((1.0 / config.vertex_count) * sum);
  float farthest = 0;
  for (std::uint32_t i = 0; i < config.vertex_count; ++i) {
    farthest = max_of(farthest, norm(config.vertices_m[i] - obstacle_out.centre_m));
  }
  constexpr float kRoundUp = 1.0001F;
  obstacle_out.bound_m = farthest * kRoundUp;
  return Status::kOk;
}

Mat3 obstacle_stiffness(const Obstacle& obstacle, Vec3 normal, double depth_m, bool slips) {
  const float k = obstacle.config.stiffness_n_per_m;
  const double least = kLeastStiffnessFraction * static_cast<double>(k);
  const double along = max_of(press_of(obstacle.config, depth_m).stiffness_n_per_m, least);
  return stiffness_matrix(normal, static_cast<float>(along), slips ? 0 : k);
}

bool find_face(const Obstacle& obstacle, const Segment& axis_m, double radius_m,
               const ObstacleContact& last, Vec3d now_m, const CameFrom& from,
               const FaceLimits& limits, ObstacleFace& out) {
  const double rounding = rounding_of(obstacle, radius_m);
  const Segment axis = in_body(obstacle, axis_m);
  if (is_far(obstacle, axis, rounding + limits.reach_m)) return false;
  const ConvexHull hull = hull_of(obstacle);
  const bool known = !is_zero(last.normal);
  const Vec3d before = to_body(obstacle.rotation, known ? to_double(last.normal) : from.seen);
  const Closest closest = view(obstacle, axis, kCoreFraction * rounding, before, from.before_m);
  out = {};
  out.place = static_cast<float>(closest.place);
  Vec3d normal = closest.normal;
  if (known) {
    out.goes_on = dot(before, normal) >= kThroughCosine;
    out.depth_last_m = depth_along(hull, before, in_body(obstacle, now_m), rounding);
    normal = turn(before, normal, limits.turn_rad);
  }
  const double place = static_cast<double>(out.place);
  out.depth_m = depth_along(hull, normal, point_on(axis, place), rounding);
  out.normal = to_world(obstacle.rotation, normal);
  out.at_m = point_on(axis_m, place);
  if (out.goes_on) {
    out.bristle_m = across(out.normal, to_double(last.bristle_m) + (now_m - last.at_m));
  }
  return out.depth_m > -limits.reach_m;
}

double face_loss(const Obstacle& obstacle, const ObstacleFace& face, const ObstacleContact& last,
                 Vec3d moved_m, Vec3d bristle_m) {
  if (is_zero(last.normal)) return 0;
  const double k = static_cast<double>(obstacle.config.stiffness_n_per_m);
  const double depth_last = face.depth_last_m - dot(to_double(last.normal), moved_m);
  const double depth = face.depth_m - dot(face.normal, moved_m);
  const double turned =
      press_of(obstacle.config, depth_last).energy_j - press_of(obstacle.config, depth).energy_j;
  const Vec3d before = to_double(last.bristle_m),
              trial = face.bristle_m + across(face.normal, moved_m);
  const double lifted = dot(face.normal, before);  // lost as the plane of contact turns
  const double tension = k * norm(face.goes_on ? trial : before), left = k * norm(bristle_m);
  const double held = min_of(tension, max_of(left, k * norm(before)));
  return turned + 0.5 * k * lifted * lifted + 0.5 * (held + left) * (tension - left) / k;
}

ObstacleLoad obstacle_load(const Obstacle& obstacle, const NeedlePiece& piece,
                           const Segment& before_m, double turn_rad, const ObstacleContact& last,
                           ObstacleContact& next_out) {
  next_out = {};
  ObstacleLoad load = {};
  if (!is_finite(piece.a_m) || !is_finite(piece.b_m) || !is_finite(piece.radius_m)) return load;
  const Segment axis = axis_of(piece);
  const Vec3d now = point_on(axis, static_cast<double>(last.place));
  ObstacleFace face = {};
  (void)find_face(obstacle, axis, static_cast<double>(piece.radius_m), last, now,
                  {{0, 0, 0}, before_m}, {0, turn_rad}, face);
  const ObstacleConfig& config = obstacle.config;
  const double k = static_cast<double>(config.stiffness_n_per_m);
  const Press pressed = press_of(config, face.depth_m);
  const bool holds = face.goes_on || is_zero(last.normal);
  const double limit_n = holds ? static_cast<double>(config.friction) * pressed.force_n : 0;
  const Slip slid = slip(k, limit_n, face.bristle_m);
  load.dissipated_j =
      static_cast<float>(face_loss(obstacle, face, last, {0, 0, 0}, slid.bristle_m));
  if (!(face.depth_m > 0)) return load;
  load.normal = to_float(face.normal);
  load.place = face.place;
  load.depth_m = static_cast<float>(face.depth_m);
  next_out = {load.normal, to_float(slid.bristle_m), face.at_m, face.place,
              static_cast<float>(limit_n)};
  load.force_n = to_float(pressed.force_n * face.normal - k * slid.bristle_m);
  load.at_m = to_float(face.at_m);
  load.elastic_j =
      static_cast<float>(pressed.energy_j + 0.5 * k * dot(slid.bristle_m, slid.bristle_m));
  load.slips = slid.slips ? 1 : 0;
  load.stiffness_n_per_m = obstacle_stiffness(obstacle, load.normal, face.depth_m, slid.slips);
  return load;
}

}  // namespace stylet
