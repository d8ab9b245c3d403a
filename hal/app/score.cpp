// SPDX-License-Identifier: Apache-2.0
// Scores of recordings, side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hal/app/commands.h"
#include "hal/app/recorded_score.h"
#include "hal/app/score_text.h"
#include "hal/record/recording.h"
#include "hal/record/replay.h"
#include "hal/scene/scene.h"

namespace stylet::app {

hal::Score score_of(const hal::RecordingReader& recording, std::span<const hal::Target> targets) {
  constexpr std::uint64_t kBlock = 4096;
  const hal::RecordingInfo& info = recording.info();
  hal::Scorer scorer(targets, info.course, static_cast<double>(info.config.period_s));
  std::vector<hal::TickRecord> block;
  for (std::uint32_t needle = 0; needle < info.config.needle_count; ++needle) {
    for (std::uint64_t first = 0; first < recording.ticks(); first += kBlock) {
      block.resize(std::min(kBlock, recording.ticks() - first));
      recording.read(first, block, needle);
      for (hal::TickRecord& record : block) {
        record.needle = needle;
        scorer.add(record);
      }
    }
  }
  std::vector<Event> events;
  for (std::uint64_t first = 0; first < recording.event_count(); first += kBlock) {
    events.resize(std::min(kBlock, recording.event_count() - first));
    recording.read(first, events);
    for (const Event& each : events) scorer.add(each);
  }
  return scorer.score();
}

namespace {

// The organ has the names of the layers; without it, layers have numbers.
std::vector<std::string> recorded_layers(const std::string& path, const hal::RecordingInfo& info,
                                         const std::string& organ) {
  try {
    return layer_names(hal::load_recorded_organ(path, info, organ).organ);
  } catch (const hal::LoadError& error) {
    if (!organ.empty()) throw;
    fmt::print(stderr, "stylet: note: layers have numbers instead of names: {}\n", error.what());
    return {};
  }
}

ScoredRecording attempt_of(const std::string& path, const ScoreOptions& options) {
  const hal::RecordingReader recording(path);
  const hal::RecordingInfo& info = recording.info();
  ScoredRecording attempt;
  attempt.name = std::filesystem::path(path).filename().string();
  attempt.targets = options.scene.empty() ? hal::parse_targets(info.scene_text, info.scene_file)
                                          : hal::read_scene(options.scene).targets;
  attempt.layers = recorded_layers(path, info, options.organ);
  attempt.score = score_of(recording, attempt.targets);
  if (info.lost_records > 0) {
    fmt::print(stderr,
               "stylet: note: {}: {} ticks were not recorded and do not count in the score\n", path,
               info.lost_records);
  }
  return attempt;
}

}  // namespace

int score(const ScoreOptions& options) {
  std::vector<ScoredRecording> attempts;
  for (const std::string& each : options.recordings) attempts.push_back(attempt_of(each, options));
  if (!options.json) {
    fmt::print("{}", score_table(attempts));
    return kExitOk;
  }
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    out.push_back({{"recording", options.recordings[i]}, {"score", score_json(attempts[i])}});
  }
  using Json = nlohmann::ordered_json;
  fmt::print("{}\n", out.dump(2, ' ', false, Json::error_handler_t::replace));
  return kExitOk;
}

}  // namespace stylet::app
