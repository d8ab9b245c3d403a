// SPDX-License-Identifier: GPL-3.0-or-later
// Where the voxels of an NRRD lie: by space directions in a space of the patient; or by spacings or
// ends of the axes, which leave left and right open. Source: teem.sourceforge.net/nrrd/format.html.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();
constexpr double kMillimetre = 1e-3;
using Axes = std::array<std::size_t, 3>;  // numbers of the axes that lie in space

const std::pair<std::string, HeaderLine>* found(const HeaderFields& fields, const char* name) {
  const auto at = fields.find(name);
  return at == fields.end() ? nullptr : &at->second;
}

[[noreturn]] void refuse_line(const std::string& path, const HeaderLine& line,
                              const std::string& expected) {
  refuse("{}: header line {}: {}: expected {}", path, line.number, line.text, expected);
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> out;
  for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    out.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end);
  }
  return out;
}

// The first three axes that are neither layers nor components, as in ITK.
Axes axes_in_space(const std::string& path, const HeaderFields& fields, std::size_t count) {
  constexpr std::array<std::string_view, 6> kInSpace = {"domain", "space", "time",
                                                        "???",    "none",  "unknown"};
  std::vector<std::string> kinds(count, "???");
  if (const auto* given = found(fields, "kinds")) {
    kinds = words(given->first);
    if (kinds.size() != count) {
      refuse_line(path, given->second, fmt::format("{} kinds", count));
    }
  }
  Axes axes{};
  std::size_t filled = 0;
  for (std::size_t axis = 0; axis < count && filled < axes.size(); ++axis) {
    if (std::find(kInSpace.begin(), kInSpace.end(), lower(kinds[axis])) != kInSpace.end()) {
      axes[filled++] = axis;
    }
  }
  if (filled < axes.size()) refuse("{}: {} dimensions: expected 3", path, filled);
  return axes;
}

// ---- the space ----------------------------------------------------------------------------------

struct Space {
  std::array<double, 3> to_lps = {1, 1, 1};  // sign of each axis
  std::string unknown;                       // why it is not a space of the patient
};

Space read_space(const std::string& path, const HeaderFields& fields) {
  struct Known {
    std::string_view name, letters;
    std::array<double, 3> to_lps;
  };
  constexpr std::array<Known, 3> kKnown = {{{"leftposteriorsuperior", "lps", {1, 1, 1}},
                                            {"rightanteriorsuperior", "ras", {-1, -1, 1}},
                                            {"leftanteriorsuperior", "las", {1, -1, 1}}}};
  if (const auto* dimension = found(fields, "spacedimension")) {
    if (dimension->first != "3") refuse_line(path, dimension->second, "3");
  }
  const auto* given = found(fields, "space");
  if (given == nullptr) return {{1, 1, 1}, "no space"};
  std::string name = lower(given->first);
  std::erase_if(name, [](char c) { return c == '-' || c == ' '; });
  for (const Known& known : kKnown) {
    if (name == known.name || name == known.letters) return {known.to_lps, ""};
  }
  if (name == "scannerxyz" || name == "3drighthanded") {
    return {{1, 1, 1}, "space " + given->first};
  }
  refuse_line(path, given->second,
              "left-posterior-superior, right-anterior-superior or left-anterior-superior");
}

// Reads `count` units, which are texts in quotes.
std::vector<double> read_units(const std::string& path, const HeaderFields& fields,
                               const char* field, std::size_t count) {
  constexpr std::array<std::pair<std::string_view, double>, 7> kUnits = {{{"mm", kMillimetre},
                                                                          {"cm", 1e-2},
                                                                          {"m", 1},
                                                                          {"um", 1e-6},
                                                                          {"µm", 1e-6},
                                                                          {"", kMillimetre},
                                                                          {"???", kMillimetre}}};
  const auto* given = found(fields, field);
  if (given == nullptr) return std::vector<double>(count, kMillimetre);  // as is usual
  const std::string expected = fmt::format(R"({} of "mm", "cm", "m" or "um")", count);
  std::vector<double> units;
  for (std::string_view rest = trimmed(given->first); !rest.empty(); rest = trimmed(rest)) {
    const std::size_t end = rest.front() == '"' ? rest.find('"', 1) : std::string_view::npos;
    if (end == std::string_view::npos) refuse_line(path, given->second, expected);
    const auto* unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& each) {
      return each.first == rest.substr(1, end - 1);
    });
    if (unit == kUnits.end()) refuse_line(path, given->second, expected);
    units.push_back(unit->second);
    rest.remove_prefix(end + 1);
  }
  if (units.size() != count) refuse_line(path, given->second, expected);
  return units;
}

// ---- vectors: (x,y,z) ---------------------------------------------------------------------------

// Removes the next vector from `rest`; no value if the text there is "none".
std::optional<Vec> next_vector(const std::string& path, const HeaderLine& line,
                               std::string_view& rest) {
  rest = trimmed(rest);
  constexpr std::string_view kNone = "none";
  if (rest.starts_with(kNone)) {
    rest.remove_prefix(kNone.size());
    return std::nullopt;
  }
  const std::size_t end = rest.find(')');
  if (!rest.starts_with('(') || end == std::string_view::npos) {
    refuse_line(path, line, "vectors (x,y,z)");
  }
  std::string inside(rest.substr(1, end - 1));
  rest.remove_prefix(end + 1);
  if (std::count(inside.begin(), inside.end(), ',') != 2) {
    refuse_line(path, line, "vectors (x,y,z)");
  }
  std::replace(inside.begin(), inside.end(), ',', ' ');
  const std::vector<double> numbers = real_numbers(path, line, inside, 3);
  const Vec vector = {numbers[0], numbers[1], numbers[2]};
  if (!finite(vector)) refuse_line(path, line, "vectors (x,y,z) of numbers");
  return vector;
}

// Directions in the space and unit of the file.
std::array<Vec, 3> read_directions(const std::string& path,
                                   const std::pair<std::string, HeaderLine>& given,
                                   std::size_t count, const Axes& axes) {
  const auto& [value, line] = given;
  std::vector<std::optional<Vec>> vectors;
  for (std::string_view rest = trimmed(value); !rest.empty(); rest = trimmed(rest)) {
    vectors.push_back(next_vector(path, line, rest));
  }
  if (vectors.size() != count) refuse_line(path, line, fmt::format("{} vectors", count));
  std::array<Vec, 3> steps;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::optional<Vec>& vector = vectors[axes[i]];
    if (!vector) refuse_line(path, line, fmt::format("a vector for axis {}", axes[i]));
    steps[i] = *vector;
  }
  return steps;
}

// ---- without directions -------------------------------------------------------------------------

struct Along {
  double spacing = 0, first = 0;  // of an axis, in its unit; `first`: place of the first voxel
};

Along read_axis(const std::string& path, const HeaderFields& fields, std::size_t axis,
                std::size_t count, std::uint64_t size) {
  const auto number = [&](const char* field) {
    const auto* given = found(fields, field);
    return given == nullptr ? kNotSaid
                            : real_numbers(path, given->second, given->first, count)[axis];
  };
  const auto* centers = found(fields, "centers");
  if (centers == nullptr) centers = found(fields, "centerings");
  const auto kinds = centers == nullptr ? std::vector<std::string>{} : words(centers->first);
  if (centers != nullptr && kinds.size() != count) {
    refuse_line(path, centers->second, fmt::format("{} of cell or node", count));
  }
  const bool is_node = centers != nullptr && lower(kinds[axis]) == "node";  // default cell, as teem
  const double least = number("axismins"), most = number("axismaxs"), told = number("spacings");
  const double between = (most - least) / static_cast<double>(is_node ? size - 1 : size);
  const double spacing = std::isnan(told) ? between : told;
  if (!(spacing > 0) || !std::isfinite(spacing)) {
    refuse("{}: axis {}: expected space directions, or spacings above 0", path, axis);
  }
  constexpr double kSame = 1e-3;  // half a voxel in 500
  if (std::fabs(between - spacing) > kSame * spacing) {
    refuse("{}: axis {}: spacing {:.6g}, but axis mins and maxs give {:.6g}: expected the same",
           path, axis, spacing, between);
  }
  if (std::isnan(least)) return {spacing, 0};
  if (!std::isfinite(least)) refuse("{}: axis mins: {}: expected numbers", path, least);
  return {spacing, is_node ? least : least + spacing / 2};
}

}  // namespace

HeaderFrame nrrd_frame(const std::string& path, const HeaderFields& fields,
                       const std::vector<std::uint64_t>& sizes) {
  const Axes axes = axes_in_space(path, fields, sizes.size());
  const Space space = read_space(path, fields);
  const std::vector<double> space_unit_m = read_units(path, fields, "spaceunits", 3);
  const auto to_lps_m = [&](Vec v) {
    return Vec{v.x * space.to_lps[0] * space_unit_m[0], v.y * space.to_lps[1] * space_unit_m[1],
               v.z * space.to_lps[2] * space_unit_m[2]};
  };
  HeaderFrame frame;
  frame.axes = axes;
  const auto* directions = found(fields, "spacedirections");
  if (directions != nullptr) {
    const auto steps = read_directions(path, *directions, sizes.size(), axes);
    std::transform(steps.begin(), steps.end(), frame.step_m.begin(), to_lps_m);
  } else {
    const std::vector<double> unit_m = read_units(path, fields, "units", sizes.size());
    std::array<double, 3> first{};
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const Along along = read_axis(path, fields, axes[i], sizes.size(), sizes[axes[i]]);
      const double spacing_m = along.spacing * unit_m[axes[i]];
      frame.step_m[i] = {i == 0 ? spacing_m : 0, i == 1 ? spacing_m : 0, i == 2 ? spacing_m : 0};
      first[i] = along.first * unit_m[axes[i]];
    }
    frame.origin_m = {first[0], first[1], first[2]};
  }
  if (directions == nullptr || !space.unknown.empty()) {
    const std::string why = directions == nullptr ? "no space directions" : space.unknown;
    frame.notes.push_back(fmt::format("{}: {}: {}", path, why, kAxesTaken));
  }
  if (const auto* given = found(fields, "spaceorigin")) {
    std::string_view rest = given->first;
    const std::optional<Vec> origin = next_vector(path, given->second, rest);
    if (!origin || !trimmed(rest).empty()) refuse_line(path, given->second, "one vector (x,y,z)");
    frame.origin_m = to_lps_m(*origin);
  } else if (directions != nullptr) {
    frame.notes.push_back(
        fmt::format("{}: no space origin: the first voxel was taken to lie at 0, 0, 0", path));
  }
  return frame;
}

}  // namespace stylet::offline
