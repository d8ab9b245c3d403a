// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/settings.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "base/refusal.h"
#include "pipeline/membranes.h"
#include "pipeline/refine.h"
#include "pipeline/slides.h"
#include "voxels/crop.h"

namespace stylet::offline {
namespace {

// The region without folders, so that the organ's bytes do not depend on where files lie.
std::string without_folder(const std::string& fix) {
  const std::string word = "touching:";
  if (!fix.starts_with(word)) return fix;
  return word + std::filesystem::path(fix.substr(word.size())).filename().string();
}

template <typename HaveTissue>  // inputs, or groups of labels
std::vector<std::string> names_of_tissues(const std::vector<HaveTissue>& sources) {
  std::vector<std::string> tissues;
  for (const HaveTissue& source : sources) tissues.push_back(source.tissue);
  return tissues;
}

void choose_gaps(const Settings& s, BuildOptions& options) {
  options.split = s.split_gaps;
  if (s.split_gaps) options.options_text += " --split-gaps";
  if (s.fill_gaps.empty()) return;
  const std::vector<Layer> gap = parse_layers({s.fill_gaps}, "--fill-gaps");
  constexpr double kWidestGapM = 0.1;  // wider gaps separate organs, not just their meshes
  if (gap.front().thickness_m > kWidestGapM) {
    refuse("--fill-gaps '{}': expected a width of more than 0 and at most {:g} mm", s.fill_gaps,
           kWidestGapM * 1e3);
  }
  options.gap_tissue = find_tissue(options.own_tissues, gap.front().tissue).name;
  options.gap_m = gap.front().thickness_m;
  options.options_text += " --fill-gaps " + s.fill_gaps;
}

LayerCourse parse_course(const Settings& s, const std::string& of) {
  const std::string& along = s.layers_along;
  if (along.size() != 2 || (along[0] != '+' && along[0] != '-') || along[1] < 'x' ||
      along[1] > 'z') {
    refuse("--layers-along '{}': expected one of +x, -x, +y, -y, +z, -z", along);
  }
  return {static_cast<std::size_t>(along[1] - 'x'), along[0] == '-', of};
}

// The layers, and the tissue of the inputs that they replace: theirs, if all have the same.
void choose_layers(const Settings& s, const std::vector<std::string>& tissues,
                   BuildOptions& options) {
  options.layers = parse_layers(s.layers, "--layer");
  if (s.layers.empty() && s.layers_of.empty()) return;
  const bool is_one = std::set<std::string>(tissues.begin(), tissues.end()).size() == 1;
  const std::string of = s.layers_of.empty() && is_one ? tissues.front() : s.layers_of;
  if (s.layers.empty() || std::find(tissues.begin(), tissues.end(), of) == tissues.end()) {
    refuse("--layers-of '{}': expected the tissue of one of the inputs, together with --layer", of);
  }
  options.layer_course = parse_course(s, of);
  options.options_text += fmt::format(" --layers-of {} --layers-along {} --layer {}", of,
                                      s.layers_along, joined(s.layers));
}

// A file that says its unit is built in that unit again only without the option.
std::string units_text(const Settings& s, const std::vector<Input>& inputs) {
  if (!s.units.empty()) return " --units " + s.units;
  const auto says = [](const Input& input) { return input.read.metres_per_unit.has_value(); };
  return std::ranges::any_of(inputs, says) ? "" : " --units mm";
}

// Refused with the name of the recipe, which names the tissue.
std::string tissue_of_recipe(const BuildOptions& options, const LabelSource& source,
                             const std::string& name) try {
  return find_tissue(options.own_tissues, name).name;
} catch (const Refusal& refusal) {
  refuse("{}: {}", source.recipe_text, refusal.what());
}

}  // namespace

void settle_places(const std::vector<std::string>& tissues, BuildOptions& options) {
  check_slides(options, tissues);
  check_refinements(options, tissues);
  for (const Refinement& each : options.refinements) {
    options.options_text += " --refine " + text_of(each);
  }
}

const char* tool_version() {
  return "stylet-organ " STYLET_VERSION;
}

MeshUnits units_of(const Settings& s) {
  MeshUnits units{.scale = s.scale};
  if (!s.units.empty()) units.given_m = kMetresPerUnit.at(s.units);
  return units;
}

BuildOptions common_options(const Settings& s, const MeshUnits& units) {
  BuildOptions options;
  options.name = s.name;
  options.voxel_edge_m = s.voxel_mm * 1e-3;
  require_voxel_edge(options.voxel_edge_m);
  options.voxels_across = s.voxels_across;
  options.held = parse_regions(s.fix, units);
  options.crop = parse_crop(s.crop);
  if (!s.materials.empty()) options.own_tissues = read_tissues(s.materials);
  options.membranes = parse_membranes(s.membranes, units);
  for (const Membrane& membrane : options.membranes) {
    (void)find_tissue(options.own_tissues, membrane.tissue);
  }
  options.slides = parse_slides(s.slides);
  for (const std::string& text : s.refine) {
    options.refinements.push_back(parse_refinement(text, "--refine"));
  }
  options.tool_version = tool_version();
  options.options_text = s.voxels_across > 0 ? fmt::format("--voxels-across {}", s.voxels_across)
                         : !s.fit.empty()    ? "--fit " + s.fit
                                             : fmt::format("--voxel-mm {}", s.voxel_mm);
  for (const std::string& fix : s.fix) options.options_text += " --fix " + without_folder(fix);
  for (const std::string& crop : s.crop) options.options_text += " --crop " + crop;
  for (const Membrane& membrane : options.membranes) {
    options.options_text += fmt::format(" --membrane {}:{}", membrane.from, membrane.tissue);
  }
  for (const Slide& slide : options.slides) options.options_text += " --slide " + text_of(slide);
  if (!s.materials.empty()) {
    options.options_text +=
        " --materials " + std::filesystem::path(s.materials).filename().string();
  }
  return options;
}

std::vector<Layer> parse_layers(const std::vector<std::string>& texts, const char* option) {
  std::vector<Layer> layers;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    double mm = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(
        text.data() + (colon == std::string::npos ? text.size() : colon + 1), end, mm);
    if (error != std::errc{} || read != end || !(mm > 0)) {
      refuse("{} '{}': expected TISSUE:MM", option, text);
    }
    layers.push_back({mm * 1e-3, text.substr(0, colon)});
  }
  return layers;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& t : texts) text += (text.empty() ? "" : " ") + t;
  return text;
}

void choose_capsule(const Settings& s, const std::vector<std::string>& tissues,
                    BuildOptions& options) {
  const bool all_layers = !options.layers.empty() && options.layer_course.of.empty();
  const bool any_liver = std::find(tissues.begin(), tissues.end(), "liver") != tissues.end();
  if (s.capsule == "auto") {
    options.capsule = any_liver && !all_layers ? "liver_capsule" : "";
    options.capsule_of = "liver";
  } else {
    options.capsule = s.capsule == "none" ? "" : s.capsule;
  }
  options.options_text += " --capsule " + (options.capsule.empty() ? "none" : options.capsule);
}

void choose_for_labels(const Settings& s, const LabelSource& source, const Recipe& recipe,
                       BuildOptions& options) {
  std::vector<std::string> tissues = names_of_tissues(recipe.groups);
  for (const std::string& tissue : tissues) (void)tissue_of_recipe(options, source, tissue);
  for (const NamedLabels& border : recipe.membranes) {
    (void)tissue_of_recipe(options, source, border.name);
  }
  for (const WallLayer& layer : recipe.wall) {
    options.wall.push_back(tissue_of_recipe(options, source, layer.tissue));
  }
  options.options_text += " --recipe " + source.recipe_text;
  if (options.name.empty()) {
    const std::string file = std::filesystem::path(source.path).filename().string();
    options.name = file.substr(0, file.find('.'));
  }
  choose_gaps(s, options);
  options.split = options.split || recipe.open_gaps;
  choose_layers(s, tissues, options);
  choose_capsule(s, tissues, options);
  std::ranges::copy(recipe.slides, std::back_inserter(options.slides));
  std::ranges::copy(recipe.refinements, std::back_inserter(options.refinements));
  for (const WallLayer& layer : recipe.wall) tissues.push_back(layer.tissue);
  settle_places(tissues, options);
}

void choose_for_meshes(const Settings& s, const std::vector<Input>& inputs, BuildOptions& options) {
  options.wrap = s.wrap;
  options.options_text += units_text(s, inputs);
  options.options_text += fmt::format(" --scale {}{}", s.scale, s.wrap ? " --wrap" : "");
  if (options.name.empty()) {
    options.name = std::filesystem::path(inputs.front().path).stem().string();
  }
  const std::vector<std::string> tissues = names_of_tissues(inputs);
  choose_gaps(s, options);
  choose_layers(s, tissues, options);
  choose_capsule(s, tissues, options);
  settle_places(tissues, options);
}

}  // namespace stylet::offline
