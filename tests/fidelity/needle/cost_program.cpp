// SPDX-License-Identifier: Apache-2.0
// Solves one case of the needle for some ticks and prints a hash of all directions it went through.
// cost.py counts its instructions; comparing the hash between builds compares their arithmetic.
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "rig.h"

namespace stylet::test {
namespace {

// Random numbers in [-1, 1) that are the same with every library.
struct Draw {
  std::uint64_t state = 88172645463325252U;
  double next() {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    return static_cast<double>(state >> 11U) * 0x1p-52 - 1;
  }
  Vec3d within(double size) {
    const double x = next(), y = next();
    return size * Vec3d{x, y, next()};
  }
};

void load(Needle& n, const char* name, Draw& draw, int tick) {
  const bool tissue = std::strcmp(name, "tissue") == 0;
  const bool buckled = std::strcmp(name, "buckled") == 0;
  const bool thrown = std::strcmp(name, "thrown") == 0;
  if (tissue && tick > 0) return;
  n.loads.count = 0;
  if (buckled) n.push(n.length_m, {1e-3, 0, 30});
  while (n.loads.count < kMaxRodLoads && (tissue || thrown)) {
    const double arc = n.length_m * (0.5 + 0.5 * draw.next());
    const double size = thrown ? 0.5 : 0.005;
    n.hold(arc, draw.within(size) - Vec3d{0, 0, arc}, (thrown ? 1e4 : 10) * kIsotropic);
    n.loads.load[n.loads.count - 1].force_n = draw.within(thrown ? 30 : 0.02);
  }
  if (thrown) n.handle = {{draw.next(), draw.next(), draw.next(), 1.5}};
}

std::uint64_t run(const char* name, std::uint32_t rods, int ticks) {
  Draw draw;
  const auto n = needle(rods, 0.12, 6.425e-4);
  std::uint64_t hash = 14695981039346656037U;
  for (int tick = 0; tick < ticks; ++tick) {
    load(*n, name, draw, tick);
    n->tick();
    for (std::uint32_t j = 0; j < rods; ++j) {
      const Vec3d t = n->shape.direction[j];
      for (const double value : {t.x, t.y, t.z}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211U;
      }
    }
  }
  return hash;
}

}  // namespace
}  // namespace stylet::test

// usage: needle_cost rest|tissue|buckled|thrown RODS TICKS
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const auto rods = static_cast<std::uint32_t>(std::atoi(argv[2]));
  if (rods < 1 || rods > stylet::kMaxRods) return 2;
  std::printf("%016" PRIx64 "\n", stylet::test::run(argv[1], rods, std::atoi(argv[3])));
  return 0;
}
