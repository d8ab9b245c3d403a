// SPDX-License-Identifier: Apache-2.0
#include "hal/device/model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace stylet::hal {
namespace {

constexpr float kSlew = 2000;  // N/s
constexpr float kUsbS = 1e-3F, kFastUsbS = 0.25e-3F;

constexpr Vec3 mm(float right, float up, float near) {
  return {1e-3F * right, 1e-3F * up, 1e-3F * near};
}

// The damping is what the advertised stiffness implies, if that is where the device begins to buzz
// in a light grip: b = K (T/2 + delay) at T = 1 ms (Gil et al. 2009).
constexpr DeviceModel make_model(DeviceModel model) {
  constexpr float kHalfPeriodS = 0.5e-3F;
  model.motion.damping_n_s_per_m =
      model.max_stiffness_n_per_m * (kHalfPeriodS + model.motion.delay_s);
  return model;
}

// name; largest force, continuous force; slew; stiffness; damping; workspace; mass, (damping),
// friction, resolution, delay.
constexpr std::array kModels = {
    make_model({"touch",
                3.3F,
                0.88F,
                kSlew,
                400,
                4,
                mm(160, 120, 70),
                {0.045F, 0, 0.26F, 0.055e-3F, kUsbS}}),
    make_model({"omni",
                3.3F,
                0.88F,
                kSlew,
                700,
                5,
                mm(160, 120, 70),
                {0.045F, 0, 0.26F, 0.055e-3F, kUsbS}}),
    make_model({"touch-x",
                7.9F,
                1.75F,
                kSlew,
                1000,
                5,
                mm(160, 120, 120),
                {0.045F, 0, 0.06F, 0.023e-3F, kUsbS}}),
    make_model({"premium-1.5",
                8.5F,
                1.4F,
                kSlew,
                800,
                5,
                mm(381, 267, 191),
                {0.075F, 0, 0.04F, 0.03e-3F, kUsbS}}),
    make_model({"premium-3.0",
                22,
                3,
                kSlew,
                1000,
                5,
                mm(838, 584, 406),
                {0.159F, 0, 0.2F, 0.02e-3F, kUsbS}}),
    make_model({"falcon", 8, 2, kSlew, 3000, 20, mm(100, 100, 100), {0.2F, 0, 0, 0.06e-3F, kUsbS}}),
    make_model(
        {"omega.3", 12, 12, kSlew, 5000, 30, mm(160, 160, 110), {0.2F, 0, 0, 0.01e-3F, kFastUsbS}}),
    make_model(
        {"omega.6", 12, 12, kSlew, 5000, 30, mm(160, 160, 110), {0.2F, 0, 0, 0.01e-3F, kFastUsbS}}),
    make_model(
        {"omega.7", 12, 12, kSlew, 5000, 30, mm(160, 160, 110), {0.2F, 0, 0, 0.01e-3F, kFastUsbS}}),
    make_model(
        {"sigma.7", 12, 12, kSlew, 4000, 30, mm(190, 190, 130), {0.2F, 0, 0, 0.01e-3F, kFastUsbS}}),
    make_model({"delta.6",
                20,
                20,
                kSlew,
                5000,
                30,
                mm(400, 400, 260),
                {0.25F, 0, 0, 0.03e-3F, kFastUsbS}}),
};

// Names of before, and families.
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

// Forces, stiffness, damping and room: the smallest, and nothing that the arm dissipates may be
// assumed beyond it. Steps and delay: the largest.
DeviceModel most_careful() {
  DeviceModel all = kModels[0];
  all.name = "unknown";
  for (const DeviceModel& each : kModels) {
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
  }
  return all;
}

}  // namespace

std::span<const DeviceModel> device_models() {
  return kModels;
}

const DeviceModel* find_device_model(std::string_view name) {
  for (const DeviceModel& each : kModels) {
    if (name == each.name) return &each;
  }
  return nullptr;
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
  for (const DeviceModel& each : kModels) consider(each.name, &each);
  for (const Alias& each : kAliases) consider(each.called, find_device_model(each.model));
  return best;
}

const DeviceModel& unknown_device_model() {
  static const DeviceModel the_only = most_careful();
  return the_only;
}

}  // namespace stylet::hal
