// SPDX-License-Identifier: Apache-2.0
// The second station: the device is here, its needle in the tissue of another machine. It sends
// what the device measures, and renders the newest local model of the force that comes back.
//
// Whatever the network does, the force on the hand ends when the model's life is over: kForceLifeNs
// after the sample it answers, on this machine's clock. The force fades in the second half of that
// life, which the guard's slew must allow, and fades in again from zero when models with a newer
// arming number come (packet.h). The samples tell what force the hand has, and that it has ended.
// The station's own guard stands between model and hand. If it latches a fault, the station sends
// no samples until that is acknowledged; its silence tells the other machine. Promises: one tick
// allocates nothing, takes no lock, and never waits. Units: SI. Frame: the device's.
#pragma once

#include <cstdint>

#include "hal/device/device.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"
#include "hal/guard/guard.h"

namespace stylet::hal {

struct StationConfig {
  GuardConfig guard;
  float max_torque_nm = 0;
  RenderLimits limits;  // sent to the other machine, whose guard and coupling keep to them
};
// Made from what the device says of itself.
StationConfig station_config(const DeviceInfo& info);

struct StationState {
  GuardState guard = guard_start();
  GuardState torque_guard = guard_start();
  Sample sample = {};
  SamplePacket sent;
  ObeyedForce obeyed;
  Vec3 force_n = {};          // on the hand
  Vec3 torque_nm = {};        // likewise
  std::int64_t fade_ns = 0;   // since models began to come again
  std::uint64_t models = 0;   // how many were accepted
  std::uint64_t refused = 0;  // damaged, or not to be obeyed
  std::uint64_t starved = 0;  // ticks without a living model
};

// `session`: a new number each time a station is started.
StationState station_start(std::uint32_t session);
void station_tick(const StationConfig& config, StationState& state, const Device& device,
                  const Link& link, std::int64_t now_ns);
// Replaces station_tick at the end of a run: true once no force is left.
bool station_end(const StationConfig& config, StationState& state, const Device& device,
                 std::int64_t now_ns);

}  // namespace stylet::hal
