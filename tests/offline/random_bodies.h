// SPDX-License-Identifier: Apache-2.0
// Random bodies for tests of organ building, the same everywhere for a seed; and meshes joined into
// one.
#pragma once

#include <array>
#include <numbers>
#include <random>

#include "base/geometry.h"

namespace stylet::test {

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  std::size_t below(std::size_t count) { return engine_() % count; }
  bool coin() { return engine_() % 2 == 0; }
  offline::Vec direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  template <typename List>
  void shuffle(List& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

inline void append(offline::Mesh& mesh, const offline::Mesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const offline::Triangle& t : other.triangles) {
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
}

inline offline::Mesh both(offline::Mesh mesh, const offline::Mesh& other) {
  append(mesh, other);
  return mesh;
}

// A right-handed frame in any direction.
inline std::array<offline::Vec, 3> random_frame(Draw& draw) {
  const offline::Vec x = draw.direction(), across = cross(x, draw.direction());
  const offline::Vec y = across * (1 / length(across));
  return {x, y, cross(x, y)};
}

inline offline::Mesh turned(offline::Mesh mesh, const std::array<offline::Vec, 3>& frame) {
  for (offline::Vec& p : mesh.points) p = frame[0] * p.x + frame[1] * p.y + frame[2] * p.z;
  return mesh;
}

}  // namespace stylet::test
