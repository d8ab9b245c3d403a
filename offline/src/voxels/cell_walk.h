// SPDX-License-Identifier: GPL-3.0-or-later
// What the 64 samples of a cell lie in, found along the rows in which layers are counted: the
// owner, and the depth below the layered inputs' surface, measured from a plane through the cell
// and so finer than the samples. Units: in a cell, edges. Time: linear in the cells walked.
#pragma once

#include "voxels/layers.h"
#include "voxels/sample_owners.h"
#include "voxels/sample_parts.h"

namespace stylet::offline {

// A place is beyond the plane if dot(normal, place) > limit.
struct Plane {
  Vec normal;
  double limit = 0;
};

// The plane between the samples in `beyond` and the others. Its normal goes from the middle of the
// others to that of `beyond`, with as many samples on either side. Also for none or all of them.
Plane fit_plane(const SamplePlaces& places, std::uint64_t beyond);

// For the row through each sample: the depth it has reached in the layered inputs.
using Depths = std::array<double, kCellSamples>;

inline bool is_layered(const TissueNumbers& numbers, std::uint16_t owner) {
  return owner != kNoOwner && numbers.is_layered[owner] != 0;
}

struct CellHere {
  OfSamples owner{};
  Depths from{}, at{}, to{};  // each row's depth at its start in the cell, its sample, its end
};

// How the sides of a body bound rows. A fitted plane leans a little, so rows along a side would be
// partly inside; a layer counts them as thick as full rows. So where volumes count (kUpright), a
// row along a side is wholly inside or outside.
enum class Sides { kAsSampled, kUpright };

// Walks cell by cell along the rows of the course.
class CellWalk {
 public:
  CellWalk(const Claims& claims, const SamplePlaces& places, const TissueNumbers& numbers,
           Sides sides = Sides::kAsSampled);

  // Calls visit(cell, what its samples lie in) for each kept cell.
  template <typename Visit>
  void each_cell(Visit visit) const {
    const Grid& grid = claims_.grid;
    const std::size_t axis = numbers_.course.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 3> at{};
    for (at[v] = 0; at[v] < grid.size[v]; ++at[v]) {
      for (at[u] = 0; at[u] < grid.size[u]; ++at[u]) {
        Depths depths{};
        for (std::uint32_t step = 0; step < grid.size[axis]; ++step) {
          at[axis] = numbers_.course.backwards ? grid.size[axis] - 1 - step : step;
          const std::size_t cell = cell_index(grid, at[0], at[1], at[2]);
          if (!is_kept(claims_, cell)) {
            depths = {};
            continue;
          }
          visit(cell, enter(cell, depths));
        }
      }
    }
  }

 private:
  CellHere enter(std::size_t cell, Depths& depths) const;  // moves `depths` on

  const Claims& claims_;
  const SamplePlaces& places_;
  const TissueNumbers& numbers_;
  Sides sides_;
  SampleOwners owners_;
};

}  // namespace stylet::offline
