// SPDX-License-Identifier: Apache-2.0
// What a test sees and sets of the stand-in for a vendor's library: where the hand is, what the
// motors do, and what goes wrong. Units and frame are the vendor's. A stand-in exports its
// functions under the vendor's names, and standin(i) for its i-th device.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace stylet::test {

enum class Trouble : int {
  kNone,
  kNoDevice,      // opening fails
  kInUse,         // another program has it
  kUncalibrated,  // until a test says otherwise
  kSilent,        // the vendor's thread stops, or calls return no data; motors go on
  kNoAnswer,      // every call fails
  kHarmless,      // a warning each tick: warm motors, saturation
  kForcesOff,     // switched off by its own button
  kStopsSending,  // for a service: connected, but silent
};

// The vendor's call that does not return until a test says so.
enum class Hang : int { kNone, kOpen, kRead, kWrite, kClose };

struct StandIn {
  std::atomic<double> position[3];
  std::atomic<double> rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row
  std::atomic<unsigned> buttons;
  std::atomic<bool> pinched;     // its gripper is closed
  std::atomic<double> force[3];  // of the motors, now
  std::atomic<double> torque[3];
  std::atomic<Trouble> trouble;
  std::atomic<int> forbidden;  // calls that the vendor's manual forbids
  std::atomic<int> updates;    // of the calibration
  std::atomic<int> ticks;
  std::atomic<int> writes;          // of a force to the motors
  std::atomic<int> late_ms;         // the next tick of the vendor's thread is so late
  std::atomic<bool> mute;           // reports nothing of what it can do
  std::atomic<double> hand_kg;      // more than 0: a mass that the motors move; 0: fixed
  std::atomic<double> velocity[3];  // of that mass, m/s
  std::atomic<Hang> hangs;
  std::atomic<bool> refuses_watchdog;
  // What the device says of itself; null or 0: the stand-in's default.
  std::atomic<const char*> model, serial;
  std::atomic<int> type;
  std::atomic<double> most_force_n, most_stiffness_n_per_mm, always_n;
};

// Moves the mass for `seconds` under the motors' force, the weight that gravity compensation
// leaves, and the hand's damping. `metre`: in the vendor's unit; `up`: the vendor's vertical axis.
inline void move_hand(StandIn& unit, double seconds, double metre, int up, double weight_fraction) {
  const double mass = unit.hand_kg.load();
  for (int i = 0; mass > 0 && i < 3; ++i) {
    const double weight = i == up ? -9.81 * weight_fraction * mass : 0;
    unit.velocity[i] =
        unit.velocity[i] + (unit.force[i] + weight - 5 * unit.velocity[i]) / mass * seconds;
    unit.position[i] = unit.position[i] + metre * unit.velocity[i] * seconds;
  }
}

// Does not return from that call until a test says so.
inline void hang_in(Hang call, const StandIn& unit) {
  while (unit.hangs.load() == call) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

using StandInOf = StandIn* (*)(int index);

}  // namespace stylet::test
