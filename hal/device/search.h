// SPDX-License-Identifier: Apache-2.0
// Which devices this machine could use, and why not the others: a line for each kind, with the
// first thing that is missing and its remedy. Opens none: what only opening shows (calibration,
// another program that has it) is for the probe.
// Promise: reads only; a captured tree of /proc, /sys and /dev can be looked at instead.
#pragma once

#include <string>
#include <vector>

namespace stylet::hal {

struct DeviceSighting {
  std::string uri;   // to open it with
  std::string name;  // of the kind
  bool ready = false;
  std::string seen;    // what is there, or what is missing
  std::string remedy;  // empty: nothing to do
};
std::vector<DeviceSighting> search_devices(const std::string& root = "/");

}  // namespace stylet::hal
