// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <thread>

#include "commands.h"
#include "fault_desk.h"
#include "report.h"
#include "stop_signal.h"
#include "stylet/hal/devices.h"
#include "stylet/hal/helpers.h"
#include "stylet/hal/instance.h"
#include "stylet/hal/recorder.h"
#include "stylet/hal/replay.h"
#include "stylet/hal/replay_device.h"
#include "stylet/hal/scene.h"
#include "terminal.h"

namespace stylet::app {
namespace {

// Eight seconds of all needles at 1 kHz: longer than any disk makes the recorder wait.
constexpr std::size_t kRecordRing = 8192 * kMaxNeedles;
constexpr std::size_t kEventRing = 1024;
constexpr int kWarmUpTicks = 200;
constexpr double kLongestRunS = 86400;

// One needle's start and whoever holds it.
struct Station {
  hal::Placement placement;
  hal::SimulatedHand hand;
  hal::Steered steered;
  hal::ReplayDevice replayed;
};

// Everything of one run, in the order in which it has to exist.
struct Session {
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { close_devices(); }  // however the run ends, no device keeps a force

  void close_devices() {
    for (const hal::Device& device : devices) device.close(device.self);
    devices.clear();
  }

  RunOptions options;
  hal::Scene scene;
  hal::OrganFile organ;
  std::vector<Station> stations;  // of each needle
  std::unique_ptr<hal::KernelInstance> instance;
  std::vector<hal::Device> devices;
  hal::LoopConfig config;
  hal::LoopState state;
  hal::Ring<hal::TickRecord> records{kRecordRing};
  hal::Ring<Event> events{kEventRing};
  std::unique_ptr<hal::RecordingWriter> writer;
  std::unique_ptr<hal::FlightRecorder> flight;
  std::unique_ptr<hal::Recorder> recorder;
  hal::HostState host;
  hal::ThreadUse thread = {};
  std::vector<int> processors;  // real time: the loop's and the helpers'
  std::uint64_t helped_parts = 0;
  bool host_fit = true;
  std::vector<std::string> troubles;  // of devices, in words
  bool open_end = false;              // nothing but Ctrl-C ends it
  std::exception_ptr failure;
};

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).string();
}

// --device: the first names the first needle's, and so on.
void attach_devices(Session& s) {
  const std::vector<std::string>& uris = s.options.devices;
  if (uris.size() > s.scene.hands.size()) {
    throw hal::SceneError(fmt::format("--device: {}: expected at most {}, one a needle of {}",
                                      uris.back(), s.scene.hands.size(), s.scene.file));
  }
  for (std::size_t i = 0; i < uris.size(); ++i) {
    if (const std::string expected = hal::device_uri_fault(uris[i]); !expected.empty()) {
      throw hal::SceneError(fmt::format("--device: {}: expected {}", uris[i], expected));
    }
    hal::attach(s.scene.hands[i], uris[i]);
  }
  for (const hal::Hand& hand : s.scene.hands) {
    if (hand.device == "attached" && s.options.fast) {
      throw hal::SceneError(
          fmt::format("{}: device.uri: {}: expected no --fast: a hand cannot be "
                      "hurried",
                      s.scene.file, hand.uri));
    }
  }
}

// Threads of the tissue step wait for each other in real time: two on one processor would wait for
// good.
void choose_processors(Session& s) {
  if (s.options.threads > 0) s.scene.threads = s.options.threads;
  if (s.options.fast) return;
  s.processors = hal::loop_processors(s.scene.cpu);
  if (s.scene.threads <= s.processors.size()) return;
  throw hal::SceneError(fmt::format(
      "{}: loop.threads: {}: at most {}, a processor of this machine for each; --fast takes any",
      s.scene.file, s.scene.threads, s.processors.size()));
}

void load(Session& s) {
  s.scene = hal::read_scene(s.options.scene);
  choose_processors(s);
  if (!s.options.mode.empty()) {
    s.scene.config.mode = s.options.mode == "paper" ? Mode::kPaper : Mode::kPhysical;
  }
  attach_devices(s);
  if (s.options.organ.empty() && s.scene.organ_path.empty()) {
    throw hal::SceneError(
        fmt::format("{}: organ.path: missing: an organ file, here or by --organ", s.scene.file));
  }
  s.organ = hal::load_organ(!s.options.organ.empty() ? s.options.organ
                                                     : beside(s.scene.file, s.scene.organ_path));
  s.stations.resize(s.scene.hands.size());
  for (std::uint32_t i = 0; i < s.stations.size(); ++i) {
    s.stations[i].placement = hal::place_needle(s.scene, s.organ.organ, i);
  }
  s.instance =
      std::make_unique<hal::KernelInstance>(s.organ.organ, s.scene.config, s.scene.obstacles);
}

// The device of one needle, and for how many ticks it has something to do.
std::uint64_t open_device(Session& s, std::uint32_t needle) {
  hal::Hand& hand = s.scene.hands[needle];
  Station& station = s.stations[needle];
  if (hand.device == "attached") {
    fmt::print(stderr, "stylet: waiting for {}\n", hand.uri);
    s.devices.push_back(hal::open_device(hand.uri));
    hal::fit_to_device(s.devices.back().info, hand);
    return 0;
  }
  const double period_s = static_cast<double>(s.config.period_ns) * 1e-9;
  if (hand.device == "replay") {
    const hal::RecordingReader recording(beside(s.scene.file, hand.replay_path));
    const std::uint32_t recorded = recording.info().config.needle_count;
    station.replayed.samples = hal::read_samples(recording, std::min(needle, recorded - 1));
    s.devices.push_back(hal::replay_device(station.replayed, hand.limits));
    return station.replayed.samples.size();
  }
  if (hand.device == "steered") {
    station.steered.config = hand.steering;
    station.steered.period_s = period_s;
    for (Vec3& each : station.steered.config.targets_m) {
      each = hal::place_in_device(station.placement.mapping, each);
    }
    s.devices.push_back(hal::steered_device(station.steered, hand.limits));
    return hal::steered_ticks(station.steered.config, s.scene.config.needle[needle].length_m,
                              period_s);
  }
  station.hand.config = hand.hand;
  station.hand.period_s = period_s;
  station.hand.script = hal::make_script(hand.waypoints, hand.approach.start_m);
  s.devices.push_back(hal::simulated_hand_device(station.hand, hand.limits));
  return hal::script_ticks(station.hand.script, period_s);
}

// As long as the needle that takes longest.
void open_devices(Session& s) {
  const double period_s = static_cast<double>(s.scene.config.period_s);
  s.config.period_ns = std::llround(period_s * 1e9);
  // Hashing a large organ takes longer than a tick: in real time only once, after the loop.
  s.config.hash_every_ticks = s.options.fast ? s.scene.hash_every_ticks : 0;
  for (std::uint32_t i = 0; i < s.stations.size(); ++i) {
    s.config.ticks = std::max(s.config.ticks, open_device(s, i));
    const hal::Hand& hand = s.scene.hands[i];
    s.config.hand[i] = {s.stations[i].placement.mapping, hand.guard, hand.coupling, hand.grip,
                        hand.limits.max_torque_nm};
  }
  s.open_end = s.config.ticks == 0 && s.options.duration_s <= 0;
  if (s.open_end) s.config.ticks = static_cast<std::uint64_t>(kLongestRunS / period_s);
  if (s.options.duration_s > 0) {
    // In whole nanoseconds: as a float, 10 ms is a little less, and 3 s one tick more.
    const auto periods = s.options.duration_s * 1e9 / static_cast<double>(s.config.period_ns);
    s.config.ticks = static_cast<std::uint64_t>(std::ceil(periods - 1e-6));
  }
}

hal::RecordingInfo recording_info(const Session& s, const std::vector<hal::Course>& courses) {
  hal::RecordingInfo info;
  info.stylet_version = STYLET_VERSION;
  info.scene_file = s.scene.file;
  info.scene_text = s.scene.text;
  info.organ_file = std::filesystem::absolute(s.organ.path).string();
  info.organ_name = s.organ.organ.name;
  info.organ_hash = s.organ.organ.hash;
  info.config = s.scene.config;
  std::copy(courses.begin(), courses.end(), info.course.begin());
  info.obstacles = s.scene.obstacles;
  return info;
}

void open_recording(Session& s) {
  std::vector<hal::Course> courses;
  for (const Station& each : s.stations) courses.push_back(each.placement.course);
  const hal::RecordingInfo info = recording_info(s, courses);
  if (!s.options.record.empty()) {
    s.writer = std::make_unique<hal::RecordingWriter>(s.options.record, info);
  }
  s.flight = std::make_unique<hal::FlightRecorder>(s.options.flight, info);
  s.recorder =
      std::make_unique<hal::Recorder>(s.records, s.events, s.writer.get(), courses, s.flight.get());
}

std::unique_ptr<hal::Helpers> start_helpers(Session& s) {
  if (s.scene.threads == 1) return nullptr;
  hal::HelperConfig config = {s.scene.threads - 1, !s.options.fast, {}, s.scene.rt_priority};
  if (config.real_time) config.cpus.assign(s.processors.begin() + 1, s.processors.end());
  return std::make_unique<hal::Helpers>(s.instance->kernel, config, s.state, s.host.report);
}

// The thread of the loop, from its rights to the last tick.
void servo(Session& s) try {
  if (!s.options.fast) {
    hal::prepare_thread(s.processors[0], s.scene.rt_priority, s.host.report);
  }
  const std::unique_ptr<hal::Helpers> helpers = start_helpers(s);
  s.host_fit = s.options.fast || s.host.report.lacks.empty() || s.options.allow_non_rt;
  if (!s.host_fit) return;
  std::vector<Input> starts;
  for (const Station& each : s.stations) {
    starts.push_back({hal::to_world(each.placement.mapping, {{}, {1, 0, 0, 0}}), 1});
  }
  hal::warm_up(s.instance->kernel, starts, kWarmUpTicks);
  hal::VirtualTime time;
  const hal::Clock clock = s.options.fast ? hal::virtual_clock(time) : hal::monotonic_clock();
  const hal::Outlets outlets = {&s.records, &s.events, nullptr, s.options.fast};
  const hal::ThreadUse before = hal::thread_use();
  hal::run_loop(s.config, s.instance->kernel, s.devices, clock, outlets, s.state);
  const hal::ThreadUse after = hal::thread_use();
  s.thread = {after.minor_faults - before.minor_faults, after.major_faults - before.major_faults,
              after.voluntary_switches - before.voluntary_switches,
              after.involuntary_switches - before.involuntary_switches};
  if (helpers != nullptr) s.helped_parts = helpers->parts();
} catch (...) {
  s.failure = std::current_exception();
}

// Whom a fault is told of.
std::vector<std::string> hand_names(const Session& s) {
  std::vector<std::string> names;
  for (const hal::Hand& hand : s.scene.hands) {
    names.push_back(hand.device == "attached" ? hand.uri : fmt::format("needle {}", names.size()));
  }
  return names;
}

// In virtual time nobody could answer: the report tells of the faults.
void show_progress(Session& s, const std::atomic<bool>& done) {
  const bool show = terminal_rewrites_lines() && !s.options.json;
  FaultDesk desk(s.state.mailbox, hand_names(s));
  while (!done.load()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(s.options.fast ? 20 : 100));
    if (!s.options.fast) desk.look();
    if (!show) continue;
    const double ticks = static_cast<double>(s.recorder->ticks());
    const double all = static_cast<double>(s.config.ticks);
    const double period_s = static_cast<double>(s.scene.config.period_s);
    rewrite_line(s.open_end ? fmt::format("{:6.2f} s, Ctrl-C ends it", ticks * period_s)
                            : fmt::format("{:6.2f} of {:.2f} s  {:3.0f} %", ticks * period_s,
                                          all * period_s, 100 * ticks / all));
  }
  if (show) rewrite_line("");
}

void run_threads(Session& s) {
  const StopOnSignal stop_on_signal(s.state.stop);
  std::atomic<bool> done{false};
  std::thread loop([&s, &done] {
    servo(s);
    done.store(true);
  });
  show_progress(s, done);
  loop.join();
  for (std::size_t i = 0; i < s.devices.size(); ++i) {
    const hal::Device& device = s.devices[i];
    const std::string trouble = device.trouble != nullptr ? device.trouble(device.self) : "";
    if (!trouble.empty()) s.troubles.push_back(s.scene.hands[i].uri + ": " + trouble);
  }
  s.close_devices();
  std::vector<hal::Fault> faults;
  for (std::size_t i = 0; i < s.stations.size(); ++i) {
    faults.push_back(s.state.hand[i].guard.fault);
  }
  s.recorder->stop(faults);
  if (s.failure) std::rethrow_exception(s.failure);
}

// What went wrong with the recording; empty: nothing. The report is worth having all the same.
std::string finish_recording(Session& s, std::uint64_t state_hash) {
  if (s.writer == nullptr || !s.recorder->error().empty()) return s.recorder->error();
  try {
    s.writer->finish(state_hash, s.state.lost_records);
  } catch (const hal::RecordingError& error) {
    return error.what();
  }
  return "";
}

const char* mode_name(const Session& s) {
  return s.scene.config.mode == Mode::kPaper ? "paper" : "physical";
}

RunReport report_of(const Session& s, double wall_s) {
  RunReport report;
  report.scene_file = s.scene.file;
  report.organ_file = s.organ.path;
  report.organ_name = s.organ.organ.name;
  report.mode = mode_name(s);
  report.recording = s.options.record;
  report.organ_hash = s.organ.organ.hash;
  report.voxel_edge_m = s.organ.organ.voxel_edge_m;
  report.state_hash = hash(s.instance->kernel);
  report.period_s = static_cast<double>(s.scene.config.period_s);
  report.fast = s.options.fast;
  report.interrupted = s.state.stop.load();
  report.wall_s = wall_s;
  const Config& config = s.scene.config;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    report.phases.push_back(
        hal::find_phases(s.recorder->track(i), report.period_s, config.needle[i].unit_m));
    const bool simulated = s.scene.hands[i].device == "simulated";
    report.least_received_j.push_back(simulated ? s.stations[i].hand.least_received_j
                                                : std::numeric_limits<double>::quiet_NaN());
  }
  report.needles.assign(config.needle, config.needle + config.needle_count);
  report.obstacles = s.scene.obstacles.size();
  report.events = s.recorder->events();
  report.loop = &s.state;
  report.thread = s.thread;
  report.threads = s.scene.threads;
  report.helped_parts = s.helped_parts;
  report.host = s.host.report;
  report.predicted = s.instance->predicted;
  report.used = s.instance->kernel.sizes;
  report.stats = stats(s.instance->kernel);
  return report;
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

void announce(const Session& s) {
  if (s.options.json) return;
  const double length_s =
      static_cast<double>(s.config.ticks) * static_cast<double>(s.scene.config.period_s);
  fmt::print(
      "{} in {} mode, organ \"{}\": {} voxels of {:g} mm; {} of {} at {:g} us a tick, "
      "{}\n\n",
      s.scene.file, mode_name(s), s.organ.organ.name, s.organ.organ.voxel_count,
      static_cast<double>(s.organ.organ.voxel_edge_m) * 1e3,
      s.open_end ? "until Ctrl-C" : fmt::format("{:.2f} s", length_s), hands_name(s),
      static_cast<double>(s.config.period_ns) * 1e-3,
      s.options.fast ? "virtual clock" : "real time");
  std::fflush(stdout);
}

void warn(const Session& s, const char* kind, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    fmt::print(stderr, "stylet: {}: {}: {}\n", s.options.scene, kind, line);
  }
}

void tell_of_flights(const hal::FlightRecorder& recorder) {
  for (const hal::Flight& each : recorder.flights()) {
    fmt::print(stderr, "stylet: {} of needle {} in tick {}: what led to it is in {}\n",
               hal::fault_name(each.fault), each.needle, each.tick, each.path);
  }
  if (!recorder.error().empty()) fmt::print(stderr, "stylet: {}\n", recorder.error());
}

}  // namespace

int run(const RunOptions& options) {
  const auto session = std::make_unique<Session>();
  Session& s = *session;
  s.options = options;
  load(s);
  open_devices(s);
  if (!options.fast) hal::prepare_process(s.host);
  open_recording(s);
  announce(s);
  const std::int64_t start_ns = hal::monotonic_now_ns();
  run_threads(s);
  const double wall_s = static_cast<double>(hal::monotonic_now_ns() - start_ns) * 1e-9;
  warn(s, "note", s.host.report.notes);
  warn(s, s.host_fit ? "warning" : "not fit for real time", s.host.report.lacks);
  if (!s.host_fit) {
    fmt::print(stderr,
               "stylet: nothing was run; --allow-non-rt goes on without these rights, "
               "--fast needs none\n");
    return kExitHostUnfit;
  }
  RunReport report = report_of(s, wall_s);
  const std::string record_error = finish_recording(s, report.state_hash);
  if (!record_error.empty()) report.recording.clear();
  fmt::print("{}", options.json ? json_text(report) : human_text(report));
  if (!record_error.empty()) throw hal::RecordingError(record_error);
  if (s.state.lost_records > 0) {
    fmt::print(stderr, "stylet: {} records lost: the recorder fell more than {} records behind\n",
               s.state.lost_records, kRecordRing);
  }
  tell_of_flights(*s.flight);
  for (const std::string& each : s.troubles) fmt::print(stderr, "stylet: {}\n", each);
  const auto faulty = [](const hal::HandState& hand) {
    return hand.guard.fault != hal::Fault::kNone;
  };
  const bool trouble =
      s.state.lost_records > 0 || std::any_of(s.state.hand.begin(), s.state.hand.end(), faulty);
  return trouble ? kExitTrouble : kExitOk;
}

int replay_recording(const ReplayOptions& options) {
  const hal::RecordingReader recording(options.recording);
  const hal::RecordingInfo& info = recording.info();
  const hal::OrganFile organ = hal::load_recorded_organ(options.recording, info, options.organ);
  if (info.lost_records > 0) {
    throw hal::RecordingError(
        fmt::format("{}: lost_records: {}: a recording with gaps cannot be "
                    "replayed",
                    options.recording, info.lost_records));
  }
  hal::KernelInstance instance(organ.organ, info.config, info.obstacles);
  const bool show = terminal_rewrites_lines();
  const auto progress = [&](std::uint64_t ticks) {
    if (show) rewrite_line(fmt::format("{} of {} ticks", ticks, recording.ticks()));
  };
  const hal::ReplayResult result = hal::replay(recording, instance.kernel, progress);
  if (show) rewrite_line("");
  if (result.same) {
    fmt::print("same bits: {} ticks, state hash {:016x}\n", result.ticks, result.state_hash);
    return kExitOk;
  }
  fmt::print("differs: tick {}, {}: recorded {}, replayed {}\n", result.tick, result.field,
             result.recorded, result.replayed);
  return kExitTrouble;
}

}  // namespace stylet::app
