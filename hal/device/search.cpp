// SPDX-License-Identifier: Apache-2.0
#include "hal/device/search.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "hal/base/host_tree.h"
#include "hal/device/devices.h"
#include "hal/device/drivers/force_dimension.h"
#include "hal/device/drivers/openhaptics.h"
#include "hal/device/drivers/spacemouse.h"
#include "hal/device/usb_devices.h"

namespace stylet::hal {
namespace {

using std::string;

constexpr const char* kRules =
    "sudo toolchain/rt-host/rt-host.sh installs udev rules; then unplug it and plug it in again";

// A device on the bus: what it is called there, and the files a program needs to talk to it.
struct Attached {
  string place;
  std::vector<string> nodes;
};

string id_of(const HostTree& tree, const string& folder, const char* which) {
  return read_text(tree, folder + "/" + which).value_or("");
}

bool is_one(const HostTree& tree, const string& folder, const char* scheme) {
  const string vendor = id_of(tree, folder, "idVendor"), product = id_of(tree, folder, "idProduct");
  return std::any_of(kUsbDevices.begin(), kUsbDevices.end(), [&](const UsbDevice& known) {
    return scheme == std::string_view(known.scheme) && known.is(vendor, product);
  });
}

// Terminals and raw HIDs carry their device's ids two or three folders up.
void add_nodes(const HostTree& tree, const string& type, const char* scheme, Attached& found) {
  for (const string& name : names_in(tree, "/sys/class/" + type)) {
    string folder = "/sys/class/" + type + "/" + name + "/device";
    for (int up = 0; up < 4; ++up, folder += "/..") {
      if (!is_one(tree, folder, scheme)) continue;
      found.nodes.push_back("/dev/" + name);
      break;
    }
  }
}

Attached find_usb(const HostTree& tree, const char* scheme) {
  const string bus = "/sys/bus/usb/devices";
  Attached found;
  for (const string& entry : names_in(tree, bus)) {
    const string folder = bus + "/" + entry;
    if (!is_one(tree, folder, scheme)) continue;
    found.place = "USB " + entry;
    const auto number = parse_number(id_of(tree, folder, "busnum"));
    const auto device = parse_number(id_of(tree, folder, "devnum"));
    if (number && device) {
      found.nodes.push_back(fmt::format("/dev/bus/usb/{:03}/{:03}", *number, *device));
    }
  }
  return found;
}

bool modem_manager_runs(const HostTree& tree) {
  for (const string& process : names_in(tree, "/proc")) {
    if (!parse_number(process)) continue;
    if (read_text(tree, "/proc/" + process + "/comm") == "ModemManager") return true;
  }
  return false;
}

bool has_rules(const HostTree& tree) {
  return exists(tree, "/etc/udev/rules.d/70-stylet-haptic.rules");
}

// True if everything is in reach; else says what is not.
bool may_use(const HostTree& tree, const Attached& attached, DeviceSighting& out) {
  for (const string& node : attached.nodes) {
    if (access((tree.root + node).c_str(), R_OK | W_OK) == 0) continue;
    out.seen = fmt::format("{}: {} may not be read and written by this user", attached.place, node);
    out.remedy = has_rules(tree) ? "usermod -aG realtime USER, then log in again" : kRules;
    return false;
  }
  return true;
}

DeviceSighting openhaptics(const HostTree& tree) {
  DeviceSighting out = {"hd:", "3D Systems Touch and relatives", false, "", ""};
  Attached touch = find_usb(tree, "hd");
  touch.nodes.clear();  // the driver talks to a terminal or a raw HID
  add_nodes(tree, "tty", "hd", touch);
  add_nodes(tree, "hidraw", "hd", touch);
  if (const string missing = openhaptics_missing(); !missing.empty()) {
    out.seen = (touch.place.empty() ? "" : touch.place + ", but ") + missing;
    out.remedy =
        "install the vendor's OpenHaptics and Touch driver; a library it lacks, such as "
        "libncurses.so.5, is in Debian (apt install libncurses5)";
    return out;
  }
  if (!touch.place.empty() && !may_use(tree, touch, out)) return out;
  const bool terminal = !touch.nodes.empty() && touch.nodes[0].find("tty") != string::npos;
  if (terminal && !has_rules(tree) && modem_manager_runs(tree)) {
    out.seen = touch.place + ": ModemManager takes it for a modem";
    out.remedy = kRules;
    return out;
  }
  out.ready = true;
  out.seen = touch.place.empty() ? "library; none on USB (older ones are on Ethernet or FireWire)"
                                 : "library, " + touch.place;
  return out;
}

DeviceSighting force_dimension(const HostTree& tree) {
  DeviceSighting out = {"dhd:", "Force Dimension, Novint Falcon", false, "", ""};
  const Attached device = find_usb(tree, "dhd");
  if (const string missing = force_dimension_missing(); !missing.empty()) {
    out.seen = (device.place.empty() ? "" : device.place + ", but ") + missing;
    out.remedy = "install the vendor's SDK (libdhd.so.3 and libusb-1.0)";
    return out;
  }
  if (device.place.empty()) {
    out.seen = "library, but no such device on USB";
    out.remedy = "check cable and power";
    return out;
  }
  if (!may_use(tree, device, out)) return out;
  out.ready = true;
  out.seen = "library, " + device.place;
  return out;
}

// Somebody listens on this port of this machine.
bool listens(std::uint16_t port) {
  const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto* at = reinterpret_cast<const sockaddr*>(&address);
  const bool good = connect(probe, at, sizeof address) == 0;
  close(probe);
  return good;
}

DeviceSighting haply() {
  constexpr std::uint16_t kPort = 10001;
  if (listens(kPort)) return {"haply:", "Haply Inverse3", true, "its service answers", ""};
  return {"haply:", "Haply Inverse3", false, "no service on 127.0.0.1:10001",
          "install haply-inverse-service and start it"};
}

DeviceSighting spacemouse(const HostTree& tree) {
  DeviceSighting out = {"spacemouse:", "3Dconnexion SpaceMouse", false, "", ""};
  const Attached mouse = find_usb(tree, "spacemouse");
  const string path = spacenavd_socket();
  if (!exists(tree, path)) {
    out.seen = (mouse.place.empty() ? "" : mouse.place + ", but ") + ("no socket " + path);
    out.remedy = "apt install spacenavd; systemctl start spacenavd";
    return out;
  }
  out.ready = access((tree.root + path).c_str(), R_OK | W_OK) == 0;
  out.seen = path + (out.ready ? "" : " may not be used by this user") +
             (mouse.place.empty() ? "" : ", " + mouse.place);
  if (!out.ready) out.remedy = "chmod 666 " + path;
  return out;
}

}  // namespace

std::vector<DeviceSighting> search_devices(const string& root) {
  const HostTree tree = {root == "/" ? "" : root};
  return {openhaptics(tree),
          force_dimension(tree),
          haply(),
          spacemouse(tree),
          {"pointer:", "mouse or finger on the console's page", true, "with --console", ""},
          {"udp:7755", "another program, over the network", true, "always", ""},
          {"shm:NAME", "another program, through shared memory", true, "always", ""}};
}

}  // namespace stylet::hal
