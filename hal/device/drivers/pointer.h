// SPDX-License-Identifier: Apache-2.0
// A needle held by a mouse or a finger on the console's page: places without force, which the page
// draws instead.
//
// The page posts poses while the pointer moves, 30 to 120 times a second and never evenly; while it
// rests, the console says that the page is still there (pointer_stay). The loop gets one sample a
// tick that follows them with kPointerFollowS, critically damped, and never faster than
// kPointerSpeedMPerS and kPointerTurnRadPerS: no leap of the pointer is one of the needle. All on
// the loop's clock: the same posts in the same ticks give the same bits.
//   before the first post      at rest, and answers
//   newest post or stay is older than kPointerGoneNs, or pointer_leave   does not answer: the guard
//   latches
//                              "device silent" within its watchdog
//   a post after that          answers again, and the needle is taken up where it is: only the
//                              pointer's way from there on counts
//   the loop has not asked for kPointerAnewS, as between two attempts   taken up anew, too
// Half a second of silence is long for a guard, but there is no force that could push a hand: the
// needle waits where it is.
// Promises: pointer_post never waits for the loop nor the loop for it; read and write allocate
// nothing, take no lock and make no system call. Units: SI. Frame: the device's (device.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/device/device.h"

namespace stylet::hal {

constexpr double kPointerFollowS = 0.03;    // its place lags behind by twice that
constexpr double kPointerSpeedMPerS = 0.3;  // a needle is not thrown
constexpr double kPointerTurnRadPerS = 6;   // a turn in a second
constexpr double kPointerReachM = 2;        // farther from the origin: no pose of a page
constexpr double kPointerAnewS = 0.1;
constexpr std::int64_t kPointerGoneNs = 500'000'000;

// Any thread but the loop's, for the device "pointer:NUMBER". Place and rotation count from the
// first post on. False: NaN, out of reach, not a rotation, or no such number; nothing was changed.
bool pointer_post(std::uint32_t number, const Pose& pose, std::uint32_t buttons);
// Every pointer that was posted still is where it was. Any thread but the loop's.
void pointer_stay();
// The page has gone. Any thread but the loop's.
void pointer_leave(std::uint32_t number);
// Whether there is a page to post at all; opening a pointer is refused where there is none.
void pointer_serve(bool served);

// Which one a URI asks for: "pointer:" is the first, 0; none if it is no pointer's, or too many.
std::optional<std::uint32_t> pointer_number(const std::string& uri);

// "pointer:" and "pointer:1" to "pointer:3", each opened once at a time.
Device open_pointer(const std::string& rest, double patience_s);

}  // namespace stylet::hal
