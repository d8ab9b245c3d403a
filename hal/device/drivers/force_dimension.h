// SPDX-License-Identifier: Apache-2.0
// Force Dimension delta, omega, sigma, lambda and the Novint Falcon through DHD, libdhd.so.
//
// A thread of ours polls the device 2000 times a second: it reads pose and buttons and writes the
// newest force (relay.h), zero too, because gravity is compensated only while forces are sent. The
// device's own watchdog ends the force 10 ms after this thread dies, and another thread of ours
// (supervisor.h) switches it off, too. If the watchdog is refused the user is told. Whatever
// switches the forces off (button, velocity, watchdog, cable) ends them for good. The arm is never
// moved to calibrate it. STYLET_LIBDHD names a library elsewhere. Source: Force Dimension SDK 3.17
// headers and manual.
#pragma once

#include <optional>
#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

// Empty `index`: the default device. Waits up to patience_s for a calibrated device.
Device open_force_dimension(const std::string& index, double patience_s);
// Empty: the library is there. Else one line that says why not.
std::string force_dimension_missing();
// Whether the default device accepts a watchdog: opens it without forces, and closes it. False also
// if the library cannot set one; nullopt: there is no library, or no device that is free.
std::optional<bool> force_dimension_watchdog();

}  // namespace stylet::hal
