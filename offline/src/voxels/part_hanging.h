// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts hang on which, where levels of voxels meet and parts do not touch (voxels/sheets.h).
//
// Each level knows its parts also a little beyond its voxels: where another level has them, its own
// parts tell what is connected with what. Finer parts in a coarser cell that are connected within
// it belong to the coarser part that has most of its samples in them. (To none, if these are too
// few to be a part: a sliver of another body, for which the coarser cell has no voxel.) So a node
// of finer voxels hangs on the coarser parts that own the parts which share its particle. If there
// are several, these share the particles of the nodes around: what finer samples connect is
// connected. A node whose parts touch nothing there is free.
//
// Time: linear in the parts. Units: cell edges.
#pragma once

#include "voxels/node_groups.h"

namespace stylet::offline {

struct GroupHangs {
  CellPlace node;
  std::uint8_t group;  // of the parts with voxels around it
  std::uint32_t on;    // a part of the coarser level
};

// Sorted by node, then group. Groups of both levels have been found; those of the coarser one grow.
std::vector<GroupHangs> hang_groups(const NodeGroups& fine, const SamplePlaces& places,
                                    const ApartOwners& apart, NodeGroups& coarse_io);

}  // namespace stylet::offline
