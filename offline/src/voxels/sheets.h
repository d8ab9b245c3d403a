// SPDX-License-Identifier: GPL-3.0-or-later
// Own voxels for parts that lie in one cell, or in neighbours, without touching: lobes with a gap
// thinner than a voxel, sheets through one cell. Without them such parts share particles and stick.
//
// Nesme, Kry, Jerabkova, Faure 2009, on the 64 samples of each cell: what hangs together in a cell
// is a voxel; voxels of neighbouring cells whose samples reach each other share the particles of
// the nodes between them, others do not. Voxels that may not share a node go to different sheets of
// the lattice (kernel/schema/organ.fbs); ties join the nodes that are one particle.
//
// Promises: without such parts the lattice comes back as it was. Gaps are seen from about a third
// of a voxel on. Time: linear in voxels. Units: cell edges.
#pragma once

#include "voxels/lattice.h"
#include "voxels/sample_parts.h"

namespace stylet::bake {

// `places` of the samples in `claims`. Refused where the format ends.
Lattice split_parts(const Claims& claims, const SamplePlaces& places, Lattice lattice);

}  // namespace stylet::bake
