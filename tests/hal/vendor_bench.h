// SPDX-License-Identifier: Apache-2.0
// The bench of a vendor's library that is loaded at run time: its stand-in is another library, and
// exports standin() beside the vendor's functions (standin/standin.h).
#pragma once

#include <dlfcn.h>

#include <cstdlib>

#include "device_bench.h"
#include "hal/base/rotation.h"

namespace stylet::hal {

// Vendor axis i is our axis permutation[i].
struct Axes {
  std::array<std::size_t, 3> permutation;
  double unit_m;
};

class VendorBench : public Bench {
 public:
  VendorBench(const char* variable, const char* library, const char* uri_text, Axes axes,
              int unit_number)
      : uri_(uri_text), axes_(axes), unit_(unit_number) {
    loses = false;  // USB and FireWire keep a sample's time
    setenv(variable, library, 1);
    void* loaded = dlopen(library, RTLD_NOW | RTLD_NODELETE);
    EXPECT_NE(loaded, nullptr) << dlerror();
    standin_ = reinterpret_cast<test::StandInOf>(dlsym(loaded, "standin"));
    move({{}, {1, 0, 0, 0}});
    press(0);
    trouble(test::Trouble::kNone);
    standin_(unit_)->hand_kg = 0;
    refuse_watchdog(false);
    hang(test::Hang::kNone);
    for (auto& v : standin_(unit_)->velocity) v = 0;
  }
  std::string uri() const override { return uri_; }

  void move(const Pose& pose) override {
    test::StandIn& unit = *standin_(unit_);
    const std::array p = {pose.position_m.x, pose.position_m.y, pose.position_m.z};
    const std::array<Vec3, 3> columns = {rotate(pose.rotation, {1, 0, 0}),
                                         rotate(pose.rotation, {0, 1, 0}),
                                         rotate(pose.rotation, {0, 0, 1})};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t ours = axes_.permutation[i];
      unit.position[i] = static_cast<double>(p[ours]) / axes_.unit_m;
      for (std::size_t j = 0; j < 3; ++j) {
        const Vec3& c = columns[axes_.permutation[j]];
        unit.rotation[3 * i + j] = static_cast<double>(std::array{c.x, c.y, c.z}[ours]);
      }
    }
  }
  void press(std::uint32_t mask) override { standin_(unit_)->buttons = mask; }
  void trouble(test::Trouble trouble) override { standin_(unit_)->trouble = trouble; }
  void refuse_watchdog(bool refused) override { standin_(unit_)->refuses_watchdog = refused; }
  void hang(test::Hang call) override { standin_(unit_)->hangs = call; }
  Vec3 felt() override { return ours(standin_(unit_)->force); }
  int writes() override { return standin_(unit_)->writes; }
  Vec3 felt_torque() override { return ours(standin_(unit_)->torque); }

 private:
  Vec3 ours(const std::atomic<double> (&vendors)[3]) const {
    std::array<float, 3> turned = {};
    for (std::size_t i = 0; i < 3; ++i) {
      turned[axes_.permutation[i]] = static_cast<float>(vendors[i].load());
    }
    return {turned[0], turned[1], turned[2]};
  }

  std::string uri_;
  Axes axes_;
  int unit_;
  test::StandInOf standin_ = nullptr;
};

constexpr Axes kOurs = {{0, 1, 2}, 1e-3};    // x right, y up, z toward the user, in mm
constexpr Axes kUserFirst = {{2, 0, 1}, 1};  // x toward the user, y right, z up, in m

}  // namespace stylet::hal
