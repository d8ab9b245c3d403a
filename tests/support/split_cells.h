// SPDX-License-Identifier: Apache-2.0
// A block of cells, each of which may be split into eight, again and again: which cells are.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <set>

namespace stylet::test {

using LevelCell = std::array<std::uint32_t, 4>;  // level, x, y, z in it

// Whether a cell of this level (not the finest) is split. Where neighbours would differ by more
// than one level, the coarser one is split as well.
using Split = std::function<bool(std::uint32_t level, int x, int y, int z)>;

class SplitCells {
 public:
  // So many cells of level 0 along each axis.
  SplitCells(std::array<int, 3> size, std::uint32_t levels, const Split& split) : size_(size) {
    choose(levels, split);
  }

  // Calls visit(LevelCell) for the cells that are not split.
  template <typename Visit>
  void each(Visit visit) const {
    each_in_level(0, [&](int x, int y, int z) { each_in(cell(0, x, y, z), visit); });
  }

 private:
  static LevelCell cell(std::uint32_t level, int x, int y, int z) {
    return {level, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
            static_cast<std::uint32_t>(z)};
  }

  template <typename Visit>
  void each_in_level(std::uint32_t level, Visit visit) const {
    const int nx = size_[0] << level, ny = size_[1] << level, nz = size_[2] << level;
    for (int i = 0; i < nx * ny * nz; ++i) visit(i % nx, i / nx % ny, i / nx / ny);
  }

  template <typename Visit>
  void each_in(const LevelCell& at, Visit visit) const {
    const auto& [level, x, y, z] = at;
    if (split_.count(at) == 0) {
      visit(at);
      return;
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
      each_in({level + 1, 2 * x + (i & 1U), 2 * y + ((i >> 1U) & 1U), 2 * z + (i >> 2U)}, visit);
    }
  }

  // Those asked for, and from the finest on those beside them.
  void choose(std::uint32_t levels, const Split& split) {
    for (std::uint32_t level = 0; level + 1 < levels; ++level) {
      each_in_level(level, [&](int x, int y, int z) {
        if (level > 0 && split_.count(cell(level - 1, x / 2, y / 2, z / 2)) == 0) return;
        if (split(level, x, y, z)) split_.insert(cell(level, x, y, z));
      });
    }
    for (std::uint32_t level = levels - 1; level-- > 1;) {
      const std::set<LevelCell> now = split_;
      for (const LevelCell& each : now) {
        for (int side = 0; each[0] == level && side < 27; ++side) split_around(each, side);
      }
    }
  }

  void split_around(const LevelCell& of, int side) {
    const std::uint32_t level = of[0];
    const int x = static_cast<int>(of[1]) + side % 3 - 1,
              y = static_cast<int>(of[2]) + side / 3 % 3 - 1,
              z = static_cast<int>(of[3]) + side / 9 - 1;
    if (x < 0 || y < 0 || z < 0 || x >= size_[0] << level || y >= size_[1] << level ||
        z >= size_[2] << level) {
      return;
    }
    split_.insert(cell(level - 1, x / 2, y / 2, z / 2));
  }

  std::array<int, 3> size_;
  std::set<LevelCell> split_;
};

// Splits about this part of the cells.
inline Split at_random(unsigned seed, double part) {
  return [=](std::uint32_t level, int x, int y, int z) {
    std::seed_seq place = {seed, level, static_cast<unsigned>(x), static_cast<unsigned>(y),
                           static_cast<unsigned>(z)};
    std::mt19937 random(place);
    return std::bernoulli_distribution(part)(random);
  };
}

}  // namespace stylet::test
