// SPDX-License-Identifier: Apache-2.0
// Structs of stylet.h as numpy sees them, and its refusals as Python's StyletError.
//
// Promise: a dtype has every field of the struct under its name, but for `struct_bytes` and what is
// reserved; nothing is copied to look at a struct. Units and frames: those of stylet.h. Source:
// numpy's manual, "Structured arrays".
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <initializer_list>

#include "stylet/stylet.h"

namespace stylet::python {

namespace py = pybind11;

// A field of a struct: its name, numpy's word for its type, its place.
struct Field {
  const char* name;
  const char* format;
  std::size_t offset;
};
constexpr const char* kFloat = "<f4";
constexpr const char* kVec3 = "(3,)<f4";
constexpr const char* kQuat = "(4,)<f4";
constexpr const char* kInt32 = "<i4";
constexpr const char* kUint32 = "<u4";
constexpr const char* kUint64 = "<u8";
#define STYLET_FIELD(type, name, format) \
  ::stylet::python::Field {              \
#name, format, offsetof(type, name)  \
  }
py::dtype dtype_of(std::initializer_list<Field> fields, std::size_t bytes);

// Of Python's objects none is changed here: what these return is for reading.
py::dtype vec3_dtype();  // three numbers of 32 bits
py::dtype input_dtype();
py::dtype output_dtype();  // a record, whose fields are attributes too
py::dtype config_dtype();
py::dtype needle_dtype();
py::dtype obstacle_dtype();
py::dtype voxel_dtype();
py::dtype cube_dtype();
py::dtype constraint_particle_dtype();
py::dtype obstacle_touch_dtype();
py::dtype event_dtype();

// Makes StyletError, and what Python needs to make structs.
void add_types(py::module_& module);
// Of all classes of the module: an object whose `__init__` was not called, or raised, is refused
// wherever it is used. It has no C++ object, and pybind11 would give memory that nobody filled.
void refuse_objects_without_init(const py::module_& module);
// For `__init__` of Python's classes: raises where it was called before. pybind11 would ignore the
// second call, and what it was given.
void refuse_second_init(const py::object& object);

// Bytes of Python where they lie: bytes, bytearray, memoryview, an array in one piece.
class Bytes {
 public:
  explicit Bytes(const py::object& given);
  ~Bytes() { PyBuffer_Release(&view_); }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

  const void* data() const { return view_.buf; }
  std::size_t size() const { return static_cast<std::size_t>(view_.len); }

 private:
  Py_buffer view_ = {};
};

// What pickle and copy say of a class. Each has it: pickle's own way in its old protocols, 0 and 1,
// makes an object without this class, at which pybind11 ends the process.
template <typename Class>
void refuse_pickle(Class& type, const char* why) {
  type.def("__reduce__", [why](const py::object&) -> py::object { throw py::type_error(why); });
}

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

// One struct with the library's defaults, as an array of one row.
template <typename T, typename Init>
py::array defaults(const py::dtype& dtype, const Init& init) {
  py::array row(dtype, 1);
  check(init(static_cast<T*>(row.mutable_data()), sizeof(T)));
  return row;
}

// A row of the dtype as the struct, which says its size.
template <typename T>
T struct_of(const py::array& row) {
  T out = *static_cast<const T*>(row.data());
  out.struct_bytes = sizeof(T);
  return out;
}

}  // namespace stylet::python
