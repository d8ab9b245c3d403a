// SPDX-License-Identifier: Apache-2.0
// The console's server: HTTP and WebSocket, on one thread of the lowest priority.
//
// It takes the newest state from a Display and rows from a Ring, and gives every page what it can
// take: a slow or dead page loses frames and does not affect others. What pages ask of the
// session is passed on as Orders. All bounds are in limits.h. Promise: nothing here is called from
// the loop, and no function waits for a page.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/base/channel.h"
#include "hal/console/gate.h"
#include "hal/console/messages.h"
#include "hal/console/scene_view.h"
#include "hal/record/recording.h"

namespace stylet::console {

struct ConsoleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ServerConfig {
  GateConfig gate;                     // port 0: any free port
  std::vector<int> spared_processors;  // the loop's, if it has its own
};

// For the page of counters.
struct ServerCounters {
  std::size_t connections = 0;    // open now
  std::uint64_t lost_frames = 0;  // of all pages so far
  std::string scene;              // shown now
};

struct ServerEvents {
  // Called on the server's thread; must return at once. The answer is told to the page that asked;
  // it is empty if the order was accepted.
  std::function<std::string(const Order&)> ordered;
  std::function<void(const PointerMoved&)> pointed;
  std::function<void()> pointer_left;  // the page in control has gone
  std::function<std::string(const ServerCounters&)> metrics;
};

class Server {
 public:
  // Starts to listen, or throws ConsoleError.
  Server(const ServerConfig& config, ServerEvents events);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // The page's address, including the token.
  std::string url() const;

  // To be called from any one other thread at a time.
  void show(std::shared_ptr<const SceneView> view);
  void show(Activity activity);
  void refuse(const std::string& what);  // told to the page in control
  // The attempt is the one whose rows were told last, or the recording.
  void show(const ScoredAttempt& attempt);
  // Takes the recorder's rows and events, from one thread. False: the queue is full, and this one
  // is lost.
  bool tell(const Told& told);
  // For a recording, instead of tell(): its whole curve and its marks.
  void show(std::shared_ptr<const Curve> curve, std::span<const hal::Mark> marks);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace stylet::console
