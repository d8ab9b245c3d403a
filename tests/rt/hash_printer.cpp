// SPDX-License-Identifier: Apache-2.0
// Prints the state's hash after every hundred ticks of the script, for each setup, for the lattice
// step of each instruction set that this processor has; with helper threads, only of the widest.
// determinism.py compares the hashes of different compilers.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "helper_threads.h"
#include "session.h"
#include "two_parts.h"
#include "variants.h"

namespace stylet::test {
namespace {

void print_hashes(const Organ& organ, Session session, const Config& config, const char* name,
                  const Variant& variant, std::uint64_t ticks, std::uint32_t helpers) {
  const Script script = block_script(organ, config);
  session.kernel.step = variant.step;
  const Block memory = make_block(team_bytes(session.kernel, helpers));
  if (set_team(session.kernel, helpers, memory.span()) != Status::kOk) std::abort();
  const Helpers threads(session.kernel, helpers);
  for (std::uint64_t i = 0; i < ticks; i += 100) {
    run(session.kernel, script, i, 100);
    std::printf("%s %s %" PRIu64 " %016" PRIx64 "\n", variant.name, name, i + 100,
                hash(session.kernel));
  }
}

}  // namespace
}  // namespace stylet::test

// usage: stylet_hash [TICKS [HELPERS]]
int main(int argc, char** argv) {
  using namespace stylet;
  const std::uint64_t ticks = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  const auto helpers =
      argc > 2 ? static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)) : 0;
  const auto opened = test::block_organ(10, 10, 10);
  const auto stiffening = test::block_organ(10, 10, 10, test::kStiffening);
  const auto sliding = test::sliding_organ();
  std::vector<test::Variant> variants = test::variants_here();
  if (helpers > 0) variants = {variants.back()};
  for (const test::Variant& variant : variants) {
    for (const test::Setup setup : test::kSetups) {
      test::print_hashes(opened->organ, test::make_session(opened->organ, setup),
                         test::config_of(setup), setup_name(setup), variant, ticks, helpers);
    }
    const auto print = [&](const Organ& organ, const Config& config, const char* name) {
      test::print_hashes(organ, test::make_session(organ, config), config, name, variant, ticks,
                         helpers);
    };
    print(stiffening->organ, test::stiffening_config(), "stiffening");
    print(sliding->organ, test::sliding_config(), "sliding");
  }
  return 0;
}
