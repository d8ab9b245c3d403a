// SPDX-License-Identifier: Apache-2.0
// A stand-in for libdhd.so, in three versions: the present one; STYLET_DHD_BARE without the newer
// calls; STYLET_DHD_OLD with the names of version 3.2. As in the vendor's library, results above
// zero are no errors, a watchdog ends the force, saturation and the time guard are reported, and
// the frame is x toward the user, y right, z up. A hand of one mass may hold the device. If it
// moves faster than kBrakeMPerS, the device brakes. Gravity compensation is part of the force
// commands; without them the hand carries the arm's weight.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "standin.h"

namespace {

using stylet::test::Hang;
using stylet::test::hang_in;
using stylet::test::StandIn;
using stylet::test::Trouble;
using Clock = std::chrono::steady_clock;

constexpr int kDevices = 2;
constexpr double kMostForceN = 12;
constexpr double kBrakeMPerS = 0.5;
constexpr double kHeldS = 0.005;  // a force command carries the arm for so long

struct Unit {
  StandIn seen;
  std::atomic<bool> open{false};
  std::atomic<bool> output{false};
  std::atomic<std::int64_t> watchdog_us{0};
  std::atomic<Clock::rep> fed{0};
  std::atomic<int> cause{0};
  std::atomic<Clock::rep> read{0};
  std::atomic<Clock::rep> moved{0};
  std::atomic<bool> carried{true};  // gravity compensation is on
  std::atomic<bool> brakes{false};
  std::atomic<bool> emulates{false};  // its gripper is a button
};
Unit units[kDevices];
thread_local int last_error = 0;

Clock::rep now() {
  return Clock::now().time_since_epoch().count();
}

std::int64_t microseconds_since(Clock::rep then) {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::duration(now() - then))
      .count();
}

int failed(int error) {
  last_error = error;
  return -1;
}

void stop_motors(Unit& u) {
  for (int i = 0; i < 3; ++i) u.seen.force[i] = u.seen.torque[i] = 0;
}

void off(Unit& u, int cause) {
  u.output = false;
  u.cause = cause;
  stop_motors(u);
}

// Advances to the present, in the thread that calls first. A moment that is counted twice or left
// out does not matter here.
void live(Unit& u) {
  const Clock::rep before = u.moved.exchange(now());
  const double seconds = before == 0 ? 0 : 1e-6 * static_cast<double>(microseconds_since(before));
  const bool held =
      u.carried && u.open && 1e-6 * static_cast<double>(microseconds_since(u.fed)) < kHeldS;
  stylet::test::move_hand(u.seen, std::min(seconds, 0.005), 1, 2, held ? 0 : 1);
  const double speed =
      std::hypot(u.seen.velocity[0].load(), u.seen.velocity[1].load(), u.seen.velocity[2].load());
  if (u.output && speed > kBrakeMPerS) {
    off(u, 2);
    u.brakes = true;
    for (auto& v : u.seen.velocity) v = 0;
  }
}

// Null: the call fails.
Unit* answering(char id) {
  Unit& u = units[id == 1 ? 1 : 0];
  const Trouble trouble = u.seen.trouble.load();
#if defined(STYLET_DHD_OLD) || defined(STYLET_DHD_BARE)
  const bool watched = false;
#else
  const bool watched = !u.seen.refuses_watchdog;
#endif
  if (trouble == Trouble::kNoAnswer && !watched) off(u, 5);  // its cable is out
  if (!u.open || trouble == Trouble::kNoAnswer) return nullptr;
  if (trouble == Trouble::kForcesOff) off(u, 1);
  return &u;
}

unsigned pressed(const Unit& u) {
  return u.seen.buttons.load() | (u.emulates && u.seen.pinched ? 1U : 0U);
}

// Data of a moment ago, without asking the device.
bool guarded(Unit& u) {
  if (u.seen.trouble.load() == Trouble::kSilent) return true;
  if (microseconds_since(u.read.load()) < 100) return true;
  u.read = now();
  return false;
}

}  // namespace

extern "C" {

// Before it says what the motors do, the watchdog must be looked at.
StandIn* standin(int index) {
  Unit& u = units[index];
  const std::int64_t limit = u.watchdog_us.load();
  if (limit != 0 && u.output && microseconds_since(u.fed.load()) > limit) off(u, 3);
  live(u);
  return &u.seen;
}

int dhdOpenID(char index) {
  if (index < 0 || index >= kDevices) return failed(15);
  Unit& u = units[static_cast<int>(index)];
  hang_in(Hang::kOpen, u.seen);
  if (u.seen.trouble.load() == Trouble::kNoDevice) return failed(5);
  if (u.seen.trouble.load() == Trouble::kInUse || u.open) return failed(20);
  u.open = true;
  u.cause = 0;
  u.brakes = false;
  u.moved = 0;
  u.watchdog_us = 0;
  u.emulates = false;
  return index;
}

int dhdOpen() {
  return dhdOpenID(0);
}

int dhdClose(char id) {
  Unit& u = units[id == 1 ? 1 : 0];
  stop_motors(u);
  hang_in(Hang::kClose, u.seen);
  u.output = u.open = false;
  return 0;
}

const char* dhdGetSystemName(char) {
  return "stand-in omega";
}
int dhdGetSystemType(char id) {
  const int type = units[id == 1 ? 1 : 0].seen.type.load();
  return type != 0 ? type : 35;
}
int dhdGetSerialNumber(unsigned short* serial, char id) {
  const char* told = units[id == 1 ? 1 : 0].seen.serial.load();
  if (told == nullptr) return failed(2);
  *serial = static_cast<unsigned short>(std::atoi(told));
  return 0;
}

const char* dhdErrorGetLastStr() {
  switch (last_error) {
    case 5:
      return "no device found";
    case 20:
      return "device in use";
    default:
      return "communication error";
  }
}

int dhdGetPosition(double* x, double* y, double* z, char id) {
  Unit* u = answering(id);
  if (u == nullptr) return failed(2);
  hang_in(Hang::kRead, u->seen);
  *x = u->seen.position[0];
  *y = u->seen.position[1];
  *z = u->seen.position[2];
  return guarded(*u) ? 1 : 0;
}

#if defined(STYLET_DHD_OLD)
int dhdGetRotatorMatrix(double m[3][3], char id)
#else
int dhdGetOrientationFrame(double m[3][3], char id)
#endif
{
  Unit* u = answering(id);
  if (u == nullptr) return failed(2);
  for (int i = 0; i < 9; ++i) m[i / 3][i % 3] = u->seen.rotation[i];
  return 0;
}

int dhdSetForce(double x, double y, double z, char id) {
  Unit* u = answering(id);
  if (u == nullptr) return failed(2);
  hang_in(Hang::kWrite, u->seen);
  live(*u);
  u->fed = now();
  ++u->seen.ticks;
  ++u->seen.writes;
  const double size = std::sqrt(x * x + y * y + z * z);
  const double share = size > kMostForceN ? kMostForceN / size : 1;
  const double force[3] = {share * x, share * y, share * z};
  for (int i = 0; i < 3; ++i) u->seen.force[i] = u->output ? force[i] : 0;
  const bool saturated = share < 1 || u->seen.trouble.load() == Trouble::kHarmless;
  return saturated ? 2 : 0;
}

int dhdEnableForce(unsigned char on, char id) {
  Unit* u = answering(id);
  if (u == nullptr) return failed(2);
  u->output = on != 0;
  u->fed = now();
  if (on == 0) stop_motors(*u);
  return 0;
}

int dhdGetButton(int index, char id) {
  Unit* u = answering(id);
  return u == nullptr ? failed(2) : static_cast<int>((pressed(*u) >> index) & 1U);
}

int dhdGetStatus(int* status, char id) {
  Unit* u = answering(id);
  if (u == nullptr) return failed(2);
  if (u->seen.trouble.load() == Trouble::kUncalibrated && ++u->seen.updates >= 3) {
    u->seen.trouble = Trouble::kNone;
  }
  std::fill(status, status + 17, 0);
  status[0] = status[1] = status[2] = 1;
  status[3] = u->seen.trouble.load() == Trouble::kUncalibrated ? 1 : 0;
  status[5] = u->output ? 1 : 0;
  status[6] = u->brakes ? 1 : 0;
  status[14] = u->cause;
  return 0;
}

#if !defined(STYLET_DHD_OLD) && !defined(STYLET_DHD_BARE)
int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double m[3][3], char id) {
  return dhdGetOrientationFrame(m, id) < 0 ? -1 : dhdGetPosition(x, y, z, id);
}

int dhdSetForceAndTorqueAndGripperForce(double x, double y, double z, double tx, double ty,
                                        double tz, double, char id) {
  const int result = dhdSetForce(x, y, z, id);
  Unit* u = answering(id);
  if (u == nullptr) return -1;
  const double torque[3] = {tx, ty, tz};
  for (int i = 0; i < 3; ++i) u->seen.torque[i] = u->output ? torque[i] : 0;
  return result;
}

unsigned dhdGetButtonMask(char id) {
  Unit* u = answering(id);
  return u == nullptr ? 0 : pressed(*u);
}

bool dhdHasActiveWrist(char) {
  return true;
}

int dhdSetGravityCompensation(int on, char id) {
  units[id == 1 ? 1 : 0].carried = on != 0;
  return 0;
}
int dhdEmulateButton(unsigned char on, char id) {
  units[id == 1 ? 1 : 0].emulates = on != 0;
  return 0;
}
int dhdEnableExpertMode() {
  return 0;
}
int dhdSetWatchdog(unsigned char n, char id) {
  if (units[id == 1 ? 1 : 0].seen.refuses_watchdog) return failed(2);
  units[id == 1 ? 1 : 0].watchdog_us = 125L * n;
  return 0;
}
#endif

}  // extern "C"
