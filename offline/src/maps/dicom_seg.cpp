// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>

#include "maps/dicom_file.h"
#include "maps/names.h"
#include "maps/readers.h"
#include "maps/slabs.h"

namespace stylet::offline {
namespace {

struct Frame {
  std::size_t frame = 0, plane = 0;
  std::uint16_t segment = 0;
  FramePlace place;
};

// Whether pixels are segment numbers; in other, older kinds each segment has its own frames.
// Source: DICOM PS3.3, C.8.20.2 (SegmentationType LABELMAP).
bool pixels_are_segments(const DicomFile& file) {
  return text_of(file, DCM_SegmentationType) == "LABELMAP";
}

std::uint16_t segment_of(const DicomFile& file, std::size_t frame,
                         const std::set<std::uint16_t>& described) {
  if (pixels_are_segments(file)) return 0;
  const double number =
      number_of(file, frame, DCM_SegmentIdentificationSequence, DCM_ReferencedSegmentNumber);
  if (!(number >= 1 && number <= 65535)) {
    refuse("{}: ReferencedSegmentNumber {}: expected 1 to 65535", frame_name(file, frame), number);
  }
  if (!described.contains(static_cast<std::uint16_t>(number))) {
    refuse("{}: ReferencedSegmentNumber {}: expected the number of a segment in SegmentSequence",
           frame_name(file, frame), number);
  }
  return static_cast<std::uint16_t>(number);
}

// The frames, sorted along the normal.
std::vector<Frame> frames_of(const DicomFile& file, const std::set<std::uint16_t>& described) {
  require_map_size(file.path, {file.columns, file.rows, file.frames});
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < file.frames; ++i) {
    frames.push_back({i, 0, segment_of(file, i, described), place_of(file, i)});
    require_same_grid(frames.front().place, frames.back().place);
  }
  const PixelGrid& grid = frames.front().place.grid;
  const Vec normal = cross(grid.column_step_m, grid.row_step_m);
  const auto along = [&](const Frame& f) { return dot(normal, f.place.plane.origin_m); };
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const Frame& a, const Frame& b) { return along(a) < along(b); });
  return frames;
}

// Frames of several segments share a plane, even if the last digits of their positions differ.
std::vector<Plane> planes_of(std::vector<Frame>& frames) {
  constexpr double kSameM = 2e-5, kBeside = 0.1;  // kBeside is in pixels
  const PixelGrid& grid = frames.front().place.grid;
  const double pixel_m = std::min(length(grid.column_step_m), length(grid.row_step_m));
  const Vec across = cross(grid.column_step_m, grid.row_step_m);
  const Vec normal = across * (1 / length(across));
  std::vector<Plane> planes;
  for (Frame& each : frames) {
    const Plane& plane = each.place.plane;
    const Vec way = planes.empty() ? Vec{} : plane.origin_m - planes.back().origin_m;
    const bool is_same = !planes.empty() && std::fabs(dot(normal, way)) <= kSameM;
    if (!is_same) planes.push_back(plane);
    const double beside_m = is_same ? length(way - normal * dot(normal, way)) : 0;
    if (beside_m > kBeside * pixel_m) {
      refuse("{}: lies {:.4g} mm to the side of {}: expected the same columns and rows", plane.what,
             beside_m * 1e3, planes.back().what);
    }
    each.plane = planes.size() - 1;
  }
  return planes;
}

// Distance of neighbouring planes: as the file says; else that of its frames if they are evenly
// spaced; else their thickness or, if it is greater, a distance that occurs three times or more in
// a row (slabs.h), since slices may be thinner than their distance. Two frames are not enough to
// tell it: a lesion may be in two slices far apart.
double plane_step_m(const DicomFile& file, const std::vector<Plane>& planes, Vec normal,
                    std::vector<std::string>& notes) {
  const double told_mm = number_of(file, 0, DCM_PixelMeasuresSequence, DCM_SpacingBetweenSlices);
  if (told_mm >= kLeastMm && told_mm <= kFarthestMm) return told_mm * 1e-3;
  std::vector<double> gaps_m;
  for (std::size_t i = 1; i < planes.size(); ++i) {
    gaps_m.push_back(dot(normal, planes[i].origin_m - planes[i - 1].origin_m));
  }
  constexpr double kSame = 1.01, kNext = 1.5;
  const double thick_m = planes.front().thickness_m;
  if (gaps_m.size() > 1) {
    const auto [least_m, most_m] = std::ranges::minmax(gaps_m);
    const bool is_even = most_m <= kSame * least_m;
    if (is_even && (thick_m == 0 || least_m <= kNext * thick_m)) return least_m;
  }
  if (thick_m == 0) {
    refuse(
        "{}: neither SpacingBetweenSlices nor SliceThickness nor the places of the frames tell the "
        "distance of planes: expected one of them",
        file.path);
  }
  const double drawn_m = drawn_gap_m(gaps_m);
  if (drawn_m > kNext * thick_m) {
    notes.push_back(fmt::format(
        "{}: its planes are {:.4g} mm thick and lie {:.4g} mm apart: what lies between them is "
        "taken from the nearest one",
        file.path, thick_m * 1e3, drawn_m * 1e3));
  }
  return std::max(thick_m, drawn_m);
}

// The order in which frames are put into the map: the segment with the highest number comes last.
void sort_by_segment(std::vector<Frame>& frames) {
  std::stable_sort(frames.begin(), frames.end(),
                   [](const Frame& a, const Frame& b) { return a.segment < b.segment; });
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Frame &before = frames[i - 1], &each = frames[i];  // planes ascend in a segment
    if (before.segment != each.segment || before.plane < each.plane) continue;
    refuse("{}: {} this plane in frame {} already: expected each plane once", each.place.plane.what,
           each.segment > 0 ? fmt::format("segment {} has", each.segment) : "there is",
           before.frame);
  }
}

// The smallest stored number with which a pixel belongs to its segment.
double threshold(const DicomFile& file, std::vector<std::string>& notes) {
  const std::string kind = text_of(file, DCM_SegmentationType);
  if (kind == "BINARY") return 1;
  const double most = number_of(file.path, *file.format->getDataset(), DCM_MaximumFractionalValue);
  if (kind != "FRACTIONAL" || !(most >= 1 && most <= 255)) {
    refuse(
        "{}: SegmentationType {}, MaximumFractionalValue {}: expected BINARY, LABELMAP, or "
        "FRACTIONAL and 1 to 255",
        file.path, kind, most);
  }
  notes.push_back(
      fmt::format("{}: a fractional segmentation ({}): a voxel belongs to a segment from a "
                  "fraction of one half on",
                  file.path, text_of(file, DCM_SegmentationFractionalType)));
  return most / 2;
}

bool is_background(DcmItem& segment) {
  const auto types = items_of(segment, DCM_SegmentedPropertyTypeCodeSequence);
  return std::any_of(types.begin(), types.end(), [](DcmItem* type) {
    return text_of(*type, DCM_CodingSchemeDesignator) == "DCM" &&
           text_of(*type, DCM_CodeValue) == "125040";
  });
}

// The pixel value of a label map where there is no segment: its PixelPaddingValue. Without one
// every pixel belongs to a segment, except in files that describe segment 0 as background or not at
// all, like those of dcmqi before 1.5.5. Source: DICOM PS3.3, C.8.20.2; PS3.16, CID 7150.
double background_of(const DicomFile& file) {
  const double told = number_of(file.path, *file.format->getDataset(), DCM_PixelPaddingValue);
  if (!std::isnan(told)) return told;
  for (DcmItem* const segment : items_of(*file.format->getDataset(), DCM_SegmentSequence)) {
    if (number_of(file.path, *segment, DCM_SegmentNumber) != 0 || is_background(*segment)) continue;
    refuse(
        "{}: no PixelPaddingValue, and segment 0 is {}: expected segments from 1 on, or "
        "PixelPaddingValue 0 where that is the background",
        file.path, text_of(*segment, DCM_SegmentLabel));
  }
  return 0;
}

void put_label_map(const DicomFile& file, const std::vector<Frame>& frames, Stack& stack,
                   std::vector<std::string>& notes) {
  const double background = background_of(file);
  std::set<std::uint16_t> different;
  std::size_t empty = 0;
  for (const Frame& frame : frames) {
    std::vector<std::uint16_t> labels = label_pixels(file, frame.frame, different);
    for (std::uint16_t& label : labels) {
      if (label == background) {
        label = 0;
        ++empty;
      } else if (label == 0) {
        refuse("{}: segment 0, where PixelPaddingValue is {}: expected segments from 1 on",
               frame.place.plane.what, background);
      }
    }
    put_plane(stack, frame.plane, labels);
  }
  if (empty > 0 &&
      std::isnan(number_of(file.path, *file.format->getDataset(), DCM_PixelPaddingValue))) {
    notes.push_back(fmt::format(
        "{}: no PixelPaddingValue: its {} pixels of 0 were taken as belonging to no segment",
        file.path, empty));
  }
}

void put_segments(const DicomFile& file, const std::vector<Frame>& frames, Stack& stack,
                  std::vector<std::string>& notes) {
  const double least = threshold(file, notes);
  for (const Frame& frame : frames) {
    std::vector<std::uint16_t> labels;
    for (const std::int32_t pixel : stored_pixels(file, frame.frame)) {
      labels.push_back(pixel >= least ? frame.segment : 0);
    }
    put_plane(stack, frame.plane, labels);
  }
}

// The numbers of all segments, including those without a name.
std::set<std::uint16_t> read_names(const DicomFile& file, LabelMap& map) {
  std::set<std::uint16_t> numbers;
  for (DcmItem* const segment : items_of(*file.format->getDataset(), DCM_SegmentSequence)) {
    const double number = number_of(file.path, *segment, DCM_SegmentNumber);
    if (pixels_are_segments(file) && number == background_of(file)) continue;
    if (!(number >= 1 && number <= 65535)) {
      refuse("{}: SegmentNumber {}: expected 1 to 65535", file.path, number);
    }
    std::string name = text_of(*segment, DCM_SegmentLabel);
    for (DcmItem* const type : items_of(*segment, DCM_SegmentedPropertyTypeCodeSequence)) {
      if (name.empty()) name = text_of(*type, DCM_CodeMeaning);
    }
    numbers.insert(static_cast<std::uint16_t>(number));
    name_label(file.path, map, static_cast<std::uint16_t>(number), name);
  }
  return numbers;
}

}  // namespace

LabelMap read_dicom_seg(const DicomFile& file) {
  LabelMap named;
  std::vector<Frame> frames = frames_of(file, read_names(file, named));
  const std::vector<Plane> planes = planes_of(frames);
  const PixelGrid grid = frames.front().place.grid;
  const Vec across = cross(grid.column_step_m, grid.row_step_m);
  std::vector<std::string> notes;
  const double step_m = plane_step_m(file, planes, across * (1 / length(across)), notes);
  sort_by_segment(frames);
  load_pixels(file);
  Stack stack = sparse_stack(file.path, grid, planes, step_m);
  if (pixels_are_segments(file)) {
    put_label_map(file, frames, stack, notes);
  } else {
    put_segments(file, frames, stack, notes);
  }
  LabelMap map = std::move(stack.map);
  map.notes.insert(map.notes.end(), notes.begin(), notes.end());
  if (stack.claimed_twice > 0) {
    map.notes.push_back(fmt::format(
        "{}: {} voxels lie in several segments: each was given to the one with the higher number",
        file.path, stack.claimed_twice));
  }
  map.names = std::move(named.names);
  return map;
}

}  // namespace stylet::offline
