// SPDX-License-Identifier: Apache-2.0
// The module stylet._stylet: stylet.h for Python, and nothing else of Stylet.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "hal/hosts/python/src/poses.h"
#include "hal/hosts/python/src/simulation.h"

namespace stylet::python {
namespace {

// The pose as Python has it: seven numbers.
py::array_t<float> pose_of_tip(const py::object& tip_m, const py::object& direction,
                               float length_m) {
  const auto tip = vector_of<3>("tip_m", tip_m);
  const auto way = vector_of<3>("direction", direction);
  // The library takes what has no length for -z: a mistake would be a needle that points down.
  if (!std::all_of(way.begin(), way.end(), [](float each) { return std::isfinite(each); })) {
    throw py::value_error("direction: expected finite numbers");
  }
  const stylet_pose pose =
      stylet_pose_of_tip({tip[0], tip[1], tip[2]}, {way[0], way[1], way[2]}, length_m);
  const auto& [at, turn] = pose;
  const std::array<float, 7> numbers = {at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z};
  return py::array_t<float>(numbers.size(), numbers.data());
}

}  // namespace
}  // namespace stylet::python

PYBIND11_MODULE(_stylet, module) {
  using namespace stylet::python;
  module.def("version", stylet_version_text);
  module.def("build", stylet_build_text);
  module.def("state_layout", stylet_state_layout);
  module.def("status_name", stylet_status_name);
  module.def("event_name", stylet_event_name);
  module.def("pose_of_tip", pose_of_tip, py::arg("tip_m"), py::arg("direction"),
             py::arg("length_m"));
  module.def("refuse_second_init", refuse_second_init, py::arg("object"));
  add_types(module);
  add_organ(module);
  add_simulation(module);
  add_batch(module);
  add_hand(module);
  refuse_objects_without_init(module);
}
