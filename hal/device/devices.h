// SPDX-License-Identifier: Apache-2.0
// Devices by name: a URI is a driver's scheme, a colon, and what that driver wants to know. Which
// there are: README.md, made from their descriptors (driver.h).
//
// Promise: open_device gives a device that measures, or throws DeviceError with one line; it may
// wait for the device as long as `patience_s`. Vendor libraries are loaded here, at run time.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "hal/device/device.h"
#include "hal/device/driver.h"
#include "hal/device/motor.h"

namespace stylet::hal {

// The longest period of a loop with a device that renders: an order is fresh for twice as long, so
// that one lost tick is not felt. A longer one would fade and rise with every tick.
constexpr std::int64_t kLongestDevicePeriodNs = kOrderFreshNs / 2;
// SCHED_FIFO, of threads that talk to devices: above the loop's.
constexpr int kDevicePriority = 90;

struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The drivers that are known: those that need no library, or what use_drivers was given.
std::span<const DriverDescriptor* const> drivers();
// Before the first device, once; `known` outlives all of them.
void use_drivers(std::span<const DriverDescriptor* const> known);

// Empty: the URI's driver is known. Else what was expected.
std::string device_uri_fault(const std::string& uri);
bool device_renders(const std::string& uri);
// Opening waits no longer once `asked` says so; any thread.
void stop_opening_when(bool (*asked)());
// Why a thread that talks to a device has not the priority it wants, errno; 0: none was refused.
int device_priority_refused();
// close frees what open made.
Device open_device(const std::string& uri, double patience_s = 10);
// Likewise; and when the device has failed for good, a thread that is not the loop's opens it again
// as soon as it can (lasting_device.h).
Device open_lasting_device(const std::string& uri, double patience_s = 10);

}  // namespace stylet::hal
