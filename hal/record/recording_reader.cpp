// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "hal/base/input_file.h"
#include "hal/record/recording.h"
#include "hal/record/recording_format.h"

namespace stylet::hal {

using namespace hdf5;

struct RecordingReader::File {
  std::string path;
  Handle file;
  RecordingInfo info;
  mutable std::vector<Table> ticks;  // for each needle
  mutable Table events;
  std::vector<Mark> marks;

  File(const std::string& path_in, hid_t id)
      : path(path_in), file(id, H5Fclose), events(id, path, event_columns()) {}

  // Finds the ticks that all needles have, and how many are missing, because they count from 1.
  void take_what_is_whole() {
    const auto shortest =
        std::min_element(ticks.begin(), ticks.end(),
                         [](const Table& a, const Table& b) { return a.rows() < b.rows(); });
    const std::uint64_t rows = shortest->rows();
    for (Table& each : ticks) each.keep(rows);
    if (rows == 0) return;
    TickRecord last;
    ticks[0].read(rows - 1, std::span(&last, 1));
    info.lost_records = last.output.tick - std::min(rows, last.output.tick);
  }
};

namespace {

// A killed process left its recording under another name.
std::string hint_of_parts(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path wanted = path;
  const fs::path folder = wanted.has_parent_path() ? wanted.parent_path() : fs::path(".");
  std::error_code error;
  for (const auto& each : fs::directory_iterator(folder, error)) {
    const std::string name = each.path().filename().string();
    if (name.starts_with(wanted.filename().string() + ".") && name.ends_with(".tmp")) {
      return fmt::format("; a run that is going on or was killed left {}", each.path().string());
    }
  }
  return "";
}

// Whether the file is being written, or its writer was killed. HDF5 File Format 3.0, superblock:
// version at 8, consistency flags at 11, bit 2 for a file that may be read while it is written.
bool is_growing(const std::string& path) {
  std::array<unsigned char, 12> head = {};
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return false;
  const std::size_t got = std::fread(head.data(), 1, head.size(), file);
  (void)std::fclose(file);
  return got == head.size() && head[8] >= 3 && (head[11] & 4U) != 0;
}

}  // namespace

RecordingReader::RecordingReader(const std::string& path) {
  prepare_library();
  if (const std::string why = why_unreadable(path); !why.empty()) {
    fail(path, "file", why + ": expected a recording (HDF5)" + hint_of_parts(path));
  }
  const bool growing = is_growing(path);
  const hid_t id = H5Fopen(
      path.c_str(), growing ? H5F_ACC_RDONLY | H5F_ACC_SWMR_READ : H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) fail(path, "file", "not an HDF5 file, or damaged, or cut short");
  file_ = std::make_unique<File>(path, id);
  AttributeReader reader{id, file_->path};
  std::string format;
  reader.text("format", format);
  if (format != kFormatName)
    fail(path, "format", "another kind of HDF5 file: expected a recording");
  std::uint32_t version = 0;
  reader.number("format_version", ColumnType::kUint32, 1, &version);
  if (version != kFormatVersion) {
    fail(path, "format_version",
         fmt::format("{}: expected {}: make the recording again with this program", version,
                     kFormatVersion));
  }
  visit_attributes(reader, file_->info);
  visit_optional(reader, file_->info);
  read_bodies(id, file_->path, file_->info);
  Ending ending;
  visit_ending(reader, ending);
  file_->info.lost_records = ending.lost_records;
  file_->info.final_state_hash = ending.final_state_hash;
  file_->ticks = tick_tables(id, file_->path, file_->info.config);
  for (Table& each : file_->ticks) {
    each.open(ending.ticks == 0);
    // Left behind: complete except for its end.
    file_->info.unfinished = ending.ticks == 0 && (growing || file_->ticks[0].rows() > 0);
    if (each.rows() != ending.ticks && !file_->info.unfinished) {
      fail(path, "ticks", fmt::format("{} rows: expected {}", each.rows(), ending.ticks));
    }
  }
  file_->events.open(file_->info.unfinished);
  if (file_->info.unfinished) file_->take_what_is_whole();
  file_->marks = read_marks(id, file_->path);
}

RecordingReader::~RecordingReader() = default;

const RecordingInfo& RecordingReader::info() const {
  return file_->info;
}
std::uint64_t RecordingReader::ticks() const {
  return file_->ticks[0].rows();
}
std::uint64_t RecordingReader::event_count() const {
  return file_->events.rows();
}

void RecordingReader::read(std::uint64_t first, std::span<TickRecord> out,
                           std::uint32_t needle) const {
  file_->ticks[needle].read(first, out);
  for (TickRecord& each : out) each.needle = needle;
}

const std::vector<Mark>& RecordingReader::marks() const {
  return file_->marks;
}

void RecordingReader::read(std::uint64_t first, std::span<Event> out) const {
  file_->events.read(first, out);
}

}  // namespace stylet::hal
