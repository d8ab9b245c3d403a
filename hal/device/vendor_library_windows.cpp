// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <windows.h>

#include <cstdlib>
#include <system_error>
#include <vector>

#include "hal/device/vendor_library.h"
// Ours are words, too.
#undef far
#undef near

#include "hal/device/devices.h"

namespace stylet::hal {

VendorLibrary::VendorLibrary(const char* scheme, const char* variable,
                             std::initializer_list<const char*> names)
    : scheme_(scheme) {
  std::vector<std::string> tried(names.begin(), names.end());
  if (const char* path = std::getenv(variable); path != nullptr) tried = {path};
  std::string reasons;
  for (const std::string& each : tried) {
    path_ = each;
    handle_ = LoadLibraryA(each.c_str());
    if (handle_ != nullptr) return;
    // If a file is there, it lacks another one or is none: that is worth more than other messages.
    const DWORD error = GetLastError();
    if (reasons.empty() || error != ERROR_MOD_NOT_FOUND) {
      reasons =
          fmt::format("{}: {}", each, std::system_category().message(static_cast<int>(error)));
    }
  }
  throw DeviceError(fmt::format(
      "{}: {}: expected the vendor's library, beside the program or in PATH, or its file in {}",
      scheme, reasons, variable));
}

void* VendorLibrary::symbol(const char* name, bool needed) const {
  void* const found = reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle_), name));
  if (found == nullptr && needed) {
    throw DeviceError(fmt::format("{}: {}: no function {}: expected a library of this vendor",
                                  scheme_, path_, name));
  }
  return found;
}

}  // namespace stylet::hal
