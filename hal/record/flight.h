// SPDX-License-Identifier: Apache-2.0
// The flight recorder: a recording of the last second before each fault, and of what followed it.
//
// It runs in the recorder's thread, so the loop does nothing for it. Promises: the ring is
// allocated at the start; a file is written only after a fault, never over another one. If writing
// fails the run goes on, and error() says why. The file is a recording like others, but the earlier
// ticks are missing (they are its `lost_records`): it can be read and plotted, not replayed.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "hal/guard/guard.h"
#include "hal/record/recording.h"

namespace stylet::hal {

constexpr double kFlightBeforeS = 1.0;
constexpr double kFlightAfterS = 0.1;  // by then the force has gone to zero

struct Flight {
  std::string path;
  Fault fault = Fault::kNone;
  std::uint32_t needle = 0;
  std::uint64_t tick = 0;  // of the fault
};

class FlightRecorder {
 public:
  // Files are named `path` with -1, -2, ... before its extension, using names that are free. `info`
  // is that of the whole run.
  FlightRecorder(std::string path, RecordingInfo info);

  // In order, with all needles of each tick.
  void add(std::span<const TickRecord> records, std::span<const Event> events);
  // The run has ended: writes a flight that still waits for the ticks after its fault, or one for a
  // fault latched after the last tick. `faults`: of each needle now; empty: those recorded.
  void finish(std::span<const Fault> faults = {});

  const std::vector<Flight>& flights() const { return flights_; }
  const std::string& error() const { return error_; }

 private:
  void add(const TickRecord& record);
  void write();

  std::string path_;
  RecordingInfo info_;
  std::vector<TickRecord> ring_;       // of all needles
  std::uint64_t count_ = 0;            // records ever added
  std::deque<Event> events_;           // not older than the ring
  std::vector<Fault> last_fault_;      // of each needle
  std::uint64_t records_to_come_ = 0;  // until the pending flight is written; 0: none is pending
  Flight pending_;
  std::vector<Flight> flights_;
  std::string error_;
};

}  // namespace stylet::hal
