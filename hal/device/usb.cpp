// SPDX-License-Identifier: Apache-2.0
#include "hal/device/usb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace stylet::hal {

using std::string;

namespace {

string id_of(const HostTree& tree, const string& folder, const char* which) {
  return read_text(tree, folder + "/" + which).value_or("");
}

bool is_one(const HostTree& tree, const string& folder, std::span<const UsbId> ids) {
  const string vendor = id_of(tree, folder, "idVendor"), product = id_of(tree, folder, "idProduct");
  return std::any_of(ids.begin(), ids.end(),
                     [&](const UsbId& known) { return known.is(vendor, product); });
}

}  // namespace

// Terminals and raw HIDs have the ids of their device two or three folders further up.
void add_nodes(const HostTree& tree, const string& type, std::span<const UsbId> ids,
               Attached& found) {
  for (const string& name : names_in(tree, "/sys/class/" + type)) {
    string folder = "/sys/class/" + type + "/" + name + "/device";
    for (int up = 0; up < 4; ++up, folder += "/..") {
      if (!is_one(tree, folder, ids)) continue;
      found.nodes.push_back("/dev/" + name);
      break;
    }
  }
}

Attached find_usb(const HostTree& tree, std::span<const UsbId> ids) {
  const string bus = "/sys/bus/usb/devices";
  Attached found;
  for (const string& entry : names_in(tree, bus)) {
    const string folder = bus + "/" + entry;
    if (!is_one(tree, folder, ids)) continue;
    found.place = "USB " + entry;
    const auto number = parse_number(id_of(tree, folder, "busnum"));
    const auto device = parse_number(id_of(tree, folder, "devnum"));
    if (number && device) {
      found.nodes.push_back(fmt::format("/dev/bus/usb/{:03}/{:03}", *number, *device));
    }
  }
  return found;
}

bool has_rules(const HostTree& tree) {
  return exists(tree, "/etc/udev/rules.d/70-stylet-haptic.rules");
}

// True if everything is accessible; else says what is not.
bool may_use(const HostTree& tree, const Attached& attached, DeviceSighting& out) {
  for (const string& node : attached.nodes) {
    if (access((tree.root + node).c_str(), R_OK | W_OK) == 0) continue;
    out.seen = fmt::format("{}: {} may not be read and written by this user", attached.place, node);
    out.remedy = has_rules(tree) ? "usermod -aG realtime USER, then log in again" : kUdevRemedy;
    return false;
  }
  return true;
}

}  // namespace stylet::hal
