// SPDX-License-Identifier: Apache-2.0
// Structs of stylet.h as numpy sees them, and its refusals as Python's StyletError.
//
// Promise: a dtype has every field of the struct under its name, but for `struct_bytes` and what is
// reserved; nothing is copied to look at a struct. Units and frames: those of stylet.h. Source:
// numpy's manual, "Structured arrays".
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "stylet/stylet.h"

namespace stylet::python {

namespace py = pybind11;

// Of Python's objects none is changed here: what these return is for reading.
py::dtype vec3_dtype();  // three numbers of 32 bits
py::dtype input_dtype();
py::dtype output_dtype();  // a record, whose fields are attributes too
py::dtype config_dtype();
py::dtype needle_dtype();
py::dtype obstacle_dtype();
py::dtype voxel_dtype();
py::dtype constraint_particle_dtype();
py::dtype obstacle_touch_dtype();
py::dtype event_dtype();

// Makes StyletError, and what Python needs to make structs.
void add_types(py::module_& module);

// Nothing if all is well, or raises StyletError.
void check(stylet_status status, const stylet_refusal& why);
void check(stylet_status status);
// A refusal for a call to fill.
stylet_refusal empty_refusal();

// An array that Python may only read, and whose memory the caller goes on to fill: `array` keeps
// it.
py::array read_only(const py::array& array);

// A plain object with these attributes.
py::object names(const py::dict& values);

// A row of the dtype as the struct, which says its size.
template <typename T>
T struct_of(const py::array& row) {
  T out = *static_cast<const T*>(row.data());
  out.struct_bytes = sizeof(T);
  return out;
}

}  // namespace stylet::python
