// SPDX-License-Identifier: GPL-3.0-or-later
// What the four mesh readers share: a cursor over a file's bytes, numbers, and the polygons read so
// far. Private to the readers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/refusal.h"
#include "meshes/read_mesh.h"

namespace stylet::bake {

// A text file seen as lines of blank-separated tokens. `token` is empty at the end of the line.
struct Lines {
  std::string_view text;
  std::string_view file;
  std::size_t next = 0;        // byte behind the current line
  std::uint64_t number = 0;    // of the current line, from 1
  std::string_view rest = {};  // what is left of the current line
  char comment = '\0';         // begins a comment that runs to the end of the line
};

// Without the byte-order mark that editors of Windows put before UTF-8.
std::string_view without_mark(std::string_view bytes);

bool next_line(Lines& lines);               // false at the end of the file
std::string_view next_token(Lines& lines);  // within the current line
// Goes on to the following lines where the current one is used up; refuses at the end of the file.
std::string_view token_across_lines(Lines& lines, const char* expected);

// The number a token spells, or NaN; infinite and overflowing spellings also count as NaN.
double parse_number(std::string_view token);
bool parse_integer(std::string_view token, std::int64_t& value_out);
std::int64_t require_integer(const Lines& lines, std::string_view token, std::int64_t low,
                             std::int64_t high, const char* expected);

[[noreturn]] void refuse_at(const Lines& lines, std::string_view value, std::string_view expected);

// A token cut to what fits in one line of a terminal, unprintable bytes as '?'.
std::string shown(std::string_view token);

// A point that is no number is kept as NaN together with its place: it matters only if a face uses
// it.
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
// `place` follows "file:": " byte 84" or a line number.
void add_point(Collector& collector, Vec point, std::string place);
void add_polygon(Collector& collector, const std::vector<std::uint32_t>& corners);
// Refuses a used point that is no number, drops unused points, counts both.
ReadMesh finish(Collector&& collector);

ReadMesh read_obj(std::string_view file, std::string_view bytes);
ReadMesh read_stl(std::string_view file, std::string_view bytes);
ReadMesh read_ply(std::string_view file, std::string_view bytes);
ReadMesh read_off(std::string_view file, std::string_view bytes);

}  // namespace stylet::bake
