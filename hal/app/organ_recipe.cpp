// SPDX-License-Identifier: Apache-2.0
#include "hal/app/organ_recipe.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

namespace stylet::app {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string safe = word;
  replace_all(safe, "'", "'\\''");
  return fmt::format("'{}'", safe);
}

// The one beside this program if it is there, since the folder need not be in PATH.
std::string builder() {
  std::error_code error;
  const fs::path beside =
      fs::read_symlink("/proc/self/exe", error).replace_filename("stylet-organ");
  return fs::exists(beside, error) ? beside.string() : "stylet-organ";
}

// Folder of the meshes: STYLET_DATA, else where it lies beside a clone, as in hal/scenes/play.py.
std::string data_folder(const fs::path& scenes) {
  if (const char* given = std::getenv("STYLET_DATA"); given != nullptr) return given;
  return fs::weakly_canonical(scenes / "../../../shared/data").string();
}

}  // namespace

std::string organ_command(const hal::Scene& scene, const std::string& organ) {
  constexpr std::string_view kRecipe = "# organ: stylet-organ ";
  const std::size_t at = ("\n" + scene.text).find("\n" + std::string(kRecipe));
  if (at == std::string::npos) return "";
  const std::size_t start = at + kRecipe.size();
  std::istringstream recipe(scene.text.substr(start, scene.text.find('\n', start) - start));
  const fs::path scenes = fs::absolute(scene.file).parent_path();
  std::string command = shell_word(builder());
  for (std::string word; recipe >> word;) {
    replace_all(word, "{data}", data_folder(scenes));
    replace_all(word, "{scenes}", scenes.string());
    command += fmt::format(" {}", shell_word(word));
  }
  return fmt::format("{} -o {}", command, shell_word(organ));
}

}  // namespace stylet::app
