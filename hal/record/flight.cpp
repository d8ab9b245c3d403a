// SPDX-License-Identifier: Apache-2.0
#include "hal/record/flight.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace stylet::hal {
namespace {

std::uint64_t records_in(double seconds, const RecordingInfo& info) {
  const double ticks = std::ceil(seconds / static_cast<double>(info.config.period_s));
  return static_cast<std::uint64_t>(ticks) * info.config.needle_count;
}

}  // namespace

FlightRecorder::FlightRecorder(std::string path, RecordingInfo info)
    : path_(std::move(path)),
      info_(std::move(info)),
      ring_(records_in(kFlightBeforeS, info_) + records_in(kFlightAfterS, info_)),
      last_fault_(info_.config.needle_count, Fault::kNone) {}

void FlightRecorder::add(std::span<const TickRecord> records, std::span<const Event> events) {
  events_.insert(events_.end(), events.begin(), events.end());
  for (const TickRecord& record : records) add(record);
  const std::uint64_t oldest = ring_[count_ > ring_.size() ? count_ % ring_.size() : 0].output.tick;
  while (!events_.empty() && events_.front().tick < oldest) events_.pop_front();
}

void FlightRecorder::add(const TickRecord& record) {
  ring_[count_ % ring_.size()] = record;
  ++count_;
  Fault& last = last_fault_[record.needle];
  if (record.fault != Fault::kNone && last == Fault::kNone && records_to_come_ == 0) {
    pending_ = {"", record.fault, record.needle, record.output.tick};
    // Up to the end of a tick.
    records_to_come_ = records_in(kFlightAfterS, info_) + last_fault_.size() - 1 - record.needle;
  } else if (records_to_come_ > 0 && --records_to_come_ == 0) {
    write();
  }
  last = record.fault;
}

void FlightRecorder::finish(std::span<const Fault> faults) {
  for (std::uint32_t i = 0; i < std::min(faults.size(), last_fault_.size()); ++i) {
    const bool fresh = faults[i] != Fault::kNone && last_fault_[i] == Fault::kNone;
    last_fault_[i] = faults[i];
    if (!fresh || records_to_come_ > 0 || count_ == 0) continue;
    pending_ = {"", faults[i], i, ring_[(count_ - 1) % ring_.size()].output.tick};
    records_to_come_ = 1;
  }
  if (records_to_come_ > 0) write();
  records_to_come_ = 0;
}

void FlightRecorder::write() {
  const std::uint64_t kept = std::min<std::uint64_t>(count_, ring_.size());
  std::deque<TickRecord> records;
  for (std::uint64_t i = count_ - kept; i < count_; ++i) records.push_back(ring_[i % ring_.size()]);
  // A tick is kept whole, with all needles, or not at all.
  while (!records.empty() && records.front().needle != 0) records.pop_front();
  while (!records.empty() && records.back().needle + 1 != last_fault_.size()) records.pop_back();
  if (records.empty()) return;
  const std::uint64_t first = records.front().output.tick, last = records.back().output.tick;
  std::vector<Event> events;
  std::copy_if(events_.begin(), events_.end(), std::back_inserter(events),
               [&](const Event& each) { return each.tick >= first && each.tick <= last; });
  try {
    const OutputName name = {path_, Naming::kNumber};
    RecordingWriter writer(free_name(name), info_, name);
    writer.append(std::vector<TickRecord>(records.begin(), records.end()));
    writer.append(events);
    pending_.path = writer.finish(0, first - 1);
    flights_.push_back(pending_);
  } catch (const std::exception& failure) {
    error_ = failure.what();
  }
}

}  // namespace stylet::hal
