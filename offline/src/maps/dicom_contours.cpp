// SPDX-License-Identifier: GPL-3.0-or-later
// Structure sets of radiotherapy (RTSTRUCT): closed contours in planes. The even-odd rule over all
// contours of a structure in a plane decides what is inside, so holes stay open, whether they are
// own contours or keyholes. Each structure is as thick as it was drawn (maps/slabs.h). The smallest
// structure gets a shared voxel, because an outline of the whole body contains all others.
// Source: DICOM PS3.3, C.8.8.5 and C.8.8.6.
#include <algorithm>
#include <array>
#include <cmath>

#include "maps/contours.h"
#include "maps/dicom_file.h"
#include "maps/names.h"
#include "maps/readers.h"
#include "maps/slabs.h"

namespace stylet::offline {
namespace {

constexpr double kFlatM = 1e-4;       // what points may be off their plane
constexpr double kPixelM = 0.5e-3;    // of the raster without a series: a tenth of a lattice voxel
constexpr double kMostAcross = 1024;  // pixels of that raster
constexpr double kMostAcrossSeries = 4096;

struct Structure {
  std::uint16_t label = 0;
  std::string name;
  std::vector<Contour> contours;
};

DcmItem& root_of(const DicomFile& file) {
  return *file.format->getDataset();
}

Contour contour_of(const std::string& where, DcmItem& item) {
  const std::vector<double> numbers = numbers_of_points(where, item, DCM_ContourData);
  if (numbers.size() % 3 != 0 || numbers.size() < 9) {
    refuse("{}: {} numbers in ContourData: expected three points or more, with three numbers each",
           where, numbers.size());
  }
  const double told = number_of(where, item, DCM_NumberOfContourPoints);
  if (!std::isnan(told) && told != static_cast<double>(numbers.size() / 3)) {
    refuse("{}: NumberOfContourPoints {}, but ContourData holds {}: expected as many", where, told,
           numbers.size() / 3);
  }
  Contour contour;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    contour.points_m.push_back(Vec{numbers[i], numbers[i + 1], numbers[i + 2]} * 1e-3);
    if (!(length(contour.points_m.back()) <= kFarthestMm * 1e-3)) {
      refuse("{}: point {}: expected three numbers, at most {} mm away", where, i / 3, kFarthestMm);
    }
  }
  return contour;
}

void take_contours(const DicomFile& file, DcmItem& roi, Structure& structure,
                   std::size_t& left_out) {
  std::size_t i = 0;
  for (DcmItem* const item : items_of(roi, DCM_ContourSequence)) {
    const std::string kind = text_of(*item, DCM_ContourGeometricType);
    const std::string where = fmt::format("{}: {}: contour {}", file.path, structure.name, i++);
    if (kind == "CLOSED_PLANAR" || kind == "CLOSEDPLANAR_XOR") {
      structure.contours.push_back(contour_of(where, *item));
    } else {
      ++left_out;
    }
  }
}

// In the order of the file. Labels are the ROINumbers if all are valid labels, else the order.
std::vector<Structure> structures_of(const DicomFile& file, std::vector<std::string>& notes) {
  std::vector<Structure> structures;
  std::vector<double> numbers;
  bool by_number = true;
  for (DcmItem* const roi : items_of(root_of(file), DCM_StructureSetROISequence)) {
    numbers.push_back(number_of(file.path, *roi, DCM_ROINumber));
    by_number = by_number && numbers.back() >= 1 && numbers.back() <= 65535;
    const std::string name = text_of(*roi, DCM_ROIName);
    require_short(file.path, name);
    structures.push_back({0, printable(name), {}});
  }
  if (structures.empty() || structures.size() > kMostLabels) {
    refuse("{}: {} structures: expected 1 to {}", file.path, structures.size(), kMostLabels);
  }
  for (std::size_t i = 0; i < structures.size(); ++i) {
    structures[i].label =
        by_number ? static_cast<std::uint16_t>(numbers[i]) : static_cast<std::uint16_t>(i + 1);
    if (std::find(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(i), numbers[i]) !=
        numbers.begin() + static_cast<std::ptrdiff_t>(i)) {
      refuse("{}: ROINumber {} is there several times: expected it once", file.path, numbers[i]);
    }
  }
  if (!by_number) {
    notes.push_back(fmt::format(
        "{}: ROINumber {} cannot be a label: its structures are numbered in their order", file.path,
        *std::find_if(numbers.begin(), numbers.end(),
                      [](double number) { return !(number >= 1 && number <= 65535); })));
  }
  std::size_t left_out = 0;
  for (DcmItem* const roi : items_of(root_of(file), DCM_ROIContourSequence)) {
    const double number = number_of(file.path, *roi, DCM_ReferencedROINumber);
    const auto found = std::find(numbers.begin(), numbers.end(), number);
    if (found == numbers.end()) {
      refuse("{}: ReferencedROINumber {}: expected the number of a structure", file.path, number);
    }
    take_contours(file, *roi, structures[static_cast<std::size_t>(found - numbers.begin())],
                  left_out);
  }
  if (left_out > 0) {
    notes.push_back(
        fmt::format("{}: {} contours are points or open lines: left out", file.path, left_out));
  }
  for (Structure& each : structures) {
    const std::size_t repeated = drop_repeated(each.contours);
    if (repeated == 0) continue;
    notes.push_back(fmt::format("{}: {}: {} contours are there twice: each was taken once",
                                file.path, each.name, repeated));
  }
  return structures;
}

template <typename Visit>  // visit(Structure&, Contour&, number of the contour)
void each_contour(std::vector<Structure>& structures, Visit visit) {
  for (Structure& structure : structures) {
    for (std::size_t i = 0; i < structure.contours.size(); ++i) {
      visit(structure, structure.contours[i], i);
    }
  }
}

// In the plane of the largest contour; rows follow the patient's axis that fits this plane best.
Raster own_raster(const DicomFile& file, std::vector<Structure>& structures) {
  Vec normal;
  each_contour(structures, [&](const Structure&, const Contour& contour, std::size_t) {
    const Vec area = area_of(contour);
    if (length(area) > length(normal)) normal = area;
  });
  if (!(length(normal) > 0)) {
    refuse("{}: no contour with an area: expected closed contours in planes", file.path);
  }
  normal = normal * (1 / length(normal));
  constexpr double kAlong = 0.8;
  const bool sagittal = std::fabs(normal.x) > kAlong, axial = std::fabs(normal.z) > kAlong;
  if ((sagittal ? normal.x : axial ? normal.z : normal.y) < 0) normal = normal * -1;
  const Vec axis = sagittal ? Vec{0, 1, 0} : Vec{1, 0, 0};
  const Vec in_plane = axis - normal * dot(normal, axis);
  const Vec row = in_plane * (1 / length(in_plane));
  Raster raster;
  raster.grid = {0, 0, row * kPixelM, cross(normal, row) * kPixelM};
  return raster;
}

Vec normal_of(const PixelGrid& grid) {
  const Vec across = cross(grid.column_step_m, grid.row_step_m);
  return across * (1 / length(across));
}

// Positions, along the normal, of all planes with a contour.
std::vector<double> find_planes(const DicomFile& file, const Raster& raster,
                                std::vector<Structure>& structures) {
  const Vec normal = normal_of(raster.grid);
  std::vector<double> places;
  each_contour(structures, [&](const Structure& structure, Contour& contour, std::size_t i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec& point : contour.points_m) {
      low = std::min(low, dot(normal, point));
      high = std::max(high, dot(normal, point));
    }
    if (high - low > 2 * kFlatM) {
      refuse(
          "{}: {}: contour {} reaches through {:.4g} mm across the planes of the others: expected "
          "all contours in parallel planes",
          file.path, structure.name, i, (high - low) * 1e3);
    }
    contour.along_m = (low + high) / 2;
    places.push_back(contour.along_m);
  });
  std::sort(places.begin(), places.end());
  std::vector<double> planes;
  for (const double place : places) {
    if (planes.empty() || place - planes.back() > kSamePlaneM) planes.push_back(place);
  }
  each_contour(structures, [&](const Structure&, Contour& contour, std::size_t) {
    const auto behind = std::upper_bound(planes.begin(), planes.end(), contour.along_m);
    contour.plane = static_cast<std::size_t>(behind - planes.begin()) - 1;
  });
  return planes;
}

// The planes that a structure has contours in.
std::vector<std::size_t> planes_of(const Structure& structure) {
  std::set<std::size_t> planes;
  for (const Contour& contour : structure.contours) planes.insert(contour.plane);
  return {planes.begin(), planes.end()};
}

// The distance of planes to assume if a structure does not tell it: that of the series, else that
// of the structure that was drawn with the smallest distance.
double distance_m(const DicomFile& file, const Raster& raster, const std::vector<double>& along,
                  const std::vector<Structure>& structures) {
  if (raster.step_m > 0) return raster.step_m;
  double several = HUGE_VAL, any = HUGE_VAL;
  for (const Structure& structure : structures) {
    const std::vector<double> gaps = gaps_of(planes_of(structure), along);
    for (const double gap : gaps) any = std::min(any, gap);
    if (gaps.size() > 1) several = std::min(several, median(gaps));
  }
  if (several < HUGE_VAL) return several;
  if (any < HUGE_VAL) return any;
  refuse(
      "{}: contours in {} plane only, whose thickness is not known: expected several planes, or "
      "the folder with the series they were drawn on",
      file.path, along.size());
}

// Makes the grid as large as the contours; returns the first pixel's place in columns and rows.
std::array<double, 2> fit(const DicomFile& file, Raster& raster,
                          std::vector<Structure>& structures) {
  std::array<double, 2> low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
  const auto bounds = [&](const Structure&, const Contour& contour, std::size_t) {
    for (const Vec& point : contour.points_m) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const Vec step = axis == 0 ? raster.grid.column_step_m : raster.grid.row_step_m;
        const double at = dot(point - raster.anchor_m, step) / dot(step, step);
        low[axis] = std::min(low[axis], at);
        high[axis] = std::max(high[axis], at);
      }
    }
  };
  each_contour(structures, bounds);
  const double across = std::max(high[0] - low[0], high[1] - low[1]);
  if (raster.step_m == 0 && across > kMostAcross) {
    raster.grid.column_step_m = raster.grid.column_step_m * (across / kMostAcross);
    raster.grid.row_step_m = raster.grid.row_step_m * (across / kMostAcross);
    low = {HUGE_VAL, HUGE_VAL};
    high = {-HUGE_VAL, -HUGE_VAL};
    each_contour(structures, bounds);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low[axis] = std::floor(low[axis]);
    const double count = std::ceil(high[axis]) - low[axis] + 1;
    if (!(count <= kMostAcrossSeries)) {
      refuse("{}: contours reach over {} pixels: expected at most {}", file.path, count,
             kMostAcrossSeries);
    }
    (axis == 0 ? raster.grid.columns : raster.grid.rows) = static_cast<std::uint32_t>(count);
  }
  return low;
}

std::size_t voxels_of(const Layers& layers, const Slabs& slabs, const std::vector<Run>& runs) {
  std::size_t voxels = 0;
  for (const Run& run : runs) {
    const Span span = span_of(layers, slabs.at(run.plane));
    voxels += std::size_t{run.end - run.first} * (span.end - span.first);
  }
  return voxels;
}

void put_runs(Stack& stack, const Layers& layers, const Slabs& slabs, std::uint16_t label,
              const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    put_run(stack, span_of(layers, slabs.at(run.plane)), run.row, run.first, run.end, label);
  }
}

// Notes a structure that has layers without a contour between its first and last, or no contour.
void tell_holes(const DicomFile& file, const Layers& layers, const Slabs& slabs,
                const Structure& structure, std::vector<std::string>& notes) {
  if (slabs.empty()) {
    notes.push_back(fmt::format("{}: {} has no closed contour", file.path, structure.name));
    return;
  }
  std::size_t holes = 0;
  std::uint32_t end = span_of(layers, slabs.begin()->second).first;
  for (const auto& [plane, slab] : slabs) {
    const Span span = span_of(layers, slab);
    holes += span.first > end ? span.first - end : 0;
    end = span.end;
  }
  if (holes == 0) return;
  notes.push_back(
      fmt::format("{}: {} has no contour in {} layers of {:.4g} mm between its first and its last: "
                  "taken as empty there",
                  file.path, structure.name, holes, layers.step_m * 1e3));
}

// Notes a structure with planes so far apart that what lies between them is a guess.
void tell_thick(const DicomFile& file, const Slabs& slabs, const Structure& structure,
                std::vector<std::string>& notes) {
  constexpr double kUsualM = 0.02;  // scanners' slices are at most half as thick
  double most_m = 0;
  for (const auto& [plane, slab] : slabs) most_m = std::max(most_m, slab.high_m - slab.low_m);
  if (most_m <= kUsualM) return;
  notes.push_back(
      fmt::format("{}: {}: one contour stands for {:.4g} mm across its planes: expected "
                  "contours at most {:.4g} mm apart",
                  file.path, structure.name, most_m * 1e3, kUsualM * 1e3));
}

// Notes planes in which all contours together hold no pixel: outlined twice, or too small.
void tell_unheld(const DicomFile& file, const Structure& structure, const std::vector<Run>& runs,
                 std::vector<std::string>& notes) {
  std::set<std::size_t> held;
  for (const Run& run : runs) held.insert(run.plane);
  const std::size_t planes = planes_of(structure).size();
  if (held.size() == planes) return;
  notes.push_back(fmt::format(
      "{}: {}: in {} of its {} planes no pixel is inside of its contours: taken as empty there",
      file.path, structure.name, planes - held.size(), planes));
}

// Layers of zeros at the right position.
Stack empty_stack(const DicomFile& file, const Raster& raster, std::array<double, 2> low,
                  const Layers& layers) {
  const PixelGrid& grid = raster.grid;
  const Vec normal = normal_of(grid);
  const Vec corner = raster.anchor_m + grid.column_step_m * low[0] + grid.row_step_m * low[1];
  const Span all = span_of(layers, {layers.low_m, layers.high_m});
  Stack stack;
  stack.grid = grid;
  stack.shift.resize(all.end);
  LabelMap& map = stack.map;
  require_map_size(file.path, {grid.columns, grid.rows, all.end});
  map.size = {grid.columns, grid.rows, all.end};
  map.step_m = {grid.column_step_m, grid.row_step_m, normal * layers.step_m};
  map.origin_m = corner + normal * (layers.low_m + layers.step_m / 2 - dot(normal, corner));
  require_frame(file.path, map);
  map.label.assign(std::size_t{grid.columns} * grid.rows * all.end, 0);
  return stack;
}

Raster raster_of_series(const std::vector<FramePlace>& series) {
  const PixelGrid& grid = series.front().grid;
  std::vector<double> along, gaps;
  for (const FramePlace& slice : series) {
    along.push_back(dot(normal_of(grid), slice.plane.origin_m));
  }
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) gaps.push_back(along[i] - along[i - 1]);
  const double step_m = gaps.empty() ? series.front().plane.thickness_m : median(gaps);
  return {grid, series.front().plane.origin_m, step_m};
}

}  // namespace

LabelMap read_dicom_contours(const DicomFile& file, const std::vector<FramePlace>& series) {
  std::vector<std::string> notes;
  std::vector<Structure> structures = structures_of(file, notes);
  Raster raster = series.empty() ? own_raster(file, structures) : raster_of_series(series);
  const std::vector<double> along = find_planes(file, raster, structures);
  if (along.empty()) refuse("{}: expected closed contours in planes", file.path);
  const double step_m = distance_m(file, raster, along, structures);
  const std::array<double, 2> low = fit(file, raster, structures);
  std::vector<Slabs> slabs;
  for (const Structure& structure : structures) {
    slabs.push_back(slabs_of(planes_of(structure), along, step_m));
  }
  const Layers layers = layers_of(raster.grid, slabs);
  require_filled(file.path, raster.grid, along.size(), layers.high_m - layers.low_m, layers.step_m);
  Stack stack = empty_stack(file, raster, low, layers);
  struct Filled {
    std::size_t structure;
    std::vector<Run> runs;
    std::size_t voxels;
  };
  std::vector<Filled> filled;
  for (std::size_t i = 0; i < structures.size(); ++i) {
    std::vector<Run> runs = runs_of(raster, low, structures[i].contours);
    const std::size_t voxels = voxels_of(layers, slabs[i], runs);
    tell_holes(file, layers, slabs[i], structures[i], notes);
    tell_thick(file, slabs[i], structures[i], notes);
    tell_unheld(file, structures[i], runs, notes);
    filled.push_back({i, std::move(runs), voxels});
    stack.map.names[structures[i].label] = structures[i].name;
  }
  std::stable_sort(filled.begin(), filled.end(),
                   [](const Filled& a, const Filled& b) { return a.voxels > b.voxels; });
  for (const auto& [i, runs, voxels] : filled) {
    put_runs(stack, layers, slabs[i], structures[i].label, runs);
  }
  LabelMap map = std::move(stack.map);
  map.notes.insert(map.notes.end(), notes.begin(), notes.end());
  if (stack.claimed_twice > 0) {
    map.notes.push_back(fmt::format(
        "{}: {} voxels lie in several structures: each was given to the smallest of them",
        file.path, stack.claimed_twice));
  }
  return map;
}

}  // namespace stylet::offline
