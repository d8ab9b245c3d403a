// SPDX-License-Identifier: Apache-2.0
// The stand-ins of vendors' libraries, with a hand on them.
#include "vendor_bench.h"

namespace stylet::hal {
namespace {

std::unique_ptr<Bench> hd(const char* uri, int unit) {
  return std::make_unique<VendorBench>("STYLET_LIBHD", STYLET_STANDIN_HD, uri, kOurs, unit);
}
std::unique_ptr<Bench> dhd(const char* uri, int unit) {
  const char* other = std::getenv("STYLET_STANDIN_DHD");  // of another version
  return std::make_unique<VendorBench>(
      "STYLET_LIBDHD", other != nullptr ? other : STYLET_STANDIN_DHD_NOW, uri, kUserFirst, unit);
}

// Of the whole arm it uses the motor and the encoder of one axis.
class OneAxis : public VendorBench {
 public:
  OneAxis() : VendorBench("STYLET_LIBHD", STYLET_STANDIN_HD, "hd:", kOurs, 0) {
    places = feels = {false, false, true};
    turns = false;
  }
  void move(const Pose& pose) override {
    VendorBench::move({places.of(pose.position_m), {1, 0, 0, 0}});
  }
  Vec3 felt() override { return feels.of(VendorBench::felt()); }
};

}  // namespace

std::unique_ptr<Bench> one_axis_bench() {
  return std::make_unique<OneAxis>();
}
std::unique_ptr<Bench> hd_bench() {
  return hd("hd:", 0);
}
std::unique_ptr<Bench> dhd_bench() {
  return dhd("dhd:0", 0);
}
std::unique_ptr<Bench> hd_bench_of(int unit) {
  return hd(unit == 0 ? "hd:Left" : "hd:Right", unit);
}
std::unique_ptr<Bench> dhd_bench_of(int unit) {
  return dhd(unit == 0 ? "dhd:0" : "dhd:1", unit);
}

}  // namespace stylet::hal
