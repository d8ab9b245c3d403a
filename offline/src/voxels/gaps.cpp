// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/gaps.h"

namespace stylet::offline {
namespace {

// A flag for each cell of a grid that is enlarged by a rim of empty cells.
struct Mask {
  std::array<std::size_t, 3> size{};
  std::vector<std::uint8_t> set;
};

std::array<std::size_t, 3> steps_of(const Mask& mask) {
  return {1, mask.size[0], mask.size[0] * mask.size[1]};
}

// Gives a cell `value` if its neighbour on one side (see `forward`) has it, axis by axis. Steps to
// one side only, so that gaps of any number of cells, odd or even, are met exactly.
void spread(Mask& mask, std::uint8_t value, bool forward) {
  const auto steps = steps_of(mask);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<std::uint8_t> before = mask.set;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::size_t at = i / steps[axis] % mask.size[axis];
      const bool has_neighbour = forward ? at > 0 : at + 1 < mask.size[axis];
      if (!has_neighbour) continue;
      const std::size_t neighbour = forward ? i - steps[axis] : i + steps[axis];
      if (before[neighbour] == value) mask.set[i] = value;
    }
  }
}

std::size_t in_mask(const Mask& mask, const Grid& grid, std::size_t rim, std::size_t cell) {
  const std::size_t x = cell % grid.size[0], row = cell / grid.size[0];
  const std::size_t y = row % grid.size[1], z = row / grid.size[1];
  return ((z + rim) * mask.size[1] + y + rim) * mask.size[0] + x + rim;
}

bool is_enclosed(const Mask& mask, std::size_t at) {
  const auto steps = steps_of(mask);
  for (std::size_t n = 0; n < 27; ++n) {
    const std::size_t x = n % 3, y = n / 3 % 3, z = n / 9;
    const std::size_t low = at - steps[0] - steps[1] - steps[2];
    if (mask.set[low + x * steps[0] + y * steps[1] + z * steps[2]] == 0) return false;
  }
  return true;
}

}  // namespace

std::size_t fill_gaps(Claims& claims, double width_m, std::uint16_t owner) {
  const Grid& grid = claims.grid;
  const auto rounds = static_cast<std::size_t>(std::floor(width_m / grid.edge_m + 1e-3));
  const std::size_t rim = rounds + 1;
  Mask mask;
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mask.size[axis] = grid.size[axis] + 2 * rim;
    cells *= mask.size[axis];
  }
  mask.set.assign(cells, 0);
  for (std::size_t cell = 0; cell < claims.inside.size(); ++cell) {
    mask.set[in_mask(mask, grid, rim, cell)] = claims.inside[cell] != 0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < rounds; ++i) spread(mask, 1, true);
  for (std::size_t i = 0; i < rounds; ++i) spread(mask, 0, false);
  std::size_t added = 0;
  for (std::size_t cell = 0; cell < claims.inside.size(); ++cell) {
    const std::size_t at = in_mask(mask, grid, rim, cell);
    if (mask.set[at] == 0) continue;
    if (claims.inside[cell] == 0) {
      claims.owner[cell] = owner;
      claims.owner_fill[cell] = 64;
      claims.inside[cell] = kFullCell;
      ++added;
    } else if (is_enclosed(mask, at)) {
      claims.inside[cell] = kFullCell;
    }
  }
  return added;
}

}  // namespace stylet::offline
