// SPDX-License-Identifier: Apache-2.0
#include "hal/app/organ_command.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>
#include <vector>

#include "hal/app/own_program.h"
#include "hal/app/scene_name.h"
#include "hal/base/input_file.h"

namespace stylet::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOrganCommand = "# organ: stylet-organ ";
constexpr std::string_view kData = "{data}";

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
  const fs::path beside = own_program().replace_filename("stylet-organ");
  return fs::exists(beside, error) ? beside.string() : "stylet-organ";
}

// Folder of the meshes: STYLET_DATA, else where it lies beside a clone, as in hal/scenes/play.py.
std::string data_folder(const fs::path& scenes) {
  if (const char* given = std::getenv("STYLET_DATA"); given != nullptr) return given;
  return fs::weakly_canonical(scenes / "../../../shared/data").string();
}

// The command after the mark; empty: the scene has none.
std::string organ_command_of(const std::string& scene_text) {
  std::istringstream lines(scene_text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kOrganCommand)) return line.substr(kOrganCommand.size());
  }
  return "";
}

// Program and arguments; `organ` is the file that they make.
std::vector<std::string> words_of(const hal::Scene& scene, const std::string& organ) {
  const fs::path scenes = fs::absolute(scene.file).parent_path();
  std::vector<std::string> words = {builder()};
  std::istringstream command(organ_command_of(scene.text));
  for (std::string word; command >> word;) {
    replace_all(word, kData, data_folder(scenes));
    replace_all(word, "{scenes}", scenes.string());
    words.push_back(word);
  }
  words.insert(words.end(), {"-o", organ});
  return words;
}

// As a shell takes it.
std::string command_of(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) {
    if (!command.empty()) command += ' ';
    command += shell_word(word);
  }
  return command;
}

// Named by its command and the version, so that another command or version makes another organ.
fs::path kept_organ(const hal::Scene& scene) {
  const char* const caches = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  fs::path top;
  if (caches != nullptr && fs::path(caches).is_absolute()) {
    top = caches;
  } else if (home != nullptr && fs::path(home).is_absolute()) {
    top = fs::path(home) / ".cache";
  } else {
    throw hal::SceneError(fmt::format(
        "{}: HOME and XDG_CACHE_HOME are not set: expected one of them, to keep the scene's organ "
        "there, or an organ file by --organ",
        scene.file));
  }
  const std::string made_by = fmt::format("{} {}", STYLET_VERSION, organ_command_of(scene.text));
  const std::size_t key = std::hash<std::string>()(made_by);
  return top / "stylet/organs" /
         fmt::format("{}-{:016x}.organ", fs::path(scene.file).stem().string(), key);
}

// Runs a program; its output goes to standard error, for whoever waits. Returns what went wrong.
std::string run_program(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return std::strerror(error);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("exit code {}", WEXITSTATUS(status));
}

void require_meshes(const hal::Scene& scene) {
  if (organ_command_of(scene.text).find(kData) == std::string::npos) return;
  std::error_code error;
  const std::string folder = data_folder(fs::absolute(scene.file).parent_path());
  if (fs::is_directory(folder, error)) return;
  throw hal::SceneError(fmt::format(
      "{}: its organ is made of meshes that do not come with Stylet: expected STYLET_DATA to name "
      "their folder; there is no folder {}",
      scene.file, folder));
}

// The installed organ, if the scene's command is the one that made it and it is there; else empty.
fs::path phantom_of(const hal::Scene& scene) {
  if (organ_command_of(scene.text) != STYLET_PHANTOM_COMMAND) return {};
  const fs::path organ = own_program().parent_path().parent_path() / STYLET_PHANTOM;
  return hal::why_unreadable(organ) == "no such file" ? fs::path() : organ;
}

// An organ of stylet-organ appears whole or not at all, so two runs may make the same one at once.
std::string own_organ(const hal::Scene& scene) {
  if (const fs::path phantom = phantom_of(scene); !phantom.empty()) return phantom;
  const fs::path organ = kept_organ(scene);
  if (hal::why_unreadable(organ) != "no such file") return organ;
  require_meshes(scene);
  std::error_code error;
  fs::create_directories(organ.parent_path(), error);
  if (error) {
    throw hal::SceneError(fmt::format("{}: {}", organ.parent_path().string(), error.message()));
  }
  fmt::print(stderr, "stylet: the organ of {} is made once, as {}\n", scene.file, organ.string());
  const std::vector<std::string> words = words_of(scene, organ);
  if (const std::string why = run_program(words); !why.empty()) {
    throw hal::SceneError(fmt::format(
        "{}: no such file; stylet-organ (Debian: package stylet-organ): {}; the organ of this "
        "scene is made by: {}",
        organ.string(), why, command_of(words)));
  }
  return organ;
}

}  // namespace

bool has_organ_command(const std::string& scene_text) {
  return !organ_command_of(scene_text).empty();
}

std::string organ_of_scene(const hal::Scene& scene) {
  const fs::path path = fs::path(scene.file).parent_path() / scene.organ_path;
  if (!has_organ_command(scene.text) || hal::why_unreadable(path) != "no such file") return path;
  if (comes_with_stylet(scene.file)) return own_organ(scene);
  throw hal::SceneError(fmt::format("{}: no such file: the organ of this scene is made by: {}",
                                    path.string(), command_of(words_of(scene, path))));
}

}  // namespace stylet::app
