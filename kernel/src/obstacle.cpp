// SPDX-License-Identifier: Apache-2.0
#include "obstacle.h"

#include "convex.h"

namespace stylet {
namespace {

// An axis nearer to the body than this share of the rounding is looked at from where the last
// normal leads out: the direction of a distance needs a distance.
constexpr double kCoreShare = 0.25;
// A normal that turns by more than 120 degrees has not turned: the needle has passed through.
constexpr double kThroughCosine = -0.5;
// Normal stiffness left where the force is saturated, so that rounding cannot make it negative.
constexpr double kLeastStiffnessShare = 1e-5;

constexpr float kLargestConfigM = 10;
constexpr float kRotationTolerance = 1e-3F;

double max_of(double a, double b) {
  return a > b ? a : b;
}
double min_of(double a, double b) {
  return a < b ? a : b;
}

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

Segment axis_in_body(const Obstacle& obstacle, const NeedlePiece& piece) {
  const Vec3d origin = to_double(obstacle.config.pose.position_m);
  return {to_body(obstacle.rotation, to_double(piece.a_m) - origin),
          to_body(obstacle.rotation, to_double(piece.b_m) - origin)};
}

ConvexHull hull_of(const Obstacle& obstacle) {
  return {{obstacle.config.vertices_m, obstacle.config.vertex_count}, to_double(obstacle.centre_m)};
}

double rounding_of(const Obstacle& obstacle, const NeedlePiece& piece) {
  return static_cast<double>(obstacle.config.rounding_m) + static_cast<double>(piece.radius_m);
}

// ---- where --------------------------------------------------------------------------------------

// The closest points, seen with the axis moved to at least `margin` outside the body along `out`:
// which side of the body is near a needle that is pressed into it.
Closest view_along(const ConvexHull& hull, const Segment& axis, Vec3d out, double margin) {
  const double depth = reach(hull, out) - min_of(dot(out, axis.a_m), dot(out, axis.b_m));
  const Vec3d shift = max_of(depth + margin, 0) * out;
  return closest(hull, {axis.a_m + shift, axis.b_m + shift});
}

Closest view(const ConvexHull& hull, const Segment& axis, double margin, Vec3d last_normal) {
  const bool remembers = dot(last_normal, last_normal) > 0;
  const Closest near = closest(hull, axis);
  if (near.distance_m >= margin || (!remembers && near.distance_m > 0)) return near;
  return view_along(hull, axis, remembers ? last_normal : way_out(hull, axis), margin);
}

double depth_along(const ConvexHull& hull, Vec3d normal, Vec3d point, double rounding) {
  return rounding + reach(hull, normal) - dot(normal, point);
}

// Towards `target`, by at most kMaxNormalTurnRad (to third order).
Vec3d turn(Vec3d from, Vec3d target) {
  constexpr double kMost = static_cast<double>(kMaxNormalTurnRad);
  const double along = dot(from, target);
  const Vec3d across = target - along * from;
  const double sine = norm(across);
  if (along < kThroughCosine || (along > 0 && sine <= kMost * along)) return target;
  const Vec3d turned = from + (kMost / sine) * across;
  return (1 / norm(turned)) * turned;
}

// No point of the axis can be within the rounding of the body.
bool is_far(const Obstacle& obstacle, const Segment& axis, double rounding) {
  const Vec3d centre = to_double(obstacle.centre_m);
  const Vec3d along = axis.b_m - axis.a_m, gap = centre - axis.a_m;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? max_of(0, min_of(1, dot(gap, along) / length2)) : 0;
  const double limit = static_cast<double>(obstacle.bound_m) + rounding;
  const Vec3d left = gap - t * along;
  return dot(left, left) > limit * limit;
}

struct Touch {
  Vec3d normal;         // world
  double depth_m;       // along it
  double depth_last_m;  // along the last normal, at the last place
  double place;
  bool goes_on;  // the contact of the last call, not a new one
};

Touch find_touch(const Obstacle& obstacle, const NeedlePiece& piece, const ObstacleContact& last) {
  const double rounding = rounding_of(obstacle, piece);
  const Segment axis = axis_in_body(obstacle, piece);
  if (is_far(obstacle, axis, rounding)) return {};
  const ConvexHull hull = hull_of(obstacle);
  const Vec3d last_normal = to_body(obstacle.rotation, to_double(last.normal));
  const Closest seen = view(hull, axis, kCoreShare * rounding, last_normal);
  Touch touch = {};
  Vec3d normal = seen.normal;
  touch.place = seen.place;
  if (!is_zero(last.normal)) {
    const Vec3d last_point = point_on(axis, static_cast<double>(last.place));
    touch.goes_on = dot(last_normal, normal) >= kThroughCosine;
    touch.depth_last_m = depth_along(hull, last_normal, last_point, rounding);
    normal = turn(last_normal, normal);
  }
  touch.depth_m = depth_along(hull, normal, point_on(axis, touch.place), rounding);
  touch.normal = to_world(obstacle.rotation, normal);
  return touch;
}

// ---- what it does -------------------------------------------------------------------------------

// k depth at first, the largest force at last: F = k d / sqrt(1 + (k d / F_max)^2).
struct Press {
  double force_n, stiffness_n_per_m, energy_j;
};

Press press(const ObstacleConfig& config, double depth_m) {
  if (!(depth_m > 0)) return {};
  const double k = static_cast<double>(config.stiffness_n_per_m);
  const double u = k * depth_m / static_cast<double>(config.largest_force_n);
  const double root = std::sqrt(1 + u * u);
  return {k * depth_m / root, k / (root * root * root), k * depth_m * depth_m / (1 + root)};
}

struct Slip {
  Vec3d bristle_m;
  double dissipated_j;
  bool slips;
};

// Return map: the bristle follows the needle until its tension reaches the limit of friction.
Slip slip(double k, double limit_n, Vec3d normal, Vec3d last_bristle, Vec3d moved) {
  const double lifted = dot(normal, last_bristle);  // lost as the plane of contact turns
  const Vec3d trial = last_bristle + moved;
  const Vec3d bristle = trial - dot(normal, trial) * normal;
  const double tension = k * norm(bristle), turned = 0.5 * k * lifted * lifted;
  if (tension <= limit_n) return {bristle, turned, false};
  const double held = min_of(tension, max_of(limit_n, k * norm(last_bristle)));
  const double slipped = (tension - limit_n) / k;
  return {(limit_n / tension) * bristle, turned + 0.5 * (held + limit_n) * slipped, true};
}

Mat3 stiffness_matrix(Vec3 n, float normal, float across) {
  const float d = normal - across;
  return {{{across + d * n.x * n.x, d * n.x * n.y, d * n.x * n.z},
           {d * n.x * n.y, across + d * n.y * n.y, d * n.y * n.z},
           {d * n.x * n.z, d * n.y * n.z, across + d * n.z * n.z}}};
}

bool all_finite(const ObstacleConfig& c) {
  bool finite = is_finite(c.pose.position_m) && is_finite(c.rounding_m) &&
                is_finite(c.stiffness_n_per_m) && is_finite(c.largest_force_n) &&
                is_finite(c.friction);
  const Quat q = c.pose.rotation;
  finite = finite && is_finite(q.w) && is_finite(Vec3{q.x, q.y, q.z});
  for (std::uint32_t i = 0; i < c.vertex_count; ++i) finite = finite && is_finite(c.vertices_m[i]);
  return finite;
}

bool in_range(const ObstacleConfig& c) {
  if (c.vertex_count == 0 || c.vertex_count > kMaxHullVertices || !all_finite(c)) return false;
  for (std::uint32_t i = 0; i < c.vertex_count; ++i) {
    if (!(norm(c.vertices_m[i]) <= kLargestConfigM)) return false;
  }
  const Quat q = c.pose.rotation;
  const float length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return norm(c.pose.position_m) <= kLargestConfigM && length2 > 1 - kRotationTolerance &&
         length2 < 1 + kRotationTolerance && c.rounding_m >= 0 && c.rounding_m <= kLargestConfigM &&
         c.stiffness_n_per_m > 0 && c.largest_force_n > 0 && c.friction >= 0;
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

Status obstacle_prepare(const ObstacleConfig& config, Obstacle& obstacle_out) {
  if (!in_range(config)) return Status::kConfigValueOutOfRange;
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

bool obstacle_near(const Obstacle& obstacle, const NeedlePiece& piece) {
  return !is_far(obstacle, axis_in_body(obstacle, piece), rounding_of(obstacle, piece));
}

Gap obstacle_gap(const Obstacle& obstacle, const NeedlePiece& piece) {
  const double rounding = rounding_of(obstacle, piece);
  const ConvexHull hull = hull_of(obstacle);
  const Segment axis = axis_in_body(obstacle, piece);
  const Closest seen = view(hull, axis, kCoreShare * rounding, {0, 0, 0});
  const Vec3d point = point_on(axis, seen.place);
  const Vec3d normal = seen.normal;
  return {static_cast<float>(-depth_along(hull, normal, point, rounding)),
          to_float(to_world(obstacle.rotation, normal)), static_cast<float>(seen.place)};
}

ObstacleLoad obstacle_load(const Obstacle& obstacle, const NeedlePiece& piece,
                           const ObstacleContact& last, ObstacleContact& next_out) {
  next_out = {};
  const bool usable = is_finite(piece.a_m) && is_finite(piece.b_m) && is_finite(piece.radius_m);
  const Touch touch = usable ? find_touch(obstacle, piece, last) : Touch{};
  const ObstacleConfig& config = obstacle.config;
  const double k = static_cast<double>(config.stiffness_n_per_m);
  const Press pressed = press(config, touch.depth_m);
  const double before_j = press(config, touch.depth_last_m).energy_j;
  const double turned_j = is_zero(last.normal) ? 0 : before_j - pressed.energy_j;
  const double held_at = static_cast<double>(last.place);
  const Vec3d moved = touch.goes_on ? (1 - held_at) * (to_double(piece.a_m) - to_double(last.a_m)) +
                                          held_at * (to_double(piece.b_m) - to_double(last.b_m))
                                    : Vec3d{0, 0, 0};
  const double limit_n = touch.goes_on || is_zero(last.normal)
                             ? static_cast<double>(config.friction) * pressed.force_n
                             : 0;
  const Slip slid = slip(k, limit_n, touch.normal, to_double(last.bristle_m), moved);
  ObstacleLoad load = {};
  load.dissipated_j = static_cast<float>(turned_j + slid.dissipated_j);
  const bool known = !is_zero(to_float(touch.normal)) && !is_zero(last.normal);
  if (!(touch.depth_m > 0) && !known) return load;
  const Vec3d place_m = point_on({to_double(piece.a_m), to_double(piece.b_m)}, touch.place);
  load.normal = to_float(touch.normal);
  load.place = static_cast<float>(touch.place);
  load.depth_m = static_cast<float>(touch.depth_m);
  if (!(touch.depth_m > 0)) {
    load.at_m = to_float(place_m + touch.depth_m * touch.normal);
    load.stiffness_n_per_m = stiffness_matrix(load.normal, config.stiffness_n_per_m, 0);
    return load;
  }
  next_out = {to_float(touch.normal), to_float(slid.bristle_m), piece.a_m, piece.b_m,
              static_cast<float>(touch.place)};
  load.force_n = to_float(pressed.force_n * touch.normal - k * slid.bristle_m);
  load.at_m = to_float(place_m);
  load.elastic_j =
      static_cast<float>(pressed.energy_j + 0.5 * k * dot(slid.bristle_m, slid.bristle_m));
  load.slips = slid.slips ? 1 : 0;
  load.stiffness_n_per_m = stiffness_matrix(
      load.normal, static_cast<float>(max_of(pressed.stiffness_n_per_m, kLeastStiffnessShare * k)),
      slid.slips ? 0 : config.stiffness_n_per_m);
  return load;
}

}  // namespace stylet
