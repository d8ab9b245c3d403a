// SPDX-License-Identifier: Apache-2.0
// Bodies and references for the obstacle tests: random poses, and a box's signed distance in closed
// form.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw.h"
#include "gap.h"
#include "needle/convex.h"
#include "needle/obstacle.h"

namespace stylet::test {

constexpr float kNeedleRadiusM = 0.35e-3F;  // 22G

// Places of bodies and needles.
struct PlaceDraw : DoubleDraw {
  PlaceDraw() : DoubleDraw(20140801) {}
  float uniform_f(double low, double high) { return static_cast<float>(between(low, high)); }
  Vec3 vector(double size) {
    return {uniform_f(-size, size), uniform_f(-size, size), uniform_f(-size, size)};
  }
  Quat rotation() {
    for (;;) {
      const Quat q = {uniform_f(-1, 1), uniform_f(-1, 1), uniform_f(-1, 1), uniform_f(-1, 1)};
      const float length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
      if (length > 0.1F && length < 1) {
        return {q.w / length, q.x / length, q.y / length, q.z / length};
      }
    }
  }
};

inline ObstacleConfig bone() {
  ObstacleConfig config;
  config.stiffness_n_per_m = 20e3F;
  config.largest_force_n = 20;
  config.friction = 0.2F;
  return config;
}

inline ObstacleConfig bone_box(Vec3 half_m) {
  ObstacleConfig config = bone();
  make_box(config, half_m);
  return config;
}

inline Obstacle prepared(const ObstacleConfig& config) {
  Obstacle obstacle = {};
  EXPECT_EQ(obstacle_prepare(config, obstacle), Status::kOk);
  return obstacle;
}

// Points spread evenly over a sphere (Fibonacci's spiral).
inline ObstacleConfig bone_hull_of_sphere(std::uint32_t vertices, double radius_m) {
  ObstacleConfig config = bone();
  config.vertex_count = vertices;
  const double turn = 3.14159265358979323846 * (3 - std::sqrt(5.0));
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const double z = 1 - (2.0 * i + 1) / vertices, ring = std::sqrt(1 - z * z);
    config.vertices_m[i] =
        to_float(radius_m * Vec3d{ring * std::cos(turn * i), ring * std::sin(turn * i), z});
  }
  return config;
}

inline Vec3d to_body(const Obstacle& obstacle, Vec3 point) {
  const Vec3d v = to_double(point) - to_double(obstacle.config.pose.position_m);
  Vec3d result = {0, 0, 0};
  double* out[] = {&result.x, &result.y, &result.z};
  for (int i = 0; i < 3; ++i) *out[i] = dot(to_double(column(obstacle.rotation, i)), v);
  return result;
}

// Signed distance of a point to a box, closed form; negative inside.
inline double box_distance(Vec3d half, Vec3d p) {
  const Vec3d q = {std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
  const Vec3d outside = {std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return norm(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// Least distance of a segment to a box that it does not enter: convex along the segment, so the
// golden section finds it.
inline double box_distance(Vec3d half, const Segment& segment) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = 0, high = 1;
  for (int i = 0; i < 80; ++i) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (box_distance(half, point_on(segment, left)) <
        box_distance(half, point_on(segment, right))) {
      high = right;
    } else {
      low = left;
    }
  }
  return box_distance(half, point_on(segment, 0.5 * (low + high)));
}

inline double angle_between(Vec3d a, Vec3d b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

inline bool all_finite(const ObstacleLoad& load) {
  bool finite = is_finite(load.force_n) && is_finite(load.at_m) && is_finite(load.place) &&
                is_finite(load.depth_m) && is_finite(load.normal) && is_finite(load.elastic_j) &&
                is_finite(load.dissipated_j);
  for (const auto& row : load.stiffness_n_per_m.m) {
    for (const float value : row) finite = finite && is_finite(value);
  }
  return finite;
}

}  // namespace stylet::test
