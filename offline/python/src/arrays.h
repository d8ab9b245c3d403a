// SPDX-License-Identifier: GPL-3.0-or-later
// numpy's arrays as label maps and meshes.
//
// Promise: an array is read where it lies and copied once, whatever its order and type; an array
// that cannot be labels or a surface is refused with place and value. Labels are read without the
// interpreter's lock. Units: metres. Frame: the patient's (LPS).
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <optional>
#include <string>

#include "maps/label_map.h"
#include "meshes/read_mesh.h"

namespace stylet::offline::python {

namespace py = pybind11;

// Where an array's labels lie, without the array.
struct LabelArray {
  const char* data = nullptr;
  char kind = 'u';
  std::size_t item_bytes = 1;
  std::array<std::size_t, 3> size{};          // x, y, z
  std::array<py::ssize_t, 3> stride_bytes{};  // of a step along x, y, z
};

// `axes`: which axes of the array are x, y and z. Refuses with a TypeError what is not numbers.
LabelArray label_array(const py::array& labels, const std::array<std::size_t, 3>& axes);

// Fills size, label and sha256 of `map`; `name` is for messages.
void take_array(const std::string& name, const LabelArray& array, LabelMap& map);

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Faces = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
ReadMesh mesh_of(const std::string& name, const Points& vertices_m, const Faces& faces);

}  // namespace stylet::offline::python
