// SPDX-License-Identifier: Apache-2.0
// A haptic device, as the loop sees it: four functions and a pointer.
//
// Promises asked of a device: read and write return at once, allocate nothing, take no lock and may
// be called from one real-time thread; open (each device's own function) and close may do anything.
// Units: SI. Frame: x right, y up, z toward the operator; the scene maps it to the world.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "hal/device/model.h"
#include "hal/device/motor.h"
#include "stylet/units.h"

namespace stylet::hal {

// One measurement. `seq` grows by one with every new measurement, so that a repeat and a loss show.
struct Sample {
  std::uint64_t seq;
  std::int64_t t_ns;      // when it was taken, on the loop's clock
  Pose pose;              // of the handle
  std::uint32_t buttons;  // bit i: button i is pressed
};

struct Command {
  Vec3 force_n;             // on the operator's hand
  Vec3 tip_m = {};          // where the needle's tip is, for a device that steers it
  Vec3 tip_direction = {};  // unit length; zero: not known yet
  Vec3 torque_nm = {};      // on the operator's hand, for a device that renders it
  // For a device that answers faster than it is asked: as it moves away from the place the force
  // was computed for, that of the newest usable sample, the force on the hand falls by so much a
  // metre, and stays this small.
  Vec3 place_m = {};
  float stiffness_n_per_m = 0;
  float max_force_n = 0;
  std::uint32_t arming = 0;  // grows each time the guard begins anew, see motor.h
  bool falls = false;        // the guard lets go: what there is must not grow
  std::int64_t end_ns = 0;   // nothing of it is left by then, CLOCK_MONOTONIC; 0: it ages only
};

struct DeviceInfo {
  const char* name;
  float max_force_n;
  float max_slew_n_per_s;
  float max_stiffness_n_per_m = 0;  // that it renders without buzzing; 0: not known
  float max_torque_nm = 0;          // 0: it renders none
  float continuous_force_n = 0;     // what its motors stand for ever; 0: not known
  float force_life_s = 0;           // a force not renewed ends of itself after this; 0: it does not
  const char* identity = "";  // tells it apart from others of its kind; empty: it does not say
  const DeviceModel* model = nullptr;  // what it was recognised as; null: nothing known
};

// How long its guard may go without a sample, which is `otherwise_s` for most. A device whose
// forces end of themselves needs no watchdog as short as others: a packet may be lost.
inline float watchdog_of(const DeviceInfo& info, float otherwise_s) {
  constexpr float kLifeShare = 0.75F;
  return std::max(otherwise_s, kLifeShare * info.force_life_s);
}

struct Device {
  void* self = nullptr;
  DeviceInfo info = {};
  // False: no answer this time; `sample_out` is untouched. `now_ns` is the time of this tick: a
  // device without a clock of its own uses it as the time of its sample.
  bool (*read)(void* self, std::int64_t now_ns, Sample& sample_out) = nullptr;
  void (*write)(void* self, const Command& command) = nullptr;
  void (*close)(void* self) = nullptr;  // leaves the device without force
  // Any thread but the loop's, before close: why it does not answer any more; empty: no trouble.
  std::string (*trouble)(void* self) = nullptr;
  // Likewise: what is particular to it and worth knowing.
  std::string (*about)(void* self) = nullptr;
  // The loop's thread: what the motors have. False, or none: the device does not tell.
  bool (*motor)(void* self, MotorReport& report_out) = nullptr;
  // Any thread but the loop's, before close: what whoever holds it should know of it now, a net
  // that is missing or a clock that was set; empty: nothing. It goes on all the same.
  std::string (*note)(void* self) = nullptr;
};

inline std::string trouble_of(const Device& device) {
  return device.trouble != nullptr ? device.trouble(device.self) : "";
}

inline std::string note_of(const Device& device) {
  return device.note != nullptr ? device.note(device.self) : "";
}

}  // namespace stylet::hal
