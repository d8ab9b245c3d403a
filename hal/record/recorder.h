// SPDX-License-Identifier: Apache-2.0
// The other end of the rings: a thread without priority that keeps what the loop did.
//
// It always keeps the curve that phases are read from (24 bytes a tick, at most kMaxTrackPoints),
// feeds the flight recorder and the score, and writes the full records where a recording is asked
// for. If writing fails the run goes on; the reason is in `error`. If anything else does, such as
// memory, the thread ends, and the reason is there, too. In a run it is in a process of its own
// (recorder_process.h).
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/channel.h"
#include "hal/record/flight.h"
#include "hal/record/recording.h"
#include "hal/score/phases.h"
#include "hal/score/score.h"

namespace stylet::hal {

// Of each needle: 70 minutes at 1 kHz, 100 MB. Full: the older half is forgotten, and the phases
// are those of the rest; the recording has all.
constexpr std::size_t kMaxTrackPoints = std::size_t{1} << 22U;
// Of all needles. Full: likewise.
constexpr std::size_t kMaxEventsKept = std::size_t{1} << 16U;

// Adds to what is kept of a run; false: the older half was forgotten.
template <typename T>
bool keep_newest(std::vector<T>& kept, const T& item, std::size_t most) {
  const bool full = kept.size() >= most;
  if (full) kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(most / 2));
  kept.push_back(item);
  return !full;
}

class Recorder {
 public:
  // Gets everything else that wants to know, on the recorder's thread and in order: the records,
  // then the events among them. Must return at once.
  using Tap = std::function<void(std::span<const TickRecord>, std::span<const Event>)>;
  // `writer`, `flight` and `scorer` may be null, `tap` empty. Rings and they must outlive the
  // recorder.
  Recorder(Ring<TickRecord>& records, Ring<Event>& events, RecordingWriter* writer,
           std::span<const Course> courses, FlightRecorder* flight = nullptr,
           Scorer* scorer = nullptr, Tap tap = {});
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Takes what is left in the rings and ends the thread. The loop must have ended; `faults` are
  // those of its hands then.
  void stop(std::span<const Fault> faults = {});
  // After stop().
  const std::vector<TrackPoint>& track(std::size_t needle = 0) const { return tracks_[needle]; }
  const std::vector<Event>& events() const { return events_; }
  const std::string& error() const { return error_; }
  // Not all ticks, or events, of the run are in them.
  bool forgot() const { return forgot_; }

  // The thread has ended before stop(); the reason is in error().
  bool failed() const { return failed_.load(std::memory_order_acquire); }
  // Ticks taken so far, for a progress line.
  std::uint64_t ticks() const { return ticks_.load(std::memory_order_relaxed); }

 private:
  void work();
  std::size_t drain();

  Ring<TickRecord>& record_ring_;
  Ring<Event>& event_ring_;
  RecordingWriter* writer_;
  FlightRecorder* flight_;
  Scorer* scorer_;
  Tap tap_;
  std::vector<Course> courses_;  // of each needle
  std::vector<TickRecord> block_;
  std::vector<std::vector<TrackPoint>> tracks_;
  std::vector<Event> events_, fresh_;
  bool forgot_ = false;
  std::string error_;
  std::atomic<std::uint64_t> ticks_{0};
  std::vector<Fault> last_faults_;  // set before stop_
  std::atomic<bool> stop_{false}, failed_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
