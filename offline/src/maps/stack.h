// SPDX-License-Identifier: GPL-3.0-or-later
// Planes of labels, as slices and frames of DICOM are, to a map on an upright grid.
//
// The planes' positions decide, not their order or what a header says of distances. Planes at even
// distances straight above each other become the layers of the map as they are. A stack that leans
// (tilted gantry) is put upright by whole pixels, right to half of one. Planes at uneven distances
// stand for what is nearest to them, in layers of an eighth of the finest distance (thicker ones,
// up to the finest distance, where the map would be large). What was done is a note of the map.
// Refused with the plane and the value: one beside the line of the others, one that is missing,
// there twice or overlaps the next, a lean beyond what gantries have: labels are not invented.
// Units: metres. Frame: the patient's (LPS).
#pragma once

#include <string>
#include <vector>

#include "maps/label_map.h"

namespace stylet::bake {

struct Plane {
  Vec origin_m;            // centre of the first pixel
  double thickness_m = 0;  // 0: not known
  std::string what;        // for messages: a file, or a frame of it
};

struct PixelGrid {
  std::uint32_t columns = 0, rows = 0;
  Vec column_step_m, row_step_m;  // from a column to the next, from a row to the next
};

// Layers of the map that a plane fills.
struct Span {
  std::uint32_t first = 0, end = 0;
};

// What of the normal a plane stands for.
struct Slab {
  double low_m = 0, high_m = 0;
};

struct Stack {
  LabelMap map;  // labels all 0
  PixelGrid grid;
  std::vector<Span> spans;                         // of each plane, as given
  std::vector<std::array<std::int32_t, 2>> shift;  // of each layer, in columns and rows
  std::size_t claimed_twice = 0;                   // voxels that changed their label in put_plane
};

// Every plane between the first and the last is there. `path` is for messages.
Stack whole_stack(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes);

// Empty planes are left out, as a segmentation may: what is farther from a plane than half of
// `step_m`, or than half of 1.5 of it from its neighbour, is empty.
Stack sparse_stack(const std::string& path, const PixelGrid& grid, const std::vector<Plane>& planes,
                   double step_m);

double median(std::vector<double> values);  // the lower of two; there is one at least

// Of layers that end where the slabs of uneven planes do, of which the thinnest is `finest_m`: an
// eighth of it, as long as a map of `height_m` does not get large.
double layer_step_m(const PixelGrid& grid, double height_m, double finest_m);

// A few planes far apart claim no more layers than a body of 2.6 m has of 0.04 mm, and no more
// memory than a packed file of their size could.
void require_filled(const std::string& path, const PixelGrid& grid, std::size_t planes,
                    double height_m, double step_m);

// Labels of a plane's pixels, row after row; 0 changes nothing, a label takes what another has.
void put_layers(Stack& stack, Span layers, const std::vector<std::uint16_t>& pixels);
void put_plane(Stack& stack, std::size_t plane, const std::vector<std::uint16_t>& pixels);

}  // namespace stylet::bake
