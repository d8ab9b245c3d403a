// SPDX-License-Identifier: Apache-2.0
// Any bytes as an organ file: refused with a reason, or a hundred ticks of a needle going in keep
// every promise.
#include <algorithm>
#include <cmath>
#include <vector>

#include "promises.h"
#include "session.h"
#include "target.h"

namespace stylet::test {
namespace {

constexpr std::size_t kMostBytes = 4U << 20U;  // a larger kernel is right but slow
constexpr int kTicks = 100;
constexpr float kStepM = 0.5e-3F;

// Along -z through the middle of some triangle, from 1 mm above.
Vec3 start_of(const Organ& organ) {
  const float half = 0.5F * organ.voxel_edge_m;
  Vec3 from = {organ.origin_m.x + half, organ.origin_m.y + half,
               organ.origin_m.z + static_cast<float>(organ.size_z) * organ.voxel_edge_m + 1};
  float distance_m = 1;
  if (!organ_raycast(organ, from, {0, 0, -1}, distance_m)) distance_m = 1;
  promise(std::isfinite(distance_m) && distance_m >= 0, "a ray hits behind its origin");
  from.z -= distance_m - 1e-3F;
  return from;
}

void run_in(const Organ& organ) {
  const Config config;
  Sizes need = {};
  if (sizes(organ, config, need) != Status::kOk) return;
  if (need.model_bytes + need.state_bytes + need.scratch_bytes > kMostBytes) return;
  Session session = make_session(organ, config);
  Vec3 tip = start_of(organ);
  for (int i = 0; i < kTicks; ++i) {
    const Vec3 base = {tip.x, tip.y, tip.z + config.needle[0].length_m};
    const Output out = tick(session.kernel, {{base, {1, 0, 0, 0}}, 1});
    const char* broken = broken_promise(session.kernel, {&out, 1});
    promise(broken == nullptr, broken);
    tip.z -= kStepM;
  }
  std::vector<Vec3> places(organ.vertices.size());
  promise(surface(session.kernel, places) == places.size(), "a vertex of the surface is missing");
  for (const Vec3& place : places) promise(is_finite(place), "a vertex that is not finite");
  const Energy e = energy(session.kernel);
  promise(std::isfinite(e.elastic + e.kinetic + e.coupling), "an energy that is not finite");
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  // A copy of exactly these bytes, aligned: the sanitizer sees one byte too far.
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const std::vector<std::byte> bytes(first, first + size);
  Organ organ;
  OrganRefusal refusal;
  const Status status = organ_open(bytes, organ, &refusal);
  test::promise(status == refusal.status, "status and refusal disagree");
  if (status == Status::kOk) {
    test::run_in(organ);
  } else {
    test::promise(*refusal.place != '\0' && *refusal.expected != '\0', "a refusal without reason");
  }
  return 0;
}
