// SPDX-License-Identifier: Apache-2.0
// Signals that end a program from outside (Ctrl-C, SIGTERM, SIGHUP, SIGQUIT) end the run after a
// tick, so that no device keeps a force and the recording is completed. Install it before the first
// device is opened. A vanished reader (SIGPIPE) or a file that may not grow (SIGXFSZ) ends nothing,
// and a reader that reads no more does not hold up the end.
#pragma once

#include <signal.h>

#include <array>
#include <atomic>

#include "hal/app/standard_streams.h"

namespace stylet::app {

inline std::atomic<std::atomic<bool>*> g_stop{nullptr};
inline std::atomic<int> g_stops_asked{0};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);

// The third signal ends the program at once, so a hanging driver cannot hold it.
constexpr int kStopsThatEndAtOnce = 3;
constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

inline void on_signal(int number) {
  if (std::atomic<bool>* stop = g_stop.load(); stop != nullptr) stop->store(true);
  if (g_stops_asked.fetch_add(1) + 1 < kStopsThatEndAtOnce) return;
  signal(number, SIG_DFL);
  raise(number);
}

inline bool stop_was_asked() {
  return g_stops_asked.load() > 0;
}

struct StopOnSignal {
  explicit StopOnSignal(std::atomic<bool>& stop) {
    bound_standard_streams();
    g_stops_asked.store(0);
    g_stop.store(&stop);
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (const int number : kStopSignals) sigaction(number, &action, nullptr);
    action.sa_handler = SIG_IGN;
    for (const int number : {SIGPIPE, SIGXFSZ}) sigaction(number, &action, nullptr);
  }
  ~StopOnSignal() { g_stop.store(nullptr); }
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

}  // namespace stylet::app
