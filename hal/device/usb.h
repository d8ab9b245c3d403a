// SPDX-License-Identifier: Apache-2.0
// What Linux tells of devices on USB, for a driver's search.
// Promise: only reads, only below the tree's root.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hal/device/driver.h"

namespace stylet::hal {

constexpr const char* kUdevRemedy =
    "sudo toolchain/rt-host/rt-host.sh installs udev rules; then unplug it and plug it in again";

// A device on the bus: where it is (empty if it is missing), and the files a program needs to talk
// to it.
struct Attached {
  std::string place;
  std::vector<std::string> nodes;
};
Attached find_usb(const HostTree& tree, std::span<const UsbId> ids);
// Adds the device's files in /sys/class/`type`, such as tty.
void add_nodes(const HostTree& tree, const std::string& type, std::span<const UsbId> ids,
               Attached& found);
// Whether our udev rules are installed.
bool has_rules(const HostTree& tree);
// True if everything is accessible; else says what is not.
bool may_use(const HostTree& tree, const Attached& attached, DeviceSighting& out);

}  // namespace stylet::hal
