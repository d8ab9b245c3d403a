// SPDX-License-Identifier: Apache-2.0
#include "hal/app/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>
#include <new>
#include <utility>

#include "hal/app/opening.h"
#include "hal/app/organ_command.h"
#include "hal/base/contained.h"
#include "hal/device/devices.h"
#include "hal/loop/helpers.h"
#include "hal/record/recorder.h"

namespace stylet::app {
namespace {

constexpr int kWarmUpTicks = 200;
constexpr double kLongestRunS = 86400;
constexpr double kDisplayPauseS = 1.0 / 60;

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).string();
}

// --device: the first one holds the first needle, and so on.
void attach_devices(Session& s) {
  const std::vector<std::string>& uris = s.options.devices;
  if (uris.size() > s.scene.hands.size()) {
    throw hal::SceneError(
        fmt::format("--device: {}: expected at most {}, one for each needle of {}", uris.back(),
                    s.scene.hands.size(), s.scene.file));
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
          fmt::format("{}: device.uri: {}: expected no --fast: a hand on a device moves in real "
                      "time",
                      s.scene.file, hand.uri));
    }
    const std::int64_t period_ns = std::llround(static_cast<double>(s.scene.config.period_s) * 1e9);
    const bool renders = hand.device == "attached" && hal::device_renders(hand.uri);
    if (renders && period_ns > hal::kLongestDevicePeriodNs) {
      throw hal::SceneError(
          fmt::format("{}: loop.period_us: {:g}: expected at most {:g} with {}: its motors drop an "
                      "order after {:g} us, and one lost tick must not be felt",
                      s.scene.file, static_cast<double>(period_ns) * 1e-3,
                      static_cast<double>(hal::kLongestDevicePeriodNs) * 1e-3, hand.uri,
                      static_cast<double>(hal::kOrderFreshNs) * 1e-3));
    }
  }
}

// Threads of the tissue step wait for each other in real time: two of them on one processor would
// wait for ever.
void choose_processors(Session& s) {
  if (s.options.threads > 0) s.scene.threads = s.options.threads;
  if (s.options.fast) return;
  s.processors = hal::loop_processors(s.scene.cpu);
  if (s.scene.threads <= s.processors.size()) return;
  throw hal::SceneError(
      fmt::format("{}: loop.threads: {}: expected at most {}, so that each has a processor of this "
                  "machine; --fast takes any number",
                  s.scene.file, s.scene.threads, s.processors.size()));
}

}  // namespace

Session::~Session() {
  close_devices();  // however the run ends, no device keeps a force
}

void Session::close_devices() {
  close_or_leave(devices, [this](std::size_t i) { return scene.hands[i].uri; });
  devices.clear();
}

void load(Session& s) {
  s.scene = hal::read_scene(s.options.scene, s.options.devices.size());
  choose_processors(s);
  if (!s.options.mode.empty()) {
    s.scene.config.mode = s.options.mode == "paper" ? Mode::kPaper : Mode::kPhysical;
  }
  attach_devices(s);
  if (s.options.organ.empty() && s.scene.organ_path.empty()) {
    throw hal::SceneError(fmt::format(
        "{}: organ.path: missing: expected an organ file, here or by --organ", s.scene.file));
  }
  s.organ = std::make_shared<hal::OrganFile>(
      hal::load_organ(s.options.organ.empty() ? organ_of_scene(s.scene) : s.options.organ));
  s.sources.resize(s.scene.hands.size());
  for (std::uint32_t i = 0; i < s.sources.size(); ++i) {
    s.sources[i].placement = hal::place_needle(s.scene, s.organ->organ, i);
  }
  s.instance =
      std::make_unique<hal::KernelInstance>(s.organ->organ, s.scene.config, s.scene.obstacles);
}

std::vector<std::string> files_of(const Session& s) {
  std::vector<std::string> files = s.scene.hulls;
  files.insert(files.end(), {s.options.scene, s.organ->path});
  for (const hal::Hand& hand : s.scene.hands) {
    if (hand.device == "replay") files.push_back(beside(s.scene.file, hand.replay_path));
  }
  return files;
}

namespace {

// Puts a needle's hand at the start of its script; returns how many ticks the script has.
std::uint64_t rewind_hand(Session& s, std::uint32_t needle) {
  const hal::Hand& hand = s.scene.hands[needle];
  NeedleSource& source = s.sources[needle];
  const double period_s = static_cast<double>(s.config.period_ns) * 1e-9;
  if (hand.device == "attached") return 0;
  if (hand.device == "replay") {
    const hal::RecordingReader recording(beside(s.scene.file, hand.replay_path));
    const std::uint32_t recorded = recording.info().config.needle_count;
    source.replayed = {};
    source.replayed.samples = hal::read_samples(recording, std::min(needle, recorded - 1));
    return source.replayed.samples.size();
  }
  if (hand.device == "steered") {
    source.steered = {};
    source.steered.config = hand.steering;
    source.steered.period_s = period_s;
    for (Vec3& each : source.steered.config.targets_m) {
      each = hal::place_in_device(source.placement.mapping, each);
    }
    return hal::steered_ticks(source.steered.config, s.scene.config.needle[needle].length_m,
                              period_s);
  }
  source.hand = {};
  source.hand.config = hand.hand;
  source.hand.period_s = period_s;
  source.hand.script = hal::make_script(hand.waypoints, hand.approach.start_m);
  return hal::script_ticks(source.hand.script, period_s);
}

hal::Device open_device(Session& s, std::uint32_t needle) {
  hal::Hand& hand = s.scene.hands[needle];
  NeedleSource& source = s.sources[needle];
  if (hand.device == "replay") return hal::replay_device(source.replayed, hand.limits);
  if (hand.device == "steered") return hal::steered_device(source.steered, hand.limits);
  if (hand.device != "attached") return hal::simulated_hand_device(source.hand, hand.limits);
  fmt::print(stderr, "stylet: waiting for {}\n", hand.uri);
  const hal::Device device = open_or_stop(hand.uri, hal::open_lasting_device);
  s.fits.push_back(hand.uri + ": " + hal::fit_to_device(device.info, hand));
  return device;
}

void open_igtl(Session& s) {
  const IgtlOptions& options = s.options.igtl;
  if (!options.on) return;
  s.igtl = std::make_unique<hal::IgtlProcess>(
      hal::IgtlConfig{options.listen, options.port, courses_of(s), s.scene.targets});
  fmt::print(stderr, "stylet: OpenIGTLink at {}:{}\n", options.listen, s.igtl->port());
}

}  // namespace

// The run is as long as the needle with the longest script.
void open_devices(Session& s) {
  open_igtl(s);
  const double period_s = static_cast<double>(s.scene.config.period_s);
  s.config.period_ns = std::llround(period_s * 1e9);
  // Hashing a large organ takes longer than a tick: in real time it is done once, after the loop.
  s.config.hash_every_ticks = s.options.fast ? s.scene.hash_every_ticks : 0;
  s.config.display_every_ticks =
      static_cast<std::uint32_t>(std::max(1.0, std::floor(kDisplayPauseS / period_s)));
  for (std::uint32_t i = 0; i < s.sources.size(); ++i) {
    s.config.ticks = std::max(s.config.ticks, rewind_hand(s, i));
    s.devices.push_back(open_device(s, i));
    const hal::Hand& hand = s.scene.hands[i];
    s.config.hand[i] = {s.sources[i].placement.mapping,
                        hand.guard,
                        hand.coupling,
                        hand.grip,
                        hand.limits.max_torque_nm,
                        hand.device != "attached"};
  }
  s.open_end = s.config.ticks == 0 && s.options.duration_s <= 0;
  if (s.open_end) s.config.ticks = static_cast<std::uint64_t>(kLongestRunS / period_s);
  if (s.options.duration_s > 0) {
    // In whole nanoseconds: as a float, 10 ms is a little less, so 3 s would be one tick more.
    const auto periods = s.options.duration_s * 1e9 / static_cast<double>(s.config.period_ns);
    s.config.ticks = static_cast<std::uint64_t>(std::ceil(periods - 1e-6));
  }
}

std::vector<hal::Course> courses_of(const Session& s) {
  std::vector<hal::Course> courses;
  for (const NeedleSource& each : s.sources) courses.push_back(each.placement.course);
  return courses;
}

const char* mode_name(const Session& s) {
  return s.scene.config.mode == Mode::kPaper ? "paper" : "physical";
}

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts = {};
  localtime_r(&now, &parts);
  std::array<char, 40> text;
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &parts);
  return {text.data(), size};
}

namespace {

hal::RecordingInfo recording_info(const Session& s, const std::vector<hal::Course>& courses) {
  hal::RecordingInfo info;
  info.stylet_version = STYLET_VERSION;
  info.scene_file = s.scene.file;
  info.scene_text = s.scene.text;
  info.organ_file = std::filesystem::absolute(s.organ->path).string();
  info.organ_name = s.organ->organ.name;
  info.organ_hash = s.organ->organ.hash;
  info.config = s.scene.config;
  std::copy(courses.begin(), courses.end(), info.course.begin());
  info.obstacles = s.scene.obstacles;
  return info;
}

// What was refused to the devices' threads is known only once they run.
void note_device_threads(Session& s) {
  const int error = hal::device_priority_refused();
  if (error == 0 || s.told_of_threads) return;
  s.told_of_threads = true;
  s.host.report.notes.push_back(
      fmt::format("SCHED_FIFO priority {} of a device's thread was refused ({}): its samples and "
                  "forces may come late; put \"@realtime - rtprio {}\" into "
                  "/etc/security/limits.conf and your user into the group realtime",
                  hal::kDevicePriority, std::strerror(error), hal::kDevicePriority));
}

void take_guards(const Session& s, Attempt& a) {
  for (std::size_t i = 0; i < s.sources.size(); ++i) {
    const NeedleSource& source = s.sources[i];
    if (s.config.hand[i].scripted || source.left_ns == 0) continue;
    hal::HandState& hand = a.state.hand[i];
    const std::int64_t idle_ns = hal::monotonic_now_ns() - source.left_ns;
    hand.guard = source.guard;
    hand.torque_guard = source.torque_guard;
    hal::guard_resume(s.config.hand[i].guard, hand.guard, idle_ns);
    hal::guard_resume(s.config.hand[i].guard, hand.torque_guard, idle_ns);
  }
}

void leave_guards(Session& s, const Attempt& a) {
  for (std::size_t i = 0; i < s.sources.size(); ++i) {
    s.sources[i].guard = a.state.hand[i].guard;
    s.sources[i].torque_guard = a.state.hand[i].torque_guard;
    s.sources[i].left_ns = hal::monotonic_now_ns();
  }
}

}  // namespace

void prepare(Session& s, Attempt& a, hal::Display* display) {
  const std::vector<hal::Course> courses = courses_of(s);
  hal::RecordingInfo info = recording_info(s, courses);
  // On a virtual clock there is no date, so that the same run gives the same file.
  if (!s.options.fast) info.began = local_time();
  info.trainee = a.trainee;
  a.display = display;
  if (s.runs++ > 0) {
    reset(s.instance->kernel);
    for (std::uint32_t i = 0; i < s.sources.size(); ++i) rewind_hand(s, i);
  }
  take_guards(s, a);
  a.recorder = std::make_unique<hal::RecorderProcess>(hal::RecorderTask{
      std::move(info), a.recording, a.recording_name, s.options.flight, s.scene.targets});
}

namespace {

std::unique_ptr<hal::Helpers> start_helpers(Session& s, Attempt& a) {
  if (s.scene.threads == 1) return nullptr;
  hal::HelperConfig config = {s.scene.threads - 1, !s.options.fast, {}, s.scene.rt_priority};
  if (config.real_time) config.cpus.assign(s.processors.begin() + 1, s.processors.end());
  return std::make_unique<hal::Helpers>(s.instance->kernel, config, a.state, s.host.report);
}

// The loop's thread, from its rights to the last tick.
void servo(Session& s, Attempt& a) try {
  hal::name_thread("stylet-loop");
  if (!s.options.fast) {
    hal::prepare_thread(s.processors[0], s.scene.rt_priority, s.host.report);
  }
  const std::unique_ptr<hal::Helpers> helpers = start_helpers(s, a);
  a.host_fit = s.options.fast || s.host.report.lacks.empty() || s.options.allow_non_rt;
  if (!a.host_fit) return;
  std::vector<Input> starts;
  for (const NeedleSource& each : s.sources) {
    starts.push_back({hal::to_world(each.placement.mapping, {{}, {1, 0, 0, 0}}), 1});
  }
  hal::warm_up(s.instance->kernel, starts, kWarmUpTicks);
  hal::VirtualTime time;
  const hal::Clock clock = s.options.fast ? hal::virtual_clock(time) : hal::monotonic_clock();
  const hal::Outlets outlets = {&a.recorder->records(), &a.recorder->events(), a.display,
                                s.options.fast, s.igtl == nullptr ? nullptr : &s.igtl->newest()};
  const hal::ThreadUse before = hal::thread_use();
  hal::run_loop(s.config, s.instance->kernel, s.devices, clock, outlets, a.state);
  const hal::ThreadUse after = hal::thread_use();
  a.thread_use = {after.minor_faults - before.minor_faults,
                  after.major_faults - before.major_faults,
                  after.voluntary_switches - before.voluntary_switches,
                  after.involuntary_switches - before.involuntary_switches};
  if (helpers != nullptr) a.helped_parts = helpers->parts();
} catch (...) {
  a.failure = std::current_exception();
}

}  // namespace

void start(Session& s, Attempt& a) {
  a.start_ns = hal::monotonic_now_ns();
  a.loop = std::thread([&s, &a] {
    servo(s, a);
    a.done.store(true);
  });
}

namespace {

void tell_of_recorder(Session& s, Attempt& a) {
  if (std::exchange(a.recorder_lost, true)) return;
  a.state.unread.store(true);
  ++s.lost_processes;
  hal::SideProcess& process = a.recorder->process();
  fmt::print(stderr, "stylet: the recorder ended: {}; the run goes on without it\n",
             process.ended());
  if (a.recording.empty()) return;
  fmt::print(stderr, "stylet: {} ends at tick {} and stays as {}.{}.tmp\n", a.recording,
             a.recorder->ticks_kept(), a.recording, process.pid());
}

}  // namespace

void watch_processes(Session& s, Attempt* a) {
  if (a != nullptr && a->recorder->hangs()) a->recorder->process().kill();
  if (a != nullptr && !a->recorder->process().ended().empty()) tell_of_recorder(s, *a);
  if (s.igtl == nullptr || s.igtl_lost || s.igtl->process().ended().empty()) return;
  s.igtl_lost = true;
  ++s.lost_processes;
  fmt::print(stderr, "stylet: OpenIGTLink ended: {}; the run goes on without it\n",
             s.igtl->process().ended());
}

void finish(Session& s, Attempt& a) {
  a.loop.join();
  watch_processes(s, &a);
  leave_guards(s, a);
  for (std::size_t i = 0; i < s.devices.size(); ++i) {
    const hal::Device& device = s.devices[i];
    const std::string trouble = hal::trouble_of(device);
    if (!trouble.empty()) a.troubles.push_back(s.scene.hands[i].uri + ": " + trouble);
  }
  std::vector<hal::Fault> faults;
  for (std::size_t i = 0; i < s.sources.size(); ++i) {
    faults.push_back(a.state.hand[i].guard.fault);
  }
  a.kept = a.recorder->stop(faults);
  if (!a.kept) {
    tell_of_recorder(s, a);
    const std::uint64_t kept = a.recording.empty() ? 0 : a.recorder->ticks_kept();
    const std::uint64_t ticks = std::max(a.state.ticks, kept) - kept;
    a.state.lost_records.store(ticks * s.sources.size());
  }
  note_device_threads(s);
  a.wall_s = static_cast<double>(hal::monotonic_now_ns() - a.start_ns) * 1e-9;
  if (a.failure) std::rethrow_exception(a.failure);
}

std::string finish_recording(Attempt& a, RunReport& report, std::span<const hal::Mark> marks) {
  if (!a.kept) return "";  // already told
  hal::Completed completed = {"", a.kept->error};
  if (!a.recording.empty() && a.kept->error.empty()) {
    completed = a.recorder->finish(report.state_hash, a.state.lost_records, marks);
    if (completed.error.empty() && completed.recording.empty()) {
      fmt::print(stderr, "stylet: no tick was run: there is no recording {}\n", a.recording);
    } else if (completed.error.empty() && completed.recording != a.recording) {
      fmt::print(stderr, "stylet: {} appeared during the run and is kept: this recording is {}\n",
                 a.recording, completed.recording);
    }
  }
  report.recording = a.recording = completed.recording;
  return completed.error;
}

RunReport report_of(const Session& s, const Attempt& a) {
  RunReport report;
  report.scene_file = s.scene.file;
  report.organ_file = s.organ->path;
  report.organ_name = s.organ->organ.name;
  report.mode = mode_name(s);
  report.organ_hash = s.organ->organ.hash;
  report.voxel_edge_m = s.organ->organ.voxel_edge_m;
  report.levels = s.organ->organ.levels;
  report.state_hash = hash(s.instance->kernel);
  report.period_s = static_cast<double>(s.scene.config.period_s);
  report.fast = s.options.fast;
  report.interrupted = a.state.stop.load();
  report.wall_s = a.wall_s;
  const Config& config = s.scene.config;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    report.stages.push_back(a.kept ? a.kept->stages[i] : std::vector<hal::StageRow>{});
    const bool simulated = s.scene.hands[i].device == "simulated";
    report.most_force_n.push_back(s.config.hand[i].guard.max_force_n);
    report.least_received_j.push_back(simulated ? s.sources[i].hand.least_received_j
                                                : std::numeric_limits<double>::quiet_NaN());
  }
  report.needles.assign(config.needle, config.needle + config.needle_count);
  report.obstacles = s.scene.obstacles.size();
  if (a.kept) report.events = a.kept->events;
  if (a.kept && !s.scene.targets.empty()) {
    report.score = {"", s.scene.targets, layer_names(s.organ->organ), a.kept->score};
  }
  report.loop = &a.state;
  report.thread = a.thread_use;
  report.threads = s.scene.threads;
  report.helped_parts = a.helped_parts;
  report.lost_processes = s.lost_processes;
  report.host = s.host.report;
  report.predicted = s.instance->predicted;
  report.used = s.instance->kernel.sizes;
  report.stats = stats(s.instance->kernel);
  return report;
}

Resonance resonance_of(const Session& s) try {
  return first_resonance(s.instance->kernel);
} catch (const std::bad_alloc&) {
  (void)std::fputs("stylet: the first resonance is not reported: not enough memory\n", stderr);
  return {std::nan(""), std::nan(""), std::nan("")};
}

bool tell_of_trouble(const Session& s, const Attempt& a) {
  if (a.kept && a.state.lost_records > 0) {
    fmt::print(stderr, "stylet: {} records lost: the recorder fell more than {} records behind\n",
               a.state.lost_records.load(), hal::kRecordRing);
  }
  if (a.kept && a.kept->forgot) {
    fmt::print(stderr, "stylet: stages and events are those of the last {} ticks at most\n",
               hal::kMaxTrackPoints);
  }
  for (const hal::Flight& each : a.kept ? a.kept->flights : std::vector<hal::Flight>{}) {
    fmt::print(stderr, "stylet: {} of needle {} in tick {}: what led to it is in {}\n",
               hal::fault_name(each.fault), each.needle, each.tick, each.path);
  }
  if (a.kept && !a.kept->flight_error.empty()) {
    fmt::print(stderr, "stylet: {}\n", a.kept->flight_error);
  }
  for (const std::string& each : a.troubles) fmt::print(stderr, "stylet: {}\n", each);
  const auto faulty = [](const hal::HandState& hand) {
    return hand.guard.fault != hal::Fault::kNone;
  };
  return s.lost_processes > 0 || a.state.lost_records > 0 ||
         std::any_of(a.state.hand.begin(), a.state.hand.end(), faulty);
}

namespace {

void warn(const Session& s, const char* kind, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    fmt::print(stderr, "stylet: {}: {}: {}\n", s.options.scene, kind, line);
  }
}

}  // namespace

bool tell_of_host(const Session& s, bool fit) {
  warn(s, "note", s.host.report.notes);
  warn(s, fit ? "warning" : "not fit for real time", s.host.report.lacks);
  if (!fit) {
    fmt::print(stderr,
               "stylet: nothing was run; --allow-non-rt goes on without these rights, "
               "--fast needs none\n");
  }
  return fit;
}

}  // namespace stylet::app
