// SPDX-License-Identifier: Apache-2.0
// Checks of haptic devices on USB, and of the interrupt threads that fetch their samples.
#include <fmt/format.h>

#include "hal/device/devices.h"
#include "hal/doctor/checks.h"

namespace stylet::hal {
namespace {

using std::string;

const char* haptic_name(const HostTree& tree, const string& folder) {
  const string vendor = read_text(tree, folder + "/idVendor").value_or("");
  const string product = read_text(tree, folder + "/idProduct").value_or("");
  for (const DriverDescriptor* driver : drivers()) {
    for (const UsbId& known : driver->usb) {
      if (known.is(vendor, product)) return known.name;
    }
  }
  return nullptr;
}

Seen usb_power(const Patient&, const HostTree& tree) {
  const string bus = "/sys/bus/usb/devices";
  if (!exists(tree, bus)) {
    if (!exists(tree, "/sys/bus")) return not_read(bus);
    return {Condition::kBesides, "no USB", bus};
  }
  string sleepy, found;
  for (const string& entry : names_in(tree, bus)) {
    const char* name = haptic_name(tree, bus + "/" + entry);
    if (name == nullptr) continue;
    found += fmt::format("{}{} at {}", found.empty() ? "" : ", ", name, entry);
    if (read_text(tree, bus + "/" + entry + "/power/control") != "on") sleepy = found;
  }
  const string path = bus + "/*/power/control";
  if (found.empty()) return {Condition::kBesides, "no haptic device attached", path};
  return {sleepy.empty() ? Condition::kGood : Condition::kBad,
          sleepy.empty() ? found + ", always on" : found + ", may be suspended", path};
}

// The thread that fetches a device's samples must not wait for the loop, which waits for them.
Seen device_thread(const Patient& patient, const HostTree& tree) {
  const string path = "/proc/*/stat (irq/*-*hci*)";
  std::size_t seen = 0, threads = 0;
  string below;
  for (const string& process : names_in(tree, "/proc")) {
    if (!parse_number(process)) continue;
    const auto task = read_task(tree, "/proc/" + process);
    if (!task) continue;
    ++seen;
    if (!task->name.starts_with("irq/") || task->name.find("hci") == string::npos) continue;
    ++threads;
    const bool waits = list_holds(task->cpus_allowed, patient.cpu) &&
                       task->priority <= static_cast<std::uint64_t>(patient.priority);
    if (waits)
      below += fmt::format("{}{} ({})", below.empty() ? "" : ", ", task->name, task->priority);
  }
  if (seen == 0) return not_read(path);
  if (threads == 0) return {Condition::kBesides, "no USB interrupt has a thread", path};
  if (!below.empty()) return {Condition::kBad, "here, below the loop: " + below, path};
  return {Condition::kGood, "above the loop or elsewhere", path};
}

constexpr Check kChecks[] = {
    {"device power", Verdict::kWarn, usb_power,
     "write on to its power/control; the udev rules of toolchain/rt-host do"},
    {"device IRQ thread", Verdict::kWarn, device_thread,
     "chrt -f -p 90 the thread, or keep its interrupt off processor {cpu} (irqaffinity=)"},
};

}  // namespace

std::span<const Check> device_checks() {
  return kChecks;
}

}  // namespace stylet::hal
