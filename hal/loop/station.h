// SPDX-License-Identifier: Apache-2.0
// The second station: a device here, its needle in the tissue of another machine. Sends what the
// device measures, and renders the newest local model of the force that comes back.
//
// Whatever the network does, the force on the hand ends when the model's life is over
// (kForceLifeNs after the sample it answers, on this machine's clock; it fades from half of it on,
// which the guard's slew must allow), and fades in again from zero when models of a newer arming
// come (packet.h). The samples tell what the hand has, and that it ended. The station's own guard
// is between model and hand; a fault of it is latched, and told by silence: no sample is sent
// before it is acknowledged. Promises: one tick allocates nothing, takes no lock, and waits for
// nothing. Units: SI. Frame: the device's.
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
  RenderLimits limits;  // told to the other machine, whose guard and coupling keep to them
};
// From what the device says of itself.
StationConfig station_config(const DeviceInfo& info);

struct StationState {
  GuardState guard = guard_start();
  GuardState torque_guard = guard_start();
  Sample sample = {};
  SamplePacket sent;
  ObeyedForce obeyed;
  Vec3 force_n = {};          // on the hand
  Vec3 torque_nm = {};        // likewise
  std::int64_t fade_ns = 0;   // since models came anew
  std::uint64_t models = 0;   // accepted
  std::uint64_t refused = 0;  // damaged, or not to be obeyed
  std::uint64_t starved = 0;  // ticks without a living model
};

// `session`: another number each time a station is started.
StationState station_start(std::uint32_t session);
void station_tick(const StationConfig& config, StationState& state, const Device& device,
                  const Link& link, std::int64_t now_ns);
// Instead of a tick at the end: true once nothing is left of the force.
bool station_end(const StationConfig& config, StationState& state, const Device& device,
                 std::int64_t now_ns);

}  // namespace stylet::hal
