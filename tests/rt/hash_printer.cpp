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

void print_hashes(const Organ& organ, Setup setup, const Variant& variant, std::uint64_t ticks) {
  const Script script = block_script(organ, config_of(setup));
  Session session = make_session(organ, setup);
  session.kernel.step = variant.step;
  for (std::uint64_t i = 0; i < ticks; i += 100) {
    run(session.kernel, script, i, 100);
    std::printf("%s %s %" PRIu64 " %016" PRIx64 "\n", variant.name, setup_name(setup), i + 100,
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
    for (const test::Setup setup : test::kSetups) {
      test::print_hashes(opened->organ, setup, variant, ticks);
    }
  }
  return 0;
}
