// SPDX-License-Identifier: Apache-2.0
// Writing an output never destroys what it is made from, nor what is not a file.
#include "hal/base/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

namespace stylet::hal {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& path, const std::string& input) try {
  check_output(path, std::array{input});
  return "";
} catch (const std::runtime_error& error) {
  return error.what();
}

TEST(OutputFile, IsNoInputByAnyNameAndNothingButAFile) {
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

TEST(OutputFile, KeptNamesAreFree) {
  const fs::path folder = fs::temp_directory_path() / ("stylet-kept-" + std::to_string(getpid()));
  fs::create_directories(folder / "a.b");
  const std::string path = folder / "a.b" / "out.x.h5";
  EXPECT_EQ(kept_name(path), path);
  std::ofstream(path) << "older";
  EXPECT_EQ(kept_name(path), folder / "a.b" / "out.x-2.h5");
  fs::create_symlink("nowhere", folder / "a.b" / "out.x-2.h5");  // a name that is taken, too
  EXPECT_EQ(kept_name(path), folder / "a.b" / "out.x-3.h5");
  EXPECT_EQ(kept_name(folder / "a.b"), folder / "a-2.b");
  fs::remove_all(folder);
}

// What a full disk leaves; a limit on the size of a file stands for it.
TEST(OutputFile, IsWholeOrNotThereAndFollowsTheUmask) {
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

}  // namespace
}  // namespace stylet::hal
