// SPDX-License-Identifier: GPL-3.0-or-later
// Python's dicts as the tables that recipes, tissues and options are read from.
//
// Promise: a value that a table cannot hold is refused with its name; nothing is dropped.
#pragma once

#include <pybind11/pybind11.h>

#include "base/toml_file.h"
#include "pipeline/settings.h"

namespace stylet::offline::python {

namespace py = pybind11;

// `name` is that of the dict, for messages.
toml::table table_of(const py::dict& dict, const std::string& name);

// Options by the names of Settings; another name is a TypeError.
Settings settings_of(const py::dict& options);

}  // namespace stylet::offline::python
