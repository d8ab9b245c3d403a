// SPDX-License-Identifier: Apache-2.0
#include "hal/device/vendor_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <vector>

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
    handle_ = dlopen(each.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) return;
    // If a file is there, the loader says what it lacks: that is worth more than other messages.
    const char* error = dlerror();
    const std::string said = error != nullptr ? error : each;
    const bool lacks = said.find(each + ": cannot open shared object file") == std::string::npos;
    if (reasons.empty() || lacks) reasons = said;
  }
  throw DeviceError(fmt::format(
      "{}: {}: expected the vendor's library, installed where the loader finds it, or its file in "
      "{}",
      scheme, reasons, variable));
}

void* VendorLibrary::symbol(const char* name, bool needed) const {
  void* found = dlsym(handle_, name);
  if (found == nullptr && needed) {
    throw DeviceError(fmt::format("{}: {}: no function {}: expected a library of this vendor",
                                  scheme_, path_, name));
  }
  return found;
}

}  // namespace stylet::hal
