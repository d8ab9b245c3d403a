// SPDX-License-Identifier: Apache-2.0
#include "simulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "gap.h"
#include "hal/loop/loop.h"
#include "lattice/voxel.h"
#include "laws/touch.h"
#include "promises.h"
#include "state/attachment.h"
#include "step_energy.h"
#include "tick_work.h"

namespace stylet::test {
namespace {

using hal::TickRecord;

// At the end needles are withdrawn along their axis, at this speed, at first by this much.
constexpr double kLeaveMPerS = 0.2;
constexpr double kLeaveM = 0.12;
// A thin organ of 2 kPa whose masses are scaled for stiffer layers needs 3.2 s for each factor of
// e.
constexpr double kLongestRestS = 60;
constexpr double kAtRestM = 1e-6;
constexpr double kZeroForceS = 25e-3;
// After a tick whose energy is not known, the observer begins again when so many ticks have passed
// without another one: meanwhile bent needles swing back, and voxels that were inside out turn
// back. A choice, not measured.
constexpr std::uint64_t kLostTicks = 100;
// A needle that moves less than this in a tick passes no body unseen: the kernel looks that far for
// bodies (coupling/touches.h). A longer way is checked in steps of half the radius of the smallest
// body (scenario.cpp).
constexpr double kLookedAtM = 2e-3, kWayStepM = 0.5e-3;

double square_sum(Vec3 a, Vec3 b) {
  const double x = static_cast<double>(a.x) - static_cast<double>(b.x),
               y = static_cast<double>(a.y) - static_cast<double>(b.y),
               z = static_cast<double>(a.z) - static_cast<double>(b.z);
  return x * x + y * y + z * z;
}

double dot_double(Vec3 a, Vec3 b) {
  return static_cast<double>(a.x) * static_cast<double>(b.x) +
         static_cast<double>(a.y) * static_cast<double>(b.y) +
         static_cast<double>(a.z) * static_cast<double>(b.z);
}

// ---- the devices
// -----------------------------------------------------------------------------------

// The simulated hand, with turns and spoiled samples, and withdrawn at the end.
struct Player {
  const HandPlan* plan = nullptr;
  hal::SimulatedHand hand;
  Draw draw{0}, button_draw{0};
  bool pressed = false;
  double period_s = 0;
  double turn[3] = {};
  std::uint32_t spoiled_in_a_row = 0;
  std::uint32_t kind = 0;
  bool leaving = false;
  double leave_m_per_s = 0, leave_m = 0, left_m = 0;
  std::uint64_t seq = 0;
};

// Spoils a sample; false: no answer.
bool spoil(Player& player, hal::Sample& sample) {
  float* fields[] = {&sample.pose.position_m.x, &sample.pose.position_m.y,
                     &sample.pose.position_m.z, &sample.pose.rotation.w,
                     &sample.pose.rotation.x,   &sample.pose.rotation.y,
                     &sample.pose.rotation.z};
  float& field = *fields[player.draw.below(7)];
  switch (player.kind) {
    case 0:
      return false;
    case 1:
      sample.seq = player.seq;  // stuck
      return true;
    case 2:
      field = std::numeric_limits<float>::quiet_NaN();
      return true;
    case 3:
      field = player.draw.chance(0.5) ? std::numeric_limits<float>::infinity() : -1e30F;
      return true;
    case 4:
      sample.t_ns -= 1'000'000'000;
      return true;
    case 5:
      sample.pose.position_m.x += player.draw.between(-0.3, 0.3);  // plausible, but a jump
      return true;
    default:
      sample.pose.rotation = {0, 1, 0, 0};
      return true;
  }
}

void turn(Player& player, hal::Sample& sample) {
  const Vec3 rate = player.plan->turn_per_s;
  const double period = player.leaving ? 0 : player.period_s;
  player.turn[0] = std::clamp(player.turn[0] + period * static_cast<double>(rate.x), -0.1, 0.1);
  player.turn[1] = std::clamp(player.turn[1] + period * static_cast<double>(rate.y), -0.1, 0.1);
  player.turn[2] = std::clamp(player.turn[2] + period * static_cast<double>(rate.z), -1.0, 1.0);
  const double size = std::sqrt(1 + player.turn[0] * player.turn[0] +
                                player.turn[1] * player.turn[1] + player.turn[2] * player.turn[2]);
  sample.pose.rotation = {static_cast<float>(1 / size), static_cast<float>(player.turn[0] / size),
                          static_cast<float>(player.turn[1] / size),
                          static_cast<float>(player.turn[2] / size)};
}

// A dead man's button, if there is one, is released and soon pressed again.
void press(Player& player, hal::Sample& sample) {
  const std::int32_t number = player.plan->guard.dead_man_button;
  if (number < 0) return;
  if (player.button_draw.chance(player.pressed ? player.plan->release_share : 0.02)) {
    player.pressed = !player.pressed;
  }
  sample.buttons = player.pressed ? 1U << static_cast<std::uint32_t>(number) : 0;
}

bool read(void* self, std::int64_t now_ns, hal::Sample& sample_out) {
  Player& player = *static_cast<Player*>(self);
  const hal::Device hand = hal::simulated_hand_device(player.hand, player.plan->limits);
  hal::Sample sample = {};
  (void)hand.read(hand.self, now_ns, sample);
  turn(player, sample);
  press(player, sample);
  if (player.leaving) {
    player.left_m =
        std::min(player.left_m + player.leave_m_per_s * player.period_s, player.leave_m);
    sample.pose.position_m.z += static_cast<float>(player.left_m);
  }
  const double time_s = static_cast<double>(player.hand.tick) * player.period_s;
  if (!player.leaving && time_s >= player.plan->dead_from_s) return false;
  if (!player.leaving && player.spoiled_in_a_row == 0 &&
      player.draw.chance(player.plan->bad_share)) {
    player.kind = player.draw.below(7);
    player.spoiled_in_a_row = 1 + (player.draw.chance(0.2) ? player.draw.below(40) : 0);
  }
  const bool spoiled = !player.leaving && player.spoiled_in_a_row > 0;
  if (spoiled) --player.spoiled_in_a_row;
  if (spoiled && !spoil(player, sample)) return false;
  player.seq = sample.seq;
  sample_out = sample;
  return true;
}

void write(void* self, const hal::Command& command) {
  static_cast<Player*>(self)->hand.force_n = command.force_n;
}

// ---- the observer of energy
// ------------------------------------------------------------------------

struct Base {
  Vec3 position_m;
  Quat rotation;
  Vec3 force_n, torque_nm;
  Vec3 shift_m, obstacle_n;  // obstacles stand still while breathing moves the attachments
};

struct Observer {
  std::array<Base, kMaxNeedles> last{};
  std::array<bool, kMaxNeedles> known{};
  double stored_before_j = 0;  // what was stored when the observer began
  double work_j = 0, slack_j = 0, least_j = 0;
  std::uint64_t begin_tick = 0;  // it does not begin before this tick
  bool on = false;
};

// Shift of the attachments at the kernel's present tick.
Vec3 shift_of(const Kernel& kernel) {
  const View view = view_of(kernel);
  return attachment_shift(view.model, view.state);
}

Vec3 turned_by(const Quat& a, const Quat& b) {
  const Vec3 va = {a.x, a.y, a.z}, vb = {b.x, b.y, b.z};
  return 2.0F * (a.w * vb - b.w * va - cross(vb, va));
}

double length(Vec3 v) {
  return std::sqrt(square_sum(v, {}));
}

// How much the mean of two wrenches may differ from the mean along the way between them.
double slack_of(const Base& last, const Base& now, Vec3 step, Vec3 turn) {
  return 0.5 * (std::sqrt(square_sum(now.force_n, last.force_n)) * length(step) +
                std::sqrt(square_sum(now.torque_nm, last.torque_nm)) * length(turn) +
                std::sqrt(square_sum(now.obstacle_n, last.obstacle_n)) *
                    std::sqrt(square_sum(now.shift_m, last.shift_m)));
}

void watch_work(Observer& observer, const Kernel& kernel, std::span<const Output> outputs) {
  for (std::uint32_t i = 0; i < outputs.size(); ++i) {
    const NeedleState& own = *needle_view(view_of(kernel), i).state.needle;
    if (own.handle_known == 0) continue;
    const Base now = {own.base_m,           own.handle.rotation, outputs[i].force_n,
                      outputs[i].torque_nm, shift_of(kernel),    outputs[i].cause.obstacle_n};
    const Base& last = observer.last[i];
    if (observer.known[i]) {
      const Vec3 step = now.position_m - last.position_m,
                 turn = turned_by(last.rotation, now.rotation);
      observer.work_j -= 0.5 * (dot_double(now.force_n, step) + dot_double(last.force_n, step) +
                                dot_double(now.torque_nm, turn) + dot_double(last.torque_nm, turn));
      // In that frame obstacles move the other way, and push.
      observer.work_j -=
          0.5 * dot_double(now.obstacle_n + last.obstacle_n, now.shift_m - last.shift_m);
      observer.slack_j += slack_of(last, now, step, turn);
    }
    observer.last[i] = now;
    observer.known[i] = true;
  }
}

// The observer begins again from what is stored now; the needles' poses and forces are known.
void begin_anew(Observer& observer, double stored_j) {
  observer.stored_before_j = stored_j;
  observer.work_j = observer.slack_j = 0;
}

bool all_outside(const Kernel& kernel) {
  const Stats now = stats(kernel);
  return now.constraint_particles.used == 0 && now.obstacle_contacts.used == 0;
}

// ---- the session
// -----------------------------------------------------------------------------------

struct Simulation {
  const Scenario& scenario;
  const Tamper& tamper;
  const Meter& meter;
  Session session;
  Session copy;                  // for the counter of instructions, if there is one
  std::vector<std::byte> saved;  // the state before a wanted tick; otherwise empty
  hal::LoopConfig config;
  hal::LoopState state;
  hal::Ring<TickRecord> records{2 * kMaxNeedles};
  hal::VirtualTime time;
  std::array<Player, kMaxNeedles> players;
  Draw draw;
  Observer observer;
  TickWork work;
  Verdict verdict;
  std::array<Vec3, kMaxNeedles> command_n{};
  std::array<std::uint32_t, kMaxNeedles> ticks_since_fault{}, blind_ticks{}, released_ticks{};
  std::array<double, kMaxNeedles> heat_n2{};
  std::array<std::vector<Vec3>, kMaxNeedles> nodes_m;  // after the last tick, in the world
  std::int64_t tick_ns = 0, passed_ns = 0;             // of the newest tick; since the one before

  std::uint32_t needles() const { return scenario.config.needle_count; }
};

const char* broken_force(Simulation& s, std::uint32_t needle, const TickRecord& record) {
  const hal::GuardConfig& guard = s.scenario.hands[needle].guard;
  const double force = std::sqrt(square_sum(record.command_n, {}));
  const double change = std::sqrt(square_sum(record.command_n, s.command_n[needle]));
  const double period_s = static_cast<double>(guard.period_s);
  // Ticks may be lost. A fade goes on by the time that passes; all other changes go on by at most a
  // period.
  const double passed_s = std::max(static_cast<double>(s.passed_ns) * 1e-9, period_s);
  const bool ramps = record.mode == hal::GuardMode::kRamp || record.mode == hal::GuardMode::kLive;
  const double most_s = ramps ? period_s : passed_s;
  s.command_n[needle] = record.command_n;
  if (!std::isfinite(force)) return "a force that is not finite is sent";
  if (force > static_cast<double>(guard.max_force_n) * (1 + 1e-6)) return "too large a force";
  if (change > static_cast<double>(guard.max_slew_n_per_s) * most_s * (1 + 1e-5)) {
    return "too fast a change of force";
  }
  auto& since = s.ticks_since_fault[needle];
  since = record.fault == hal::Fault::kNone ? 0 : since + 1;
  auto& blind = s.blind_ticks[needle];
  blind = record.input.valid != 0 ? 0 : blind + 1;
  const auto most = static_cast<std::uint32_t>(kZeroForceS / period_s) + 1;
  if (std::max(since, blind) > most && force > 0) return "force 25 ms after a fault";
  auto& released = s.released_ticks[needle];
  if (record.input.valid != 0) released = record.sample.buttons == 0 ? released + 1 : 0;
  if (guard.dead_man_button >= 0 && released > most && force > 0) {
    return "force 25 ms after the dead man's button was released";
  }
  double& heat = s.heat_n2[needle];
  heat += passed_s / static_cast<double>(guard.thermal_s) * (force * force - heat);
  const double always = static_cast<double>(guard.continuous_force_n);
  if (heat > always * always * (1 + 1e-3)) return "motors warmer than they stand";
  return nullptr;
}

void note_use(Simulation& s, std::span<const Output> outputs) {
  std::uint32_t load = 0;
  for (const Output& out : outputs) load += out.constraint_particles;
  std::array<ObstacleTouch, kMaxNeedles * kMaxTouches> touches;
  const std::uint32_t touched = obstacle_touches(s.session.kernel, touches);
  s.verdict.touches_max = std::max(s.verdict.touches_max, touched);
  load += touched;
  if (load <= s.verdict.busiest_load) return;
  s.verdict.busiest_load = load;
  s.verdict.busiest_tick = outputs[0].tick;
}

// Whether the corners of a voxel are turned inside out. Such a voxel has no nearest rotation: from
// then on its energy is different in every substep.
bool turned_over(const Corners& corners) {
  const float* g = corners.gradient;
  const Vec3 x = {1 + g[0], g[3], g[6]}, y = {g[1], 1 + g[4], g[7]}, z = {g[2], g[5], 1 + g[8]};
  return dot(x, cross(y, z)) < 0;
}

bool inside_out(const Kernel& kernel) {
  View view = view_of(kernel);
  for (std::uint32_t index = 0; index < view.model.head->counts.rows; ++index) {
    const Row& row = view.model.row[index];
    for (std::uint32_t slot = row.slot; slot < row.slot + row.count; ++slot) {
      if (!(view.model.slot_k[slot] > 0)) continue;
      if (turned_over(sum_corners(view.model, view.state, slot, index))) return true;
    }
  }
  return false;
}

// Energy in a needle's contacts with obstacles: in those that press and those that stick.
double touch_energy(const View& view) {
  double sum = 0;
  for (std::uint32_t i = 0; i < view.state.needle->touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    const ObstacleConfig& body = view.model.obstacle[touch.obstacle].config;
    const double k = static_cast<double>(body.stiffness_n_per_m);
    const Press pressed = stylet::press(k, static_cast<double>(body.largest_force_n),
                                        static_cast<double>(touch.depth_m));
    sum += pressed.energy_j + 0.5 * k * square_sum(touch.contact.bristle_m, {});
  }
  return sum;
}

double stored_energy(const Kernel& kernel) {
  const Energy now = energy(kernel);
  double sum = tissue_energy(kernel, now) + now.bending;
  for (std::uint32_t i = 0; i < counts_of(kernel).needles; ++i) {
    sum += touch_energy(needle_view(view_of(kernel), i));
  }
  return sum;
}

float depth_m(const View& view, std::uint32_t body, Vec3 a_m, Vec3 b_m) {
  const NeedlePiece piece = {a_m, b_m, view.model.needle_config().outer_radius_m};
  return std::max(-gap_of(view.model.obstacle[body], piece).separation_m, 0.0F);
}

// How deep a piece was inside a body on its straight way, in so many steps, if that was deeper than
// at both ends; otherwise nothing.
double passed_depth_m(const View& view, std::uint32_t body, const Vec3* before_m, const Vec3* now_m,
                      std::uint32_t steps) {
  const float ends_m = std::max(depth_m(view, body, before_m[0], before_m[1]),
                                depth_m(view, body, now_m[0], now_m[1]));
  float deepest_m = ends_m;
  for (std::uint32_t i = 1; i < steps; ++i) {
    const float part = static_cast<float>(i) / static_cast<float>(steps);
    const Vec3 a_m = before_m[0] + part * (now_m[0] - before_m[0]);
    const Vec3 b_m = before_m[1] + part * (now_m[1] - before_m[1]);
    deepest_m = std::max(deepest_m, depth_m(view, body, a_m, b_m));
  }
  return deepest_m > ends_m ? static_cast<double>(deepest_m) : 0;
}

// The largest difference between a body's force on a piece at this depth on the way and its force
// at the ends, where the piece is less deep; times the way.
double passed_slack_j(const ObstacleConfig& body, double depth_m, double way_m) {
  const double pressed_n = stylet::press(static_cast<double>(body.stiffness_n_per_m),
                                         static_cast<double>(body.largest_force_n), depth_m)
                               .force_n;
  const double friction = static_cast<double>(body.friction);
  return 2 * pressed_n * std::sqrt(1 + friction * friction) * way_m;
}

double passed_slack_j(const View& view, std::span<const Vec3> before_m,
                      std::span<const Vec3> now_m) {
  double farthest_m = 0;
  for (std::size_t i = 0; i < now_m.size(); ++i) {
    farthest_m = std::max(farthest_m, std::sqrt(square_sum(now_m[i], before_m[i])));
  }
  if (!(farthest_m > kLookedAtM)) return 0;
  const auto steps = static_cast<std::uint32_t>(std::ceil(farthest_m / kWayStepM));
  double sum_j = 0;
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    const ObstacleConfig& config = view.model.obstacle[body].config;
    for (std::size_t i = 0; i + 1 < now_m.size(); ++i) {
      const double deepest_m = passed_depth_m(view, body, &before_m[i], &now_m[i], steps);
      sum_j += passed_slack_j(config, deepest_m, farthest_m);
    }
  }
  return sum_j;
}

// For needles that a hand has thrown through a body in a tick, or that were deeper inside it on the
// way than at either end: the force on the way does not lie between the wrenches at the ends.
double passed_slack_j(Simulation& s) {
  View view = view_of(s.session.kernel);
  const Vec3 shift_m = attachment_shift(view.model, view.state);
  double sum_j = 0;
  for (std::uint32_t i = 0; i < s.needles(); ++i) {
    View one = needle_view(view, i);
    if (one.state.needle->handle_known == 0) continue;
    const Vec3* const node = one.state.node;
    std::vector<Vec3> now_m(node, node + one.model.rod->rods + 1);
    for (Vec3& node_m : now_m) node_m = node_m + shift_m;
    std::swap(s.nodes_m[i], now_m);
    if (!now_m.empty()) sum_j += passed_slack_j(one, now_m, s.nodes_m[i]);
  }
  return sum_j;
}

// A needle that found no stable shape (a flag says so) moves by more than a step of its
// equilibrium.
bool loses_count(Simulation& s, std::span<const Output> outputs) {
  if (!s.scenario.gentle && inside_out(s.session.kernel)) return true;
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const Output& out) { return (out.flags & kFlagNeedleUnstable) != 0; });
}

const char* broken_energy(Simulation& s, std::span<const Output> outputs) {
  Observer& observer = s.observer;
  const double stored_j = stored_energy(s.session.kernel);
  const double passed_j = s.scenario.gentle ? 0 : passed_slack_j(s);
  if (loses_count(s, outputs)) {
    observer.on = false;
    observer.begin_tick = outputs[0].tick + kLostTicks;
  } else if (!observer.on && outputs[0].tick >= observer.begin_tick) {
    observer = {.stored_before_j = stored_j, .least_j = observer.least_j, .on = true};
  }
  if (!observer.on) return nullptr;
  ++s.verdict.observed_ticks;
  watch_work(observer, s.session.kernel, outputs);
  const double observed = observer.work_j + observer.stored_before_j - stored_j;
  s.observer.least_j = std::min(s.observer.least_j, observed);
  double allowed = kObserverJ;
  if (!s.scenario.gentle) allowed += s.observer.slack_j + passed_j;
  // The observer begins again after such a tick, because the tick's slack would hide what follows.
  if (passed_j > 0) begin_anew(observer, stored_j);
  return observed > -allowed ? nullptr : "more energy comes out of the tissue than went in";
}

// How much the tick may cost.
const char* broken_bound(Simulation& s, std::uint64_t tick) {
  const Kernel& kernel = s.session.kernel;
  count_work(kernel, shift_of(kernel), s.work);
  const std::uint64_t bound = bound_of(s.work.amount);
  if (bound > s.verdict.dearest_bound) {
    s.verdict.dearest_bound = bound;
    s.verdict.dearest_tick = tick;
  }
  return bound <= kDearestTick ? nullptr : "a tick may cost more than the worst case";
}

void save_for_meter(Simulation& s) {
  if (!s.meter.wanted || !s.meter.wanted(s.state.ticks + 1)) return;
  s.saved.resize(snapshot_bytes(s.session.kernel));
  if (snapshot(s.session.kernel, s.saved) != Status::kOk) std::abort();
}

void call_meter(Simulation& s, std::span<const TickRecord> records) {
  if (s.saved.empty()) return;
  if (restore(s.copy.kernel, s.saved) != Status::kOk) std::abort();
  s.saved.clear();
  std::array<Input, kMaxNeedles> inputs;
  for (std::size_t i = 0; i < records.size(); ++i) inputs[i] = records[i].input;
  s.meter.count(s.copy.kernel, std::span(inputs).first(records.size()));
}

// After a tick, before the next one.
void check_tick(Simulation& s) {
  std::array<TickRecord, kMaxNeedles> records;
  std::array<Output, kMaxNeedles> outputs;
  std::uint32_t count = 0;
  while (count < s.needles() && s.records.pop(records[count])) ++count;
  if (count == 0 || s.verdict.broken != nullptr) return;
  const char* broken = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    outputs[i] = records[i].output;
    if (broken == nullptr) broken = broken_force(s, i, records[i]);
  }
  const std::span all = std::span(outputs).first(count);
  call_meter(s, std::span(records).first(count));
  if (s.tamper) s.tamper(s.session.kernel, outputs[0].tick);
  if (broken == nullptr) broken = broken_promise(s.session.kernel, all);
  if (broken == nullptr) broken = broken_energy(s, all);
  if (broken == nullptr) broken = broken_bound(s, outputs[0].tick);
  note_use(s, all);
  s.verdict.ticks = outputs[0].tick;
  if (broken == nullptr) return;
  s.verdict.broken = broken;
  s.verdict.tick = outputs[0].tick;
  s.state.stop = true;
}

// An operator who sees a fault, waits until the device answers again, and acknowledges; and a loop
// that is late.
void between_ticks(Simulation& s) {
  for (std::uint32_t i = 0; i < s.needles(); ++i) {
    hal::GuardState& guard = s.state.hand[i].guard;
    if (guard.fault != hal::Fault::kNone && s.blind_ticks[i] == 0 && s.draw.chance(0.01)) {
      s.verdict.faults += guard_rearm(guard, guard.fault) ? 1 : 0;
    }
  }
  if (s.draw.chance(s.scenario.late_share)) {
    s.time.now_ns += s.config.period_ns * (1 + s.draw.below(s.draw.chance(0.1) ? 30 : 3));
  }
}

hal::Clock checking_clock(Simulation& simulation) {
  const auto now = [](void* self) { return static_cast<Simulation*>(self)->time.now_ns; };
  const auto sleep = [](void* self, std::int64_t until_ns) {
    Simulation& s = *static_cast<Simulation*>(self);
    check_tick(s);
    between_ticks(s);
    save_for_meter(s);
    s.passed_ns = s.tick_ns == 0 ? 0 : until_ns - s.tick_ns;
    s.tick_ns = until_ns;
    s.time.now_ns = std::max(s.time.now_ns, until_ns);
  };
  return {&simulation, now, sleep};
}

void run_ticks(Simulation& s, std::uint64_t ticks) {
  std::array<hal::Device, kMaxNeedles> devices;
  for (std::uint32_t i = 0; i < s.needles(); ++i) {
    devices[i] = {&s.players[i], s.scenario.hands[i].limits, read, write, [](void*) {}};
  }
  s.config.ticks = s.state.ticks + ticks;
  s.config.lets_go = false;  // the session goes on
  run_loop(s.config, s.session.kernel, std::span(devices).first(s.needles()), checking_clock(s),
           {&s.records, nullptr, nullptr}, s.state);
  check_tick(s);
}

double largest_displacement(const Kernel& kernel) {
  View view = view_of(kernel);
  double largest = 0;
  for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
    largest =
        std::max(largest, square_sum({view.state.ux[i], view.state.uy[i], view.state.uz[i]}, {}));
  }
  return std::sqrt(largest);
}

// Withdraws all needles by this much.
void leave(Simulation& s, double to_m) {
  const double speed_m_per_s = s.scenario.gentle ? kGentleMPerS : kLeaveMPerS;
  double most_m = 0;
  for (std::uint32_t i = 0; i < s.needles(); ++i) {
    Player& player = s.players[i];
    most_m = std::max(most_m, to_m - player.left_m);
    player.leaving = true;
    player.leave_m_per_s = speed_m_per_s;
    player.leave_m = to_m;
  }
  const double period_s = static_cast<double>(s.scenario.config.period_s);
  run_ticks(s, static_cast<std::uint64_t>(1.1 * most_m / speed_m_per_s / period_s));
}

double longest_needle_m(const Config& config) {
  float longest = 0;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    longest = std::max(longest, config.needle[i].length_m);
  }
  return static_cast<double>(longest);
}

// Withdraws all needles and waits for the tissue.
void come_to_rest(Simulation& s) {
  const double period_s = static_cast<double>(s.scenario.config.period_s);
  leave(s, kLeaveM);
  // A violent hand may have pushed a needle through the organ up to its hub and swept the tip
  // aside.
  if (!all_outside(s.session.kernel)) leave(s, kLeaveM + longest_needle_m(s.scenario.config));
  // Friction may hold parts that slide where they were dragged to: they do not move on.
  const bool stays = has_slides(view_of(s.session.kernel).model);
  double before_m = std::numeric_limits<double>::max();
  while (s.verdict.broken == nullptr && s.verdict.rest_s < kLongestRestS) {
    const double now_m = largest_displacement(s.session.kernel);
    const double left_m = stays ? std::abs(now_m - before_m) : now_m;
    if (all_outside(s.session.kernel) && left_m < kAtRestM) return;
    before_m = now_m;
    run_ticks(s, static_cast<std::uint64_t>(0.1 / period_s));
    s.verdict.rest_s += 0.1;
  }
  if (s.verdict.broken != nullptr) return;
  s.verdict.tick = s.verdict.ticks;
  s.verdict.broken = all_outside(s.session.kernel) ? "the tissue does not come back to rest"
                                                   : "a withdrawn needle is still in the tissue";
}

}  // namespace

Session session_of(const Scenario& scenario) {
  Session session = make_session(scenario.organ->organ, scenario.config);
  if (set_obstacles(session.kernel, scenario.obstacles) != Status::kOk) std::abort();
  return session;
}

Verdict simulate(const Scenario& scenario, const Tamper& tamper, const Meter& meter) {
  Simulation s{.scenario = scenario,
               .tamper = tamper,
               .meter = meter,
               .session = session_of(scenario),
               .copy = meter.wanted ? session_of(scenario) : Session{},
               .saved = {},
               .config = {},
               .state = {},
               .time = {},
               .players = {},
               .draw = Draw(scenario.seed + 1),
               .observer = {},
               .work = {},
               .verdict = {},
               .nodes_m = {}};
  const double period_s = static_cast<double>(scenario.config.period_s);
  s.config.period_ns = std::llround(period_s * 1e9);
  for (std::uint32_t i = 0; i < s.needles(); ++i) {
    const HandPlan& plan = scenario.hands[i];
    s.config.hand[i] = {plan.mapping, plan.guard, {}};
    Player& player = s.players[i];
    player.plan = &plan;
    player.period_s = period_s;
    player.draw = Draw(scenario.seed * kMaxNeedles + i);
    player.button_draw = Draw(scenario.seed * kMaxNeedles + i + (1ULL << 40U));
    player.hand.config = plan.hand;
    player.hand.period_s = period_s;
    player.hand.script = hal::make_script(plan.waypoints, plan.start_m);
  }
  run_ticks(s, scenario.ticks);
  if (s.verdict.broken == nullptr) come_to_rest(s);
  s.verdict.observer_min_j = s.observer.least_j;
  return s.verdict;
}

}  // namespace stylet::test
