// SPDX-License-Identifier: Apache-2.0
// A driver as the rest of the program knows it: one descriptor, in the driver's own file. The list
// of devices, the help, the doctor, the udev rules of toolchain/rt-host and the table in README.md
// are all made from it.
// Promise: plain data that outlives the program's last device.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "hal/base/host_tree.h"
#include "hal/device/device.h"
#include "hal/device/model.h"
#include "hal/device/search.h"

namespace stylet::hal {

// Ids on USB: the vendor, and the product if the vendor makes other things too.
struct UsbId {
  const char* vendor;
  const char* product;  // empty: any
  const char* name;
  bool has_terminal = false;  // it is also a terminal in /dev, which ModemManager must leave alone
  bool has_raw_hid = false;   // it is also a raw HID in /dev

  bool is(std::string_view its_vendor, std::string_view its_product) const {
    return its_vendor == vendor && (*product == 0 || its_product == product);
  }
};

// Its row of the table in README.md, in Markdown.
struct DriverRow {
  const char* uris;
  const char* device;
  const char* freedoms;  // that are measured / rendered
  const char* needs;
};

struct DriverDescriptor {
  const char* scheme;  // of its URIs, before the colon
  const char* uri;     // the URI that `stylet devices` lists
  const char* name;
  // `rest`: the part of the URI after the colon. Waits up to `patience_s` for the device; throws a
  // DeviceError of one line that says what to do.
  Device (*open)(const std::string& rest, double patience_s);
  // Says whether it is here (presence), what was seen or is missing, and the remedy; opens nothing.
  void (*search)(const HostTree& tree, DeviceSighting& out);
  // Whether a device that has failed for good may be closed and opened again now; null: it recovers
  // by itself.
  bool (*may_open_again)() = nullptr;
  // The text after the colon that opens the same device again, if the kind has one; null: `rest`.
  std::string (*same)(const std::string& rest, const std::string& identity) = nullptr;
  bool renders = true;  // whether it renders forces
  std::span<const UsbId> usb = {};
  std::span<const DeviceModel> models = {};  // models recognised by their names
  DriverRow row;
};

inline bool may_always_open_again() {
  return true;
}

#define STYLET_DRIVER(file, descriptor) extern const DriverDescriptor descriptor;
#define STYLET_LIBRARY_DRIVER STYLET_DRIVER
#define STYLET_LINUX_DRIVER STYLET_DRIVER
#include "hal/device/drivers.inc"
#undef STYLET_DRIVER
#undef STYLET_LIBRARY_DRIVER
#undef STYLET_LINUX_DRIVER

}  // namespace stylet::hal
