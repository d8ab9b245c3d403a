// SPDX-License-Identifier: Apache-2.0
// Where the console listens, and with which token, from the command line.
#pragma once

#include "hal/app/commands.h"
#include "hal/console/server.h"

namespace stylet::app {

inline console::ServerConfig server_config(const ServeOptions& options) {
  console::ServerConfig config;
  config.gate.port = options.port;
  if (!options.listen.empty()) {
    config.gate.address = options.listen;
    config.gate.token = console::new_token();
  }
  return config;
}

}  // namespace stylet::app
