// SPDX-License-Identifier: Apache-2.0
// The guard between kernel and device: it keeps the hand safe whatever either of them does.
//
// It trusts neither side and shares no code with them. Every force it lets through is finite, at
// most max_force_n long (shortened, never turned), changes by at most max_slew_n_per_s, and in the
// long run is no more than the motors bear. Nothing is felt before a device has told where it is:
// the needle may wait far from the hand. Forces fade in after arming. Trouble latches a fault: the
// force goes to zero within kDecayS, or at once if it is not a number, and stays there until
// guard_rearm names the fault. Only a timing fault of loop or device clears by itself, and only if
// no force was let through before it. If the hand lets go of the dead man's button, the force is
// zero within kDecayS, too. hal/guard/GUARD.md has all states and limits. All times are times that
// really pass (`now_ns` of guard_sample), even if ticks are lost or come too often; a clock that
// stands or runs backwards is a fault. The guard learns from their report what force the motors
// really have (motor.h), and continues from that. Plain functions over a plain struct: no
// allocation, no clock, bounded time. Units: SI. Frame: the device's. Source: Hannaford and Ryu
// 2002 (observer of energy and passivity controller).
#pragma once

#include <array>
#include <cstdint>

#include "hal/device/device.h"
#include "hal/device/model.h"

namespace stylet::hal {

// ---- limits that no scene can change
// ----------------------------------------------------------------

constexpr float kDecayS = 0.020F;  // from a fault to zero force
constexpr std::int64_t kDecayNs = 20'000'000;
constexpr std::int64_t kMaxStepNs = 100'000'000;  // longest time between two ticks that is believed
constexpr float kMaxDistanceM = 10.0F;            // largest distance of a sample that is believed
constexpr double kRotationTolerance = 0.1;        // of the square of a quaternion's length
constexpr float kJumpM = 5e-3F;                   // allowed beyond the way of the fastest hand
constexpr float kSpeedS = 5e-3F;                  // time over which speed is averaged
constexpr float kBuzzHz = 20;                     // slower swings are movements of the hand
constexpr std::uint32_t kBuzzTurns = 12;  // to and fro, each within half a period of kBuzzHz
constexpr float kWarmFraction = 0.8F;     // of the thermal budget: force is reduced from here on
constexpr double kLostEnergyJ = 0.05;     // energy made in spite of the passivity controller
constexpr float kPathS = 0.020F;          // time over which the path's length is averaged
constexpr std::int64_t kMostJumpedNs = 20'000'000;  // time of jumps, less a part of the other time
constexpr std::int64_t kJumpedPart = 10;            // that part: a tenth
// When this much time is lost, at once or in total, the guard latches Fault::kTooLate. Each tick in
// time makes up for half a period, so a loop that goes on losing more than a third of its ticks
// faults. A sample that is this far ahead of its tick is not used.
constexpr std::int64_t kMaxLateNs = 20'000'000;
constexpr std::int64_t kLostTicksPart = 2;

// ---- what is latched, and why
// --------------------------------------------------------------------

// Numbers are part of recordings: they never change meaning.
enum class Fault : std::uint32_t {
  kNone = 0,
  kForceNotFinite = 1,  // the kernel asked for NaN or an infinity
  kStaleSamples = 2,    // the device answers, but with nothing new or nothing usable
  kDeviceSilent = 3,    // the device does not answer, or has failed
  kTooLate = 4,         // the loop missed too many ticks
  kKernelFault = 5,     // the kernel latched a fault of its own
  kTooFast = 6,         // the device moved faster than a hand can, or its samples jump
  kBuzz = 7,            // the force swings to and fro faster than a hand can
  kEnergy = 8,          // the hand was given energy, and the passivity controller could not stop it
  kForceExpired = 9,    // the motors got no order in time and have stopped
};
constexpr Fault kLastFault = Fault::kForceExpired;
const char* fault_name(Fault fault);

// Why a sample was not used. Those after kRepeated are of samples that were new.
enum class Refusal : std::uint8_t {
  kNone,
  kSilent,
  kRepeated,
  kLate,
  kNotFinite,
  kAbsurd,
  kJumped
};
const char* refusal_name(Refusal refusal);

// Numbers are part of recordings.
enum class GuardMode : std::uint32_t {
  kLetGo = 0,    // no force: the dead man's button must be seen released
  kUnarmed = 1,  // no force: the button must be pressed
  kRamp = 2,     // force fades in
  kLive = 3,
  kRelease = 4,  // the button was released: force fades out
  kFading = 5,   // a fault is latched: force fades out
  kFault = 6,    // a fault is latched: no force
};
const char* mode_name(GuardMode mode);

struct GuardConfig {
  float period_s = 1e-3F;
  float max_force_n = 8;
  float max_slew_n_per_s =
      2000;                  // at least max_force_n / kDecayS, so that a fault can fade in time
  float ramp_s = 0.5F;       // after arming
  float watchdog_s = 3e-3F;  // longest time without a new usable sample
  float max_speed_m_per_s = 2;
  float buzz_n = 0.8F;           // amplitude
  float continuous_force_n = 8;  // root mean square over thermal_s; max_force_n or more: no budget
  float thermal_s = 60;
  std::int32_t dead_man_button = -1;     // negative: there is no such button, armed from the start
  std::int32_t acknowledge_button = -1;  // released and pressed again, it acknowledges the fault
  // For the observer of energy: what the device itself dissipates and how finely it knows its
  // position, and the most energy that the tissue may have stored to give back.
  DeviceDynamics device = {};
  float stored_energy_j = 0.8F;
  float passivity_damping_n_s_per_m = 0;  // largest damping of the controller; 0: it only observes
};

struct GuardCounters {
  std::uint64_t samples_used;
  std::uint64_t samples_missing;   // no answer
  std::uint64_t samples_repeated;  // sequence number not newer than the last, or no time has passed
  std::uint64_t samples_lost;      // gaps in the sequence numbers
  std::uint64_t samples_old;       // older than watchdog_s, or kMaxLateNs ahead
  std::uint64_t samples_not_finite;
  std::uint64_t samples_absurd;  // farther than kMaxDistanceM away, or not a rotation
  std::uint64_t samples_jumped;  // farther from the last one than any hand moves
  std::uint64_t force_not_finite;
  std::uint64_t force_limited;
  std::uint64_t slew_limited;
  std::uint64_t force_warm;    // limited to less than max_force_n to spare the motors
  std::uint64_t force_damped;  // by the passivity controller
  std::uint64_t faults;
  std::uint64_t rearms;
};

// Work of the hand on the device, less what it gets back: see GUARD.md.
struct EnergyObserver {
  std::uint32_t have_position;
  Vec3 position_m;        // follows the device's, at most its resolution away
  Vec3 velocity_m_per_s;  // averaged over kSpeedS
  double path_m_per_s;    // speed along the path, averaged over kPathS
  std::array<Vec3, kMaxDelayTicks + 2> force_n;  // newest first
  std::uint32_t have_rotation;
  Quat rotation;                                   // of the newest usable sample
  std::array<Vec3, kMaxDelayTicks + 2> torque_nm;  // newest first
  double energy_j, least_j;
};

// The part of the force above kBuzzHz, and how often it changed direction.
struct BuzzDetector {
  Vec3 slow_n, last_n;
  std::uint32_t turns;  // in a row
  std::int64_t ns;      // since the last one
};

// The newest new sample that was refused since the last used one, or that there was none. It stays
// as it was when a fault was latched.
struct RefusedSamples {
  Refusal why;
  std::int64_t for_ns;      // how late it was, or the time without a usable one
  std::int64_t allowed_ns;  // the watchdog
};

struct GuardState {
  GuardMode mode;
  Fault fault;           // latched
  std::uint32_t arming;  // grows with each arming: older orders move nothing
  std::uint32_t have_time;
  std::int64_t now_ns;    // of the newest tick
  std::int64_t step_ns;   // between it and the tick before; 0: the clock stands still
  std::int64_t lost_ns;   // lost by late ticks, less what was made up for
  std::int64_t blind_ns;  // without a usable sample
  RefusedSamples refused;
  std::int64_t jumped_ns;  // of samples that jumped, less a part of that of usable ones
  std::int64_t ramp_ns;    // since arming
  std::int64_t fade_ns;    // since the fault, or since the button was released
  std::uint32_t have_seq;
  std::uint64_t seq;                  // of the newest sample
  std::uint32_t button_seen, button;  // the dead man's, in the newest usable sample since arming
  std::uint32_t may_acknowledge;      // its button was seen released since the force was gone
  std::uint32_t forced;               // a force was ever let through, or the motors ever had one
  std::uint32_t have_pose;
  Vec3 pose_m;   // of the newest usable sample
  Vec3 force_n;  // last one let through
  Vec3 fade_from_n;
  double fade_left;                     // of fade_from_n
  std::uint32_t force_due, torque_due;  // 1: none was let through yet in the newest tick
  std::int64_t due_ns;                  // time since the last force that was let through
  std::uint32_t have_motor;             // the device reports the force of its motors
  Vec3 motor_n;                         // that force, as last reported
  double heat_n2;                       // mean square of the force over thermal_s
  EnergyObserver energy;
  BuzzDetector buzz;
  GuardCounters counters;
};

// Starts at zero force; without a dead man's button it is armed with the first usable sample.
GuardState guard_start();

// Prepares the guard for another run with a device that stays open: what is latched stays latched,
// and motors are as warm as they were, less what they cooled in `idle_ns`. Everything else begins
// anew.
void guard_resume(const GuardConfig& config, GuardState& state, std::int64_t idle_ns);

// Takes the force that the motors have, if the device reports it; call this before guard_sample.
// Motors that have stopped by themselves latch a fault, which says whether their device has failed.
void guard_motor(GuardState& state, const MotorReport& report);

// Whether what is latched ends with the next usable sample: a fault of time before the first force.
bool guard_clears_itself(const GuardState& state);

// Whether the force can only fall: it is fading, or there is none.
bool guard_withdraws_force(const GuardState& state);

// Whether a force is on its way to zero: after a fault, or since the button was released.
bool guard_falls(const GuardState& state);

// Tells the guard that a tick begins `late_ns` too late, or would have begun then; call this before
// guard_sample. What the hand did in that time shall not be felt. guard_sample itself knows only
// the times that it is given, which may be those of a grid.
void guard_late(GuardState& state, std::int64_t late_ns);

// Call this instead of guard_sample where no tick was due: no time counts as lost.
void guard_skip(GuardState& state, std::int64_t now_ns);

// End of a run: fades force and torque to zero whatever is asked. True once nothing is left.
bool guard_end(const GuardConfig& config, GuardState& force_state, GuardState& torque_state,
               std::int64_t now_ns);

// True if the kernel may use the sample. `answered`: the device gave a sample at all. `now_ns` may
// be of any clock that only runs forwards.
bool guard_sample(const GuardConfig& config, GuardState& state, bool answered, const Sample& sample,
                  std::int64_t now_ns);

// Returns the force to send instead of `force_n`. Without a new guard_sample no time has passed,
// and the force stays what it was; only a falling force goes on falling, by one period a call, and
// one that is not finite becomes zero.
Vec3 guard_force(const GuardConfig& config, GuardState& state, Vec3 force_n);

// The same for a torque, at most `max_torque_nm` long (0: no torque), with a guard of its own; a
// fault of the force is also one of the torque, and the other way round. The limits of buzz and
// heat that are fractions of the largest force are the same fractions of the largest torque. The
// torque's work is observed with the force's. It can go from zero to its limit in half the time in
// which a fault fades. Call it after guard_force.
Vec3 guard_torque(const GuardConfig& config, float max_torque_nm, GuardState& force_state,
                  GuardState& torque_state, Vec3 torque_nm);

// What to write to the device: what was let through last, at the newest usable sample's position.
Command guard_command(const GuardConfig& config, const GuardState& force_state,
                      const GuardState& torque_state);

// Latches `fault` unless one is latched already.
void guard_trip(GuardState& state, Fault fault);

// Goes back to the start if `seen` is the latched fault, the force has gone to zero, and the newest
// sample was usable.
bool guard_rearm(GuardState& state, Fault seen);

}  // namespace stylet::hal
