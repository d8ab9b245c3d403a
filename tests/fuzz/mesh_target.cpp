// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh, in each of the formats. They are refused with one line that names the file,
// or read into triangles whose points exist and are finite. Not none: the program refuses an empty
// file before it calls a reader.
#include <new>

#include "meshes/reader.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const offline::MeshFormat& format : offline::kMeshFormats) {
    try {
      const offline::Mesh mesh = format.read("mesh", bytes).mesh;
      // Every point and corner costs at least a byte of the file.
      test::promise(mesh.points.size() <= size && mesh.triangles.size() <= size,
                    "a mesh larger than its file");
      for (const offline::Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
          test::promise(corner < mesh.points.size(), "a corner that is not a point of the mesh");
          test::promise(offline::finite(mesh.points[corner]), "a corner that is not finite");
        }
      }
    } catch (const offline::Refusal& refused) {
      test::promise_one_line(refused.what());
      test::promise(std::string_view(refused.what()).starts_with("mesh"),
                    "a refusal that does not name the file");
    }
  }
  return 0;
}
