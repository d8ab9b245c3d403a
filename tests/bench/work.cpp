// SPDX-License-Identifier: Apache-2.0
// One step of the tissue or one tick, in a state the arguments choose, for callgrind to count: it
// counts what lies between the two marks and nothing else. Prints what the counts are to be set
// against. growth.py calls it.
#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "liver.h"
#include "variants.h"

namespace stylet::test {
namespace {

enum class Hand { kAway, kQuiet, kViolent };

struct Work {
  std::size_t voxels = 1000;
  float unit_m = 5e-3F;
  std::uint32_t rods = 0;  // 0: rigid
  Hand hand = Hand::kQuiet;
  bool tick = false;
};

// Sideways and back by 5 mm each tick: as fast as the kernel lets a hand be.
Input shaken(const Script& script, std::uint64_t at, Hand hand) {
  Input input = scripted_input(script, at);
  if (hand == Hand::kViolent) input.handle.position_m.x += at % 2 == 0 ? 5e-3F : -5e-3F;
  return input;
}

int count(const Work& work) {
  const auto opened = liver_organ(work.voxels);
  Config config = config_of(work.rods > 0 ? Setup::kElastic : Setup::kPhysical);
  config.needle[0].unit_m = work.unit_m;
  if (work.rods > 0) config.needle[0].rods = work.rods;
  const Script script = script_for(opened->organ, config);
  Session session = make_session(opened->organ, config);
  session.kernel.step = variants_here()[1].step;  // AVX2: what callgrind can run
  std::uint64_t at = 0;
  const std::uint64_t end = work.hand == Hand::kAway ? 10 : kPauseBegin + 1;
  for (; at < end; ++at) {
    const bool shake = at + 20 > end;
    tick(session.kernel, shaken(script, at, shake ? work.hand : Hand::kQuiet));
  }
  const Input input = shaken(script, at, work.hand);
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_TOGGLE_COLLECT;
  if (work.tick) {
    tick(session.kernel, input);
  } else {
    session.kernel.step(session.kernel);
  }
  CALLGRIND_TOGGLE_COLLECT;
  const Stats after = stats(session.kernel);
  std::printf("voxels=%u cps=%u coupled=%u rods=%u triangles=%zu\n", opened->organ.voxel_count,
              after.constraint_particles.used, after.coupled_voxels.used, work.rods,
              opened->organ.triangles.size());
  return 0;
}

}  // namespace
}  // namespace stylet::test

// usage: stylet-work VOXELS UNIT_MM RODS away|quiet|violent step|tick
int main(int argc, char** argv) {
  using namespace stylet::test;
  if (argc != 6 || variants_here().size() < 2) return 2;
  const std::string_view hand = argv[4];
  Work work;
  work.voxels = std::strtoul(argv[1], nullptr, 10);
  work.unit_m = std::strtof(argv[2], nullptr) * 1e-3F;
  work.rods = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  work.hand = hand == "away" ? Hand::kAway : hand == "violent" ? Hand::kViolent : Hand::kQuiet;
  work.tick = std::string_view(argv[5]) == "tick";
  return count(work);
}
