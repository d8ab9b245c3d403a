// SPDX-License-Identifier: GPL-3.0-or-later
// Points, boxes and triangle meshes: the plain data that the stages pass to each other.
// Units: as the owner of the data says (file units before scaling, then metres or voxel edges).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace stylet::offline {

struct Vec {
  double x = 0, y = 0, z = 0;
  double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vec&) const = default;
};

inline Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(Vec a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec a) {
  return std::sqrt(dot(a, a));
}
inline bool finite(Vec a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

struct Box {
  Vec low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::infinity()};
  Vec high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};
};

inline void grow(Box& box, Vec p) {
  box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
  box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

inline double longest_side(const Box& box) {
  const Vec size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
  std::vector<Vec> points;
  std::vector<Triangle> triangles;
};

inline void add_mesh(Mesh& to, const Mesh& other) {
  const auto base = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles) {
    to.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
}

inline Box bounds(const Mesh& mesh) {
  Box box;
  for (const Vec& p : mesh.points) grow(box, p);
  return box;
}

// Positive if the corners of faces, seen from outside, run counter-clockwise. `centre` matters only
// for an open mesh.
inline double signed_volume(const std::vector<Vec>& points, const std::vector<Triangle>& triangles,
                            Vec centre) {
  double six_volumes = 0;
  for (const Triangle& t : triangles) {
    six_volumes += dot(points[t[0]] - centre, cross(points[t[1]] - centre, points[t[2]] - centre));
  }
  return six_volumes / 6;
}

}  // namespace stylet::offline
