// SPDX-License-Identifier: Apache-2.0
// A needle in an organ on the kernel itself: 20 mm into it from above; prints the state's hash.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <new>
#include <span>
#include <vector>

#include "stylet/kernel.h"

namespace {

std::span<std::byte> block(std::size_t bytes) {
  const std::align_val_t alignment{stylet::kBlockAlignment};
  return {static_cast<std::byte*>(::operator new(bytes, alignment)), bytes};  // until the end
}

// A height rounded to whole 2^-17 m (7.6 um) and lowered by so many: exact in float, so that this
// program moves the needle in the same way however its own arithmetic is compiled.
float on_grid(float place_m, int lowered) {
  constexpr float kPerM = 131072;
  return static_cast<float>(static_cast<int>(place_m * kPerM) - lowered) / kPerM;
}

}  // namespace

int main(int argc, char** argv) {
  std::ifstream file(argc > 1 ? argv[1] : "", std::ios::binary);
  const std::vector<char> text((std::istreambuf_iterator<char>(file)), {});
  stylet::Organ organ;
  if (organ_open(std::as_bytes(std::span(text)), organ) != stylet::Status::kOk) return 1;

  stylet::Config config;
  config.needle[0].bending_nm2 = 0.02F;
  stylet::Sizes need = {};
  if (sizes(organ, config, need) != stylet::Status::kOk) return 1;
  const stylet::Memory memory = {block(need.model_bytes), block(need.state_bytes),
                                 block(need.scratch_bytes)};
  stylet::Kernel kernel;
  if (create(organ, config, memory, kernel) != stylet::Status::kOk) return 1;

  // Through the middle of the lattice, from 1 mm above the skin.
  const float edge = organ.voxel_edge_m;
  stylet::Vec3 at = {organ.origin_m.x + edge * static_cast<float>(organ.size_x) / 2,
                     organ.origin_m.y + edge * static_cast<float>(organ.size_y) / 2,
                     organ.origin_m.z + 1};
  float to_skin_m = 1;
  (void)organ_raycast(organ, at, {0, 0, -1}, to_skin_m);
  at.z += 1e-3F + config.needle[0].length_m - to_skin_m;
  for (int i = 0; i <= 2100; ++i) {
    const stylet::Vec3 handle = {on_grid(at.x, 0), on_grid(at.y, 0), on_grid(at.z, i)};
    (void)tick(kernel, stylet::Input{{handle, {1, 0, 0, 0}}, 1});
  }
  std::printf("state %016llx\n", static_cast<unsigned long long>(hash(kernel)));
}
