// SPDX-License-Identifier: GPL-3.0-or-later
// A label map: a number for every voxel of an image, and where the image lies in the patient.
//
// Read with ITK: NRRD (.nrrd .nhdr; with libbz2 if packed by bzip2), MetaImage (.mha .mhd). With
// DCMTK: a folder with one series of DICOM slices or a structure set; a DICOM segmentation,
// structure set or image of several frames (.dcm, or any name). With CGAL: Inrimage (.inr .inr.gz).
// Own reader: NIfTI (.nii .nii.gz), versions 1 and 2. If two segments claim a voxel (DICOM, layers
// of 3D Slicer) the higher number wins; if two structures do, the smaller structure wins.
// Axes, spacing, direction cosines and units are the header's. It may leave left and right open
// (with a note), but not the spacing. Promises: what is not a label map (fractions, negative
// numbers, more than kMostLabels values, other than three dimensions) or contradicts itself is
// refused with one line; memory and time grow with the file's bytes, not with what a header claims.
// Units: metres. Frame: the patient's, x to the left, y to the back, z to the head (LPS).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace stylet::offline {

using LabelNames = std::map<std::uint16_t, std::string>;

// Label 0 is the space between the organs.
struct LabelMap {
  std::array<std::uint32_t, 3> size{};  // first index fastest
  std::vector<std::uint16_t> label;
  Vec origin_m;                    // centre of the first voxel
  std::array<Vec, 3> step_m;       // from a voxel to the next one along each index
  LabelNames names;                // as far as the file has them
  std::string sha256;              // of the file; if there are several files, of their sums
  std::vector<std::string> notes;  // what its reader had to decide, one sentence for each
};

// Decided by the name alone; nothing is read.
bool is_label_map(const std::filesystem::path& path);
LabelMap read_label_map(const std::filesystem::path& path);

double voxel_volume_m3(const LabelMap& map);

struct LabelCount {
  std::uint16_t label = 0;
  std::size_t voxels = 0;
  Vec centroid_m;
};
// Sorted by label, without label 0.
std::vector<LabelCount> count_labels(const LabelMap& map);

}  // namespace stylet::offline
