// SPDX-License-Identifier: Apache-2.0
// Calls of a vendor's driver, which may hang for ever.
//
// Each call runs in its own thread, and the caller waits for it as long as it likes. A call that is
// given up stays where it hangs until the process ends. So it must own all that it touches, and
// the process must end without destroying what is static: see driver_calls_given_up. Never call
// it in the loop's thread.
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

// Longest time for closing at the end of a run, however the drivers behave: their fade takes 25 ms,
// the vendors' own closing some hundred.
constexpr std::chrono::milliseconds kClosingTime(2000);

int driver_calls_given_up();
void count_given_up();

// Returns or throws what `call` does; nullopt: `give_up`, asked every 5 ms, said so.
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

// Closes all of them at the same time (kMaxNeedles of them, then as many more); returns which still
// hang after `longest`. Before that, none has a force (a run ends with a fade, and a closed relay
// lets no force through). Without memory for threads it closes them one after the other.
std::vector<std::size_t> close_devices(std::span<const Device> devices,
                                       std::chrono::milliseconds longest = kClosingTime);

}  // namespace stylet::hal
