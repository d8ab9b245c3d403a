// SPDX-License-Identifier: Apache-2.0
// The OpenIGTLink server (igtl.h) in a process beside the loop's.
//
// The loop leaves the newest tick in shared memory and knows nothing else of this process. If it
// ends, the run goes on without it.
#pragma once

#include <cstdint>

#include "hal/base/channel.h"
#include "hal/base/side_process.h"
#include "hal/publish/igtl.h"

namespace stylet::hal {

constexpr const char* kIgtlRole = "igtl";

class IgtlProcess {
 public:
  // Throws SideError, with the server's own words if it cannot listen.
  explicit IgtlProcess(const IgtlConfig& config);

  std::uint16_t port() const { return port_; }
  SharedLatest<NewestTick>& newest() { return newest_; }
  SideProcess& process() { return process_; }

 private:
  SideProcess process_;
  SharedLatest<NewestTick> newest_;
  std::uint16_t port_ = 0;
};

// What that process does.
void igtl_beside(SideSeat& seat);

}  // namespace stylet::hal
