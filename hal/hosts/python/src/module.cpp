// SPDX-License-Identifier: Apache-2.0
// The module stylet._stylet: stylet.h for Python, and nothing else of Stylet.
#include <pybind11/stl.h>

#include "hal/hosts/python/src/simulation.h"

namespace stylet::python {
namespace {

// The pose as Python has it: seven numbers.
py::array_t<float> pose_of_tip(std::array<float, 3> tip_m, std::array<float, 3> direction,
                               float length_m) {
  const stylet_pose pose = stylet_pose_of_tip({tip_m[0], tip_m[1], tip_m[2]},
                                              {direction[0], direction[1], direction[2]}, length_m);
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
  add_types(module);
  add_organ(module);
  add_simulation(module);
  add_batch(module);
  add_hand(module);
}
