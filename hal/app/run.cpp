// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "hal/app/commands.h"
#include "hal/app/fault_desk.h"
#include "hal/app/report.h"
#include "hal/app/session.h"
#include "hal/app/stop_signal.h"
#include "hal/app/terminal.h"
#include "hal/base/output_file.h"
#include "hal/record/replay.h"
#include "stylet/levels.h"

namespace stylet::app {
namespace {

// Names of the hands, by which faults are told.
std::vector<std::string> hand_names(const Session& s) {
  std::vector<std::string> names;
  for (const hal::Hand& hand : s.scene.hands) {
    names.push_back(hand.device == "attached" ? hand.uri : fmt::format("needle {}", names.size()));
  }
  return names;
}

// In virtual time nobody could respond: the report tells of the faults.
void show_progress(Session& s, Attempt& a) {
  const bool show = terminal_rewrites_lines() && !s.options.json;
  FaultDesk desk(a.state.mailbox, hand_names(s), s.devices);
  while (!a.done.load()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(s.options.fast ? 20 : 100));
    if (!s.options.fast) desk.look();
    watch_processes(s, &a);
    if (!show) continue;
    const double ticks = static_cast<double>(a.recorder->records().pushed() / s.sources.size());
    const double all = static_cast<double>(s.config.ticks);
    const double period_s = static_cast<double>(s.scene.config.period_s);
    rewrite_line(s.open_end ? fmt::format("{:6.2f} s, Ctrl-C ends it", ticks * period_s)
                            : fmt::format("{:6.2f} of {:.2f} s  {:3.0f} %", ticks * period_s,
                                          all * period_s, 100 * ticks / all));
  }
  if (show) rewrite_line("");
}

std::string hands_name(const Session& s) {
  std::string all;
  for (const hal::Hand& hand : s.scene.hands) {
    all += all.empty() ? "" : " and ";
    all += hand.device == "replay"     ? "a recorded hand"
           : hand.device == "steered"  ? "a hand that steers"
           : hand.device == "attached" ? hand.uri
                                       : "a simulated hand";
  }
  return all;
}

std::string edges_mm(const Organ& organ) {
  const double coarse_mm = static_cast<double>(organ.voxel_edge_m) * 1e3;
  const double fine_mm = coarse_mm * static_cast<double>(edge_ratio(organ.levels - 1U));
  return organ.levels > 1 ? fmt::format("{:g} to {:g}", coarse_mm, fine_mm)
                          : fmt::format("{:g}", coarse_mm);
}

void announce(const Session& s) {
  if (s.options.json) return;
  const double length_s =
      static_cast<double>(s.config.ticks) * static_cast<double>(s.scene.config.period_s);
  fmt::print(
      "{} in {} mode, organ \"{}\": {} voxels of {} mm; {} of {} at {:g} us a tick, "
      "{}\n\n",
      s.scene.file, mode_name(s), s.organ->organ.name, s.organ->organ.voxel_count,
      edges_mm(s.organ->organ), s.open_end ? "until Ctrl-C" : fmt::format("{:.2f} s", length_s),
      hands_name(s), static_cast<double>(s.config.period_ns) * 1e-3,
      s.options.fast ? "virtual clock" : "real time");
  for (const std::string& each : s.fits) fmt::print("{}\n", each);
  if (!s.fits.empty()) fmt::print("\n");
  std::fflush(stdout);
}

// A recording cannot be made again, so an existing one stays unless the user says otherwise.
void name_recording(const RunOptions& options, const std::string& wanted, Attempt& a) {
  if (wanted.empty()) return;
  a.recording_name = {wanted, options.force ? hal::Naming::kReplace : hal::Naming::kKeep};
  a.recording = hal::free_name(a.recording_name);
  if (a.recording != wanted) {
    fmt::print(stderr, "stylet: {} exists and is kept: this recording is {} (--force overwrites)\n",
               wanted, a.recording);
  }
}

}  // namespace

int run(const RunOptions& options) {
  hal::HostState host;
  const auto session = std::make_unique<Session>(options, host);
  const auto attempt = std::make_unique<Attempt>();
  Session& s = *session;
  Attempt& a = *attempt;
  const StopOnSignal stop_on_signal(a.state.stop);  // before the first device is open
  load(s);
  const std::string record = hal::checked_output(options.record, files_of(s));
  open_devices(s);
  if (!options.fast) hal::prepare_process(host);
  name_recording(options, record, a);
  prepare(s, a, nullptr);
  announce(s);
  start(s, a);
  show_progress(s, a);
  finish(s, a);
  RunReport report = report_of(s, a);
  // Completes the recording first, because a driver may hang while its device is closed.
  const std::string record_error = finish_recording(a, report);
  s.close_devices();
  if (!tell_of_host(s, a.host_fit)) return kExitHostUnfit;
  report.resonance = resonance_of(s);
  fmt::print("{}", options.json ? json_text(report) : human_text(report));
  if (!record_error.empty()) throw hal::RecordingError(record_error);
  return tell_of_trouble(s, a) ? kExitTrouble : kExitOk;
}

int replay_recording(const ReplayOptions& options) {
  const hal::RecordingReader recording(options.recording);
  const hal::RecordingInfo& info = recording.info();
  const hal::OrganFile organ = hal::load_recorded_organ(options.recording, info, options.organ);
  if (info.lost_records > 0) {
    throw hal::RecordingError(fmt::format("{}: lost_records: {}: expected a recording without gaps",
                                          options.recording, info.lost_records));
  }
  hal::KernelInstance instance(organ.organ, info.config, info.obstacles);
  const bool show = terminal_rewrites_lines();
  const auto progress = [&](std::uint64_t ticks) {
    if (show) rewrite_line(fmt::format("{} of {} ticks", ticks, recording.ticks()));
  };
  const hal::ReplayResult result = hal::replay(recording, instance.kernel, progress);
  if (show) rewrite_line("");
  if (options.json) {
    fmt::print("{}\n", replay_json(options.recording, result, info.unfinished));
    return result.same ? kExitOk : kExitTrouble;
  }
  if (result.same) {
    fmt::print("same bits: {} ticks, state hash {:016x}{}\n", result.ticks, result.state_hash,
               info.unfinished
                   ? " (the recording was not finished: compared up to its last whole block)"
                   : "");
    return kExitOk;
  }
  fmt::print("differs: tick {}, {}: recorded {}, replayed {}\n", result.tick, result.field,
             result.recorded, result.replayed);
  return kExitTrouble;
}

}  // namespace stylet::app
