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

void read_group(const std::string& file, const std::string& tissue, const toml::node& node,
                Recipe& recipe) {
  const toml::array* labels = node.as_array();
  if (labels == nullptr || labels->empty()) {
    refuse("{}: {}: expected a list of labels", place_of(file, node), tissue);
  }
  recipe.groups.push_back({tissue, {}});
  for (const toml::node& each : *labels) {
    const std::uint16_t label =
        each.is_string() ? named_label(file, recipe, each) : label_of(file, tissue, each);
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
    if (key != "names" && key != "tissues") {
      refuse("{}: {}: expected [names] or [tissues]", place_of(file, node), key.str());
    }
  }
  if (root.contains("names")) read_names(file, table_of(file, root, "names"), recipe);
  for (const auto& [key, node] : table_of(file, root, "tissues")) {
    read_group(file, std::string(key.str()), node, recipe);
  }
  if (recipe.groups.empty()) refuse("{}: [tissues]: expected at least one", file);
  return recipe;
}

}  // namespace stylet::bake
