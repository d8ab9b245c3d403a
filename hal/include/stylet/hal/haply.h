// SPDX-License-Identifier: Apache-2.0
// Haply Inverse3 through the vendor's local service: three forces, and with a VerseGrip rotation
// and buttons.
//
// The service gives one state for each message it gets. A thread of ours sends the newest force
// (relay.h) 2000 times a second and takes the state; an answer that does not come in 20 ms ends the
// connection, and with it, as far as is known, the force. The service filters forces (damping,
// gate, scale): what is rendered need not be what was sent. Source: docs.haply.co, service 3.5.
#pragma once

#include <string>

#include "stylet/hal/device.h"

namespace stylet::hal {

// "", "ID", "@ADDRESS:PORT" or "ID@ADDRESS:PORT"; the first device, and 127.0.0.1:10001.
Device open_haply(const std::string& rest, double patience_s);

}  // namespace stylet::hal
