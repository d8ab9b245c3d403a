// SPDX-License-Identifier: Apache-2.0
// The curve of an attempt for the plots: one row for each tick and needle, and the events.
//
// Used by one thread. A tick that is not later than the last one begins a new attempt, so rows and
// events need no other sign of it. Units: SI.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "console_generated.h"
#include "hal/loop/loop.h"
#include "hal/loop/record.h"

namespace stylet::console {

Row row_of(const hal::TickRecord& record, const hal::Course& course);
Happened happened(const stylet::Event& event);

// What the recorder tells, in the order it is told.
struct Told {
  bool is_event = false;
  Row row;
  Happened event;
};

// For each needle: every stride-th tick and, of the ticks between, the one with the largest force.
std::vector<Row> thin(std::span<const Row> rows, std::uint64_t first, std::uint32_t stride);
// The stride with which `ticks` ticks of `needles` needles give at most `most` rows.
std::uint32_t stride_for(std::uint64_t ticks, std::uint32_t needles, std::uint32_t most);

class Curve {
 public:
  // 0: keeps all rows.
  explicit Curve(std::size_t most_rows) : most_rows_(most_rows) {}
  void add(const Told& told);

  // Grows with every attempt. Row numbers count from the attempt's start, forgotten rows included.
  std::uint64_t attempt() const { return attempt_; }
  std::uint64_t row_count() const { return forgotten_ + rows_.size(); }
  std::uint64_t event_count() const { return events_.size(); }
  // Rows from this number on, if they are still kept.
  std::span<const Row> rows_from(std::uint64_t number) const;
  std::span<const Happened> events_from(std::uint64_t number) const;
  // Rows of the ticks [first, last].
  std::span<const Row> rows_between(std::uint64_t first, std::uint64_t last) const;

  const hal::Histogram& tick_time() const { return tick_time_; }
  const hal::Histogram& lateness() const { return lateness_; }

 private:
  void begin();

  std::size_t most_rows_;
  std::uint64_t attempt_ = 0, forgotten_ = 0;
  std::vector<Row> rows_;
  std::vector<Happened> events_;
  hal::Histogram tick_time_, lateness_;  // in us
};

}  // namespace stylet::console
