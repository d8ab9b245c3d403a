// SPDX-License-Identifier: Apache-2.0
// A connection to the server: HTTP until it becomes a page's WebSocket.
// Promise: used by the server's thread alone; it ends by itself.
#pragma once

#include "hal/console/server_state.h"

namespace stylet::console {

void serve_visit(tcp::socket&& socket, Server::Impl& server);

}  // namespace stylet::console
