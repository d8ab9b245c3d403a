// SPDX-License-Identifier: Apache-2.0
// Calls of a vendor's driver, which may never return.
//
// Each runs in a thread of its own and is waited for as long as the caller likes. One that is given
// up goes on where it hangs, for as long as the process lives: so it owns all it touches, and the
// process must end without looking back (no destructors of what is static): driver_calls_given_up.
// Never in the loop's thread.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "hal/device/device.h"

namespace stylet::hal {

// The end of a run, however its devices' drivers behave: their fade takes 25 ms, the vendors' own
// goodbyes some hundred.
constexpr std::chrono::milliseconds kClosingTime(2000);

int driver_calls_given_up();
void count_given_up();

// What `call` returns, or throws what it throws; nothing: `give_up`, asked every 5 ms, had enough.
template <typename Result>
std::optional<Result> call_driver(std::function<Result()> call,
                                  const std::function<bool()>& give_up) {
  struct Shared {
    std::atomic<bool> done{false};
    std::optional<Result> result;
    std::exception_ptr failure;
  };
  auto shared = std::make_shared<Shared>();
  std::thread thread([shared, call = std::move(call)] {
    try {
      shared->result = call();
    } catch (...) {
      shared->failure = std::current_exception();
    }
    shared->done.store(true);
  });
  while (!shared->done.load()) {
    if (give_up()) {
      thread.detach();
      count_given_up();
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  thread.join();
  if (shared->failure) std::rethrow_exception(shared->failure);
  return shared->result;
}

// Closes all of them side by side; which of them hang after `longest`. No force was ordered of each
// before (a run ends with a fade, and a relay lets nothing through once it is closed).
std::vector<std::size_t> close_devices(std::span<const Device> devices,
                                       std::chrono::milliseconds longest = kClosingTime);

}  // namespace stylet::hal
