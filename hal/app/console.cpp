// SPDX-License-Identifier: Apache-2.0
// The session behind a console: one attempt at a scene after another, and the next scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "hal/app/serve.h"
#include "hal/app/session.h"
#include "hal/app/stop_signal.h"
#include "hal/app/supervised.h"
#include "hal/base/contained.h"
#include "hal/base/follower.h"
#include "hal/base/output_file.h"
#include "hal/console/console_process.h"
#include "hal/console/limits.h"
#include "hal/device/drivers/pointer.h"
#include "hal/publish/metrics.h"

namespace stylet::app {
namespace {

constexpr double kLookS = 0.02;     // pause between looks at the attempt
constexpr double kPageGoneS = 0.5;  // then it is unknown where a hand on a hanging page is

// Other files may end in .toml, too: tissues, hulls.
bool is_scene(const std::filesystem::path& path) try {
  if (path.extension() != ".toml") return false;
  (void)hal::read_scene(path.string());
  return true;
} catch (const std::exception&) {
  return false;
}

// File names of all scenes in this one's folder.
std::vector<std::string> scenes_beside(const std::string& file) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(file).parent_path();
  std::vector<std::string> names;
  for (const fs::directory_entry& each : fs::directory_iterator(folder)) {
    if (is_scene(each.path())) names.push_back(each.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Which pointers hold needles.
class Pointers {
 public:
  Pointers() { hal::pointer_serve(true); }
  ~Pointers() { hal::pointer_serve(false); }
  Pointers(const Pointers&) = delete;
  Pointers& operator=(const Pointers&) = delete;

  void choose(const std::vector<hal::Hand>& hands) {
    for (std::size_t i = 0; i < number_.size(); ++i) {
      number_[i] = i < hands.size() ? hal::pointer_number(hands[i].uri).value_or(kNone) : kNone;
    }
  }
  void move(const console::PointerMoved& moved) const {
    if (moved.needle >= number_.size()) return;
    (void)hal::pointer_post(number_[moved.needle], moved.pose, moved.buttons);
  }
  void leave() const {
    for (const std::uint32_t each : number_) hal::pointer_leave(each);
  }

 private:
  static constexpr std::uint32_t kNone = kMaxNeedles;  // posts to it are refused
  std::array<std::uint32_t, kMaxNeedles> number_ = {kNone, kNone, kNone, kNone};
};

// The numbers for Prometheus (metrics.h). The onlooker and the session write them, in two threads.
class Meter {
 public:
  void add(const hal::TickRecord& record) {
    const std::lock_guard lock(mutex_);
    metrics_add(metrics_, record);
  }
  // Counts from the loop's counters until end().
  void begin(const hal::Scene& scene, const hal::LoopState& loop) {
    const std::lock_guard lock(mutex_);
    loop_ = &loop;
    metrics_.period_s = static_cast<double>(scene.config.period_s);
    metrics_.needles = scene.config.needle_count;
    metrics_.fault = {};
    metrics_.running = true;
    ++metrics_.attempts;
  }
  void end() {
    const std::lock_guard lock(mutex_);
    if (loop_ == nullptr) return;
    metrics_.running = false;
    add_losses(metrics_);
    loop_ = nullptr;
  }
  hal::MetricNumbers now() {
    const std::lock_guard lock(mutex_);
    hal::MetricNumbers now = metrics_;
    add_losses(now);
    return now;
  }

 private:
  void add_losses(hal::MetricNumbers& metrics) const {
    if (loop_ == nullptr) return;
    metrics.missed_ticks += loop_->missed_ticks.load(std::memory_order_relaxed);
    metrics.lost_records += loop_->lost_records.load(std::memory_order_relaxed);
    metrics.lost_events += loop_->lost_events.load(std::memory_order_relaxed);
  }

  std::mutex mutex_;
  hal::MetricNumbers metrics_;
  const hal::LoopState* loop_ = nullptr;  // of the running attempt
};

// Receives what the recorder gets, for the page and the meter.
class Onlooker {
 public:
  Onlooker(hal::RecorderProcess& recorder, std::vector<hal::Course> courses, Meter& meter,
           console::ConsoleProcess& server)
      : records_(recorder.records()),
        events_(recorder.events()),
        courses_(std::move(courses)),
        meter_(meter),
        server_(server),
        thread_([this](const std::stop_token& done) {
          hal::name_thread("stylet-rows");
          for (bool last = false; !last;) {
            last = done.stop_requested();
            (void)hal::contained("console", [this] { look(); });
            if (!last) std::this_thread::sleep_for(std::chrono::milliseconds(2));
          }
        }) {}

 private:
  void look() {
    for (hal::TickRecord each; records_.next(each);) {
      if (each.needle >= courses_.size()) continue;  // the recorder's process can write there, too
      meter_.add(each);
      (void)server_.tell({false, console::row_of(each, courses_[each.needle]), {}});
    }
    for (Event each; events_.next(each);) {
      (void)server_.tell({true, {}, console::happened(each)});
    }
  }

  hal::Follower<hal::TickRecord> records_;
  hal::Follower<Event> events_;
  std::vector<hal::Course> courses_;
  Meter& meter_;
  console::ConsoleProcess& server_;
  std::jthread thread_;
};

class Console {
 public:
  explicit Console(const RunOptions& options)
      : options_(options),
        scenes_(scenes_beside(options.scene)),
        folder_(std::filesystem::absolute(options.scene).parent_path().string()) {}

  int run() {
    std::atomic<bool> quit{false};
    const StopOnSignal stop_on_signal(quit);
    open(options_.scene);
    options_.record = hal::checked_output(options_.record, files_of(*session_));
    if (!options_.fast) hal::prepare_process(host_);
    serve();
    while (!quit.load() && host_fit_ && (!page_lost_ || running())) go_on();
    if (!host_fit_) return kExitHostUnfit;
    if (attempt_ != nullptr) end_attempt(console::Activity::Ended);
    return trouble_ ? kExitTrouble : kExitOk;
  }

 private:
  // Handles one order, and looks once at the attempt. If an attempt cannot begin or be kept, that
  // is told, and the session goes on.
  void go_on() try {
    if (server_->alive_within(kPageGoneS)) hal::pointer_stay();
    if (const std::optional<console::Wish> wish = next_wish(); wish) {
      std::visit([this](const auto& each) { grant(each); }, *wish);
    }
    const hal::MetricNumbers numbers = meter_.now();
    server_->publish(numbers);
    tell_of_life(numbers.ticks);
    watch_page();
    if (session_ != nullptr) watch_processes(*session_, attempt_.get());
    if (running() && attempt_->done.load()) end_attempt(console::Activity::Ended);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stylet: {}\n", error.what());
    trouble_ = true;
    meter_.end();
    onlooker_.reset();
    attempt_.reset();
    server_->refuse(error.what());
    become(console::Activity::Ended);
  }

  void serve() {
    console::ServerConfig config = server_config(options_.serve);
    if (!options_.fast) config.spared_processors = session_->processors;
    server_ = std::make_unique<console::ConsoleProcess>(config);
    show_view();
    fmt::print("{}: console at {}\nCtrl-C ends it\n", options_.scene, server_->url());
    std::fflush(stdout);
    supervised_.ready();
  }

  // nullopt if the page has gone.
  std::optional<console::Wish> next_wish() {
    if (page_lost_) std::this_thread::sleep_for(std::chrono::duration<double>(kLookS));
    return page_lost_ ? std::nullopt : server_->next(kLookS);
  }

  void grant(const console::Order& order) { obey(order); }
  void grant(const console::PointerMoved& moved) { pointers_.move(moved); }
  void grant(const console::PointerLeft&) { pointers_.leave(); }

  // A running attempt that makes no tick does not live, although this thread does.
  void tell_of_life(std::uint64_t ticks) {
    if (activity_ != console::Activity::Running || ticks != ticks_told_) supervised_.alive();
    ticks_told_ = ticks;
  }

  // The attempt goes on without a page, but nothing new can begin.
  void watch_page() {
    if (page_lost_) return;
    if (!server_->alive_within(hal::kSidePatienceS)) server_->process().kill();
    if (server_->process().ended().empty()) return;
    page_lost_ = trouble_ = true;
    if (session_ != nullptr) ++session_->lost_processes;
    pointers_.leave();
    fmt::print(stderr,
               "stylet: the console ended: {}; a running attempt goes on to its end, or to "
               "Ctrl-C\n",
               server_->process().ended());
  }

  // If the files of the scene are faulty, the present scene stays as it is.
  void open(const std::string& scene) {
    RunOptions options = options_;
    options.scene = scene;
    // --organ belongs to the scene it was given with: another scene's targets are in another organ.
    const bool other =
        std::filesystem::path(scene).filename() != std::filesystem::path(options_.scene).filename();
    if (other && !hal::read_scene(scene).organ_path.empty()) {
      options.organ.clear();
    }
    auto session = std::make_unique<Session>(options, host_);
    load(*session);
    session_.reset();  // closes its devices, before they are opened again
    open_devices(*session);
    session_ = std::move(session);
    pointers_.choose(session_->scene.hands);
    display_ = std::make_shared<hal::Display>(session_->instance->kernel);
    show_rest();
  }

  // Shows the organ at rest and the needles at their starts.
  void show_rest() {
    reset(session_->instance->kernel);
    std::vector<hal::TickRecord> records(session_->sources.size());
    for (std::uint32_t i = 0; i < records.size(); ++i) {
      const hal::Mapping& mapping = session_->sources[i].placement.mapping;
      records[i].input.handle = hal::to_world(mapping, {{}, {1, 0, 0, 0}});
      records[i].output.layer = kNoLayer;
      records[i].needle = i;
    }
    display_->publish(session_->instance->kernel, records, 0, 0);
  }

  void show_view() {
    auto view = std::make_shared<console::SceneView>();
    const hal::Scene& scene = session_->scene;
    view->scene = std::filesystem::path(scene.file).filename().string();
    view->scenes = scenes_;
    view->period_s = scene.config.period_s;
    view->organ = session_->organ;
    view->lattice = console::make_lattice(session_->organ->organ, session_->instance->kernel);
    for (std::uint32_t i = 0; i < session_->sources.size(); ++i) {
      const hal::Hand& hand = scene.hands[i];
      const NeedleConfig& needle = scene.config.needle[i];
      view->needles.push_back({hand.uri.empty() ? hand.device : hand.uri, needle.length_m,
                               needle.outer_radius_m, session_->sources[i].placement.course,
                               hand.guard.max_force_n});
    }
    view->obstacles = scene.obstacles;
    view->targets = scene.targets;
    view->display = display_;
    server_->show(*view);
    become(console::Activity::Ready);
  }

  void become(console::Activity activity) {
    activity_ = activity;
    server_->show(activity);
  }

  void obey(const console::Order& order) {
    switch (order.verb) {
      case console::Verb::kStart:
        return begin_attempt(order.text);
      case console::Verb::kPause:
        return hold(true);
      case console::Verb::kResume:
        return hold(false);
      case console::Verb::kReset:
        return back_to_start();
      case console::Verb::kEnd:
        return end_now();
      case console::Verb::kChoose:
        return choose(order.text);
      case console::Verb::kAcknowledge:
        return acknowledge(order);
      case console::Verb::kMark:
        return mark(order);
      case console::Verb::kSeek:
      case console::Verb::kPlay:
        return server_->refuse("seek and play: only in a recording");
    }
  }

  bool running() const { return attempt_ != nullptr; }

  void begin_attempt(const std::string& trainee) {
    if (running()) return server_->refuse("start: an attempt is running; reset ends it");
    if (session_ == nullptr) return server_->refuse("start: no scene; choose one");
    attempt_ = std::make_unique<Attempt>();
    marks_.clear();
    scored_ = {scored_.attempt + 1, trainee, local_time(), "", {}};
    if (!options_.record.empty()) {
      attempt_->recording_name = {options_.record, hal::Naming::kNumber};
      attempt_->recording = hal::free_name(attempt_->recording_name);
      attempt_->trainee = trainee;
      scored_.recording = std::filesystem::path(attempt_->recording).filename().string();
    }
    prepare(*session_, *attempt_, display_.get());
    onlooker_ =
        std::make_unique<Onlooker>(*attempt_->recorder, courses_of(*session_), meter_, *server_);
    meter_.begin(session_->scene, attempt_->state);
    start(*session_, *attempt_);
    become(console::Activity::Running);
  }

  void end_attempt(console::Activity then) {
    if (!attempt_->done.load()) attempt_->state.stop.store(true);
    finish(*session_, *attempt_);
    onlooker_.reset();  // it has seen everything
    meter_.end();
    host_fit_ = attempt_->host_fit;
    if (tell_of_host(*session_, host_fit_)) report();
    session_->host.report = {};  // is told only once
    attempt_.reset();
    become(then);
  }

  void report() {
    RunReport report = report_of(*session_, *attempt_);
    const std::string record_error = finish_recording(*attempt_, report, marks_);
    if (!record_error.empty()) fmt::print(stderr, "stylet: {}\n", record_error);
    scored_.recording = std::filesystem::path(report.recording).filename().string();
    report.resonance = resonance_of(*session_);
    fmt::print("\nattempt {}\n{}", scored_.attempt, human_text(report));
    std::fflush(stdout);
    trouble_ = tell_of_trouble(*session_, *attempt_) || !record_error.empty() || trouble_;
    if (attempt_->kept) scored_.score = attempt_->kept->score;
    if (!attempt_->kept) scored_.recording.clear();
    server_->show(scored_);
  }

  // After an attempt only pages keep a mark, because the recording is complete.
  void mark(const console::Order& order) {
    if (running() && marks_.size() < console::kMaxMarksKept) {
      marks_.push_back({order.tick, order.text});
    }
  }

  void hold(bool on) {
    if (!running()) return server_->refuse("pause and resume: no attempt is running");
    attempt_->state.paused.store(on);
    become(on ? console::Activity::Paused : console::Activity::Running);
  }

  // Without a script, the user decides when the attempt is over.
  void end_now() {
    if (!running()) return server_->refuse("end: no attempt is running");
    end_attempt(console::Activity::Ended);
  }

  void back_to_start() {
    if (running()) end_attempt(console::Activity::Ended);
    if (session_ == nullptr) return;
    show_rest();
    become(console::Activity::Ready);
  }

  void choose(const std::string& scene) {
    if (running()) return server_->refuse("choose: an attempt is running; reset ends it");
    if (std::find(scenes_.begin(), scenes_.end(), scene) == scenes_.end()) {
      return server_->refuse("choose: no scene of this name in the folder of the first one");
    }
    try {
      open((std::filesystem::path(folder_) / scene).string());
      show_view();
    } catch (const std::exception& error) {
      server_->refuse(error.what());
    }
  }

  void acknowledge(const console::Order& order) {
    if (!running() || order.needle >= session_->sources.size()) {
      return server_->refuse("acknowledge: no such needle is running");
    }
    hal::FaultMailbox& mailbox = attempt_->state.mailbox[order.needle];
    const hal::LatchedFault latched = mailbox.latched.load();
    if (latched.number == 0 || latched.number != order.fault_number ||
        order.text != hal::fault_name(latched.fault)) {
      return server_->refuse("acknowledge: expected the fault that is latched, name and number");
    }
    const double age_s = static_cast<double>(hal::monotonic_now_ns() - order.seen_ns) * 1e-9;
    if (!(age_s >= 0 && age_s <= console::kAcknowledgeLifeS)) {
      return server_->refuse(
          "acknowledge: it came too late: look at the fault and acknowledge again");
    }
    mailbox.seen.store(latched);
  }

  RunOptions options_;
  std::vector<std::string> scenes_;
  std::string folder_;
  hal::HostState host_;
  Pointers pointers_;
  Meter meter_;
  std::unique_ptr<Session> session_;
  std::shared_ptr<hal::Display> display_;
  std::unique_ptr<console::ConsoleProcess> server_;
  std::unique_ptr<Attempt> attempt_;
  std::unique_ptr<Onlooker> onlooker_;  // of the running attempt
  std::vector<hal::Mark> marks_;        // of the present attempt
  console::ScoredAttempt scored_;       // the present attempt, or the last one
  console::Activity activity_ = console::Activity::Ready;
  Supervised supervised_;
  std::uint64_t ticks_told_ = 0;
  bool host_fit_ = true;
  bool trouble_ = false, page_lost_ = false;
};

}  // namespace

int run_console(const RunOptions& options) {
  return Console(options).run();
}

}  // namespace stylet::app
