// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/bodies.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "base/matrix.h"
#include "base/most_off.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

Vec place_m(const LabelMap& map, Vec index) {
  return map.origin_m + map.step_m[0] * index.x + map.step_m[1] * index.y + map.step_m[2] * index.z;
}

// Calls visit(index of the voxel) for all voxels with these labels.
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

// A piece of an obstacle: voxels with its labels, row by row.
struct Piece {
  std::size_t obstacle = 0;
  std::vector<Vec> voxels;
  double hull_m3 = 0;
};

// The corners of the convex outline of places in one slice (Andrew's monotone chain).
std::vector<Vec> convex_outline(std::vector<Vec> places) {
  const auto before = [](Vec a, Vec b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(places.begin(), places.end(), before);
  std::vector<Vec> outline;
  for (const bool back : {false, true}) {
    const std::size_t start = outline.size();
    for (const Vec& p : places) {
      while (outline.size() >= start + 2) {
        const Vec a = outline[outline.size() - 2], b = outline.back();
        if ((b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x)) break;
        outline.pop_back();
      }
      outline.push_back(p);
    }
    if (!back) std::reverse(places.begin(), places.end());
  }
  return outline;
}

// Corners of the outline of each slice: the hull has no other corners.
std::vector<Vec> outer_corners_m(const LabelMap& map, const std::vector<Vec>& voxels) {
  std::vector<Vec> corners_m, slice;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const Vec at = voxels[i];
    const auto same_row = [&](std::size_t other) {
      return other < voxels.size() && voxels[other].y == at.y && voxels[other].z == at.z;
    };
    for (const double y : {-0.5, 0.5}) {
      if (!same_row(i - 1)) slice.push_back(at + Vec{-0.5, y, 0});
      if (!same_row(i + 1)) slice.push_back(at + Vec{0.5, y, 0});
    }
    if (i + 1 < voxels.size() && voxels[i + 1].z == at.z) continue;
    for (const Vec& corner : convex_outline(std::move(slice))) {
      for (const double z : {-0.5, 0.5}) corners_m.push_back(place_m(map, corner + Vec{0, 0, z}));
    }
    slice.clear();
  }
  return corners_m;
}

Piece piece_of(const LabelMap& map, std::size_t obstacle, std::vector<Vec> voxels) {
  const double hull_m3 = hull_volume_m3(outer_corners_m(map, voxels));
  return {obstacle, std::move(voxels), hull_m3};
}

double label_m3(const LabelMap& map, const Piece& piece) {
  return static_cast<double>(piece.voxels.size()) * voxel_volume_m3(map);
}

// The direction of the largest variance of the voxels. Of its two senses the one whose components
// have a positive sum, so that the halves of a piece have an order.
Vec longest_axis(const LabelMap& map, const Piece& piece) {
  Vec middle;
  for (const Vec& at : piece.voxels) middle = middle + at;
  middle = place_m(map, middle * (1.0 / static_cast<double>(piece.voxels.size())));
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec& at : piece.voxels) {
    const Eigen::Vector3d from = to_eigen(place_m(map, at) - middle);
    covariance += from * from.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> variances(covariance);
  const Vec axis = from_eigen(variances.eigenvectors().col(2));  // they are sorted
  return axis * (axis.x + axis.y + axis.z < 0 ? -1 : 1);
}

// Cuts a piece across its longest axis, where the hulls of both halves have the least volume.
std::array<Piece, 2> cut_in_two(const LabelMap& map, const Piece& piece) {
  const Vec axis = longest_axis(map, piece);
  std::vector<double> along;
  for (const Vec& at : piece.voxels) along.push_back(dot(place_m(map, at), axis));
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  constexpr int kPlaces = 8;
  std::array<Piece, 2> best;
  for (int place = 1; place < kPlaces; ++place) {
    const double limit = *low + (*high - *low) * place / kPlaces;
    std::array<std::vector<Vec>, 2> halves;
    for (std::size_t i = 0; i < along.size(); ++i) {
      halves[along[i] > limit ? 1 : 0].push_back(piece.voxels[i]);
    }
    if (halves[0].empty() || halves[1].empty()) continue;
    std::array<Piece, 2> tried = {piece_of(map, piece.obstacle, std::move(halves[0])),
                                  piece_of(map, piece.obstacle, std::move(halves[1]))};
    const bool better = best[0].voxels.empty() ||
                        tried[0].hull_m3 + tried[1].hull_m3 < best[0].hull_m3 + best[1].hull_m3;
    if (better) best = std::move(tried);
  }
  return best;
}

// The piece whose hull exceeds its labels by the largest volume is cut next.
void cut_pieces(const LabelMap& map, std::vector<Piece>& pieces) {
  while (pieces.size() < kMaxObstacles) {
    const auto beside = [&](const Piece& piece) { return piece.hull_m3 - label_m3(map, piece); };
    const auto worst =
        std::max_element(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
          const auto rank = [&](const Piece& piece) {
            return piece.hull_m3 > kMostHullRatio * label_m3(map, piece) ? beside(piece) : 0;
          };
          return rank(a) < rank(b);
        });
    if (worst == pieces.end() || worst->hull_m3 <= kMostHullRatio * label_m3(map, *worst)) return;
    std::array<Piece, 2> halves = cut_in_two(map, *worst);
    if (halves[0].voxels.empty()) return;
    *worst = std::move(halves[0]);
    pieces.insert(worst + 1, std::move(halves[1]));
  }
}

bool holds(const std::vector<HullPlane>& planes, Vec place_m) {
  return std::all_of(planes.begin(), planes.end(), [&](const HullPlane& plane) {
    return dot(plane.normal, place_m) <= plane.limit;
  });
}

bool holds(const Box& box, Vec p) {
  return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x &&
         p.y <= box.high.y && p.z <= box.high.z;
}

// Finds the volume of each tissue in the hull.
void find_swallowed(const LabelMap& map, const Recipe& recipe, const Groups& groups,
                    NamedHull& hull) {
  const std::vector<HullPlane> planes = hull_planes(hull.hull);
  Box box;
  for (const Vec& p : hull.hull.vertices_m) grow(box, p);
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < map.size[2]; ++z) {
    for (std::uint32_t y = 0; y < map.size[1]; ++y) {
      for (std::uint32_t x = 0; x < map.size[0]; ++x, ++i) {
        if (groups[i] == 0) continue;
        const Vec at = place_m(map, {1.0 * x, 1.0 * y, 1.0 * z});
        if (!holds(box, at) || !holds(planes, at)) continue;
        hull.swallowed_m3[recipe.groups[groups[i] - 1U].tissue] += voxel_volume_m3(map);
      }
    }
  }
}

// The obstacle's name; if it has several pieces, with a number that makes the name unique.
std::string name_of(const Piece& piece, const std::vector<Piece>& pieces, const Recipe& recipe,
                    const std::vector<NamedHull>& before) {
  const std::string& obstacle = recipe.obstacles[piece.obstacle].name;
  const auto parts = std::count_if(pieces.begin(), pieces.end(), [&](const Piece& other) {
    return other.obstacle == piece.obstacle;
  });
  if (parts == 1) return obstacle;
  const auto is_taken = [&](const std::string& name) {
    const auto is = [&](const auto& each) { return each.name == name; };
    return std::any_of(recipe.obstacles.begin(), recipe.obstacles.end(), is) ||
           std::any_of(before.begin(), before.end(), is);
  };
  for (int number = 1;; ++number) {
    std::string name = fmt::format("{}-{}", obstacle, number);
    if (!is_taken(name)) return name;
  }
}

}  // namespace

std::vector<NamedHull> find_obstacles(const std::string& path, const LabelMap& map,
                                      const Recipe& recipe, const Groups& groups) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < recipe.obstacles.size(); ++i) {
    std::vector<Vec> voxels;
    each_labelled(map, recipe.obstacles[i].labels, [&](Vec at) { voxels.push_back(at); });
    if (!voxels.empty()) pieces.push_back(piece_of(map, i, std::move(voxels)));
  }
  cut_pieces(map, pieces);
  std::vector<NamedHull> hulls;
  for (const Piece& piece : pieces) {
    const std::string name = name_of(piece, pieces, recipe, hulls);
    Hull hull =
        simple_hull(path + ": " + name, outer_corners_m(map, piece.voxels), kMaxHullVertices);
    hulls.push_back(
        {name, recipe.obstacles[piece.obstacle].name, std::move(hull), label_m3(map, piece), {}});
    find_swallowed(map, recipe, groups, hulls.back());
  }
  return hulls;
}

void warn_of_obstacles(const std::vector<NamedHull>& hulls, std::vector<std::string>& warnings) {
  for (const NamedHull& each : hulls) {
    const double off = each.hull.volume_m3 / each.label_m3 - 1;
    if (std::abs(off) <= kMostOff) continue;
    std::string tissues;
    for (const auto& [tissue, m3] : each.swallowed_m3) {
      tissues +=
          fmt::format("{} {:.3g} ml of {}", tissues.empty() ? ", in it" : ",", m3 * 1e6, tissue);
    }
    warnings.push_back(
        fmt::format("obstacle {}: its hull holds {:.3g} ml, {:+} % against the {:.3g} ml of "
                    "its labels{}: a needle is kept out of all of the hull",
                    each.name, each.hull.volume_m3 * 1e6, std::lround(100 * off),
                    each.label_m3 * 1e6, tissues));
  }
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
    target.in_tissue = std::ranges::any_of(recipe.groups, [&](const LabelGroup& group) {
      return std::ranges::find_first_of(group.labels, wanted.labels) != group.labels.end();
    });
    targets.push_back(target);
  }
  return targets;
}

void warn_of_targets(const std::vector<Target>& targets, std::vector<std::string>& warnings) {
  for (const Target& target : targets) {
    if (target.in_tissue) continue;
    warnings.push_back(
        fmt::format("target {}: its labels are in none of the tissues: it lies outside the organ",
                    target.name));
  }
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
  const auto aim = std::ranges::find(targets, true, &Target::in_tissue);
  if (aim != targets.end()) text += fmt::format("point_mm = {}\n", shown(aim->middle_m));
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

}  // namespace stylet::offline
