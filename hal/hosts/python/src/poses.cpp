// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/python/src/poses.h"

#include <string>

namespace stylet::python {
namespace {

using Truths = py::array_t<bool, py::array::c_style | py::array::forcecast>;

[[noreturn]] void wrong_shape(const py::array& array, const std::string& expected) {
  const std::string shape = py::str(array.attr("shape"));
  throw py::value_error("poses of shape " + shape + ": expected " + expected);
}

Floats floats(py::handle given) {
  return real_numbers("poses", given, py::none(),
                      "where a tick has no sample, say so in valid, or call tick(None)");
}

}  // namespace

std::string text_of(const std::vector<py::ssize_t>& shape) {
  std::string out = "(";
  for (const py::ssize_t each : shape) {
    out += (out.size() > 1 ? ", " : "") + std::to_string(each);
  }
  return out + (shape.size() == 1 ? ",)" : ")");
}

Floats real_numbers(const char* name, py::handle given, const py::object& shape, const char* none) {
  return py::module_::import("stylet.given").attr("real")(name, given, shape, none);
}

Inputs::Inputs(const py::object& given, const py::object& valid) {
  py::ssize_t axes = 0;
  if (py::isinstance<py::array>(given) &&
      py::reinterpret_borrow<py::array>(given).dtype().equal(input_dtype())) {
    held_ = py::reinterpret_borrow<py::array>(given);
    if ((held_.flags() & py::array::c_style) == 0) {
      throw py::value_error("inputs of strides " +
                            py::str(held_.attr("strides")).cast<std::string>() +
                            ": expected an array in one piece (numpy.ascontiguousarray)");
    }
    ready_ = static_cast<const stylet_input*>(held_.data());
    axes = held_.ndim();
    // The library goes by the first one's size from each to the next, and so out of the array.
    if (held_.size() > 0 && ready_->struct_bytes != sizeof(stylet_input)) {
      throw py::value_error("inputs: struct_bytes " + std::to_string(ready_->struct_bytes) +
                            ": expected " + std::to_string(sizeof(stylet_input)) +
                            ", as stylet.inputs writes it");
    }
    if (!valid.is_none()) {
      throw py::value_error("valid: expected None: the inputs say themselves which are valid");
    }
  } else {
    const Floats poses = floats(given);
    axes = poses.ndim() - 1;
    if (axes < 1 || poses.shape(axes) != kPoseNumbers) wrong_shape(poses, "(..., 7)");
    poses_ = poses.data();
    held_ = poses;
  }
  for (py::ssize_t i = 0; i < axes; ++i) shape_.push_back(held_.shape(i));
  for (const py::ssize_t each : shape_) count_ *= each;
  if (valid.is_none()) return;
  const auto truths = py::module_::import("numpy").attr("asarray")(valid).cast<py::array>();
  if (truths.dtype().kind() != 'b' && truths.dtype().kind() != 'u' &&
      truths.dtype().kind() != 'i') {
    throw py::type_error("valid of " + py::str(truths.dtype()).cast<std::string>() +
                         ": expected truths");
  }
  valid_ = Truths::ensure(truths);
  if (valid_.size() != count_) {
    throw py::value_error("valid: " + std::to_string(valid_.size()) + " truths: expected " +
                          std::to_string(count_) + ", one for each pose");
  }
  truths_ = valid_.data();
}

const stylet_input* Inputs::get(py::ssize_t first, py::ssize_t count, stylet_input* room) const {
  if (ready_ != nullptr) return ready_ + first;
  for (py::ssize_t i = 0; i < count; ++i) {
    const py::ssize_t at = first + i;
    room[i] = input_of(poses_ + kPoseNumbers * at, truths_ == nullptr || truths_[at]);
  }
  return room;
}

Poses poses_of_tick(py::handle given, py::object& held) {
  Floats array;
  if (py::isinstance<py::array_t<float, py::array::c_style>>(given)) {
    array = py::reinterpret_borrow<Floats>(given);
  } else {
    array = floats(given);
  }
  const py::ssize_t axes = array.ndim();
  if (axes < 1 || axes > 2 || array.shape(axes - 1) != kPoseNumbers) {
    wrong_shape(array, "(7,) or (needles, 7)");
  }
  const Poses out = {array.data(), axes == 2 ? array.shape(0) : 1, axes == 2};
  held = std::move(array);
  return out;
}

}  // namespace stylet::python
