// SPDX-License-Identifier: GPL-3.0-or-later
// Names that a file gives its labels, and how a recipe's names are compared with them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "maps/header.h"
#include "maps/label_map.h"

namespace stylet::bake {

// Words of letters and digits count, not their case or order: "Right kidney" is kidney_right.
bool is_same_name(std::string_view a, std::string_view b);

// The labels of a name: those spelled like it where there are any, else those that are the same.
std::vector<std::uint16_t> labels_named(const LabelNames& names, std::string_view name);

// One printable line of UTF-8, whatever the file has.
std::string printable(std::string_view name);

// A name that is none changes nothing; a second one that is another is refused with both.
void name_label(const std::string& path, LabelMap& map, std::uint16_t label, std::string_view name);

// The XML of Caret and the Connectome Workbench: <Label Key="5"...>liver</Label> in a LabelTable.
// What cannot be read becomes a note of the map; two names for one label are refused.
void read_label_table(const std::string& path, std::string_view xml, LabelMap& map);

// A segment of 3D Slicer: the voxels of a layer that have a value.
struct Segment {
  std::size_t layer = 0;
  std::uint16_t value = 0;
  std::string name;
};
// SegmentN_Name, _LabelValue, _Layer of an NRRD with so many layers, in the order of N.
std::vector<Segment> slicer_segments(const std::string& path, const Claim& claim,
                                     std::size_t layers);
// Labels of one layer get their names. Of several, `map.label` has the layers of each voxel side by
// side; afterwards the number of its segment, from 1, the higher where two claim it.
void take_segments(const std::string& path, const std::vector<Segment>& segments,
                   std::size_t layers, LabelMap& map);

}  // namespace stylet::bake
