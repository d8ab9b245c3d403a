// SPDX-License-Identifier: Apache-2.0
// The console's server (server.h) in a process beside the loop's.
//
// The loop publishes into a Display, which lies in shared memory; rows and counters go the same
// way. Stages, activities and scores go as messages. What the page asks for comes back as messages,
// which are checked here. If this process ends, hangs or sends nonsense, the page is gone and the
// attempt goes on without it. Promises: those of SideProcess. Whatever this process sends, `next`
// gives an order within its bounds or nothing. No function waits for it longer than kShowPatienceS.
// All but `tell` are to be called from one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "hal/base/channel.h"
#include "hal/base/side_process.h"
#include "hal/console/server.h"
#include "hal/publish/metrics.h"

namespace stylet::console {

constexpr const char* kConsoleRole = "console";
// Longest wait for room in the socket, which holds some hundred messages; then the console's
// process is killed.
constexpr double kShowPatienceS = 0.5;

struct PointerLeft {};
using Wish = std::variant<Order, PointerMoved, PointerLeft>;
hal::Bytes wish_message(const Wish& wish);
// Checks a message: any bytes give an order within its bounds, or hal::PackingError.
Wish wish_of(std::span<const std::byte> message);

class ConsoleProcess {
 public:
  // Throws hal::SideError, with the server's own words if it cannot listen.
  explicit ConsoleProcess(const ServerConfig& config);

  const std::string& url() const { return url_; }
  void show(const SceneView& view);  // copies all but its display
  void show(Activity activity);
  void show(const ScoredAttempt& attempt);
  void refuse(const std::string& what);  // told to the page in control
  // The counters' page shows the newest numbers.
  void publish(const hal::MetricNumbers& numbers);
  // To be called by any one thread. False: the ring is full, and the row is lost.
  bool tell(const Told& told) { return told_.push(told); }

  // What a page asks for.
  std::optional<Wish> next(double patience_s);
  // Whether it has given a sign of life in the last `seconds`. A sign counts from the call that
  // finds it, so call this more often than that.
  bool alive_within(double seconds);
  hal::SideProcess& process() { return process_; }

 private:
  using Clock = std::chrono::steady_clock;
  void send(const hal::Packer& message, std::span<const int> descriptors = {});

  hal::SideProcess process_;
  hal::SharedLatest<hal::MetricNumbers> numbers_;
  hal::Ring<Told> told_;
  std::string url_;
  std::uint64_t beats_ = 0;
  Clock::time_point beat_ = Clock::now();
};

// What the console's process does.
void console_beside(hal::SideSeat& seat);

}  // namespace stylet::console
