// SPDX-License-Identifier: Apache-2.0
// Where a program writes a file that its user names: links are followed, as by a shell's `>`, since
// a file that is renamed to a link's name would take the place of the link.
//
// Promise: no file is made or changed, and nothing is thrown but std::bad_alloc. Whoever may change
// the folders in between can lead the file elsewhere, as with any other program.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace stylet {

struct OutputPlace {
  std::filesystem::path path;
  std::string
      trouble;  // why nothing can be written there, to be put behind the name; empty: it can
};

// Whether a folder's names are the system's: links there lead to what a process has open. Shared
// memory alone holds files of users.
inline bool belongs_to_the_system(const std::filesystem::path& folder) {
  std::error_code error;
  const auto parts = std::filesystem::weakly_canonical(folder, error);
  auto part = parts.begin();
  if (error || part == parts.end() || ++part == parts.end()) return false;
  if (*part == "proc" || *part == "sys") return true;
  if (*part != "dev") return false;
  return ++part == parts.end() || (*part != "shm" && *part != "mqueue");
}

// `name`: as the user gives it, from the present folder. Names beside it are longer by up to 35
// bytes while the file is written.
inline OutputPlace output_place(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as many as Linux follows
  constexpr std::size_t kMostNameBytes = 220;
  constexpr const char* kDevice =
      "is a device or another special file: expected the name of a file";
  fs::path path = name;
  std::error_code error;
  for (int links = 0;; ++links) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (links == kMostLinks) return {path, "leads from link to link without end"};
    if (belongs_to_the_system(folder)) return {path, kDevice};
    if (!fs::is_symlink(fs::symlink_status(path, error))) break;
    const fs::path to = fs::read_symlink(path, error);
    if (error) return {path, "is a link that cannot be read: " + error.message()};
    path = to.is_absolute() ? to : folder / to;
  }
  if (path.filename().string().size() > kMostNameBytes) {
    return {path,
            "has a name of more than 220 bytes: expected a shorter one, as it has a longer one "
            "while it is written"};
  }
  const fs::file_status now = fs::status(path, error);
  if (fs::is_directory(now)) return {path, "is a directory: expected the name of a file"};
  if (fs::exists(now) && !fs::is_regular_file(now)) return {path, kDevice};
  return {path, ""};
}

}  // namespace stylet
