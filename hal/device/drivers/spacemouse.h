// SPDX-License-Identifier: Apache-2.0
// 3Dconnexion SpaceMouse through the socket of spacenavd: a position without force, for users who
// have no haptic device.
//
// Deflection gives speed: 50 mm/s and 1 rad/s at full deflection. It is held for at most 50 ms, as
// the daemon says nothing while the cap rests. The socket is SPNAV_SOCKET, or that of /etc/spnavrc,
// or /var/run/spnav.sock. Source: the protocol of libspnav 1.0, in both its versions.
#pragma once

#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

// The URI has no options: `rest` must be empty.
Device open_spacemouse(const std::string& rest, double patience_s);
std::string spacenavd_socket();

}  // namespace stylet::hal
