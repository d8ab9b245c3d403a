// SPDX-License-Identifier: GPL-3.0-or-later
// Turns planes of labels, such as slices and frames of DICOM, into a map on an upright grid.
//
// The planes' positions decide, not their order or the distances in a header. Planes at even
// distances straight above each other become the layers of the map unchanged. A leaning stack
// (tilted gantry) is put upright in whole pixels, with an error of up to half a pixel. With uneven
// distances every layer has the labels of the nearest plane; layers are an eighth of the finest
// distance (thicker, up to the finest distance, if the map would be large). A note of the map tells
// this. Refused with plane and value: a plane off the line of the others, missing, there twice or
// overlapping the next, and a lean greater than gantries have: labels are not invented.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include <string>
#include <vector>

#include "maps/label_map.h"

namespace stylet::offline {

struct Plane {
  Vec origin_m;            // centre of the first pixel
  double thickness_m = 0;  // 0: not known
  std::string what;        // for messages: a file, or a frame of it
};

struct PixelGrid {
  std::uint32_t columns = 0, rows = 0;
  Vec column_step_m, row_step_m;  // from a column to the next, from a row to the next
};

// The layers of the map that a plane fills.
struct Span {
  std::uint32_t first = 0, end = 0;
};

// The range along the normal that takes the labels of a plane.
struct Slab {
  double low_m = 0, high_m = 0;
};

struct Stack {
  LabelMap map;  // labels all 0
  PixelGrid grid;
  std::vector<Span> spans;                         // of each plane, in the order given
  std::vector<std::array<std::int32_t, 2>> shift;  // of each layer, in columns and rows
  std::size_t claimed_twice = 0;                   // voxels that changed their label in put_plane
};

// For planes without a gap between the first and the last. `path` is for messages.
Stack whole_stack(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes);

// For planes without the empty ones, which a segmentation may leave out: planes up to 1.5 `step_m`
// apart meet halfway; otherwise what is farther than half of `step_m` from a plane is empty.
Stack sparse_stack(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes,
                   double step_m);

double median(std::vector<double> values);  // the lower of two middle values; not of no values

// Thickness of layers for slabs of uneven planes, the thinnest of which is `finest_m`: an eighth of
// `finest_m`, or more (up to `finest_m`) if a map of `height_m` would get large.
double layer_step_m(const PixelGrid& grid, double height_m, double finest_m);

// Limits what a few planes far apart may claim: as many layers of 0.04 mm as a body of 2.6 m has,
// and as much memory as a packed file of their size could hold.
void require_filled(const std::string& path, const PixelGrid& grid, std::size_t planes,
                    double height_m, double step_m);

// Puts a label in columns [first, end) of a row of pixels; it replaces another.
void put_run(Stack& stack, Span layers, std::size_t row, std::uint32_t first, std::uint32_t end,
             std::uint16_t label);
// Puts the labels of a plane's pixels, row after row; 0 changes nothing.
void put_plane(Stack& stack, std::size_t plane, const std::vector<std::uint16_t>& pixels);

}  // namespace stylet::offline
