// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks the voxels of an NRRD file packed by bzip2, with libbz2: ITK's NRRD reader was built
// without it.
// Promises: memory grows with what the streams really hold, two bytes a value (four where layers
// are not the file's first axis), at most to what the header claims; there unpacking stops. Data
// that is damaged, cut short or longer than the header says is refused with the place.
// Source: teem.sourceforge.net/nrrd/format.html (encoding: bzip2).
#pragma once

#include <string>
#include <string_view>

#include "maps/header.h"
#include "maps/label_map.h"

namespace stylet::offline {

// Fills size and labels of the map, the layers of a voxel side by side; returns how many layers.
std::size_t read_bzip2(const std::string& path, std::string_view bytes, const Claim& claim,
                       LabelMap& map);

}  // namespace stylet::offline
