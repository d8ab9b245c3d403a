// SPDX-License-Identifier: Apache-2.0
// The stand-ins of vendors' libraries, with a hand on them.
#include <dlfcn.h>

#include <cstdlib>
#include <numeric>

#include "device_bench.h"
#include "stylet/hal/mapping.h"

namespace stylet::hal {
namespace {

using test::StandIn;
using test::StandInOf;

// Vendor axis i is our axis permutation[i].
struct Axes {
  std::array<std::size_t, 3> permutation;
  double unit_m;
};

class VendorBench : public Bench {
 public:
  VendorBench(const char* variable, const char* library, const char* uri_text, Axes axes)
      : uri_(uri_text), axes_(axes) {
    setenv(variable, library, 1);
    void* loaded = dlopen(library, RTLD_NOW | RTLD_NODELETE);
    EXPECT_NE(loaded, nullptr) << dlerror();
    standin_ = reinterpret_cast<StandInOf>(dlsym(loaded, "standin"));
    move({{}, {1, 0, 0, 0}});
    press(0);
    trouble(test::Trouble::kNone);
    standin_(0)->hand_kg = 0;
    refuse_watchdog(false);
    for (auto& v : standin_(0)->velocity) v = 0;
  }
  std::string uri() const override { return uri_; }

  void move(const Pose& pose) override {
    StandIn& unit = *standin_(0);
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
  void press(std::uint32_t mask) override { standin_(0)->buttons = mask; }
  void trouble(test::Trouble trouble) override { standin_(0)->trouble = trouble; }
  void refuse_watchdog(bool refused) override { standin_(0)->refuses_watchdog = refused; }
  Vec3 felt() override { return ours(standin_(0)->force); }
  int writes() override { return standin_(0)->ticks; }
  Vec3 felt_torque() override { return ours(standin_(0)->torque); }

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
  StandInOf standin_ = nullptr;
};

constexpr Axes kOurs = {{0, 1, 2}, 1e-3};
constexpr Axes kUserFirst = {{2, 0, 1}, 1};  // x toward the user, y right, z up

}  // namespace

std::unique_ptr<Bench> hd_bench() {
  return std::make_unique<VendorBench>("STYLET_LIBHD", STYLET_STANDIN_HD, "hd:", kOurs);
}
std::unique_ptr<Bench> dhd_bench() {
  const char* other = std::getenv("STYLET_STANDIN_DHD");  // of another age
  return std::make_unique<VendorBench>(
      "STYLET_LIBDHD", other != nullptr ? other : STYLET_STANDIN_DHD_NOW, "dhd:0", kUserFirst);
}

}  // namespace stylet::hal
