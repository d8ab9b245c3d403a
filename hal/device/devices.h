// SPDX-License-Identifier: Apache-2.0
// Devices by name: a URI is a kind, a colon, and what that kind wants to know.
//
//   hd:[NAME]         3D Systems Touch and relatives through OpenHaptics
//   dhd:[INDEX]       Force Dimension, Novint Falcon
//   haply:[ID]        Haply Inverse3 through its service
//   spacemouse:       3Dconnexion through spacenavd: places, no force
//   pointer:[NUMBER]  a mouse or a finger on the console's page: places, no force
//   udp:[ADDRESS:]PORT, shm:NAME   any other program that speaks in packets (packet.h)
//
// Promise: open_device gives a device that measures, or throws DeviceError with one line; it may
// wait for the device as long as `patience_s`. Vendor libraries are loaded here, at run time.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/device/device.h"
#include "hal/device/motor.h"

namespace stylet::hal {

// The longest period of a loop with a device that renders: an order is fresh for twice as long, so
// that one lost tick is not felt. A longer one would fade and rise with every tick.
constexpr std::int64_t kLongestDevicePeriodNs = kOrderFreshNs / 2;
constexpr int kDevicePriority =
    90;  // SCHED_FIFO, of threads that talk to devices: above the loop's

struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct DeviceKind {
  const char* scheme;   // before the colon
  const char* example;  // of a URI
  const char* name;
  Device (*open)(const std::string& rest, double patience_s);
  // Whether it may be closed and opened again now, once it has failed for good; null: it comes back
  // by itself.
  bool (*may_open_again)();
  // What opens the same one again, where a kind can say so; null: `rest` itself.
  std::string (*same)(const std::string& rest, const std::string& identity) = nullptr;
  bool renders = true;  // forces
};
std::span<const DeviceKind> device_kinds();

// Empty: the URI's kind is known. Else what was expected.
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
