// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "maps/readers.h"

namespace stylet::offline {
namespace {

constexpr double kSameM = 1e-5;      // positions are written with two digits of a millimetre
constexpr double kEven = 0.01;       // of a distance: how far a plane may be off its even place
constexpr double kWidest = 1.5;      // of the usual distance; in a wider gap, a plane is missing
constexpr double kNarrowest = 0.5;   // of the usual distance; nearer planes overlap
constexpr double kBeside = 0.1;      // of a pixel: how far a plane may be off the others' line
constexpr double kUpright = 0.05;    // of a pixel: a smaller lean is invisible
constexpr double kMostLeanDeg = 45;  // gantries tilt by 30 degrees
constexpr std::uint32_t kFiner = 8;  // layers for the finest distance of an uneven stack
constexpr double kFineVoxels = 1U << 26U;  // a map has fine layers up to this number of voxels

struct Placed {
  std::size_t plane = 0;           // index in the planes as given
  double along_m = 0;              // along the normal, from the first plane
  std::array<double, 2> beside{};  // in columns and rows
};

// What is known of a stack before its layers are chosen.
struct Frame {
  const std::string& path;
  const PixelGrid& grid;
  const std::vector<Plane>& planes;
  Vec normal;
  std::vector<Placed> order;      // planes, sorted along the normal
  std::array<double, 2> lean{};   // columns and rows per metre along the normal
  std::array<double, 2> start{};  // of the line that planes lie on, where along_m is 0
};

const std::string& name_of(const Frame& f, std::size_t place) {
  return f.planes[f.order[place].plane].what;
}

double pixel_m(const Frame& f, std::size_t axis) {
  return length(axis == 0 ? f.grid.column_step_m : f.grid.row_step_m);
}

void put_in_order(Frame& f) {
  const Vec across = cross(f.grid.column_step_m, f.grid.row_step_m);
  f.normal = across * (1 / length(across));
  for (std::size_t i = 0; i < f.planes.size(); ++i) {
    f.order.push_back({i, dot(f.normal, f.planes[i].origin_m), {}});
  }
  std::stable_sort(f.order.begin(), f.order.end(),
                   [](const Placed& a, const Placed& b) { return a.along_m < b.along_m; });
  const Vec first_m = f.planes[f.order.front().plane].origin_m;
  const double low_m = f.order.front().along_m;
  for (Placed& placed : f.order) {
    placed.along_m -= low_m;
    const Vec way = f.planes[placed.plane].origin_m - first_m;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Vec step = axis == 0 ? f.grid.column_step_m : f.grid.row_step_m;
      placed.beside[axis] = dot(way, step) / dot(step, step);
    }
  }
}

void check_not_twice(const Frame& f) {
  for (std::size_t i = 1; i < f.order.size(); ++i) {
    const double gap_m = f.order[i].along_m - f.order[i - 1].along_m;
    if (gap_m > kSameM) continue;
    refuse("{}: lies {:.6g} mm from {}: expected no slice missing or twice", name_of(f, i),
           gap_m * 1e3, name_of(f, i - 1));
  }
}

// Finds the line that most planes lie on; refuses a plane beside it.
void find_lean(Frame& f) {
  if (f.order.size() < 2) return;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> leans, starts;
    for (std::size_t i = 1; i < f.order.size(); ++i) {
      leans.push_back((f.order[i].beside[axis] - f.order[i - 1].beside[axis]) /
                      (f.order[i].along_m - f.order[i - 1].along_m));
    }
    f.lean[axis] = median(leans);
    for (const Placed& p : f.order) starts.push_back(p.beside[axis] - f.lean[axis] * p.along_m);
    f.start[axis] = median(starts);
  }
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    std::array<double, 2> off{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      off[axis] = f.order[i].beside[axis] - f.start[axis] - f.lean[axis] * f.order[i].along_m;
    }
    if (std::hypot(off[0], off[1]) <= kBeside) continue;
    refuse(
        "{}: lies {:.4g} mm to the side of the line of the others: expected all on one line; "
        "resample the series first",
        name_of(f, i), std::hypot(off[0] * pixel_m(f, 0), off[1] * pixel_m(f, 1)) * 1e3);
  }
}

// Whether the stack leans noticeably; if so, adds a note.
bool leans(const Frame& f, std::vector<std::string>& notes) {
  const double height_m = f.order.back().along_m;
  if (std::hypot(f.lean[0], f.lean[1]) * height_m <= kUpright) return false;
  const double degrees =
      std::atan(std::hypot(f.lean[0] * pixel_m(f, 0), f.lean[1] * pixel_m(f, 1))) * 180 /
      std::numbers::pi;
  if (degrees > kMostLeanDeg) {
    refuse("{}: its planes lean by {:.3g} degrees: expected at most {}, as of a tilted gantry",
           f.path, degrees, kMostLeanDeg);
  }
  notes.push_back(
      fmt::format("{}: its planes lean by {:.3g} degrees (tilted gantry): put upright by whole "
                  "pixels, to within half a pixel",
                  f.path, degrees));
  return true;
}

std::vector<double> distances_m(const Frame& f) {
  std::vector<double> distances;
  for (std::size_t i = 1; i < f.order.size(); ++i) {
    distances.push_back(f.order[i].along_m - f.order[i - 1].along_m);
  }
  return distances;
}

// The distances that planes would have if they touched; empty if their thickness is not known.
std::vector<double> touching_m(const Frame& f) {
  std::vector<double> out;
  for (std::size_t i = 1; i < f.order.size(); ++i) {
    const double before_m = f.planes[f.order[i - 1].plane].thickness_m;
    const double own_m = f.planes[f.order[i].plane].thickness_m;
    if (!(before_m > 0 && own_m > 0)) return {};
    out.push_back((before_m + own_m) / 2);
  }
  return out;
}

// Notes that planes do not fill the space between them, if the widest gap shows this.
void tell_gaps(const Frame& f, const std::vector<double>& distances,
               std::vector<std::string>& notes) {
  const std::vector<double> touching = touching_m(f);
  std::size_t widest = 0;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (distances[i] * touching[widest] > distances[widest] * touching[i]) widest = i;
  }
  if (touching.empty() || !(distances[widest] > kWidest * touching[widest])) return;
  notes.push_back(
      fmt::format("{}: slices of {:.4g} mm lie {:.4g} mm apart: what lies between them is taken "
                  "from the nearest one",
                  f.path, touching[widest] * 1e3, distances[widest] * 1e3));
}

// Refuses planes whose distances are not all about the same multiple of those of touching planes.
void check_distances(const Frame& f, const std::vector<double>& distances) {
  const std::vector<double> touching = touching_m(f);
  const auto expected = [&](std::size_t i) { return touching.empty() ? 1.0 : touching[i]; };
  std::vector<double> factors;
  for (std::size_t i = 0; i < distances.size(); ++i) factors.push_back(distances[i] / expected(i));
  const double usual = median(factors);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (factors[i] >= kNarrowest * usual && factors[i] <= kWidest * usual) continue;
    refuse(
        "{}: lies {:.6g} mm from the slice before, but by the others it should be {:.6g} mm: "
        "expected no slice missing or twice",
        name_of(f, i + 1), distances[i] * 1e3, usual * expected(i) * 1e3);
  }
}

// Whether all planes lie at multiples of the step from the first.
bool is_even(const Frame& f, double step_m) {
  return std::all_of(f.order.begin(), f.order.end(), [&](const Placed& placed) {
    const double layer = placed.along_m / step_m;
    return std::fabs(layer - std::round(layer)) * step_m <= kSameM + kEven * step_m;
  });
}

// Layers along the normal; `first_m` is the middle of the first.
struct Layers {
  double first_m = 0, step_m = 0;
  std::uint32_t count = 0;
};

Layers checked_layers(const Frame& f, double first_m, double step_m, double count) {
  const double most = static_cast<double>(kMostMapVoxels);
  require_map_size(f.path, {f.grid.columns, f.grid.rows,
                            static_cast<std::size_t>(std::clamp(count, 0.0, most + 1))});
  return {first_m, step_m, static_cast<std::uint32_t>(count)};
}

Stack with_layers(const Frame& f, const Layers& layers, bool is_leaning,
                  std::vector<std::string> notes) {
  Stack stack;
  stack.grid = f.grid;
  stack.spans.resize(f.planes.size());
  stack.shift.resize(layers.count);
  std::array<std::int32_t, 2> low{}, high{};
  for (std::uint32_t layer = 0; layer < layers.count && is_leaning; ++layer) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double at_m = layers.first_m + layer * layers.step_m;
      const double shift = std::round(f.start[axis] + f.lean[axis] * at_m);
      if (!(std::fabs(shift) < static_cast<double>(kMostMapVoxels))) {
        refuse("{}: planes are shifted by {} pixels: expected a smaller image", f.path, shift);
      }
      const auto whole = static_cast<std::int32_t>(shift);
      stack.shift[layer][axis] = whole;
      low[axis] = layer == 0 ? whole : std::min(low[axis], whole);
      high[axis] = layer == 0 ? whole : std::max(high[axis], whole);
    }
  }
  for (auto& shift : stack.shift) shift = {shift[0] - low[0], shift[1] - low[1]};
  const std::size_t columns = f.grid.columns + static_cast<std::size_t>(high[0] - low[0]);
  const std::size_t rows = f.grid.rows + static_cast<std::size_t>(high[1] - low[1]);
  LabelMap& map = stack.map;
  require_map_size(f.path, {columns, rows, layers.count});
  map.size = {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), layers.count};
  map.step_m = {f.grid.column_step_m, f.grid.row_step_m, f.normal * layers.step_m};
  map.origin_m = f.planes[f.order.front().plane].origin_m + f.normal * layers.first_m +
                 map.step_m[0] * low[0] + map.step_m[1] * low[1];
  map.notes = std::move(notes);
  require_frame(f.path, map);
  map.label.assign(columns * rows * layers.count, 0);
  return stack;
}

Stack even_stack(const Frame& f, double step_m, std::vector<std::string> notes) {
  const bool is_leaning = leans(f, notes);
  const double count = std::round(f.order.back().along_m / step_m) + 1;
  Stack stack = with_layers(f, checked_layers(f, 0, step_m, count), is_leaning, std::move(notes));
  for (const Placed& placed : f.order) {
    const auto layer = static_cast<std::uint32_t>(std::lround(placed.along_m / step_m));
    stack.spans[placed.plane] = {layer, layer + 1};
  }
  return stack;
}

// The range of each plane along the normal: to half the way to a neighbour, or to half of `alone_m`
// if the neighbour is farther than kWidest times `alone_m`.
std::vector<Slab> slabs_of(const Frame& f, const std::vector<double>& distances, double alone_m) {
  const auto half = [&](std::size_t gap, std::size_t otherwise) {
    const double way = gap < distances.size() ? distances[gap] : 0;
    if (way == 0) return (alone_m > 0 ? alone_m : distances[otherwise]) / 2;
    return (alone_m > 0 && way > kWidest * alone_m ? alone_m : way) / 2;
  };
  std::vector<Slab> slabs;
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    const double at = f.order[i].along_m;
    slabs.push_back({at - half(i - 1, 0), at + half(i, distances.size() - 1)});
  }
  return slabs;
}

Stack uneven_stack(const Frame& f, const std::vector<double>& distances, double alone_m,
                   std::vector<std::string> notes) {
  const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
  const std::vector<Slab> slabs = slabs_of(f, distances, alone_m);
  const double low_m = slabs.front().low_m, height_m = slabs.back().high_m - low_m;
  const double finest_m = alone_m > 0 ? std::min(alone_m, *least) : *least;
  const double step_m = layer_step_m(f.grid, height_m, finest_m);
  const bool has_gap = alone_m > 0 && *most > kWidest * alone_m;
  notes.push_back(fmt::format(
      "{}: its planes lie {:.4g} to {:.4g} mm apart: brought into layers of {:.4g} mm, each with "
      "the labels of the nearest plane{}",
      f.path, *least * 1e3, *most * 1e3, step_m * 1e3,
      has_gap ? fmt::format("; in gaps over {:.4g} mm, what is farther than {:.4g} mm from a plane "
                            "is taken as empty",
                            kWidest * alone_m * 1e3, alone_m / 2 * 1e3)
              : ""));
  const bool is_leaning = leans(f, notes);
  const Layers layers =
      checked_layers(f, low_m + step_m / 2, step_m, std::max(1.0, std::round(height_m / step_m)));
  Stack stack = with_layers(f, layers, is_leaning, std::move(notes));
  const auto layer_at = [&](double at_m) {
    const double layer = std::round((at_m - low_m) / step_m);
    return static_cast<std::uint32_t>(std::clamp(layer, 0.0, 1.0 * layers.count));
  };
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    stack.spans[f.order[i].plane] = {layer_at(slabs[i].low_m), layer_at(slabs[i].high_m)};
  }
  return stack;
}

Frame frame_of(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes) {
  Frame f{path, grid, planes, {}, {}, {}, {}};
  put_in_order(f);
  check_not_twice(f);
  find_lean(f);
  return f;
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double layer_step_m(const PixelGrid& grid, double height_m, double finest_m) {
  const double voxels = height_m / finest_m * grid.columns * grid.rows;
  return finest_m / std::clamp(std::floor(kFineVoxels / voxels), 1.0, 1.0 * kFiner);
}

void require_filled(const std::string& path, const PixelGrid& grid, std::size_t planes,
                    double height_m, double step_m) {
  constexpr double kMostLayers = 65536, kMostForAPlane = 64;
  const double layers = height_m / step_m + 1;
  const double voxels = layers * grid.columns * grid.rows;
  const double most_filled = kMostForAPlane * static_cast<double>(planes);
  if (layers <= kMostLayers && (voxels <= kFineVoxels || layers <= most_filled)) return;
  refuse(
      "{}: {} planes from first to last over {:.6g} mm, {:.6g} mm apart: {:.0f} layers: expected "
      "at most {:.0f} of {} x {} pixels; is the distance of planes right?",
      path, planes, height_m * 1e3, step_m * 1e3, layers,
      std::min(kMostLayers,
               std::max(most_filled, std::floor(kFineVoxels / grid.columns / grid.rows))),
      grid.columns, grid.rows);
}

Stack whole_stack(const std::string& path, const PixelGrid& grid,
                  const std::vector<Plane>& planes) {
  const Frame f = frame_of(path, grid, planes);
  if (planes.size() == 1) {
    const double thick_m = planes.front().thickness_m;
    if (!(thick_m > 0)) {
      refuse("{}: a single slice without SliceThickness: expected SliceThickness, or more slices",
             planes.front().what);
    }
    return even_stack(f, thick_m, {});
  }
  const std::vector<double> distances = distances_m(f);
  check_distances(f, distances);
  const double step_m = f.order.back().along_m / static_cast<double>(distances.size());
  std::vector<std::string> notes;
  tell_gaps(f, distances, notes);
  if (!is_even(f, step_m)) return uneven_stack(f, distances, 0, std::move(notes));
  return even_stack(f, step_m, std::move(notes));
}

Stack sparse_stack(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes,
                   double step_m) {
  const Frame f = frame_of(path, grid, planes);
  require_filled(path, grid, planes.size(), f.order.back().along_m, step_m);
  const std::vector<double> distances = distances_m(f);
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] >= kNarrowest * step_m) continue;
    refuse(
        "{}: lies {:.6g} mm from the plane before: expected {:.6g} mm, the distance or thickness "
        "of planes",
        name_of(f, i + 1), distances[i] * 1e3, step_m * 1e3);
  }
  if (!is_even(f, step_m)) return uneven_stack(f, distances, step_m, {});
  const double empty =
      std::round(f.order.back().along_m / step_m) + 1 - static_cast<double>(planes.size());
  if (empty > 0) {
    notes.push_back(fmt::format(
        "{}: {:.0f} planes between its first and last are not in the file: taken as empty", path,
        empty));
  }
  return even_stack(f, step_m, std::move(notes));
}

namespace {

// Where a row of pixels begins in a layer of the map.
std::size_t row_in_map(const Stack& stack, std::uint32_t layer, std::size_t row) {
  const auto& size = stack.map.size;
  const auto [right, down] = stack.shift[layer];
  return (std::size_t{layer} * size[1] + row + static_cast<std::size_t>(down)) * size[0] +
         static_cast<std::size_t>(right);
}

void put_pixel(Stack& stack, std::size_t at, std::uint16_t label) {
  std::uint16_t& has = stack.map.label[at];
  if (label == 0 || has == label) return;
  stack.claimed_twice += has != 0 ? 1 : 0;
  has = label;
}

}  // namespace

void put_run(Stack& stack, Span layers, std::size_t row, std::uint32_t first, std::uint32_t end,
             std::uint16_t label) {
  for (std::uint32_t layer = layers.first; layer < layers.end; ++layer) {
    const std::size_t to = row_in_map(stack, layer, row);
    for (std::uint32_t column = first; column < end; ++column) put_pixel(stack, to + column, label);
  }
}

void put_plane(Stack& stack, std::size_t plane, const std::vector<std::uint16_t>& pixels) {
  const std::size_t columns = stack.grid.columns;
  const Span layers = stack.spans[plane];
  for (std::uint32_t layer = layers.first; layer < layers.end; ++layer) {
    for (std::size_t row = 0; row < stack.grid.rows; ++row) {
      const std::size_t to = row_in_map(stack, layer, row);
      for (std::size_t column = 0; column < columns; ++column) {
        put_pixel(stack, to + column, pixels[row * columns + column]);
      }
    }
  }
}

}  // namespace stylet::offline
