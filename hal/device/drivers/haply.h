// SPDX-License-Identifier: Apache-2.0
// Haply Inverse3 through the vendor's local service: three forces, and with a VerseGrip also
// rotation and buttons.
//
// The service sends one state for each message it gets. A thread of ours sends the newest force
// (relay.h) 2000 times a second, then a ping, and takes the newest state once the pong has come,
// which RFC 6455 (5.5.2) obliges the service to send. So at most one of our messages is on its way
// to the service, whatever it sends unasked. A service that first reads and then answers, in one
// loop, has no older force to render; what one with a queue of its own keeps behind its pongs
// is not known here. If an answer or pong does not come in 20 ms the connection is closed: as far
// as is known, this ends the force. The service filters forces (damping, gate, scale), so what is
// rendered can differ from what was sent. Device and grip are bound by their ids for as long as
// they are open: whatever the order of lists, no other is read, moved or armed, and no two needles
// of this program share one. Source: docs.haply.co, service 3.5.
#pragma once

#include <span>
#include <string>

#include "hal/device/device.h"
#include "hal/device/driver.h"

namespace stylet::hal {

// `rest`: "", "ID", "@ADDRESS:PORT" or "ID@ADDRESS:PORT", then wishes. Defaults: the first device
// that no needle here holds, its only grip, and 127.0.0.1:10001.
Device open_haply(const std::string& rest, double patience_s);
// All drivers, including this one: for use_drivers (devices.h).
std::span<const DriverDescriptor* const> drivers_with_haply();
// The text that opens the same device and grip again: `rest` with the identity that was opened.
std::string same_haply(const std::string& rest, const std::string& identity);

}  // namespace stylet::hal
