// SPDX-License-Identifier: Apache-2.0
// Prints the state's hash after every hundred ticks of the script, in both modes, for the lattice
// step of each instruction set this processor has. determinism.py compares what different compilers
// make of it.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "session.h"

namespace stylet {
void lattice_step_baseline(const Kernel& kernel);
#if defined(__x86_64__)
void lattice_step_avx2(const Kernel& kernel);
void lattice_step_avx512(const Kernel& kernel);
#endif
}  // namespace stylet

namespace stylet::test {
namespace {

struct Variant {
  const char* name;
  void (*step)(const Kernel&);
  bool runs_here;
};

std::vector<Variant> variants() {
  std::vector<Variant> all = {{"baseline", lattice_step_baseline, true}};
#if defined(__x86_64__)
  __builtin_cpu_init();
  all.push_back({"avx2", lattice_step_avx2, __builtin_cpu_supports("avx2") != 0});
  all.push_back({"avx512", lattice_step_avx512,
                 __builtin_cpu_supports("avx512f") != 0 &&
                     __builtin_cpu_supports("avx512vl") != 0 &&
                     __builtin_cpu_supports("avx512dq") != 0});
#endif
  return all;
}

void print_hashes(const Organ& organ, Mode mode, const Variant& variant, std::uint64_t ticks) {
  const Config config = config_of(mode);
  Session session = make_session(organ, config);
  session.kernel.step = variant.step;
  for (std::uint64_t i = 0; i < ticks; i += 100) {
    run(session.kernel, config, i, 100);
    std::printf("%s %s %" PRIu64 " %016" PRIx64 "\n", variant.name, mode_name(mode), i + 100,
                hash(session.kernel));
  }
}

}  // namespace
}  // namespace stylet::test

// usage: stylet_hash [TICKS]
int main(int argc, char** argv) {
  using namespace stylet;
  const std::uint64_t ticks = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  const auto opened = test::block_organ(10, 10, 10);
  for (const test::Variant& variant : test::variants()) {
    if (!variant.runs_here) continue;
    for (const Mode mode : {Mode::kPhysical, Mode::kPaper}) {
      test::print_hashes(opened->organ, mode, variant, ticks);
    }
  }
  return 0;
}
