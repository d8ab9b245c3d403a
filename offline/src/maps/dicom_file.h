// SPDX-License-Identifier: GPL-3.0-or-later
// A file of DICOM frames by DCMTK, from a single slice to an enhanced or segmentation object: where
// each frame lies, as its own or the shared functional groups or the file itself say, and what its
// pixels are. Only the readers of DICOM include this, as it brings DCMTK's headers.
//
// Promises: what is missing, cut off, not finite or not understood is refused with file, frame and
// value; memory follows the bytes there are, as far as compression allows. Nothing is taken for
// granted: no spacing of 1 mm, no place at 0. Units: metres. Frame: the patient's (LPS).
// Source: DICOM PS3.3, C.7.6.2 (Image Plane), C.7.6.16 (functional groups).
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "maps/stack.h"

namespace stylet::bake {

struct DicomFile {
  std::string path;
  std::shared_ptr<DcmFileFormat> format;  // large values are still on the disk
  DcmItem* shared = nullptr;              // functional groups of all frames
  std::vector<DcmItem*> groups;           // of each frame; none in a file of a slice
  std::size_t frames = 1;
  std::uint32_t columns = 0, rows = 0;
};

// Everything but large values. Sizes are 0 where it holds no image.
DicomFile open_dicom(const std::string& path);

std::string text_of(DcmItem& item, const DcmTagKey& tag);
std::string text_of(const DicomFile& file, const DcmTagKey& tag);
// Not a number where there is none.
double number_of(DcmItem& item, const DcmTagKey& tag, unsigned long place = 0);
std::vector<DcmItem*> items_of(DcmItem& item, const DcmTagKey& sequence);
// Of a frame: in its functional group, the shared one, or the file.
double number_of(const DicomFile& file, std::size_t frame, const DcmTagKey& group,
                 const DcmTagKey& tag, unsigned long place = 0);
// "FILE" of a file of one frame, else "FILE: frame N".
std::string frame_name(const DicomFile& file, std::size_t frame);

// Lengths and places beyond are refused: no patient is smaller or farther away.
constexpr double kLeastMm = 1e-6, kFarthestMm = 1e6;

struct FramePlace {
  Plane plane;
  PixelGrid grid;
};
FramePlace place_of(const DicomFile& file, std::size_t frame);
// Refuses a frame whose pixels are not as large and turned as those of `first`.
void require_same_grid(const FramePlace& first, const FramePlace& frame);

// Brings the pixels into memory, decompressed; refuses colours and what does not hold them all.
void load_pixels(const DicomFile& file);
// As stored: bits, unsigned or signed numbers.
std::vector<std::int32_t> stored_pixels(const DicomFile& file, std::size_t frame);
// With slope and intercept; `different` as for take_labels.
std::vector<std::uint16_t> label_pixels(const DicomFile& file, std::size_t frame,
                                        std::set<std::uint16_t>& different);

// ---- readers of one kind of file ----------------------------------------------------------------

LabelMap read_dicom_seg(const DicomFile& file);  // segments, see sparse_stack
// Contours, on the pixels of the series they were drawn on; without one, on a raster of half a
// millimetre.
LabelMap read_dicom_contours(const DicomFile& file, const std::vector<FramePlace>& series);

}  // namespace stylet::bake
