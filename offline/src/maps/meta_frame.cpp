// SPDX-License-Identifier: GPL-3.0-or-later
// Where the voxels of a MetaImage lie. Source: the documentation of MetaIO; its metaObject.cxx for
// names with the same meaning.
#include <array>
#include <cmath>

#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

using Field = HeaderFields::mapped_type;

// The field under any of its names. Refuses several of them, of which the library would choose one.
const Field* only_one(const std::string& path, const HeaderFields& fields,
                      std::initializer_list<const char*> names) {
  const Field* found = nullptr;
  for (const char* name : names) {
    const auto at = fields.find(name);
    if (at == fields.end()) continue;
    if (found != nullptr) {
      refuse("{}: header lines {} and {}: {} and {}: expected one of them", path,
             found->second.number, at->second.second.number, found->second.text,
             at->second.second.text);
    }
    found = &at->second;
  }
  return found;
}

std::vector<double> numbers_of(const std::string& path, const Field& field, std::size_t count) {
  const auto& [value, line] = field;
  std::vector<double> numbers = real_numbers(path, line, value, count);
  for (const double number : numbers) {
    if (std::isfinite(number)) continue;
    refuse("{}: header line {}: {}: expected {} numbers", path, line.number, line.text, count);
  }
  return numbers;
}

double read_unit_m(const std::string& path, const HeaderFields& fields) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits = {
      {{"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"?", 1e-3}}};
  const auto found = fields.find("DistanceUnits");
  if (found == fields.end()) return kUnits[0].second;
  const auto& [value, line] = found->second;
  for (const auto& [name, metres] : kUnits) {
    if (value == name) return metres;
  }
  refuse("{}: header line {}: {}: expected um, mm or cm", path, line.number, line.text);
}

std::array<double, 3> read_spacing(const std::string& path, const HeaderFields& fields,
                                   std::size_t axes) {
  auto found = fields.find("ElementSpacing");
  if (found == fields.end()) found = fields.find("ElementSize");
  if (found == fields.end()) refuse("{}: expected ElementSpacing in the header", path);
  const auto& [value, line] = found->second;
  const std::vector<double> numbers = numbers_of(path, found->second, axes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (numbers[axis] > 0) continue;
    refuse("{}: header line {}: {}: expected lengths above 0", path, line.number, line.text);
  }
  return {numbers[0], numbers[1], numbers[2]};
}

// Three letters for the sides that the axes come from; any other text tells nothing.
bool is_orientation(const std::string& code) {
  return code.size() == 3 && code.find_first_not_of("RAILPS") == std::string::npos;
}

bool is_contradicted(const std::string& code, const std::array<Vec, 3>& directions) {
  constexpr std::string_view kFrom = "RAI", kTo = "LPS";
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_from = kFrom.find(code[i]) != std::string_view::npos;
    const std::size_t axis = is_from ? kFrom.find(code[i]) : kTo.find(code[i]);
    if (directions[i][axis] * (is_from ? 1 : -1) <= 0) return true;
  }
  return false;
}

}  // namespace

HeaderFrame meta_frame(const std::string& path, const HeaderFields& fields, std::size_t axes) {
  if (axes < 3) refuse("{}: {} dimensions: expected 3", path, axes);
  HeaderFrame frame;
  std::array<Vec, 3> directions = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const Field* matrix = only_one(path, fields, {"TransformMatrix", "Rotation", "Orientation"});
  if (matrix != nullptr) {
    const std::vector<double> cells = numbers_of(path, *matrix, axes * axes);
    for (std::size_t i = 0; i < 3; ++i) {
      directions[i] = {cells[i * axes], cells[i * axes + 1], cells[i * axes + 2]};
    }
  }
  const auto told = fields.find("AnatomicalOrientation");
  const std::string code = told == fields.end() ? "" : told->second.first;
  const bool contradicts = is_orientation(code) && is_contradicted(code, directions);
  if (matrix == nullptr && contradicts) {
    refuse("{}: AnatomicalOrientation {}, but no TransformMatrix: expected one, or RAI", path,
           code);
  }
  if (matrix == nullptr && !is_orientation(code)) {
    frame.notes.push_back(fmt::format("{}: no TransformMatrix: {}", path, kAxesTaken));
  }
  if (contradicts) {
    frame.notes.push_back(fmt::format(
        "{}: AnatomicalOrientation {} is not what the TransformMatrix says, which was taken", path,
        code));
  }
  const double unit_m = read_unit_m(path, fields);
  const std::array<double, 3> spacing = read_spacing(path, fields, axes);
  for (std::size_t i = 0; i < 3; ++i) frame.step_m[i] = directions[i] * (spacing[i] * unit_m);
  if (const Field* offset = only_one(path, fields, {"Offset", "Position", "Origin"})) {
    const std::vector<double> at = numbers_of(path, *offset, axes);
    frame.origin_m = Vec{at[0], at[1], at[2]} * unit_m;
  } else {
    frame.notes.push_back(
        fmt::format("{}: no Offset: the first voxel was taken to lie at 0, 0, 0", path));
  }
  return frame;
}

}  // namespace stylet::offline
