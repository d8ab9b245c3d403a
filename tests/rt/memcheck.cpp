// SPDX-License-Identifier: Apache-2.0
// A program that embeds the kernel, in memory that nobody has written to, for valgrind's memcheck,
// which must find nothing that depends on such memory. Each setup runs from create to the middle of
// an insertion, with a snapshot restored on the way.
#include <cstdio>
#include <vector>

#include "session.h"

namespace {

using namespace stylet;
using namespace stylet::test;

constexpr std::uint64_t kTicks = 1300;  // contact, puncture, the first particles

// As make_block, but with undefined content.
Block raw_block(std::size_t size) {
  Block block;
  block.bytes.reset(
      static_cast<std::byte*>(::operator new (size, std::align_val_t{kBlockAlignment})));
  block.size = size;
  return block;
}

bool embed(const Organ& organ, Setup setup) {
  const Config config = config_of(setup);
  Sizes need = {};
  if (sizes(organ, config, need) != Status::kOk) return false;
  const Block model = raw_block(need.model_bytes), state = raw_block(need.state_bytes),
              scratch = raw_block(need.scratch_bytes);
  Kernel kernel;
  if (create(organ, config, {model.span(), state.span(), scratch.span()}, kernel) != Status::kOk ||
      set_obstacles(kernel, obstacles_of(organ, setup)) != Status::kOk) {
    return false;
  }
  const Block team = raw_block(team_bytes(kernel, 1));
  if (set_team(kernel, 1, team.span()) != Status::kOk) return false;
  std::vector<std::byte> saved(snapshot_bytes(kernel));
  const Script script = block_script(organ, config);
  for (std::uint64_t i = 0; i < kTicks; ++i) {
    const Output out = tick(kernel, scripted_input(script, i));
    if (!(out.force_n.z > -1e6F && out.force_n.z < 1e6F)) return false;  // so that memcheck notices
    if (i == kTicks / 2 && snapshot(kernel, saved) != Status::kOk) return false;
    if (i == kTicks / 2 + 9 && restore(kernel, saved) != Status::kOk) return false;
  }
  const Energy e = energy(kernel);
  return e.elastic >= 0 && stats(kernel).constraint_particles.used > 0 && hash(kernel) != 0;
}

}  // namespace

int main() {
  const auto opened = block_organ(6, 5, 8);
  for (const Setup setup : kSetups) {
    if (!embed(opened->organ, setup)) {
      std::printf("%s: not as expected\n", setup_name(setup));
      return 1;
    }
  }
  std::puts("as expected");
  return 0;
}
