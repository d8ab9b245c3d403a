// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files to triangles: OBJ, STL (text, binary), PLY (text, binary), OFF.
//
// Promises: what cannot be read is refused with one line (`file:line: value: expected ...`, or
// `file: byte n: ...` in binary files); what is only ill-formed geometry is read and counted.
// Memory and time are linear in the size of the file, whatever its header claims. Every point a
// triangle uses is finite; polygons are fanned from their first corner. Units: those of the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace stylet::bake {

struct ReadCounts {
  std::size_t polygons = 0;          // faces with more than three corners, fanned
  std::size_t short_faces = 0;       // faces with fewer than three corners, left out
  std::size_t lines_and_points = 0;  // dangling edges and points, left out
  std::size_t unusable_points = 0;   // not a finite number, and no face uses them
};

struct ReadMesh {
  Mesh mesh;
  ReadCounts counts;
  std::string sha256;  // of the file's bytes, hexadecimal
};

ReadMesh read_mesh(const std::filesystem::path& path);

// The mesh as an OFF file, with enough digits to read the same doubles back.
std::string off_text(const Mesh& mesh);

}  // namespace stylet::bake
