// SPDX-License-Identifier: GPL-3.0-or-later
// Gives separate voxels to parts that do not touch but lie in one cell or in neighbouring cells:
// lobes with a gap thinner than a voxel, thin walls. Else such parts share particles and stick.
//
// Nesme, Kry, Jerabkova, Faure 2009, with the 64 samples of each cell: each connected part in a
// cell is a voxel; voxels of neighbouring cells whose samples reach each other share the particles
// of the nodes between them, others do not. Voxels that must not share a node go to different
// sheets of the lattice (kernel/schema/organ.fbs); ties join the nodes that are one particle.
//
// With levels of voxels each level has parts and sheets of its own; nodes of finer parts hang on
// the coarser parts that they touch (voxels/part_hanging.h).
//
// Inputs that are apart (voxels/apart.h) are parts that do not touch, however near they are.
//
// Promises: without such parts the lattice is unchanged. Gaps are detected from about a third of a
// voxel on. Time: linear in voxels. Units: cell edges.
#pragma once

#include "voxels/cell_parts.h"

namespace stylet::offline {

// One lattice for each level, as from make_lattices. `places` are those of the samples in `levels`,
// which lose what no voxel could hold (CellParts::strays). `cut`: cells of level 0 that are cut
// away (voxels/crop.h). Refuses what exceeds the limits of the format.
std::vector<Lattice> split_parts(std::vector<Claims>& levels, const SamplePlaces& places,
                                 std::vector<Lattice> lattices,
                                 const std::vector<std::uint8_t>& cut = {},
                                 const Connections& connections = {});

}  // namespace stylet::offline
