// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes of a build: where their surfaces come from, and how they get into the organ.
//
// Promises: what cannot be meant is refused with the option's name; what a needle would not find as
// it was asked for is warned of. Units: metres.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asset/membranes.h"
#include "asset/write_organ.h"
#include "base/geometry.h"
#include "pipeline/voxel_materials.h"
#include "voxels/lattice.h"

namespace stylet::offline {

// Each text is MESH:TISSUE, a surface as it is in the file, open or closed; or x=MM:TISSUE, also
// with y and z, a plane through the whole organ.
std::vector<Membrane> parse_membranes(const std::vector<std::string>& texts,
                                      const MeshUnits& units);

// For the organ's provenance.
std::vector<SourceRecord> membrane_records(const std::vector<Membrane>& membranes);

CellGrid cells_of(const Grid& grid);

// Cuts the membranes by the cells of each level. A surface that is too fine for a tick is
// simplified.
MembraneLists place_membranes(const std::vector<Membrane>& membranes,
                              std::span<const Lattice> levels, MaterialList& materials,
                              std::vector<std::string>& warnings);

}  // namespace stylet::offline
