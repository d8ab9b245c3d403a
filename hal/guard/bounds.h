// SPDX-License-Identifier: Apache-2.0
// The limits of what a scene or a caller of the C interface may configure of a guard and of the
// device behind it. A value outside is refused, with its field and these numbers. Units: SI.
#pragma once

namespace stylet::hal {

struct Bounds {
  double least, most;
};

constexpr Bounds kForceBoundsN = {0.01, 100};  // also of the continuous force
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
// A limit that is computed as a quotient or a product may be passed by this fraction, for its
// rounding.
constexpr double kRoundingFraction = 1e-5;

}  // namespace stylet::hal
