// SPDX-License-Identifier: Apache-2.0
// Devices of stylet_loop.h: hal's drivers by URI, a caller's own functions, and a simulated hand.
#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <new>

#include "hal/device/devices.h"
#include "hal/device/drivers/simulated_hand.h"
#include "hal/guard/bounds.h"
#include "hal/hosts/c/hands.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"

namespace stylet::c {
namespace {

struct OwnDevice {
  stylet_device_functions functions;
};

bool read_own(void* self, std::int64_t now_ns, hal::Sample& sample_out) {
  const stylet_device_functions& own = static_cast<OwnDevice*>(self)->functions;
  stylet_sample sample = {};
  sample.struct_bytes = sizeof sample;
  if (own.read(own.self, now_ns, &sample) == 0) return false;
  sample_out = {sample.seq, sample.t_ns, pose(sample.pose), sample.buttons, sample.plunger_n};
  return true;
}

void write_own(void* self, const hal::Command& command) {
  const stylet_device_functions& own = static_cast<OwnDevice*>(self)->functions;
  const stylet_command out = {sizeof out,
                              command.arming,
                              plain(command.force_n),
                              plain(command.torque_nm),
                              plain(command.place_m),
                              command.stiffness_n_per_m,
                              command.max_force_n,
                              command.falls ? 1U : 0U,
                              command.end_ns,
                              plain(command.tip_m),
                              plain(command.tip_direction)};
  own.write(own.self, &out);
}

bool motor_own(void* self, hal::MotorReport& report_out) {
  const stylet_device_functions& own = static_cast<OwnDevice*>(self)->functions;
  stylet_motor_report report = {};
  if (own.motor(own.self, &report) == 0) return false;
  report_out = {vec(report.force_n), vec(report.torque_nm), report.arming, report.stopped != 0};
  return true;
}

// Without a force is how every device must be left, whatever its functions did before.
void close_own(void* self) {
  const std::unique_ptr<OwnDevice> own(static_cast<OwnDevice*>(self));
  write_own(own.get(), {});
}

stylet_status check(const stylet_device_functions& f, stylet_refusal* refusal_out) {
  const auto wide = [](float value) { return static_cast<double>(value); };
  FirstOutside first(0);
  first.check("device.max_force_n", wide(f.max_force_n), 0, hal::kForceBoundsN.most);
  // At least so much that a fault can fade in time.
  first.check(
      "device.max_slew_n_per_s", wide(f.max_slew_n_per_s),
      (1 - hal::kRoundingFraction) * std::max(wide(f.max_force_n), 0.0) / wide(hal::kDecayS),
      hal::kSlewBoundsNPerS.most);
  first.check("device.max_stiffness_n_per_m", wide(f.max_stiffness_n_per_m), 0,
              hal::kStiffnessBoundsNPerM.most);
  first.check("device.continuous_force_n", wide(f.continuous_force_n), 0, hal::kForceBoundsN.most);
  first.check("device.max_torque_nm", wide(f.max_torque_nm), hal::kTorqueBoundsNm.least,
              hal::kTorqueBoundsNm.most);
  first.check("device.force_life_s", wide(f.force_life_s), 0, 1);
  return told(first, refusal_out);
}

void close_computed(void* self) {
  delete static_cast<hal::SimulatedHand*>(self);
}

}  // namespace
}  // namespace stylet::c

using namespace stylet;

stylet_status stylet_device_open(const char* uri, double patience_s, stylet_device** device_out,
                                 stylet_refusal* refusal_out) try {
  if (device_out != nullptr) *device_out = nullptr;
  if (device_out == nullptr) return c::refuse_missing(refusal_out, "device_out");
  if (uri == nullptr) return c::refuse_missing(refusal_out, "uri");
  FirstOutside first(0);
  first.check("patience_s", patience_s, 0, std::numeric_limits<double>::infinity());
  const stylet_status status = c::told(first, refusal_out);
  if (status != STYLET_OK) return status;
  auto made = std::make_unique<stylet_device>();
  made->device = hal::open_lasting_device(uri, patience_s);
  made->opened = true;
  *device_out = made.release();
  return c::refuse(refusal_out, STYLET_OK);
} catch (const std::bad_alloc&) {
  return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
} catch (const std::exception& error) {
  return c::refuse_text(refusal_out, STYLET_DEVICE_FAILED, "device", error.what());
}

stylet_status stylet_device_from_functions(const stylet_device_functions* functions,
                                           stylet_device** device_out,
                                           stylet_refusal* refusal_out) {
  if (device_out != nullptr) *device_out = nullptr;
  if (device_out == nullptr) return c::refuse_missing(refusal_out, "device_out");
  if (functions == nullptr) return c::refuse_missing(refusal_out, "functions");
  stylet_device_functions own = {};
  if (!c::take(functions, own)) return c::refuse_struct(refusal_out, "functions", functions);
  if (own.read == nullptr) return c::refuse_missing(refusal_out, "functions.read");
  if (own.write == nullptr) return c::refuse_missing(refusal_out, "functions.write");
  const stylet_status status = c::check(own, refusal_out);
  if (status != STYLET_OK) return status;
  std::unique_ptr<stylet_device> made(new (std::nothrow) stylet_device);
  std::unique_ptr<c::OwnDevice> self(new (std::nothrow) c::OwnDevice{own});
  if (made == nullptr || self == nullptr) return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  hal::Device& device = made->device;
  device.info = {"a device of the caller", own.max_force_n, own.max_slew_n_per_s};
  device.info.max_stiffness_n_per_m = own.max_stiffness_n_per_m;
  device.info.continuous_force_n = own.continuous_force_n;
  device.info.max_torque_nm = own.max_torque_nm;
  device.info.force_life_s = own.force_life_s;
  device.read = c::read_own;
  device.write = c::write_own;
  device.close = c::close_own;
  if (own.motor != nullptr) device.motor = c::motor_own;
  device.self = self.release();
  *device_out = made.release();
  return c::refuse(refusal_out, STYLET_OK);
}

stylet_status stylet_device_simulated(float travel_m, float speed_m_per_s, float hold_s,
                                      stylet_device** device_out) try {
  if (device_out == nullptr) return STYLET_ARGUMENT_MISSING;
  *device_out = nullptr;
  const bool good = travel_m > 0 && travel_m <= 1 && speed_m_per_s >= 1e-4F && speed_m_per_s <= 1 &&
                    hold_s >= 0 && hold_s <= 3600;
  if (!good) return STYLET_ARGUMENT_OUT_OF_RANGE;
  auto hand = std::make_unique<hal::SimulatedHand>();
  hand->script =
      hal::make_script({{.travel_m = travel_m, .speed_m_per_s = speed_m_per_s, .hold_s = hold_s},
                        {.travel_m = 0, .speed_m_per_s = speed_m_per_s}},
                       0);
  auto made = std::make_unique<stylet_device>();
  const hal::DeviceModel& model = hal::unknown_device_model();
  made->device = hal::simulated_hand_device(
      *hand, {"a simulated hand", model.max_force_n, model.max_slew_n_per_s});
  made->device.close = c::close_computed;
  made->scripted = true;
  (void)hand.release();  // the device's now
  *device_out = made.release();
  return STYLET_OK;
} catch (const std::bad_alloc&) {
  return STYLET_OUT_OF_MEMORY;
}

void stylet_device_close(stylet_device* device) {
  if (device == nullptr || device->taken) return;
  if (device->process != c::this_process()) return;  // after a fork it is still the parent's
  if (device->device.close != nullptr) device->device.close(device->device.self);
  delete device;
}
