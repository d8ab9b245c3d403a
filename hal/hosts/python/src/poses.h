// SPDX-License-Identifier: Apache-2.0
// Poses that Python gives, as the inputs that the library takes.
//
// Promise: arrays of 32-bit floats that lie in one piece are read where they lie. A pose is seven
// numbers: position in m, then the rotation's quaternion w, x, y, z. Frame: world. Source:
// stylet.h.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "hal/hosts/python/src/types.h"

namespace stylet::python {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

// What Python gave as real numbers (stylet/given.py, which refuses anything else by `name`).
// `shape` is a tuple or None; `none` says what to do instead of giving None.
// As Python writes it: "(3, 7)".
std::string text_of(const std::vector<py::ssize_t>& shape);

Floats real_numbers(const char* name, py::handle given, const py::object& shape,
                    const char* none = "expected numbers");

// N numbers in a row.
template <std::size_t N>
std::array<float, N> vector_of(const char* name, py::handle given) {
  const Floats numbers = real_numbers(name, given, py::make_tuple(N));
  std::array<float, N> out;
  std::copy_n(numbers.data(), N, out.begin());
  return out;
}

// What a call of `run` was given: inputs ready for the library, or poses to be made inputs.
class Inputs {
 public:
  // `shape`: what an array must have, without the seven of a pose; it may have the axes of one
  // needle left out. `valid` is None or one truth for each pose.
  Inputs(const py::object& given, const py::object& valid);

  // Without the seven of a pose.
  const std::vector<py::ssize_t>& shape() const { return shape_; }
  py::ssize_t count() const { return count_; }
  // Inputs [first, first + count); `room` has space for as many, and is used if it is needed.
  const stylet_input* get(py::ssize_t first, py::ssize_t count, stylet_input* room) const;

 private:
  py::array held_;
  py::array_t<bool> valid_;
  const stylet_input* ready_ = nullptr;
  const float* poses_ = nullptr;
  const bool* truths_ = nullptr;
  std::vector<py::ssize_t> shape_;
  py::ssize_t count_ = 1;
};

constexpr py::ssize_t kPoseNumbers = 7;

inline stylet_input input_of(const float* pose, bool valid) {
  return {sizeof(stylet_input),
          valid ? 1U : 0U,
          {{pose[0], pose[1], pose[2]}, {pose[3], pose[4], pose[5], pose[6]}},
          0};
}

// Poses of one tick: their numbers, and whether the array has the axis of needles. `held` keeps
// what had to be converted.
struct Poses {
  const float* numbers;
  py::ssize_t count;
  bool has_axis;
};
Poses poses_of_tick(py::handle given, py::object& held);

}  // namespace stylet::python
