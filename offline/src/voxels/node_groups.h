// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts of the cells around a node share its particle: those that are connected there.
//
// Time: linear in the parts. Units: cell edges.
#pragma once

#include <span>

#include "voxels/cell_parts.h"

namespace stylet::offline {

struct AtNode {
  std::uint32_t part;
  std::uint32_t corner;  // which corner of the part's cell the node is: bits x, y, z
};

class NodeGroups {
 public:
  // All arguments must outlive the object (CellParts).
  NodeGroups(const Claims& claims, const SamplePlaces& places, const Lattice& lattice,
             const Connections& connections)
      : cells(claims, places, lattice, connections) {}

  CellParts cells;

  std::vector<AtNode> around(const CellPlace& node) const;

  // Marks parts, at voxels and beside them, that do not touch all parts of their cell and of the
  // cells around it, and returns whether there are any. If so, finds the groups at the corners of
  // the marked parts; at all other corners every part is of group 0.
  bool find_crowded();
  void find_groups();
  // From now on these parts, which all have the node as a corner, share its particle.
  void unite(const CellPlace& node, std::span<const std::uint32_t> parts);

  // Calls visit(node) once for each corner of the parts that `wanted` accepts, sorted by z, then y,
  // then x.
  template <typename Wanted, typename Visit>
  void each_node(Wanted wanted, Visit visit) const {
    std::vector<std::uint64_t> nodes;
    for (const CellPart& part : cells.parts) {
      if (!wanted(part)) continue;
      const CellPlace at = cells.place_of(part.cell);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint64_t x = at.x + (corner & 1U), y = at.y + (corner >> 1U & 1U);
        nodes.push_back((std::uint64_t{at.z + (corner >> 2U)} << 40U) | (y << 20U) | x);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    constexpr std::uint64_t kBits = (1U << 20U) - 1;
    for (const std::uint64_t node : nodes) {
      visit(CellPlace{static_cast<std::uint32_t>(node & kBits),
                      static_cast<std::uint32_t>(node >> 20U & kBits),
                      static_cast<std::uint32_t>(node >> 40U)});
    }
  }
};

}  // namespace stylet::offline
