// SPDX-License-Identifier: Apache-2.0
// stylet_driver_texts udev | table | windows | needles | materials | tips | devices: texts that
// also stand elsewhere, made from the drivers' descriptors and the needles, for
// toolchain/checks/drivers.py.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "hal/base/needles.h"
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

// ---- what a scene may name ----------------------------------------------------------------------

std::string needle_table() {
  std::string rows =
      "| needle | OD / ID mm | material | EI N m^2 | length mm | tip, half angle | what |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const hal::NeedlePreset& each : hal::needle_presets()) {
    const std::string inner = each.inner_mm > 0 ? fmt::format("{:.4g}", each.inner_mm) : "solid";
    const double stiffness_nm2 =
        hal::bending_nm2(each.outer_mm, each.inner_mm, each.material.youngs_modulus_gpa);
    rows += fmt::format("| `{}` | {:.4g} / {} | `{}` | {:.2e} | {:.4g} | {}, {:.4g}° | {} |\n",
                        each.name, each.outer_mm, inner, each.material.name, stiffness_nm2,
                        each.length_mm, each.tip, each.half_angle_deg, each.what);
  }
  return rows;
}

std::string material_table() {
  std::string rows = "| material | E GPa |\n| --- | --- |\n";
  for (const hal::NeedleMaterial& each : hal::needle_materials()) {
    rows += fmt::format("| `{}` | {:.4g} |\n", each.name, each.youngs_modulus_gpa);
  }
  return rows;
}

std::string tip_table() {
  std::string rows = "| tip | length of the crack, in outer diameters |\n| --- | --- |\n";
  for (const hal::TipKind& each : hal::tip_kinds()) {
    rows += fmt::format("| `{}` | {:.4g} |\n", each.name, each.torn_diameters);
  }
  return rows;
}

std::string model_table() {
  std::string rows =
      "| device | force N | continuous N | slew N/s | stiffness N/m | damping N s/m | workspace mm "
      "| mass g | arm's damping N s/m | friction N | resolution mm | delay ms |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  // As written in the code, not as a float holds them.
  const auto milli = [](float value) { return fmt::format("{:.4g}", 1e3F * value); };
  for (const hal::DriverDescriptor* driver : hal::drivers_with_haply()) {
    for (const hal::DeviceModel& each : driver->models) {
      const hal::DeviceDynamics& motion = each.motion;
      rows += fmt::format(
          "| `{}` | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {} x {} x {} | {} | {:.4g} | "
          "{:.4g} | {} | {} |\n",
          each.name, each.max_force_n, each.continuous_force_n, each.max_slew_n_per_s,
          each.max_stiffness_n_per_m, each.max_damping_n_s_per_m, milli(each.workspace_m.x),
          milli(each.workspace_m.y), milli(each.workspace_m.z), milli(motion.mass_kg),
          motion.damping_n_s_per_m, motion.friction_n, milli(motion.resolution_m),
          milli(motion.delay_s));
    }
  }
  return rows;
}

}  // namespace
}  // namespace stylet::app

int main(int argc, char** argv) {
  const std::string_view wanted = argc == 2 ? argv[1] : "";
  std::string text;
  if (wanted == "udev") text = stylet::app::udev_rules();
  if (wanted == "table") text = stylet::app::table();
  if (wanted == "windows") text = stylet::app::windows_table();
  if (wanted == "needles") text = stylet::app::needle_table();
  if (wanted == "materials") text = stylet::app::material_table();
  if (wanted == "tips") text = stylet::app::tip_table();
  if (wanted == "devices") text = stylet::app::model_table();
  if (text.empty()) {
    (void)std::fputs(
        "usage: stylet_driver_texts udev | table | windows | needles | materials | tips | "
        "devices\n",
        stderr);
    return 2;
  }
  return std::fputs(text.c_str(), stdout) < 0 ? 1 : 0;
}
