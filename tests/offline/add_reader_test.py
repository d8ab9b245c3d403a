#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A format of meshes is one file and one line: this adds a new one to a copy of the readers,
touches nothing else, and read_mesh and the help texts know it. A reader that needs a library adds
that to the list in readers.cmake.

usage: add_reader_test.py SOURCE
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import run

SOURCE = pathlib.Path(sys.argv[1])

READER = """// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/lines.h"

namespace stylet::offline {

// Three numbers a line are a point; every three points are a triangle.
ReadMesh read_points(std::string_view file, std::string_view bytes) {
  Lines lines{bytes, file};
  Collector collector{file};
  std::vector<std::uint32_t> corners;
  while (next_line(lines)) {
    const std::string_view x = next_token(lines), y = next_token(lines), z = next_token(lines);
    corners.push_back(static_cast<std::uint32_t>(collector.mesh.points.size()));
    add_point(collector, {x, y, z}, place_of(lines));
    if (corners.size() < 3) continue;
    add_polygon(collector, corners, place_of(lines));
    corners.clear();
  }
  if (!corners.empty()) refuse_at(lines, "end of file", "three points for each triangle");
  return finish(std::move(collector));
}

}  // namespace stylet::offline
"""

# Its reader calls a library: the file's only line is a text, the mesh a triangle of its size in x.
LIBRARY = ("set(mesh_reader_libraries ",
           "find_package(ZLIB REQUIRED)\nset(mesh_reader_libraries ZLIB::ZLIB ")
PACKED = """// SPDX-License-Identifier: GPL-3.0-or-later
#include <zlib.h>

#include "meshes/lines.h"

namespace stylet::offline {

ReadMesh read_packed(std::string_view file, std::string_view bytes) {
  std::string text(100, ' ');
  uLongf size = text.size();
  const auto* packed = reinterpret_cast<const Bytef*>(bytes.data());
  if (uncompress(reinterpret_cast<Bytef*>(text.data()), &size, packed, bytes.size()) != Z_OK) {
    refuse_at(Place{file}, "bytes", "a stream of zlib");
  }
  Mesh mesh{{{0, 0, 0}, {double(size), 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Collector collector{file};
  collector.mesh = mesh;
  return finish(std::move(collector));
}

}  // namespace stylet::offline
"""

PROGRAM = """#include <cstdio>
#include "meshes/read_mesh.h"

int main(int, char** arguments) {
  using namespace stylet::offline;
  try {
    const Mesh mesh = read_mesh(arguments[1]).mesh;
    std::printf("%s: %zu triangles\\n", mesh_endings().c_str(), mesh.triangles.size());
  } catch (const std::exception& refused) {
    std::printf("%s\\n", refused.what());
  }
}
"""

BUILD = """cmake_minimum_required(VERSION 3.22)
project(readers CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
include(src/meshes/readers.cmake)
add_executable(read main.cpp src/base/file.cpp src/meshes/read_mesh.cpp ${mesh_readers})
target_include_directories(read PRIVATE src)
target_link_libraries(read PRIVATE ${mesh_reader_libraries} OpenSSL::Crypto)
"""


class AddReader(unittest.TestCase):
    def test_one_file_and_one_line(self):
        with tempfile.TemporaryDirectory(prefix="stylet-reader-") as folder:
            copy = pathlib.Path(folder)
            for room in "base", "meshes":
                shutil.copytree(SOURCE / "offline/src" / room, copy / "src" / room)
            (copy / "src/meshes/read_points.cpp").write_text(READER)
            with (copy / "src/meshes/readers.inc").open("a") as readers:
                readers.write("STYLET_MESH_READER(pts, read_points)\n")
            (copy / "CMakeLists.txt").write_text(BUILD)
            (copy / "main.cpp").write_text(PROGRAM)
            run("cmake", "-S", copy, "-B", copy / "build", "-DCMAKE_BUILD_TYPE=Debug")
            run("cmake", "--build", copy / "build", "--parallel", 2)
            (copy / "a.pts").write_text("0 0 0\n1 0 0\n0 1 0\n" * 2)
            (copy / "a.xyz").write_text("")
            read = copy / "build/read"
            self.assertRegex(run(read, copy / "a.pts"), r"^\.obj .*\.pts: 2 triangles\n$")
            self.assertRegex(run(read, copy / "a.xyz"), r"expected a mesh file .* or \.pts\n$")
            (copy / "a.pts").write_text("0 0 0\n1 0 0\n0 1 0\n2 0 0\n")
            self.assertRegex(run(read, copy / "a.pts"), r"a\.pts:4: 'end of file': expected three")
            with (copy / "src/meshes/readers.inc").open("a") as readers:
                readers.write("STYLET_MESH_READER(xyz, read_none)\n")
            again = subprocess.run(["cmake", copy / "build"], capture_output=True, text=True)
            self.assertNotEqual(again.returncode, 0)
            self.assertRegex(" ".join(again.stderr.split()), r"readers\.inc: .*read_none\.cpp")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
