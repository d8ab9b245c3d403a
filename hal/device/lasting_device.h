// SPDX-License-Identifier: Apache-2.0
// A device that is opened again when it has failed for good: a cable that was pulled, a service
// that was restarted.
//
// While it is away it does not answer, so the guard latches its fault; when it is back it gives
// samples, and no force before somebody acknowledges. Another device is not taken, nor one that
// renders less than the first one did: the guard's limits are the first one's.
// Promises: read and write are wait-free and allocate nothing; opening, closing and waiting happen
// in a thread of its own, the first try kFirstTryS after the failure, then after twice as long each
// time, at most kLongestTryS. Samples keep counting up over all of them.
#pragma once

#include <functional>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr double kFirstTryS = 0.25;
constexpr double kLongestTryS = 4;

struct Reopening {
  std::function<Device()> open;  // throws DeviceError
  bool (*may_open)() = nullptr;  // nor close; not now: it would disturb another device
  double first_try_s = kFirstTryS;
  double longest_try_s = kLongestTryS;
};
// Takes `first`, which is open.
Device lasting_device(const Device& first, const Reopening& reopening);

}  // namespace stylet::hal
