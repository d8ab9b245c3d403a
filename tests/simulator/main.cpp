// SPDX-License-Identifier: Apache-2.0
// Plays random sessions until there are enough ticks, or the one session of a seed. usage:
// stylet-simulator [--seed FIRST] [--sessions COUNT | --ticks TICKS] [--each] [--added-mass]
// [--procedures] [--stiffening] [--toughness] [--membranes] [--sliding]
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "simulator.h"

namespace {

using stylet::test::Scenario;
using stylet::test::Verdict;

struct Options {
  std::uint64_t seed = 1;
  std::uint64_t sessions = 1;
  std::uint64_t ticks = 0;
  bool each = false;
  bool added_mass = false;
  bool procedures = false;
  stylet::test::Further further;
};

std::uint64_t number(const char* text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), value);
  if (error != std::errc{} || *end != '\0') {
    std::fprintf(stderr, "'%s': expected a whole number\n", text);
    std::exit(2);
  }
  return value;
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--each") {
      options.each = true;
    } else if (name == "--added-mass") {
      options.added_mass = true;
    } else if (name == "--procedures") {
      options.procedures = true;
    } else if (name == "--stiffening") {
      options.further.stiffening = true;
    } else if (name == "--toughness") {
      options.further.toughness = true;
    } else if (name == "--membranes") {
      options.further.membranes = true;
    } else if (name == "--sliding") {
      options.further.sliding = true;
    } else if (i + 1 < argc && name == "--seed") {
      options.seed = number(argv[++i]);
    } else if (i + 1 < argc && name == "--sessions") {
      options.sessions = number(argv[++i]);
    } else if (i + 1 < argc && name == "--ticks") {
      options.ticks = number(argv[++i]);
    } else {
      std::fprintf(stderr,
                   "%s: expected --seed N, --sessions N, --ticks N, --each, "
                   "--added-mass, --procedures, --stiffening, "
                   "--toughness, --membranes or --sliding\n",
                   argv[i]);
      std::exit(2);
    }
  }
  if (options.ticks > 0) options.sessions = std::numeric_limits<std::uint64_t>::max();
  return options;
}

void describe(const Verdict& v, std::uint64_t seed) {
  std::printf(
      "seed %llu: %llu ticks, observer %.3g J, %u faults, rest after %.1f s, "
      "busiest tick %llu (%u particles and contacts), dearest tick %llu (at most %llu "
      "instructions)\n",
      static_cast<unsigned long long>(seed), static_cast<unsigned long long>(v.ticks),
      v.observer_min_j, v.faults, v.rest_s, static_cast<unsigned long long>(v.busiest_tick),
      v.busiest_load, static_cast<unsigned long long>(v.dearest_tick),
      static_cast<unsigned long long>(v.dearest_bound));
}

int report_failure(const Verdict& v, const Options& options, std::uint64_t seed,
                   const char* program) {
  std::printf("seed %llu, tick %llu: %s (observer %.3g J)\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(v.tick), v.broken, v.observer_min_j);
  std::printf(
      "again: %s --seed %llu%s%s%s%s%s%s\nat commit: ", program,
      static_cast<unsigned long long>(seed), options.added_mass ? " --added-mass" : "",
      options.procedures ? " --procedures" : "", options.further.stiffening ? " --stiffening" : "",
      options.further.toughness ? " --toughness" : "",
      options.further.membranes ? " --membranes" : "", options.further.sliding ? " --sliding" : "");
  std::fflush(stdout);
  if (std::system("git -C " STYLET_SOURCE " describe --always --dirty") != 0) std::printf("?\n");
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  Verdict most;
  std::uint64_t done = 0, ticks = 0, observed = 0, busiest_seed = 0, touched = 0, went_in = 0;
  std::uint64_t dearest = 0;
  while (done < options.sessions && (options.ticks == 0 || ticks < options.ticks)) {
    const std::uint64_t seed = options.seed + done++;
    Scenario scenario = options.procedures ? stylet::test::draw_procedure(seed, options.further)
                                           : stylet::test::draw_scenario(seed, options.further);
    if (options.added_mass) scenario.config.inertia = stylet::Inertia::kAddedMass;
    const Verdict v = stylet::test::simulate(scenario);
    if (options.each) describe(v, seed);
    if (v.broken != nullptr) return report_failure(v, options, seed, argv[0]);
    ticks += v.ticks;
    observed += v.observed_ticks;
    went_in += v.busiest_load > 1 ? 1 : 0;
    touched += v.touches_max > 0 ? 1 : 0;
    dearest = std::max(dearest, v.dearest_bound);
    if (v.busiest_load > most.busiest_load) {
      most = v;
      busiest_seed = seed;
    }
  }
  std::printf(
      "%llu sessions, %llu ticks, every promise held (energy observed in %.1f %% of them)\n",
      static_cast<unsigned long long>(done), static_cast<unsigned long long>(ticks),
      100 * static_cast<double>(observed) / static_cast<double>(ticks));
  std::printf("%llu with more than one particle or contact, %llu that met an obstacle\n",
              static_cast<unsigned long long>(went_in), static_cast<unsigned long long>(touched));
  std::printf("dearest tick of all: at most %llu instructions\n",
              static_cast<unsigned long long>(dearest));
  std::printf("busiest: ");
  describe(most, busiest_seed);
  return 0;
}
