// SPDX-License-Identifier: Apache-2.0
// Devices by name: a URI is a driver's scheme, a colon, and what that driver needs to know.
// README.md lists them; the list is made from the drivers' descriptors (driver.h).
//
// Promise: open_device gives a device that measures, or throws DeviceError with one line; it may
// wait up to `patience_s` for the device. Vendor libraries are loaded here, at run time.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "hal/device/device.h"
#include "hal/device/driver.h"
#include "hal/device/motor.h"

namespace stylet::hal {

// The longest loop period with a device that renders. An order stays fresh for two of them, so that
// one lost tick is not felt. With a longer period the force would fade and rise in every tick.
constexpr std::int64_t kLongestDevicePeriodNs = kOrderFreshNs / 2;
// SCHED_FIFO priority of threads that talk to devices: above the loop's.
constexpr int kDevicePriority = 90;

// Of open: begins with the device's URI, "SCHEME:REST: what is wrong: what to do". What a device
// tells later (trouble, note) does not: whoever tells it says which device.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The known drivers: those given to use_drivers, else those that need no library.
std::span<const DriverDescriptor* const> drivers();
// Call once, before the first device; `known` must outlive all devices.
void use_drivers(std::span<const DriverDescriptor* const> known);

// Empty: the URI's driver is known. Else what was expected instead.
std::string device_uri_fault(const std::string& uri);
bool device_renders(const std::string& uri);
// Opening stops waiting once `asked` returns true; it may be called on any thread.
void stop_opening_when(bool (*asked)());
// errno of why a thread that talks to a device was refused its priority; 0: none was refused.
int device_priority_refused();
// Device::close frees what this makes.
Device open_device(const std::string& uri, double patience_s = 10);
// The same, but if the device fails for good, a thread other than the loop's opens it again as soon
// as it can (lasting_device.h).
Device open_lasting_device(const std::string& uri, double patience_s = 10);

}  // namespace stylet::hal
