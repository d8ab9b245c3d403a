// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/skin.h"

namespace stylet::offline {
namespace {

// The faces between chosen voxels and others, their corners counter-clockwise from outside.
class SkinMaker {
 public:
  // `beyond`: only faces to these voxels; null: all faces.
  SkinMaker(const LabelMap& map, const Groups& groups, const Groups* beyond)
      : map_(map),
        groups_(groups),
        beyond_(beyond),
        number_((std::size_t{map.size[0]} + 1) * (map.size[1] + 1) * (map.size[2] + 1), kNone),
        mirrored_(dot(map.step_m[0], cross(map.step_m[1], map.step_m[2])) < 0) {}

  Skin make() {
    std::array<std::int64_t, 3> at{};
    for (at[2] = 0; at[2] < map_.size[2]; ++at[2]) {
      for (at[1] = 0; at[1] < map_.size[1]; ++at[1]) {
        for (at[0] = 0; at[0] < map_.size[0]; ++at[0]) {
          if (is_chosen(groups_, at)) add_faces(at);
        }
      }
    }
    return std::move(skin_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool is_chosen(const Groups& groups, const std::array<std::int64_t, 3>& at) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < 0 || at[axis] >= map_.size[axis]) return false;
    }
    return groups[static_cast<std::size_t>((at[2] * map_.size[1] + at[1]) * map_.size[0] +
                                           at[0])] != 0;
  }

  void add_faces(const std::array<std::int64_t, 3>& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int64_t side : {0, 1}) {
        std::array<std::int64_t, 3> beyond = at;
        beyond[axis] += side == 1 ? 1 : -1;
        if (is_chosen(groups_, beyond)) continue;
        if (beyond_ == nullptr || is_chosen(*beyond_, beyond)) add_face(at, axis, side);
      }
    }
  }

  void add_face(const std::array<std::int64_t, 3>& at, std::size_t axis, std::int64_t side) {
    constexpr std::int64_t kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    Quad quad{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::int64_t, 3> corner = at;
      corner[axis] += side;
      corner[b] += kAround[i][0];
      corner[c] += kAround[i][1];
      quad.corner[i] = point_at(corner);
    }
    if ((side == 1) == mirrored_) std::swap(quad.corner[1], quad.corner[3]);
    skin_.quads.push_back(quad);
  }

  std::uint32_t point_at(const std::array<std::int64_t, 3>& corner) {
    const auto index = static_cast<std::size_t>(
        (corner[2] * (map_.size[1] + 1) + corner[1]) * (map_.size[0] + 1) + corner[0]);
    if (number_[index] == kNone) {
      number_[index] = static_cast<std::uint32_t>(skin_.points.size());
      Vec point = map_.origin_m;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point = point + map_.step_m[axis] * (static_cast<double>(corner[axis]) - 0.5);
      }
      skin_.points.push_back(point);
    }
    return number_[index];
  }

  const LabelMap& map_;
  const Groups& groups_;
  const Groups* beyond_;
  std::vector<std::uint32_t> number_;  // number of the point at each corner of the map's voxels
  bool mirrored_;                      // the map's indices are left-handed
  Skin skin_;
};

// Moves every point towards the mean of its neighbours, by the fraction `share` of the distance.
void relax(Skin& skin, double share) {
  std::vector<Vec> sum(skin.points.size());
  std::vector<double> count(skin.points.size(), 0);
  for (const Quad& quad : skin.quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t from = quad.corner[i], to = quad.corner[(i + 1) % 4];
      sum[from] = sum[from] + skin.points[to];
      sum[to] = sum[to] + skin.points[from];
      count[from] += 1;
      count[to] += 1;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Vec mean = sum[i] * (1 / count[i]);
    skin.points[i] = skin.points[i] + (mean - skin.points[i]) * share;
  }
}

}  // namespace

Skin label_skin(const LabelMap& map, const Groups& groups) {
  return SkinMaker(map, groups, nullptr).make();
}

Skin label_border(const LabelMap& map, const Groups& inside, const Groups& tissue) {
  return SkinMaker(map, inside, &tissue).make();
}

void smooth(Skin& skin, int rounds) {
  constexpr double kShrink = 0.5, kSwell = -0.53;
  for (int round = 0; round < rounds; ++round) {
    relax(skin, kShrink);
    relax(skin, kSwell);
  }
}

Mesh triangles_of(const Skin& skin) {
  Mesh mesh;
  mesh.points = skin.points;
  for (const Quad& quad : skin.quads) {
    const auto& c = quad.corner;
    mesh.triangles.push_back({c[0], c[1], c[2]});
    mesh.triangles.push_back({c[0], c[2], c[3]});
  }
  return mesh;
}

}  // namespace stylet::offline
