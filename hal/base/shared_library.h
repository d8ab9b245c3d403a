// SPDX-License-Identifier: Apache-2.0
// A library of somebody else's, loaded at run time and never unloaded, as Linux and Windows do it.
// Promise: throws nothing of its own; not for the loop.
#pragma once

#include <string>

namespace stylet::hal {

struct LoadedLibrary {
  void* handle = nullptr;  // null: it could not be loaded
  std::string why;         // in the loader's words
  bool was_there = false;  // it was found, but lacks something or is not a library
};

// `file`: a name where the loader looks, or a path.
LoadedLibrary load_library(const std::string& file);
// Null if the library has no such function.
void* library_symbol(void* handle, const char* name);
// Where a library has to be for its name to be enough.
const char* where_libraries_are();

}  // namespace stylet::hal
