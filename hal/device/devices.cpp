// SPDX-License-Identifier: Apache-2.0
#include "hal/device/devices.h"

#include <fmt/format.h>

#include <array>

#include "hal/device/lasting_device.h"
#include "hal/device/patience.h"
#include "hal/device/thread.h"

namespace stylet::hal {
namespace {

constexpr double kAgainPatienceS = 1;  // for calibration and first samples, at each new try

constexpr std::array kOwn = {
#define STYLET_DRIVER(file, descriptor) &descriptor,
#define STYLET_LIBRARY_DRIVER(file, descriptor)
#ifdef _WIN32
#define STYLET_LINUX_DRIVER(file, descriptor)
#else
#define STYLET_LINUX_DRIVER STYLET_DRIVER
#endif
#include "hal/device/drivers.inc"
#undef STYLET_DRIVER
#undef STYLET_LIBRARY_DRIVER
#undef STYLET_LINUX_DRIVER
};
constinit std::span<const DriverDescriptor* const> g_drivers = kOwn;

const DriverDescriptor* driver_of(const std::string& uri) {
  for (const DriverDescriptor* each : g_drivers) {
    if (uri.starts_with(std::string(each->scheme) + ":")) return each;
  }
  return nullptr;
}

}  // namespace

std::span<const DriverDescriptor* const> drivers() {
  return g_drivers;
}

void use_drivers(std::span<const DriverDescriptor* const> known) {
  g_drivers = known;
}

std::string device_uri_fault(const std::string& uri) {
  if (driver_of(uri) != nullptr) return "";
  std::string expected;
  for (const DriverDescriptor* each : g_drivers) {
    expected += fmt::format("{}{}:", expected.empty() ? "" : ", ", each->scheme);
  }
  return "a device's URI, which begins with one of " + expected;
}

bool device_renders(const std::string& uri) {
  const DriverDescriptor* driver = driver_of(uri);
  return driver != nullptr && driver->renders;
}

void stop_opening_when(bool (*asked)()) {
  g_opening_stops.store(asked);
}

int device_priority_refused() {
  return g_priority_refused.load();
}

Device open_device(const std::string& uri, double patience_s) {
  const DriverDescriptor* driver = driver_of(uri);
  if (driver == nullptr) {
    throw DeviceError(fmt::format("{}: expected {}", uri, device_uri_fault(uri)));
  }
  return driver->open(uri.substr(uri.find(':') + 1), patience_s);
}

Device open_lasting_device(const std::string& uri, double patience_s) {
  const DriverDescriptor* driver = driver_of(uri);
  const Device device = open_device(uri, patience_s);
  if (driver->may_open_again == nullptr) return device;
  std::string again = uri;
  if (driver->same != nullptr) {
    const std::size_t rest = uri.find(':') + 1;
    again = uri.substr(0, rest) + driver->same(uri.substr(rest), device.info.identity);
  }
  return lasting_device(device, {.open = [again] { return open_device(again, kAgainPatienceS); },
                                 .may_open = driver->may_open_again,
                                 .uri = again});
}

}  // namespace stylet::hal
