// SPDX-License-Identifier: Apache-2.0
#include "hal/record/recording.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "hal/base/input_file.h"

namespace stylet::hal {
namespace {

constexpr const char* kFormatName = "stylet-recording";
constexpr std::uint32_t kFormatVersion = 4;
// Rows are kept for so long, as a whole chunk: none is written twice.
constexpr double kBlockS = 0.5;
constexpr std::uint64_t kMaxBlockRows = 4096;
constexpr hsize_t kEventRows = 64;  // of a chunk
constexpr unsigned kDeflateLevel = 1;

// An HDF5 identifier and how to give it back.
struct Handle {
  hid_t id = -1;
  herr_t (*close)(hid_t) = nullptr;
  Handle(hid_t id_in, herr_t (*close_in)(hid_t)) : id(id_in), close(close_in) {}
  ~Handle() {
    if (id >= 0) close(id);
  }
  Handle(Handle&& other) noexcept : id(other.id), close(other.close) { other.id = -1; }
  Handle& operator=(Handle&&) = delete;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

[[noreturn]] void fail(const std::string& path, const std::string& place, const std::string& why) {
  throw RecordingError(fmt::format("{}: {}: {}", path, place, why));
}

hid_t memory_type(ColumnType type) {
  switch (type) {
    case ColumnType::kFloat32:
      return H5T_NATIVE_FLOAT;
    case ColumnType::kUint32:
      return H5T_NATIVE_UINT32;
    case ColumnType::kUint64:
      return H5T_NATIVE_UINT64;
    case ColumnType::kInt64:
      return H5T_NATIVE_INT64;
  }
  return -1;
}

hid_t file_type(ColumnType type) {
  switch (type) {
    case ColumnType::kFloat32:
      return H5T_IEEE_F32LE;
    case ColumnType::kUint32:
      return H5T_STD_U32LE;
    case ColumnType::kUint64:
      return H5T_STD_U64LE;
    case ColumnType::kInt64:
      return H5T_STD_I64LE;
  }
  return -1;
}

// The named attributes of a recording, each a plain number or a text. One list for both directions.
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

// Texts that a recording may go without: a run on a virtual clock has no date, so that its file is
// the same each time.
template <typename Visitor, typename Info>
void visit_optional_texts(Visitor& visit, Info& info) {
  visit.optional_text("began", info.began);
  visit.optional_text("trainee", info.trainee);
}

Handle number_space(std::uint32_t width) {
  const hsize_t size = width;
  return {width == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose};
}

struct AttributeWriter {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t width, const void* value) {
    const Handle space = number_space(width);
    const Handle attribute(
        H5Acreate2(file, name, file_type(type), space.id, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute.id < 0 || H5Awrite(attribute.id, memory_type(type), value) < 0) {
      fail(path, name, "attribute cannot be written");
    }
  }

  void optional_text(const char* name, const std::string& value) {
    if (!value.empty()) text(name, value);
  }

  // As a dataset: an attribute holds 64 KiB at most.
  void text(const char* name, const std::string& value) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type.id, std::max<std::size_t>(value.size(), 1));
    H5Tset_cset(type.id, H5T_CSET_UTF8);
    H5Tset_strpad(type.id, H5T_STR_NULLPAD);
    const std::string padded = value.empty() ? std::string(1, '\0') : value;
    const Handle set(
        H5Dcreate2(file, name, type.id, space.id, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    if (set.id < 0 || H5Dwrite(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) {
      fail(path, name, "text cannot be written");
    }
  }
};

// Of attributes that are there.
struct AttributeRewriter {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t, const void* value) const {
    const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
    if (attribute.id < 0 || H5Awrite(attribute.id, memory_type(type), value) < 0) {
      fail(path, name, "attribute cannot be written");
    }
  }
};

struct AttributeReader {
  hid_t file;
  const std::string& path;

  void number(const char* name, ColumnType type, std::uint32_t width, void* value) {
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

  void optional_text(const char* name, std::string& value) {
    if (H5Lexists(file, name, H5P_DEFAULT) > 0) text(name, value);
  }

  void text(const char* name, std::string& value) {
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
};

// Columns of one struct type, each a dataset that grows by rows; `prefix` goes before their names.
class Table {
 public:
  Table(hid_t file, const std::string& path, std::span<const Column> columns,
        std::string prefix = "", hsize_t chunk_rows = 1)
      : file_(file),
        path_(path),
        columns_(columns),
        prefix_(std::move(prefix)),
        chunk_rows_(chunk_rows) {}

  void create() {
    for (const Column& column : columns_) {
      const hsize_t size[2] = {0, column.width}, limit[2] = {H5S_UNLIMITED, column.width};
      const hsize_t chunk[2] = {chunk_rows_, column.width};
      const int rank = column.width == 1 ? 1 : 2;
      const Handle space(H5Screate_simple(rank, size, limit), H5Sclose);
      const Handle create_list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_obj_track_times(create_list.id, false);  // the same run gives the same file
      H5Pset_chunk(create_list.id, rank, chunk);
      H5Pset_shuffle(create_list.id);
      H5Pset_deflate(create_list.id, kDeflateLevel);
      H5Pset_fletcher32(create_list.id);
      make_groups(name(column));
      sets_.emplace_back(H5Dcreate2(file_, name(column).c_str(), file_type(column.type), space.id,
                                    H5P_DEFAULT, create_list.id, H5P_DEFAULT),
                         H5Dclose);
      if (sets_.back().id < 0) fail(path_, name(column), "column cannot be made");
    }
  }

  // Of an unfinished recording those rows count that every column has.
  void open(bool unfinished = false) {
    for (const Column& column : columns_) {
      if (!exists(name(column))) fail(path_, name(column), "column missing");
      sets_.emplace_back(H5Dopen2(file_, name(column).c_str(), H5P_DEFAULT), H5Dclose);
      if (sets_.back().id < 0) fail(path_, name(column), "column damaged");
      const std::uint64_t rows = check(column, sets_.back().id);
      if (&column == columns_.data()) rows_ = rows;
      if (unfinished) rows_ = std::min<hsize_t>(rows, rows_);
      if (rows != rows_ && !unfinished) {
        fail(path_, name(column),
             fmt::format("{} rows: expected {} as in {}", rows, rows_, name(columns_.front())));
      }
    }
  }

  // After a failure: nothing but these rows, which every column has.
  void cut(std::uint64_t rows) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const hsize_t size[2] = {rows, columns_[c].width};
      (void)H5Dset_extent(sets_[c].id, size);
    }
    rows_ = rows;
  }
  void abandon() {
    for (Handle& each : sets_) each.id = -1;
  }

  std::uint64_t rows() const { return rows_; }
  void keep(std::uint64_t rows) { rows_ = rows; }

  template <typename Row>
  void append(std::span<const Row> rows) {
    if (!rows.empty())
      append(reinterpret_cast<const std::byte*>(rows.data()), sizeof(Row), rows.size());
  }

  template <typename Row>
  void read(std::uint64_t first, std::span<Row> rows) {
    if (!rows.empty())
      read(first, reinterpret_cast<std::byte*>(rows.data()), sizeof(Row), rows.size());
  }

 private:
  std::string name(const Column& column) const { return prefix_ + column.name; }

  void append(const std::byte* structs, std::size_t stride, std::size_t count) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const Column& column = columns_[c];
      const std::size_t bytes = column.width * column_bytes(column.type);
      buffer_.resize(bytes * count);
      for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(&buffer_[i * bytes], structs + i * stride + column.offset, bytes);
      }
      const hsize_t size[2] = {rows_ + count, column.width};
      if (H5Dset_extent(sets_[c].id, size) < 0 || !transfer(c, rows_, count, /*write=*/true)) {
        fail(path_, name(column), "column cannot be written (disk full?)");
      }
    }
    rows_ += count;
  }

  void read(std::uint64_t first, std::byte* structs, std::size_t stride, std::size_t count) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const Column& column = columns_[c];
      const std::size_t bytes = column.width * column_bytes(column.type);
      buffer_.resize(bytes * count);
      if (!transfer(c, first, count, /*write=*/false)) {
        fail(path_, name(column),
             fmt::format("rows {} to {} cannot be read: file damaged or cut short", first,
                         first + count));
      }
      for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(structs + i * stride + column.offset, &buffer_[i * bytes], bytes);
      }
    }
  }

  void make_groups(const std::string& full) const {
    const Handle create_list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(create_list.id, false);
    for (std::size_t at = full.find('/'); at != std::string::npos; at = full.find('/', at + 1)) {
      const std::string group = full.substr(0, at);
      if (H5Lexists(file_, group.c_str(), H5P_DEFAULT) > 0) continue;
      const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, create_list.id, H5P_DEFAULT),
                        H5Gclose);
    }
  }

  // Every group on the way, too: HDF5 reports a missing group as an error, not as "no".
  bool exists(const std::string& full) const {
    for (std::size_t at = full.find('/'); at != std::string::npos; at = full.find('/', at + 1)) {
      if (H5Lexists(file_, full.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return H5Lexists(file_, full.c_str(), H5P_DEFAULT) > 0;
  }

  std::uint64_t check(const Column& column, hid_t set) const {
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    hsize_t size[2] = {0, 1};
    const int rank = column.width == 1 ? 1 : 2;
    if (H5Tequal(type.id, file_type(column.type)) <= 0 ||
        H5Sget_simple_extent_ndims(space.id) != rank ||
        H5Sget_simple_extent_dims(space.id, size, nullptr) < 0 || size[1] != column.width) {
      fail(path_, name(column),
           fmt::format("column has another type: expected {} x {} byte number(s)", column.width,
                       column_bytes(column.type)));
    }
    return size[0];
  }

  bool transfer(std::size_t c, std::uint64_t first, std::size_t count, bool write) {
    const Column& column = columns_[c];
    const hsize_t start[2] = {first, 0}, size[2] = {count, column.width};
    const Handle space(H5Dget_space(sets_[c].id), H5Sclose);
    const Handle memory(H5Screate_simple(column.width == 1 ? 1 : 2, size, nullptr), H5Sclose);
    const hid_t type = memory_type(column.type);
    if (H5Sselect_hyperslab(space.id, H5S_SELECT_SET, start, nullptr, size, nullptr) < 0)
      return false;
    return write
               ? H5Dwrite(sets_[c].id, type, memory.id, space.id, H5P_DEFAULT, buffer_.data()) >= 0
               : H5Dread(sets_[c].id, type, memory.id, space.id, H5P_DEFAULT, buffer_.data()) >= 0;
  }

  hid_t file_;
  const std::string& path_;
  std::span<const Column> columns_;
  std::string prefix_;
  hsize_t chunk_rows_;
  std::vector<Handle> sets_;
  std::vector<std::byte> buffer_;
  std::uint64_t rows_ = 0;
};

std::uint64_t block_rows(double period_s) {
  if (!(period_s * static_cast<double>(kMaxBlockRows) > kBlockS)) return kMaxBlockRows;
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(std::lround(kBlockS / period_s)), 1);
}

// One table of ticks a needle; the first one's has no prefix.
std::vector<Table> tick_tables(hid_t file, const std::string& path, const Config& config) {
  std::vector<Table> tables;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    tables.emplace_back(file, path, tick_columns(), i == 0 ? "" : fmt::format("needle{}/", i),
                        block_rows(static_cast<double>(config.period_s)));
  }
  return tables;
}

Table needle_table(hid_t file, const std::string& path) {
  return {file, path, needle_columns(), "", kMaxNeedles};
}
Table obstacle_table(hid_t file, const std::string& path) {
  return {file, path, obstacle_columns(), "", kMaxObstacles};
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

// One text of lines "tick<tab>words". Recordings without marks have none.
constexpr const char* kMarks = "marks";

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

// We report errors ourselves: the library's own stack print is not for users, and its cleaning up
// at exit crashes on a file that could not be completed because the disk was full.
void quieten() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
void prepare_library() {
  H5dont_atexit();
  quieten();
}

}  // namespace

// ---- writing
// ---------------------------------------------------------------------------------------

struct RecordingWriter::File {
  std::string path, temporary;
  Handle file;
  std::vector<Table> ticks;  // of each needle
  Table events;
  std::size_t block_rows;
  std::array<std::uint64_t, kMaxNeedles> flushed = {};  // rows that are on the disk
  std::uint64_t flushed_events = 0;
  // Less than a block.
  std::array<std::vector<TickRecord>, kMaxNeedles> waiting;  // of each needle
  std::vector<Event> waiting_events;

  File(const std::string& path_in, const std::string& temporary_in, hid_t id, const Config& config)
      : path(path_in),
        temporary(temporary_in),
        file(id, H5Fclose),
        ticks(tick_tables(id, path, config)),
        events(id, path, event_columns(), "", kEventRows),
        block_rows(hal::block_rows(static_cast<double>(config.period_s))) {}
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
  // library is not asked to close the file: it would write the length it wanted, and the file
  // would count as cut short.
  [[noreturn]] void give_up(const char* why) {
    for (std::size_t i = 0; i < ticks.size(); ++i) ticks[i].cut(flushed[i]);
    events.cut(flushed_events);
    (void)H5Fflush(file.id, H5F_SCOPE_LOCAL);
    for (Table& each : ticks) each.abandon();
    events.abandon();
    file.id = -1;
    throw RecordingError(
        fmt::format("{}; what was recorded before is {}", why, std::exchange(temporary, "")));
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

std::string numbered_name(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path wanted = path;
  for (int number = 1;; ++number) {
    fs::path name = wanted.parent_path() / wanted.stem();
    name += fmt::format("-{}{}", number, wanted.extension().string());
    if (!fs::exists(name)) return name.string();
  }
}

namespace {

// In the format of which a file that is being written can be read at any time (SWMR): whoever is
// killed leaves what was flushed. Attributes stay in their one place.
hid_t create_file(const std::string& path) {
  const Handle create_list(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const Handle access_list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(create_list.id, false);
  H5Pset_attr_phase_change(create_list.id, 64, 0);
  H5Pset_libver_bounds(access_list.id, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create_list.id, access_list.id);
}

// What only the end tells.
struct Ending {
  std::uint64_t lost_records = 0, final_state_hash = 0, ticks = 0;
};
template <typename Visitor, typename Values>
void visit_ending(Visitor& visit, Values& ending) {
  visit.number("lost_records", ColumnType::kUint64, 1, &ending.lost_records);
  visit.number("final_state_hash", ColumnType::kUint64, 1, &ending.final_state_hash);
  visit.number("ticks", ColumnType::kUint64, 1, &ending.ticks);  // 0 until it is whole
}

// In a copy: a file that is closed and opened again could be left half changed.
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

RecordingWriter::RecordingWriter(const std::string& path, const RecordingInfo& info) {
  prepare_library();
  const std::string temporary = fmt::format("{}.{}.tmp", path, getpid());
  const hid_t id = create_file(temporary);
  if (id < 0) {
    std::remove(temporary.c_str());
    fail(path, "file", "cannot be created: expected a folder that can be written, and room there");
  }
  file_ = std::make_unique<File>(path, temporary, id, info.config);
  AttributeWriter writer{id, file_->path};
  writer.text("format", kFormatName);
  writer.number("format_version", ColumnType::kUint32, 1, &kFormatVersion);
  visit_attributes(writer, info);
  visit_optional_texts(writer, info);
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
    quieten();  // the library asks each thread
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

void RecordingWriter::leave() {
  if (!file_->temporary.empty()) file_->put_down_all();
  file_->temporary.clear();
  file_.reset();
}

std::uint64_t RecordingWriter::ticks_kept() const {
  return file_ == nullptr ? 0 : file_->ticks[0].rows();
}

void RecordingWriter::finish(std::uint64_t final_state_hash, std::uint64_t lost_records,
                             std::span<const Mark> marks) {
  file_->put_down_all();
  const Ending ending = {lost_records, final_state_hash, file_->ticks[0].rows()};
  AttributeRewriter writer{file_->file.id, file_->path};
  visit_ending(writer, ending);
  const std::string path = file_->path;
  const std::string temporary = std::exchange(file_->temporary, "");
  bool whole = H5Fflush(file_->file.id, H5F_SCOPE_LOCAL) >= 0;
  file_.reset();
  if (whole && !marks.empty()) whole = add_marks(temporary, path, marks);
  if (!whole || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove((temporary + "+").c_str());
    fail(path, "file",
         fmt::format("cannot be completed (disk full, or the name is taken by a folder?); "
                     "what was recorded is {}",
                     temporary));
  }
}

// ---- reading
// ---------------------------------------------------------------------------------------

struct RecordingReader::File {
  std::string path;
  Handle file;
  RecordingInfo info;
  mutable std::vector<Table> ticks;  // of each needle
  mutable Table events;
  std::vector<Mark> marks;

  File(const std::string& path_in, hid_t id)
      : path(path_in), file(id, H5Fclose), events(id, path, event_columns()) {}

  // Ticks of all needles, and how many are not there: they count from 1.
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

// Whoever was killed left what it had under another name.
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

// Somebody writes it, or was killed meanwhile. HDF5 File Format 3.0, superblock: version at 8,
// consistency flags at 11, bit 2 for a file that may be read while it is written.
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
    fail(
        path, "format_version",
        fmt::format("{}: expected {}; record it again with this program", version, kFormatVersion));
  }
  visit_attributes(reader, file_->info);
  visit_optional_texts(reader, file_->info);
  read_bodies(id, file_->path, file_->info);
  Ending ending;
  visit_ending(reader, ending);
  file_->info.lost_records = ending.lost_records;
  file_->info.final_state_hash = ending.final_state_hash;
  file_->ticks = tick_tables(id, file_->path, file_->info.config);
  for (Table& each : file_->ticks) {
    each.open(ending.ticks == 0);
    // Left behind: whole, but for its end.
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
