// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hal/guard/bounds.h"
#include "hal/loop/fit.h"

namespace stylet::hal {
namespace {

double of(float value) {
  return static_cast<double>(value);
}

// A number of a section, between bounds in SI; `per_si`: how many of the key's unit make one.
float within(Section& section, const char* key, double fallback, Bounds bounds, double per_si = 1) {
  const double value =
      section.number(key, fallback * per_si, bounds.least * per_si, bounds.most * per_si);
  return si(value, 1 / per_si);
}

std::int32_t button(Section& guard, const char* key) {
  return static_cast<std::int32_t>(guard.integer(key, -1, static_cast<int>(kButtonBounds.least),
                                                 static_cast<int>(kButtonBounds.most)));
}

DeviceModel named_model(Section& device) {
  const std::string name = device.text("model", "");
  if (name.empty()) return {};
  const DeviceModel* found = find_device_model(name);
  if (found != nullptr) return *found;
  std::string all;
  for (const DeviceModel& each : device_models()) {
    all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", each.name);
  }
  device.fail("model", "one of " + all);
}

void read_dynamics(Section& device, float period_s, DeviceDynamics& motion) {
  motion.mass_kg = within(device, "mass_g", of(motion.mass_kg), kDeviceMassBoundsKg, 1e3);
  motion.damping_n_s_per_m =
      within(device, "damping_n_s_per_m", of(motion.damping_n_s_per_m), kDampingBoundsNSPerM);
  motion.friction_n = within(device, "friction_n", of(motion.friction_n), kDeviceFrictionBoundsN);
  motion.resolution_m =
      within(device, "resolution_mm", of(motion.resolution_m), kResolutionBoundsM, 1e3);
  motion.delay_s = si(device.number("delay_ms", of(motion.delay_s) * 1e3, 0, 100), 1e-3);
  const double most_ms = kMaxDelayTicks * of(period_s) * 1e3;
  if (of(motion.delay_s) * 1e3 > most_ms * (1 + kRoundingFraction)) {
    device.fail("delay_ms", fmt::format("at most {} periods of the loop, {:g} ms; it is {:g} ms",
                                        kMaxDelayTicks, most_ms, of(motion.delay_s) * 1e3));
  }
}

// Checks that a fault can fade in time.
void check_slew(const Section& guard, const Section& device, const GuardConfig& config) {
  const double needed = of(config.max_force_n) / of(kDecayS);
  if (of(config.max_slew_n_per_s) >= needed * (1 - kRoundingFraction)) return;
  const Section& named = guard.has("max_slew_n_per_s") ? guard : device;
  named.fail("max_slew_n_per_s",
             fmt::format("at least {:g} (max_force_n / {:g} s, so that a fault can fade in time)",
                         needed, of(kDecayS)));
}

}  // namespace

DeviceModel read_device_model(Section& device, float period_s) {
  DeviceModel model = named_model(device);
  const bool named = device.has("model");
  model.max_force_n = within(device, "max_force_n", of(model.max_force_n), kForceBoundsN);
  const float always =
      named ? std::min(model.continuous_force_n, model.max_force_n) : model.max_force_n;
  model.continuous_force_n = within(device, "continuous_force_n", of(always), kForceBoundsN);
  model.max_slew_n_per_s =
      within(device, "max_slew_n_per_s", of(model.max_slew_n_per_s), kSlewBoundsNPerS);
  model.max_stiffness_n_per_m = within(device, "max_stiffness_n_per_m",
                                       of(model.max_stiffness_n_per_m), kStiffnessBoundsNPerM);
  model.max_damping_n_s_per_m = within(device, "max_damping_n_s_per_m",
                                       of(model.max_damping_n_s_per_m), kDampingBoundsNSPerM);
  read_dynamics(device, period_s, model.motion);
  return model;
}

GuardConfig read_guard(Section guard, const Section& device, const DeviceModel& model,
                       float period_s) {
  const auto number = [&guard](const char* key, double fallback, Bounds bounds, double per_si = 1) {
    return within(guard, key, fallback, bounds, per_si);
  };
  GuardConfig config;
  config.period_s = period_s;
  config.max_force_n =
      std::min(model.max_force_n, number("max_force_n", of(model.max_force_n), kForceBoundsN));
  config.max_slew_n_per_s =
      std::min(model.max_slew_n_per_s,
               number("max_slew_n_per_s", of(model.max_slew_n_per_s), kSlewBoundsNPerS));
  check_slew(guard, device, config);
  config.ramp_s = number("ramp_ms", 0.5, kRampBoundsS, 1e3);
  config.watchdog_s = number("watchdog_ms", 3e-3, kWatchdogBoundsS, 1e3);
  config.max_speed_m_per_s = number("max_speed_mm_per_s", 2, kSpeedBoundsMPerS, 1e3);
  config.buzz_n = number("buzz_n", kBuzzFraction * of(config.max_force_n), kBuzzBoundsN);
  config.continuous_force_n = model.continuous_force_n;
  config.thermal_s = number("thermal_s", of(config.thermal_s), kThermalBoundsS);
  config.dead_man_button = button(guard, "dead_man_button");
  config.acknowledge_button = button(guard, "acknowledge_button");
  config.device = model.motion;
  const Vec3 reach = model.workspace_m;
  config.stored_energy_j = 0.5F * model.max_force_n * std::max({reach.x, reach.y, reach.z});
  config.passivity_damping_n_s_per_m =
      number("passivity_damping_n_s_per_m", kPassivityFraction * of(model.max_damping_n_s_per_m),
             kDampingBoundsNSPerM);
  guard.finish();
  return config;
}

CouplingConfig read_coupling(Section coupling, const DeviceModel& model, const GuardConfig& guard,
                             const GripConfig& grip) {
  const bool known = model.max_stiffness_n_per_m > 0;
  const double most =
      known ? of(most_coupling(model.max_stiffness_n_per_m, grip)) : kStiffnessBoundsNPerM.most;
  CouplingConfig config;
  config.stiffness_n_per_m =
      static_cast<float>(coupling.number("stiffness_n_per_m", known ? most : 0, 0, most));
  config.max_force_n = guard.max_force_n / grip.force_scale;
  config.period_s = guard.period_s;
  coupling.finish();
  return config;
}

namespace {

// Whose limit counts: of two, the lower; both, if they are the same.
const char* whose(float scenes, float devices) {
  const double apart = std::fabs(of(scenes) - of(devices));
  if (apart <= kRoundingFraction * std::fabs(of(devices))) return "scene and device";
  return scenes < devices ? "scene" : "device";
}

// What would hold with a scene that limits nothing.
Hand of_device_alone(const DeviceInfo& info, const Hand& scenes) {
  constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  Hand alone = scenes;
  alone.guard.max_force_n = alone.guard.max_slew_n_per_s = kNoLimit;
  alone.guard.buzz_n = alone.guard.continuous_force_n = kNoLimit;
  alone.guard.watchdog_s = 0;
  alone.coupling.stiffness_n_per_m = 0;
  fit_to_device(info, alone.grip, alone.guard, alone.coupling);
  return alone;
}

std::string told_of_force(const Hand& scenes, const Hand& alone, const Hand& used) {
  const float scenes_buzz_n =
      std::min(scenes.guard.buzz_n, static_cast<float>(kBuzzFraction) * scenes.guard.max_force_n);
  return fmt::format("at most {:.3g} N ({}), buzz {:.3g} N ({})", of(used.guard.max_force_n),
                     whose(scenes.guard.max_force_n, alone.guard.max_force_n),
                     of(used.guard.buzz_n), whose(scenes_buzz_n, alone.guard.buzz_n));
}

std::string told_of_heat_and_stiffness(const Hand& scenes, const Hand& alone, const Hand& used) {
  std::string told;
  if (std::isfinite(alone.guard.continuous_force_n)) {
    told += fmt::format(", for ever {:.3g} N ({})", of(used.guard.continuous_force_n),
                        whose(scenes.guard.continuous_force_n, alone.guard.continuous_force_n));
  }
  const float asked = scenes.coupling.stiffness_n_per_m;
  const float can = alone.coupling.stiffness_n_per_m;
  if (can > 0) {
    told += fmt::format(", coupling {:.3g} N/m ({})", of(used.coupling.stiffness_n_per_m),
                        asked > 0 ? whose(asked, can) : "device");
  }
  return told;
}

// The longer watchdog counts.
std::string told_of_watchdog(const Hand& scenes, const Hand& alone, const Hand& used) {
  const float scenes_s = scenes.guard.watchdog_s, devices_s = alone.guard.watchdog_s;
  return fmt::format(", watchdog {:.3g} ms ({})", of(used.guard.watchdog_s) * 1e3,
                     whose(-scenes_s, -devices_s));
}

std::string told_of_energy(const DeviceModel& model, const GuardConfig& guard) {
  return fmt::format(
      ", energy: damping {:.3g} N s/m, friction {:.3g} N, steps of {:.3g} mm, delay {:.3g} ms, at "
      "most {:.3g} N s/m added, {:.3g} J stored ({})",
      of(guard.device.damping_n_s_per_m), of(guard.device.friction_n),
      of(guard.device.resolution_m) * 1e3, of(guard.device.delay_s) * 1e3,
      of(guard.passivity_damping_n_s_per_m), of(guard.stored_energy_j), model.name);
}

}  // namespace

std::string fit_to_device(const DeviceInfo& info, Hand& hand) {
  const Hand scenes = hand;
  fit_to_device(info, hand.grip, hand.guard, hand.coupling);
  hand.limits = info;
  std::string told = info.name;
  if (info.identity[0] != 0) told += fmt::format(" {}", info.identity);
  if (info.model != nullptr) told += fmt::format(", taken for \"{}\"", info.model->name);
  if (!(info.max_force_n > 0)) return told + ": no force";
  const Hand alone = of_device_alone(info, scenes);
  told += ": " + told_of_force(scenes, alone, hand) +
          told_of_heat_and_stiffness(scenes, alone, hand) + told_of_watchdog(scenes, alone, hand);
  if (info.model != nullptr) told += told_of_energy(*info.model, hand.guard);
  return told;
}

}  // namespace stylet::hal
