// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "stylet/limits.h"

namespace stylet::bake {
namespace {

Vec place_m(const LabelMap& map, Vec index) {
  return map.origin_m + map.step_m[0] * index.x + map.step_m[1] * index.y + map.step_m[2] * index.z;
}

// Calls visit(index of the voxel) for the voxels of some labels.
template <typename Visit>
void each_labelled(const LabelMap& map, const std::vector<std::uint16_t>& labels, Visit visit) {
  std::vector<bool> wanted(65536, false);
  for (const std::uint16_t label : labels) wanted[label] = true;
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < map.size[2]; ++z) {
    for (std::uint32_t y = 0; y < map.size[1]; ++y) {
      for (std::uint32_t x = 0; x < map.size[0]; ++x, ++i) {
        if (wanted[map.label[i]]) visit(Vec{1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
}

// Corners of the first and the last voxel of each row: the hull has no other.
std::vector<Vec> outer_corners_m(const LabelMap& map, const std::vector<std::uint16_t>& labels) {
  std::vector<Vec> ends;
  each_labelled(map, labels, [&](Vec at) {
    const bool same_row = ends.size() > 1 && ends.back().y == at.y && ends.back().z == at.z;
    if (!same_row) ends.insert(ends.end(), 2, at);
    ends.back() = at;
  });
  std::vector<Vec> corners_m;
  for (const Vec& at : ends) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto half = [&](unsigned bit) { return (corner >> bit & 1U) != 0 ? 0.5 : -0.5; };
      corners_m.push_back(place_m(map, at + Vec{half(0), half(1), half(2)}));
    }
  }
  return corners_m;
}

}  // namespace

std::vector<NamedHull> find_obstacles(const std::string& path, const LabelMap& map,
                                      const Recipe& recipe) {
  std::vector<NamedHull> hulls;
  for (const NamedLabels& body : recipe.obstacles) {
    const std::vector<Vec> corners_m = outer_corners_m(map, body.labels);
    if (corners_m.empty()) continue;
    hulls.push_back({body.name, simple_hull(path + ": " + body.name, corners_m, kMaxHullVertices)});
  }
  return hulls;
}

std::vector<Target> find_targets(const LabelMap& map, const Recipe& recipe) {
  std::vector<Target> targets;
  for (const NamedLabels& wanted : recipe.targets) {
    Vec sum;
    double count = 0;
    each_labelled(map, wanted.labels, [&](Vec at) {
      sum = sum + at;
      ++count;
    });
    if (count == 0) continue;
    const Vec centroid_m = place_m(map, sum * (1 / count));
    Target target{wanted.name, {}, count * voxel_volume_m3(map), 0};
    target.radius_m = std::cbrt(target.volume_m3 * 3 / (4 * std::numbers::pi));
    double least = std::numeric_limits<double>::infinity();
    each_labelled(map, wanted.labels, [&](Vec at) {
      const double away = length(place_m(map, at) - centroid_m);
      if (away >= least) return;
      least = away;
      target.middle_m = place_m(map, at);
    });
    targets.push_back(target);
  }
  return targets;
}

std::string scene_toml(const std::string& organ, const std::vector<std::string>& hull_files,
                       const std::vector<Target>& targets) {
  const auto shown = [](Vec m) {
    return fmt::format("[{:.2f}, {:.2f}, {:.2f}]", m.x * 1e3, m.y * 1e3, m.z * 1e3);
  };
  std::string text = fmt::format(
      "# Made by stylet-organ build. Frame: the patient's, x to the left, y to the back, z to the "
      "head.\n[organ]\npath = \"{}\"\n\n[approach]\ndirection = [0, 1, 0]  # from the front\n",
      organ);
  if (!targets.empty()) text += fmt::format("point_mm = {}\n", shown(targets.front().middle_m));
  for (const Target& target : targets) {
    text += fmt::format("\n[[targets]]\nname = \"{}\"\nat_mm = {}\nradius_mm = {:.2f}\n",
                        target.name, shown(target.middle_m), std::max(0.1, target.radius_m * 1e3));
  }
  text += "\n[[hand.waypoint]]\ntravel_mm = 80\nspeed_mm_s = 25\nhold_s = 0.5\n";
  for (const std::string& file : hull_files) {
    text +=
        fmt::format("\n[[obstacles]]\nshape = \"hull\"\nhull = \"{}\"\nat_mm = [0, 0, 0]\n", file);
  }
  return text;
}

}  // namespace stylet::bake
