// SPDX-License-Identifier: Apache-2.0
// The runs of an organ as its lattice stores them: planes, lines of nodes, stretches along x.
//
// The memory of a lattice depends on its voxels, not on the space between them. Along x, voxels
// with fewer than kGap empty cells between them are one stretch; cells between two stretches are
// not stored. Of several empty planes in a row, one is stored. Rows without a voxel are not stored.
//
// Promises: no allocation; all walks together visit each run a fixed number of times.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
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

// At most so many planes and rows are walked together: those beside a plane of nodes, and those
// beside a line of nodes.
constexpr std::uint32_t kPlanesTogether = 2;
constexpr std::uint32_t kRowsTogether = 2 * kPlanesTogether;

// The stretches that the voxels of several rows make together, one after the other.
class Stretches {
 public:
  Stretches(std::initializer_list<Runs> rows) : Stretches(std::span(rows.begin(), rows.size())) {}
  explicit Stretches(std::span<const Runs> rows);

  // The next stretch; false after the last one.
  bool next(Extent& stretch_out);

 private:
  Runs left_[kRowsTogether];
  std::uint32_t rows_;
};

// The voxel rows beside a line of nodes: those at y, then y - 1, of each plane.
using Beside = std::array<Runs, kRowsTogether>;

// The lines of nodes along x between the voxel rows of one plane or of two, by rising y.
class Lines {
 public:
  Lines(std::initializer_list<Runs> planes);

  // The next line y that has a node; false after the last one.
  bool next(std::uint32_t& y_out, Beside& rows_out);

 private:
  Runs left_[kPlanesTogether], here_[kPlanesTogether] = {};
  std::uint32_t planes_, y_ = 0;
};

// The planes that are stored, lowest first.
class Planes {
 public:
  explicit Planes(const Organ& organ) : left_(organ.runs), end_(organ.size_z) {}

  // The next plane; false after the last one: then `z_out` is that of the nodes above it.
  bool next(std::uint32_t& z_out, Runs& runs_out);

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
