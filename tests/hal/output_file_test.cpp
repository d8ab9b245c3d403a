// SPDX-License-Identifier: Apache-2.0
// Writing an output never destroys the input it is made from, nor anything that is not a file.
#include "hal/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "file_system.h"

namespace stylet::hal {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& path, const std::string& input) try {
  (void)checked_output(path, std::array{input});
  return "";
} catch (const std::runtime_error& error) {
  return error.what();
}

TEST(OutputFile, MayNotBeAnInputByAnyNameNorAnythingButAFile) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-output-" + std::to_string(getpid()));
  fs::create_directories(folder / "sub");
  const std::string input = folder / "in.h5";
  std::ofstream(input) << "kept";
  fs::create_symlink(input, folder / "soft.h5");
  fs::create_hard_link(input, folder / "hard.h5");
  for (const char* name : {"in.h5", "sub/../in.h5", "soft.h5", "hard.h5"}) {
    EXPECT_NE(refusal(folder / name, input).find("this command reads this file"), std::string::npos)
        << name;
  }
  EXPECT_NE(refusal(folder / "sub", input).find("is a directory"), std::string::npos);
  EXPECT_NE(refusal("/dev/full", input).find("is a device"), std::string::npos);
  EXPECT_EQ(refusal(folder / "new.h5", input), "");
  std::ofstream(folder / "other.h5") << "older";
  EXPECT_EQ(refusal(folder / "other.h5", input), "");
  EXPECT_EQ(refusal("", input), "");
  EXPECT_EQ(refusal(folder / "new.h5", "no such input"), "");
  fs::remove_all(folder);
}

TEST(OutputFile, AFreeNameIsChosen) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-kept-" + std::to_string(getpid()));
  fs::create_directories(folder / "a.b");
  const std::string path = folder / "a.b" / "out.x.h5";
  const auto kept = [](const std::string& name) { return free_name({name, Naming::kKeep}); };
  const auto numbered = [](const std::string& name) { return free_name({name, Naming::kNumber}); };
  EXPECT_EQ(kept(path), path);
  EXPECT_EQ(numbered(path), folder / "a.b" / "out.x-1.h5");
  std::ofstream(path) << "older";
  EXPECT_EQ(free_name({path}), path);
  EXPECT_EQ(kept(path), folder / "a.b" / "out.x-2.h5");
  EXPECT_EQ(numbered(path), folder / "a.b" / "out.x-1.h5");
  // Names that are taken as well.
  for (const char* each : {"out.x-1.h5", "out.x-2.h5"}) {
    fs::create_symlink("nowhere", folder / "a.b" / each);
  }
  EXPECT_EQ(kept(path), folder / "a.b" / "out.x-3.h5");
  EXPECT_EQ(numbered(path), folder / "a.b" / "out.x-3.h5");
  EXPECT_EQ(kept(folder / "a.b"), folder / "a-2.b");
  fs::remove_all(folder);
}

// If several programs choose the same free name and then end together, each keeps its file, and a
// file that somebody put there meanwhile stays; on each kind of file system.
TEST(OutputFile, NamesThatAreTakenMeanwhileReplaceNothing) {
  std::mt19937 random(8);
  for (int round = 0; round < 90; ++round) {
    const test::FileSystem system(round % 3 == 0, round % 3 != 2);
    const fs::path folder =
        fs::temp_directory_path() / ("stylet-names-" + std::to_string(getpid()));
    fs::create_directories(folder);
    const OutputName output = {folder / "out.h5",
                               random() % 2 == 0 ? Naming::kKeep : Naming::kNumber};
    const std::string first = free_name(output);
    std::multiset<std::string> expected;
    if (random() % 2 == 0) {
      std::ofstream(first) << "precious";
      expected.insert("precious");
    }
    const int programs = 1 + static_cast<int>(random() % 5);
    std::vector<pid_t> children;
    for (int i = 0; i < programs; ++i) {
      const std::string mine = folder / ("temporary" + std::to_string(i));
      std::ofstream(mine) << i;
      expected.insert(std::to_string(i));
      children.push_back(fork());
      if (children.back() != 0) continue;
      const std::string name = take_name(mine, first, output);
      std::ifstream in(name);
      const std::string text(std::istreambuf_iterator<char>(in), {});
      _exit(text == std::to_string(i) && !fs::exists(mine) ? 0 : 1);
    }
    for (const pid_t each : children) {
      int status = 1;
      waitpid(each, &status, 0);
      EXPECT_EQ(status, 0) << round;
    }
    std::multiset<std::string> found;
    for (const auto& each : fs::directory_iterator(folder)) {
      std::ifstream in(each.path());
      found.emplace(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    EXPECT_EQ(found, expected) << round;
    fs::remove_all(folder);
  }
}

TEST(OutputFile, ANameThatCannotBeTakenLeavesTheFileUnderItsOwn) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-no-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string mine = folder / "temporary";
  std::ofstream(mine) << "bytes";
  for (const Naming naming : {Naming::kReplace, Naming::kKeep, Naming::kNumber}) {
    const std::string wanted = folder / "none" / "out.h5";
    EXPECT_EQ(take_name(mine, wanted, {wanted, naming}), "");
    EXPECT_EQ(errno, ENOENT);
    EXPECT_EQ(fs::file_size(mine), 5U);
  }
  fs::remove_all(folder);
}

// What a full disk leaves; a limit on file sizes takes its place here.
TEST(OutputFile, IsWholeOrAbsentAndFollowsTheUmask) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-whole-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string path = folder / "out.json", text(10000, 'x');
  const mode_t mask = ::umask(027);
  write_output(path, text);
  ::umask(mask);
  EXPECT_EQ(fs::file_size(path), text.size());
  EXPECT_EQ(fs::status(path).permissions(), static_cast<fs::perms>(0640));
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto on_excess = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit least = {5000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &least), 0);
  std::string message;
  try {
    write_output(path, std::string(10000, 'y'));
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, on_excess);
  EXPECT_EQ(message, path + ": cannot be written: File too large");
  std::ifstream in(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), text);  // the older one stays
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  fs::remove_all(folder);
}

// A link is followed and its target is judged; nothing replaces the link.
TEST(OutputFile, LinksAreFollowed) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-links-" + std::to_string(getpid()));
  fs::create_directories(folder / "far");
  const fs::path file = folder / "far" / "file";
  std::ofstream(file) << "older";
  fs::create_symlink("far/file", folder / "a");
  fs::create_symlink(folder / "a", folder / "b");
  fs::create_symlink("far/new", folder / "dangling");
  fs::create_symlink("loop", folder / "loop");
  fs::create_directory_symlink("far", folder / "near");
  const auto place = [&](const char* name) { return checked_output(folder / name, {}); };
  for (const char* name : {"a", "b", "near/file"}) {
    write_output(place(name), name);
    std::string held;
    std::ifstream(file) >> held;
    EXPECT_EQ(held, name);
  }
  write_output(place("dangling"), "x");
  EXPECT_TRUE(fs::is_regular_file(folder / "far" / "new"));
  for (const char* name : {"a", "b", "dangling", "loop"}) {
    EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
  }
  EXPECT_NE(refusal(folder / "a", file).find("this command reads this file"), std::string::npos);
  EXPECT_NE(refusal(folder / "loop", "").find("from link to link"), std::string::npos);
  EXPECT_EQ(place(std::string(220, 'n').c_str()), folder / std::string(220, 'n'));
  EXPECT_NE(refusal(folder / std::string(221, 'n'), "").find("220 bytes"), std::string::npos);
  fs::remove_all(folder);
}

// Names under which the system shows what a process has open: a file renamed to one of them would
// replace it for every other program.
TEST(OutputFile, NamesOfTheSystemAreNotReplaced) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-system-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const int file = ::open((folder / "out").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(file, 0);
  const std::string own = std::to_string(file);
  fs::create_symlink("/proc/self/fd/" + own, folder / "link");
  fs::create_directory_symlink("/dev/fd", folder / "fds");
  for (const std::string& name : std::vector<std::string>{
           "/dev/fd/" + own, "/proc/self/fd/" + own, "/dev/stdout", "/dev/../dev/stylet-new",
           "/sys/stylet-new", (folder / "link").string(), (folder / "fds" / own).string()}) {
    EXPECT_NE(refusal(name, "").find("is a device"), std::string::npos) << name;
  }
  EXPECT_EQ(refusal("/dev/shm/stylet-new", ""), "");
  EXPECT_EQ(refusal("/devices", ""), "");
  ::close(file);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace stylet::hal
