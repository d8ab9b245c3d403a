// SPDX-License-Identifier: Apache-2.0
#include "hal/device/vendor_library.h"

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "hal/base/shared_library.h"
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
    const LoadedLibrary loaded = load_library(each);
    handle_ = loaded.handle;
    if (handle_ != nullptr) return;
    // If a file is there, the loader says what it lacks: that is worth more than other messages.
    if (reasons.empty() || loaded.was_there) reasons = loaded.why;
  }
  throw DeviceError(fmt::format("{}: {}: expected the vendor's library, {}, or its file in {}",
                                scheme, reasons, where_libraries_are(), variable));
}

void* VendorLibrary::symbol(const char* name, bool needed) const {
  void* const found = library_symbol(handle_, name);
  if (found == nullptr && needed) {
    throw DeviceError(fmt::format("{}: {}: no function {}: expected a library of this vendor",
                                  scheme_, path_, name));
  }
  return found;
}

}  // namespace stylet::hal
