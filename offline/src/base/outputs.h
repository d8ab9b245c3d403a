// SPDX-License-Identifier: GPL-3.0-or-later
// The files that one command writes: all of them appear under their names, or none.
//
// Promises: an output that the command reads, that it writes twice, or that is a directory, a
// device or another special file is refused; bytes lie in temporaries beside their names until
// commit(), which gives them their names when all are complete and on the disk; without it, and
// where it fails, every file is as it was. SIGINT, SIGTERM and SIGHUP wait until that is so (of
// SIGKILL temporaries stay). Permissions follow the umask. What goes wrong is refused
// with one line.
#pragma once

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stylet::bake {

// Refuses what no output may be, so that it is known before anything takes time.
void check_output(const std::filesystem::path& path);
void check_output_folder(const std::filesystem::path& path);

class Outputs {
 public:
  Outputs() = default;
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  void add(const std::filesystem::path& path, std::span<const std::byte> bytes);
  void add(const std::filesystem::path& path, std::string_view text);
  // Made at once, with those it lies in; gone again without commit().
  void add_folder(const std::filesystem::path& path);
  // Of an older command, which would be untrue beside what this one writes.
  void remove(const std::filesystem::path& path);
  void commit();

 private:
  struct File {
    std::filesystem::path path;
    std::string temporary;  // after its commit: what was there before, if anything
    bool named = false, replaced = false;
  };
  bool name(File& file);
  void take_back();
  void hold_signals();
  void release_signals();

  std::vector<File> files_;
  std::vector<std::filesystem::path> folders_, removed_;
  sigset_t held_{};  // what this blocks
};

// One alone.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace stylet::bake
