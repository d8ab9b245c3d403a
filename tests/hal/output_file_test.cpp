// SPDX-License-Identifier: Apache-2.0
// An output never destroys what it is made from, nor what is no file.
#include "stylet/hal/output_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
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
    EXPECT_NE(refusal(folder / name, input).find("is read by this command"), std::string::npos)
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

}  // namespace
}  // namespace stylet::hal
