// SPDX-License-Identifier: Apache-2.0
// The recorder (recorder.h) in a process beside the loop's, with the recording, the flight
// recorder, the score and the phases.
//
// The loop pushes records and events into rings in shared memory. If this process ends, the rings
// are full after some seconds, and what does not fit is counted in the loop; what it wrote stays as
// the recording's temporary file. If the loop's process is killed, this one keeps what is in the
// rings first: nothing that the loop has pushed is lost.
// Promises: as of SideProcess; whoever waits for an answer waits no longer than kSidePatienceS
// after the last record was taken.
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
#include "hal/score/phases.h"
#include "hal/score/score.h"

namespace stylet::hal {

constexpr const char* kRecorderRole = "recorder";
// Eight seconds of all needles at 1 kHz: longer than any disk makes the recorder wait. Full:
// records are lost and counted.
constexpr std::size_t kRecordRing = 8192 * kMaxNeedles;
constexpr std::size_t kEventRing = 1024;

struct RecorderTask {
  RecordingInfo info;
  std::string recording;  // empty: none
  std::string flight;
  std::vector<Target> targets;
};

// What came of a run.
struct Recorded {
  std::vector<std::vector<PhaseRow>> phases;  // of each needle
  std::vector<Event> events;
  Score score;
  std::vector<Flight> flights;
  std::string error, flight_error;  // of writing; empty: none
  bool forgot = false;              // phases and events are those of the last kMaxTrackPoints
};

class RecorderProcess {
 public:
  // Throws SideError, with the recording's own words where it cannot be written.
  explicit RecorderProcess(const RecorderTask& task);

  Ring<TickRecord>& records() { return records_; }
  Ring<Event>& events() { return events_; }
  SideProcess& process() { return process_; }
  // Of which the file has all.
  std::uint64_t ticks_kept() const;
  // A ring is full, and it has taken nothing for kSidePatienceS. Asked now and then.
  bool hangs();

  // Once, when the loop has ended; `faults`: of each hand now. None: the process has ended, or was
  // killed because it took nothing any more.
  std::optional<Recorded> stop(std::span<const Fault> faults);
  // After that. What went wrong; empty: the recording has its name.
  std::string finish(std::uint64_t state_hash, std::uint64_t lost_records,
                     std::span<const Mark> marks);

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<Bytes> ask(const Packer& question);
  // Taken nothing for kSidePatienceS, `idle` or not.
  bool takes_nothing(bool idle);

  SideProcess process_;
  Ring<TickRecord> records_;
  Ring<Event> events_;
  std::size_t needles_, targets_;
  std::uint64_t taken_ = 0;  // when it was looked at last
  Clock::time_point took_ = Clock::now();
};

// What that process does.
void recorder_beside(SideSeat& seat);

}  // namespace stylet::hal
