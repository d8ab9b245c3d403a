// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/guard.h"

#include <algorithm>
#include <string>

namespace stylet::hal {
namespace {

// Fractions of what the device renders: for the controller's damping and the amplitude of buzzing.
constexpr double kPassivityShare = 0.5, kBuzzShare = 0.1;

double of(float value) {
  return static_cast<double>(value);
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
  motion.mass_kg = si(device.number("mass_g", of(motion.mass_kg) * 1e3, 0, 1e4), 1e-3);
  motion.damping_n_s_per_m =
      static_cast<float>(device.number("damping_n_s_per_m", of(motion.damping_n_s_per_m), 0, 1000));
  motion.friction_n = static_cast<float>(device.number("friction_n", of(motion.friction_n), 0, 10));
  motion.resolution_m =
      si(device.number("resolution_mm", of(motion.resolution_m) * 1e3, 0, 1), 1e-3);
  motion.delay_s = si(device.number("delay_ms", of(motion.delay_s) * 1e3, 0, 100), 1e-3);
  const double most_ms = kMaxDelayTicks * of(period_s) * 1e3;
  if (of(motion.delay_s) * 1e3 > most_ms * 1.0001) {
    device.fail("delay_ms", fmt::format("at most {} periods of the loop, {:g} ms; it is {:g} ms",
                                        kMaxDelayTicks, most_ms, of(motion.delay_s) * 1e3));
  }
}

// Checks that a fault can fade in time.
void check_slew(const Section& guard, const Section& device, const GuardConfig& config) {
  const double needed = of(config.max_force_n) / of(kDecayS);
  if (of(config.max_slew_n_per_s) >= needed * 0.99999) return;
  const Section& named = guard.has("max_slew_n_per_s") ? guard : device;
  named.fail("max_slew_n_per_s",
             fmt::format("at least {:g} (max_force_n / {:g} s, so that a fault can fade in time)",
                         needed, of(kDecayS)));
}

}  // namespace

DeviceModel read_device_model(Section& device, float period_s) {
  DeviceModel model = named_model(device);
  const auto number = [&device](const char* key, float fallback, double low, double high) {
    return static_cast<float>(device.number(key, of(fallback), low, high));
  };
  const bool named = device.has("model");
  model.max_force_n = number("max_force_n", model.max_force_n, 0.01, 100);
  const float always =
      named ? std::min(model.continuous_force_n, model.max_force_n) : model.max_force_n;
  model.continuous_force_n = number("continuous_force_n", always, 0.01, 100);
  model.max_slew_n_per_s = number("max_slew_n_per_s", model.max_slew_n_per_s, 1, 1e6);
  model.max_stiffness_n_per_m =
      number("max_stiffness_n_per_m", model.max_stiffness_n_per_m, 1, 1e6);
  model.max_damping_n_s_per_m =
      number("max_damping_n_s_per_m", model.max_damping_n_s_per_m, 0, 1000);
  read_dynamics(device, period_s, model.motion);
  return model;
}

GuardConfig read_guard(Section guard, const Section& device, const DeviceModel& model,
                       float period_s) {
  const auto number = [&guard](const char* key, double fallback, double low, double high) {
    return static_cast<float>(guard.number(key, fallback, low, high));
  };
  GuardConfig config;
  config.period_s = period_s;
  config.max_force_n =
      std::min(model.max_force_n, number("max_force_n", of(model.max_force_n), 0.01, 100));
  config.max_slew_n_per_s = std::min(
      model.max_slew_n_per_s, number("max_slew_n_per_s", of(model.max_slew_n_per_s), 1, 1e6));
  check_slew(guard, device, config);
  config.ramp_s = si(guard.number("ramp_ms", 500, 0, 10000), 1e-3);
  config.watchdog_s = si(guard.number("watchdog_ms", 3, 1, 5), 1e-3);
  config.max_speed_m_per_s = si(guard.number("max_speed_mm_per_s", 2000, 10, 20000), 1e-3);
  config.buzz_n = number("buzz_n", kBuzzShare * of(config.max_force_n), 0.001, 100);
  config.continuous_force_n = model.continuous_force_n;
  config.thermal_s = number("thermal_s", of(config.thermal_s), 1, 3600);
  config.dead_man_button = static_cast<std::int32_t>(guard.integer("dead_man_button", -1, 0, 31));
  config.acknowledge_button =
      static_cast<std::int32_t>(guard.integer("acknowledge_button", -1, 0, 31));
  config.device = model.motion;
  const Vec3 reach = model.workspace_m;
  config.stored_energy_j = 0.5F * model.max_force_n * std::max({reach.x, reach.y, reach.z});
  config.passivity_damping_n_s_per_m = number(
      "passivity_damping_n_s_per_m", kPassivityShare * of(model.max_damping_n_s_per_m), 0, 1000);
  guard.finish();
  return config;
}

float most_coupling(float limit_n_per_m, const GripConfig& grip) {
  return static_cast<float>(kCouplingShare) * limit_n_per_m /
         (grip.motion_scale * grip.force_scale);
}

CouplingConfig read_coupling(Section coupling, const DeviceModel& model, const GuardConfig& guard,
                             const GripConfig& grip) {
  const bool known = model.max_stiffness_n_per_m > 0;
  const double most = known ? of(most_coupling(model.max_stiffness_n_per_m, grip)) : 1e6;
  CouplingConfig config;
  config.stiffness_n_per_m =
      static_cast<float>(coupling.number("stiffness_n_per_m", known ? most : 0, 0, most));
  config.max_force_n = guard.max_force_n / grip.force_scale;
  config.period_s = guard.period_s;
  coupling.finish();
  return config;
}

namespace {

// The stricter of two limits; `whose` says where it comes from.
float stricter(float scenes, float devices, const char*& whose) {
  whose = scenes < devices ? "scene" : "device";
  return std::min(scenes, devices);
}

// The scene's value counts only where it is stricter; where the scene says nothing it is zero.
float assumed(float scenes, float devices) {
  return scenes > 0 ? std::min(scenes, devices) : devices;
}

void fit_force(const DeviceInfo& info, Hand& hand, std::string& told) {
  GuardConfig& guard = hand.guard;
  const char* whose = "";
  guard.max_force_n = stricter(guard.max_force_n, info.max_force_n, whose);
  told += fmt::format("at most {:.3g} N ({})", of(guard.max_force_n), whose);
  const float slew = std::min(guard.max_slew_n_per_s, info.max_slew_n_per_s);
  guard.max_slew_n_per_s = std::max(slew, guard.max_force_n / kDecayS);
  hand.coupling.max_force_n = guard.max_force_n / hand.grip.force_scale;
  const float buzz_n = static_cast<float>(kBuzzShare) * guard.max_force_n;
  guard.buzz_n = stricter(guard.buzz_n, buzz_n, whose);
  told += fmt::format(", buzz {:.3g} N ({})", of(guard.buzz_n), whose);
}

void fit_heat_and_stiffness(const DeviceInfo& info, Hand& hand, std::string& told) {
  const DeviceModel* model = info.model;
  const auto known = [model](float read, float DeviceModel::*of_model) {
    return read > 0 ? read : model != nullptr ? model->*of_model : 0;
  };
  const float always_n = known(info.continuous_force_n, &DeviceModel::continuous_force_n);
  const char* whose = "";
  if (always_n > 0) {
    float& continuous_n = hand.guard.continuous_force_n;
    continuous_n = stricter(continuous_n, always_n, whose);
    told += fmt::format(", for ever {:.3g} N ({})", of(continuous_n), whose);
  }
  const float stiffness = known(info.max_stiffness_n_per_m, &DeviceModel::max_stiffness_n_per_m);
  if (stiffness > 0) {
    const float most = most_coupling(stiffness, hand.grip);
    float& coupling = hand.coupling.stiffness_n_per_m;
    coupling = stricter(coupling > 0 ? coupling : most, most, whose);
    told += fmt::format(", coupling {:.3g} N/m ({})", of(coupling), whose);
  }
}

// For the observer of energy: what the device itself dissipates, not what the scene's device would.
void fit_energy(const DeviceInfo& info, Hand& hand, std::string& told) {
  const DeviceModel& model = *info.model;
  GuardConfig& guard = hand.guard;
  const DeviceDynamics scenes = guard.device;
  guard.device = model.motion;
  guard.device.damping_n_s_per_m =
      assumed(scenes.damping_n_s_per_m, model.motion.damping_n_s_per_m);
  guard.device.friction_n = assumed(scenes.friction_n, model.motion.friction_n);
  const Vec3 reach = model.workspace_m;
  guard.stored_energy_j =
      0.5F * std::min(info.max_force_n, model.max_force_n) * std::max({reach.x, reach.y, reach.z});
  guard.passivity_damping_n_s_per_m =
      assumed(guard.passivity_damping_n_s_per_m,
              static_cast<float>(kPassivityShare) * model.max_damping_n_s_per_m);
  told += fmt::format(
      ", energy: damping {:.3g} N s/m, friction {:.3g} N, steps of {:.3g} mm, delay {:.3g} ms, at "
      "most {:.3g} N s/m added, {:.3g} J stored ({})",
      of(guard.device.damping_n_s_per_m), of(guard.device.friction_n),
      of(guard.device.resolution_m) * 1e3, of(guard.device.delay_s) * 1e3,
      of(guard.passivity_damping_n_s_per_m), of(guard.stored_energy_j), model.name);
}

}  // namespace

std::string fit_to_device(const DeviceInfo& info, Hand& hand) {
  std::string told = info.name;
  if (info.identity[0] != 0) told += fmt::format(" {}", info.identity);
  if (info.model != nullptr) told += fmt::format(", taken for \"{}\"", info.model->name);
  told += ": ";
  if (info.max_force_n > 0) {
    fit_force(info, hand, told);
    fit_heat_and_stiffness(info, hand, told);
    if (info.model != nullptr) fit_energy(info, hand, told);
  } else {
    told += "no force";
  }
  hand.guard.watchdog_s = watchdog_of(info, hand.guard.watchdog_s);
  hand.limits = info;
  return told;
}

}  // namespace stylet::hal
