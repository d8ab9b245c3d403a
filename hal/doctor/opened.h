// SPDX-License-Identifier: Apache-2.0
// Judges a device that was opened and watched without force (probe.h): whether its samples come as
// the guard needs them. For a device in a network that is all that can be known of the way to it.
// Promises: only judges; a machine that was late itself is no fault of the device, and then what
// cannot be told is kUnknown. May allocate; never called from the loop. The limits are the guard's.
#pragma once

#include <string>
#include <vector>

#include "hal/device/device.h"
#include "hal/doctor/doctor.h"
#include "hal/doctor/probe.h"

namespace stylet::hal {

// `device` is still open.
std::vector<Finding> judge_opened(const std::string& uri, const Device& device,
                                  const DeviceProbe& probe);
// A device that could not be opened; `why` is the text of its DeviceError.
Finding judge_refused(const std::string& uri, const std::string& why);

}  // namespace stylet::hal
