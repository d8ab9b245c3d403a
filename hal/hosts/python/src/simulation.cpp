// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/python/src/simulation.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "hal/hosts/python/src/poses.h"

namespace stylet::python {
namespace {

// Ticks between two looks for Ctrl-C: a second at the usual period.
constexpr py::ssize_t kTicksOfPart = 1000;

py::object recarray_of(const py::array& array) {
  return array.attr("view")(py::module_::import("numpy").attr("recarray"));
}

}  // namespace

Use::Use(Simulation& simulation) : simulation_(&simulation) {
  if (simulation.used_) throw std::runtime_error("another thread is using this simulation");
  simulation.used_ = true;
}

Use::~Use() {
  if (simulation_ != nullptr) simulation_->used_ = false;
}

Simulation::Simulation(const Organ& organ, const std::vector<py::array>& needles,
                       const py::array& config, const std::vector<py::array>& obstacles) {
  const auto own_needles = structs_of<stylet_needle>(needles);
  const auto own_config = struct_of<stylet_config>(config);
  stylet_simulation* made = nullptr;
  stylet_refusal why = empty_refusal();
  check(stylet_simulation_create(organ.handle.get(), &own_config, own_needles.data(),
                                 static_cast<std::uint32_t>(own_needles.size()), &made, &why),
        why);
  handle_ = std::shared_ptr<stylet_simulation>(made, stylet_simulation_free);
  prepare();
  if (!obstacles.empty()) set_obstacles(obstacles);
}

Simulation::Simulation(Simulation& other) {
  const Use use(other);
  stylet_simulation* made = nullptr;
  check(stylet_simulation_clone(other.handle(), &made));
  handle_ = std::shared_ptr<stylet_simulation>(made, stylet_simulation_free);
  prepare();
  std::copy_n(static_cast<const stylet_output*>(other.outputs_.own.data()), needles_,
              static_cast<stylet_output*>(outputs_.own.mutable_data()));
}

void Simulation::prepare() {
  needles_ = stylet_simulation_needles(handle());
  inputs_.resize(needles_);
  outputs_.own = py::array(output_dtype(), static_cast<py::ssize_t>(needles_));
  auto* const outputs = static_cast<stylet_output*>(outputs_.own.mutable_data());
  std::fill_n(outputs, needles_, stylet_output{});
  outputs->struct_bytes = sizeof(stylet_output);
  outputs_.view = recarray_of(read_only(outputs_.own));
  first_output_ = outputs_.view[py::int_(0)];
}

py::object Simulation::tick(const py::object& poses) {
  const Use use(*this);
  bool has_axis = needles_ > 1;
  std::uint32_t given = 0;  // None: no needle has a sample
  py::object held;
  if (!poses.is_none()) {
    const Poses all = poses_of_tick(poses, held);
    has_axis = all.has_axis;
    given = static_cast<std::uint32_t>(all.count);
    if (given != needles_) {
      throw py::value_error("poses: " + std::to_string(given) + ": expected " +
                            std::to_string(needles_) + ", one for each needle");
    }
    for (std::uint32_t i = 0; i < given; ++i) {
      inputs_[i] = input_of(all.numbers + kPoseNumbers * i, true);
    }
  }
  auto* const outputs = static_cast<stylet_output*>(outputs_.own.mutable_data());
  stylet_status status = STYLET_OK;
  {
    const py::gil_scoped_release others_run;
    status = stylet_simulation_tick(handle(), inputs_.data(), given, outputs, needles_);
  }
  check(status);
  return has_axis ? py::object(outputs_.view) : first_output_;
}

py::array output_array(const py::object& out, const std::vector<py::ssize_t>& shape) {
  py::array array;
  if (out.is_none()) {
    array = py::array(output_dtype(), shape);
  } else {
    array = py::reinterpret_borrow<py::array>(out);
    const bool fits =
        py::isinstance<py::array>(out) && array.dtype().equal(output_dtype()) &&
        (array.flags() & py::array::c_style) != 0 && array.writeable() &&
        std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim());
    if (!fits) {
      const std::string given =
          py::isinstance<py::array>(out)
              ? "an array of shape " + py::str(array.attr("shape")).cast<std::string>()
              : py::repr(py::type::of(out)).cast<std::string>();
      throw py::value_error("out: " + given + ": expected an array of output_dtype of shape " +
                            text_of(shape) + " in one piece, which may be written");
    }
  }
  return array;
}

py::array Simulation::run(const py::object& poses, const py::object& valid, const py::object& out) {
  const Use use(*this);
  const Inputs inputs(poses, valid);
  const auto& shape = inputs.shape();
  const bool has_axis = shape.size() == 2 && shape[1] == static_cast<py::ssize_t>(needles_);
  if (!has_axis && (shape.size() != 1 || needles_ > 1)) {
    throw py::value_error("poses: " + text_of(shape) + " of them: expected (ticks, " +
                          std::to_string(needles_) + "), for ticks and needles" +
                          (needles_ > 1 ? "" : ", or (ticks,)"));
  }
  py::array array = output_array(out, shape);
  auto* const outputs = static_cast<stylet_output*>(array.mutable_data());
  const auto needles = static_cast<py::ssize_t>(needles_);
  std::vector<stylet_input> room(
      static_cast<std::size_t>(std::min(shape[0], kTicksOfPart) * needles));
  for (py::ssize_t tick = 0; tick < shape[0]; tick += kTicksOfPart) {
    const py::ssize_t ticks = std::min(kTicksOfPart, shape[0] - tick);
    const stylet_input* const part = inputs.get(tick * needles, ticks * needles, room.data());
    outputs[tick * needles].struct_bytes = sizeof(stylet_output);
    stylet_status status = STYLET_OK;
    {
      const py::gil_scoped_release others_run;
      status = stylet_simulation_run(handle(), part, outputs + tick * needles,
                                     static_cast<std::uint32_t>(ticks));
    }
    check(status);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return out.is_none() ? py::array(recarray_of(array)) : array;
}

void Simulation::set_obstacles(const std::vector<py::array>& obstacles) {
  const Use use(*this);
  const auto own = structs_of<stylet_obstacle>(obstacles);
  stylet_refusal why = empty_refusal();
  check(stylet_simulation_set_obstacles(handle(), own.data(),
                                        static_cast<std::uint32_t>(own.size()), &why),
        why);
}

void Simulation::reset() {
  const Use use(*this);
  check(stylet_simulation_reset(handle()));
}

std::uint64_t Simulation::hash() {
  const Use use(*this);
  return stylet_simulation_hash(handle());
}

py::bytes Simulation::snapshot() {
  const Use use(*this);
  std::string bytes(stylet_simulation_snapshot_bytes(handle()), '\0');
  check(stylet_simulation_snapshot(handle(), bytes.data(), bytes.size()));
  return bytes;
}

void Simulation::restore(const py::object& snapshot) {
  const Use use(*this);
  const Bytes all(snapshot);
  check(stylet_simulation_restore(handle(), all.data(), all.size()));
}

py::object Simulation::difference(Simulation& other) {
  if (&other == this) return py::none();
  const Use use(*this), used_too(other);
  std::uint64_t index = 0;
  const char* const field = stylet_simulation_difference(handle(), other.handle(), &index);
  return field == nullptr ? py::object(py::none()) : py::object(py::make_tuple(field, index));
}

void add_simulation(py::module_& module) {
  using Rows = std::vector<py::array>;
  py::class_<Simulation> type(module, "Simulation");
  refuse_pickle(type,
                "a simulation cannot be pickled: pass its snapshot(), which restore() takes in one "
                "of the same organ, needles and configuration");
  type.def(py::init<const Organ&, const Rows&, const py::array&, const Rows&>())
      .def(py::init<Simulation&>())
      .def("tick", &Simulation::tick, py::arg("poses"))
      .def("run", &Simulation::run, py::arg("poses"), py::arg("valid") = py::none(),
           py::arg("out") = py::none())
      .def("_set_obstacles", &Simulation::set_obstacles)
      .def("reset", &Simulation::reset)
      .def_property_readonly("needles", &Simulation::needles)
      .def("surface", &Simulation::surface)
      .def("needle_shape", &Simulation::needle_shape, py::arg("needle") = 0)
      .def("particles", &Simulation::particles)
      .def("voxel_corners", &Simulation::voxel_corners)
      .def("constraint_particles", &Simulation::constraint_particles)
      .def("obstacle_touches", &Simulation::obstacle_touches)
      .def("events", &Simulation::events)
      .def("stats", &Simulation::stats)
      .def("energy", &Simulation::energy)
      .def("mass", &Simulation::mass, py::arg("material"))
      .def("hash", &Simulation::hash)
      .def("snapshot", &Simulation::snapshot)
      .def("restore", &Simulation::restore, py::arg("snapshot"))
      .def("difference", &Simulation::difference, py::arg("other"));
}

}  // namespace stylet::python
