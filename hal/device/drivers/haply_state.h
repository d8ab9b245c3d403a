// SPDX-License-Identifier: Apache-2.0
// What Haply's service says of one Inverse3 and its grip, and what is sent to them. Both are
// identified by their ids, never by their places in a list.
//
// Promise: any message is accepted; data that is missing, of another type or of another device
// changes nothing. Throws nothing but std::bad_alloc. Units: SI. Frame: the device's of the hal.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stylet/units.h"

namespace stylet::hal {

struct HaplyIds {
  std::string device;
  std::string grip;  // empty: there is no grip
};

struct HaplyState {
  Pose pose = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons = 0;  // of a grip that is there and awake; else 0
  bool calibrated = false;
  double rendered_n = 0;           // the force after the service's filters
  double gate = -1, damping = -1;  // of these filters, in the inventory; negative: not told
};

// Ids of all listed ones, in the order of the list, each once.
std::vector<std::string> listed_devices(const nlohmann::json& message);
std::vector<std::string> listed_grips(const nlohmann::json& message);

// Whether the message holds a position of this device.
bool take_state(const nlohmann::json& message, const HaplyIds& ids, HaplyState& state);
// Only the inventory, the first message, tells of filters.
void take_filters(const nlohmann::json& message, const HaplyIds& ids, HaplyState& state);

// Messages to the service.
std::string force_message(const HaplyIds& ids, Vec3 force_n);
// Lasts as long as the connection. Negative `gate`: unchanged.
std::string filter_message(const HaplyIds& ids, double gate, double damping);

}  // namespace stylet::hal
