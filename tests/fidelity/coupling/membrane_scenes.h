// SPDX-License-Identifier: Apache-2.0
// What tests of membranes share: drawn numbers, surfaces as triangles, and the punctures of a
// needle that is pushed in. Units: SI. Frame: world.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {

constexpr double kPlaceMm = 0.1;  // what a membrane's place may be off

struct Chance {
  std::mt19937_64 engine;
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine);
  }
  Vec3 direction() {
    std::normal_distribution<float> normal;
    const Vec3 v = {normal(engine), normal(engine), normal(engine)};
    return (1 / norm(v)) * v;
  }
};

using Triangles = std::vector<std::array<Vec3, 3>>;

// A square of `half_m` around a place, across a direction.
inline Triangles sheet(Vec3 at_m, Vec3 across, float half_m) {
  const Vec3 n = (1 / norm(across)) * across;
  const Vec3 helper = std::fabs(n.x) < 0.8F ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = (half_m / norm(cross(n, helper))) * cross(n, helper);
  const Vec3 v = cross(n, u);
  const Vec3 a = at_m - u - v, b = at_m + u - v, c = at_m + u + v, d = at_m - u + v;
  return {{a, b, c}, {a, c, d}};
}

// A sphere as triangles, of which none lies more than some 50 um inside it: an octahedron whose
// triangles are divided in four until they are small enough.
inline Triangles sphere(Vec3 centre_m, float radius_m) {
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1}, none = {};
  Triangles faces;
  for (const Vec3& a : {x, none - x}) {
    for (const Vec3& b : {y, none - y}) {
      for (const Vec3& c : {z, none - z}) faces.push_back({a, b, c});
    }
  }
  const auto between = [](Vec3 a, Vec3 b) { return (1 / norm(a + b)) * (a + b); };
  float side_m = radius_m * std::numbers::pi_v<float> / 2;
  for (; side_m * side_m / (6 * radius_m) > 50e-6F; side_m /= 2) {
    Triangles finer;
    for (const auto& [a, b, c] : faces) {
      const Vec3 ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (auto& face : faces) {
    for (Vec3& p : face) p = centre_m + radius_m * p;
  }
  return faces;
}

// Punctures of membranes and of the surface, with the tip's rest place in the tick before each.
struct Puncture {
  Event event;
  Vec3 rest_m;
};
struct Watch {
  std::uint32_t seen = 0;
  Vec3 rest_m = {};
  std::vector<Puncture> punctures;

  void operator()(Rig& rig) {
    std::vector<Event> list(kMaxEvents);
    list.resize(events(rig.kernel(), list));
    for (const Event& e : list) {
      if (e.kind != EventKind::kPuncture || e.tick <= seen) continue;
      punctures.push_back({e, rest_m});
    }
    seen = static_cast<std::uint32_t>(rig.view().state.head->tick);
    rest_m = rig.view().state.tip->rest_m;
  }
  std::vector<Puncture> of(std::uint32_t layer) const {
    std::vector<Puncture> some;
    for (const Puncture& p : punctures) {
      if (p.event.layer == layer) some.push_back(p);
    }
    return some;
  }
};

inline void push(Rig& rig, Watch& watch, Vec3 from_m, float to_x_m, float speed_m_per_s = 20e-3F) {
  drive(rig, from_m, to_x_m, speed_m_per_s, [&](const Output&) { watch(rig); });
}

inline double ratio(float a, float b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

}  // namespace stylet::test
