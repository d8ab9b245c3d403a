// SPDX-License-Identifier: Apache-2.0
// Haply Inverse3 through the vendor's local service: three forces, and with a VerseGrip rotation
// and buttons.
//
// The service gives one state for each message it gets. A thread of ours sends the newest force
// (relay.h) 2000 times a second, a ping behind it, and takes the newest state once the pong has
// come, which RFC 6455 (5.5.2) obliges the service to give: so no more than one of our messages is
// on its way to it, whatever it says unasked. A service that first reads and then answers, as one
// loop does, has no older force to render; what one with a queue of its own holds back behind its
// pongs is not known here. An answer or a pong that does not come in 20 ms ends the connection, and
// with it, as far as is known, the force. The service filters forces (damping, gate, scale): what
// is rendered need not be what was sent. Device and grip are bound by their ids for as long as it
// is open: whatever is listed in whichever order, no other one is read, moved or armed, and no two
// needles of this program share one. Source: docs.haply.co, service 3.5.
#pragma once

#include <span>
#include <string>

#include "hal/device/device.h"
#include "hal/device/driver.h"

namespace stylet::hal {

// "", "ID", "@ADDRESS:PORT" or "ID@ADDRESS:PORT", and then wishes; the first device that nothing
// here holds, its only grip, and 127.0.0.1:10001.
Device open_haply(const std::string& rest, double patience_s);
// All drivers, this one too: for use_drivers (devices.h).
std::span<const DriverDescriptor* const> drivers_with_haply();
// What opens the same device and grip again: `rest` with the identity that was opened.
std::string same_haply(const std::string& rest, const std::string& identity);

}  // namespace stylet::hal
