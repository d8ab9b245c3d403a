// SPDX-License-Identifier: Apache-2.0
// Guards of stylet_loop.h: hal's guard of a force and of a torque, with a caller's configuration.
#include <algorithm>
#include <cmath>
#include <new>
#include <string_view>
#include <utility>

#include "hal/guard/bounds.h"
#include "hal/hosts/c/hands.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"
#include "hal/loop/fit.h"
#include "hal/loop/loop.h"

namespace stylet::c {
namespace {

double wide(float value) {
  return static_cast<double>(value);
}

hal::GuardConfig config_of(const stylet_guard_config& c) {
  hal::GuardConfig out;
  out.period_s = c.period_s;
  out.max_force_n = c.max_force_n;
  out.max_slew_n_per_s = c.max_slew_n_per_s;
  out.ramp_s = c.ramp_s;
  out.watchdog_s = c.watchdog_s;
  out.max_speed_m_per_s = c.max_speed_m_per_s;
  out.buzz_n = c.buzz_n;
  out.continuous_force_n = c.continuous_force_n;
  out.thermal_s = c.thermal_s;
  out.dead_man_button = c.dead_man_button;
  out.acknowledge_button = c.acknowledge_button;
  out.device = {c.device_mass_kg, c.device_damping_n_s_per_m, c.device_friction_n,
                c.device_resolution_m, c.device_delay_s};
  out.stored_energy_j = c.stored_energy_j;
  out.passivity_damping_n_s_per_m = c.passivity_damping_n_s_per_m;
  return out;
}

// The limits are those of a scene's [guard] and [device].
stylet_status check(const stylet_guard_config& c, std::uint32_t index,
                    stylet_refusal* refusal_out) {
  constexpr double kDecay = static_cast<double>(hal::kDecayS);
  FirstOutside first(index);
  const auto within = [&](const char* field, float value, hal::Bounds bounds) {
    first.check(field, wide(value), bounds.least, bounds.most);
  };
  within("guard.period_s", c.period_s, {wide(kMinPeriodS), wide(kMaxPeriodS)});
  within("guard.max_force_n", c.max_force_n, hal::kForceBoundsN);
  const double least_slew = (1 - hal::kRoundingFraction) * wide(c.max_force_n) / kDecay;
  const hal::Bounds slew = hal::kSlewBoundsNPerS, watchdog = hal::kWatchdogBoundsS;
  within("guard.max_slew_n_per_s", c.max_slew_n_per_s,
         {std::max(slew.least, least_slew), slew.most});
  within("guard.ramp_s", c.ramp_s, hal::kRampBoundsS);
  within("guard.watchdog_s", c.watchdog_s,
         {watchdog.least, std::max(watchdog.most, 3 * wide(c.period_s))});
  within("guard.max_speed_m_per_s", c.max_speed_m_per_s, hal::kSpeedBoundsMPerS);
  within("guard.buzz_n", c.buzz_n, hal::kBuzzBoundsN);
  within("guard.continuous_force_n", c.continuous_force_n, hal::kForceBoundsN);
  within("guard.thermal_s", c.thermal_s, hal::kThermalBoundsS);
  for (const auto& [field, button] :
       {std::pair("guard.dead_man_button", c.dead_man_button),
        std::pair("guard.acknowledge_button", c.acknowledge_button)}) {
    first.check(field, button, -1, hal::kButtonBounds.most);
  }
  within("guard.device_mass_kg", c.device_mass_kg, hal::kDeviceMassBoundsKg);
  within("guard.device_damping_n_s_per_m", c.device_damping_n_s_per_m, hal::kDampingBoundsNSPerM);
  within("guard.device_friction_n", c.device_friction_n, hal::kDeviceFrictionBoundsN);
  within("guard.device_resolution_m", c.device_resolution_m, hal::kResolutionBoundsM);
  within("guard.device_delay_s", c.device_delay_s,
         {0, (1 + hal::kRoundingFraction) * hal::kMaxDelayTicks * wide(c.period_s)});
  within("guard.stored_energy_j", c.stored_energy_j, hal::kStoredEnergyBoundsJ);
  within("guard.passivity_damping_n_s_per_m", c.passivity_damping_n_s_per_m,
         hal::kDampingBoundsNSPerM);
  within("guard.max_torque_nm", c.max_torque_nm, hal::kTorqueBoundsNm);
  return told(first, refusal_out);
}

hal::GuardConfig config_for(const hal::DeviceModel& model) {
  hal::DeviceInfo info = {model.name, model.max_force_n, model.max_slew_n_per_s};
  info.model = &model;
  hal::GuardConfig config;
  hal::CouplingConfig coupling;
  hal::fit_to_device(info, {}, config, coupling);
  return config;
}

}  // namespace

stylet_guard_config plain(const hal::GuardConfig& c, float max_torque_nm) {
  return {sizeof(stylet_guard_config),
          c.period_s,
          c.max_force_n,
          c.max_slew_n_per_s,
          c.ramp_s,
          c.watchdog_s,
          c.max_speed_m_per_s,
          c.buzz_n,
          c.continuous_force_n,
          c.thermal_s,
          c.dead_man_button,
          c.acknowledge_button,
          c.device.mass_kg,
          c.device.damping_n_s_per_m,
          c.device.friction_n,
          c.device.resolution_m,
          c.device.delay_s,
          c.stored_energy_j,
          c.passivity_damping_n_s_per_m,
          max_torque_nm};
}

stylet_status read_guard(const stylet_guard_config* config, std::uint32_t bytes,
                         std::uint32_t index, CheckedGuard& out, stylet_refusal* refusal_out) {
  stylet_guard_config own = plain(hal::GuardConfig{}, 0);
  if (config != nullptr && !take(config, bytes, own)) {
    const std::uint32_t told = bytes != 0 ? bytes : config->struct_bytes;
    return refuse_size(refusal_out, "guard", told, sizeof *config, index);
  }
  const stylet_status status = check(own, index, refusal_out);
  if (status == STYLET_OK) out = {config_of(own), own.max_torque_nm};
  return status;
}

}  // namespace stylet::c

using namespace stylet;

const char* stylet_fault_name(uint32_t fault) {
  return hal::fault_name(static_cast<hal::Fault>(fault));
}

const char* stylet_guard_mode_name(uint32_t mode) {
  return hal::mode_name(static_cast<hal::GuardMode>(mode));
}

stylet_status stylet_guard_config_init(stylet_guard_config* config, size_t struct_bytes) {
  return c::init(c::plain(hal::GuardConfig{}, 0), config, struct_bytes);
}

stylet_status stylet_guard_config_for(stylet_guard_config* config, const char* model) {
  if (config == nullptr || model == nullptr) return c::missing(config);
  const hal::DeviceModel* const found = hal::find_device_model(model);
  if (found == nullptr) return c::nothing(STYLET_ARGUMENT_OUT_OF_RANGE, config);
  return c::answer(c::plain(c::config_for(*found), 0), config);
}

const char* stylet_device_model(uint32_t index) {
  const auto models = hal::device_models();
  return index < models.size() ? models[index].name : nullptr;
}

stylet_status stylet_guard_create(const stylet_guard_config* config, stylet_guard** guard_out,
                                  stylet_refusal* refusal_out) {
  if (guard_out == nullptr) return c::refuse_missing(refusal_out, "guard_out");
  *guard_out = nullptr;
  c::CheckedGuard checked;
  const std::uint32_t bytes = config == nullptr ? 0 : c::stride_of(config);
  const stylet_status status = c::read_guard(config, bytes, 0, checked, refusal_out);
  if (status != STYLET_OK) return status;
  auto* const made = new (std::nothrow) stylet_guard{checked.config, checked.max_torque_nm};
  if (made == nullptr) return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  *guard_out = made;
  return c::refuse(refusal_out, STYLET_OK);
}

void stylet_guard_free(stylet_guard* guard) {
  delete guard;
}

stylet_status stylet_guard_motor(stylet_guard* guard, const stylet_motor_report* report) {
  if (guard == nullptr || report == nullptr) return STYLET_ARGUMENT_MISSING;
  hal::guard_motor(guard->force, {c::vec(report->force_n), c::vec(report->torque_nm),
                                  report->arming, report->stopped != 0});
  return STYLET_OK;
}

int stylet_guard_sample(stylet_guard* guard, const stylet_sample* sample, int64_t now_ns) {
  if (guard == nullptr) return 0;
  stylet_sample own = {};
  const bool answered = sample != nullptr && c::take(sample, own);
  const hal::Sample taken = {own.seq, own.t_ns, c::pose(own.pose), own.buttons, own.plunger_n};
  return hal::guard_sample(guard->config, guard->force, answered, taken, now_ns) ? 1 : 0;
}

stylet_vec3 stylet_guard_force(stylet_guard* guard, stylet_vec3 force_n) {
  if (guard == nullptr) return {0, 0, 0};
  return c::plain(hal::guard_force(guard->config, guard->force, c::vec(force_n)));
}

stylet_vec3 stylet_guard_torque(stylet_guard* guard, stylet_vec3 torque_nm) {
  if (guard == nullptr) return {0, 0, 0};
  return c::plain(hal::guard_torque(guard->config, guard->max_torque_nm, guard->force,
                                    guard->torque, c::vec(torque_nm)));
}

int stylet_guard_end(stylet_guard* guard, int64_t now_ns) {
  return guard == nullptr || hal::guard_end(guard->config, guard->force, guard->torque, now_ns) ? 1
                                                                                                : 0;
}

stylet_status stylet_guard_trip(stylet_guard* guard, uint32_t fault) {
  if (guard == nullptr) return STYLET_ARGUMENT_MISSING;
  if (fault == STYLET_FAULT_NONE || fault > static_cast<std::uint32_t>(hal::kLastFault)) {
    return STYLET_ARGUMENT_OUT_OF_RANGE;
  }
  hal::guard_trip(guard->force, static_cast<hal::Fault>(fault));
  return STYLET_OK;
}

int stylet_guard_rearm(stylet_guard* guard, uint32_t fault_seen) {
  if (guard == nullptr || fault_seen == STYLET_FAULT_NONE) return 0;
  return hal::guard_rearm(guard->force, static_cast<hal::Fault>(fault_seen)) ? 1 : 0;
}

stylet_status stylet_guard_get_report(const stylet_guard* guard, stylet_guard_report* report_out) {
  if (guard == nullptr || report_out == nullptr) return c::missing(report_out);
  const hal::GuardState& s = guard->force;
  const hal::GuardCounters& n = s.counters;
  const bool latched = s.fault != hal::Fault::kNone;
  const stylet_guard_report report = {0,
                                      static_cast<std::uint32_t>(s.mode),
                                      static_cast<std::uint32_t>(s.fault),
                                      latched ? static_cast<std::uint32_t>(n.faults) : 0,
                                      s.arming,
                                      hal::guard_withdraws_force(s) ? 1U : 0U,
                                      c::plain(s.force_n),
                                      c::plain(guard->torque.force_n),
                                      s.energy.energy_j,
                                      n.samples_used,
                                      n.samples_missing,
                                      n.samples_repeated,
                                      n.samples_lost,
                                      n.samples_old,
                                      n.samples_not_finite,
                                      n.samples_absurd,
                                      n.samples_jumped,
                                      n.force_not_finite,
                                      n.force_limited,
                                      n.slew_limited,
                                      n.force_warm,
                                      n.force_damped,
                                      n.faults,
                                      n.rearms};
  return c::answer(report, report_out);
}
