// SPDX-License-Identifier: GPL-3.0-or-later
// What every reader of meshes needs: places in a file and refusals that name them, counts that the
// file has room for, the points and polygons read so far, and the list of the readers. lines.h has
// the cursor over a text file, bytes.h that over a binary one. Private to the readers and to what
// calls one by itself.
//
// A reader that hands the bytes to a parser in C must not throw through it, as C code cannot be
// unwound: a callback catches, keeps std::current_exception() and stops the parser; once the parser
// has returned, the reader calls std::rethrow_exception().
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/refusal.h"
#include "meshes/read_mesh.h"

namespace stylet::offline {

// Where something stands in a file: in a line, counted from 1, or at a byte, counted from 0.
struct Place {
  enum class Kind : std::uint8_t { kLine, kByte };
  std::string_view file;
  Kind kind = Kind::kLine;
  std::uint64_t number = 0;
};

// One line: "a.off:12: value: expected ..." or "a.stl: byte 84: value: expected ...".
[[noreturn]] void refuse_at(const Place& place, std::string_view value, std::string_view expected);

// Things that a header counts, and what is there to hold them.
struct Room {
  std::size_t bytes = 0;       // of the file, or of what is left of it
  std::size_t bytes_each = 1;  // that one of them takes at least
};
// `count`, spelled `value` in the file; refused if it is negative or the file has no room for as
// many: no reader may reserve memory for what a header claims before it has asked here.
std::size_t require_room(const Place& place, std::string_view value, std::int64_t count,
                         const Room& room, std::string_view what);

struct Collector {
  std::string_view file;
  std::uint32_t first_index = 0;  // what the format calls its first point, for messages
  Mesh mesh = {};
  ReadCounts counts = {};
  std::optional<double> metres_per_unit = {};  // as in ReadMesh
  std::vector<std::string> notes = {};         // as in ReadMesh
  // A point that is not a finite number matters only if a face uses it.
  struct BadPoint {
    std::uint32_t point;
    Place place;
    std::string value;
  };
  std::vector<BadPoint> bad_points = {};
  std::uint64_t corners_end = 0;  // one more than the highest corner so far
  Place highest_place = {};       // of that corner
};

// `value` spells a point that is not finite, if the file has other words for it than its numbers.
void add_point(Collector& collector, Vec point, const Place& place, std::string value = {});
// Corners may name points that follow later in the file.
void add_polygon(Collector& collector, std::span<const std::uint32_t> corners, const Place& place);
// Refuses a mesh without triangles, a corner that names no point, and a corner that is not finite.
// Unused points that are not finite are counted and become zero.
ReadMesh finish(Collector&& collector);

#define STYLET_MESH_READER(ending, reader) \
  ReadMesh reader(std::string_view file, std::string_view bytes);
#include "meshes/readers.inc"
#undef STYLET_MESH_READER

struct MeshFormat {
  std::string_view ending;  // of the file's name, with its dot
  ReadMesh (*read)(std::string_view file, std::string_view bytes);
};

inline constexpr MeshFormat kMeshFormats[] = {
#define STYLET_MESH_READER(ending, reader) {"." #ending, reader},
#include "meshes/readers.inc"
#undef STYLET_MESH_READER
};

// Calls a reader. What else than a refusal it throws becomes one that names the file; so do notes.
ReadMesh read_with(const MeshFormat& format, std::string_view file, std::string_view bytes);

}  // namespace stylet::offline
