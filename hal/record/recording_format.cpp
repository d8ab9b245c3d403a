// SPDX-License-Identifier: Apache-2.0
#include "hal/record/recording_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace stylet::hal::hdf5 {

namespace {

constexpr double kBlockS = 0.5;  // time for which rows are kept before they are written
constexpr std::uint64_t kMaxBlockRows = 4096;
constexpr const char* kMarks = "marks";

Handle number_space(std::uint32_t width) {
  const hsize_t size = width;
  return {width == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose};
}

Table needle_table(hid_t file, const std::string& path) {
  return {file, path, needle_columns(), "", kMaxNeedles};
}
Table obstacle_table(hid_t file, const std::string& path) {
  return {file, path, obstacle_columns(), "", kMaxObstacles};
}

}  // namespace

void AttributeWriter::number(const char* name, ColumnType type, std::uint32_t width,
                             const void* value) const {
  const Handle space = number_space(width);
  const Handle attribute(
      H5Acreate2(file, name, file_type(type), space.id, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute.id < 0 || H5Awrite(attribute.id, memory_type(type), value) < 0) {
    fail(path, name, "attribute cannot be written");
  }
}

void AttributeWriter::optional_text(const char* name, const std::string& value) const {
  if (!value.empty()) text(name, value);
}

void AttributeWriter::optional_vector(const char* name, const Vec3& value) const {
  const bool zero = value.x == 0 && value.y == 0 && value.z == 0;
  if (!zero) number(name, ColumnType::kFloat32, 3, &value);
}

// Stored as a dataset, because an attribute holds 64 KiB at most.
void AttributeWriter::text(const char* name, const std::string& value) const {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type.id, std::max<std::size_t>(value.size(), 1));
  H5Tset_cset(type.id, H5T_CSET_UTF8);
  H5Tset_strpad(type.id, H5T_STR_NULLPAD);
  const std::string padded = value.empty() ? std::string(1, '\0') : value;
  const Handle set(H5Dcreate2(file, name, type.id, space.id, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  if (set.id < 0 || H5Dwrite(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) {
    fail(path, name, "text cannot be written");
  }
}

void AttributeRewriter::number(const char* name, ColumnType type, std::uint32_t,
                               const void* value) const {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  if (attribute.id < 0 || H5Awrite(attribute.id, memory_type(type), value) < 0) {
    fail(path, name, "attribute cannot be written");
  }
}

void AttributeReader::number(const char* name, ColumnType type, std::uint32_t width,
                             void* value) const {
  if (H5Aexists(file, name) <= 0) fail(path, name, "attribute missing");
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  if (attribute.id < 0) fail(path, name, "attribute damaged");
  const Handle space(H5Aget_space(attribute.id), H5Sclose);
  const Handle stored(H5Aget_type(attribute.id), H5Tclose);
  if (H5Sget_simple_extent_npoints(space.id) != static_cast<hssize_t>(width) ||
      H5Tequal(stored.id, file_type(type)) <= 0) {
    fail(path, name, fmt::format("attribute has another type: expected {} number(s)", width));
  }
  if (H5Aread(attribute.id, memory_type(type), value) < 0) fail(path, name, "attribute damaged");
}

void AttributeReader::optional_text(const char* name, std::string& value) const {
  if (H5Lexists(file, name, H5P_DEFAULT) > 0) text(name, value);
}

void AttributeReader::optional_vector(const char* name, Vec3& value) const {
  if (H5Aexists(file, name) > 0) number(name, ColumnType::kFloat32, 3, &value);
}

void AttributeReader::text(const char* name, std::string& value) const {
  constexpr std::size_t kMaxBytes = 1U << 24U;
  if (H5Lexists(file, name, H5P_DEFAULT) <= 0) fail(path, name, "text missing");
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (set.id < 0) fail(path, name, "text damaged");
  const Handle type(H5Dget_type(set.id), H5Tclose);
  const Handle space(H5Dget_space(set.id), H5Sclose);
  const std::size_t size = H5Tget_size(type.id);
  if (H5Tget_class(type.id) != H5T_STRING || H5Tis_variable_str(type.id) > 0 ||
      H5Sget_simple_extent_npoints(space.id) != 1 || size == 0 || size > kMaxBytes) {
    fail(path, name, "text of another type: expected one string of at most 16 MiB");
  }
  value.assign(size, '\0');
  if (H5Dread(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) {
    fail(path, name, "text damaged");
  }
  value.resize(std::min(value.size(), value.find('\0')));
}

std::uint64_t block_rows(double period_s) {
  if (!(period_s * static_cast<double>(kMaxBlockRows) > kBlockS)) return kMaxBlockRows;
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(std::lround(kBlockS / period_s)), 1);
}

std::vector<Table> tick_tables(hid_t file, const std::string& path, const Config& config) {
  std::vector<Table> tables;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    tables.emplace_back(file, path, tick_columns(), i == 0 ? "" : fmt::format("needle{}/", i),
                        block_rows(static_cast<double>(config.period_s)));
  }
  return tables;
}

void write_bodies(hid_t file, const std::string& path, const RecordingInfo& info) {
  Table needles = needle_table(file, path), obstacles = obstacle_table(file, path);
  needles.create();
  obstacles.create();
  std::vector<NeedleRecord> rows;
  for (std::uint32_t i = 0; i < info.config.needle_count; ++i) {
    rows.push_back({info.config.needle[i], info.course[i]});
  }
  needles.append(std::span<const NeedleRecord>(rows));
  obstacles.append(std::span<const ObstacleConfig>(info.obstacles));
}

void read_bodies(hid_t file, const std::string& path, RecordingInfo& info) {
  Table needles = needle_table(file, path), obstacles = obstacle_table(file, path);
  needles.open();
  obstacles.open();
  if (needles.rows() < 1 || needles.rows() > kMaxNeedles) {
    fail(path, "needles", fmt::format("{} rows: expected 1 to {}", needles.rows(), kMaxNeedles));
  }
  if (obstacles.rows() > kMaxObstacles) {
    fail(path, "obstacles",
         fmt::format("{} rows: expected {} at most", obstacles.rows(), kMaxObstacles));
  }
  std::vector<NeedleRecord> rows(needles.rows());
  needles.read(0, std::span(rows));
  info.config.needle_count = static_cast<std::uint32_t>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    info.config.needle[i] = rows[i].config;
    info.course[i] = rows[i].course;
  }
  info.obstacles.resize(obstacles.rows());
  obstacles.read(0, std::span(info.obstacles));
}

void write_marks(hid_t file, const std::string& path, std::span<const Mark> marks) {
  std::string lines;
  for (const Mark& each : marks) lines += fmt::format("{}\t{}\n", each.tick, each.text);
  if (!lines.empty()) AttributeWriter{file, path}.text(kMarks, lines);
}

std::vector<Mark> read_marks(hid_t file, const std::string& path) {
  std::vector<Mark> marks;
  if (H5Lexists(file, kMarks, H5P_DEFAULT) <= 0) return marks;
  std::string text;
  AttributeReader{file, path}.text(kMarks, text);
  const char* const last = text.data() + text.size();
  for (const char* begin = text.data(); begin < last;) {
    const char* const end = std::find(begin, last, '\n');
    Mark mark;
    const auto [rest, error] = std::from_chars(begin, end, mark.tick);
    if (error != std::errc() || rest == end || *rest != '\t') {
      fail(path, kMarks,
           fmt::format("line {}: expected a tick, a tab and words", marks.size() + 1));
    }
    mark.text.assign(rest + 1, end);
    marks.push_back(std::move(mark));
    begin = end + 1;
  }
  return marks;
}

}  // namespace stylet::hal::hdf5
