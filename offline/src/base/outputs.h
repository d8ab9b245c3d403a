// SPDX-License-Identifier: GPL-3.0-or-later
// The files that one command writes: all of them appear under their names, or none.
//
// Promises: an output is refused if the command also reads it, if it is written twice, or if it is
// a directory, a device or another special file. Bytes go to temporaries beside the final names.
// commit() renames them once all are complete and on the disk; without commit(), or if it fails,
// every file is as it was, also on file systems that cannot exchange two files. SIGINT, SIGTERM
// and SIGHUP are held back until then. SIGKILL leaves the temporaries behind, as
// NAME.stylet-part- and six letters; the next commit() of the same output removes them, but none
// whose writer still lives. Permissions follow the umask. Failures are refused with one line.
#pragma once

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stylet::offline {

// Where an output of this name is written: links are followed (output_place.h). Refuses a path that
// cannot be an output, so that the user learns it before the long work begins.
std::filesystem::path checked_output(const std::filesystem::path& path);
void check_output_folder(const std::filesystem::path& path);

class Outputs {
 public:
  Outputs() = default;
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  void add(const std::filesystem::path& path, std::span<const std::byte> bytes);
  void add(const std::filesystem::path& path, std::string_view text);
  // The folder and its parents are made at once, and removed again without commit().
  void add_folder(const std::filesystem::path& path);
  // Removes a file of an older command that would contradict what this command writes.
  void remove(const std::filesystem::path& path);
  // Returns the leftovers of killed commands that it removed.
  std::vector<std::string> commit();

 private:
  struct File {
    std::filesystem::path path;
    std::string temporary;  // after its commit: the file that was there before, if any
    int lock;               // the temporary, open and locked while this command lives
    bool named = false, replaced = false;
  };
  bool name(File& file);
  bool name_beside(File& file);
  void take_back();
  void hold_signals();
  void release_signals();

  std::vector<File> files_;
  std::vector<std::filesystem::path> folders_, removed_;
  sigset_t held_{};  // the signals that this object blocks
};

// Writes a single file; returns what commit() does.
std::vector<std::string> write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace stylet::offline
