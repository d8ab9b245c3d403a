// SPDX-License-Identifier: Apache-2.0
// Shared by the organ-building tests: where the data is, a scratch folder, quick builds.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <concepts>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "base/refusal.h"
#include "data_folder.h"
#include "pipeline/build.h"
#include "stylet/organ.h"

namespace stylet::test {

// Skips the calling test with a plain line if the shared data is missing.
#define SKIP_WITHOUT(path)                                              \
  if (!std::filesystem::exists(path)) {                                 \
    GTEST_SKIP() << (path).string() << " is missing (set STYLET_DATA)"; \
  }

// A folder of the test, which is removed with it.
struct Scratch {
  std::filesystem::path folder;

  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "stylet-offline-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
};

// What a call is refused with; nothing if it is not.
template <std::invocable Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const offline::Refusal& refused) {
    return refused.what();
  }
  return "";
}

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Names and bytes of all files below a folder.
inline std::map<std::string, std::string> all_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    files[entry.path()] = entry.is_directory() ? "a folder" : slurp(entry.path());
  }
  return files;
}

// A closed box, faces outward.
inline offline::Mesh box_mesh(offline::Vec low, offline::Vec high) {
  offline::Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.push_back({(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                           (i & 4U) != 0 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline offline::Input input_of(const offline::Mesh& mesh, double metres_per_unit,
                               const std::string& tissue = "liver", int priority = 0) {
  offline::Input input;
  input.path = "test.off";
  input.tissue = tissue;
  input.priority = priority;
  input.metres_per_unit = metres_per_unit;
  input.read.mesh = mesh;
  return input;
}

inline offline::Built build_quietly(std::vector<offline::Input> inputs,
                                    const offline::BuildOptions& options) {
  return offline::build(std::move(inputs), options, [](const char*, double) {});
}

inline Organ opened(const std::vector<std::byte>& bytes) {
  Organ organ;
  EXPECT_EQ(organ_open(bytes, organ), Status::kOk);
  return organ;
}
Organ opened(std::vector<std::byte>&&) = delete;  // the organ refers to the bytes

// Filled volume of all voxels, m^3.
inline double volume_m3(const Organ& organ) {
  const double edge = static_cast<double>(organ.voxel_edge_m);
  double fill = 0;
  for (const std::uint8_t f : organ.voxel_fill) fill += f / 255.0;
  return fill * edge * edge * edge;
}

}  // namespace stylet::test
