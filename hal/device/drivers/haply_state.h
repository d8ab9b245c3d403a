// SPDX-License-Identifier: Apache-2.0
// What Haply's service says of one Inverse3 and of the one grip that goes with it, and what is said
// to them. Both go by their ids, never by their place in a list.
//
// Promise: any message is taken; what is missing, of another type or of another device changes
// nothing. Nothing but std::bad_alloc leaves. Units: SI. Frame: the device's of the hal.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stylet/units.h"

namespace stylet::hal {

struct HaplyIds {
  std::string device;
  std::string grip;  // empty: none
};

struct HaplyState {
  Pose pose = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons = 0;  // of a grip that is there and awake; else none
  bool calibrated = false;
  double rendered_n = 0;           // what comes out of the service's filters
  double gate = -1, damping = -1;  // of these, in the inventory; below zero: not told
};

// Ids of all that are listed, in their order, each once.
std::vector<std::string> listed_devices(const nlohmann::json& message);
std::vector<std::string> listed_grips(const nlohmann::json& message);

// Whether the message holds a place of this device.
bool take_state(const nlohmann::json& message, const HaplyIds& ids, HaplyState& state);
// The inventory alone, which comes first, tells of filters.
void take_filters(const nlohmann::json& message, const HaplyIds& ids, HaplyState& state);

// Messages to the service.
std::string force_message(const HaplyIds& ids, Vec3 force_n);
// Lasts as long as the connection. `gate` below zero: stays as it is.
std::string filter_message(const HaplyIds& ids, double gate, double damping);

}  // namespace stylet::hal
