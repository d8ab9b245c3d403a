// SPDX-License-Identifier: Apache-2.0
// Outputs on file systems that can do less: without an exchange of two files (NFS, FUSE), and also
// without hard links (FAT). The system's calls are replaced here, and refuse as on those.
#include "base/outputs.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/refusal.h"
#include "file_system.h"
#include "offline_support.h"

namespace {

int renames_left = -1;  // -1: without a limit
std::mt19937 disk(5);
bool takes_pieces = false;  // a call writes only some bytes, or a signal ends it

}  // namespace

extern "C" int rename(const char* from, const char* to) noexcept {
  if (renames_left == 0) {
    renames_left = -1;  // the way back is not hindered
    errno = EIO;
    return -1;
  }
  if (renames_left > 0) --renames_left;
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

extern "C" ssize_t write(int file, const void* bytes, std::size_t size) {
  if (takes_pieces && disk() % 4 == 0) {
    errno = EINTR;
    return -1;
  }
  const std::size_t most = takes_pieces ? 1 + disk() % 5 : size;
  return ::syscall(SYS_write, file, bytes, std::min(size, most));
}

namespace stylet::test {
namespace {

// Restores everything when its test ends, however it ends.
struct Disk {
  FileSystem files;
  ~Disk() {
    renames_left = -1;
    takes_pieces = false;
  }
};

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& each : std::filesystem::directory_iterator(folder)) {
    names.insert(each.path().string());
  }
  return names;
}

// Some files exist before, some do not. If any step fails, all are as they were; if none does, all
// are new. Where a file may have two names, an older file is never missing in between.
TEST(Outputs, AppearTogetherOrNotAtAllOnFileSystemsThatCanDoLess) {
  std::mt19937 engine(4);
  int failed = 0, complete = 0;
  for (int round = 0; round < 400; ++round) {
    const bool has_links = engine() % 2 == 0;
    const Disk system = {{engine() % 4 == 0, has_links}};
    const Scratch scratch;
    const int count = 1 + static_cast<int>(engine() % 4);
    std::vector<std::filesystem::path> paths;
    for (int i = 0; i < count; ++i) {
      paths.push_back(scratch.folder / std::to_string(i));
      if (engine() % 3 != 0) scratch.write(std::to_string(i), "old " + std::to_string(i));
    }
    const auto before = all_files(scratch.folder);
    bool refused = false;
    try {
      offline::Outputs outputs;
      for (const auto& path : paths) outputs.add(path, std::string_view("new"));
      const bool gone = engine() % 4 == 0;  // the last file's bytes: somebody has removed them
      for (const auto& each : std::filesystem::directory_iterator(scratch.folder)) {
        const std::string name = each.path().filename().string();
        if (gone && name.starts_with(std::to_string(count - 1) + ".stylet-part-")) {
          std::filesystem::remove(each.path());
        }
      }
      if (!gone && engine() % 2 == 0) renames_left = static_cast<int>(engine() % 6);
      outputs.commit();
    } catch (const offline::Refusal& refusal) {
      refused = true;
      EXPECT_THAT(refusal.what(), testing::HasSubstr(": cannot be written: "));
    }
    if (refused) {
      ++failed;
      ASSERT_EQ(all_files(scratch.folder), before) << round;
    } else {
      ++complete;
      ASSERT_EQ(all_files(scratch.folder).size(), paths.size()) << round;
      for (const auto& path : paths) ASSERT_EQ(slurp(path), "new") << round;
    }
  }
  EXPECT_GT(failed, 100);
  EXPECT_GT(complete, 100);
}

// A command that writes some outputs, and is then killed or waits.
class Writer {
 public:
  Writer(const std::vector<std::filesystem::path>& paths, bool killed) {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    process_ = ::fork();
    if (process_ == 0) {
      offline::Outputs outputs;
      for (const auto& each : paths) outputs.add(each, std::string_view("half"));
      (void)::syscall(SYS_write, ready[1], "r", 1);
      if (killed) ::kill(::getpid(), SIGKILL);
      for (;;) ::pause();
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
    if (killed) end();
  }
  ~Writer() { end(); }
  Writer(Writer&& other) noexcept : process_(std::exchange(other.process_, 0)) {}
  Writer& operator=(Writer&&) = delete;

 private:
  void end() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(std::exchange(process_, 0), nullptr, 0);
  }
  pid_t process_ = 0;
};

// What killed commands left is removed by the next command with the same output, which says so;
// what a living command writes stays, as do files that only look similar.
TEST(Outputs, WhatKilledCommandsLeftIsRemovedByTheNext) {
  std::mt19937 engine(17);
  for (int round = 0; round < 30; ++round) {
    const Scratch scratch;
    const std::vector<std::filesystem::path> all = {scratch.folder / "a", scratch.folder / "b",
                                                    scratch.folder / "a.sha256"};
    std::set<std::string> expected, gone;
    for (const char* name :
         {"a", "a.stylet-part-", "a.stylet-part-12345", "a.stylet-part-1234567", "a.part-123456",
          "a.part-backup", "a.stylet-part-12-456", "a.stylet-part-123456.new",
          "xa.stylet-part-123456", "a.STYLET-PART-123456"}) {
      scratch.write(name, "mine");
      expected.insert(scratch.folder / name);
    }
    std::filesystem::create_directory(scratch.folder / "a.stylet-part-folder");
    std::filesystem::create_symlink("a", scratch.folder / "a.stylet-part-linked");
    expected.insert(
        {scratch.folder / "a.stylet-part-folder", scratch.folder / "a.stylet-part-linked"});
    std::vector<Writer> living;
    for (int i = static_cast<int>(engine() % 6); i >= 0; --i) {
      std::vector<std::filesystem::path> paths;
      for (const auto& each : all) {
        if (engine() % 2 == 0) paths.push_back(each);
      }
      const std::set<std::string> before = names_in(scratch.folder);
      const bool killed = engine() % 2 == 0;
      living.emplace_back(paths, killed);
      for (const std::string& each : names_in(scratch.folder)) {
        if (before.contains(each)) continue;
        const bool of_b = each.starts_with((scratch.folder / "b").string());
        (killed && !of_b ? gone : expected).insert(each);
      }
    }
    if (engine() % 2 == 0) {
      scratch.write("a.stylet-part-123456.old", "an older a");
      gone.insert(scratch.folder / "a.stylet-part-123456.old");
    }
    offline::Outputs outputs;
    outputs.add(scratch.folder / "a", std::string_view("new"));
    outputs.remove(scratch.folder / "a.sha256");
    const std::vector<std::string> removed = outputs.commit();
    EXPECT_EQ(std::set<std::string>(removed.begin(), removed.end()), gone) << round;
    EXPECT_EQ(names_in(scratch.folder), expected) << round;
    EXPECT_EQ(slurp(scratch.folder / "a"), "new");
  }
}

TEST(Outputs, EveryByteIsWrittenHoweverFewACallTakes) {
  const Disk system = {{true, true}};
  for (std::size_t size = 0; size < 80; ++size) {
    const Scratch scratch;
    std::string bytes(size, '\0');
    for (char& each : bytes) each = static_cast<char>(disk());
    takes_pieces = true;
    offline::write_file(scratch.folder / "a", bytes);
    takes_pieces = false;
    ASSERT_EQ(slurp(scratch.folder / "a"), bytes);
  }
}

// A complete folder stays, even an empty one; an incomplete one is removed.
TEST(Outputs, FoldersStayOnceComplete) {
  const Scratch scratch;
  for (const bool complete : {false, true}) {
    offline::Outputs outputs;
    EXPECT_FALSE(std::filesystem::exists(scratch.folder / "a"));
    outputs.add_folder(scratch.folder / "a" / "b");
    if (complete) outputs.commit();
    EXPECT_TRUE(std::filesystem::exists(scratch.folder / "a" / "b"));
  }
  EXPECT_TRUE(std::filesystem::exists(scratch.folder / "a" / "b"));
}

TEST(Outputs, AFolderThatCannotBeMadeIsNamed) {
  offline::Outputs outputs;
  EXPECT_THAT([&] { outputs.add_folder("/proc/stylet/folder"); },
              testing::ThrowsMessage<offline::Refusal>(
                  testing::StartsWith("/proc/stylet: cannot be made: ")));
}

}  // namespace
}  // namespace stylet::test
