// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/haply_state.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "hal/device/vendor_pose.h"

namespace stylet::hal {

using nlohmann::json;

namespace {

constexpr const char* kDevices[] = {"inverse3"};
constexpr const char* kGrips[] = {"wireless_verse_grip", "verse_grip", "custom_verse_grip"};
constexpr const char* kButtons[][2] = {
    {"a", "button_0"}, {"b", "button_1"}, {"c", "button_2"}, {"home", "button_3"}};

const json* part(const json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

std::string id_of(const json& each) {
  const json* id = part(&each, "device_id");
  return id != nullptr && id->is_string() ? id->get<std::string>() : "";
}

const json* entry(const json& message, std::span<const char* const> lists, const std::string& id) {
  for (const char* name : lists) {
    const json* list = part(&message, name);
    if (list == nullptr || !list->is_array() || id.empty()) continue;
    for (const json& each : *list) {
      if (id_of(each) == id) return &each;
    }
  }
  return nullptr;
}

std::vector<std::string> ids_in(const json& message, std::span<const char* const> lists) {
  std::vector<std::string> found;
  for (const char* name : lists) {
    const json* list = part(&message, name);
    if (list == nullptr || !list->is_array()) continue;
    for (const json& each : *list) {
      const std::string id = id_of(each);
      const bool known = std::find(found.begin(), found.end(), id) != found.end();
      if (!id.empty() && !known) found.push_back(id);
    }
  }
  return found;
}

bool number(const json* object, const char* key, double& out) {
  const json* found = part(object, key);
  if (found == nullptr || !found->is_number()) return false;
  out = found->get<double>();
  return true;
}

bool truth(const json* object, const char* key) {
  const json* found = part(object, key);
  if (found == nullptr) return false;
  return found->is_boolean() ? found->get<bool>() : found->is_number() && *found != 0;
}

bool vector(const json* object, UserFirst& out) {
  return number(object, "x", out.x) && number(object, "y", out.y) && number(object, "z", out.z);
}

// A grip that sleeps or has gone presses no button: a dead man's button must not stay pressed.
void take_grip(const json* grip, HaplyState& state) {
  state.buttons = 0;
  const json* status = part(grip, "status");
  if (part(status, "awake") != nullptr && !truth(status, "awake")) return;
  const json* told = part(grip, "state");
  const json* q = part(told, "orientation");
  double w = 0;
  UserFirst v = {};
  if (!number(q, "w", w) || !vector(q, v)) return;
  state.pose.rotation = from_user_first(Quat{static_cast<float>(w), static_cast<float>(v.x),
                                             static_cast<float>(v.y), static_cast<float>(v.z)});
  const json* buttons = part(told, "buttons");
  state.buttons = truth(told, "button") ? 1U : 0U;
  for (std::uint32_t i = 0; i < std::size(kButtons); ++i) {
    for (const char* name : kButtons[i]) {
      if (truth(buttons, name) || truth(told, name)) state.buttons |= 1U << i;
    }
  }
}

std::string message_to(const HaplyIds& ids, const char* key, json what) {
  json device = {{"device_id", ids.device}};
  device[key] = std::move(what);
  return json{{"inverse3", json::array({std::move(device)})}}.dump();
}

}  // namespace

std::vector<std::string> listed_devices(const json& message) {
  return ids_in(message, kDevices);
}

std::vector<std::string> listed_grips(const json& message) {
  return ids_in(message, kGrips);
}

bool take_state(const json& message, const HaplyIds& ids, HaplyState& state) {
  const json* device = entry(message, kDevices, ids.device);
  if (device == nullptr) return false;
  const json* status = part(device, "status");
  if (part(status, "calibrated") != nullptr) state.calibrated = truth(status, "calibrated");
  const json* told = part(device, "state");
  UserFirst force = {}, place = {};
  if (vector(part(told, "current_cursor_force"), force)) {
    state.rendered_n = std::hypot(force.x, force.y, force.z);
  }
  if (!vector(part(told, "cursor_position"), place)) return false;
  state.pose.position_m = from_user_first(place.x, place.y, place.z);
  take_grip(entry(message, kGrips, ids.grip), state);
  return true;
}

void take_filters(const json& message, const HaplyIds& ids, HaplyState& state) {
  const json* config = part(entry(message, kDevices, ids.device), "config");
  const json* filters = part(config, "filters");
  (void)number(part(filters, "force_gate"), "gain", state.gate);
  (void)number(part(filters, "damping"), "scalar", state.damping);
}

std::string force_message(const HaplyIds& ids, Vec3 force_n) {
  const UserFirst f = to_user_first(force_n);
  return message_to(ids, "commands",
                    {{"set_cursor_force", {{"values", {{"x", f.x}, {"y", f.y}, {"z", f.z}}}}}});
}

std::string filter_message(const HaplyIds& ids, double gate, double damping) {
  json what = {{"damping", {{"scalar", damping}}}};
  if (gate >= 0) what["force_gate"] = {{"gain", gate}};
  return message_to(ids, "configure", std::move(what));
}

}  // namespace stylet::hal
