// SPDX-License-Identifier: Apache-2.0
// The tables of a scene that keep the hand safe: [device], [guard] and [coupling].
#pragma once

#include "hal/scene/section.h"

namespace stylet::hal {

// Reads the keys of [device] that say what it can do and how it moves. A missing key has the value
// of the device that the key `model` names. The caller then calls device.finish().
DeviceModel read_device_model(Section& device, float period_s);
// `device` is used only for messages, because a limit may be impossible owing to its keys.
GuardConfig read_guard(Section guard, const Section& device, const DeviceModel& model,
                       float period_s);
CouplingConfig read_coupling(Section coupling, const DeviceModel& model, const GuardConfig& guard,
                             const GripConfig& grip);

}  // namespace stylet::hal
