// SPDX-License-Identifier: Apache-2.0
#include "lattice_plan.h"

#include "voxel.h"

namespace stylet {
namespace {

// Row (y, z) of the lattice; null beyond the edge and where there is no voxel.
Row* row_at(const ModelView& model, std::uint32_t y, std::uint32_t z) {
  if (y >= model.head->size_y) return nullptr;  // y - 1 of the first line wraps
  const std::uint32_t index = model.row_of[z * model.head->size_y + y];
  return index == kNoRow ? nullptr : model.row + index;
}

Extent extent_of(const Row* row) {
  if (row == nullptr) return {0, 0};
  return {row->x0, static_cast<std::uint32_t>(row->x0) + row->count};
}

// Slot at the low side of node `x`, in its plane; windows reach at most their own width before it.
std::int32_t slot_of(const Row& row, const Plane& plane, std::uint32_t x) {
  return static_cast<std::int32_t>(row.slot + x) -
         static_cast<std::int32_t>(plane.slot_begin + row.x0);
}

void fill_line(const ModelView& model, std::uint32_t y, std::uint32_t z, std::uint32_t width,
               Window*& next) {
  const Row* before = row_at(model, y - 1, z);
  const Row* behind = row_at(model, y, z);
  const Plane& plane = model.plane[z];
  const std::uint32_t above = model.plane[z + 1].particle_begin;
  const auto visit = [&](std::uint32_t x, std::uint16_t one, std::uint16_t other) {
    const Row& row = behind != nullptr ? *behind : *before;
    const std::uint32_t side = behind != nullptr ? 0 : 1;
    // Without a node of a row the other is read twice: that one is at hand.
    *next++ = {{slot_of(one != 0 ? *before : *behind, plane, x),
                slot_of(other != 0 ? *behind : *before, plane, x)},
               {one, other},
               row.node[side] + x - row.x0 - plane.particle_begin,
               row.node[side + 2] + x - row.x0 - above};
  };
  for_each_window(extent_of(before), extent_of(behind), width, visit);
}

}  // namespace

void fill_windows(const ModelView& model) {
  Window* next[2] = {model.window8, model.window16};
  for (std::uint32_t z = 0; z < model.head->counts.planes; ++z) {
    Plane& plane = model.plane[z];
    for (std::uint32_t i = 0; i < 2; ++i) {
      const Window* const first = i == 0 ? model.window8 : model.window16;
      plane.window_begin[i] = static_cast<std::uint32_t>(next[i] - first);
      for (std::uint32_t y = 0; y <= model.head->size_y; ++y) {
        if (Row* const row = row_at(model, y, z)) {
          row->window[i] = static_cast<std::uint32_t>(next[i] - first);
        }
        fill_line(model, y, z, 8U << i, next[i]);
      }
      plane.window_end[i] = static_cast<std::uint32_t>(next[i] - first);
    }
  }
}

}  // namespace stylet
