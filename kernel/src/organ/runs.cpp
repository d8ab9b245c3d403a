// SPDX-License-Identifier: Apache-2.0
#include "organ/runs.h"

#include <algorithm>

namespace stylet {
namespace {

// For a run's end, which may be beyond 65 535.
constexpr std::uint64_t order_of_end(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return (static_cast<std::uint64_t>(z) << 40U) | (static_cast<std::uint64_t>(y) << 20U) | x;
}

// Takes the runs that begin less than kGap cells after the stretch's end; whether there was one.
bool take(Runs& runs, Extent& stretch) {
  std::size_t count = 0;
  for (; count < runs.size() && runs[count].x < stretch.end + kGap; ++count) {
    const std::uint32_t end = std::uint32_t{runs[count].x} + runs[count].count;
    if (end > stretch.end) stretch.end = end;
  }
  runs = runs.subspan(count);
  return count > 0;
}

Runs take_row(Runs& runs, std::uint32_t y) {
  std::size_t count = 0;
  for (; count < runs.size() && runs[count].y == y; ++count) {
  }
  const Runs row = runs.first(count);
  runs = runs.subspan(count);
  return row;
}

}  // namespace

Stretches::Stretches(std::span<const Runs> rows) : rows_(static_cast<std::uint32_t>(rows.size())) {
  std::copy(rows.begin(), rows.end(), left_);
}

bool Stretches::next(Extent& stretch_out) {
  const Runs* first = nullptr;
  for (std::uint32_t i = 0; i < rows_; ++i) {
    const Runs& runs = left_[i];
    if (!runs.empty() && (first == nullptr || runs[0].x < (*first)[0].x)) first = &runs;
  }
  if (first == nullptr) return false;
  stretch_out = {(*first)[0].x, (*first)[0].x};
  for (std::uint32_t i = 0, idle = 0; idle < rows_; ++i) {
    idle = take(left_[i % rows_], stretch_out) ? 0 : idle + 1;
  }
  return true;
}

Lines::Lines(std::initializer_list<Runs> planes)
    : planes_(static_cast<std::uint32_t>(planes.size())) {
  std::copy(planes.begin(), planes.end(), left_);
}

bool Lines::next(std::uint32_t& y_out, Beside& rows_out) {
  bool found = false;
  std::uint32_t y = 0;
  for (std::uint32_t i = 0; i < planes_; ++i) {
    const bool behind = !here_[i].empty();  // a row ends at this line
    if (!behind && left_[i].empty()) continue;
    const std::uint32_t own = behind ? y_ + 1 : left_[i][0].y;
    if (!found || own < y) y = own;
    found = true;
  }
  for (std::uint32_t i = 0; i < planes_; ++i) {
    rows_out[2 * i + 1] = found && y == y_ + 1 ? here_[i] : Runs{};
    rows_out[2 * i] = here_[i] = found ? take_row(left_[i], y) : Runs{};
  }
  y_out = y_ = y;
  return found;
}

bool Planes::next(std::uint32_t& z_out, Runs& runs_out) {
  const std::uint32_t filled = left_.empty() ? end_ : left_[0].z;
  // After an empty plane comes the next plane that is not empty.
  if (empty_) z_ = filled;
  z_out = z_;
  std::size_t count = 0;
  for (; count < left_.size() && left_[count].z == z_; ++count) {
  }
  runs_out = left_.first(count);
  left_ = left_.subspan(count);
  empty_ = count == 0;
  return z_++ < end_;
}

bool has_voxel(const Organ& organ, Extent x, std::uint32_t y, std::uint32_t z) {
  const auto ends_before = [](const OrganRun& run, std::uint64_t place) {
    return order_of_end(static_cast<std::uint32_t>(run.x) + run.count, run.y, run.z) <= place;
  };
  const auto run = std::lower_bound(organ.runs.begin(), organ.runs.end(),
                                    order_of_end(x.begin, y, z), ends_before);
  return run != organ.runs.end() && run->y == y && run->z == z && run->x < x.end;
}

bool has_node(const Organ& organ, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const Extent beside = {x > 0 ? x - 1 : 0, x + 1};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::uint32_t dy = corner & 1U, dz = corner >> 1U;
    if (y >= dy && z >= dz && has_voxel(organ, beside, y - dy, z - dz)) return true;
  }
  return false;
}

}  // namespace stylet
