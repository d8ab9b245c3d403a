// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/python/src/organ.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hal/hosts/python/src/poses.h"

namespace stylet::python {
namespace {

py::tuple tuple_of(stylet_vec3 v) {
  return py::make_tuple(v.x, v.y, v.z);
}

py::object info_of(const stylet_organ* organ) {
  stylet_organ_info info = {};
  info.struct_bytes = sizeof info;
  check(stylet_organ_get_info(organ, &info));
  using namespace py::literals;
  return names(py::dict(
      "format_version"_a = info.format_version, "hash"_a = info.hash, "name"_a = info.name,
      "voxel_edge_m"_a = info.voxel_edge_m, "origin_m"_a = tuple_of(info.origin_m),
      "size"_a = py::make_tuple(info.size_x, info.size_y, info.size_z), "voxels"_a = info.voxels,
      "vertices"_a = info.vertices, "triangles"_a = info.triangles, "materials"_a = info.materials,
      "low_m"_a = tuple_of(info.low_m), "high_m"_a = tuple_of(info.high_m)));
}

py::object material_of(const stylet_organ* organ, std::uint32_t index) {
  stylet_material m = {};
  m.struct_bytes = sizeof m;
  check(stylet_organ_get_material(organ, index, &m));
  using namespace py::literals;
  return names(py::dict(
      "name"_a = m.name, "source"_a = m.source, "density_kg_per_m3"_a = m.density_kg_per_m3,
      "youngs_modulus_pa"_a = m.youngs_modulus_pa, "poisson_ratio"_a = m.poisson_ratio,
      "relaxing_fraction"_a = m.relaxing_fraction, "relaxation_time_s"_a = m.relaxation_time_s,
      "puncture_force_n"_a = m.puncture_force_n, "cutting_force_n"_a = m.cutting_force_n,
      "recut_fraction"_a = m.recut_fraction,
      "coulomb_friction_n_per_m"_a = m.coulomb_friction_n_per_m,
      "static_friction_n_per_m"_a = m.static_friction_n_per_m,
      "stribeck_velocity_m_per_s"_a = m.stribeck_velocity_m_per_s,
      "viscous_friction_n_s_per_m2"_a = m.viscous_friction_n_s_per_m2,
      "puncture_velocity_exponent"_a = m.puncture_velocity_exponent,
      "membrane_n_per_m"_a = m.membrane_n_per_m, "strain_stiffening"_a = m.strain_stiffening,
      "fracture_toughness_j_per_m2"_a = m.fracture_toughness_j_per_m2,
      "toughness_velocity_exponent"_a = m.toughness_velocity_exponent,
      "needle_friction_coefficient"_a = m.needle_friction_coefficient,
      "fluid_pressure_pa"_a = m.fluid_pressure_pa,
      "fluid_conductance_m3_per_pa_s"_a = m.fluid_conductance_m3_per_pa_s,
      "fluid_viscosity_pa_s"_a = m.fluid_viscosity_pa_s));
}

Organ looked_at(stylet_organ* given) {
  Organ out;
  out.handle = std::shared_ptr<stylet_organ>(given, stylet_organ_free);
  out.info = info_of(given);
  py::list materials;
  for (std::uint32_t i = 0; i < out.info.attr("materials").cast<std::uint32_t>(); ++i) {
    materials.append(material_of(given, i));
  }
  out.materials = py::tuple(materials);
  return out;
}

// Fills the array at its first use. `columns` numbers are one element for the library.
template <typename T, typename Copy>
py::object kept(const Organ& organ, py::object& array, const py::dtype& dtype, py::ssize_t columns,
                const Copy& copy) {
  if (!array) {
    const std::uint32_t count = copy(organ.handle.get(), nullptr, 0);
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(count)};
    if (columns > 1) shape.push_back(columns);
    py::array all(dtype, shape);
    copy(organ.handle.get(), static_cast<T*>(all.mutable_data()), count);
    array = read_only(all);
  }
  return array;
}

// "8", or "8 to 2" if voxels have several edges.
std::string edges_mm(const stylet_organ* organ) {
  std::vector<stylet_cube> cubes(stylet_organ_cubes(organ, nullptr, 0));
  stylet_organ_cubes(organ, cubes.data(), static_cast<std::uint32_t>(cubes.size()));
  const auto shorter = [](const stylet_cube& a, const stylet_cube& b) {
    return a.edge_m < b.edge_m;
  };
  const auto [fine, coarse] = std::minmax_element(cubes.begin(), cubes.end(), shorter);
  const auto mm = [](float edge_m) {
    return py::str("{:.4g}").format(1e3 * static_cast<double>(edge_m));
  };
  std::string edges = mm(coarse->edge_m);
  if (fine->edge_m < coarse->edge_m) edges += " to " + std::string(mm(fine->edge_m));
  return edges;
}

py::str told(const Organ& o) {
  return py::str("<stylet.Organ {!r}: {} voxels of {} mm, {} materials>")
      .format(o.info.attr("name"), o.info.attr("voxels"), edges_mm(o.handle.get()),
              o.info.attr("materials"));
}

}  // namespace

Organ read_organ(const std::string& path) {
  stylet_organ* handle = nullptr;
  stylet_refusal why = empty_refusal();
  stylet_status status = STYLET_OK;
  {
    const py::gil_scoped_release others_run;
    status = stylet_organ_read(path.c_str(), &handle, &why);
  }
  check(status, why);
  return looked_at(handle);
}

Organ organ_from_bytes(const py::object& bytes) {
  stylet_organ* handle = nullptr;
  stylet_refusal why = empty_refusal();
  const Bytes all(bytes);
  check(stylet_organ_from_bytes(all.data(), all.size(), &handle, &why), why);
  return looked_at(handle);
}

namespace {

py::object raycast(const Organ& organ, const py::object& origin_m, const py::object& direction) {
  const auto from = vector_of<3>("origin_m", origin_m);
  const auto way = vector_of<3>("direction", direction);
  float distance_m = 0;
  const int meets = stylet_organ_raycast(organ.handle.get(), {from[0], from[1], from[2]},
                                         {way[0], way[1], way[2]}, &distance_m);
  return meets == 1 ? py::object(py::float_(static_cast<double>(distance_m)))
                    : py::object(py::none());
}

}  // namespace

void add_organ(py::module_& module) {
  py::class_<Organ> type(module, "Organ");
  refuse_pickle(type,
                "an organ cannot be pickled: pass the path of its file (stylet.kept_organ reads it "
                "once in each process)");
  // Nothing of it changes: a copy is the same one.
  type.def("__copy__", [](const py::object& self) { return self; })
      .def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; })
      .def("__repr__", told);
  type.def_static(
          "read",
          [](const py::object& path) {
            const auto name = py::module_::import("os").attr("fsencode")(path).cast<std::string>();
            if (name.find('\0') != std::string::npos) {
              throw py::value_error("path: a byte 0 in it");  // as open() says; C would end there
            }
            return read_organ(name);
          },
          py::arg("path"), "The organ in this file.")
      .def_static("from_bytes", organ_from_bytes, py::arg("content"), "The same of bytes.")
      .def_readonly("info", &Organ::info)
      .def_readonly("materials", &Organ::materials)
      .def_property_readonly("voxels",
                             [](Organ& o) {
                               return kept<stylet_voxel>(o, o.voxels, voxel_dtype(), 1,
                                                         stylet_organ_voxels);
                             })
      .def_property_readonly("cubes",
                             [](Organ& o) {
                               return kept<stylet_cube>(o, o.cubes, cube_dtype(), 1,
                                                        stylet_organ_cubes);
                             })
      .def_property_readonly("vertices",
                             [](Organ& o) {
                               return kept<stylet_vec3>(o, o.vertices, vec3_dtype(), 3,
                                                        stylet_organ_vertices);
                             })
      .def_property_readonly("vertex_materials",
                             [](Organ& o) {
                               return kept<std::uint8_t>(o, o.vertex_materials,
                                                         py::dtype::of<std::uint8_t>(), 1,
                                                         stylet_organ_vertex_materials);
                             })
      .def_property_readonly("triangles",
                             [](Organ& o) {
                               return kept<std::uint32_t>(o, o.triangles,
                                                          py::dtype::of<std::uint32_t>(), 3,
                                                          stylet_organ_triangles);
                             })
      .def("raycast", raycast, py::arg("origin_m"), py::arg("direction"),
           "How far the surface at rest is from here, that way; None: it is not there.");
}

}  // namespace stylet::python
