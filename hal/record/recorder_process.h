// SPDX-License-Identifier: Apache-2.0
// The recorder (recorder.h) in a process beside the loop's, together with the recording, the flight
// recorder, the score and the stages.
//
// The loop pushes records and events into rings in shared memory. If the recorder's process ends,
// the rings are full some seconds later, and the loop counts what does not fit; what was written is
// left as the recording's temporary file. If the loop's process is killed, the recorder first keeps
// what is in the rings: nothing that the loop has pushed is lost.
// Promises: those of SideProcess; nobody waits for an answer longer than kSidePatienceS after the
// last record was taken.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/base/channel.h"
#include "hal/base/side_process.h"
#include "hal/record/flight.h"
#include "hal/record/recording.h"
#include "hal/score/score.h"
#include "hal/score/stages.h"

namespace stylet::hal {

constexpr const char* kRecorderRole = "recorder";
// Eight seconds of all needles at 1 kHz: longer than any disk holds up the recorder. When it is
// full, records are lost and counted.
constexpr std::size_t kRecordRing = 8192 * kMaxNeedles;
constexpr std::size_t kEventRing = 1024;

struct RecorderTask {
  RecordingInfo info;
  std::string recording;  // empty: no recording
  OutputName name;        // if that name is taken in the end
  std::string flight;
  std::vector<Target> targets;
};

// The results of a run.
struct Recorded {
  std::vector<std::vector<StageRow>> stages;  // for each needle
  std::vector<Event> events;
  Score score;
  std::vector<Flight> flights;
  std::string error, flight_error;  // of writing; empty: no error
  bool forgot = false;              // stages and events are only those of the last kMaxTrackPoints
};

// How the recording ended.
struct Completed {
  std::string recording;  // its name; empty: there is none
  std::string error;      // why not; empty: it would have no tick
};

class RecorderProcess {
 public:
  // Throws SideError, with the recording's own words if it cannot be written.
  explicit RecorderProcess(const RecorderTask& task);

  Ring<TickRecord>& records() { return records_; }
  Ring<Event>& events() { return events_; }
  SideProcess& process() { return process_; }
  // The ticks that are complete in the file.
  std::uint64_t ticks_kept() const;
  // A ring is full, and nothing was taken for kSidePatienceS. To be asked now and then.
  bool hangs();

  // Call once, when the loop has ended; `faults`: of each hand now. nullopt: the process has ended,
  // or was killed because it no longer took anything.
  std::optional<Recorded> stop(std::span<const Fault> faults);
  // Call after stop().
  Completed finish(std::uint64_t state_hash, std::uint64_t lost_records,
                   std::span<const Mark> marks);

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<Bytes> ask(const Packer& question);
  // Whether nothing was taken for kSidePatienceS; while it is `idle`, it has nothing to take.
  bool takes_nothing(bool idle);

  SideProcess process_;
  Ring<TickRecord> records_;
  Ring<Event> events_;
  std::size_t needles_, targets_;
  std::uint64_t taken_ = 0;  // at the last look
  Clock::time_point took_ = Clock::now();
};

// What the recorder's process does.
void recorder_beside(SideSeat& seat);

}  // namespace stylet::hal
