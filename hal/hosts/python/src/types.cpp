// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/python/src/types.h"

#include <string>

namespace stylet::python {

py::dtype dtype_of(std::initializer_list<Field> fields, std::size_t bytes) {
  py::list names, formats, offsets;
  for (const Field& each : fields) {
    names.append(each.name);
    formats.append(each.format);
    offsets.append(each.offset);
  }
  return {names, formats, offsets, static_cast<py::ssize_t>(bytes)};
}

namespace {

py::object& error_type() {
  static py::object& type = *new py::object;  // outlives the interpreter, whose end frees nothing
  return type;
}

// Beside what C says: as attributes, so that a program need not read the text.
[[noreturn]] void raise(const stylet_refusal& why) {
  py::object error = error_type()(py::str(why.text));
  error.attr("status") = why.status;
  error.attr("status_name") = stylet_status_name(why.status);
  error.attr("place") = why.place;
  error.attr("index") = why.index;
  error.attr("value") = why.value;
  error.attr("least") = why.least;
  error.attr("most") = why.most;
  error.attr("expected") = why.expected;
  error.attr("text") = why.text;
  PyErr_SetObject(error_type().ptr(), error.ptr());
  throw py::error_already_set();
}

}  // namespace

py::dtype vec3_dtype() {
  return py::dtype::of<float>();
}

py::dtype input_dtype() {
  return dtype_of({STYLET_FIELD(stylet_input, struct_bytes, kUint32),
                   STYLET_FIELD(stylet_input, valid, kUint32),
                   {"position_m", kVec3, offsetof(stylet_input, handle.position_m)},
                   {"rotation_wxyz", kQuat, offsetof(stylet_input, handle.rotation)},
                   STYLET_FIELD(stylet_input, plunger_n, kFloat)},
                  sizeof(stylet_input));
}

py::dtype output_dtype() {
  const py::dtype fields = dtype_of({STYLET_FIELD(stylet_output, flags, kUint32),
                                     STYLET_FIELD(stylet_output, tick, kUint64),
                                     STYLET_FIELD(stylet_output, force_n, kVec3),
                                     STYLET_FIELD(stylet_output, torque_nm, kVec3),
                                     STYLET_FIELD(stylet_output, stiffness_n, kVec3),
                                     STYLET_FIELD(stylet_output, cutting_n, kVec3),
                                     STYLET_FIELD(stylet_output, friction_n, kVec3),
                                     STYLET_FIELD(stylet_output, clamping_n, kVec3),
                                     STYLET_FIELD(stylet_output, obstacle_n, kVec3),
                                     STYLET_FIELD(stylet_output, tip_m, kVec3),
                                     STYLET_FIELD(stylet_output, depth_m, kFloat),
                                     STYLET_FIELD(stylet_output, phase, kUint32),
                                     STYLET_FIELD(stylet_output, layer, kUint32),
                                     STYLET_FIELD(stylet_output, constraint_particles, kUint32),
                                     STYLET_FIELD(stylet_output, events, kUint32),
                                     STYLET_FIELD(stylet_output, stiffness_n_per_m, kFloat),
                                     STYLET_FIELD(stylet_output, opening_pa, kFloat),
                                     STYLET_FIELD(stylet_output, hub_pa, kFloat),
                                     STYLET_FIELD(stylet_output, flow_m3_per_s, kFloat),
                                     STYLET_FIELD(stylet_output, injected_m3, kFloat),
                                     STYLET_FIELD(stylet_output, plunger_m, kFloat),
                                     STYLET_FIELD(stylet_output, plunger_m_per_s, kFloat),
                                     STYLET_FIELD(stylet_output, filled, kFloat)},
                                    sizeof(stylet_output));
  const py::object record = py::module_::import("numpy").attr("record");
  return py::dtype::from_args(py::make_tuple(record, fields));
}

py::dtype config_dtype() {
  return dtype_of(
      {STYLET_FIELD(stylet_config, mode, kUint32), STYLET_FIELD(stylet_config, period_s, kFloat),
       STYLET_FIELD(stylet_config, substeps, kUint32),
       STYLET_FIELD(stylet_config, inertia, kUint32),
       STYLET_FIELD(stylet_config, tissue_damping_s, kFloat),
       STYLET_FIELD(stylet_config, surround_drag_per_s, kFloat),
       STYLET_FIELD(stylet_config, hourglass_weight, kFloat),
       STYLET_FIELD(stylet_config, paper_alpha, kFloat),
       STYLET_FIELD(stylet_config, breathing_amplitude_m, kVec3),
       STYLET_FIELD(stylet_config, breathing_period_s, kFloat),
       STYLET_FIELD(stylet_config, gravity_m_per_s2, kVec3)},
      sizeof(stylet_config));
}

py::dtype needle_dtype() {
  return dtype_of({STYLET_FIELD(stylet_needle, length_m, kFloat),
                   STYLET_FIELD(stylet_needle, outer_radius_m, kFloat),
                   STYLET_FIELD(stylet_needle, unit_m, kFloat),
                   STYLET_FIELD(stylet_needle, bending_nm2, kFloat),
                   STYLET_FIELD(stylet_needle, rods, kUint32),
                   STYLET_FIELD(stylet_needle, bevel_per_m, kFloat),
                   STYLET_FIELD(stylet_needle, bent_length_m, kFloat),
                   STYLET_FIELD(stylet_needle, bent_angle_rad, kFloat),
                   STYLET_FIELD(stylet_needle, torsion_nm2, kFloat),
                   STYLET_FIELD(stylet_needle, tip_half_angle_rad, kFloat),
                   STYLET_FIELD(stylet_needle, torn_diameters, kFloat),
                   STYLET_FIELD(stylet_needle, hub, kUint32),
                   STYLET_FIELD(stylet_needle, bore_radius_m, kFloat),
                   STYLET_FIELD(stylet_needle, opening_m, kFloat),
                   STYLET_FIELD(stylet_needle, filling_pa_s, kFloat),
                   STYLET_FIELD(stylet_needle, plunger_radius_m, kFloat),
                   STYLET_FIELD(stylet_needle, plunger_friction_n, kFloat),
                   STYLET_FIELD(stylet_needle, syringe_m3, kFloat),
                   STYLET_FIELD(stylet_needle, syringe_filled, kFloat),
                   STYLET_FIELD(stylet_needle, syringe_gas_m3, kFloat)},
                  sizeof(stylet_needle));
}

py::dtype obstacle_dtype() {
  const std::string vertices = "(" + std::to_string(STYLET_MAX_HULL_VERTICES) + ",3)<f4";
  return dtype_of({STYLET_FIELD(stylet_obstacle, vertex_count, kUint32),
                   {"position_m", kVec3, offsetof(stylet_obstacle, pose.position_m)},
                   {"rotation_wxyz", kQuat, offsetof(stylet_obstacle, pose.rotation)},
                   {"vertices_m", vertices.c_str(), offsetof(stylet_obstacle, vertices_m)},
                   STYLET_FIELD(stylet_obstacle, rounding_m, kFloat),
                   STYLET_FIELD(stylet_obstacle, stiffness_n_per_m, kFloat),
                   STYLET_FIELD(stylet_obstacle, largest_force_n, kFloat),
                   STYLET_FIELD(stylet_obstacle, friction, kFloat)},
                  sizeof(stylet_obstacle));
}

py::dtype voxel_dtype() {
  return dtype_of(
      {STYLET_FIELD(stylet_voxel, x, "<u2"), STYLET_FIELD(stylet_voxel, y, "<u2"),
       STYLET_FIELD(stylet_voxel, z, "<u2"), STYLET_FIELD(stylet_voxel, material, "u1"),
       STYLET_FIELD(stylet_voxel, fixed, "u1"), STYLET_FIELD(stylet_voxel, fill, kFloat)},
      sizeof(stylet_voxel));
}

py::dtype cube_dtype() {
  return dtype_of(
      {STYLET_FIELD(stylet_cube, low_m, kVec3), STYLET_FIELD(stylet_cube, edge_m, kFloat)},
      sizeof(stylet_cube));
}

py::dtype constraint_particle_dtype() {
  return dtype_of({STYLET_FIELD(stylet_constraint_particle, position_m, kVec3),
                   STYLET_FIELD(stylet_constraint_particle, goal_m, kVec3),
                   STYLET_FIELD(stylet_constraint_particle, force_on_needle_n, kVec3),
                   STYLET_FIELD(stylet_constraint_particle, arc_length_m, kFloat),
                   STYLET_FIELD(stylet_constraint_particle, is_tip, kUint32),
                   STYLET_FIELD(stylet_constraint_particle, needle, kUint32)},
                  sizeof(stylet_constraint_particle));
}

py::dtype obstacle_touch_dtype() {
  return dtype_of({STYLET_FIELD(stylet_obstacle_touch, position_m, kVec3),
                   STYLET_FIELD(stylet_obstacle_touch, normal, kVec3),
                   STYLET_FIELD(stylet_obstacle_touch, force_on_needle_n, kVec3),
                   STYLET_FIELD(stylet_obstacle_touch, obstacle, kUint32),
                   STYLET_FIELD(stylet_obstacle_touch, needle, kUint32)},
                  sizeof(stylet_obstacle_touch));
}

py::dtype event_dtype() {
  return dtype_of(
      {STYLET_FIELD(stylet_event, tick, kUint64), STYLET_FIELD(stylet_event, kind, kUint32),
       STYLET_FIELD(stylet_event, layer, kUint32), STYLET_FIELD(stylet_event, depth_m, kFloat),
       STYLET_FIELD(stylet_event, force_n, kFloat), STYLET_FIELD(stylet_event, needle, kUint32)},
      sizeof(stylet_event));
}

Bytes::Bytes(const py::object& given) {
  if (PyObject_GetBuffer(given.ptr(), &view_, PyBUF_SIMPLE) != 0) throw py::error_already_set();
}

void refuse_objects_without_init(const py::module_& module) {
  for (const auto& [name, object] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(object.ptr())) continue;
    auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(object.ptr()));
    if (type == nullptr) continue;  // Python's own, such as StyletError
    // Called where a method, or a function with such an argument, finds no object of C++.
    type->operator_new = [](std::size_t) -> void* {
      throw py::type_error("__init__ of this object was not called, or raised");
    };
  }
}

void refuse_second_init(const py::object& object) {
  auto* const base = reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
  if (PyObject_TypeCheck(object.ptr(), base) == 0) {
    throw py::type_error("expected an object of this module");
  }
  auto* const instance = reinterpret_cast<py::detail::instance*>(object.ptr());
  if (instance->get_value_and_holder().instance_registered()) {
    throw py::type_error("__init__ of this object was called before: make another one");
  }
}

void add_types(py::module_& module) {
  error_type() = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc("stylet.StyletError",
                                "What the library refused: status and status_name, and where it "
                                "knows them place, index, value, least, most, expected.",
                                nullptr, nullptr));
  module.attr("StyletError") = error_type();
  module.attr("input_dtype") = input_dtype();
  module.attr("output_dtype") = output_dtype();
  module.attr("config_dtype") = config_dtype();
  module.attr("needle_dtype") = needle_dtype();
  module.attr("obstacle_dtype") = obstacle_dtype();
  module.attr("voxel_dtype") = voxel_dtype();
  module.attr("cube_dtype") = cube_dtype();
  module.attr("constraint_particle_dtype") = constraint_particle_dtype();
  module.attr("obstacle_touch_dtype") = obstacle_touch_dtype();
  module.attr("event_dtype") = event_dtype();
  module.def("default_config",
             [] { return defaults<stylet_config>(config_dtype(), stylet_config_init); });
  module.def("default_needle",
             [] { return defaults<stylet_needle>(needle_dtype(), stylet_needle_init); });
  module.def("preset_needle", [](const std::string& name) {
    py::array row = defaults<stylet_needle>(needle_dtype(), stylet_needle_init);
    check(stylet_needle_preset(static_cast<stylet_needle*>(row.mutable_data()), name.c_str()));
    return row;
  });
  module.def("needle_presets", [] {
    py::list names;
    for (std::uint32_t i = 0; stylet_needle_preset_name(i) != nullptr; ++i) {
      names.append(stylet_needle_preset_name(i));
    }
    return names;
  });
  module.def("default_obstacle",
             [] { return defaults<stylet_obstacle>(obstacle_dtype(), stylet_obstacle_init); });
  module.def("box_obstacle", [](float x_m, float y_m, float z_m) {
    py::array row = defaults<stylet_obstacle>(obstacle_dtype(), stylet_obstacle_init);
    check(stylet_obstacle_box(static_cast<stylet_obstacle*>(row.mutable_data()), {x_m, y_m, z_m}));
    return row;
  });
  module.def("sphere_obstacle", [](float radius_m) {
    py::array row = defaults<stylet_obstacle>(obstacle_dtype(), stylet_obstacle_init);
    check(stylet_obstacle_sphere(static_cast<stylet_obstacle*>(row.mutable_data()), radius_m));
    return row;
  });
}

void check(stylet_status status, const stylet_refusal& why) {
  if (status != STYLET_OK) raise(why);
}

void check(stylet_status status) {
  if (status == STYLET_OK) return;
  stylet_refusal why = empty_refusal();
  why.status = status;
  std::string(stylet_status_name(status)).copy(why.text, sizeof why.text - 1);
  raise(why);
}

stylet_refusal empty_refusal() {
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  return why;
}

py::array read_only(const py::array& array) {
  py::array view = array.attr("view")();
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

py::object names(const py::dict& values) {
  return py::module_::import("types").attr("SimpleNamespace")(**values);
}

}  // namespace stylet::python
