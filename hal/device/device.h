// SPDX-License-Identifier: Apache-2.0
// A haptic device as the loop sees it: functions and a pointer.
//
// A device must promise: read and write return at once, allocate nothing, take no lock and may be
// called from one real-time thread; open (each device's own function) and close may do anything.
// Units: SI. Frame: x right, y up, z toward the operator; the scene maps it to the world.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "hal/device/model.h"
#include "hal/device/motor.h"
#include "stylet/units.h"

namespace stylet::hal {

// One measurement. `seq` grows by one with each, so that repeated and lost ones are noticed.
struct Sample {
  std::uint64_t seq;
  std::int64_t t_ns;      // when it was taken, on the loop's clock
  Pose pose;              // of the handle
  std::uint32_t buttons;  // bit i: button i is pressed
  float plunger_n = 0;    // on a syringe's plunger, of a device that has one
};

struct Command {
  Vec3 force_n;             // on the operator's hand
  Vec3 tip_m = {};          // position of the needle's tip, for a device that steers it
  Vec3 tip_direction = {};  // unit length; zero: not known yet
  Vec3 torque_nm = {};      // on the operator's hand, for a device that renders it
  // For a device that renders faster than commands come: place_m is the place of the newest usable
  // sample, for which the force was computed. As the device moves away from it, the hand's force
  // falls by stiffness_n_per_m newtons a metre, and never exceeds max_force_n.
  Vec3 place_m = {};
  float stiffness_n_per_m = 0;
  float max_force_n = 0;
  std::uint32_t arming = 0;  // grows each time the guard begins anew, see motor.h
  bool falls = false;        // the guard is taking force away: it must not grow
  std::int64_t end_ns = 0;   // the force must be gone by then, CLOCK_MONOTONIC; 0: it only ages
};

struct DeviceInfo {
  const char* name;
  float max_force_n;
  float max_slew_n_per_s;
  float max_stiffness_n_per_m = 0;  // that it renders without buzzing; 0: unknown
  float max_torque_nm = 0;          // 0: it renders none
  float continuous_force_n = 0;     // that its motors bear for ever; 0: unknown
  // So long after the sample that it answers (not after it was sent) a force ends by itself, in the
  // device; 0: it does not.
  float force_life_s = 0;
  // Serial number or id, which tells it apart from others of its kind; empty: it does not say.
  const char* identity = "";
  const DeviceModel* model = nullptr;  // the model it was recognised as; null: unknown
  // Its samples say when they were taken, so that one that was held up on its way counts as old.
  // False: they count as taken when its driver gets them.
  bool sends_times = false;
};

// How long the guard may go without a sample: `otherwise_s` for most devices. A device whose forces
// end by themselves can have a longer watchdog, because a packet may be lost. For a life of 20 ms
// these are the 15 ms of GUARD.md, S4.
inline float watchdog_of(const DeviceInfo& info, float otherwise_s) {
  constexpr float kLifeFraction = 0.75F;
  return std::max(otherwise_s, kLifeFraction * info.force_life_s);
}

// A device that has shown nothing new for so long does not answer: less than the usual watchdog of
// 3 ms, so that the guard calls it silent whichever tick is the last; more than the 2.2 ms between
// two samples of the slowest device.
constexpr std::int64_t kQuietNs = 2'500'000;

// What became of the packets of a device that sends them, since it was opened.
struct PacketCount {
  std::uint64_t came = 0;      // each newer than all before it
  std::uint64_t late = 0;      // after a newer one, or twice: not used
  std::uint64_t lost = 0;      // gaps in their numbers, less those that came late
  std::uint64_t useless = 0;   // with a wrong length, checksum or version
  bool forces_arrive = false;  // the device has shown that a packet of ours reached it
};

struct Device {
  void* self = nullptr;
  DeviceInfo info = {};
  // False: no answer this time, and `sample_out` is untouched. `now_ns` is the time of this tick: a
  // device without a clock of its own uses it as the time of its sample.
  bool (*read)(void* self, std::int64_t now_ns, Sample& sample_out) = nullptr;
  void (*write)(void* self, const Command& command) = nullptr;
  void (*close)(void* self) = nullptr;  // leaves the device without force
  // Any thread but the loop's, before close: why it no longer answers; empty: no trouble.
  std::string (*trouble)(void* self) = nullptr;
  // Likewise: what is special about it and worth knowing.
  std::string (*about)(void* self) = nullptr;
  // The loop's thread: what force the motors have. False, or null: the device does not tell.
  bool (*motor)(void* self, MotorReport& report_out) = nullptr;
  // Any thread but the loop's, before close: what its user should know now, such as a watchdog that
  // is missing or a clock that was set; empty: nothing. The device works all the same.
  std::string (*note)(void* self) = nullptr;
  // The loop's thread: what became of its packets. Null: it sends none, or none can be lost.
  PacketCount (*packets)(void* self) = nullptr;
};

inline std::string trouble_of(const Device& device) {
  return device.trouble != nullptr ? device.trouble(device.self) : "";
}

inline std::string note_of(const Device& device) {
  return device.note != nullptr ? device.note(device.self) : "";
}

}  // namespace stylet::hal
