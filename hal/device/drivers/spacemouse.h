// SPDX-License-Identifier: Apache-2.0
// 3Dconnexion SpaceMouse through the socket of spacenavd: places without force, for those who have
// no haptic device.
//
// Deflection is speed: 50 mm/s and 1 rad/s at full deflection, held for 50 ms at most, for the
// daemon says nothing while the cap rests. The socket is SPNAV_SOCKET, or that of /etc/spnavrc, or
// /var/run/spnav.sock. Source: the protocol of libspnav 1.0, both its versions.
#pragma once

#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

// Nothing to say in the URI: `rest` must be empty.
Device open_spacemouse(const std::string& rest, double patience_s);
std::string spacenavd_socket();

}  // namespace stylet::hal
