// SPDX-License-Identifier: Apache-2.0
// Counts the instructions of chosen ticks of a recording, or of the worst case (worst_case.h). It
// is run twice with the same arguments. The first time, by itself, it plays and saves the state
// before each window. The second time, under callgrind, it starts from those states and leaves, for
// each tick, a dump of the costs of this tick alone, and what the tick may cost by tick_work.h.
// costs.py does both.
//
// usage: stylet_tick_costs RECORDING|worst FOLDER FIRST:LAST...   ticks FIRST to LAST - 1, rising
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/loop/instance.h"
#include "hal/record/organ_file.h"
#include "hal/record/recording.h"
#include "hal/record/replay.h"
#include "state/attachment.h"
#include "tick_work.h"
#include "worst_case.h"

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

// A kernel and the motion of its needles.
struct Player {
  std::unique_ptr<hal::KernelInstance> instance;
  std::vector<Input> inputs;
  std::vector<Output> outputs;

  Player() = default;
  virtual ~Player() = default;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  virtual std::uint64_t ticks() const = 0;
  virtual void load_inputs(std::uint64_t at) = 0;

  void make(const Organ& organ, const Config& config, std::span<const ObstacleConfig> obstacles) {
    instance = std::make_unique<hal::KernelInstance>(organ, config, obstacles);
    inputs.resize(config.needle_count);
    outputs.resize(config.needle_count);
  }
};

struct RecordedPlayer : Player {
  hal::RecordingReader recording;
  hal::OrganFile organ;

  explicit RecordedPlayer(const std::string& path)
      : recording(path), organ(hal::load_recorded_organ(path, recording.info(), "")) {
    make(organ.organ, recording.info().config, recording.info().obstacles);
  }
  std::uint64_t ticks() const override { return recording.ticks(); }
  void load_inputs(std::uint64_t at) override {
    std::vector<hal::TickRecord> row(1);
    for (std::uint32_t n = 0; n < inputs.size(); ++n) {
      recording.read(at, row, n);
      inputs[n] = row[0].input;
    }
  }
};

struct WorstPlayer : Player {
  WorstCase worst = worst_case();

  WorstPlayer() { make(worst.organ->organ, worst.config, worst.obstacles); }
  std::uint64_t ticks() const override { return kWorstTicks; }
  void load_inputs(std::uint64_t at) override { worst_inputs(worst, at, inputs); }
};

std::string state_path(const std::string& folder, const Window& window) {
  return folder + "/" + std::to_string(window.first) + ".state";
}

void save_states(Player& player, const std::string& folder, const std::vector<Window>& windows) {
  Kernel& kernel = player.instance->kernel;
  std::uint64_t at = 0;
  std::vector<std::byte> state(snapshot_bytes(kernel));
  for (const Window& window : windows) {
    for (; at < window.first; ++at) {
      player.load_inputs(at);
      tick(kernel, player.inputs, player.outputs);
    }
    if (snapshot(kernel, state) != Status::kOk) std::abort();
    std::ofstream(state_path(folder, window), std::ios::binary)
        .write(reinterpret_cast<const char*>(state.data()),
               static_cast<std::streamsize>(state.size()));
  }
}

void count_window(Player& player, const Window& window) {
  Kernel& kernel = player.instance->kernel;
  TickWork work;
  count_work(kernel, {}, work);  // the particles there are before
  for (std::uint64_t at = window.first; at < window.last; ++at) {
    player.load_inputs(at);
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    tick(kernel, player.inputs, player.outputs);
    CALLGRIND_TOGGLE_COLLECT;
    const View view = view_of(kernel);
    count_work(kernel, attachment_shift(view.model, view.state), work);
    char text[80];
    std::snprintf(text, sizeof text, "%llu %s %llu", static_cast<unsigned long long>(at),
                  inserted(player.outputs) ? "inserted" : "other",
                  static_cast<unsigned long long>(bound_of(work.amount)));
    CALLGRIND_DUMP_STATS_AT(text);
  }
}

void count_windows(Player& player, const std::string& folder, const std::vector<Window>& windows) {
  std::vector<std::byte> state(snapshot_bytes(player.instance->kernel));
  for (const Window& window : windows) {
    std::ifstream(state_path(folder, window), std::ios::binary)
        .read(reinterpret_cast<char*>(state.data()), static_cast<std::streamsize>(state.size()));
    if (restore(player.instance->kernel, state) != Status::kOk) {
      throw std::runtime_error(state_path(folder, window) + ": not a state of this recording");
    }
    count_window(player, window);
  }
}

std::unique_ptr<Player> player_of(const std::string& what) {
  if (what == "worst") return std::make_unique<WorstPlayer>();
  return std::make_unique<RecordedPlayer>(what);
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  if (argc < 4) {
    std::fputs("usage: stylet_tick_costs RECORDING|worst FOLDER FIRST:LAST...\n", stderr);
    return 2;
  }
  try {
    std::vector<Window> windows;
    for (int i = 3; i < argc; ++i) windows.push_back(window_of(argv[i]));
    const std::unique_ptr<Player> player = player_of(argv[1]);
    if (RUNNING_ON_VALGRIND == 0) {
      save_states(*player, argv[2], windows);
      std::printf("%llu\n", static_cast<unsigned long long>(player->ticks()));
    } else {
      count_windows(*player, argv[2], windows);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stylet_tick_costs: %s\n", error.what());
    return 1;
  }
  return 0;
}
