// SPDX-License-Identifier: Apache-2.0
// Organs for Python: read once, looked at as arrays that are copied once and kept.
//
// Promise: the arrays are for reading, and the same object each time. Units: SI. Frame: world.
// Source: stylet.h.
#pragma once

#include <memory>
#include <string>

#include "hal/hosts/python/src/types.h"

namespace stylet::python {

struct Organ {
  std::shared_ptr<stylet_organ> handle;
  py::object info, materials, voxels, cubes, vertices, vertex_materials, triangles;
};

Organ read_organ(const std::string& path);
Organ organ_from_bytes(const py::object& bytes);
void add_organ(py::module_& module);

}  // namespace stylet::python
