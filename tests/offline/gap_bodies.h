// SPDX-License-Identifier: Apache-2.0
// Bodies with gaps, and what measures them, for tests of parts that do not touch. Units: mm.
#pragma once

#include <numbers>
#include <vector>

#include "base/geometry.h"
#include "offline_support.h"
#include "report/quality.h"

namespace stylet::test {

inline offline::Mesh ball(double radius, int rings) {
  offline::Mesh mesh;
  const double pi = std::numbers::pi;
  mesh.points = {{0, 0, radius}, {0, 0, -radius}};
  const auto at = [&](int ring, int i) {
    return static_cast<std::uint32_t>(2 + (ring - 1) * 2 * rings + (i + 2 * rings) % (2 * rings));
  };
  for (int ring = 1; ring < rings; ++ring) {
    for (int i = 0; i < 2 * rings; ++i) {
      const double a = pi * ring / rings, b = pi * i / rings;
      mesh.points.push_back({radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b),
                             radius * std::cos(a)});
      mesh.triangles.push_back({ring == 1 ? 0 : at(ring - 1, i), at(ring, i), at(ring, i + 1)});
      if (ring > 1)
        mesh.triangles.push_back({at(ring - 1, i), at(ring, i + 1), at(ring - 1, i + 1)});
      if (ring + 1 == rings) mesh.triangles.push_back({1, at(ring, i + 1), at(ring, i)});
    }
  }
  return mesh;
}

// Two lobes of 40 x 18 x 20, `gap` apart, on a base of 10 below both: one body.
inline offline::Mesh two_lobes(double gap) {
  const std::vector<double> x = {0, 18, 18 + gap, 36 + gap}, z = {0, 10, 30};
  offline::Mesh mesh;
  for (const double y : {0.0, 40.0}) {
    for (const double height : z) {
      for (const double across : x) mesh.points.push_back({across, y, height});
    }
  }
  const auto at = [](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return k * 12 + j * 4 + i;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t j = 0; j < 2; ++j) {
      if (i == 1 && j == 1) continue;  // the gap
      quad(at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0));
      quad(at(i, j, 1), at(i, j + 1, 1), at(i + 1, j + 1, 1), at(i + 1, j, 1));
    }
    const std::uint32_t top = i == 1 ? 1 : 2;
    quad(at(i, 0, 0), at(i, 0, 1), at(i + 1, 0, 1), at(i + 1, 0, 0));
    quad(at(i, top, 0), at(i + 1, top, 0), at(i + 1, top, 1), at(i, top, 1));
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t j = i == 0 || i == 3 ? 0 : 1; j < 2; ++j) {
      if (i % 2 == 0) {
        quad(at(i, j, 0), at(i, j + 1, 0), at(i, j + 1, 1), at(i, j, 1));
      } else {
        quad(at(i, j, 0), at(i, j, 1), at(i, j + 1, 1), at(i, j + 1, 0));
      }
    }
  }
  return mesh;
}

inline double volume(const offline::Mesh& mesh) {
  double sum = 0;
  for (const offline::Triangle& t : mesh.triangles) {
    sum += dot(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]])) / 6;
  }
  return sum;
}

inline offline::Mesh inside_out(offline::Mesh mesh) {
  for (offline::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// Pieces that hang together in the lattice.
inline std::size_t pieces_of(const offline::Built& built) {
  return offline::measure_quality(opened(built.bytes), {}, [](const char*, double) {})
      .pieces.size();
}

}  // namespace stylet::test
