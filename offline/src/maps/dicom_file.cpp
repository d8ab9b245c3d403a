// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/dicom_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/dicom_bounds.h"
#include "maps/header.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

constexpr double kMetresPerMm = 1e-3;

DcmDataset& dataset_of(const DicomFile& file) {
  return *file.format->getDataset();
}

std::uint16_t count_of(const DicomFile& file, const DcmTagKey& tag, std::uint16_t otherwise) {
  const double count = number_of(file.path, dataset_of(file), tag);
  if (std::isnan(count)) return otherwise;
  if (!(count >= 0 && count <= 65535)) {
    refuse("{}: {} {}: expected 0 to 65535", file.path, DcmTag(tag).getTagName(), count);
  }
  return static_cast<std::uint16_t>(count);
}

// Refuses too many claimed frames or pixels before memory is allocated for each of them.
void require_pixels_held(const DicomFile& file) {
  DcmDataset& data = dataset_of(file);
  const std::uint16_t bits = std::max<std::uint16_t>(1, count_of(file, DCM_BitsAllocated, 1));
  require_map_size(file.path, {file.columns, file.rows, file.frames});
  const std::uint64_t pixels = std::uint64_t{file.columns} * file.rows * file.frames;
  Claim claim;
  claim.packed = DcmXfer(data.getOriginalXfer()).isEncapsulated();
  claim.sizes = {(pixels * bits + 7) / 8};
  std::error_code error;
  require_held(file.path, claim, std::filesystem::file_size(file.path, error));
}

void read_groups(DicomFile& file) {
  DcmDataset& data = dataset_of(file);
  const double frames = number_of(file.path, data, DCM_NumberOfFrames);
  constexpr double kMostFrames = 2147483647;  // of an integer string (PS3.5, 6.2)
  if (!std::isnan(frames) && !(frames >= 1 && frames <= kMostFrames)) {
    refuse("{}: NumberOfFrames {}: expected 1 to {}", file.path, frames, kMostFrames);
  }
  file.frames = std::isnan(frames) ? 1 : static_cast<std::size_t>(frames);
  file.groups = items_of(data, DCM_PerFrameFunctionalGroupsSequence);
  const std::vector<DcmItem*> shared = items_of(data, DCM_SharedFunctionalGroupsSequence);
  if (!shared.empty()) file.shared = shared.front();
  // Numbers of each frame are looked for among all elements of these two.
  for (DcmItem* const item : {static_cast<DcmItem*>(&data), file.shared}) {
    constexpr unsigned long kMost = 4000;  // private ones of scanners are hundreds
    if (item == nullptr || item->card() <= kMost) continue;
    refuse("{}: {} elements on one level: expected at most {}", file.path, item->card(),
           kMost);
  }
  if (!file.groups.empty() && file.groups.size() != file.frames) {
    refuse("{}: {} frames, but functional groups of {}: expected one group for each frame",
           file.path, file.frames, file.groups.size());
  }
  if (file.frames > 1 && file.columns > 0 && file.rows > 0) require_pixels_held(file);
}

Vec vector_at(const DicomFile& file, std::size_t frame, const DcmTagKey& group,
              const DcmTagKey& tag, unsigned long first) {
  const auto number = [&](unsigned long i) {
    return number_of(file, frame, group, tag, first + i);
  };
  return {number(0), number(1), number(2)};
}

bool is_turned(Vec a, Vec b) {
  constexpr double kSame = 1e-4;  // a twentieth of a millimetre over half a metre
  return length(a - b) > kSame;
}

}  // namespace

DicomFile open_dicom(const std::string& path) {
  DicomFile file;
  file.path = path;
  file.format = std::make_shared<DcmFileFormat>();
  load_dicom(path, *file.format);
  file.columns = count_of(file, DCM_Columns, 0);
  file.rows = count_of(file, DCM_Rows, 0);
  read_groups(file);
  return file;
}

std::string text_of(DcmItem& item, const DcmTagKey& tag) {
  OFString text;
  (void)item.findAndGetOFStringArray(tag, text);
  return text.c_str();
}

std::string text_of(const DicomFile& file, const DcmTagKey& tag) {
  return text_of(dataset_of(file), tag);
}

std::vector<DcmItem*> items_of(DcmItem& item, const DcmTagKey& sequence) {
  DcmSequenceOfItems* found = nullptr;
  std::vector<DcmItem*> items;
  if (item.findAndGetSequence(sequence, found).bad() || found == nullptr) return items;
  for (DcmObject* each = found->nextInContainer(nullptr); each != nullptr;
       each = found->nextInContainer(each)) {
    if (auto* next = dynamic_cast<DcmItem*>(each)) items.push_back(next);
  }
  return items;
}

double number_of(const DicomFile& file, std::size_t frame, const DcmTagKey& group,
                 const DcmTagKey& tag, unsigned long place) {
  constexpr double kSame = 1e-4;  // of numbers with a few digits
  const std::string where = frame_name(file, frame);
  const auto told_by = [&](DcmItem* groups) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    DcmSequenceOfItems* found = nullptr;
    if (groups == nullptr || groups->findAndGetSequence(group, found).bad()) return kNone;
    if (found->card() > 1) {
      refuse("{}: {} items in {}: expected one", where, found->card(), DcmTag(group).getTagName());
    }
    return found->card() == 0 ? kNone : number_of(where, *found->getItem(0), tag, place);
  };
  const double own = told_by(frame < file.groups.size() ? file.groups[frame] : nullptr);
  const double shared = told_by(file.shared);
  // DICOM has each functional group in one of the two only (PS3.3, C.7.6.16.1).
  if (std::fabs(own - shared) > kSame * std::max({1.0, std::fabs(own), std::fabs(shared)})) {
    refuse("{}: {} {} for this frame, but {} for all frames: expected it in one place", where,
           DcmTag(tag).getTagName(), own, shared);
  }
  if (!std::isnan(own)) return own;
  return std::isnan(shared) ? number_of(where, dataset_of(file), tag, place) : shared;
}

std::string frame_name(const DicomFile& file, std::size_t frame) {
  return file.frames == 1 ? file.path : fmt::format("{}: frame {}", file.path, frame);
}

FramePlace place_of(const DicomFile& file, std::size_t frame) {
  constexpr double kUnit = 1e-3;  // error of cosines with a few digits
  const std::string what = frame_name(file, frame);
  const DcmTagKey turn = DCM_PlaneOrientationSequence;
  Vec along_row = vector_at(file, frame, turn, DCM_ImageOrientationPatient, 0);
  Vec along_column = vector_at(file, frame, turn, DCM_ImageOrientationPatient, 3);
  const bool square = std::fabs(length(along_row) - 1) <= kUnit &&
                      std::fabs(length(along_column) - 1) <= kUnit &&
                      std::fabs(dot(along_row, along_column)) <= kUnit;
  if (!square) {
    refuse(
        "{}: ImageOrientationPatient {} {} {} {} {} {}: expected two directions of length 1 at "
        "right angles",
        what, along_row.x, along_row.y, along_row.z, along_column.x, along_column.y,
        along_column.z);
  }
  std::array<double, 2> pixel_mm{};
  for (unsigned long axis = 0; axis < 2; ++axis) {
    pixel_mm[axis] = number_of(file, frame, DCM_PixelMeasuresSequence, DCM_PixelSpacing, axis);
    if (!(pixel_mm[axis] >= kLeastMm && pixel_mm[axis] <= kFarthestMm)) {
      refuse("{}: PixelSpacing {}: expected two sizes in mm, both above 0", what, pixel_mm[axis]);
    }
  }
  FramePlace place;
  const Vec at_mm = vector_at(file, frame, DCM_PlanePositionSequence, DCM_ImagePositionPatient, 0);
  if (!(length(at_mm) <= kFarthestMm)) {
    refuse("{}: ImagePositionPatient {} {} {}: expected three numbers, at most {} mm away", what,
           at_mm.x, at_mm.y, at_mm.z, kFarthestMm);
  }
  const double thick_mm = number_of(file, frame, DCM_PixelMeasuresSequence, DCM_SliceThickness, 0);
  const bool thick = thick_mm >= kLeastMm && thick_mm <= kFarthestMm;
  place.plane = {at_mm * kMetresPerMm, thick ? thick_mm * kMetresPerMm : 0, what};
  // PixelSpacing has the distance of rows first, then that of columns.
  along_row = along_row * (1 / length(along_row));
  along_column = along_column - along_row * dot(along_row, along_column);
  along_column = along_column * (1 / length(along_column));
  place.grid = {file.columns, file.rows, along_row * (pixel_mm[1] * kMetresPerMm),
                along_column * (pixel_mm[0] * kMetresPerMm)};
  return place;
}

void require_same_grid(const FramePlace& first, const FramePlace& frame) {
  const PixelGrid &a = first.grid, &b = frame.grid;
  if (a.columns != b.columns || a.rows != b.rows) {
    refuse("{}: {} x {} pixels: expected {} x {}, as in {}", frame.plane.what, b.columns, b.rows,
           a.columns, a.rows, first.plane.what);
  }
  constexpr double kSame = 1e-4;
  for (const bool is_row : {false, true}) {
    const Vec one = is_row ? a.row_step_m : a.column_step_m;
    const Vec other = is_row ? b.row_step_m : b.column_step_m;
    const double one_mm = length(one) * 1e3, other_mm = length(other) * 1e3;
    if (std::fabs(one_mm - other_mm) > kSame * one_mm) {
      refuse("{}: pixels of {:.6g} mm: expected {:.6g} mm, as in {}", frame.plane.what, other_mm,
             one_mm, first.plane.what);
    }
    const Vec there = other * (1e3 / other_mm);
    if (!is_turned(one * (1e3 / one_mm), there)) continue;
    refuse("{}: {} along {:.5g} {:.5g} {:.5g}: expected the same direction as in {}",
           frame.plane.what, is_row ? "columns" : "rows", there.x, there.y, there.z,
           first.plane.what);
  }
}

void load_pixels(const DicomFile& file) {
  DcmDataset& data = dataset_of(file);
  const std::uint16_t samples = count_of(file, DCM_SamplesPerPixel, 1);
  if (samples != 1) {
    refuse("{}: {} values a pixel: expected labels, which have one value a pixel", file.path,
           samples);
  }
  const std::uint16_t bits = count_of(file, DCM_BitsAllocated, 0);
  const std::uint16_t used = count_of(file, DCM_BitsStored, bits);
  if ((bits != 1 && bits != 8 && bits != 16) || used < 1 || used > bits) {
    refuse("{}: {} of {} bits a pixel are used: expected at least one of 1, 8 or 16 bits",
           file.path, used, bits);
  }
  require_pixels_held(file);
  const std::uint64_t pixels = std::uint64_t{file.columns} * file.rows * file.frames;
  const std::uint64_t wanted = (pixels * bits + 7) / 8;
  const DcmXfer stored(data.getOriginalXfer());
  if (stored.isEncapsulated() && stored.isLossy()) {
    refuse("{}: {}: this compression changes values: expected one without loss", file.path,
           stored.getXferName());
  }
  OFCondition condition = data.loadAllDataIntoMemory();
  if (condition.bad()) {
    refuse("{}: ends too early, or is damaged: {}", file.path, condition.text());
  }
  condition = data.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  if (condition.bad()) {
    refuse("{}: {}: cannot be decompressed: {}", file.path, stored.getXferName(), condition.text());
  }
  DcmElement* element = nullptr;
  (void)data.findAndGetElement(DCM_PixelData, element);
  const std::uint64_t there = element == nullptr ? 0 : element->getLength();
  if (there < wanted) {
    refuse("{}: {} bytes of pixels: expected {}", file.path, there, wanted);
  }
}

std::vector<std::int32_t> stored_pixels(const DicomFile& file, std::size_t frame) {
  const unsigned bits = count_of(file, DCM_BitsAllocated, 0);
  const unsigned used = count_of(file, DCM_BitsStored, static_cast<std::uint16_t>(bits));
  const unsigned high = count_of(file, DCM_HighBit, static_cast<std::uint16_t>(used - 1));
  const bool is_signed = count_of(file, DCM_PixelRepresentation, 0) == 1;
  if (high + 1 < used || high >= bits) {
    refuse("{}: HighBit {}: expected {} to {}", file.path, high, used - 1, bits - 1);
  }
  DcmElement* element = nullptr;
  (void)dataset_of(file).findAndGetElement(DCM_PixelData, element);
  Uint8* bytes = nullptr;
  Uint16* words = nullptr;
  const OFCondition condition = element == nullptr ? EC_TagNotFound
                                : bits == 16       ? element->getUint16Array(words)
                                                   : element->getUint8Array(bytes);
  if (condition.bad() || (bytes == nullptr && words == nullptr)) {
    refuse("{}: expected pixels: {}", file.path, condition.text());
  }
  const std::size_t pixels = std::size_t{file.columns} * file.rows;
  std::vector<std::int32_t> values(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = frame * pixels + i;
    if (bits == 1) {
      values[i] = bytes[at / 8] >> (at % 8) & 1;
      continue;
    }
    const unsigned raw = bits == 16 ? words[at] : bytes[at];
    const unsigned value = raw >> (high + 1 - used) & ((1U << used) - 1);
    const bool negative = is_signed && (value >> (used - 1) & 1U) != 0;
    values[i] = static_cast<std::int32_t>(value) - (negative ? 1 << used : 0);
  }
  return values;
}

std::vector<std::uint16_t> label_pixels(const DicomFile& file, std::size_t frame,
                                        std::set<std::uint16_t>& different) {
  const DcmTagKey group = DCM_PixelValueTransformationSequence;
  const double told = number_of(file, frame, group, DCM_RescaleSlope);
  const double added = number_of(file, frame, group, DCM_RescaleIntercept);
  const double slope = std::isnan(told) ? 1 : told, intercept = std::isnan(added) ? 0 : added;
  const std::vector<std::int32_t> stored = stored_pixels(file, frame);
  std::vector<char> bytes(stored.size() * sizeof(double));
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const double value = stored[i] * slope + intercept;
    std::memcpy(bytes.data() + i * sizeof(double), &value, sizeof(double));
  }
  LabelMap map;
  take_labels<double>(frame_name(file, frame), bytes, map, different);
  return std::move(map.label);
}

}  // namespace stylet::offline
