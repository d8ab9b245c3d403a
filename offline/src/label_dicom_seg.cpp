// SPDX-License-Identifier: GPL-3.0-or-later
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmfg/fgseg.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>
#include <dcmtk/dcmseg/segutils.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string_view>

#include "label_readers.h"

namespace stylet::bake {
namespace {

constexpr double kMetresPerMm = 1e-3;

struct Plane {
  Vec origin_m;
  double along_m = 0;  // the planes' normal
  std::uint16_t segment = 0;
  std::size_t frame = 0;
};

template <typename Group>
Group& group_of(const std::string& path, FGInterface& groups, std::size_t frame,
                DcmFGTypes::E_FGType type, const char* name) {
  auto* group = dynamic_cast<Group*>(groups.get(static_cast<Uint32>(frame), type));
  if (group == nullptr) refuse("{}: frame {}: expected its {}", path, frame, name);
  return *group;
}

// Directions along a row and a column, and the pixels' size, which all frames share.
void read_directions(const std::string& path, FGInterface& groups, LabelMap& map) {
  Vec row, column;
  auto& orientation = group_of<FGPlaneOrientationPatient>(
      path, groups, 0, DcmFGTypes::EFG_PLANEORIENTPATIENT, "plane orientation");
  Float64 row_mm = 0, column_mm = 0;
  auto& measures =
      group_of<FGPixelMeasures>(path, groups, 0, DcmFGTypes::EFG_PIXELMEASURES, "pixel measures");
  if (orientation.getImageOrientationPatient(row.x, row.y, row.z, column.x, column.y, column.z)
          .bad() ||
      measures.getPixelSpacing(column_mm, 0).bad() || measures.getPixelSpacing(row_mm, 1).bad()) {
    refuse("{}: expected ImageOrientationPatient and PixelSpacing", path);
  }
  map.step_m[0] = row * (row_mm * kMetresPerMm);
  map.step_m[1] = column * (column_mm * kMetresPerMm);
}

std::vector<Plane> read_planes(const std::string& path, DcmSegmentation& file, Vec normal) {
  std::vector<Plane> planes(file.getNumberOfFrames());
  FGInterface& groups = file.getFunctionalGroups();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Plane& plane = planes[i];
    plane.frame = i;
    Vec at_mm;
    auto& position = group_of<FGPlanePosPatient>(path, groups, i, DcmFGTypes::EFG_PLANEPOSPATIENT,
                                                 "plane position");
    auto& segment =
        group_of<FGSegmentation>(path, groups, i, DcmFGTypes::EFG_SEGMENTATION, "segment number");
    if (position.getImagePositionPatient(at_mm.x, at_mm.y, at_mm.z).bad() ||
        segment.getReferencedSegmentNumber(plane.segment).bad()) {
      refuse("{}: frame {}: expected ImagePositionPatient and ReferencedSegmentNumber", path, i);
    }
    plane.origin_m = at_mm * kMetresPerMm;
    plane.along_m = dot(normal, plane.origin_m);
  }
  std::sort(planes.begin(), planes.end(),
            [](const Plane& a, const Plane& b) { return a.along_m < b.along_m; });
  return planes;
}

// Distance of neighbouring planes: as the file says, else the smallest between its frames.
double plane_step_m(const std::string& path, FGInterface& groups,
                    const std::vector<Plane>& planes) {
  constexpr double kSameM = 1e-5;
  auto& measures =
      group_of<FGPixelMeasures>(path, groups, 0, DcmFGTypes::EFG_PIXELMEASURES, "pixel measures");
  Float64 mm = 0;
  if (measures.getSpacingBetweenSlices(mm).good() && mm > 0) return mm * kMetresPerMm;
  double step_m = 0, widest_m = 0;
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const double gap_m = planes[i].along_m - planes[i - 1].along_m;
    if (gap_m > kSameM && (step_m == 0 || gap_m < step_m)) step_m = gap_m;
    widest_m = std::max(widest_m, gap_m);
  }
  // A lesion in two slices far apart: only planes that are regular tell their distance.
  const bool regular = planes.size() > 2 && widest_m - step_m <= kSameM && step_m > 0;
  const bool thick = measures.getSliceThickness(mm).good() && mm > 0;
  if (regular && (!thick || step_m <= 1.5 * mm * kMetresPerMm)) return step_m;
  if (!thick) {
    refuse(
        "{}: neither SpacingBetweenSlices nor SliceThickness, and frames that do not tell it: "
        "expected one of them",
        path);
  }
  return mm * kMetresPerMm;
}

void take_frame(const std::string& path, DcmSegmentation& file, const Plane& plane,
                std::size_t layer, LabelMap& map) {
  const std::size_t pixels = std::size_t{map.size[0]} * map.size[1];
  const std::unique_ptr<DcmIODTypes::Frame> frame(
      DcmSegUtils::unpackBinaryFrame(file.getFrame(plane.frame), static_cast<Uint16>(map.size[1]),
                                     static_cast<Uint16>(map.size[0])));
  if (!frame || frame->length < pixels) {
    refuse("{}: frame {}: expected {} pixels of a bit", path, plane.frame, pixels);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    if (frame->pixData[i] != 0) map.label[layer * pixels + i] = plane.segment;
  }
}

void read_names(DcmSegmentation& file, LabelMap& map) {
  for (std::size_t number = 1; number <= file.getNumberOfSegments(); ++number) {
    DcmSegment* segment = file.getSegment(number);
    OFString name;
    if (segment != nullptr && segment->getSegmentLabel(name).good()) {
      map.names[static_cast<std::uint16_t>(number)] = name.c_str();
    }
  }
}

// Where segments overlap, the one with the higher number has the voxel, whatever the last digits of
// a frame's place are.
std::vector<Plane> in_order(const std::vector<Plane>& planes, double step_m) {
  std::vector<Plane> sorted = planes;
  const auto key = [&](const Plane& plane) {
    return std::pair(std::lround((plane.along_m - planes.front().along_m) / step_m), plane.segment);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Plane& a, const Plane& b) { return key(a) < key(b); });
  return sorted;
}

void fill(const std::string& path, DcmSegmentation& file, Uint16 columns, Uint16 rows,
          LabelMap& map) {
  if (file.getSegmentationType() != DcmSegTypes::ST_BINARY) {
    refuse("{}: a fractional segmentation: expected a binary one", path);
  }
  read_directions(path, file.getFunctionalGroups(), map);
  const Vec across = cross(map.step_m[0], map.step_m[1]);
  const Vec normal = across * (1 / length(across));
  const std::vector<Plane> planes = read_planes(path, file, normal);
  if (planes.empty()) refuse("{}: no frames: expected one at least", path);
  const double step_m = plane_step_m(path, file.getFunctionalGroups(), planes);
  const double layers = (planes.back().along_m - planes.front().along_m) / step_m;
  map.step_m[2] = normal * step_m;
  map.origin_m = planes.front().origin_m;
  require_frame(path, map);
  require_map_size(path, {columns, rows, static_cast<std::size_t>(std::lround(layers)) + 1});
  map.size = {columns, rows, static_cast<std::uint32_t>(std::lround(layers)) + 1};
  map.label.assign(std::size_t{map.size[0]} * map.size[1] * map.size[2], 0);
  for (const Plane& plane : in_order(planes, step_m)) {
    constexpr double kOff = 0.05;  // of a step
    const Vec way = plane.origin_m - planes.front().origin_m;
    const Vec aside = way - normal * dot(normal, way);
    if (length(aside) > kOff * std::min(length(map.step_m[0]), length(map.step_m[1]))) {
      refuse(
          "{}: frame {} lies {:.4g} mm to the side of the others: expected the same columns and "
          "rows",
          path, plane.frame, length(aside) * 1e3);
    }
    const double layer = (plane.along_m - planes.front().along_m) / step_m;
    if (std::fabs(layer - std::round(layer)) > kOff) {
      refuse("{}: frame {} lies between the planes that are {:.6g} mm apart: expected it on one",
             path, plane.frame, step_m * 1e3);
    }
    take_frame(path, file, plane, static_cast<std::size_t>(std::lround(layer)), map);
  }
  read_names(file, map);
}

}  // namespace

bool is_dicom(const std::string& path) {
  constexpr std::size_t kPreamble = 128;
  std::array<char, kPreamble + 4> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  return file && std::string_view(head.data() + kPreamble, 4) == "DICM";
}

void require_whole_dicom(const std::string& path) {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  DcmFileFormat format;
  OFCondition condition = format.loadFile(path.c_str());
  if (condition.good()) condition = format.loadAllDataIntoMemory();
  if (condition.bad()) refuse("{}: ends too early, or is damaged: {}", path, condition.text());
}

LabelMap read_dicom_seg(const std::string& path) {
  const Silence silence;
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  DcmFileFormat format;
  Uint16 rows = 0, columns = 0;
  DcmSegmentation* loaded = nullptr;
  OFCondition condition = format.loadFile(path.c_str());
  if (condition.good()) {
    DcmDataset& dataset = *format.getDataset();
    (void)dataset.findAndGetUint16(DCM_Rows, rows);
    (void)dataset.findAndGetUint16(DCM_Columns, columns);
    condition = DcmSegmentation::loadDataset(dataset, loaded);
  }
  const std::unique_ptr<DcmSegmentation> file(loaded);
  if (condition.bad() || !file) {
    refuse("{}: expected a DICOM segmentation: {}; of a series of slices give the folder", path,
           condition.text());
  }
  LabelMap map;
  fill(path, *file, columns, rows, map);
  return map;
}

}  // namespace stylet::bake
