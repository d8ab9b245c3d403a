// SPDX-License-Identifier: GPL-3.0-or-later
// What the mesh readers share: a cursor over a file's bytes, numbers, the polygons read so far, and
// the list of the readers. Private to them and to what calls one by itself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/refusal.h"
#include "meshes/read_mesh.h"

namespace stylet::offline {

// A text file as lines of blank-separated tokens. A token is empty at the end of the line.
struct Lines {
  std::string_view text;
  std::string_view file;
  std::size_t next = 0;        // index of the byte after the current line
  std::uint64_t number = 0;    // number of the current line, from 1
  std::string_view rest = {};  // unread part of the current line
  char comment = '\0';         // this character begins a comment up to the end of the line
};

// `bytes` without the byte-order mark that editors on Windows put before UTF-8.
std::string_view without_mark(std::string_view bytes);

bool next_line(Lines& lines);               // false at the end of the file
std::string_view next_token(Lines& lines);  // within the current line
// The next token, from the next lines if the current one is used up; refuses the end of the file.
std::string_view token_across_lines(Lines& lines, const char* expected);

// The number that a token spells, else NaN; also NaN for infinite and overflowing numbers.
double parse_number(std::string_view token);
bool parse_integer(std::string_view token, std::int64_t& value_out);
std::int64_t require_integer(const Lines& lines, std::string_view token, std::int64_t low,
                             std::int64_t high, const char* expected);

[[noreturn]] void refuse_at(const Lines& lines, std::string_view value, std::string_view expected);

// A token cut to fit into a line of a terminal, with '?' for unprintable bytes.
std::string shown(std::string_view token);

// A point that is not a finite number is kept as NaN, together with its place in the file: it
// matters only if a face uses it.
struct Collector {
  std::string_view file;
  Mesh mesh = {};
  ReadCounts counts = {};
  struct BadPoint {
    std::uint32_t point;
    std::string place;
    std::string value;
  };
  std::vector<BadPoint> bad_points = {};
};

void add_point(Collector& collector, const std::string_view (&tokens)[3], std::uint64_t line);
// `place` is printed after "file:" and is " byte 84" or a line number.
void add_point(Collector& collector, Vec point, std::string place);
void add_polygon(Collector& collector, const std::vector<std::uint32_t>& corners);
// Refuses a used point that is not a finite number; drops and counts unused points.
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

}  // namespace stylet::offline
