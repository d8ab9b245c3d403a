// SPDX-License-Identifier: Apache-2.0
#include "hal/record/recorder.h"

#include <chrono>
#include <utility>

#include "hal/base/contained.h"

namespace stylet::hal {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::chrono::milliseconds kPause{2};

}  // namespace

Recorder::Recorder(Ring<TickRecord>& records, Ring<Event>& events, RecordingWriter* writer,
                   std::span<const Course> courses, FlightRecorder* flight, Scorer* scorer, Tap tap)
    : record_ring_(records),
      event_ring_(events),
      writer_(writer),
      flight_(flight),
      scorer_(scorer),
      tap_(std::move(tap)),
      courses_(courses.begin(), courses.end()),
      tracks_(courses.size()),
      thread_(&Recorder::work, this) {}

Recorder::~Recorder() {
  stop();
}

void Recorder::stop(std::span<const Fault> faults) {
  if (!thread_.joinable()) return;
  last_faults_.assign(faults.begin(), faults.end());
  stop_.store(true, std::memory_order_release);
  thread_.join();
}

void Recorder::work() try {
  name_thread("stylet-recorder");
  for (;;) {
    const bool last = stop_.load(std::memory_order_acquire);
    if (drain() == 0) {
      if (last && flight_ != nullptr) flight_->finish(last_faults_);
      if (last) return;
      std::this_thread::sleep_for(kPause);
    }
  }
} catch (const std::bad_alloc&) {
  error_ = "out of memory";  // short enough to need no memory
  failed_.store(true, std::memory_order_release);
} catch (const std::exception& error) {
  (void)contained("recorder", [&] { error_ = error.what(); });
  failed_.store(true, std::memory_order_release);
} catch (...) {
  error_ = "unknown error";  // as above
  failed_.store(true, std::memory_order_release);
}

std::size_t Recorder::drain() {
  block_.clear();
  fresh_.clear();
  std::uint64_t taken = 0;
  TickRecord record;
  while (block_.size() < kBlock && record_ring_.pop(record)) {
    block_.push_back(record);
    const TrackPoint point = track_point(record, courses_[record.needle]);
    forgot_ = !keep_newest(tracks_[record.needle], point, kMaxTrackPoints) || forgot_;
    taken += record.needle == 0 ? 1 : 0;
    if (scorer_ != nullptr) scorer_->add(record);
  }
  Event event;
  while (fresh_.size() < kBlock && event_ring_.pop(event)) {
    fresh_.push_back(event);
    forgot_ = !keep_newest(events_, event, kMaxEventsKept) || forgot_;
    if (scorer_ != nullptr) scorer_->add(event);
  }
  const std::span<const Event> fresh = fresh_;
  if (flight_ != nullptr) flight_->add(block_, fresh);
  if (writer_ != nullptr && error_.empty()) {
    try {
      writer_->append(block_);
      writer_->append(fresh);
    } catch (const RecordingError& failure) {
      error_ = failure.what();
    }
  }
  if (tap_ && (!block_.empty() || !fresh.empty())) tap_(block_, fresh);
  ticks_.fetch_add(taken, std::memory_order_relaxed);
  return block_.size() + fresh.size();
}

}  // namespace stylet::hal
