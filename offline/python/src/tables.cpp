// SPDX-License-Identifier: GPL-3.0-or-later
#include "tables.h"

#include <pybind11/stl.h>

#include <string>

namespace stylet::offline::python {
namespace {

[[noreturn]] void refuse_value(const std::string& place, py::handle value, const char* expected) {
  throw py::type_error(place + ": " + py::repr(value).cast<std::string>() + ": expected " +
                       expected);
}

toml::array array_of(const py::sequence& list, const std::string& place);

// Gives `put` the value as a type of TOML. numpy's numbers and arrays count as Python's.
template <typename Put>
void convert(py::handle value, const std::string& place, const Put& put) {
  if (py::hasattr(value, "tolist")) {
    convert(value.attr("tolist")(), place, put);
  } else if (py::isinstance<py::dict>(value)) {
    put(table_of(value.cast<py::dict>(), place));
  } else if (py::isinstance<py::str>(value)) {
    put(value.cast<std::string>());
  } else if (py::isinstance<py::bool_>(value)) {
    put(value.cast<bool>());
  } else if (py::isinstance<py::int_>(value)) {
    put(value.cast<std::int64_t>());
  } else if (py::isinstance<py::float_>(value)) {
    put(value.cast<double>());
  } else if (py::isinstance<py::sequence>(value)) {
    put(array_of(value.cast<py::sequence>(), place));
  } else {
    refuse_value(place, value, "a number, a text, a list or a dict");
  }
}

toml::array array_of(const py::sequence& list, const std::string& place) {
  toml::array out;
  for (const py::handle each : list) {
    convert(each, place,
            [&](auto&& value) { out.push_back(std::forward<decltype(value)>(value)); });
  }
  return out;
}

struct Taker {
  const py::dict& options;
  std::size_t taken = 0;

  template <typename T>
  void operator()(const char* name, T& field, const char* expected) {
    if (!options.contains(name)) return;
    ++taken;
    const py::object value = options[name];
    try {
      field = value.cast<T>();
    } catch (const py::cast_error&) {
      refuse_value(name, value, expected);
    }
  }
};

}  // namespace

toml::table table_of(const py::dict& dict, const std::string& name) {
  toml::table out;
  for (const auto& [key, value] : dict) {
    if (!py::isinstance<py::str>(key)) refuse_value(name, key, "a text as key");
    const auto text = key.cast<std::string>();
    convert(value, name + "." + text,
            [&](auto&& each) { out.insert(text, std::forward<decltype(each)>(each)); });
  }
  return out;
}

Settings settings_of(const py::dict& options) {
  Settings s;
  Taker take{options};
  take("name", s.name, "a text");
  take("voxel_mm", s.voxel_mm, "a number");
  take("voxels_across", s.voxels_across, "a whole number");
  take("capsule", s.capsule, "the name of a tissue, 'auto' or 'none'");
  take("fix", s.fix, "a list of texts");
  take("crop", s.crop, "a list of texts");
  take("materials", s.materials, "a path or a dict");
  take("layers", s.layers, "a list of texts");
  take("layers_of", s.layers_of, "the name of a tissue");
  take("layers_along", s.layers_along, "a text");
  take("membranes", s.membranes, "a list of texts");
  take("slides", s.slides, "a list of texts");
  take("refine", s.refine, "a list of texts");
  take("fill_gaps", s.fill_gaps, "a text");
  take("split_gaps", s.split_gaps, "True or False");
  take("wrap", s.wrap, "True or False");
  if (take.taken != options.size()) throw py::type_error("unknown option");
  return s;
}

}  // namespace stylet::offline::python
