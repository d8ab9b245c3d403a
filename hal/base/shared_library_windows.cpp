// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <windows.h>

#include <system_error>

#include "hal/base/shared_library.h"

namespace stylet::hal {

LoadedLibrary load_library(const std::string& file) {
  LoadedLibrary out;
  out.handle = LoadLibraryA(file.c_str());
  if (out.handle != nullptr) return out;
  const DWORD error = GetLastError();
  out.why = fmt::format("{}: {}", file, std::system_category().message(static_cast<int>(error)));
  out.was_there = error != ERROR_MOD_NOT_FOUND;
  return out;
}

void* library_symbol(void* handle, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle), name));
}

const char* where_libraries_are() {
  return "beside the program or in PATH";
}

}  // namespace stylet::hal
