// SPDX-License-Identifier: Apache-2.0
#include "hal/device/devices.h"

#include <fmt/format.h>

#include <array>

#include "hal/device/drivers/force_dimension.h"
#include "hal/device/drivers/haply.h"
#include "hal/device/drivers/openhaptics.h"
#include "hal/device/drivers/peer.h"
#include "hal/device/drivers/pointer.h"
#include "hal/device/drivers/spacemouse.h"
#include "hal/device/lasting_device.h"
#include "hal/device/patience.h"
#include "hal/device/thread.h"

namespace stylet::hal {
namespace {

constexpr double kAgainPatienceS = 1;  // for calibration and first samples, each time it is tried

bool always() {
  return true;
}

constexpr std::array kKinds = {
    DeviceKind{"hd", "hd:", "3D Systems Touch and relatives, OpenHaptics", open_openhaptics,
               [] { return !openhaptics_in_use(); }},
    DeviceKind{"dhd", "dhd:0", "Force Dimension and Novint Falcon, DHD", open_force_dimension,
               always},
    DeviceKind{"haply", "haply:", "Haply Inverse3, its service", open_haply, always, same_haply},
    DeviceKind{"spacemouse", "spacemouse:", "3Dconnexion SpaceMouse, spacenavd: no force",
               open_spacemouse, always, nullptr, false},
    DeviceKind{"pointer", "pointer:", "mouse or finger on the console's page: no force",
               open_pointer, nullptr, nullptr, false},
    DeviceKind{"udp", "udp:7755", "another program, over the network", open_udp, nullptr},
    DeviceKind{"shm", "shm:mine", "another program, through shared memory", open_shared_memory,
               nullptr},
};

const DeviceKind* kind_of(const std::string& uri) {
  for (const DeviceKind& each : kKinds) {
    if (uri.starts_with(std::string(each.scheme) + ":")) return &each;
  }
  return nullptr;
}

}  // namespace

std::span<const DeviceKind> device_kinds() {
  return kKinds;
}

std::string device_uri_fault(const std::string& uri) {
  if (kind_of(uri) != nullptr) return "";
  std::string expected;
  for (const DeviceKind& each : kKinds) {
    expected += fmt::format("{}{}:", expected.empty() ? "" : ", ", each.scheme);
  }
  return "a device's URI, which begins with one of " + expected;
}

bool device_renders(const std::string& uri) {
  const DeviceKind* kind = kind_of(uri);
  return kind != nullptr && kind->renders;
}

void stop_opening_when(bool (*asked)()) {
  g_opening_stops.store(asked);
}

int device_priority_refused() {
  return g_priority_refused.load();
}

Device open_device(const std::string& uri, double patience_s) {
  const DeviceKind* kind = kind_of(uri);
  if (kind == nullptr) {
    throw DeviceError(fmt::format("{}: expected {}", uri, device_uri_fault(uri)));
  }
  return kind->open(uri.substr(uri.find(':') + 1), patience_s);
}

Device open_lasting_device(const std::string& uri, double patience_s) {
  const DeviceKind* kind = kind_of(uri);
  const Device device = open_device(uri, patience_s);
  if (kind->may_open_again == nullptr) return device;
  std::string again = uri;
  if (kind->same != nullptr) {
    const std::size_t rest = uri.find(':') + 1;
    again = uri.substr(0, rest) + kind->same(uri.substr(rest), device.info.identity);
  }
  return lasting_device(device, {.open = [again] { return open_device(again, kAgainPatienceS); },
                                 .may_open = kind->may_open_again});
}

}  // namespace stylet::hal
