// SPDX-License-Identifier: Apache-2.0
// 3D Systems (Geomagic, Sensable) Touch and relatives through OpenHaptics HD, libHD.so: six degrees
// of freedom measured, three rendered.
//
// The servo runs in the vendor's thread, about 1 kHz: it publishes pose and buttons and applies the
// newest force (relay.h). The library is loaded once and never unloaded: it fails when it is loaded
// a second time. STYLET_LIBHD names a library elsewhere. Position is the middle of the gimbal.
// Frame: the device's own is ours. Source: OpenHaptics API reference and programmer's guide.
#pragma once

#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

// Empty name: the default device. Waits for calibration up to patience_s.
Device open_openhaptics(const std::string& name, double patience_s);
// One is open, has not failed, and may have a force: another could be opened only by stopping its
// servo for a moment. One that was opened again after it had failed has none before somebody
// acknowledged.
bool openhaptics_in_use();
// Empty: the library is there. Else why not, in one line.
std::string openhaptics_missing();

}  // namespace stylet::hal
