// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "base/file.h"
#include "meshes/reader.h"

namespace stylet::offline {
namespace {

// The endings with `between` between two of them, but `last` before the last.
std::string listed_endings(std::string_view between, std::string_view last) {
  std::string text;
  for (const MeshFormat& format : kMeshFormats) {
    const auto left = std::end(kMeshFormats) - &format;
    text += fmt::format("{}{}", format.ending, left == 1 ? "" : left == 2 ? last : between);
  }
  return text;
}

const MeshFormat* format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* const format =
      std::find_if(std::begin(kMeshFormats), std::end(kMeshFormats),
                   [&](const MeshFormat& each) { return each.ending == extension; });
  return format == std::end(kMeshFormats) ? nullptr : format;
}

}  // namespace

std::string mesh_endings() {
  return listed_endings(" ", " ");
}

ReadMesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat* const format = format_of(path);
  if (format == nullptr) {
    refuse("{}: '{}': expected a mesh file ending in {}", path.string(), path.extension().string(),
           listed_endings(", ", " or "));
  }
  const std::string bytes = read_file(path);
  ReadMesh result = read_with(*format, path.string(), bytes);
  result.sha256 = sha256_hex(bytes);
  return result;
}

std::string off_text(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.triangles.size());
  for (const Vec& p : mesh.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace stylet::offline
