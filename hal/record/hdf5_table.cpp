// SPDX-License-Identifier: Apache-2.0
#include "hal/record/hdf5_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "hal/record/recording.h"

namespace stylet::hal::hdf5 {

namespace {

constexpr unsigned kDeflateLevel = 1;  // of zlib's nine: the fastest
// A chunk is read as a whole. The largest that is written is 4096 rows of four numbers of 8 bytes.
// Chunks 16 times as large are read as well, because other tools make larger ones when they repack.
constexpr hsize_t kMaxChunkBytes = hsize_t{16} * 4096 * 4 * 8;

}  // namespace

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

// We report errors ourselves: what the library prints is not for users, and its cleanup at exit
// crashes on a file that could not be completed because the disk was full.
void quieten() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
void prepare_library() {
  // If memory is short, the library crashes while it makes a file's caches, or takes the file for
  // damaged. It needs 3 MB for our files; so this throws first.
  constexpr std::size_t kRoom = std::size_t{8} << 20U;
  ::operator delete(::operator new(kRoom));  // the compiler may leave out an expression with `new`
  H5dont_atexit();
  quieten();
}

void Table::create() {
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

void Table::open(bool unfinished) {
  for (const Column& column : columns_) {
    if (!exists(name(column))) fail(path_, name(column), "column missing");
    sets_.emplace_back(H5Dopen2(file_, name(column).c_str(), H5P_DEFAULT), H5Dclose);
    if (sets_.back().id < 0) fail(path_, name(column), "column damaged");
    const std::uint64_t claimed = check(column, sets_.back().id);
    const std::uint64_t stored = stored_rows(column, sets_.back().id);
    if (stored < claimed && !unfinished) {
      fail(path_, name(column),
           fmt::format("{} rows, of which the file holds {}: file damaged", claimed, stored));
    }
    const std::uint64_t rows = std::min(claimed, stored);
    if (&column == columns_.data()) rows_ = rows;
    if (unfinished) rows_ = std::min<hsize_t>(rows, rows_);
    if (rows != rows_ && !unfinished) {
      fail(path_, name(column),
           fmt::format("{} rows: expected {} as in {}", rows, rows_, name(columns_.front())));
    }
  }
}

void Table::cut(std::uint64_t rows) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const hsize_t size[2] = {rows, columns_[c].width};
    (void)H5Dset_extent(sets_[c].id, size);
  }
  rows_ = rows;
}

void Table::append(const std::byte* structs, std::size_t stride, std::size_t count) {
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

void Table::read(std::uint64_t first, std::byte* structs, std::size_t stride, std::size_t count) {
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

void Table::make_groups(const std::string& full) const {
  const Handle create_list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(create_list.id, false);
  for (std::size_t at = full.find('/'); at != std::string::npos; at = full.find('/', at + 1)) {
    const std::string group = full.substr(0, at);
    if (H5Lexists(file_, group.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, create_list.id, H5P_DEFAULT),
                      H5Gclose);
  }
}

// Checks each group on the way: HDF5 reports a missing group as an error, not as "no".
bool Table::exists(const std::string& full) const {
  for (std::size_t at = full.find('/'); at != std::string::npos; at = full.find('/', at + 1)) {
    if (H5Lexists(file_, full.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_, full.c_str(), H5P_DEFAULT) > 0;
}

std::uint64_t Table::check(const Column& column, hid_t set) const {
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

std::uint64_t Table::stored_rows(const Column& column, hid_t set) const {
  const Handle list(H5Dget_create_plist(set), H5Pclose);
  const hsize_t number_bytes = column_bytes(column.type);
  const H5D_layout_t layout = H5Pget_layout(list.id);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(list.id) != 0) return 0;  // in other files
  if (layout != H5D_CHUNKED) return H5Dget_storage_size(set) / (number_bytes * column.width);
  hsize_t shape[2] = {0, 1}, chunks = 0;
  H5Pget_chunk(list.id, 2, shape);
  if (shape[0] > kMaxChunkBytes || shape[1] > column.width ||
      shape[0] * shape[1] * number_bytes > kMaxChunkBytes) {
    fail(path_, name(column),
         fmt::format("chunks of {} x {} numbers: expected at most {} bytes in a chunk", shape[0],
                     shape[1], kMaxChunkBytes));
  }
  const Handle space(H5Dget_space(set), H5Sclose);
  if (H5Dget_num_chunks(set, space.id, &chunks) < 0) fail(path_, name(column), "column damaged");
  return chunks * shape[0] * shape[1] / column.width;
}

bool Table::transfer(std::size_t c, std::uint64_t first, std::size_t count, bool write) {
  const Column& column = columns_[c];
  const hsize_t start[2] = {first, 0}, size[2] = {count, column.width};
  const Handle space(H5Dget_space(sets_[c].id), H5Sclose);
  const Handle memory(H5Screate_simple(column.width == 1 ? 1 : 2, size, nullptr), H5Sclose);
  const hid_t type = memory_type(column.type);
  if (H5Sselect_hyperslab(space.id, H5S_SELECT_SET, start, nullptr, size, nullptr) < 0)
    return false;
  // The library does not tell in all of its errors whether memory was short; malloc does.
  errno = 0;
  const herr_t done =
      write ? H5Dwrite(sets_[c].id, type, memory.id, space.id, H5P_DEFAULT, buffer_.data())
            : H5Dread(sets_[c].id, type, memory.id, space.id, H5P_DEFAULT, buffer_.data());
  if (done < 0 && errno == ENOMEM) throw std::bad_alloc();
  return done >= 0;
}

}  // namespace stylet::hal::hdf5
