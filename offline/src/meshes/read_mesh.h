// SPDX-License-Identifier: GPL-3.0-or-later
// Reads mesh files as triangles, in every format that readers.inc lists.
//
// Promises: an unreadable file is refused with one line, `file:line: value: expected ...` of a text
// file, `file: byte n: value: expected ...` of a binary file; geometry that is merely ill-formed is
// read and counted.
// Memory and time are linear in the size of the file, whatever its header claims. Every point that
// a triangle uses is finite. Polygons become fans around their first corner. Units: the file's,
// until scale_to_metres.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

struct ReadCounts {
  std::size_t polygons = 0;          // faces with more than three corners, fanned
  std::size_t short_faces = 0;       // faces with fewer than three corners, left out
  std::size_t lines_and_points = 0;  // dangling edges and points, left out
  std::size_t unusable_points = 0;   // not a finite number, and no face uses them
};

struct ReadMesh {
  Mesh mesh;
  ReadCounts counts;
  std::string sha256;                          // of the file's bytes, hexadecimal
  std::optional<double> metres_per_unit = {};  // if the file says so
  std::vector<std::string> notes = {};  // what the user is told as warnings: of parts left out, say
};

ReadMesh read_mesh(const std::filesystem::path& path);
// Whether the name ends as that of a mesh.
bool is_mesh_name(const std::filesystem::path& path);

// What the name of a mesh may end in, as a help says it: ".obj .stl" and so on.
std::string mesh_endings();

// What a user may say of a mesh's unit.
inline const std::map<std::string, double> kMetresPerUnit{
    {"mm", 1e-3}, {"cm", 1e-2}, {"dm", 1e-1}, {"m", 1.0}, {"inch", 0.0254}};
struct MeshUnits {
  std::optional<double> given_m = {};  // of --units; without it the file's own unit, or else mm
  double scale = 1;
};
// Metres for a unit of the mesh's coordinates. A user who contradicts the file gets a note.
double take_metres(ReadMesh& read, const std::string& name, const MeshUnits& units);
// Refuses a coordinate that no unit of an organ gives. `name` is the file's, for the refusal.
void scale_to_metres(Mesh& mesh, const std::string& name, double metres_per_unit);

// The mesh as text of an OFF file, with enough digits to give the same doubles when read.
std::string off_text(const Mesh& mesh);

}  // namespace stylet::offline
