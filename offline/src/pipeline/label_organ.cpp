// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/label_organ.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "maps/skin.h"
#include "maps/wall.h"
#include "meshes/simplify.h"
#include "pipeline/pieces.h"
#include "voxels/levels.h"
#include "voxels/losses.h"

namespace stylet::offline {
namespace {

// Number of samples of each group in one cell, and the bits of samples inside.
struct CellCount {
  std::array<std::uint8_t, 256> samples{};
  std::array<std::uint8_t, 64> group{};  // group of each sample
  std::uint64_t inside = 0;
};

constexpr std::size_t kNoSkin = static_cast<std::size_t>(-1);

constexpr std::size_t kAcross = 4, kSamples = kAcross * kAcross * kAcross;

// The sub-cell (of 4 x 4 x 4) that a sample lies in.
Vec sample_row(std::size_t sample) {
  return {static_cast<double>(sample % kAcross), static_cast<double>(sample / kAcross % kAcross),
          static_cast<double>(sample / kAcross / kAcross)};
}

// Where in its sub-cell a sample lies. On a grid, the faces of a map would lie between the same
// rows of samples everywhere, and volumes would be wrong by a row. So Roberts' R3 sequence is used,
// which is evenly spread.
Vec jitter(std::size_t sample) {
  const auto part = [sample](double step) {
    const double at = static_cast<double>(sample) * step;
    return at - std::floor(at);
  };
  return {part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703)};
}

CellCount count_cell(const Grid& grid, std::size_t cell, Vec corner, const LabelMap& map,
                     const Groups& groups, const ToIndex& to_index) {
  CellCount count;
  for (std::size_t s = 0; s < kSamples; ++s) {
    const Vec at = corner + (sample_row(s) + jitter(cell * kSamples + s)) * (1.0 / kAcross);
    const std::uint8_t group = group_at(map, groups, to_index, grid.origin_m + at * grid.edge_m);
    count.group[s] = group;
    if (group == 0) continue;
    ++count.samples[group];
    count.inside |= std::uint64_t{1} << s;
  }
  return count;
}

// Keeps the shares of a cell that no group fills alone.
void keep_shares(const CellCount& count, std::size_t cell, Claims& claims) {
  std::uint64_t left = count.inside;
  while (left != 0) {
    const std::uint8_t group = count.group[static_cast<unsigned>(std::countr_zero(left))];
    std::uint64_t own = 0;
    for (std::size_t s = 0; s < kSamples; ++s) {
      own |= static_cast<std::uint64_t>(count.group[s] == group) << s;
    }
    if (own == ~std::uint64_t{0}) return;
    claims.shares.push_back(
        {static_cast<std::uint32_t>(cell), static_cast<std::uint16_t>(group - 1), 0, own});
    left &= ~own;
  }
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
        keep_shares(count, cell, claims);
        for (std::size_t i = 0; i < reports.size(); ++i) {
          reports[i].filled_volume_m3 += count.samples[i + 1] * sample_m3;
        }
      }
    }
  }
  return claims;
}

// The claims of each level; what is reported is that of the finest one.
std::vector<Claims> claim_levels(const Grid& coarsest, std::uint32_t halvings, const LabelMap& map,
                                 const Groups& groups, std::vector<LabelReport>& reports,
                                 const Progress& progress) {
  std::vector<Claims> levels;
  for (const Grid& grid : level_grids(coarsest, halvings)) {
    for (LabelReport& each : reports) each.filled_volume_m3 = 0;
    levels.push_back(claim_labels(grid, map, groups, reports, progress));
  }
  return levels;
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

template <typename Found>  // NamedHull or Target
void warn_of_missing(const std::vector<NamedLabels>& wanted, const std::vector<Found>& found,
                     std::string Found::*name, BuildReport& report) {
  for (const NamedLabels& each : wanted) {
    const bool is_there = std::any_of(found.begin(), found.end(),
                                      [&](const Found& f) { return f.*name == each.name; });
    if (is_there) continue;
    report.warnings.push_back(fmt::format("none of the labels of {} is in the map", each.name));
  }
}

void warn_of_absent(const Recipe& recipe, BuildReport& report) {
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    if (report.labels[i].voxels > 0) continue;
    const std::string& tissue = recipe.groups[i].tissue;
    const auto layer = std::find_if(recipe.wall.begin(), recipe.wall.end(),
                                    [&](const WallLayer& each) { return each.tissue == tissue; });
    report.warnings.push_back(
        layer == recipe.wall.end()
            ? fmt::format("none of the labels of {} is in the map", tissue)
            : fmt::format("layer {}: its {:.3g} mm fall between the voxels of the map, so that no "
                          "voxel holds any of it and no needle feels it: expected a finer map, or "
                          "a thicker layer",
                          tissue, layer->thickness_m * 1e3));
  }
}

// The surface of some groups alone.
Skin skin_of(const LabelMap& map, Groups groups, const std::vector<std::size_t>& wanted) {
  for (std::uint8_t& group : groups) {
    const bool kept = group != 0 && std::ranges::find(wanted, group - 1U) != wanted.end();
    if (!kept) group = 0;
  }
  return label_skin(map, groups);
}

// The surface of all groups; but tissues that slide have one each, because a needle meets both of
// two that lie on each other. `of_group` is filled in for these.
std::vector<Skin> find_skins(const LabelMap& map, const Groups& groups, const Recipe& recipe,
                             const std::vector<Slide>& slides, std::vector<std::size_t>& of_group) {
  std::vector<std::size_t> rest;
  std::vector<Skin> skins;
  of_group.assign(recipe.groups.size(), kNoSkin);
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    const std::string& tissue = recipe.groups[i].tissue;
    const bool slid = std::ranges::any_of(slides, [&](const Slide& slide) {
      return slide.tissue == tissue || slide.ground == tissue;
    });
    if (!slid) {
      rest.push_back(i);
      continue;
    }
    of_group[i] = skins.size();
    skins.push_back(skin_of(map, groups, {i}));
  }
  if (skins.empty()) return {label_skin(map, groups)};
  skins.push_back(skin_of(map, groups, rest));
  return skins;
}

// All skins as one surface, each with its part of the triangles.
Mesh thinned(const std::vector<Skin>& skins, std::uint32_t most_triangles) {
  std::size_t quads = 0;
  for (const Skin& skin : skins) quads += skin.quads.size();
  Mesh all;
  for (const Skin& skin : skins) {
    if (skin.quads.empty()) continue;
    const double part = static_cast<double>(skin.quads.size()) / static_cast<double>(quads);
    const auto most = static_cast<std::size_t>(part * most_triangles);
    add_mesh(all, with_fewer_triangles(triangles_of(skin), most));
  }
  return all;
}

SamplePlaces map_samples() {
  SamplePlaces places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = (sample_row(i) + Vec{0.5, 0.5, 0.5}) * (1.0 / kAcross);
  }
  return places;
}

// Volume of labels that a sample of each group represents.
std::vector<double> sample_volumes(const Grid& grid, BuildReport& report) {
  const double sample_m3 = grid.edge_m * grid.edge_m * grid.edge_m / 64;
  std::vector<double> volumes;
  for (const LabelReport& label : report.labels) {
    const bool sampled = label.filled_volume_m3 > 0;
    volumes.push_back(sampled ? sample_m3 * label.map_volume_m3 / label.filled_volume_m3 : 0);
    const std::string text =
        sampled ? "" : loss("labels of " + label.tissue, label.map_volume_m3, {}, grid.edge_m);
    if (!text.empty()) report.warnings.push_back(text);
  }
  return volumes;
}

void measure_shares(const Claimed& claimed, const LabelMap& map, const Groups& groups,
                    const BuildOptions& options, BuildReport& report) {
  const Claims& claims = claimed.levels.back();
  if (!options.split) report.closed_gaps = closed_gaps(claims, claimed.places);
  const std::size_t count = report.labels.size();
  const std::vector<double> given_m3 = given_volumes_m3(claims, count);
  const std::vector<PieceCount> pieces = label_pieces(claims, map, groups, count);
  for (std::size_t i = 0; i < count; ++i) {
    const LabelReport& label = report.labels[i];
    report.shares.push_back({label.tissue, label.tissue, label.map_volume_m3,
                             label.filled_volume_m3, given_m3[i], pieces[i].pieces,
                             pieces[i].lost});
  }
}

// The membranes of the recipe: smoothed as the surface is.
void add_membranes(const LabelMap& map, const Groups& groups, const Recipe& recipe,
                   std::vector<Membrane>& membranes, std::vector<std::string>& warnings) {
  for (const NamedLabels& border : recipe.membranes) {
    Groups inside(map.label.size(), 0);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const bool wanted = std::find(border.labels.begin(), border.labels.end(), map.label[i]) !=
                          border.labels.end();
      inside[i] = wanted ? 1 : 0;
    }
    Skin skin = label_border(map, inside, groups);
    if (skin.quads.empty()) {
      warnings.push_back(fmt::format(
          "membrane {}: its labels border on no other tissue: expected labels in the map that do",
          border.name));
      continue;
    }
    smooth(skin, recipe.smoothing);
    Membrane membrane;
    membrane.from = "labels";
    membrane.tissue = border.name;
    membrane.mesh_m = triangles_of(skin);
    membranes.push_back(std::move(membrane));
  }
}

}  // namespace

Built build_labels(const std::string& path, const LabelMap& whole, const Recipe& as_read,
                   const BuildOptions& as_given, const Progress& progress) {
  BuildOptions options = as_given;
  const bool crops = !as_read.crop_around.empty(), has_wall = !as_read.wall.empty();
  Recipe recipe = as_read;
  LabelMap part = has_wall ? whole : LabelMap{};
  if (has_wall) progress("growing the wall", 0);
  const std::vector<std::string> of_wall = add_wall(part, recipe);
  if (crops) part = cropped(path, has_wall ? part : whole, recipe);
  const LabelMap& map = crops || has_wall ? part : whole;
  const Groups groups = groups_of(path, map, recipe);
  progress("finding the surface", 0);
  std::vector<std::size_t> skin_of_group;
  std::vector<Skin> skins = find_skins(map, groups, recipe, options.slides, skin_of_group);
  Claimed claimed;
  Built built;
  built.report.warnings = whole.notes;
  built.report.warnings.insert(built.report.warnings.end(), of_wall.begin(), of_wall.end());
  built.obstacles = find_obstacles(path, map, recipe, groups);
  built.targets = find_targets(map, recipe);
  warn_of_targets(built.targets, built.report.warnings);
  for (Skin& skin : skins) {
    for (const Vec& point : skin.points) grow(claimed.box, point);
    if (options.measured) add_mesh(built.input_m, triangles_of(skin));
    smooth(skin, recipe.smoothing);
  }
  add_membranes(map, groups, recipe, options.membranes, built.report.warnings);
  progress("thinning the surface", 0);
  claimed.mesh = thinned(skins, recipe.most_triangles);
  for (const Vec& point : claimed.mesh.points) grow(claimed.box, point);
  warn_of_size(claimed.box, built.report.warnings);
  built.report.labels = label_reports(map, groups, recipe);
  claimed.places = map_samples();
  for (const LabelGroup& group : recipe.groups) claimed.tissues.push_back(group.tissue);
  for (const std::size_t skin : skin_of_group) {
    claimed.surface_m.push_back(skin == kNoSkin ? Mesh{} : triangles_of(skins[skin]));
  }
  const std::uint32_t halvings = most_halvings(options.refinements);
  const double edge_m = choose_edge(claimed.box, options, [&](double each_m) {
    std::vector<LabelReport> unused = built.report.labels;
    Claimed tried = claimed;
    tried.levels =
        claim_levels(make_grid(claimed.box, each_m), halvings, map, groups, unused, progress);
    return swept_voxels(std::move(tried), options, progress);
  });
  const Grid grid = make_grid(claimed.box, edge_m);
  warn_of_absent(recipe, built.report);
  warn_of_missing(recipe.obstacles, built.obstacles, &NamedHull::obstacle, built.report);
  warn_of_missing(recipe.targets, built.targets, &Target::name, built.report);
  claimed.levels = claim_levels(grid, halvings, map, groups, built.report.labels, progress);
  if (options.measured) measure_shares(claimed, map, groups, options, built.report);
  claimed.sources = {{std::filesystem::path(path).filename().string(), "labels", map.sha256, 1e-3,
                      0, static_cast<std::uint32_t>(claimed.mesh.triangles.size())}};
  cut_away(claimed, options);
  warn_of_obstacles(built.obstacles, built.report.warnings);
  claimed.sample_m3 = sample_volumes(claimed.levels.back().grid, built.report);
  built.bytes = assemble(std::move(claimed), options, built.report.warnings, progress);
  return built;
}

}  // namespace stylet::offline
