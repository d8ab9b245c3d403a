// SPDX-License-Identifier: Apache-2.0
// A needle held by a mouse or a finger on the console's page: a position without force; the page
// draws the force instead.
//
// The page posts poses while the pointer moves, 30 to 120 times a second, at uneven times. While it
// rests, the console says that the page is still there (pointer_stay). The loop gets one
// sample a tick, which follows the poses with kPointerFollowS, critically damped, and never faster
// than kPointerSpeedMPerS and kPointerTurnRadPerS: the needle never leaps when the pointer does.
// All is on the loop's clock: the same posts in the same ticks give the same bits.
//   before the first post      at rest, and answers
//   newest post or stay older than kPointerGoneNs, or pointer_leave
//                              does not answer: the guard latches
//                              "device silent" within its watchdog
//   a post after that          answers again; the needle continues from where it is: only the
//                              pointer's motion from then on counts
//   the loop did not read for kPointerAnewS, as between two attempts: continues likewise
// Half a second of silence is long for a guard, but here no force could push a hand: the needle
// waits where it is.
// Promises: pointer_post and the loop never wait for each other; read and write allocate
// nothing, take no lock and make no system call. Units: SI. Frame: the device's (device.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr double kPointerFollowS = 0.03;    // the device lags behind by twice this time
constexpr double kPointerSpeedMPerS = 0.3;  // a needle is not thrown faster than this
constexpr double kPointerTurnRadPerS = 6;   // one turn takes about a second
constexpr double kPointerReachM = 2;        // a pose farther from the origin is refused
constexpr double kPointerAnewS = 0.1;
constexpr std::int64_t kPointerGoneNs = 500'000'000;

// Any thread but the loop's, for the device "pointer:NUMBER". Position and rotation count from the
// first post. False: NaN, out of reach, not a rotation, or no such number; nothing has changed.
bool pointer_post(std::uint32_t number, const Pose& pose, std::uint32_t buttons);
// Says that every posted pointer is still where it was. Any thread but the loop's.
void pointer_stay();
// Says that the page has gone. Any thread but the loop's.
void pointer_leave(std::uint32_t number);
// Says whether there is a page that can post; without one, opening a pointer is refused.
void pointer_serve(bool served);

// The pointer that a URI asks for: "pointer:" is the first, 0; nullopt: not a pointer, or too high.
std::optional<std::uint32_t> pointer_number(const std::string& uri);

// "pointer:" and "pointer:1" to "pointer:3"; each can be open only once at a time.
Device open_pointer(const std::string& rest, double patience_s);

}  // namespace stylet::hal
