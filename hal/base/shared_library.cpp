// SPDX-License-Identifier: Apache-2.0
#include "hal/base/shared_library.h"

#include <dlfcn.h>

namespace stylet::hal {

LoadedLibrary load_library(const std::string& file) {
  LoadedLibrary out;
  out.handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (out.handle != nullptr) return out;
  const char* const error = dlerror();
  out.why = error != nullptr ? error : file;
  out.was_there = out.why.find(file + ": cannot open shared object file") == std::string::npos;
  return out;
}

void* library_symbol(void* handle, const char* name) {
  return dlsym(handle, name);
}

const char* where_libraries_are() {
  return "installed where the loader finds it";
}

}  // namespace stylet::hal
