// SPDX-License-Identifier: Apache-2.0
// Any bytes as an organ file. They are refused with a reason, or a hundred ticks of an insertion
// keep every promise, with memory proportional to the number of voxels. Bytes that begin with
// "sparse" describe runs of voxels far apart, which damaged files hardly ever contain.
#include <algorithm>
#include <cmath>
#include <vector>

#include "promises.h"
#include "session.h"
#include "sparse_organ.h"
#include "stylet/limits.h"
#include "target.h"
#include "lattice/voxel.h"

namespace stylet::test {
namespace {

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

std::uint64_t total(const Sizes& s) {
  return std::uint64_t{s.model_bytes} + s.state_bytes + s.scratch_bytes;
}

std::uint64_t bytes_of_one_voxel() {
  const auto one = open_organ(organ_of_runs({format::Run(0, 0, 0, 1)}));
  Sizes need = {};
  promise(sizes(one->organ, Config{}, need) == Status::kOk, "no sizes of one voxel");
  return total(need);
}

void run_in(const Organ& organ, Vec3 tip) {
  static const std::uint64_t kFixed = bytes_of_one_voxel();
  const Config config;
  Sizes need = {};
  promise(sizes(organ, config, need) == Status::kOk, "no sizes of an organ that opens");
  promise(total(need) <= kFixed + std::uint64_t{kMaxBytesPerVoxel} * organ.voxel_count,
          "more memory than its voxels explain");
  Session session = make_session(organ, config);
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

// ---- voxels far apart ---------------------------------------------------------------------------

constexpr std::string_view kSparse = "sparse";
constexpr std::uint32_t kMostVoxels = 4000;

// One byte says where the next run lies (in the same row, the next row or another plane), how many
// bytes its distance takes, and its length; one or two more bytes are the distance.
std::vector<format::Run> draw_runs(Bytes in) {
  std::vector<format::Run> runs;
  std::uint32_t x = 0, y = 0, z = 0, most_y = 0, voxels = 0;
  while (!in.empty() && voxels < kMostVoxels) {
    const std::uint8_t op = in.byte();
    std::uint32_t way = in.byte();
    if ((op & 4U) != 0) way = 256 * way + in.byte();
    const std::uint32_t count = (op & 8U) != 0 ? 1 : 1 + (op >> 4U) * 5;
    const std::uint32_t where = op & 3U;
    if (where == 1) y += 1 + way;
    if (where == 2) z += 1 + way;
    if (where == 2) y = in.byte();
    x = where == 1 || where == 2 ? in.byte() : x + 1 + way;
    most_y = std::max(most_y, y);
    const std::uint64_t rows = std::uint64_t{most_y + 1} * (z + 1);
    if (x + count > 65535 || y > 65534 || z > 65534 || rows > kMaxRows) break;
    runs.emplace_back(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                      static_cast<std::uint16_t>(z), static_cast<std::uint16_t>(count));
    x += count;
    voxels += count;
  }
  return runs;
}

void run_sparse(Bytes in) {
  const std::uint32_t pick = in.byte();
  const std::vector<format::Run> runs = draw_runs(in);
  if (runs.empty()) return;
  const std::uint32_t top = pick * voxels_of(runs) / 256;
  const auto opened = open_organ(organ_of_runs(runs, top));
  const SparseCell cell = cell_of_voxel(runs, top);
  const float edge_m = opened->organ.voxel_edge_m;
  run_in(opened->organ,
         edge_m * Vec3{static_cast<float>(cell.x) + 0.4F, static_cast<float>(cell.y) + 0.6F,
                       static_cast<float>(cell.z) + 1.2F});
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  const auto* first = reinterpret_cast<const std::byte*>(data);
  if (size > test::kSparse.size() && std::equal(test::kSparse.begin(), test::kSparse.end(), data)) {
    test::run_sparse({{data + test::kSparse.size(), size - test::kSparse.size()}});
    return 0;
  }
  // A copy of exactly these bytes, aligned, so that the sanitizer sees a read of one byte too many.
  const std::vector<std::byte> bytes(first, first + size);
  Organ organ;
  OrganRefusal refusal;
  const Status status = organ_open(bytes, organ, &refusal);
  test::promise(status == refusal.status, "status and refusal disagree");
  if (status == Status::kOk) {
    test::run_in(organ, test::start_of(organ));
  } else {
    test::promise(*refusal.place != '\0' && *refusal.expected != '\0', "a refusal without reason");
  }
  return 0;
}
