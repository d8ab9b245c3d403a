// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/device_model.h"

#include <array>

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

}  // namespace stylet::hal
