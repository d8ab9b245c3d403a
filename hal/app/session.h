// SPDX-License-Identifier: Apache-2.0
// A scene made ready to run, and one run of it: `run` does this once, the console again and again.
// Whoever owns the two decides what happens when:
//
//   load -> open_devices -> { Attempt -> start -> (pause, rearm) -> finish }... -> ~Session
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal/app/commands.h"
#include "hal/app/report.h"
#include "hal/loop/display.h"
#include "hal/loop/host.h"
#include "hal/loop/instance.h"
#include "hal/loop/loop.h"
#include "hal/publish/igtl_process.h"
#include "hal/record/organ_file.h"
#include "hal/record/recorder_process.h"
#include "hal/record/replay_device.h"
#include "hal/scene/scene.h"

namespace stylet::app {

// Where one needle starts, and what moves it: a script, a steering, a recording, a device.
struct NeedleSource {
  hal::Placement placement;
  hal::SimulatedHand hand;
  hal::Steered steered;
  hal::ReplayDevice replayed;
  // A device's guard between two attempts. As long as the device is open, a latched fault and the
  // heat of its motors stay with it.
  hal::GuardState guard = hal::guard_start();
  hal::GuardState torque_guard = hal::guard_start();
  std::int64_t left_ns = 0;  // when the last attempt ended; 0: before the first
};

// All that the runs of one scene have in common, in the order in which it must be created.
struct Session {
  Session(RunOptions options_in, hal::HostState& host_in)
      : options(std::move(options_in)), host(host_in) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  void close_devices();

  RunOptions options;
  hal::HostState& host;
  hal::Scene scene;
  std::shared_ptr<hal::OrganFile> organ;
  std::vector<NeedleSource> sources;  // for each needle
  std::unique_ptr<hal::KernelInstance> instance;
  std::vector<hal::Device> devices;
  std::vector<std::string> fits;  // what was taken from each attached device, in words
  bool told_of_threads = false;
  std::unique_ptr<hal::IgtlProcess> igtl;  // null: not asked for
  std::uint32_t lost_processes = 0;        // processes beside the loop's that ended before it
  bool igtl_lost = false;
  hal::LoopConfig config;
  std::vector<int> processors;  // in real time: the loop's and the helpers'
  bool open_end = false;        // only the user ends a run
  std::uint32_t runs = 0;
};

// Loads scene, organ and kernel; opens no device yet.
void load(Session& session);
// The files that a loaded session reads: no output may be one of them.
std::vector<std::string> files_of(const Session& session);
// Opens the devices, and the server for OpenIGTLink clients.
void open_devices(Session& session);
std::vector<hal::Course> courses_of(const Session& session);
const char* mode_name(const Session& session);
// The present time, ISO 8601, local time with its offset.
std::string local_time();

// One run, from the start of the scene.
struct Attempt {
  Attempt() = default;
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;
  ~Attempt() {
    state.stop.store(true);
    state.unread.store(true);
    if (loop.joinable()) loop.join();
  }

  hal::LoopState state;
  hal::Display* display = nullptr;  // null: no display
  std::string recording;            // empty: no recording; finish_recording sets the name it got
  hal::OutputName recording_name;   // if that name is taken in the end
  std::string trainee;              // for the recording; empty: not told
  std::unique_ptr<hal::RecorderProcess> recorder;
  bool recorder_lost = false;         // the user has been told
  std::optional<hal::Recorded> kept;  // set by finish(); nullopt: the recorder was lost
  hal::ThreadUse thread_use = {};
  std::uint64_t helped_parts = 0;
  bool host_fit = true;
  std::vector<std::string> troubles;  // of devices, in words
  std::exception_ptr failure;
  std::int64_t start_ns = 0;
  double wall_s = 0;
  std::atomic<bool> done{false};
  std::thread loop;
};

// Opens the recording, and puts scripted hands back to their start. `display` may be null.
void prepare(Session& session, Attempt& attempt, hal::Display* display);
// Runs the loop in a thread of its own; `done` is set when it has ended.
void start(Session& session, Attempt& attempt);
// Waits for the loop's end, and completes the recorder's work. Throws what the loop threw.
void finish(Session& session, Attempt& attempt);
// Completes the recording and puts its name into the report; no name: there is none. Returns what
// went wrong, empty: nothing. Whatever it is, the report is worth telling.
std::string finish_recording(Attempt& attempt, RunReport& report,
                             std::span<const hal::Mark> marks = {});

// Checks whether the processes beside this one still run; tells on standard error if one does not.
// Call it a few times a second, on any thread but the loop's.
void watch_processes(Session& session, Attempt* attempt);

// Tells on standard error what the machine refuses; returns `fit`.
bool tell_of_host(const Session& session, bool fit);
RunReport report_of(const Session& session, const Attempt& attempt);
// The organ's first resonance, for a report. If memory is too short for it, says so and gives NaN:
// a run that ended well is reported all the same.
Resonance resonance_of(const Session& session);
// Tells faults, losses and files that a user should know of on standard error; true: any were told.
bool tell_of_trouble(const Session& session, const Attempt& attempt);

}  // namespace stylet::app
