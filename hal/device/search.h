// SPDX-License-Identifier: Apache-2.0
// Which devices this machine could use, and why not the others: one line for each kind, with the
// first thing that is missing and its remedy. It opens none, so whether a program in a network
// sends, and faults such as a missing calibration, are left to the probe.
// Promise: only reads; a captured tree of /proc, /sys and /dev can be examined instead.
#pragma once

#include <string>
#include <vector>

namespace stylet::hal {

enum class Presence {
  kMissing,  // it cannot be opened
  kUnknown,  // nothing is known to be missing, but only opening it shows whether it is there
  kReady,    // it was seen
};

struct DeviceSighting {
  std::string uri;   // to open it with
  std::string name;  // of the kind
  Presence presence = Presence::kMissing;
  std::string seen;    // what is there or what is missing
  std::string remedy;  // empty: nothing to do
};
std::vector<DeviceSighting> search_devices(const std::string& root = "/");

}  // namespace stylet::hal
