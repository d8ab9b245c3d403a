// SPDX-License-Identifier: GPL-3.0-or-later
// A label map: a number for every voxel of an image, and where the image lies in the patient.
//
// Read by ITK: NRRD (.nrrd .nhdr; by libbz2 where it is packed so), MetaImage (.mha .mhd); by
// DCMTK: a folder with one series of DICOM slices or a structure set, a DICOM segmentation,
// structure set or image of several frames (.dcm, or whatever name); by CGAL: Inrimage (.inr
// .inr.gz); by ourselves: NIfTI (.nii .nii.gz), versions 1 and 2. Of segments that claim a voxel
// both, in DICOM or in layers of 3D Slicer, the higher number wins, of structures the smaller one.
// Axes, spacing, direction cosines and units are those of the header; left and right may stay open,
// with a note, spacing not. Promises: what is no label map (fractions, negative numbers, more
// values than anybody names, other than three dimensions) and what contradicts itself is refused
// with one line; memory and time follow the bytes there are, not what a header says. Units: metres.
// Frame: the patient's, x to the left, y to the back, z to the head (LPS).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace stylet::bake {

using LabelNames = std::map<std::uint16_t, std::string>;

// 0 is what lies between the organs.
struct LabelMap {
  std::array<std::uint32_t, 3> size{};  // first index fastest
  std::vector<std::uint16_t> label;
  Vec origin_m;                    // centre of the first voxel
  std::array<Vec, 3> step_m;       // from a voxel to the next one along each index
  LabelNames names;                // as far as the file knows them
  std::string sha256;              // of the file; of several that belong together, of their sums
  std::vector<std::string> notes;  // what its reader had to decide, a sentence each
};

// By its name; nothing is read.
bool is_label_map(const std::filesystem::path& path);
LabelMap read_label_map(const std::filesystem::path& path);

double voxel_volume_m3(const LabelMap& map);

struct LabelCount {
  std::uint16_t label = 0;
  std::size_t voxels = 0;
  Vec centroid_m;
};
// In ascending order, without 0.
std::vector<LabelCount> count_labels(const LabelMap& map);

}  // namespace stylet::bake
