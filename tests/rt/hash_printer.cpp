// SPDX-License-Identifier: Apache-2.0
// Prints the state's hash after every hundred ticks of the script, in both modes, for the lattice
// step of each instruction set this processor has. determinism.py compares what different compilers
// make of it.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "session.h"
#include "variants.h"

namespace stylet::test {
namespace {

void print_hashes(const Organ& organ, Mode mode, const Variant& variant, std::uint64_t ticks) {
  const Config config = config_of(mode);
  const Script script = block_script(organ, config);
  Session session = make_session(organ, config);
  session.kernel.step = variant.step;
  for (std::uint64_t i = 0; i < ticks; i += 100) {
    run(session.kernel, script, i, 100);
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
  for (const test::Variant& variant : test::variants_here()) {
    for (const Mode mode : {Mode::kPhysical, Mode::kPaper}) {
      test::print_hashes(opened->organ, mode, variant, ticks);
    }
  }
  return 0;
}
