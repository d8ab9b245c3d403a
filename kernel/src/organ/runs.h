// SPDX-License-Identifier: Apache-2.0
// The runs of an organ as its lattice stores them: planes, lines of nodes, stretches along x.
//
// The memory of a lattice depends on its voxels, not on the space between them. Along x, voxels
// with fewer than kGap empty cells between them are one stretch; cells between two stretches are
// not stored. Of several empty planes in a row, one is stored. Rows without a voxel are not stored.
//
// Promises: no allocation; all walks together visit each run a fixed number of times.
#pragma once

#include <cstdint>
#include <span>

#include "stylet/organ.h"

namespace stylet {

// Lanes of the lattice sweep: the unit of padding on every instruction set, so that memory and bits
// do not depend on the instruction set.
constexpr std::uint32_t kLanes = 16;
// Shorter holes are stored, because the empty lanes at the ends of two stretches would take as much
// memory. With 16, two kidneys side by side took 2.4 times the slots of one.
constexpr std::uint32_t kGap = 8;

using Runs = std::span<const OrganRun>;

// Voxels [begin, end) of a row; `end` is also the last of their nodes.
struct Extent {
  std::uint32_t begin, end;
};

// The stretches that the voxels of several rows make together, one after the other.
template <std::uint32_t kRows>
class Stretches {
 public:
  explicit Stretches(const Runs (&rows)[kRows]) {
    for (std::uint32_t i = 0; i < kRows; ++i) left_[i] = rows[i];
  }

  // The next stretch; false after the last one.
  bool next(Extent& stretch_out) {
    const Runs* first = nullptr;
    for (const Runs& runs : left_) {
      if (!runs.empty() && (first == nullptr || runs[0].x < (*first)[0].x)) first = &runs;
    }
    if (first == nullptr) return false;
    stretch_out = {(*first)[0].x, (*first)[0].x};
    for (std::uint32_t i = 0, idle = 0; idle < kRows; ++i) {
      idle = take(left_[i % kRows], stretch_out) ? 0 : idle + 1;
    }
    return true;
  }

 private:
  // Takes the runs that begin less than kGap cells after the stretch's end; whether there was one.
  static bool take(Runs& runs, Extent& stretch) {
    std::size_t count = 0;
    for (; count < runs.size() && runs[count].x < stretch.end + kGap; ++count) {
      const std::uint32_t end = std::uint32_t{runs[count].x} + runs[count].count;
      if (end > stretch.end) stretch.end = end;
    }
    runs = runs.subspan(count);
    return count > 0;
  }

  Runs left_[kRows];
};

// The lines of nodes along x between the voxel rows of one plane or of two, by rising y.
template <std::uint32_t kPlanes>
class Lines {
 public:
  explicit Lines(const Runs (&planes)[kPlanes]) {
    for (std::uint32_t i = 0; i < kPlanes; ++i) left_[i] = planes[i];
  }

  // The next line y that has a node, and the voxel rows beside it: y, then y - 1, of each plane.
  bool next(std::uint32_t& y_out, Runs (&rows_out)[2 * kPlanes]) {
    bool found = false;
    std::uint32_t y = 0;
    for (std::uint32_t i = 0; i < kPlanes; ++i) {
      const bool behind = !here_[i].empty();  // a row ends at this line
      if (!behind && left_[i].empty()) continue;
      const std::uint32_t own = behind ? y_ + 1 : left_[i][0].y;
      if (!found || own < y) y = own;
      found = true;
    }
    for (std::uint32_t i = 0; i < kPlanes; ++i) {
      rows_out[2 * i + 1] = found && y == y_ + 1 ? here_[i] : Runs{};
      rows_out[2 * i] = here_[i] = found ? take_row(left_[i], y) : Runs{};
    }
    y_out = y_ = y;
    return found;
  }

 private:
  static Runs take_row(Runs& runs, std::uint32_t y) {
    std::size_t count = 0;
    for (; count < runs.size() && runs[count].y == y; ++count) {
    }
    const Runs row = runs.first(count);
    runs = runs.subspan(count);
    return row;
  }

  Runs left_[kPlanes], here_[kPlanes] = {};
  std::uint32_t y_ = 0;
};

// The planes that are stored, lowest first.
class Planes {
 public:
  explicit Planes(const Organ& organ) : left_(organ.runs), end_(organ.size_z) {}

  // The next plane; false after the last one: then `z_out` is that of the nodes above it.
  bool next(std::uint32_t& z_out, Runs& runs_out) {
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

 private:
  Runs left_;
  std::uint32_t end_, z_ = 0;
  bool empty_ = false;
};

// Where line y of nodes lies in space. (The last row of each sheet is empty, but not where there is
// one sheet: there y may be its number of rows.)
inline std::uint32_t line_in_space(const Organ& organ, std::uint32_t y) {
  return organ.size_y == organ.sheet_rows ? y : y % organ.sheet_rows;
}

// The order of a file's places: by z, y and x, each below 65 536.
constexpr std::uint64_t order_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return (std::uint64_t{z} << 32U) | (std::uint64_t{y} << 16U) | x;
}
template <typename Place>
constexpr std::uint64_t order_of(const Place& at) {
  return order_of(at.x, at.y, at.z);
}

// Whether row (y, z) has a voxel in [x.begin, x.end).
bool has_voxel(const Organ& organ, Extent x, std::uint32_t y, std::uint32_t z);
// Whether (x, y, z) is a node: the corner of a voxel.
bool has_node(const Organ& organ, std::uint32_t x, std::uint32_t y, std::uint32_t z);

}  // namespace stylet
