// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/recorder.h"

#include <chrono>
#include <utility>

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

void Recorder::work() {
  for (;;) {
    const bool last = stop_.load(std::memory_order_acquire);
    if (drain() == 0) {
      if (last && flight_ != nullptr) flight_->finish(last_faults_);
      if (last) return;
      std::this_thread::sleep_for(kPause);
    }
  }
}

std::size_t Recorder::drain() {
  block_.clear();
  TickRecord record;
  while (block_.size() < kBlock && record_ring_.pop(record)) {
    block_.push_back(record);
    tracks_[record.needle].push_back(track_point(record, courses_[record.needle]));
    if (scorer_ != nullptr) scorer_->add(record);
  }
  const std::size_t events_before = events_.size();
  Event event;
  while (event_ring_.pop(event)) {
    events_.push_back(event);
    if (scorer_ != nullptr) scorer_->add(event);
  }
  const std::span fresh = std::span(events_).subspan(events_before);
  if (flight_ != nullptr) flight_->add(block_, fresh);
  if (tap_ && (!block_.empty() || !fresh.empty())) tap_(block_, fresh);
  if (writer_ != nullptr && error_.empty()) {
    try {
      writer_->append(block_);
      writer_->append(fresh);
    } catch (const RecordingError& failure) {
      error_ = failure.what();
    }
  }
  ticks_.store(tracks_[0].size(), std::memory_order_relaxed);
  return block_.size() + fresh.size();
}

}  // namespace stylet::hal
