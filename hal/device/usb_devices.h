// SPDX-License-Identifier: Apache-2.0
// Haptic devices on USB: vendor, and product where the vendor makes other things too. The one list
// of them; toolchain/rt-host has it once more for udev, and its test compares the two.
#pragma once

#include <array>
#include <string_view>

namespace stylet::hal {

struct UsbDevice {
  const char* scheme;  // of its URI
  const char* vendor;
  const char* product;  // empty: any
  const char* name;

  bool is(std::string_view its_vendor, std::string_view its_product) const {
    return its_vendor == vendor && (*product == 0 || its_product == product);
  }
};
constexpr std::array kUsbDevices = {
    UsbDevice{"hd", "2988", "", "3D Systems Touch"},
    UsbDevice{"dhd", "1451", "", "Force Dimension"},
    UsbDevice{"dhd", "0403", "cb48", "Novint Falcon"},
    UsbDevice{"spacemouse", "256f", "", "3Dconnexion SpaceMouse"},
    UsbDevice{"spacemouse", "046d", "c626", "3Dconnexion SpaceNavigator"},
};

}  // namespace stylet::hal
