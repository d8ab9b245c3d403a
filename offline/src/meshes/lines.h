// SPDX-License-Identifier: GPL-3.0-or-later
// A text file, read line by line and word by word, and the numbers in it. For readers of meshes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "meshes/reader.h"

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
std::string_view token_across_lines(Lines& lines, std::string_view expected);

// The number that a token spells, else NaN; also NaN for infinite and overflowing numbers.
double parse_number(std::string_view token);
bool parse_integer(std::string_view token, std::int64_t& value_out);
std::int64_t require_integer(const Lines& lines, std::string_view token, std::int64_t low,
                             std::int64_t high, std::string_view expected);

// A count of things that take at least `bytes_each` bytes each.
std::size_t require_count(const Lines& lines, std::string_view token, std::size_t bytes_each,
                          std::string_view what);

Place place_of(const Lines& lines);  // the current line
// `value` may be a token: it is shown in quotes.
[[noreturn]] void refuse_at(const Lines& lines, std::string_view value, std::string_view expected);

// A token cut to fit into a line of a terminal, with '?' for unprintable bytes.
std::string shown(std::string_view token);

void add_point(Collector& collector, const std::string_view (&tokens)[3], const Place& place);

}  // namespace stylet::offline
