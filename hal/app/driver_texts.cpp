// SPDX-License-Identifier: Apache-2.0
// stylet_driver_texts udev | table | windows: texts about the drivers that also stand elsewhere,
// made from their descriptors, for toolchain/checks/drivers.py.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "hal/device/drivers/haply.h"

namespace stylet::app {
namespace {

std::string ids_of(const hal::UsbId& id, const char* attribute) {
  std::string ids = fmt::format("{}{{idVendor}}==\"{}\"", attribute, id.vendor);
  if (*id.product != 0) ids += fmt::format(", {}{{idProduct}}==\"{}\"", attribute, id.product);
  return ids;
}

// One line for each USB id that `wanted` accepts.
template <typename Wanted>
std::string for_ids(const char* match, const char* attribute, const char* then, Wanted wanted) {
  std::string lines;
  for (const hal::DriverDescriptor* driver : hal::drivers_with_haply()) {
    for (const hal::UsbId& id : driver->usb) {
      if (!wanted(id)) continue;
      lines += fmt::format("{}, {}, {}\n", match, ids_of(id, attribute), then);
    }
  }
  return lines;
}

std::string udev_rules() {
  std::string vendors;
  for (const hal::DriverDescriptor* driver : hal::drivers_with_haply()) {
    for (const hal::UsbId& id : driver->usb) {
      vendors += fmt::format("#   {}{}{} {}\n", id.vendor, *id.product == 0 ? "" : ":", id.product,
                             id.name);
    }
  }
  const auto all = [](const hal::UsbId&) { return true; };
  return fmt::format(
      "# SPDX-License-Identifier: Apache-2.0\n"
      "# Haptic devices for the group realtime: never suspended, and not taken for a modem. Made "
      "from the\n# drivers' descriptors by toolchain/checks/drivers.py.\n{}"
      "ACTION==\"remove\", GOTO=\"stylet_end\"\n\n"
      "# The right to keep processors awake.\n"
      "SUBSYSTEM==\"misc\", KERNEL==\"cpu_dma_latency\", GROUP=\"realtime\", MODE=\"0660\"\n\n{}"
      "ENV{{STYLET_HAPTIC}}==\"1\", GROUP=\"realtime\", MODE=\"0660\", TEST==\"power/control\", "
      "ATTR{{power/control}}=\"on\"\n\n{}{}\nLABEL=\"stylet_end\"\n",
      vendors,
      for_ids("SUBSYSTEM==\"usb\", ENV{DEVTYPE}==\"usb_device\"", "ATTR",
              "ENV{STYLET_HAPTIC}=\"1\"", all),
      for_ids("SUBSYSTEM==\"tty\"", "ATTRS",
              "GROUP=\"realtime\", MODE=\"0660\", ENV{ID_MM_DEVICE_IGNORE}=\"1\"",
              [](const hal::UsbId& id) { return id.has_terminal; }),
      for_ids("SUBSYSTEM==\"hidraw\"", "ATTRS", "GROUP=\"realtime\", MODE=\"0660\"",
              [](const hal::UsbId& id) { return id.has_raw_hid; }));
}

std::string table() {
  std::string rows =
      "| URI | device | measures / renders | what it needs |\n| --- | --- | --- | --- |\n";
  for (const hal::DriverDescriptor* driver : hal::drivers_with_haply()) {
    const hal::DriverRow& row = driver->row;
    rows += fmt::format("| {} | {} | {} | {} |\n", row.uris, row.device, row.freedoms, row.needs);
  }
  return rows;
}

// What becomes of each kind in a library for Windows, where nobody calls use_drivers().
std::string windows_table() {
  std::string here, not_here;
  const auto add = [](std::string& kinds, const hal::DriverDescriptor& driver) {
    kinds += fmt::format("{}`{}:`", kinds.empty() ? "" : ", ", driver.scheme);
  };
#define STYLET_DRIVER(file, descriptor) add(here, hal::descriptor);
#define STYLET_LIBRARY_DRIVER(file, descriptor)
#define STYLET_LINUX_DRIVER(file, descriptor) add(not_here, hal::descriptor);
#include "hal/device/drivers.inc"
#undef STYLET_DRIVER
#undef STYLET_LIBRARY_DRIVER
#undef STYLET_LINUX_DRIVER
  return fmt::format(
      "| `stylet_device_open` | on Windows |\n| --- | --- |\n"
      "| {} | as on Linux |\n"
      "| {} | refused (`STYLET_DEVICE_FAILED`), with the kinds that are known |\n",
      here, not_here);
}

}  // namespace
}  // namespace stylet::app

int main(int argc, char** argv) {
  const std::string_view wanted = argc == 2 ? argv[1] : "";
  std::string text;
  if (wanted == "udev") text = stylet::app::udev_rules();
  if (wanted == "table") text = stylet::app::table();
  if (wanted == "windows") text = stylet::app::windows_table();
  if (text.empty()) {
    (void)std::fputs("usage: stylet_driver_texts udev | table | windows\n", stderr);
    return 2;
  }
  return std::fputs(text.c_str(), stdout) < 0 ? 1 : 0;
}
