// SPDX-License-Identifier: GPL-3.0-or-later
// What is connected in the cells of a lattice, judged by their 64 samples: the parts of each cell,
// which of them are too small to count, and which parts of neighbouring cells are connected.
//
// Time: linear in the cells. Units: cell edges.
#pragma once

#include <algorithm>

#include "voxels/apart.h"
#include "voxels/lattice.h"
#include "voxels/sample_parts.h"

namespace stylet::offline {

constexpr std::uint32_t kNoPart = 0xFFFFFFFF, kNoSheet = 0xFFFFFFFF;

struct CellPlace {
  std::uint32_t x, y, z;
};

// A step to one of the 26 neighbours, or to the cell itself.
struct CellStep {
  int x, y, z;

  std::size_t index() const { return static_cast<std::size_t>(x + 1 + 3 * (y + 1) + 9 * (z + 1)); }
  Vec vec() const { return {1.0 * x, 1.0 * y, 1.0 * z}; }
  bool is_small() const { return std::max({std::abs(x), std::abs(y), std::abs(z)}) <= 1; }
};
constexpr CellStep step_of(int index) {
  return {index % 3 - 1, index / 3 % 3 - 1, index / 9 - 1};
}

struct CellPart {
  std::uint32_t cell = 0;
  std::uint32_t host = kNoPart;  // for a part without samples: the neighbour's part it belongs to
  std::uint32_t sheet = kNoSheet;
  bool crowded = false;      // a part of a neighbouring cell does not touch it
  std::uint64_t inside = 0;  // its samples
  std::uint32_t sides = 1;   // that it consists of (voxels/apart.h); without samples: its host's
  std::uint64_t quarters = kFullCell;
  std::array<std::uint8_t, 8> group{};  // per corner: parts of the same group share the particle
  bool is_voxel = true;                 // else another level has the voxel of this place
  bool is_beside = true;                // it is a voxel, or touches the cell of one
};

// What connects samples: the reach of each, if gaps part them, else the cells; but nothing connects
// inputs that are apart.
struct Connections {
  bool gaps_part = true;
  ApartOwners apart;
};

class CellParts {
 public:
  // Finds the parts. All arguments must outlive the object, and the voxel numbers of `lattice` must
  // not change as long as parts are asked for.
  CellParts(const Claims& claims, const SamplePlaces& places, const Lattice& lattice,
            const Connections& connections);

  std::vector<CellPart> parts;
  std::vector<std::uint32_t> first;  // first part of each voxel of `lattice`, then the end

  CellPlace place_of(std::uint32_t cell) const;
  CellStep between(const CellPart& a, const CellPart& b) const;

  // Calls visit(number) for each part of the cell one `step` away.
  template <typename Visit>
  void each_part(const CellPlace& from, const CellStep& step, Visit visit) const {
    const auto& size = lattice_.grid.size;
    const auto x = from.x + static_cast<std::uint32_t>(step.x);  // below 0: wraps beyond the size
    const auto y = from.y + static_cast<std::uint32_t>(step.y);
    const auto z = from.z + static_cast<std::uint32_t>(step.z);
    if (x >= size[0] || y >= size[1] || z >= size[2]) return;
    const std::uint32_t voxel = lattice_.voxel_of_cell[cell_index(lattice_.grid, x, y, z)];
    if (voxel == kNoVoxel) return;
    for (std::uint32_t i = first[voxel]; i < first[voxel + 1]; ++i) visit(i);
  }

  // Whether parts of neighbouring cells are connected; with few samples, also through cells around.
  // Parts without samples follow their hosts; if these are missing: connected.
  bool linked(std::uint32_t i, std::uint32_t j) const;

  // Samples in cells of another side that touch no part of their own side. No part has them,
  // because a voxel of these samples would be connected with nothing.
  struct Stray {
    std::uint32_t cell;
    std::uint64_t samples;
  };
  std::vector<Stray> strays;

 private:
  // The parts with samples in cells and their 26 neighbours, and which are connected there.
  struct Block {
    std::vector<std::uint32_t> part, set;
  };

  std::vector<std::uint64_t> connected(std::uint32_t cell, std::uint64_t bits) const;
  void find_parts();
  void settle_specks();
  void find_empty_parts();
  std::size_t nearest(const std::vector<std::uint64_t>& bits, Vec place) const;
  std::vector<CellPart> settled(std::size_t voxel);
  std::vector<CellPart> empty_parts(const CellPart& empty) const;
  std::size_t same_set(const std::vector<CellPart>& kept,
                       const std::vector<std::uint32_t>& kept_set, const CellPart& part,
                       std::uint32_t set) const;
  void join_nearest(const CellPart& speck, std::vector<CellPart>& kept);
  std::vector<std::uint32_t> sets_around(std::uint32_t cell,
                                         const std::vector<std::uint32_t>& around) const;
  bool apart(const CellPart& a, const CellPart& b) const;
  bool touch(const CellPart& a, const CellPart& b) const;
  Block block_around(const std::vector<std::uint32_t>& cells) const;
  static std::uint32_t set_of(const Block& block, std::uint32_t part);

  const Claims& claims_;
  const SamplePlaces& places_;
  const Lattice& lattice_;
  bool gaps_part_;
  SampleSides sides_;
  std::array<Near, 27> near_{};
};

}  // namespace stylet::offline
