// SPDX-License-Identifier: Apache-2.0
// The reading end of the rings: a thread without priority that keeps what the loop did.
//
// It always keeps the curve in which stages are found (24 bytes a tick, at most kMaxTrackPoints),
// feeds the flight recorder and the score, and writes the full records if a recording is wanted.
// If writing fails the run goes on, and `error` gives the reason. If anything else fails, such as
// memory, the thread ends and `error` gives that reason. In a run the recorder is in a process of
// its own (recorder_process.h).
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
#include "hal/score/score.h"
#include "hal/score/stages.h"

namespace stylet::hal {

// For each needle: 70 minutes at 1 kHz, 100 MB. When full the older half is forgotten, and stages
// are found in the rest; the recording has everything.
constexpr std::size_t kMaxTrackPoints = std::size_t{1} << 22U;
// For all needles. When full the older half is forgotten.
constexpr std::size_t kMaxEventsKept = std::size_t{1} << 16U;

// Adds to what is kept of a run. False: the older half was forgotten.
template <typename T>
bool keep_newest(std::vector<T>& kept, const T& item, std::size_t most) {
  const bool full = kept.size() >= most;
  if (full) kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(most / 2));
  kept.push_back(item);
  return !full;
}

class Recorder {
 public:
  // Receives everything, for whoever else wants to know, on the recorder's thread and in order: the
  // records, then the events among them, after the writer has them. Must return at once.
  using Tap = std::function<void(std::span<const TickRecord>, std::span<const Event>)>;
  // `writer`, `flight` and `scorer` may be null, `tap` empty. They and the rings must outlive the
  // recorder.
  Recorder(Ring<TickRecord>& records, Ring<Event>& events, RecordingWriter* writer,
           std::span<const Course> courses, FlightRecorder* flight = nullptr,
           Scorer* scorer = nullptr, Tap tap = {});
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Takes what is left in the rings and ends the thread. The loop must have ended; `faults` are
  // those of its hands at that time.
  void stop(std::span<const Fault> faults = {});
  // Valid after stop().
  const std::vector<TrackPoint>& track(std::size_t needle = 0) const { return tracks_[needle]; }
  const std::vector<Event>& events() const { return events_; }
  const std::string& error() const { return error_; }
  // Not all ticks or events of the run are in track() and events().
  bool forgot() const { return forgot_; }

  // The thread has ended before stop(); error() gives the reason.
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
  std::vector<Course> courses_;  // for each needle
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
