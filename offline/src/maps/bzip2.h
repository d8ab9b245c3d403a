// SPDX-License-Identifier: GPL-3.0-or-later
// The voxels of an NRRD that are packed by bzip2, by libbz2: ITK's reader of NRRD was built without
// it.
// Promises: memory follows what the streams really hold, two bytes a value, and ends with what the
// header speaks of; unpacking stops there. What is damaged, cut short or longer than the header
// says is refused with the place. Source: teem.sourceforge.net/nrrd/format.html (encoding: bzip2).
#pragma once

#include <string>
#include <string_view>

#include "maps/header.h"
#include "maps/label_map.h"

namespace stylet::bake {

// Size and labels of the map, layers of a voxel side by side; how many layers there are.
std::size_t read_bzip2(const std::string& path, std::string_view bytes, const Claim& claim,
                       LabelMap& map);

}  // namespace stylet::bake
