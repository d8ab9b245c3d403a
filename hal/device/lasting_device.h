// SPDX-License-Identifier: Apache-2.0
// A device that is opened again when it has failed for good, as when a cable was pulled or a
// service was restarted.
//
// While it is away it does not answer, so the guard latches a fault. When it is back it gives
// samples, but no force until somebody acknowledges. Another device is refused, and so is one that
// renders less than the first did, because the guard's limits are made for the first.
// Promises: read and write are wait-free and allocate nothing; opening, closing and waiting happen
// in a thread of its own. The first try comes kFirstTryS after the failure; the wait then doubles
// each time, up to kLongestTryS. Sample numbers keep growing through all of it.
#pragma once

#include <functional>
#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr double kFirstTryS = 0.25;
constexpr double kLongestTryS = 4;

struct Reopening {
  std::function<Device()> open;  // throws DeviceError
  bool (*may_open)() = nullptr;  // false: opening or closing now would disturb another one
  double first_try_s = kFirstTryS;
  double longest_try_s = kLongestTryS;
  // Left out at the beginning of an error of `open`: who tells it says which device.
  std::string uri = {};
};
// Takes over `first`, which is open.
Device lasting_device(const Device& first, const Reopening& reopening);

}  // namespace stylet::hal
