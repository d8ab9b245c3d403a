// SPDX-License-Identifier: Apache-2.0
// A recording: the exact inputs and outputs of every tick, in one HDF5 file. Layout:
// hal/record/README.md.
//
// Promises: the file appears under its name only when finish() has succeeded. Until then it is
// `NAME.PROCESS.tmp` (`NAME.PROCESS-2.tmp` if that is there), grows every half second, and can be
// read at any time; a killed process leaves it in that state. (HDF5's single writer, multiple
// readers; each chunk is written once. Only flushing is not enough: a process killed during a flush
// leaves a file that cannot be opened.) A damaged, shortened or foreign file is refused with
// RecordingError: one line with file, place and reason. Never called from the real-time thread.
// Units: SI. Frame: world.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/base/output_file.h"
#include "hal/loop/record.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct RecordingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RecordingInfo {
  std::string stylet_version;
  std::string began;    // ISO 8601, local time with its offset; empty: not stored
  std::string trainee;  // name of the trainee; empty: not told
  std::string scene_file;
  std::string scene_text;
  std::string organ_file;  // full path at the time of the recording
  std::string organ_name;
  std::uint64_t organ_hash = 0;
  Config config;
  std::array<Course, kMaxNeedles> course = {};  // for each needle
  std::vector<ObstacleConfig> obstacles;
  std::uint64_t final_state_hash = 0;
  std::uint64_t lost_records = 0;
  // True if the file is still being written, or its writer was killed: then it has no final hash
  // and no marks.
  bool unfinished = false;
};

// A teacher's remark on a tick: one line, without control characters.
struct Mark {
  std::uint64_t tick = 0;
  std::string text;
};

class RecordingWriter {
 public:
  // `name`: gives the file another name if `path` is taken in the end; empty: what is there is
  // replaced.
  RecordingWriter(const std::string& path, const RecordingInfo& info, OutputName name = {});
  ~RecordingWriter();  // without finish() it removes the temporary file
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  // Puts each record into the table of its needle.
  void append(std::span<const TickRecord> records);
  void append(std::span<const Event> events);
  // Returns the name that the file got.
  std::string finish(std::uint64_t final_state_hash, std::uint64_t lost_records,
                     std::span<const Mark> marks = {});
  // Instead of finish(): writes all to the disk and leaves it as the temporary file. Returns how
  // many ticks that holds.
  std::uint64_t leave();
  // Ticks whose first needle's record is on the disk.
  std::uint64_t ticks_kept() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class RecordingReader {
 public:
  explicit RecordingReader(const std::string& path);
  ~RecordingReader();
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  const RecordingInfo& info() const;
  std::uint64_t ticks() const;
  // Rows [first, first + out.size()) of a needle, which must exist.
  void read(std::uint64_t first, std::span<TickRecord> out, std::uint32_t needle = 0) const;
  std::uint64_t event_count() const;
  void read(std::uint64_t first, std::span<Event> out) const;
  const std::vector<Mark>& marks() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace stylet::hal
