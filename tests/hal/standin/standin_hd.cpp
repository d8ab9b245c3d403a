// SPDX-License-Identifier: Apache-2.0
// A stand-in for libHD.so: two devices ("Left", "Right"; the default is the first), one scheduler
// thread, one stack of errors. As in the vendor's library, force is zeroed when a frame begins and
// reaches the motors when it ends; there is one frame a tick; state calls are allowed only in the
// scheduler's thread while it runs; motors keep their force when the thread dies or is late;
// numbers are read in the process's locale. A hand of one mass may hold the device.
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <clocale>
#include <cstring>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "standin.h"

namespace {

using stylet::test::Hang;
using stylet::test::hang_in;
using stylet::test::StandIn;
using stylet::test::Trouble;

constexpr unsigned kInvalidHandle = 0xFFFFFFFFU;
constexpr int kDevices = 2;

struct ErrorInfo {
  unsigned code;
  int internal;
  unsigned device;
};

struct Unit {
  StandIn seen;
  std::atomic<bool> open{false};
  std::atomic<bool> output{false};  // forces enabled
  bool in_frame = false;
  int frames_in_tick = 0;
  double wanted[3] = {};
  double scale = 1;  // wrong if the locale was
};
struct Job {
  unsigned long handle;
  unsigned (*call)(void*);
  void* data;
};

Unit units[kDevices];
std::recursive_mutex mutex;  // a callback calls back
std::deque<ErrorInfo> errors;
std::vector<Job> jobs;
unsigned long next_job = 1;
std::thread scheduler;
std::atomic<bool> running{false};
std::atomic<std::thread::id> servo_thread{};
unsigned current = 0;

void raise(unsigned code, unsigned device) {
  if (errors.size() < 64) errors.push_front({code, -28, device});
}

Unit* unit(unsigned handle) {
  return handle < kDevices && units[handle].open ? &units[handle] : nullptr;
}

// State may be read before the scheduler runs, and in its thread.
Unit* asked() {
  if (running.load() && std::this_thread::get_id() != servo_thread.load()) {
    for (Unit& each : units) ++each.seen.forbidden;
  }
  return unit(current);
}

void stop_motors(Unit& u) {
  for (int i = 0; i < 3; ++i) u.seen.force[i] = 0;
}

bool silent() {
  return std::any_of(units, units + kDevices, [](const Unit& u) {
    return u.open && u.seen.trouble.load() == Trouble::kSilent;
  });
}

void tick() {
  const std::lock_guard lock(mutex);
  for (Unit& each : units) each.frames_in_tick = 0;
  const std::vector<Job> now = jobs;
  for (const Job& job : now) {
    if (job.call(job.data) == 0) {
      std::erase_if(jobs, [&](const Job& each) { return each.handle == job.handle; });
    }
  }
}

// Motors keep their force meanwhile.
void be_late() {
  for (Unit& each : units) {
    const int late_ms = each.seen.late_ms.exchange(0);
    if (late_ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(late_ms));
  }
}

void schedule_loop() {
  servo_thread = std::this_thread::get_id();
  auto next = std::chrono::steady_clock::now();
  while (running.load()) {
    be_late();
    if (!silent()) tick();
    next = std::max(next + std::chrono::milliseconds(1), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(next);
  }
}

}  // namespace

extern "C" {

StandIn* standin(int index) {
  return &units[index].seen;
}

unsigned hdInitDevice(const char* name) {
  hang_in(Hang::kOpen, units[0].seen);
  const std::lock_guard lock(mutex);
  const std::string_view wanted = name != nullptr ? name : "Left";
  const unsigned handle = wanted == "Right" ? 1 : 0;
  const bool known = wanted == "Left" || wanted == "Right";
  Unit& u = units[handle];
  const Trouble trouble = u.seen.trouble.load();
  const unsigned error = !known || trouble == Trouble::kNoDevice ? 0x0302U
                         : trouble == Trouble::kInUse || u.open  ? 0x0301U
                                                                 : 0U;
  if (error != 0) {
    raise(error, kInvalidHandle);
    return kInvalidHandle;
  }
  u.open = true;
  u.output = u.in_frame = false;
  // The trap: a comma where a point was meant.
  u.scale = std::strcmp(std::setlocale(LC_NUMERIC, nullptr), "C") == 0 ? 1 : 10;
  current = handle;
  return handle;
}

void hdDisableDevice(unsigned handle) {
  // No lock: the scheduler may hang in a callback.
  if (handle < kDevices) hang_in(Hang::kClose, units[handle].seen);
  if (Unit* u = unit(handle); u != nullptr) {
    stop_motors(*u);
    u->open = false;
  }
}

void hdMakeCurrentDevice(unsigned handle) {
  current = handle;
}

void hdBeginFrame(unsigned handle) {
  current = handle;
  Unit* u = asked();
  if (u == nullptr) return raise(0x0104, handle);
  if (u->in_frame || ++u->frames_in_tick > 1) {
    ++u->seen.forbidden;
    raise(0x0402, handle);
  }
  u->in_frame = true;
  ++u->seen.ticks;
  std::fill(u->wanted, u->wanted + 3, 0.0);
}

void hdEndFrame(unsigned handle) {
  current = handle;
  Unit* u = asked();
  if (u == nullptr || !u->in_frame) return raise(0x0401, handle);
  u->in_frame = false;
  const Trouble trouble = u->seen.trouble.load();
  for (int i = 0; i < 3; ++i) u->seen.force[i] = u->output ? u->wanted[i] : 0;
  ++u->seen.writes;
  if (trouble == Trouble::kNoAnswer) {
    stop_motors(*u);
    raise(0x0302, handle);
  }
  if (trouble == Trouble::kHarmless) raise(0x0200, handle);
  stylet::test::move_hand(u->seen, 1e-3, 1e3, 1, 0);
}

ErrorInfo hdGetError() {
  const std::lock_guard lock(mutex);
  if (errors.empty()) return {0, 0, kInvalidHandle};
  const ErrorInfo first = errors.front();
  errors.pop_front();
  return first;
}

const char* hdGetErrorString(unsigned code) {
  return code == 0x0302 ? "communication error" : code == 0x0301 ? "already initiated" : "error";
}

void hdEnable(unsigned what) {
  if (Unit* u = asked(); u != nullptr && what == 0x4000) u->output = true;
}

void hdGetIntegerv(unsigned what, int* out) {
  Unit* u = asked();
  if (u == nullptr) return raise(0x0104, current);
  if (what == 0x2000) *out = static_cast<int>(u->seen.buttons.load());
  if (what == 0x2555) *out = 4;  // inkwell
}

void hdGetDoublev(unsigned what, double* out) {
  Unit* u = asked();
  if (u == nullptr) return raise(0x0104, current);
  if (u->seen.mute.load() && what >= 0x2602 && what <= 0x2604) return raise(0x0101, current);
  const auto told = [out](double value, double otherwise) { *out = value > 0 ? value : otherwise; };
  if (what == 0x2602) told(u->seen.most_stiffness_n_per_mm, 0.4);
  if (what == 0x2603) told(u->seen.most_force_n, 3.3);
  if (what == 0x2604) told(u->seen.always_n, 0.88);
  if (what != 0x2052) return;
  hang_in(Hang::kRead, u->seen);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out[4 * column + row] = u->seen.rotation[3 * row + column].load();
    }
    out[4 * row + 3] = 0;
    out[12 + row] = u->scale * u->seen.position[row].load();
  }
  out[15] = 1;
}

void hdSetDoublev(unsigned what, const double* in) {
  Unit* u = asked();
  if (u == nullptr || !u->in_frame) return raise(0x0102, current);
  hang_in(Hang::kWrite, u->seen);
  if (what == 0x2700) std::copy(in, in + 3, u->wanted);
}

const char* hdGetString(unsigned what) {
  const Unit* u = unit(current);
  if (u == nullptr) return "";
  const char* told = what == 0x2504 ? u->seen.serial.load() : u->seen.model.load();
  return told != nullptr ? told : what == 0x2504 ? "" : "Stand-in Touch";
}

unsigned hdCheckCalibration() {
  Unit* u = asked();
  return u != nullptr && u->seen.trouble.load() == Trouble::kUncalibrated ? 0x5001 : 0x5000;
}

void hdUpdateCalibration(unsigned style) {
  Unit* u = asked();
  if (u != nullptr && style == 4 && ++u->seen.updates >= 2) u->seen.trouble = Trouble::kNone;
}

void hdStartScheduler() {
  if (running.exchange(true)) return;
  scheduler = std::thread(schedule_loop);
  const sched_param priority = {85};
  (void)pthread_setschedparam(scheduler.native_handle(), SCHED_FIFO, &priority);
}

void hdStopScheduler() {
  if (!running.exchange(false)) return;
  scheduler.join();
  for (Unit& each : units) stop_motors(each);
}

unsigned long hdScheduleAsynchronous(unsigned (*call)(void*), void* data, unsigned short) {
  const std::lock_guard lock(mutex);
  jobs.push_back({next_job, call, data});
  return next_job++;
}

void hdUnschedule(unsigned long handle) {
  const std::lock_guard lock(mutex);
  std::erase_if(jobs, [&](const Job& each) { return each.handle == handle; });
}

}  // extern "C"

// For tests of whole programs: opening hangs at once, the other calls after the device has been
// open for a while.
namespace {
void hang_later(std::string_view call) {
  constexpr int kTicks = 500;
  const Hang hang = call == "open"    ? Hang::kOpen
                    : call == "read"  ? Hang::kRead
                    : call == "write" ? Hang::kWrite
                                      : Hang::kClose;
  if (hang == Hang::kOpen) return units[0].seen.hangs.store(hang);
  std::thread([hang] {
    while (units[0].seen.ticks.load() < kTicks) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    units[0].seen.hangs = hang;
  }).detach();
}
}  // namespace

// If it is loaded a second time, the library does not work.
namespace {
struct Loads {
  Loads() {
    const char* const kMark = "STYLET_STANDIN_HD_LOADED";
    if (getenv(kMark) != nullptr)
      units[0].seen.trouble = units[1].seen.trouble = Trouble::kNoDevice;
#ifdef _WIN32
    (void)_putenv_s(kMark, "1");
#else
    setenv(kMark, "1", 1);
#endif
    if (const char* call = getenv("STYLET_STANDIN_HANGS")) hang_later(call);
    if (const char* serial = getenv("STYLET_STANDIN_SERIAL")) units[0].seen.serial = serial;
  }
} const loads;
}  // namespace
