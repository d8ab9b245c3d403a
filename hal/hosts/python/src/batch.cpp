// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <memory>

#include "hal/hosts/python/src/poses.h"
#include "hal/hosts/python/src/simulation.h"

namespace stylet::python {
namespace {

class Batch {
 public:
  Batch(const py::tuple& simulations, std::uint32_t threads) : objects_(simulations) {
    std::vector<stylet_simulation*> handles;
    for (const py::handle object : simulations) {
      if (!py::isinstance<Simulation>(object)) {
        throw py::type_error(py::repr(object).cast<std::string>() +
                             ": expected a stylet.Simulation");
      }
      auto* const each = object.cast<Simulation*>();
      simulations_.push_back(each);
      if (each->needles() != simulations_[0]->needles()) {
        throw py::value_error("simulations: needles: " + std::to_string(each->needles()) +
                              ": expected " + std::to_string(simulations_[0]->needles()) +
                              ", as the first one has");
      }
      handles.push_back(each->handle());
    }
    stylet_batch* made = nullptr;
    check(stylet_batch_create(handles.data(), static_cast<std::uint32_t>(handles.size()), threads,
                              &made));
    handle_ = std::unique_ptr<stylet_batch, void (*)(stylet_batch*)>(made, stylet_batch_free);
  }

  // Poses of shape (simulations, ticks, needles, 7), or (simulations, ticks, 7) of one needle.
  py::array run(const py::object& poses, const py::object& valid, const py::object& out) {
    std::vector<Use> uses;
    for (Simulation* const each : simulations_) uses.emplace_back(*each);
    const Inputs inputs(poses, valid);
    const auto& shape = inputs.shape();
    const py::ssize_t needles =
        simulations_.empty() ? 1 : static_cast<py::ssize_t>(simulations_[0]->needles());
    const bool has_axis = shape.size() == 3 && shape[2] == needles;
    if ((!has_axis && (shape.size() != 2 || needles > 1)) ||
        shape[0] != static_cast<py::ssize_t>(simulations_.size())) {
      throw py::value_error("poses: " + text_of(shape) + " of them: expected (" +
                            std::to_string(simulations_.size()) + ", ticks, " +
                            std::to_string(needles) + "), for simulations, ticks and needles" +
                            (needles > 1 ? "" : ", or without the last"));
    }
    py::array array = output_array(out, shape);
    auto* const outputs = static_cast<stylet_output*>(array.mutable_data());
    if (inputs.count() > 0) outputs->struct_bytes = sizeof(stylet_output);
    room_.resize(static_cast<std::size_t>(inputs.count()));
    stylet_status status = STYLET_OK;
    {
      const py::gil_scoped_release others_run;
      const stylet_input* const all = inputs.get(0, inputs.count(), room_.data());
      status = stylet_batch_run(handle_.get(), all, outputs, static_cast<std::uint32_t>(shape[1]));
    }
    check(status);
    return array;
  }

 private:
  py::tuple objects_;  // keeps them, whatever becomes of the list that they were given in
  std::vector<Simulation*> simulations_;
  std::unique_ptr<stylet_batch, void (*)(stylet_batch*)> handle_{nullptr, stylet_batch_free};
  std::vector<stylet_input> room_;
};

}  // namespace

void add_batch(py::module_& module) {
  py::class_<Batch> type(module, "Batch");
  refuse_pickle(type, "simulations cannot be pickled: pass their snapshots");
  type.def(py::init<const py::tuple&, std::uint32_t>())
      .def("run", &Batch::run, py::arg("poses"), py::arg("valid") = py::none(),
           py::arg("out") = py::none());
}

}  // namespace stylet::python
