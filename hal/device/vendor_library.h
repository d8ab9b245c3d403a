// SPDX-License-Identifier: Apache-2.0
// A vendor's library, loaded at run time: once for a process, and never unloaded.
// Promise: throws DeviceError with one line that names what was tried and what the loader said.
#pragma once

#include <initializer_list>
#include <string>

namespace stylet::hal {

class VendorLibrary {
 public:
  // The environment `variable` can name one file to use instead of the usual names.
  VendorLibrary(const char* scheme, const char* variable, std::initializer_list<const char*> names);

  // Throws if the library has no such function; find() leaves null instead.
  template <typename Function>
  void need(const char* name, Function*& out) const {
    out = reinterpret_cast<Function*>(symbol(name, true));
  }
  template <typename Function>
  void find(const char* name, Function*& out) const {
    out = reinterpret_cast<Function*>(symbol(name, false));
  }

 private:
  void* symbol(const char* name, bool needed) const;

  std::string scheme_;
  std::string path_;
  void* handle_ = nullptr;
};

}  // namespace stylet::hal
