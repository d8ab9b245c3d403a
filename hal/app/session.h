// SPDX-License-Identifier: Apache-2.0
// A scene made ready to run, and one run of it: what `run` does once, and the console again and
// again. Whoever owns them owns the control flow:
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

// One needle's start and whoever holds it.
struct Station {
  hal::Placement placement;
  hal::SimulatedHand hand;
  hal::Steered steered;
  hal::ReplayDevice replayed;
  // Of a device, between attempts: what is latched and how warm its motors are is the device's for
  // as long as it is open.
  hal::GuardState guard = hal::guard_start();
  hal::GuardState torque_guard = hal::guard_start();
  std::int64_t left_ns = 0;  // when; 0: before the first attempt
};

// Everything that runs of one scene have in common, in the order in which it has to exist.
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
  std::vector<Station> stations;  // of each needle
  std::unique_ptr<hal::KernelInstance> instance;
  std::vector<hal::Device> devices;
  std::vector<std::string> fits;  // what was taken from each device that is attached, in words
  bool told_of_threads = false;
  std::unique_ptr<hal::IgtlProcess> igtl;  // null: not asked for
  std::uint32_t lost_processes = 0;        // beside the loop's, that ended before it
  bool igtl_lost = false;
  hal::LoopConfig config;
  std::vector<int> processors;  // real time: the loop's and the helpers'
  bool open_end = false;        // nothing but the user ends a run
  std::uint32_t runs = 0;
};

// Scene, organ, kernel; no device yet.
void load(Session& session);
// What a loaded session reads: no output may be one of them.
std::vector<std::string> files_of(const Session& session);
// Devices, and the way to OpenIGTLink clients.
void open_devices(Session& session);
std::vector<hal::Course> courses_of(const Session& session);
const char* mode_name(const Session& session);
// Now, ISO 8601, local time with its offset.
std::string local_time();

// One run from the start of the scene.
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
  hal::Display* display = nullptr;  // null: none
  std::string recording;            // empty: none
  std::string trainee;              // for the recording; empty: not said
  std::unique_ptr<hal::RecorderProcess> recorder;
  bool recorder_lost = false;         // told of
  std::optional<hal::Recorded> kept;  // after finish(); none: the recorder was lost
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
// The loop, in a thread of its own; `done` when it has ended.
void start(Session& session, Attempt& attempt);
// Waits for its end, and completes what the recorder does. Throws what the loop threw.
void finish(Session& session, Attempt& attempt);
// What went wrong with the recording; empty: nothing. The report is worth having all the same.
std::string finish_recording(Attempt& attempt, std::uint64_t state_hash,
                             std::span<const hal::Mark> marks = {});

// Whether the processes beside this one are still there; on standard error when one is not. A few
// times a second, on any thread but the loop's.
void watch_processes(Session& session, Attempt* attempt);

// What the machine refuses, on standard error; returns `fit`.
bool tell_of_host(const Session& session, bool fit);
RunReport report_of(const Session& session, const Attempt& attempt);
// Faults, losses and files that a user should know of, on standard error; true: there were any.
bool tell_of_trouble(const Session& session, const Attempt& attempt);

}  // namespace stylet::app
