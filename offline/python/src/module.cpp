// SPDX-License-Identifier: GPL-3.0-or-later
// The module stylet_organ._stylet_organ: builds of pipeline/ from what Python has in memory.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <tuple>

#include "arrays.h"
#include "asset/tissue_table.h"
#include "base/file.h"
#include "base/refusal.h"
#include "maps/recipe_table.h"
#include "pipeline/label_organ.h"
#include "tables.h"

namespace stylet::offline::python {
namespace {

// Called without the interpreter's lock, and takes it. Looks for Ctrl-C; an exception of that or of
// `told` ends the build. `told` is not copied: that would need the lock.
Progress progress_of(const py::object& told) {
  return [&told](const char* stage, double fraction) {
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!told.is_none()) told(stage, fraction);
  };
}

// An argument that is either a file or a dict in Python: its path, or the dict
// with its text for the provenance.
struct Given {
  std::string path;
  std::optional<py::dict> dict;
  std::string text;
};

Given given_of(const py::object& object, const std::string& text) {
  if (py::isinstance<py::dict>(object)) return {"", object.cast<py::dict>(), text};
  return {object.is_none() ? "" : object.cast<std::string>(), std::nullopt, text};
}

// Options with the tissues of `materials`. `units`: those of the meshes that options name.
BuildOptions options_of(Settings& settings, const Given& materials, const MeshUnits& units) {
  settings.materials = materials.path;
  BuildOptions options = common_options(settings, units);
  if (materials.dict) {
    options.own_tissues = tissues_of(table_of(*materials.dict, "materials"), "materials");
    options.options_text += " --materials " + materials.text;
  }
  return options;
}

py::dict result_of(const Built& built) {
  using namespace py::literals;
  py::list obstacles, targets;
  for (const NamedHull& each : built.obstacles) {
    py::array_t<double> vertices({each.hull.vertices_m.size(), std::size_t{3}});
    std::memcpy(vertices.mutable_data(), each.hull.vertices_m.data(),
                each.hull.vertices_m.size() * sizeof(Vec));
    obstacles.append(py::make_tuple(each.name, vertices));
  }
  for (const Target& each : built.targets) {
    const Vec at = each.middle_m;
    targets.append(py::make_tuple(each.name, py::make_tuple(at.x, at.y, at.z), each.radius_m));
  }
  return py::dict(
      "content"_a =
          py::bytes(reinterpret_cast<const char*>(built.bytes.data()), built.bytes.size()),
      "warnings"_a = built.report.warnings, "obstacles"_a = obstacles, "targets"_a = targets);
}

using Three = std::array<double, 3>;
Vec vec(const Three& v) {
  return {v[0], v[1], v[2]};
}

// Where an array of labels lies in the patient, and what it is called: origin and steps in m, names
// of labels, the file that the array was read from or nothing.
using Frame = std::tuple<Three, std::array<Three, 3>, LabelNames, std::string>;

py::dict build_from_labels(const py::array& labels, const std::array<std::size_t, 3>& axes,
                           const Frame& frame, const py::object& recipe,
                           const std::string& recipe_text, const py::object& materials,
                           const std::string& materials_text, const py::dict& options,
                           const py::object& progress) {
  Settings settings = settings_of(options);
  const Given own_recipe = given_of(recipe, recipe_text);
  BuildOptions build_options = options_of(settings, given_of(materials, materials_text), {});
  const LabelArray array = label_array(labels, axes);
  const auto& [origin_m, step_m, label_names, source] = frame;
  const std::string path = source.empty() ? "labels" : source;
  // With the interpreter's lock, as which files were read is noted for the whole program.
  const FileNames names = {path, label_names};
  const Recipe chosen = own_recipe.dict
                            ? recipe_of(table_of(*own_recipe.dict, "recipe"), "recipe", names)
                            : read_recipe(own_recipe.path, names);
  const std::string sum = source.empty() ? "" : sha256_hex(read_file(source));
  choose_for_labels(settings, {path, own_recipe.text}, chosen, build_options);
  const Progress watched = progress_of(progress);
  Built built;
  std::vector<std::size_t> voxels(65536, 0);  // of each label
  {
    const py::gil_scoped_release others_run;
    LabelMap map;
    map.origin_m = vec(origin_m);
    for (std::size_t i = 0; i < 3; ++i) map.step_m[i] = vec(step_m[i]);
    map.names = label_names;
    watched("reading the array", 0);
    take_array(path, array, map);
    if (!sum.empty()) map.sha256 = sum;
    for (const std::uint16_t label : map.label) ++voxels[label];
    built = build_labels(path, map, chosen, build_options, watched);
  }
  py::dict result = result_of(built), of_labels;
  for (std::size_t label = 1; label < voxels.size(); ++label) {
    if (voxels[label] > 0) of_labels[py::int_(label)] = voxels[label];
  }
  result["voxels_of_labels"] = of_labels;
  return result;
}

// Name, the file that it was read from or nothing, vertices in m, faces, tissue, priority.
using MeshArrays = std::tuple<std::string, std::string, Points, Faces, std::string, int>;

py::dict build_from_meshes(const std::vector<MeshArrays>& meshes, const py::object& materials,
                           const std::string& materials_text, const py::dict& options,
                           const py::object& progress) {
  Settings settings = settings_of(options);
  settings.units = "m";
  BuildOptions build_options = options_of(settings, given_of(materials, materials_text), {1.0});
  std::vector<Input> inputs;
  for (const auto& [name, source, vertices_m, faces, tissue, priority] : meshes) {
    (void)find_tissue(build_options.own_tissues, tissue);
    const std::string path = source.empty() ? name : source;
    inputs.push_back({path, tissue, priority, 1, mesh_of(path, vertices_m, faces)});
    if (!source.empty()) inputs.back().read.sha256 = sha256_hex(read_file(source));
  }
  choose_for_meshes(settings, inputs, build_options);
  const Progress watched = progress_of(progress);
  Built built;
  {
    const py::gil_scoped_release others_run;
    built = build(std::move(inputs), build_options, watched);
  }
  return result_of(built);
}

py::dict presets() {
  py::dict out;
  for (const Tissue& tissue : preset_tissues()) {
    py::dict numbers;
    for (const TissueNumber& number : tissue_numbers()) {
      numbers[number.key] = tissue.*(number.field) / number.si_per_unit;
    }
    numbers["source"] = tissue.source;
    out[py::str(tissue.name)] = numbers;
  }
  return out;
}

}  // namespace
}  // namespace stylet::offline::python

PYBIND11_MODULE(_stylet_organ, module) {
  using namespace stylet::offline::python;
  py::register_exception<stylet::offline::Refusal>(module, "Refused", PyExc_ValueError);
  module.def("build_from_labels", build_from_labels, py::arg("labels"), py::arg("axes"),
             py::arg("frame"), py::arg("recipe"), py::arg("recipe_text"), py::arg("materials"),
             py::arg("materials_text"), py::arg("options"), py::arg("progress"));
  module.def("build_from_meshes", build_from_meshes, py::arg("meshes"), py::arg("materials"),
             py::arg("materials_text"), py::arg("options"), py::arg("progress"));
  module.def("presets", presets);
  module.def("version", stylet::offline::tool_version);
}
