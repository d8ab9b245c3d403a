// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/recipe.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/refusal.h"
#include "maps/names.h"
#include "maps/recipe_table.h"

namespace stylet::offline {
namespace {

const toml::table& table_of(const std::string& file, const toml::table& root, const char* key) {
  const toml::node* node = root.get(key);
  if (node == nullptr || !node->is_table()) refuse("{}: expected a table [{}]", file, key);
  return *node->as_table();
}

std::uint16_t label_of(const std::string& file, const std::string& key, const toml::node& node) {
  const auto number = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
  if (!number || *number < 1 || *number > 65535) {
    refuse("{}: {}: expected a label from 1 to 65535", place_of(file, node), key);
  }
  return static_cast<std::uint16_t>(*number);
}

void read_names(const std::string& file, const toml::table& table, Recipe& recipe) {
  for (const auto& [key, node] : table) {
    const std::uint16_t label = label_of(file, std::string(key.str()), node);
    const auto [named, is_new] = recipe.names.emplace(label, std::string(key.str()));
    if (!is_new) {
      refuse("{}: {}: label {} is {} already: expected one name for each", place_of(file, node),
             key.str(), label, named->second);
    }
  }
}

// The file that a recipe is read from, and the names in the map that it is for.
struct Source {
  const std::string& file;
  const FileNames& of_map;
};

std::string listed(const std::map<std::uint16_t, std::string>& names) {
  std::string list;
  for (const auto& [label, name] : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

// The label with this name in the recipe's [names], else all labels so named in the map's file.
std::vector<std::uint16_t> named_labels(const Source& source, const Recipe& recipe,
                                        const toml::node& node) {
  const std::string name = *node.value<std::string>();
  const auto found = std::find_if(recipe.names.begin(), recipe.names.end(),
                                  [&](const auto& each) { return each.second == name; });
  if (found != recipe.names.end()) return {found->first};
  std::vector<std::uint16_t> labels = labels_named(source.of_map.names, name);
  if (!labels.empty()) return labels;
  refuse("{}: {}: expected one of the names of this recipe{}", place_of(source.file, node), name,
         source.of_map.names.empty()
             ? ""
             : fmt::format(", or of {}: {}", source.of_map.path, listed(source.of_map.names)));
}

std::vector<std::uint16_t> any_labels(const Source& source, const std::string& key,
                                      const Recipe& recipe, const toml::node& node) {
  if (node.is_string()) return named_labels(source, recipe, node);
  return {label_of(source.file, key, node)};
}

// Refuses a label for which recipe and map file have different names.
void check_name(const Source& source, const Recipe& recipe, std::uint16_t label) {
  const auto here = recipe.names.find(label);
  const auto& there = source.of_map.names;
  if (here == recipe.names.end() || there.empty()) return;
  const auto called = there.find(label);
  if (called != there.end() && is_same_name(called->second, here->second)) return;
  const std::vector<std::uint16_t> others = labels_named(there, here->second);
  if (called == there.end() && others.empty()) return;
  refuse(
      "{}: [names]: {} = {}: in {} {}: expected the same in both; to go by the map's names, take "
      "this one out of [names]",
      source.file, here->second, label, source.of_map.path,
      called != there.end() ? fmt::format("label {} is called {}", label, called->second)
                            : fmt::format("{} is label {}", here->second, others.front()));
}

void check_names(const Source& source, const Recipe& recipe) {
  const auto check = [&](const auto& labels) {
    for (const std::uint16_t label : labels) check_name(source, recipe, label);
  };
  check(recipe.crop_around);
  for (const LabelGroup& group : recipe.groups) check(group.labels);
  for (const NamedLabels& body : recipe.obstacles) check(body.labels);
  for (const NamedLabels& body : recipe.targets) check(body.labels);
  for (const NamedLabels& border : recipe.membranes) check(border.labels);
}

double number_of(const std::string& file, const char* key, const toml::node& node, double most) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= 0 && *value <= most)) {
    refuse("{}: {}: expected a number from 0 to {}", place_of(file, node), key, most);
  }
  return *value;
}

void read_crop(const Source& source, const toml::table& table, Recipe& recipe) {
  constexpr double kMostMarginMm = 1000;
  const std::string& file = source.file;
  for (const auto& [key, node] : table) {
    if (key == "margin_mm") {
      recipe.crop_margin_m = number_of(file, "margin_mm", node, kMostMarginMm) * 1e-3;
    } else if (key == "around" && node.is_array()) {
      for (const toml::node& each : *node.as_array()) {
        for (const std::uint16_t label : any_labels(source, "around", recipe, each)) {
          recipe.crop_around.push_back(label);
        }
      }
    } else {
      refuse("{}: {}: expected around = [LABEL...] or margin_mm", place_of(file, node), key.str());
    }
  }
  if (recipe.crop_around.empty()) refuse("{}: [crop]: expected around = [LABEL...]", file);
}

void read_surface(const std::string& file, const toml::table& table, Recipe& recipe) {
  constexpr double kMostRounds = 100;
  constexpr std::uint32_t kFewestTriangles = 1000;
  for (const auto& [key, node] : table) {
    if (key == "smoothing" && node.is_integer()) {
      recipe.smoothing = static_cast<int>(number_of(file, "smoothing", node, kMostRounds));
    } else if (key == "triangles" && node.is_integer()) {
      recipe.most_triangles =
          static_cast<std::uint32_t>(number_of(file, "triangles", node, kMaxTriangles));
      if (recipe.most_triangles < kFewestTriangles) {
        refuse("{}: triangles: expected {} or more", place_of(file, node), kFewestTriangles);
      }
    } else {
      refuse("{}: {}: expected smoothing = or triangles = a whole number", place_of(file, node),
             key.str());
    }
  }
}

void read_contact(const std::string& file, const toml::table& table, Recipe& recipe) {
  for (const auto& [key, node] : table) {
    const std::string value = node.value<std::string>().value_or("");
    if (key == "touching" && value == "shared") continue;
    if (key == "touching") {
      refuse(
          "{}: touching: expected \"shared\": organs that touch share particles; what slides is "
          "a [[slide]]",
          place_of(file, node));
    }
    if (key != "gaps" || (value != "open" && value != "closed")) {
      refuse("{}: {}: expected gaps = \"open\" or \"closed\", touching = \"shared\"",
             place_of(file, node), key.str());
    }
    recipe.open_gaps = value == "open";
  }
}

// Each entry is NAME = [LABEL...]; names become parts of file names.
std::vector<NamedLabels> read_named(const Source& source, const toml::table& table,
                                    const Recipe& recipe) {
  const std::string& file = source.file;
  std::vector<NamedLabels> list;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (!plain) {
      refuse("{}: {}: expected a name of letters, digits, _ and -", place_of(file, node), name);
    }
    const toml::array* labels = node.as_array();
    if (labels == nullptr || labels->empty()) {
      refuse("{}: {}: expected a list of labels", place_of(file, node), name);
    }
    list.push_back({name, {}});
    for (const toml::node& each : *labels) {
      for (const std::uint16_t label : any_labels(source, name, recipe, each)) {
        list.back().labels.push_back(label);
      }
    }
  }
  return list;
}

// The layers of [[wall]], from the inside out.
std::vector<WallLayer> read_wall(const std::string& file, const toml::node& node) {
  constexpr double kMostMm = 200;
  const char* const wanted = "{}: [[wall]]: expected tissue = \"NAME\" and thickness_mm, each";
  if (!node.is_array_of_tables()) refuse(fmt::runtime(wanted), place_of(file, node));
  std::vector<WallLayer> wall;
  for (const toml::node& each : *node.as_array()) {
    const toml::table& layer = *each.as_table();
    const toml::node* tissue = layer.get("tissue");
    const toml::node* thickness = layer.get("thickness_mm");
    if (layer.size() != 2 || tissue == nullptr || !tissue->is_string() || thickness == nullptr) {
      refuse(fmt::runtime(wanted), place_of(file, each));
    }
    wall.push_back({*tissue->value<std::string>(),
                    number_of(file, "thickness_mm", *thickness, kMostMm) * 1e-3});
  }
  return wall;
}

std::vector<Slide> read_slides(const std::string& file, const toml::node& node) {
  const char* const wanted =
      "{}: [[slide]]: expected tissue = \"NAME\" and on = \"NAME\", each, and maybe friction";
  if (!node.is_array_of_tables()) refuse(fmt::runtime(wanted), place_of(file, node));
  std::vector<Slide> slides;
  for (const toml::node& each : *node.as_array()) {
    const toml::table& table = *each.as_table();
    const toml::node* tissue = table.get("tissue");
    const toml::node* ground = table.get("on");
    const toml::node* friction = table.get("friction");
    const std::size_t known = friction == nullptr ? 2 : 3;
    if (table.size() != known || tissue == nullptr || !tissue->is_string() || ground == nullptr ||
        !ground->is_string()) {
      refuse(fmt::runtime(wanted), place_of(file, each));
    }
    slides.push_back({*tissue->value<std::string>(), *ground->value<std::string>(), kUsualFriction,
                      place_of(file, each) + ": [[slide]]"});
    if (friction == nullptr) continue;
    slides.back().friction =
        number_of(file, "friction", *friction, static_cast<double>(kMaxSlideFriction));
  }
  return slides;
}

std::vector<Refinement> read_refinements(const std::string& file, const toml::table& table) {
  const toml::node* where = table.get("where");
  const bool is_list = where != nullptr && where->is_array() && table.size() == 1;
  if (!is_list) refuse("{}: [refine]: expected where = [TEXT...]", place_of(file, table));
  std::vector<Refinement> refinements;
  for (const toml::node& each : *where->as_array()) {
    const std::string place = place_of(file, each) + ": [refine]";
    if (!each.is_string()) refuse("{}: where: expected a list of texts", place);
    refinements.push_back(parse_refinement(*each.value<std::string>(), place));
  }
  return refinements;
}

// Refuses labels that are both obstacle and tissue, since no needle enters an obstacle.
void check_obstacles(const std::string& file, const Recipe& recipe) {
  if (recipe.obstacles.size() > kMaxObstacles) {
    refuse("{}: [obstacles]: {} bodies: expected at most {}", file, recipe.obstacles.size(),
           kMaxObstacles);
  }
  for (const NamedLabels& body : recipe.obstacles) {
    for (const LabelGroup& group : recipe.groups) {
      for (const std::uint16_t label : body.labels) {
        if (std::find(group.labels.begin(), group.labels.end(), label) == group.labels.end())
          continue;
        refuse("{}: [obstacles]: {}: label {} is {} already: expected a label of no tissue", file,
               body.name, label, group.tissue);
      }
    }
  }
}

void take_label(const std::string& file, const toml::node& node, std::uint16_t label,
                Recipe& recipe) {
  for (const LabelGroup& group : recipe.groups) {
    if (std::find(group.labels.begin(), group.labels.end(), label) == group.labels.end()) continue;
    refuse("{}: {}: label {} is {} already: expected it once", place_of(file, node),
           recipe.groups.back().tissue, label, group.tissue);
  }
  recipe.groups.back().labels.push_back(label);
}

void read_group(const Source& source, const std::string& tissue, const toml::node& node,
                Recipe& recipe) {
  const std::string& file = source.file;
  const toml::array* labels = node.as_array();
  if (labels == nullptr || labels->empty()) {
    refuse("{}: {}: expected a list of labels", place_of(file, node), tissue);
  }
  recipe.groups.push_back({tissue, {}});
  for (const toml::node& each : *labels) {
    for (const std::uint16_t label : any_labels(source, tissue, recipe, each)) {
      take_label(file, each, label, recipe);
    }
  }
}

// Refuses what no scene takes.
void check_targets(const std::string& file, const toml::table& table) {
  constexpr std::size_t kMostTargets = 32, kMostNameBytes = 40;  // as hal/scene has them
  if (table.size() > kMostTargets) {
    refuse("{}: [targets]: {} targets: expected at most {}", place_of(file, table), table.size(),
           kMostTargets);
  }
  for (const auto& [key, node] : table) {
    if (key.str().size() <= kMostNameBytes) continue;
    refuse("{}: {}: expected a name of at most {} bytes", place_of(file, node), key.str(),
           kMostNameBytes);
  }
}

}  // namespace

Recipe recipe_of(const toml::table& root, const std::string& file, const FileNames& of_map) {
  const Source source = {file, of_map};
  Recipe recipe;
  for (const auto& [key, node] : root) {
    constexpr std::string_view kTables[] = {"names",   "tissues",   "crop",  "surface",
                                            "wall",    "contact",   "slide", "obstacles",
                                            "targets", "membranes", "refine"};
    if (std::find(std::begin(kTables), std::end(kTables), key.str()) == std::end(kTables)) {
      refuse(
          "{}: {}: expected [names], [tissues], [crop], [surface], [[wall]], [contact], "
          "[[slide]], [refine], [obstacles], [targets] or [membranes]",
          place_of(file, node), key.str());
    }
  }
  if (root.contains("names")) read_names(file, table_of(file, root, "names"), recipe);
  if (root.contains("crop")) read_crop(source, table_of(file, root, "crop"), recipe);
  if (root.contains("surface")) read_surface(file, table_of(file, root, "surface"), recipe);
  if (root.contains("contact")) read_contact(file, table_of(file, root, "contact"), recipe);
  if (root.contains("wall")) recipe.wall = read_wall(file, *root.get("wall"));
  if (root.contains("slide")) recipe.slides = read_slides(file, *root.get("slide"));
  if (root.contains("refine")) {
    recipe.refinements = read_refinements(file, table_of(file, root, "refine"));
  }
  for (const auto& [key, list] :
       {std::pair{"obstacles", &recipe.obstacles}, std::pair{"targets", &recipe.targets},
        std::pair{"membranes", &recipe.membranes}}) {
    if (root.contains(key)) *list = read_named(source, table_of(file, root, key), recipe);
  }
  if (root.contains("targets")) check_targets(file, table_of(file, root, "targets"));
  for (const auto& [key, node] : table_of(file, root, "tissues")) {
    read_group(source, std::string(key.str()), node, recipe);
  }
  if (recipe.groups.empty()) refuse("{}: [tissues]: expected at least one", file);
  check_obstacles(file, recipe);
  check_names(source, recipe);
  return recipe;
}

Recipe read_recipe(const std::filesystem::path& toml_file, const FileNames& of_map) {
  return recipe_of(read_toml(toml_file), toml_file.string(), of_map);
}

}  // namespace stylet::offline
