// SPDX-License-Identifier: Apache-2.0
#include "hal/console/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hal/base/vector.h"

namespace stylet::console {
namespace {

using hal::dot;
using hal::operator-;

std::uint64_t bucket_of(const Row& row, std::uint64_t first, std::uint32_t stride) {
  return (row.tick() - first) / stride;
}

}  // namespace

Row row_of(const hal::TickRecord& record, const hal::Course& course) {
  const stylet::Output& out = record.output;
  const stylet::Vec3& d = course.direction;
  const float axial = -dot(out.force_n, d);
  const float square = dot(out.force_n, out.force_n) - axial * axial;
  return Row(out.tick, out.depth_m, dot(out.tip_m - course.entry_m, d), axial,
             std::sqrt(std::max(square, 0.0F)), -dot(out.cause.stiffness_n, d),
             -dot(out.cause.cutting_n, d), -dot(out.cause.friction_n, d),
             -dot(out.cause.clamping_n, d), -dot(out.cause.obstacle_n, d),
             static_cast<float>(record.tick_ns) * 1e-3F, static_cast<float>(record.late_ns) * 1e-3F,
             record.needle);
}

Happened happened(const stylet::Event& event) {
  return Happened(event.tick, static_cast<std::uint32_t>(event.kind), event.needle, event.layer,
                  event.depth_m, event.force_n);
}

std::uint32_t stride_for(std::uint64_t ticks, std::uint32_t needles, std::uint32_t most) {
  const std::uint64_t rows = ticks * needles;
  if (rows <= most) return 1;
  // Each stride gives two rows: its first, and the one with the largest force.
  const std::uint64_t stride = (2 * rows + most - 1) / most;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(stride, std::numeric_limits<std::uint32_t>::max()));
}

std::vector<Row> thin(std::span<const Row> rows, std::uint64_t first, std::uint32_t stride) {
  if (stride <= 1) return {rows.begin(), rows.end()};
  struct Chosen {
    const Row *begin = nullptr, *most = nullptr;
  };
  std::vector<Row> out;
  std::array<Chosen, kMaxNeedles> chosen;
  std::uint64_t bucket = 0;
  const auto flush = [&] {
    for (Chosen& each : chosen) {
      if (each.begin != nullptr) out.push_back(*each.begin);
      if (each.most != each.begin) out.push_back(*each.most);
      each = {};
    }
  };
  for (const Row& row : rows) {
    if (bucket_of(row, first, stride) != bucket) flush();
    bucket = bucket_of(row, first, stride);
    Chosen& of = chosen[std::min<std::uint32_t>(row.needle(), kMaxNeedles - 1)];
    if (of.begin == nullptr) of = {&row, &row};
    if (std::abs(row.force_n()) > std::abs(of.most->force_n())) of.most = &row;
  }
  flush();
  return out;
}

void Curve::begin() {
  ++attempt_;
  forgotten_ = 0;
  rows_.clear();
  events_.clear();
  tick_time_ = {};
  lateness_ = {};
}

void Curve::add(const Told& told) {
  if (told.is_event) {
    events_.push_back(told.event);
    return;
  }
  const auto place = [](const Row& row) { return std::pair(row.tick(), row.needle()); };
  if (rows_.empty() || place(told.row) <= place(rows_.back())) begin();
  if (most_rows_ != 0 && rows_.size() >= most_rows_) {
    const auto half = static_cast<std::ptrdiff_t>(rows_.size() / 2);
    rows_.erase(rows_.begin(), rows_.begin() + half);
    forgotten_ += static_cast<std::uint64_t>(half);
  }
  rows_.push_back(told.row);
  if (told.row.needle() != 0) return;
  hal::histogram_add(tick_time_, std::llround(static_cast<double>(told.row.tick_us()) * 1e3));
  hal::histogram_add(lateness_, std::llround(static_cast<double>(told.row.late_us()) * 1e3));
}

std::span<const Row> Curve::rows_from(std::uint64_t number) const {
  const std::uint64_t at = std::max(number, forgotten_) - forgotten_;
  return std::span(rows_).subspan(std::min<std::uint64_t>(at, rows_.size()));
}

std::span<const Happened> Curve::events_from(std::uint64_t number) const {
  return std::span(events_).subspan(std::min<std::uint64_t>(number, events_.size()));
}

std::span<const Row> Curve::rows_between(std::uint64_t first, std::uint64_t last) const {
  const auto begin =
      std::lower_bound(rows_.begin(), rows_.end(), first,
                       [](const Row& row, std::uint64_t t) { return row.tick() < t; });
  const auto end = std::upper_bound(begin, rows_.end(), last,
                                    [](std::uint64_t t, const Row& row) { return t < row.tick(); });
  return {begin, end};
}

}  // namespace stylet::console
