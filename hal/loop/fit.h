// SPDX-License-Identifier: Apache-2.0
// Fits guard and coupling to the device that was opened: of what is configured and what the device
// says of itself, or is known of its model, the stricter counts.
// Units: SI. Frame: none.
#pragma once

#include "hal/device/device.h"
#include "hal/guard/guard.h"
#include "hal/loop/coupling.h"
#include "hal/loop/grip.h"

namespace stylet::hal {

// Fractions of what the device renders: the controller's damping, and the amplitude of buzzing.
constexpr double kPassivityFraction = 0.5, kBuzzFraction = 0.1;

// The stiffest coupling at the needle with which the device feels no more than `limit_n_per_m`.
float most_coupling(float limit_n_per_m, const GripConfig& grip);

// A device without force keeps what is configured, except the time between its samples.
void fit_to_device(const DeviceInfo& info, const GripConfig& grip, GuardConfig& guard,
                   CouplingConfig& coupling);

}  // namespace stylet::hal
