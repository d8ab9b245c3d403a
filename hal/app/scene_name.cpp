// SPDX-License-Identifier: Apache-2.0
#include "hal/app/scene_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "hal/app/commands.h"
#include "hal/app/organ_command.h"
#include "hal/app/own_program.h"
#include "hal/scene/scene.h"

namespace stylet::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".toml";

// Empty: this program lies alone.
fs::path scenes_folder() {
  std::error_code error;
  const fs::path bin = own_program().parent_path();
  for (const char* from_bin : {"../share/stylet/hal/scenes", "../../../hal/scenes"}) {
    const fs::path folder = fs::weakly_canonical(bin / from_bin, error);
    if (fs::is_directory(folder, error)) return folder;
  }
  return {};
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& each : fs::directory_iterator(scenes_folder(), error)) {
    const fs::path& path = each.path();
    if (path.extension() == kEnding && has_organ_command(text_of(path)))
      names.push_back(path.stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// The comment that the file begins with, to the end of its first sentence.
std::string first_sentence(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line) && line.starts_with("# ");) {
    if (has_organ_command(line)) break;
    all += line.substr(1);
  }
  all.erase(0, 1);
  // Not "Fig. 2": a sentence is followed by another, which begins with a capital.
  for (std::size_t at = all.find(". "); at != std::string::npos; at = all.find(". ", at + 1)) {
    if (all[at + 2] >= 'A' && all[at + 2] <= 'Z') return all.substr(0, at + 1);
  }
  return all;
}

}  // namespace

std::string scene_file(const std::string& given) {
  std::error_code error;
  const fs::path path = given;
  if (fs::exists(path, error) || path.has_parent_path() || path.extension() == kEnding) {
    return given;
  }
  const std::vector<std::string> names = scene_names();
  if (names.empty()) return given;
  if (std::find(names.begin(), names.end(), given) == names.end()) {
    std::string known;
    for (const std::string& name : names) known += name + " ";
    throw hal::SceneError(
        fmt::format("{}: no such file, and no scene of this name: there are {}", given, known));
  }
  return (scenes_folder() / (given + kEnding)).string();
}

bool comes_with_stylet(const std::string& scene_file) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(scene_file), error).parent_path();
  return !folder.empty() && folder == scenes_folder();
}

int list_scenes(bool json) {
  const fs::path folder = scenes_folder();
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& name : scene_names()) {
    const std::string file = folder / (name + kEnding);
    const std::string shows = first_sentence(text_of(file));
    all.push_back({{"name", name}, {"file", file}, {"shows", shows}});
    if (!json) fmt::print("{:<28}{}\n", name, shows);
  }
  if (json) fmt::print("{}\n", all.dump());
  return kExitOk;
}

int tell_organ(const std::string& given) {
  fmt::print("{}\n", organ_of_scene(hal::read_scene(scene_file(given))));
  return kExitOk;
}

}  // namespace stylet::app
