// SPDX-License-Identifier: Apache-2.0
// One step of the tissue or one tick, in a state that the arguments choose, for callgrind, which
// counts only what lies between the two marks. If an instruction set is named, the program itself
// counts the step, one instruction after the other, since callgrind does not know AVX-512. Prints
// the amounts against which the counts are plotted. growth.py calls it.
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "state/layout.h"
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
  bool filtered = true;                         // true mass
  std::optional<std::string_view> counted_for;  // instruction set; none: callgrind counts
};

// Sideways and back by 5 mm each tick: as fast as the kernel lets a hand be.
Input shaken(const Script& script, std::uint64_t at, Hand hand) {
  Input input = scripted_input(script, at);
  if (hand == Hand::kViolent) input.handle.position_m.x += at % 2 == 0 ? 5e-3F : -5e-3F;
  return input;
}

// Instructions of a child that makes this call and ends.
template <typename Call>
long stepped(Call call) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(77);  // nobody would wake it
    std::raise(SIGSTOP);
    call();
    _exit(0);
  }
  int status = 0;
  long steps = 0;
  waitpid(child, &status, 0);
  for (; WIFSTOPPED(status); ++steps) {
    if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0) std::exit(77);  // not allowed here
    waitpid(child, &status, 0);
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) std::exit(77);  // nothing was counted
  return steps;
}

const Variant* variant(std::string_view name) {
  static const std::vector<Variant> here = variants_here();
  for (const Variant& one : here) {
    if (name == one.name) return &one;
  }
  return nullptr;
}

int count(const Work& work) {
  const auto opened = liver_organ(work.voxels);
  Config config = config_of(work.rods > 0 ? Setup::kElastic : Setup::kPhysical);
  if (!work.filtered) config.inertia = Inertia::kAddedMass;
  config.needle[0].unit_m = work.unit_m;
  if (work.rods > 0) config.needle[0].rods = work.rods;
  const Script script = script_for(opened->organ, config);
  Session session = make_session(opened->organ, config);
  const Variant* const wanted = variant(work.counted_for.value_or("avx2"));  // callgrind's best
  if (wanted == nullptr) return 77;
  session.kernel.step = wanted->step;
  std::uint64_t at = 0;
  const std::uint64_t end = work.hand == Hand::kAway ? 10 : kPauseBegin + 1;
  for (; at < end; ++at) {
    const bool shake = at + 20 > end;
    tick(session.kernel, shaken(script, at, shake ? work.hand : Hand::kQuiet));
  }
  const Input input = shaken(script, at, work.hand);
  if (work.counted_for) {
    const long all = stepped([&] { session.kernel.step(session.kernel); });
    std::printf("instructions=%ld ", all - stepped([] {}));
  }
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_TOGGLE_COLLECT;
  if (work.tick) {
    tick(session.kernel, input);
  } else {
    session.kernel.step(session.kernel);
  }
  CALLGRIND_TOGGLE_COLLECT;
  std::printf("voxels=%u passes=%u cps=%u coupled=%u rods=%u triangles=%zu\n",
              opened->organ.voxel_count, filter_passes(session.kernel),
              stats(session.kernel).constraint_particles.used,
              view_of(session.kernel).scratch.head->coupled_count, work.rods,
              opened->organ.triangles.size());
  return 0;
}

}  // namespace
}  // namespace stylet::test

// usage: stylet-work VOXELS UNIT_MM RODS away|quiet|violent step|tick|sweep [avx2|avx512] A sweep
// is a step with added mass, so without the filter. Exits with 77 if this machine cannot count so.
int main(int argc, char** argv) {
  using namespace stylet::test;
  if (argc != 6 && argc != 7) return 2;
  const std::string_view hand = argv[4];
  Work work;
  work.voxels = std::strtoul(argv[1], nullptr, 10);
  work.unit_m = std::strtof(argv[2], nullptr) * 1e-3F;
  work.rods = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  work.hand = hand == "away" ? Hand::kAway : hand == "violent" ? Hand::kViolent : Hand::kQuiet;
  work.tick = std::string_view(argv[5]) == "tick";
  work.filtered = std::string_view(argv[5]) != "sweep";
  if (argc == 7) work.counted_for = argv[6];
  return count(work);
}
