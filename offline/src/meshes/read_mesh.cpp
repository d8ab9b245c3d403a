// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/read_mesh.h"

#include <cctype>

#include "base/file.h"
#include "meshes/mesh_text.h"

namespace stylet::offline {

ReadMesh read_mesh(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto reader = extension == ".obj"   ? read_obj
                      : extension == ".stl" ? read_stl
                      : extension == ".ply" ? read_ply
                      : extension == ".off" ? read_off
                                            : nullptr;
  if (reader == nullptr) {
    refuse("{}: '{}': expected a mesh file ending in .obj, .stl, .ply or .off", path.string(),
           extension);
  }
  const std::string bytes = read_file(path);
  ReadMesh result = reader(path.string(), bytes);
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
