// SPDX-License-Identifier: GPL-3.0-or-later
// Names that a file gives to its labels, and how the names in a recipe are compared with them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "maps/header.h"
#include "maps/label_map.h"

namespace stylet::offline {

// Compares the words of letters and digits, without case or order: "Right kidney" is kidney_right.
bool is_same_name(std::string_view a, std::string_view b);

// The labels with a name: those spelled exactly so if there are any, else those by is_same_name.
std::vector<std::uint16_t> labels_named(const LabelNames& names, std::string_view name);

// The name as one printable line of UTF-8, whatever bytes the file has.
std::string printable(std::string_view name);

// Refuses a name that is longer than anybody would give, before it is compared and told.
void require_short(const std::string& path, std::string_view name);

// An empty name changes nothing; a second, different name is refused, and both are told.
void name_label(const std::string& path, LabelMap& map, std::uint16_t label, std::string_view name);

// The XML of Caret and the Connectome Workbench: <Label Key="5"...>liver</Label> in a LabelTable.
// What cannot be read becomes a note of the map; two names for one label are refused.
void read_label_table(const std::string& path, std::string_view xml, LabelMap& map);

// A segment of 3D Slicer: the voxels of one layer that have one value.
struct Segment {
  std::size_t layer = 0;
  std::uint16_t value = 0;
  std::string name;
};
// SegmentN_Name, _LabelValue, _Layer of an NRRD file with `layers` layers, in the order of N.
std::vector<Segment> slicer_segments(const std::string& path, const Claim& claim,
                                     std::size_t layers);
// With one layer, its labels get their names. With several, `map.label` has the layers of a voxel
// side by side; afterwards the number of its segment, from 1, the higher one if two claim it.
void take_segments(const std::string& path, const std::vector<Segment>& segments,
                   std::size_t layers, LabelMap& map);

}  // namespace stylet::offline
