// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "hal/app/commands.h"
#include "hal/app/recorded_score.h"
#include "hal/app/serve.h"
#include "hal/app/stop_signal.h"
#include "hal/console/player.h"
#include "hal/console/server.h"
#include "hal/record/replay.h"
#include "hal/scene/scene.h"

namespace stylet::app {
namespace {

// What the recorded scene says of the needles' devices, as far as it can still be read.
std::vector<hal::Hand> recorded_hands(const hal::RecordingInfo& info) try {
  return hal::parse_scene(info.scene_text, info.scene_file).hands;
} catch (const std::exception&) {
  return {};
}

std::shared_ptr<console::SceneView> view_of(const hal::RecordingReader& recording,
                                            std::shared_ptr<const hal::OrganFile> organ,
                                            std::shared_ptr<hal::Display> display,
                                            const Kernel& kernel) {
  const hal::RecordingInfo& info = recording.info();
  const std::vector<hal::Hand> hands = recorded_hands(info);
  auto view = std::make_shared<console::SceneView>();
  view->scene = std::filesystem::path(info.scene_file).filename().string();
  view->period_s = info.config.period_s;
  view->recording_ticks = recording.ticks();
  view->lattice = console::make_lattice(organ->organ, kernel);
  view->organ = std::move(organ);
  for (std::uint32_t i = 0; i < info.config.needle_count; ++i) {
    const NeedleConfig& needle = info.config.needle[i];
    view->needles.push_back({i < hands.size() ? hands[i].device : "recorded", needle.length_m,
                             needle.outer_radius_m, info.course[i],
                             i < hands.size() ? hands[i].guard.max_force_n : 0});
  }
  view->obstacles = info.obstacles;
  view->targets = hal::parse_targets(info.scene_text, info.scene_file);
  view->display = std::move(display);
  return view;
}

std::string obey(console::Player& player, const console::Order& order) {
  switch (order.verb) {
    case console::Verb::kSeek:
      player.seek(order.tick);
      return "";
    case console::Verb::kPlay:
      player.play(order.speed);
      return "";
    case console::Verb::kMark:
      return "a recording takes no marks";
    default:
      return "this is a recording: seek and play only";
  }
}

}  // namespace

int play_back(const PlaybackOptions& options) {
  const hal::RecordingReader recording(options.recording);
  const hal::RecordingInfo& info = recording.info();
  const auto organ = std::make_shared<const hal::OrganFile>(
      hal::load_recorded_organ(options.recording, info, options.organ));
  if (info.lost_records > 0 || recording.ticks() == 0) {
    throw hal::RecordingError(
        fmt::format("{}: lost_records: {}, ticks: {}: expected a recording without gaps and with "
                    "at least one tick",
                    options.recording, info.lost_records, recording.ticks()));
  }
  const auto curve = console::read_curve(recording);
  const auto targets = hal::parse_targets(info.scene_text, info.scene_file);
  const std::string name = std::filesystem::path(options.recording).filename().string();
  const console::ScoredAttempt attempt = {1, "", "", name, score_of(recording, targets)};
  const hal::KernelInstance rest(organ->organ, info.config, info.obstacles);
  const auto display = std::make_shared<hal::Display>(rest.kernel);
  console::Player player(recording, organ->organ, display);
  console::ServerEvents events;
  events.ordered = [&player](const console::Order& order) { return obey(player, order); };
  console::Server server(server_config(options.serve), std::move(events));
  server.show(curve, recording.marks());
  server.show(view_of(recording, organ, display, rest.kernel));
  server.show(attempt);
  server.show(console::Activity::Playback);
  fmt::print("{}: console at {}\nCtrl-C ends it\n", options.recording, server.url());
  std::fflush(stdout);
  std::atomic<bool> quit{false};
  const StopOnSignal stop_on_signal(quit);
  bool told = false;
  while (!quit.load()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (told || player.differs_at() == 0) continue;
    told = true;
    const std::string note = fmt::format(
        "from tick {} on this program computes other forces than were recorded: forces are shown "
        "as recorded, the tissue as computed",
        player.differs_at());
    fmt::print(stderr, "stylet: {}: {}\n", options.recording, note);
    server.refuse(note);
  }
  return kExitOk;
}

}  // namespace stylet::app
