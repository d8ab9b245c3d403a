// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM end what runs after a tick, so that a device keeps no force and a recording is
// completed.
#pragma once

#include <signal.h>

#include <atomic>

namespace stylet::app {

inline std::atomic<std::atomic<bool>*> g_stop{nullptr};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);

inline void on_signal(int /*number*/) {
  if (std::atomic<bool>* stop = g_stop.load(); stop != nullptr) stop->store(true);
}

struct StopOnSignal {
  explicit StopOnSignal(std::atomic<bool>& stop) {
    g_stop.store(&stop);
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }
  ~StopOnSignal() { g_stop.store(nullptr); }
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

}  // namespace stylet::app
