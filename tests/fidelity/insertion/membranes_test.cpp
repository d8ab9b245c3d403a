// SPDX-License-Identifier: Apache-2.0
// Membranes as surfaces of their own (PHYSICS 9.7): each holds the needle's tip where it lies,
// whatever the voxels are, until the tip presses as hard as its tissue says.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr std::uint32_t kGelLayer = 0, kDura = 1, kArachnoid = 2;

struct Chance {
  std::mt19937_64 engine;
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine);
  }
  Vec3 direction() {
    std::normal_distribution<float> normal;
    const Vec3 v = {normal(engine), normal(engine), normal(engine)};
    return (1 / norm(v)) * v;
  }
};

// Two triangles of `half_m` around a place, across a direction.
std::vector<std::array<Vec3, 3>> sheet(Vec3 at_m, Vec3 across, float half_m) {
  const Vec3 n = (1 / norm(across)) * across;
  const Vec3 helper = std::fabs(n.x) < 0.8F ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = (half_m / norm(cross(n, helper))) * cross(n, helper);
  const Vec3 v = cross(n, u);
  const Vec3 a = at_m - u - v, b = at_m + u - v, c = at_m + u + v, d = at_m - u + v;
  return {{a, b, c}, {a, c, d}};
}

TinyOrgan block(float edge_m, float modulus_pa) {
  TinyOrgan tiny;
  tiny.voxel_edge_m = edge_m;
  tiny.nx = tiny.ny = tiny.nz = static_cast<std::uint16_t>(std::ceil(0.05F / edge_m));
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial gel;
  gel.youngs_modulus_pa = modulus_pa;
  gel.puncture_force_n = 0.3F;
  gel.cutting_force_n = 0.15F;
  TinyMaterial dura = gel, arachnoid = gel;
  dura.name = "dura";
  dura.puncture_force_n = 0.9F;
  arachnoid.name = "arachnoid";
  arachnoid.puncture_force_n = 0.5F;
  tiny.materials = {gel, dura, arachnoid};
  return tiny;
}

std::vector<Event> punctures(const Kernel& kernel) {
  std::vector<Event> list(kMaxEvents);
  list.resize(events(kernel, list));
  std::erase_if(list, [](const Event& e) { return e.kind != EventKind::kPuncture; });
  return list;
}

TEST(Membranes, HoldTheTipWhereTheyLie) {
  Chance chance = {std::mt19937_64(41)};
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const float edge_m = chance.between(2.5e-3F, 7e-3F);
    TinyOrgan tiny = block(edge_m, chance.between(3000, 30000));
    const float size_m = edge_m * static_cast<float>(tiny.nx);
    const Vec3 start = {-1e-3F, size_m * chance.between(0.4F, 0.6F),
                        size_m * chance.between(0.4F, 0.6F)};
    const float depth_m = chance.between(8e-3F, 22e-3F);
    Vec3 across = chance.direction();
    across.x = 1;  // at most some 45 degrees
    tiny.membranes = {{kDura, sheet({depth_m, start.y, start.z}, across, 0.02F)}};
    Rig rig = make_rig(tiny, Config{});
    std::size_t seen = 0;
    double held_off_mm = -1;
    drive(rig, start, depth_m + 12e-3F, chance.between(2e-3F, 50e-3F), [&](const Output&) {
      const std::vector<Event> list = punctures(rig.kernel());
      const bool new_one = list.size() != seen;
      seen = list.size();
      const Vec3 off = rig.view().state.tip->rest_m - Vec3{depth_m, start.y, start.z};
      if (new_one && list.back().layer == kDura) {
        printf("%d edge %.2f depth %.2f force %.3f off %.4f mm track %.3f\n", i, double(edge_m) * 1e3,
             double(depth_m) * 1e3, double(list.back().force_n), held_off_mm, double(list.back().depth_m) * 1e3);
        EXPECT_NEAR(static_cast<double>(list.back().force_n), 0.9, 0.05);
      }
      held_off_mm = static_cast<double>(dot(off, across) / norm(across)) * 1e3;
    });
    EXPECT_EQ(seen, 2U);
  }
}

}  // namespace
}  // namespace stylet::test
