// SPDX-License-Identifier: Apache-2.0
// The report of a run, for people and for machines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/app/score_text.h"
#include "hal/loop/host.h"
#include "hal/loop/loop.h"
#include "hal/record/replay.h"
#include "hal/score/stages.h"
#include "stylet/kernel.h"
#include "stylet/resonance.h"

namespace stylet::app {

struct RunReport {
  std::string scene_file, organ_file, organ_name, mode, recording;
  std::uint64_t organ_hash = 0, state_hash = 0;
  float voxel_edge_m = 0;    // of the coarsest level
  std::uint32_t levels = 1;  // each has half the edge of the one before
  double period_s = 1e-3;
  bool fast = false, interrupted = false;
  double wall_s = 0;
  std::vector<NeedleConfig> needles;
  std::vector<double> least_received_j;  // of each needle's simulated hand; NaN: it has another
  std::vector<float> most_force_n;       // largest that the guard of each needle lets through
  std::size_t obstacles = 0;
  std::vector<std::vector<hal::StageRow>> stages;  // for each needle
  std::vector<Event> events;
  std::optional<ScoredRecording> score;  // only if the scene has targets
  const hal::LoopState* loop = nullptr;
  hal::ThreadUse thread = {};
  std::uint32_t threads = 1;         // of the tissue step
  std::uint64_t helped_parts = 0;    // parts of the step done by helpers
  std::uint32_t lost_processes = 0;  // processes beside the loop's
  hal::HostReport host;
  Sizes predicted = {}, used = {};
  Stats stats = {};
  Resonance resonance = {};  // set by whoever needs it: takes time, so after recording and devices
};

std::string json_text(const RunReport& report);
std::string human_text(const RunReport& report);

// The result of a replay; `unfinished`: the recording ends with its last whole block.
std::string replay_json(const std::string& recording, const hal::ReplayResult& result,
                        bool unfinished);

}  // namespace stylet::app
