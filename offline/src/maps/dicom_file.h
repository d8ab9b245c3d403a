// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a file of DICOM frames with DCMTK, from a single slice to an enhanced or segmentation
// object: the pixels of each frame, and its position by its own functional groups, the shared ones
// or the file itself. Only the readers of DICOM include this, as it brings DCMTK's headers.
//
// Promises: data that is missing, cut off, not finite or not understood is refused with file, frame
// and value; memory grows with the bytes of the file, as far as compression allows. Nothing is
// assumed: no spacing of 1 mm, no position at 0. Units: metres. Frame: the patient's (LPS).
// Source: DICOM PS3.3, C.7.6.2 (Image Plane), C.7.6.16 (functional groups).
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "maps/dicom_number.h"
#include "maps/stack.h"

namespace stylet::offline {

struct DicomFile {
  std::string path;
  std::shared_ptr<DcmFileFormat> format;  // large values are still on the disk
  DcmItem* shared = nullptr;              // functional groups of all frames
  std::vector<DcmItem*> groups;           // of each frame; empty in a file of one slice
  std::size_t frames = 1;
  std::uint32_t columns = 0, rows = 0;
};

// Reads everything but large values. Sizes are 0 if the file holds no image.
DicomFile open_dicom(const std::string& path);

std::string text_of(DcmItem& item, const DcmTagKey& tag);
std::string text_of(const DicomFile& file, const DcmTagKey& tag);
std::vector<DcmItem*> items_of(DcmItem& item, const DcmTagKey& sequence);
// Number of a frame, from its own functional group, else the shared one, else the file. Refuses two
// different ones in the first two.
double number_of(const DicomFile& file, std::size_t frame, const DcmTagKey& group,
                 const DcmTagKey& tag, unsigned long place = 0);
// "FILE" for a file with one frame, else "FILE: frame N".
std::string frame_name(const DicomFile& file, std::size_t frame);

// Limits beyond which lengths and positions are refused: no patient is smaller or farther away.
constexpr double kLeastMm = 1e-6, kFarthestMm = 1e6;

struct FramePlace {
  Plane plane;
  PixelGrid grid;
};
FramePlace place_of(const DicomFile& file, std::size_t frame);
// Refuses a frame whose pixels differ from those of `first` in size or direction.
void require_same_grid(const FramePlace& first, const FramePlace& frame);

// Loads and decompresses the pixels; refuses colour images and files that lack some of the pixels.
void load_pixels(const DicomFile& file);
// Pixels as they are stored: bits, unsigned or signed numbers.
std::vector<std::int32_t> stored_pixels(const DicomFile& file, std::size_t frame);
// Pixels with slope and intercept applied; `different` as for take_labels.
std::vector<std::uint16_t> label_pixels(const DicomFile& file, std::size_t frame,
                                        std::set<std::uint16_t>& different);

// ---- readers of one kind of file ----------------------------------------------------------------

LabelMap read_dicom_seg(const DicomFile& file);  // segments, see sparse_stack
// Contours become labels on the pixel grid of the series that they were drawn on; without a series,
// on a raster of half a millimetre.
LabelMap read_dicom_contours(const DicomFile& file, const std::vector<FramePlace>& series);

}  // namespace stylet::offline
