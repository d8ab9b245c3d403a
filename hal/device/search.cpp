// SPDX-License-Identifier: Apache-2.0
#include "hal/device/search.h"

#include "hal/device/devices.h"

namespace stylet::hal {

std::vector<DeviceSighting> search_devices(const std::string& root) {
  const HostTree tree = {root == "/" ? "" : root};
  std::vector<DeviceSighting> all;
  for (const DriverDescriptor* each : drivers()) {
    DeviceSighting& one =
        all.emplace_back(DeviceSighting{each->uri, each->name, Presence::kMissing, "", ""});
    each->search(tree, one);
  }
  return all;
}

}  // namespace stylet::hal
