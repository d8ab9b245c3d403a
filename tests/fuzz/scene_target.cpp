// SPDX-License-Identifier: Apache-2.0
// Any text as a scene. It is refused with one line that names the file, or kernel, guard and hand
// accept everything that it says.
#include <cmath>

#include "hal/device/drivers/simulated_hand.h"
#include "hal/device/drivers/steered.h"
#include "hal/scene/scene.h"
#include "session.h"
#include "target.h"

namespace stylet::test {
namespace {

const Organ& block() {
  static const std::unique_ptr<OpenOrgan> organ = block_organ(4, 4, 4);
  return organ->organ;
}

void promise_usable(const hal::Scene& scene) {
  Sizes need = {};
  promise(sizes(block(), scene.config, need) == Status::kOk, "the kernel refuses a scene's config");
  promise(scene.hands.size() == scene.config.needle_count, "not one hand a needle");
  Session session = make_session(block(), scene.config);
  promise(set_obstacles(session.kernel, scene.obstacles) == Status::kOk,
          "the kernel refuses a scene's obstacles");
  for (const hal::Hand& hand : scene.hands) {
    const hal::GuardConfig& guard = hand.guard;
    promise(guard.max_force_n > 0 && guard.max_force_n <= hand.limits.max_force_n,
            "the guard allows more force than the device has");
    promise(guard.max_slew_n_per_s * hal::kDecayS >= guard.max_force_n * 0.9999F,
            "a fault cannot fade in time");
    promise(guard.watchdog_s <= 5e-3F, "the watchdog is too slow");
    promise(guard.max_speed_m_per_s > 0 && guard.buzz_n > 0 && guard.thermal_s > 0 &&
                guard.continuous_force_n > 0 && guard.stored_energy_j > 0,
            "a limit of the guard that is not positive");
    promise(guard.dead_man_button >= -1 && guard.dead_man_button < 32, "no such button");
    promise(guard.acknowledge_button >= -1 && guard.acknowledge_button < 32, "no such button");
    promise(guard.device.delay_s <= hal::kMaxDelayTicks * guard.period_s * 1.001F,
            "a delay that the guard does not know of");
    const auto script = hal::make_script(hand.waypoints, hand.approach.start_m);
    for (const hal::ScriptPoint& point : script) {
      promise(std::isfinite(point.t_s + point.x_m + point.y_m + point.z_m),
              "a hand's script that is not finite");
    }
  }
  for (std::uint32_t i = 0; i < scene.hands.size(); ++i) {
    try {
      (void)hal::place_needle(scene, block(), i);
    } catch (const hal::SceneError& refused) {
      promise_one_line(refused.what());
    }
  }
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // A hull names a file; none but its own seeds may be read.
  if (text.find("hull") != std::string_view::npos) return 0;
  try {
    test::promise_usable(hal::parse_scene(text, "scene.toml"));
  } catch (const hal::SceneError& refused) {
    test::promise_one_line(refused.what());
    test::promise(std::string_view(refused.what()).starts_with("scene.toml"),
                  "a refusal that does not name the file");
  }
  return 0;
}
