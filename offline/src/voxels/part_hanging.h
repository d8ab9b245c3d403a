// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts hang on which, where levels of voxels meet and parts do not touch (voxels/sheets.h).
//
// Each level also knows parts a little beyond its own voxels: in cells where another level has the
// voxels, these parts tell what is connected with what. Finer parts in a coarser cell that are
// connected within the cell belong together, to the coarser part that has most of its samples in
// them. (They belong to none if those samples are too few to be a part: then they are a sliver of
// another body, for which the coarser cell has no voxel.) So a node of finer voxels hangs on the
// coarser parts to which the finer parts belong that share the node's particle. If there are
// several such coarser parts, they share the particles of the nodes around: what finer samples
// connect is connected. A node whose parts touch nothing there is free.
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

// Sorted by node, then group. Needs the groups of both levels, and unites some of the coarser
// level.
std::vector<GroupHangs> hang_groups(const NodeGroups& fine, const SamplePlaces& places,
                                    const ApartOwners& apart, NodeGroups& coarse_io);

}  // namespace stylet::offline
