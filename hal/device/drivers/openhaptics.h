// SPDX-License-Identifier: Apache-2.0
// 3D Systems (Geomagic, Sensable) Touch and relatives through OpenHaptics HD, libHD.so: six degrees
// of freedom measured, three rendered.
//
// The servo runs in the vendor's thread, at about 1 kHz: it publishes pose and buttons and applies
// the newest force (relay.h). The library is loaded once and never unloaded, because loading it a
// second time fails. STYLET_LIBHD names a library elsewhere. The position is the middle of the
// gimbal. Frame: the device's own is ours. Source: OpenHaptics API reference, programmer's guide.
#pragma once

#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

// Empty `name`: the default device. Waits up to patience_s for calibration.
Device open_openhaptics(const std::string& name, double patience_s);
// Whether a device is open, has not failed, and may have a force: another can be opened only by
// stopping its servo for a moment. A device that was opened again after a failure has no force
// until somebody acknowledges.
bool openhaptics_in_use();
// Empty: the library is there. Else one line that says why not.
std::string openhaptics_missing();

}  // namespace stylet::hal
