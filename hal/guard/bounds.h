// SPDX-License-Identifier: Apache-2.0
// What may be configured of a guard and of the device behind it, by a scene or through the C
// interface. Beyond: refused with the field, its value and these numbers. Units SI.
#pragma once

namespace stylet::hal {

struct Bounds {
  double least, most;
};

constexpr Bounds kForceBoundsN = {0.01, 100};  // continuous, too
constexpr Bounds kSlewBoundsNPerS = {1, 1e6};
constexpr Bounds kRampBoundsS = {0, 10};
constexpr Bounds kWatchdogBoundsS = {1e-3, 5e-3};
constexpr Bounds kSpeedBoundsMPerS = {0.01, 20};
constexpr Bounds kBuzzBoundsN = {0.001, 100};
constexpr Bounds kThermalBoundsS = {1, 3600};
constexpr Bounds kButtonBounds = {0, 31};
constexpr Bounds kDeviceMassBoundsKg = {0, 10};
constexpr Bounds kDampingBoundsNSPerM = {0, 1000};  // of the device, or added by the guard
constexpr Bounds kDeviceFrictionBoundsN = {0, 10};
constexpr Bounds kResolutionBoundsM = {0, 1e-3};
constexpr Bounds kStiffnessBoundsNPerM = {1, 1e6};  // of the device; 0: unknown
constexpr Bounds kStoredEnergyBoundsJ = {0, 1000};
constexpr Bounds kTorqueBoundsNm = {0, 100};
// Share by which a limit that is a quotient or a product may be passed for its rounding.
constexpr double kRoundingShare = 1e-5;

}  // namespace stylet::hal
