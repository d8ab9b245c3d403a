// SPDX-License-Identifier: Apache-2.0
// What is seen of a simulation between two ticks, and how it is.
#include "hal/hosts/python/src/simulation.h"

namespace stylet::python {
namespace {

py::object pool_names(const stylet_pool& pool) {
  using namespace py::literals;
  return names(
      py::dict("used"_a = pool.used, "used_max"_a = pool.used_max, "capacity"_a = pool.capacity));
}

}  // namespace

// Fills memory that stays in its place, and shows as much of it as there is.
template <typename T, typename Fill>
py::array Simulation::show(Shown& shown, const py::dtype& dtype, py::ssize_t columns,
                           std::uint32_t most, const Fill& fill) {
  const Use use(*this);
  if (!shown.own || shown.own.size() == 0) {
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(most)};
    if (columns > 1) shape.push_back(columns);
    shown.own = py::array(dtype, shape);
    shown.view = read_only(shown.own);
  }
  const std::uint32_t count = fill(static_cast<T*>(shown.own.mutable_data()), most);
  return count == most ? shown.view : shown.view[py::slice(0, count, 1)].cast<py::array>();
}

py::array Simulation::surface() {
  const std::uint32_t most = stylet_simulation_surface(handle(), nullptr, 0);
  return show<stylet_vec3>(surface_, vec3_dtype(), 3, most, [&](auto* out, std::uint32_t room) {
    return stylet_simulation_surface(handle(), out, room);
  });
}

py::array Simulation::needle_shape(std::uint32_t needle) {
  if (needle >= needles_) throw py::index_error("there is no such needle");
  return show<stylet_vec3>(shapes_[needle], vec3_dtype(), 3, STYLET_MAX_RODS + 1,
                           [&](auto* out, std::uint32_t room) {
                             return stylet_simulation_needle_shape(handle(), needle, out, room);
                           });
}

py::array Simulation::particles() {
  const std::uint32_t most = stylet_simulation_particles(handle(), nullptr, 0);
  return show<stylet_vec3>(particles_, vec3_dtype(), 3, most, [&](auto* out, std::uint32_t room) {
    return stylet_simulation_particles(handle(), out, room);
  });
}

py::array Simulation::voxel_corners() {
  const std::uint32_t most = stylet_simulation_voxel_corners(handle(), nullptr, 0);
  return show<std::uint32_t>(corners_, py::dtype::of<std::uint32_t>(), 8, most / 8,
                             [&](auto* out, std::uint32_t room) {
                               return stylet_simulation_voxel_corners(handle(), out, 8 * room) / 8;
                             });
}

py::array Simulation::constraint_particles() {
  const std::uint32_t most = needles_ * (STYLET_MAX_CONSTRAINT_PARTICLES + 1);
  return show<stylet_constraint_particle>(constraint_particles_, constraint_particle_dtype(), 1,
                                          most, [&](auto* out, std::uint32_t room) {
                                            return stylet_simulation_constraint_particles(
                                                handle(), out, room);
                                          });
}

py::array Simulation::obstacle_touches() {
  return show<stylet_obstacle_touch>(
      touches_, obstacle_touch_dtype(), 1, needles_ * STYLET_MAX_TOUCHES,
      [&](auto* out, std::uint32_t room) {
        return stylet_simulation_obstacle_touches(handle(), out, room);
      });
}

py::array Simulation::events() {
  return show<stylet_event>(
      events_, event_dtype(), 1, STYLET_MAX_EVENTS,
      [&](auto* out, std::uint32_t room) { return stylet_simulation_events(handle(), out, room); });
}

py::object Simulation::stats() {
  const Use use(*this);
  stylet_stats s = {};
  s.struct_bytes = sizeof s;
  check(stylet_simulation_get_stats(handle(), &s));
  using namespace py::literals;
  return names(py::dict(
      "filter_passes"_a = s.filter_passes, "ticks"_a = s.ticks,
      "constraint_particles"_a = pool_names(s.constraint_particles),
      "coupled_voxels"_a = pool_names(s.coupled_voxels), "tracks"_a = pool_names(s.tracks),
      "obstacle_contacts"_a = pool_names(s.obstacle_contacts),
      "input_not_finite"_a = s.input_not_finite, "input_clamped"_a = s.input_clamped,
      "input_missing"_a = s.input_missing, "cp_pool_full"_a = s.cp_pool_full,
      "cp_voxel_pool_full"_a = s.cp_voxel_pool_full, "contact_budget"_a = s.contact_budget,
      "fault"_a = s.fault, "obstacle_pool_full"_a = s.obstacle_pool_full,
      "needle_unstable"_a = s.needle_unstable, "coupling_shortfall"_a = s.coupling_shortfall,
      "unit_in_voxels"_a = s.unit_in_voxels));
}

py::object Simulation::energy() {
  const Use use(*this);
  stylet_energy e = {};
  e.struct_bytes = sizeof e;
  check(stylet_simulation_get_energy(handle(), &e));
  using namespace py::literals;
  return names(py::dict("elastic_j"_a = e.elastic_j, "kinetic_j"_a = e.kinetic_j,
                        "coupling_j"_a = e.coupling_j, "bending_j"_a = e.bending_j,
                        "work_by_hand_j"_a = e.work_by_hand_j, "friction_j"_a = e.friction_j,
                        "cutting_j"_a = e.cutting_j, "relaxation_j"_a = e.relaxation_j,
                        "obstacles_j"_a = e.obstacles_j, "sliding_j"_a = e.sliding_j));
}

py::tuple Simulation::mass(std::uint32_t material) {
  const Use use(*this);
  float real_kg = 0, stepped_kg = 0;
  check(stylet_simulation_get_mass(handle(), material, &real_kg, &stepped_kg));
  return py::make_tuple(real_kg, stepped_kg);
}

}  // namespace stylet::python
