// SPDX-License-Identifier: Apache-2.0
#include "hal/device/model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "hal/device/devices.h"

namespace stylet::hal {
namespace {

// Uses no heap: a model is also asked for where no heap may be used.
template <typename Visit>
void for_each_model(Visit visit) {
  for (const DriverDescriptor* driver : drivers()) {
    for (const DeviceModel& each : driver->models) visit(each);
  }
}

// Former names, and names of families.
struct Alias {
  const char* called;
  const char* model;
};
constexpr std::array kAliases = {Alias{"desktop", "touch-x"}, Alias{"premium", "premium-1.5"}};

std::string letters(std::string_view text) {
  std::string out;
  for (const char each : text) {
    const auto c = static_cast<unsigned char>(each);
    if (std::isalnum(c) != 0) out += static_cast<char>(std::tolower(c));
  }
  return out;
}

// Forces, stiffness, damping and workspace: the smallest, and no more loss in the arm may be
// assumed than the smallest. Steps and delay: the largest.
DeviceModel most_careful() {
  DeviceModel all = device_models().front();
  all.name = "unknown";
  for_each_model([&all](const DeviceModel& each) {
    const auto less = [](float& a, float b) { a = std::min(a, b); };
    const auto more = [](float& a, float b) { a = std::max(a, b); };
    less(all.max_force_n, each.max_force_n);
    less(all.continuous_force_n, each.continuous_force_n);
    less(all.max_slew_n_per_s, each.max_slew_n_per_s);
    less(all.max_stiffness_n_per_m, each.max_stiffness_n_per_m);
    less(all.max_damping_n_s_per_m, each.max_damping_n_s_per_m);
    less(all.workspace_m.x, each.workspace_m.x);
    less(all.workspace_m.y, each.workspace_m.y);
    less(all.workspace_m.z, each.workspace_m.z);
    less(all.motion.mass_kg, each.motion.mass_kg);
    less(all.motion.damping_n_s_per_m, each.motion.damping_n_s_per_m);
    less(all.motion.friction_n, each.motion.friction_n);
    more(all.motion.resolution_m, each.motion.resolution_m);
    more(all.motion.delay_s, each.motion.delay_s);
  });
  return all;
}

}  // namespace

std::span<const DeviceModel> device_models() {
  static const std::vector<DeviceModel> all = [] {
    std::vector<DeviceModel> found;
    for_each_model([&found](const DeviceModel& each) { found.push_back(each); });
    return found;
  }();
  return all;
}

const DeviceModel* find_device_model(std::string_view name) {
  const DeviceModel* found = nullptr;
  for_each_model([&](const DeviceModel& each) {
    if (name == each.name) found = &each;
  });
  return found;
}

const DeviceModel* recognise_device_model(std::string_view called) {
  const std::string own = letters(called);
  const DeviceModel* best = nullptr;
  std::size_t longest = 0;
  const auto consider = [&](std::string_view name, const DeviceModel* model) {
    const std::string wanted = letters(name);
    if (wanted.size() <= longest || own.find(wanted) == std::string::npos) return;
    best = model;
    longest = wanted.size();
  };
  for_each_model([&](const DeviceModel& each) { consider(each.name, &each); });
  for (const Alias& each : kAliases) consider(each.called, find_device_model(each.model));
  return best;
}

const DeviceModel& unknown_device_model() {
  static const DeviceModel the_only = most_careful();
  return the_only;
}

}  // namespace stylet::hal
