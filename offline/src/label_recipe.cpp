// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_recipe.h"

#include <algorithm>

#include "refusal.h"
#include "toml_file.h"

namespace stylet::bake {
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

std::uint16_t named_label(const std::string& file, const Recipe& recipe, const toml::node& node) {
  const std::string name = *node.value<std::string>();
  const auto found = std::find_if(recipe.names.begin(), recipe.names.end(),
                                  [&](const auto& each) { return each.second == name; });
  if (found == recipe.names.end()) {
    refuse("{}: {}: expected one of the names of this recipe", place_of(file, node), name);
  }
  return found->first;
}

std::uint16_t any_label(const std::string& file, const std::string& key, const Recipe& recipe,
                        const toml::node& node) {
  return node.is_string() ? named_label(file, recipe, node) : label_of(file, key, node);
}

double number_of(const std::string& file, const char* key, const toml::node& node, double most) {
  const std::optional<double> value = node.value<double>();
  if (!node.is_number() || !value || !(*value >= 0 && *value <= most)) {
    refuse("{}: {}: expected a number from 0 to {}", place_of(file, node), key, most);
  }
  return *value;
}

void read_crop(const std::string& file, const toml::table& table, Recipe& recipe) {
  constexpr double kMostMarginMm = 1000;
  for (const auto& [key, node] : table) {
    if (key == "margin_mm") {
      recipe.crop_margin_m = number_of(file, "margin_mm", node, kMostMarginMm) * 1e-3;
    } else if (key == "around" && node.is_array()) {
      for (const toml::node& each : *node.as_array()) {
        recipe.crop_around.push_back(any_label(file, "around", recipe, each));
      }
    } else {
      refuse("{}: {}: expected around = [LABEL...] or margin_mm", place_of(file, node), key.str());
    }
  }
  if (recipe.crop_around.empty()) refuse("{}: [crop]: expected around = [LABEL...]", file);
}

void read_surface(const std::string& file, const toml::table& table, Recipe& recipe) {
  constexpr double kMostRounds = 100;
  for (const auto& [key, node] : table) {
    if (key != "smoothing" || !node.is_integer()) {
      refuse("{}: {}: expected smoothing = a whole number", place_of(file, node), key.str());
    }
    recipe.smoothing = static_cast<int>(number_of(file, "smoothing", node, kMostRounds));
  }
}

void read_group(const std::string& file, const std::string& tissue, const toml::node& node,
                Recipe& recipe) {
  const toml::array* labels = node.as_array();
  if (labels == nullptr || labels->empty()) {
    refuse("{}: {}: expected a list of labels", place_of(file, node), tissue);
  }
  recipe.groups.push_back({tissue, {}});
  for (const toml::node& each : *labels) {
    const std::uint16_t label = any_label(file, tissue, recipe, each);
    for (const LabelGroup& group : recipe.groups) {
      if (std::find(group.labels.begin(), group.labels.end(), label) == group.labels.end())
        continue;
      refuse("{}: {}: label {} is {} already: expected it once", place_of(file, each), tissue,
             label, group.tissue);
    }
    recipe.groups.back().labels.push_back(label);
  }
}

}  // namespace

Recipe read_recipe(const std::filesystem::path& toml_file) {
  const std::string file = toml_file.string();
  const toml::table root = read_toml(toml_file);
  Recipe recipe;
  for (const auto& [key, node] : root) {
    if (key != "names" && key != "tissues" && key != "crop" && key != "surface") {
      refuse("{}: {}: expected [names] or [tissues], [crop] or [surface]", place_of(file, node),
             key.str());
    }
  }
  if (root.contains("names")) read_names(file, table_of(file, root, "names"), recipe);
  if (root.contains("crop")) read_crop(file, table_of(file, root, "crop"), recipe);
  if (root.contains("surface")) read_surface(file, table_of(file, root, "surface"), recipe);
  for (const auto& [key, node] : table_of(file, root, "tissues")) {
    read_group(file, std::string(key.str()), node, recipe);
  }
  if (recipe.groups.empty()) refuse("{}: [tissues]: expected at least one", file);
  return recipe;
}

}  // namespace stylet::bake
