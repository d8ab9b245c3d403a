// SPDX-License-Identifier: Apache-2.0
// Opens and closes devices so that neither a stop signal nor a hanging driver holds up the
// program.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "hal/app/stop_signal.h"
#include "hal/device/devices.h"
#include "hal/device/driver_call.h"

namespace stylet::app {

using Opener = hal::Device (*)(const std::string& uri, double patience_s);
constexpr double kOpeningPatienceS = 10;
constexpr double kHangsS = 60;  // opening waits 10 s for a device; no driver needs a minute

// Called before the first force: tells what is missing that should be there.
inline void tell_of_opened(const std::string& uri, const hal::Device& device) {
  const std::string note = hal::note_of(device);
  if (!note.empty()) fmt::print(stderr, "stylet: {}: {}\n", uri, note);
  const int error = hal::device_priority_refused();
  if (error == 0) return;
  fmt::print(stderr,
             "stylet: {}: SCHED_FIFO priority {} of its thread was refused ({}): its samples and "
             "forces may come late; stylet doctor says what to do\n",
             uri, hal::kDevicePriority, std::strerror(error));
}

// Throws hal::DeviceError, also when a signal asks to stop: the driver then has as long as for
// closing.
inline hal::Device open_or_stop(const std::string& uri, Opener open) {
  using Clock = std::chrono::steady_clock;
  hal::stop_opening_when(stop_was_asked);
  const Clock::time_point start = Clock::now();
  Clock::time_point stopped = {};
  const auto give_up = [&] {
    const Clock::time_point now = Clock::now();
    if (stop_was_asked() && stopped == Clock::time_point{}) stopped = now;
    const bool late = stopped != Clock::time_point{} && now - stopped > hal::kClosingTime;
    return late || now - start > std::chrono::duration<double>(kHangsS);
  };
  try {
    const auto device = hal::call_driver<hal::Device>(
        [uri, open] { return open(uri, kOpeningPatienceS); }, give_up);
    if (device) {
      tell_of_opened(uri, *device);
      return *device;
    }
  } catch (const hal::DeviceError&) {
    if (!stop_was_asked()) throw;
    throw hal::DeviceError(fmt::format("{}: stopped before it was open", uri));
  }
  throw hal::DeviceError(fmt::format(
      "{}: its driver hangs in the call that opens it: switch the device off and on again", uri));
}

// Closes devices, and says whose driver hangs; `uri` gives the URI of each.
inline void close_or_leave(std::span<const hal::Device> devices,
                           const std::function<std::string(std::size_t)>& uri) {
  for (const std::size_t i : hal::close_devices(devices)) {
    fmt::print(
        stderr,
        "stylet: {}: its driver hangs in the call that closes it, after zero force was ordered: "
        "switch the device off\n",
        uri(i));
  }
}

// A device that is open as long as this lives.
struct Opened {
  Opened(std::string uri_in, Opener open)
      : uri(std::move(uri_in)), device(open_or_stop(uri, open)) {}
  ~Opened() {
    close_or_leave(std::span(&device, 1), [this](std::size_t) { return uri; });
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  const std::string uri;
  const hal::Device device;
};

}  // namespace stylet::app
