// SPDX-License-Identifier: GPL-3.0-or-later
// Which labels of a map become which tissue: a TOML file.
//
//   [names]            # optional: names of labels; default: the names in the map's file
//   liver = 5
//   [tissues]          # tissue = labels, by number or name
//   liver = ["liver"]
//   vessel = [52, 63]
//
//   [crop]             # optional: leave out what is farther from these labels along the map's axes
//   around = ["liver"]
//   margin_mm = 20
//
//   [surface]          # optional
//   smoothing = 10     # rounds of Taubin's filter, 0 to 100
//   triangles = 30000  # upper limit, 1000 or more; default: as many as the map has
//
//   [[wall]]           # optional, from the inside out: layers around all labels of the map
//   tissue = "fat"
//   thickness_mm = 10
//
//   [contact]          # optional
//   touching = "shared"  # the only value: organs that touch share particles, but see [[slide]]
//   gaps = "open"      # parts that do not touch get voxels of their own, see voxels/sheets.h;
//                      # or "closed"
//
//   [[slide]]          # optional: a tissue that is not joined to another, but slides along it
//   tissue = "liver"
//   on = "muscle"
//   friction = 0.1     # optional: this is the default
//
//   [refine]           # optional: where voxels are finer, in the words of base/refinement.h
//   where = ["labels:vessel:2", "surface"]
//
//   [obstacles]        # optional: bodies no needle enters, each the convex hull of some labels
//   rib = ["rib_right_9"]
//
//   [membranes]        # optional: a tissue thinner than a voxel, around these labels where they
//   dura = ["csf"]     # border on other tissues
//
//   [targets]          # optional: what the needle is to reach; its labels may also be a tissue
//   lesion = [2]
//
// Labels that no tissue lists are left out of the organ. Names are compared by their words:
// "Right kidney" is kidney_right.
// Promise: a recipe is accepted whole or refused with `file:line: key: ...`. A recipe is also
// refused if it gives a label another name than the map's file does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/refinement.h"
#include "base/slide.h"
#include "stylet/limits.h"

namespace stylet::offline {

struct LabelGroup {
  std::string tissue;
  std::vector<std::uint16_t> labels;
};

struct NamedLabels {
  std::string name;
  std::vector<std::uint16_t> labels;
};

struct WallLayer {
  std::string tissue;
  double thickness_m = 0;
};

struct Recipe {
  std::map<std::uint16_t, std::string> names;
  std::vector<LabelGroup> groups;               // sorted by tissue name; no label is in two of them
  std::vector<std::uint16_t> crop_around = {};  // empty: the whole map
  double crop_margin_m = 0;
  int smoothing = 10;
  std::uint32_t most_triangles = kMaxTriangles;
  std::vector<WallLayer> wall = {};
  bool open_gaps = false;
  std::vector<NamedLabels> obstacles = {};  // their labels are not in a tissue
  std::vector<NamedLabels> targets = {};
  std::vector<NamedLabels> membranes = {};  // by tissue
  std::vector<Slide> slides = {};
  std::vector<Refinement> refinements = {};
};

// Names that the file of a label map gives to its labels; may be empty.
struct FileNames {
  std::string path = {};
  std::map<std::uint16_t, std::string> names = {};
};

Recipe read_recipe(const std::filesystem::path& toml_file, const FileNames& of_map = {});

}  // namespace stylet::offline
