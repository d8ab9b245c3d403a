// SPDX-License-Identifier: Apache-2.0
// Which devices this machine could use, and why not the others: one line for each kind, with the
// first thing that is missing and its remedy. It opens none, so faults that only opening shows
// (calibration, another program that has the device) are left to the probe.
// Promise: only reads; a captured tree of /proc, /sys and /dev can be examined instead.
#pragma once

#include <string>
#include <vector>

namespace stylet::hal {

struct DeviceSighting {
  std::string uri;   // to open it with
  std::string name;  // of the kind
  bool ready = false;
  std::string seen;    // what is there or what is missing
  std::string remedy;  // empty: nothing to do
};
std::vector<DeviceSighting> search_devices(const std::string& root = "/");

}  // namespace stylet::hal
