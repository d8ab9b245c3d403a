// SPDX-License-Identifier: Apache-2.0
// Counts the instructions of chosen ticks of a recording. Run twice with the same arguments: alone
// it replays the recording and saves the state before each window; under callgrind it starts from
// those states and leaves a dump of costs for each tick, nothing but the tick collected. costs.py
// does both.
//
// usage: stylet_tick_costs RECORDING FOLDER FIRST:LAST...   ticks FIRST to LAST - 1, rising, from 0
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "stylet/hal/instance.h"
#include "stylet/hal/recording.h"
#include "stylet/hal/replay.h"

namespace stylet::test {
namespace {

bool inserted(const std::vector<Output>& outputs) {
  for (const Output& out : outputs) {
    if (out.phase == Phase::kInserted) return true;
  }
  return false;
}

struct Window {
  std::uint64_t first, last;
};

Window window_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  return {std::stoull(text), std::stoull(text.substr(colon + 1))};
}

struct Player {
  hal::RecordingReader recording;
  hal::OrganFile organ;
  Config config;
  hal::KernelInstance instance;
  std::vector<Input> inputs;
  std::vector<Output> outputs;

  explicit Player(const std::string& path)
      : recording(path),
        organ(hal::load_recorded_organ(path, recording.info(), "")),
        config(recording.info().config),
        instance(organ.organ, config, recording.info().obstacles),
        inputs(config.needle_count),
        outputs(config.needle_count) {}

  void load_inputs(std::uint64_t at) {
    std::vector<hal::TickRecord> row(1);
    for (std::uint32_t n = 0; n < config.needle_count; ++n) {
      recording.read(at, row, n);
      inputs[n] = row[0].input;
    }
  }
};

std::string state_path(const std::string& folder, const Window& window) {
  return folder + "/" + std::to_string(window.first) + ".state";
}

void save_states(Player& player, const std::string& folder, const std::vector<Window>& windows) {
  std::uint64_t at = 0;
  std::vector<std::byte> state(snapshot_bytes(player.instance.kernel));
  for (const Window& window : windows) {
    for (; at < window.first; ++at) {
      player.load_inputs(at);
      tick(player.instance.kernel, player.inputs, player.outputs);
    }
    if (snapshot(player.instance.kernel, state) != Status::kOk) std::abort();
    std::ofstream(state_path(folder, window), std::ios::binary)
        .write(reinterpret_cast<const char*>(state.data()),
               static_cast<std::streamsize>(state.size()));
  }
}

void count_windows(Player& player, const std::string& folder, const std::vector<Window>& windows) {
  std::vector<std::byte> state(snapshot_bytes(player.instance.kernel));
  for (const Window& window : windows) {
    std::ifstream(state_path(folder, window), std::ios::binary)
        .read(reinterpret_cast<char*>(state.data()), static_cast<std::streamsize>(state.size()));
    if (restore(player.instance.kernel, state) != Status::kOk) {
      throw std::runtime_error(state_path(folder, window) + ": not a state of this recording");
    }
    for (std::uint64_t at = window.first; at < window.last; ++at) {
      player.load_inputs(at);
      CALLGRIND_ZERO_STATS;
      CALLGRIND_TOGGLE_COLLECT;
      tick(player.instance.kernel, player.inputs, player.outputs);
      CALLGRIND_TOGGLE_COLLECT;
      const std::string what =
          std::to_string(at) + (inserted(player.outputs) ? " inserted" : " other");
      CALLGRIND_DUMP_STATS_AT(what.c_str());
    }
  }
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  if (argc < 4) {
    std::fputs("usage: stylet_tick_costs RECORDING FOLDER FIRST:LAST...\n", stderr);
    return 2;
  }
  try {
    std::vector<Window> windows;
    for (int i = 3; i < argc; ++i) windows.push_back(window_of(argv[i]));
    Player player(argv[1]);
    if (RUNNING_ON_VALGRIND == 0) {
      save_states(player, argv[2], windows);
      std::printf("%llu\n", static_cast<unsigned long long>(player.recording.ticks()));
    } else {
      count_windows(player, argv[2], windows);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stylet_tick_costs: %s\n", error.what());
    return 1;
  }
  return 0;
}
