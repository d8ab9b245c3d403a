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

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "stylet/hal/device.h"

namespace stylet::hal {

struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct DeviceKind {
  const char* scheme;   // before the colon
  const char* example;  // of a URI
  const char* name;
  Device (*open)(const std::string& rest, double patience_s);
  // Whether it may be opened again now, once it has failed for good; null: it comes back by itself.
  bool (*may_open_again)();
};
std::span<const DeviceKind> device_kinds();

// Empty: the URI's kind is known. Else what was expected.
std::string device_uri_fault(const std::string& uri);
// close frees what open made.
Device open_device(const std::string& uri, double patience_s = 10);
// Likewise; and when the device has failed for good, a thread that is not the loop's opens it again
// as soon as it can (lasting_device.h).
Device open_lasting_device(const std::string& uri, double patience_s = 10);

}  // namespace stylet::hal
