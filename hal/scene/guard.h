// SPDX-License-Identifier: Apache-2.0
// The parts of a scene that keep the hand safe: what the device can do, and the guard's limits.
#pragma once

#include "hal/scene/section.h"

namespace stylet::hal {

// The keys of [device] that say what it can do and how it moves; for missing keys those of `model`.
// The caller must end with device.finish().
DeviceModel read_device_model(Section& device, float period_s);
// `device` is for messages: its keys may make a limit impossible.
GuardConfig read_guard(Section guard, const Section& device, const DeviceModel& model,
                       float period_s);
CouplingConfig read_coupling(Section coupling, const DeviceModel& model, const GuardConfig& guard,
                             const GripConfig& grip);

}  // namespace stylet::hal
