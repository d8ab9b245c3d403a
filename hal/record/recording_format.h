// SPDX-License-Identifier: Apache-2.0
// The parts of a recording's file: attributes, texts and tables, for both its writer and its
// reader. Layout: hal/record/README.md.
// Promise: what cannot be read or written throws RecordingError with one line: file, place and
// reason. Units: SI. Frame: world.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hal/record/hdf5_table.h"
#include "hal/record/recording.h"

namespace stylet::hal::hdf5 {

constexpr const char* kFormatName = "stylet-recording";
constexpr std::uint32_t kFormatVersion = 6;
constexpr hsize_t kEventRows = 64;  // in a chunk

// The named attributes of a recording, each a plain number or text. One list to read and to write.
template <typename Visitor, typename Info>
void visit_attributes(Visitor& visit, Info& info) {
  visit.text("stylet_version", info.stylet_version);
  visit.text("scene_file", info.scene_file);
  visit.text("scene_text", info.scene_text);
  visit.text("organ_file", info.organ_file);
  visit.text("organ_name", info.organ_name);
  visit.number("organ_hash", ColumnType::kUint64, 1, &info.organ_hash);
  visit.number("config_mode", ColumnType::kUint32, 1, &info.config.mode);
  visit.number("config_period_s", ColumnType::kFloat32, 1, &info.config.period_s);
  visit.number("config_substeps", ColumnType::kUint32, 1, &info.config.substeps);
  visit.number("config_inertia", ColumnType::kUint32, 1, &info.config.inertia);
  visit.number("config_tissue_damping_s", ColumnType::kFloat32, 1, &info.config.tissue_damping_s);
  visit.number("config_surround_drag_per_s", ColumnType::kFloat32, 1,
               &info.config.surround_drag_per_s);
  visit.number("config_hourglass_weight", ColumnType::kFloat32, 1, &info.config.hourglass_weight);
  visit.number("config_paper_alpha", ColumnType::kFloat32, 1, &info.config.paper_alpha);
  visit.number("config_breathing_amplitude_m", ColumnType::kFloat32, 3,
               &info.config.breathing.amplitude_m);
  visit.number("config_breathing_period_s", ColumnType::kFloat32, 1,
               &info.config.breathing.period_s);
}

// What a recording need not have. A run on a virtual clock has no date, so that its file is the
// same each time.
template <typename Visitor, typename Info>
void visit_optional(Visitor& visit, Info& info) {
  visit.optional_text("began", info.began);
  visit.optional_text("trainee", info.trainee);
  visit.optional_vector("config_gravity_m_per_s2", info.config.gravity_m_per_s2);
}

// What is known only at the end.
struct Ending {
  std::uint64_t lost_records = 0, final_state_hash = 0, ticks = 0;
};
template <typename Visitor, typename Values>
void visit_ending(Visitor& visit, Values& ending) {
  visit.number("lost_records", ColumnType::kUint64, 1, &ending.lost_records);
  visit.number("final_state_hash", ColumnType::kUint64, 1, &ending.final_state_hash);
  visit.number("ticks", ColumnType::kUint64, 1, &ending.ticks);  // 0 until the file is complete
}

struct AttributeWriter {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t width, const void* value) const;
  void text(const char* name, const std::string& value) const;
  void optional_text(const char* name, const std::string& value) const;
  void optional_vector(const char* name, const Vec3& value) const;  // not if it is zero
};

// Rewrites attributes that exist.
struct AttributeRewriter {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t width, const void* value) const;
};

struct AttributeReader {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t width, void* value) const;
  void text(const char* name, std::string& value) const;
  void optional_text(const char* name, std::string& value) const;
  void optional_vector(const char* name, Vec3& value) const;
};

// Rows in a block, which is written at once and as a whole chunk: so no chunk is written twice.
std::uint64_t block_rows(double period_s);
// One table of ticks for each needle; the first needle's has no prefix.
std::vector<Table> tick_tables(hid_t file, const std::string& path, const Config& config);
// The needles and obstacles.
void write_bodies(hid_t file, const std::string& path, const RecordingInfo& info);
void read_bodies(hid_t file, const std::string& path, RecordingInfo& info);
// One text of lines "tick<tab>words". A recording without marks has no such text.
void write_marks(hid_t file, const std::string& path, std::span<const Mark> marks);
std::vector<Mark> read_marks(hid_t file, const std::string& path);

}  // namespace stylet::hal::hdf5
