// SPDX-License-Identifier: Apache-2.0
// A recording in which anything may be wrong. It is refused with one line, or every row can be read
// and a kernel may be asked for the configuration in it.
//
// HDF5 itself is not under test: a file of noise would only test its parser, whose defects we
// cannot mend. So the input says what to change in a good recording by means of the library:
// attributes, and types and shapes of columns.
#include <hdf5.h>

#include <array>
#include <filesystem>
#include <vector>

#include "hal/record/recording.h"
#include "session.h"
#include "target.h"

namespace stylet::test {
namespace {

using hal::RecordingReader;
using hal::RecordingWriter;

constexpr std::size_t kRows = 40;

const std::vector<std::uint8_t>& good_recording() {
  static const std::vector<std::uint8_t> bytes = [] {
    const InputFile file({}, ".h5");
    hal::RecordingInfo info;
    info.config.needle_count = 2;
    info.obstacles.resize(1);
    make_sphere(info.obstacles[0], 1e-3F);
    RecordingWriter writer(file.path(), info);
    std::vector<hal::TickRecord> rows(2 * kRows);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].needle = i % 2;
    writer.append(rows);
    writer.append(std::array<Event, 3>{});
    writer.finish(1, 0);
    std::vector<std::uint8_t> read(std::filesystem::file_size(file.path()));
    std::FILE* in = std::fopen(file.path().c_str(), "rb");
    promise(in != nullptr && std::fread(read.data(), 1, read.size(), in) == read.size(),
            "the good recording cannot be read back");
    (void)std::fclose(in);
    return read;
  }();
  return bytes;
}

// Names of everything under the root, in the order the library walks it.
std::vector<std::string> names_in(hid_t file) {
  std::vector<std::string> names;
  const auto keep = [](hid_t, const char* name, const H5O_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  (void)H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, keep, &names);
  return names;
}

std::vector<std::string> attributes_of(hid_t file) {
  std::vector<std::string> names;
  const auto keep = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  (void)H5Aiterate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, keep, &names);
  return names;
}

hid_t type_from(std::uint8_t choice) {
  const std::array types = {H5T_NATIVE_FLOAT,  H5T_NATIVE_UINT32, H5T_NATIVE_UINT64,
                            H5T_NATIVE_INT64,  H5T_NATIVE_INT8,   H5T_NATIVE_DOUBLE,
                            H5T_NATIVE_UINT16, H5T_C_S1};
  return types[choice % types.size()];
}

// Replaces an attribute by one of any type, length and content.
void replace_attribute(hid_t file, const std::string& name, Bytes& bytes) {
  (void)H5Adelete(file, name.c_str());
  const hsize_t length = bytes.byte() % 8U;
  const hid_t type = type_from(bytes.byte());
  const hid_t space = length == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &length, nullptr);
  const hid_t made = H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  std::array<std::uint8_t, 64> value{};
  for (std::uint8_t& each : value) each = bytes.byte();
  if (made >= 0) {
    (void)H5Awrite(made, type, value.data());
    (void)H5Aclose(made);
  }
  (void)H5Sclose(space);
}

// Replaces a data set by one of any type and shape, with or without rows.
void replace_column(hid_t file, const std::string& name, Bytes& bytes) {
  (void)H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const int rank = bytes.byte() % 4;
  std::array<hsize_t, 3> shape = {kRows + bytes.byte() % 3U - 1U, bytes.byte() % 5U,
                                  bytes.byte() % 3U};
  const hid_t type = type_from(bytes.byte());
  const hid_t space =
      rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), nullptr);
  const hid_t made =
      H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (made >= 0) (void)H5Dclose(made);
  (void)H5Sclose(space);
}

void change(hid_t file, Bytes& bytes) {
  const std::uint8_t kind = bytes.byte(), which = bytes.byte();
  const std::vector<std::string> attributes = attributes_of(file), names = names_in(file);
  if (kind % 4 < 2) {
    if (attributes.empty()) return;
    const std::string& name = attributes[which % attributes.size()];
    if (kind % 4 == 0) (void)H5Adelete(file, name.c_str());
    if (kind % 4 == 1) replace_attribute(file, name, bytes);
    return;
  }
  const std::string& name = names[which % names.size()];
  if (name == ".") return;
  if (kind % 4 == 2) (void)H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  if (kind % 4 == 3) replace_column(file, name, bytes);
}

// It is safe to ask for a kernel with any configuration that the file contains.
void ask_for(const hal::RecordingInfo& info) {
  static const std::unique_ptr<OpenOrgan> organ = block_organ(2, 2, 2);
  Sizes need = {};
  if (sizes(organ->organ, info.config, need) != Status::kOk) return;
  Session session = make_session(organ->organ, info.config);
  if (set_obstacles(session.kernel, info.obstacles) == Status::kOk) tick(session.kernel, Input{});
}

void read_all(const std::string& path) {
  const RecordingReader reader(path);
  const hal::RecordingInfo& info = reader.info();
  ask_for(info);
  promise(info.config.needle_count >= 1 && info.config.needle_count <= kMaxNeedles,
          "a number of needles no kernel has");
  promise(info.obstacles.size() <= kMaxObstacles, "more obstacles than a kernel takes");
  std::array<hal::TickRecord, 16> rows;
  for (std::uint32_t needle = 0; needle < info.config.needle_count; ++needle) {
    for (std::uint64_t first = 0; first < reader.ticks(); first += rows.size()) {
      const std::uint64_t count = std::min<std::uint64_t>(rows.size(), reader.ticks() - first);
      reader.read(first, std::span(rows).first(count), needle);
    }
  }
  std::vector<Event> events(std::min<std::uint64_t>(reader.event_count(), 1000));
  reader.read(0, events);
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  const test::InputFile file(test::good_recording(), ".h5");
  test::Bytes bytes{{data, size}};
  const hid_t opened = H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  test::promise(opened >= 0, "the good recording cannot be opened");
  for (int i = 0; i < 4 && !bytes.empty(); ++i) test::change(opened, bytes);
  (void)H5Fclose(opened);
  try {
    test::read_all(file.path());
  } catch (const hal::RecordingError& refused) {
    test::promise_one_line(refused.what());
    test::promise(std::string_view(refused.what()).starts_with(file.path()),
                  "a refusal that does not name the file");
  }
  return 0;
}
