// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/refine_near.h"

#include <algorithm>
#include <unordered_map>

#include "meshes/near_surface.h"

namespace stylet::offline {
namespace {

constexpr std::uint32_t kWhole = 0xFFFFFFFF;  // instead of an edge's middle: not halved
constexpr int kMostRounds = 24;

class Halves {
 public:
  Halves(Mesh& mesh, const NearSurface& other, double longest)
      : mesh_(mesh), other_(other), longest_(longest) {}

  // The triangles with their longer edges halved.
  std::vector<Triangle> next() {
    middles_.clear();
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh_.triangles) split(t, triangles);
    return triangles;
  }

 private:
  // Both triangles of an edge get the same answer.
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [entry, is_new] = middles_.try_emplace(std::uint64_t{low} << 32U | high, kWhole);
    if (!is_new) return entry->second;
    const Vec from = mesh_.points[low], to = mesh_.points[high], middle = (from + to) * 0.5;
    const double size = length(to - from);
    if (size > longest_ && length(other_.nearest(middle).at - middle) < size) {
      entry->second = static_cast<std::uint32_t>(mesh_.points.size());
      mesh_.points.push_back(middle);
    }
    return entry->second;
  }

  void split(Triangle t, std::vector<Triangle>& triangles) {
    std::array<std::uint32_t, 3> m{};  // behind each corner
    for (std::size_t i = 0; i < 3; ++i) m[i] = middle_of(t[i], t[(i + 1) % 3]);
    const auto halved = 3 - std::ranges::count(m, kWhole);
    // One: it is the first. Two: the last is whole.
    while ((halved == 1 && m[0] == kWhole) || (halved == 2 && m[2] != kWhole)) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      triangles.push_back({a, b, c});
    };
    if (halved == 0) {
      triangles.push_back(t);
    } else if (halved == 1) {
      add(t[0], m[0], t[2]);
      add(m[0], t[1], t[2]);
    } else if (halved == 2) {
      add(m[0], t[1], m[1]);
      add(t[0], m[0], m[1]);
      add(t[0], m[1], t[2]);
    } else {
      add(t[0], m[0], m[2]);
      add(m[0], t[1], m[1]);
      add(m[2], m[1], t[2]);
      add(m[0], m[1], m[2]);
    }
  }

  Mesh& mesh_;
  const NearSurface& other_;
  double longest_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // by edge
};

}  // namespace

Mesh refined_near(Mesh mesh, const Mesh& other, double longest) {
  if (other.triangles.empty()) return mesh;
  const NearSurface near(other);
  Halves halves(mesh, near, longest);
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Triangle> triangles = halves.next();
    const bool is_done = triangles.size() == mesh.triangles.size();
    mesh.triangles = std::move(triangles);
    if (is_done) break;
  }
  return mesh;
}

}  // namespace stylet::offline
