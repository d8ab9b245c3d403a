// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "hal/record/recording.h"
#include "hal/record/recording_format.h"

namespace stylet::hal {

using namespace hdf5;

struct RecordingWriter::File {
  std::string path, temporary;
  OutputName name;
  Handle file;
  std::vector<Table> ticks;  // for each needle
  Table events;
  std::size_t block_rows;
  std::array<std::uint64_t, kMaxNeedles> flushed = {};  // rows that are on the disk
  std::uint64_t flushed_events = 0;
  // Rows that do not fill a block yet.
  std::array<std::vector<TickRecord>, kMaxNeedles> waiting;  // for each needle
  std::vector<Event> waiting_events;

  File(const std::string& path_in, const std::string& temporary_in, OutputName name_in, hid_t id,
       const Config& config)
      : path(path_in),
        temporary(temporary_in),
        name(std::move(name_in)),
        file(id, H5Fclose),
        ticks(tick_tables(id, path, config)),
        events(id, path, event_columns(), "", kEventRows),
        block_rows(hdf5::block_rows(static_cast<double>(config.period_s))) {}
  ~File() {
    if (!temporary.empty()) std::remove(temporary.c_str());
  }

  void flush() {
    if (H5Fflush(file.id, H5F_SCOPE_LOCAL) < 0)
      fail(path, "file", "cannot be written (disk full?)");
    for (std::size_t i = 0; i < ticks.size(); ++i) flushed[i] = ticks[i].rows();
    flushed_events = events.rows();
  }
  void put_down_all() try {
    quieten();
    for (std::size_t i = 0; i < ticks.size(); ++i) put_down(i);
    put_down_events();
    flush();
  } catch (const RecordingError& error) {
    give_up(error.what());
  }
  // Nothing more can be written: what is on the disk stays, under its temporary name. Throws. The
  // library is not asked to close the file: it would write the length that it wanted, and the file
  // would then count as cut short.
  [[noreturn]] void give_up(const char* why) {
    for (std::size_t i = 0; i < ticks.size(); ++i) ticks[i].cut(flushed[i]);
    events.cut(flushed_events);
    (void)H5Fflush(file.id, H5F_SCOPE_LOCAL);
    for (Table& each : ticks) each.abandon();
    events.abandon();
    file.id = -1;
    throw RecordingError(
        fmt::format("{}; the ticks until then are in {}", why, std::exchange(temporary, "")));
  }
  void put_down_events() {
    events.append(std::span<const Event>(waiting_events));
    waiting_events.clear();
  }
  void put_down(std::size_t needle) {
    ticks[needle].append(std::span<const TickRecord>(waiting[needle]));
    waiting[needle].clear();
  }
};

namespace {

// Uses the format in which a file can be read at any time while it is written (SWMR): a killed
// process leaves what was flushed. Attributes stay in their one place.
hid_t create_file(const std::string& path) {
  const Handle create_list(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const Handle access_list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(create_list.id, false);
  H5Pset_attr_phase_change(create_list.id, 64, 0);
  H5Pset_libver_bounds(access_list.id, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  return H5Fcreate(path.c_str(), H5F_ACC_EXCL, create_list.id, access_list.id);
}

// A free name beside the recording. Another process with the same number, in a container or before
// the machine was started again, may have left a file of its own.
std::string temporary_beside(const std::string& path) {
  constexpr int kMostTried = 1000;
  std::string name = fmt::format("{}.{}.tmp", path, getpid());
  std::error_code error;
  for (int i = 2;
       i < kMostTried && std::filesystem::exists(std::filesystem::symlink_status(name, error));
       ++i) {
    name = fmt::format("{}.{}-{}.tmp", path, getpid(), i);
  }
  return name;
}

// Works on a copy: a file that is closed and opened again could be left half changed.
bool add_marks(const std::string& whole, const std::string& path, std::span<const Mark> marks) {
  const std::string marked = whole + "+";
  std::error_code error;
  if (!std::filesystem::copy_file(whole, marked, error)) return false;
  const Handle file(H5Fopen(marked.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  if (file.id >= 0) write_marks(file.id, path, marks);
  return file.id >= 0 && H5Fflush(file.id, H5F_SCOPE_LOCAL) >= 0 &&
         std::rename(marked.c_str(), whole.c_str()) == 0;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::string& path, const RecordingInfo& info,
                                 OutputName name) {
  prepare_library();
  const std::string temporary = temporary_beside(path);
  const hid_t id = create_file(temporary);
  if (id < 0) {
    fail(path, "file", "cannot be created: expected a folder that can be written, and room there");
  }
  file_ = std::make_unique<File>(path, temporary, std::move(name), id, info.config);
  AttributeWriter writer{id, file_->path};
  writer.text("format", kFormatName);
  writer.number("format_version", ColumnType::kUint32, 1, &kFormatVersion);
  visit_attributes(writer, info);
  visit_optional(writer, info);
  write_bodies(id, file_->path, info);
  for (Table& each : file_->ticks) each.create();
  file_->events.create();
  const Ending none;
  visit_ending(writer, none);
  if (H5Fstart_swmr_write(id) < 0) fail(path, "file", "cannot be written (disk full?)");
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::append(std::span<const TickRecord> records) try {
  for (const TickRecord& record : records) {
    std::vector<TickRecord>& waiting = file_->waiting[record.needle];
    waiting.push_back(record);
    if (waiting.size() < file_->block_rows) continue;
    quieten();  // each thread must do this
    file_->put_down(record.needle);
    file_->put_down_events();
    file_->flush();
  }
} catch (const RecordingError& error) {
  file_->give_up(error.what());
}

void RecordingWriter::append(std::span<const Event> events) {
  file_->waiting_events.insert(file_->waiting_events.end(), events.begin(), events.end());
}

std::uint64_t RecordingWriter::leave() {
  if (!file_->temporary.empty()) file_->put_down_all();
  const std::uint64_t kept = ticks_kept();
  if (kept > 0) file_->temporary.clear();  // else the destructor removes the file
  file_.reset();
  return kept;
}

std::uint64_t RecordingWriter::ticks_kept() const {
  return file_ == nullptr ? 0 : file_->flushed[0];
}

std::string RecordingWriter::finish(std::uint64_t final_state_hash, std::uint64_t lost_records,
                                    std::span<const Mark> marks) {
  file_->put_down_all();
  const Ending ending = {lost_records, final_state_hash, file_->ticks[0].rows()};
  AttributeRewriter writer{file_->file.id, file_->path};
  visit_ending(writer, ending);
  const std::string path = file_->path;
  const OutputName name = file_->name;
  const std::string temporary = std::exchange(file_->temporary, "");
  bool whole = H5Fflush(file_->file.id, H5F_SCOPE_LOCAL) >= 0;
  file_.reset();
  if (whole && !marks.empty()) whole = add_marks(temporary, path, marks);
  std::string taken = whole ? take_name(temporary, path, name) : "";
  if (taken.empty()) {
    std::remove((temporary + "+").c_str());
    fail(path, "file",
         fmt::format("cannot be completed (disk full, or the name is taken by a folder?); "
                     "the ticks are in {}",
                     temporary));
  }
  return taken;
}

}  // namespace stylet::hal
