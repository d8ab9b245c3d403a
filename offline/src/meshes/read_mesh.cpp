// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
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

// A body in millimetres that was taken for metres reaches some kilometres, and later stages say how
// large it is; what lies farther is a damaged number, which squares and cubes would overflow.
constexpr double kFarthestM = 1e4;

constexpr double kUsualMetresPerUnit = 1e-3;
// Of factors that two programs wrote for the same unit.
constexpr double kRounding = 1e-6;

}  // namespace

std::string mesh_endings() {
  return listed_endings(" ", " ");
}

bool is_mesh_name(const std::filesystem::path& path) {
  return format_of(path) != nullptr;
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

double take_metres(ReadMesh& read, const std::string& name, const MeshUnits& units) {
  const double unit_m = units.given_m.value_or(read.metres_per_unit.value_or(kUsualMetresPerUnit));
  if (read.metres_per_unit && std::abs(*read.metres_per_unit / unit_m - 1) > kRounding) {
    read.notes.push_back(
        fmt::format("{}: its unit is {:g} m, as it says, but --units makes it {:g} m", name,
                    *read.metres_per_unit, unit_m));
  }
  return unit_m * units.scale;
}

void scale_to_metres(Mesh& mesh, const std::string& name, double metres_per_unit) {
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      const Vec& p = mesh.points[corner];
      const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (farthest * metres_per_unit <= kFarthestM) continue;
      refuse(
          "{}: point {} of {}: ({:g}, {:g}, {:g}) in units of {:g} m: expected coordinates up to "
          "{:g} m; check --units and --scale",
          name, corner + 1, mesh.points.size(), p.x, p.y, p.z, metres_per_unit, kFarthestM);
    }
  }
  for (Vec& p : mesh.points) p = p * metres_per_unit;
}

std::string off_text(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.triangles.size());
  for (const Vec& p : mesh.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace stylet::offline
