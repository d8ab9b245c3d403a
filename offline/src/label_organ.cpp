// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_organ.h"

#include <filesystem>

#include "refusal.h"

namespace stylet::bake {
namespace {

// Number of the recipe's group plus one; 0 is none.
using Groups = std::vector<std::uint8_t>;

Groups groups_of(const std::string& path, const LabelMap& map, const Recipe& recipe) {
  constexpr std::size_t kMostGroups = 255;
  if (recipe.groups.size() > kMostGroups) {
    refuse("{} tissues: expected at most {}", recipe.groups.size(), kMostGroups);
  }
  Groups of_label(65536, 0);
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    for (const std::uint16_t label : recipe.groups[i].labels) {
      of_label[label] = static_cast<std::uint8_t>(i + 1);
    }
  }
  Groups groups;
  groups.reserve(map.label.size());
  bool any = false;
  for (const std::uint16_t label : map.label) {
    groups.push_back(of_label[label]);
    any = any || of_label[label] != 0;
  }
  if (!any) refuse("{}: holds none of the recipe's labels: expected one at least", path);
  return groups;
}

// ---- surface ------------------------------------------------------------------------------------

struct Quad {
  std::array<std::uint32_t, 4> corner;
};

struct Skin {
  std::vector<Vec> points;
  std::vector<Quad> quads;
};

// The faces between chosen voxels and others, their corners counter-clockwise from outside.
class SkinMaker {
 public:
  SkinMaker(const LabelMap& map, const Groups& groups)
      : map_(map),
        groups_(groups),
        number_((std::size_t{map.size[0]} + 1) * (map.size[1] + 1) * (map.size[2] + 1), kNone),
        mirrored_(dot(map.step_m[0], cross(map.step_m[1], map.step_m[2])) < 0) {}

  Skin make() {
    std::array<std::int64_t, 3> at{};
    for (at[2] = 0; at[2] < map_.size[2]; ++at[2]) {
      for (at[1] = 0; at[1] < map_.size[1]; ++at[1]) {
        for (at[0] = 0; at[0] < map_.size[0]; ++at[0]) {
          if (is_chosen(at)) add_faces(at);
        }
      }
    }
    return std::move(skin_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool is_chosen(const std::array<std::int64_t, 3>& at) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < 0 || at[axis] >= map_.size[axis]) return false;
    }
    return groups_[static_cast<std::size_t>((at[2] * map_.size[1] + at[1]) * map_.size[0] +
                                            at[0])] != 0;
  }

  void add_faces(const std::array<std::int64_t, 3>& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int64_t side : {0, 1}) {
        std::array<std::int64_t, 3> beyond = at;
        beyond[axis] += side == 1 ? 1 : -1;
        if (!is_chosen(beyond)) add_face(at, axis, side);
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
  std::vector<std::uint32_t> number_;  // of the point at each corner of the map's voxels
  bool mirrored_;                      // the map's indices are left-handed
  Skin skin_;
};

// Every point towards the mean of its neighbours by `share` of the way.
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

// Taubin 1995: shrinks and swells in turn, so that steps go and the volume stays.
Mesh smooth_mesh(Skin skin) {
  constexpr int kRounds = 10;
  constexpr double kShrink = 0.5, kSwell = -0.53;
  for (int round = 0; round < kRounds; ++round) {
    relax(skin, kShrink);
    relax(skin, kSwell);
  }
  Mesh mesh;
  mesh.points = std::move(skin.points);
  for (const Quad& quad : skin.quads) {
    const auto& c = quad.corner;
    mesh.triangles.push_back({c[0], c[1], c[2]});
    mesh.triangles.push_back({c[0], c[2], c[3]});
  }
  return mesh;
}

// ---- voxels -------------------------------------------------------------------------------------

// From the patient's frame to the map's indices.
struct ToIndex {
  Vec origin_m;
  std::array<Vec, 3> row;

  explicit ToIndex(const LabelMap& map) : origin_m(map.origin_m) {
    const auto& s = map.step_m;
    const double volume = dot(s[0], cross(s[1], s[2]));
    row = {cross(s[1], s[2]) * (1 / volume), cross(s[2], s[0]) * (1 / volume),
           cross(s[0], s[1]) * (1 / volume)};
  }
};

std::uint8_t group_at(const LabelMap& map, const Groups& groups, const ToIndex& to_index,
                      Vec point_m) {
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const double at = std::floor(dot(to_index.row[axis], point_m - to_index.origin_m) + 0.5);
    if (!(at >= 0 && at < map.size[axis])) return 0;
    index = index * map.size[axis] + static_cast<std::size_t>(at);
  }
  return groups[index];
}

// Samples of each group in one cell, counted; the cell's bits.
struct CellCount {
  std::array<std::uint8_t, 256> samples{};
  std::uint64_t inside = 0;
};

// Where in its 64th of the cell a sample lies: on a grid the faces of a map would fall between the
// same rows of samples everywhere, and volumes be off by a row. Roberts' R3 sequence, which spreads
// evenly.
Vec jitter(std::size_t sample) {
  const auto part = [sample](double step) {
    const double at = static_cast<double>(sample) * step;
    return at - std::floor(at);
  };
  return {part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703)};
}

CellCount count_cell(const Grid& grid, std::size_t cell, Vec corner, const LabelMap& map,
                     const Groups& groups, const ToIndex& to_index) {
  constexpr std::size_t kAcross = 4, kSamples = kAcross * kAcross * kAcross;
  CellCount count;
  for (std::size_t s = 0; s < kSamples; ++s) {
    const Vec row = {static_cast<double>(s % kAcross), static_cast<double>(s / kAcross % kAcross),
                     static_cast<double>(s / kAcross / kAcross)};
    const Vec at = corner + (row + jitter(cell * kSamples + s)) * (1.0 / kAcross);
    const std::uint8_t group = group_at(map, groups, to_index, grid.origin_m + at * grid.edge_m);
    if (group == 0) continue;
    ++count.samples[group];
    count.inside |= std::uint64_t{1} << s;
  }
  return count;
}

Claims claim_labels(const Grid& grid, const LabelMap& map, const Groups& groups,
                    std::vector<LabelReport>& reports, const Progress& progress) {
  const ToIndex to_index(map);
  const double sample_m3 = grid.edge_m * grid.edge_m * grid.edge_m / 64;
  Claims claims = no_claims(grid);
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    progress("sampling labels", static_cast<double>(z) / grid.size[2]);
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x, ++cell) {
        const CellCount count =
            count_cell(grid, cell, {1.0 * x, 1.0 * y, 1.0 * z}, map, groups, to_index);
        if (count.inside == 0) continue;
        const auto most = std::max_element(count.samples.begin() + 1, count.samples.end());
        claims.inside[cell] = count.inside;
        claims.owner[cell] = static_cast<std::uint16_t>(most - count.samples.begin() - 1);
        claims.owner_fill[cell] = *most;
        for (std::size_t i = 0; i < reports.size(); ++i) {
          reports[i].filled_volume_m3 += count.samples[i + 1] * sample_m3;
        }
      }
    }
  }
  return claims;
}

std::vector<LabelReport> label_reports(const LabelMap& map, const Groups& groups,
                                       const Recipe& recipe) {
  std::vector<LabelReport> reports;
  for (const LabelGroup& group : recipe.groups) reports.push_back({group.tissue, 0, 0, 0});
  for (const std::uint8_t group : groups) {
    if (group != 0) ++reports[group - 1].voxels;
  }
  for (LabelReport& each : reports) {
    each.map_volume_m3 = static_cast<double>(each.voxels) * voxel_volume_m3(map);
  }
  return reports;
}

void warn_of_absent(const Recipe& recipe, BuildReport& report) {
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    if (report.labels[i].voxels > 0) continue;
    report.warnings.push_back(
        fmt::format("none of the labels of {} is in the map", recipe.groups[i].tissue));
  }
}

}  // namespace

Built build_labels(const std::string& path, const LabelMap& map, const Recipe& recipe,
                   const BuildOptions& options, const Progress& progress) {
  const Groups groups = groups_of(path, map, recipe);
  progress("finding the surface", 0);
  Skin skin = SkinMaker(map, groups).make();
  Claimed claimed;
  for (const Vec& point : skin.points) grow(claimed.box, point);
  claimed.mesh = smooth_mesh(std::move(skin));
  for (const Vec& point : claimed.mesh.points) grow(claimed.box, point);
  Built built;
  warn_of_size(claimed.box, built.report.warnings);
  const Grid grid = make_grid(claimed.box, choose_edge(claimed.box, options));
  built.report.labels = label_reports(map, groups, recipe);
  warn_of_absent(recipe, built.report);
  claimed.claims = claim_labels(grid, map, groups, built.report.labels, progress);
  for (const LabelGroup& group : recipe.groups) claimed.tissues.push_back(group.tissue);
  claimed.sources = {{std::filesystem::path(path).filename().string(), "labels", map.sha256, 1e-3,
                      0, static_cast<std::uint32_t>(claimed.mesh.triangles.size())}};
  built.bytes = assemble(std::move(claimed), options, progress);
  return built;
}

}  // namespace stylet::bake
