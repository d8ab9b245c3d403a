// SPDX-License-Identifier: Apache-2.0
// Columns of plain structs, in an HDF5 file.
// Promise: what cannot be read or written throws RecordingError with one line: file, place and
// reason. Units and frames: those of the structs. Source: HDF5 1.10 reference manual.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/loop/record.h"

namespace stylet::hal::hdf5 {

// An HDF5 identifier and the function that closes it.
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

[[noreturn]] void fail(const std::string& path, const std::string& place, const std::string& why);

hid_t memory_type(ColumnType type);
hid_t file_type(ColumnType type);

// To be called in each thread: stops the library from printing errors, which are not for users.
void quieten();
// To be called before any other function of the library.
void prepare_library();

// Columns of one struct type. Each is a dataset that grows by rows; `prefix` precedes their names.
class Table {
 public:
  Table(hid_t file, const std::string& path, std::span<const Column> columns,
        std::string prefix = "", hsize_t chunk_rows = 1)
      : file_(file),
        path_(path),
        columns_(columns),
        prefix_(std::move(prefix)),
        chunk_rows_(chunk_rows) {}

  void create();

  // In an unfinished recording, only rows that every column has are counted.
  void open(bool unfinished = false);

  // After a failure: keeps only these rows, which every column has.
  void cut(std::uint64_t rows);
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

  void append(const std::byte* structs, std::size_t stride, std::size_t count);

  void read(std::uint64_t first, std::byte* structs, std::size_t stride, std::size_t count);

  void make_groups(const std::string& full) const;

  bool exists(const std::string& full) const;

  // How many rows the column has; fails if its type is wrong.
  std::uint64_t check(const Column& column, hid_t set) const;

  // How many rows the file really holds. A damaged file may claim more, which would be read as
  // zeros until memory is full.
  std::uint64_t stored_rows(const Column& column, hid_t set) const;

  bool transfer(std::size_t c, std::uint64_t first, std::size_t count, bool write);

  hid_t file_;
  const std::string& path_;
  std::span<const Column> columns_;
  std::string prefix_;
  hsize_t chunk_rows_;
  std::vector<Handle> sets_;
  std::vector<std::byte> buffer_;
  std::uint64_t rows_ = 0;
};

}  // namespace stylet::hal::hdf5
