// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/loop.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "hal/base/vector.h"

namespace stylet::hal {
namespace {

std::uint32_t clamped_ns(std::int64_t ns) {
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(ns, 0, std::numeric_limits<std::uint32_t>::max()));
}

Sample steady_sample(const GuardConfig& guard, HandState& state) {
  Sample sample = state.sample;
  sample.pose.position_m = steady_position(guard.device.resolution_m, guard.period_s, state.steady,
                                           sample.pose.position_m);
  return sample;
}

// read device -> guard -> map -> coupling: gives the kernel's input, with the last usable pose if
// there is no new one.
Input next_input(const HandConfig& config, const Device& device, HandState& state,
                 std::int64_t now_ns, TickRecord& record) {
  MotorReport motor;
  if (device.motor != nullptr && device.motor(device.self, motor)) {
    guard_motor(state.guard, motor);
  }
  record.answered = device.read(device.self, now_ns, state.sample) ? 1 : 0;
  record.sample = state.sample;
  const bool was_lost = state.guard.fault != Fault::kNone && state.guard.blind_ns != 0;
  const bool usable =
      guard_sample(config.guard, state.guard, record.answered != 0, state.sample, now_ns);
  if (usable && was_lost) {  // the device may be anywhere now: the needle stays where it is
    grip_take_up(state.grip);
    state.steady = {};
  }
  if (usable) {
    const Sample steady = steady_sample(config.guard, state);
    state.handle = to_world(config.mapping, grip_pose(config.grip, state.grip, steady));
  }
  if (!usable && !state.have_handle) state.handle = to_world(config.mapping, {{}, {1, 0, 0, 0}});
  state.have_handle = true;
  Pose base = state.handle;
  if (usable) {
    base.position_m =
        coupled_base(config.coupling, state.coupling, state.handle.position_m, state.output);
  }
  return {base, usable ? 1U : 0U, plunger_force(config.grip, state.sample)};
}

Vec3 unit_between(Vec3 from, Vec3 to) {
  const Vec3 way = to - from;
  const float size = length(way);
  if (!(size > 0)) return {};
  return {way.x / size, way.y / size, way.z / size};
}

// coupling -> grip -> guard -> device.
Vec3 send_force(const HandConfig& config, const Kernel& kernel, std::uint32_t needle,
                const Device& device, HandState& state) {
  if ((state.output.flags & kFlagFault) != 0) guard_trip(state.guard, Fault::kKernelFault);
  const Vec3 felt =
      coupled_force(config.coupling, state.coupling, state.handle.position_m, state.output.force_n);
  const Wrench wanted = grip_wrench(
      config.grip, state.grip,
      {to_device(config.mapping, felt), to_device(config.mapping, state.output.torque_nm)});
  (void)guard_force(config.guard, state.guard, wanted.force_n);
  (void)guard_torque(config.guard, config.max_torque_nm, state.guard, state.torque_guard,
                     wanted.torque_nm);
  Command command = guard_command(config.guard, state.guard, state.torque_guard);
  // The spring is scaled as the guard scales the force. While the guard lets a force fall slowly it
  // sends more than is asked, but the spring must not become stiffer than it was.
  const float asked = length(wanted.force_n), sent = length(command.force_n);
  const float scale =
      asked > 0 && state.guard.fault == Fault::kNone ? std::min(sent / asked, 1.0F) : 0;
  command.stiffness_n_per_m =
      scale * config.coupling.stiffness_n_per_m * grip_stiffness(config.grip, state.grip);
  std::array<Vec3, kMaxRods + 1> node;
  const std::uint32_t nodes = needle_shape(kernel, needle, node);
  if (nodes >= 2) {
    command.tip_m = place_in_device(config.mapping, node[nodes - 1]);
    command.tip_direction =
        to_device(config.mapping, unit_between(node[nodes - 2], node[nodes - 1]));
  }
  device.write(device.self, command);
  return command.force_n;
}

void note_guard(const HandState& hand, TickRecord& record) {
  record.fault = hand.guard.fault;
  record.fault_number = latched_fault(hand.guard).number;
  record.mode = hand.guard.mode;
  record.energy_j = static_cast<float>(hand.guard.energy.energy_j);
}

// Reads all devices before the kernel moves, and writes all of them after.
void tick_hands(const LoopConfig& config, Kernel& kernel, std::span<const Device> devices,
                std::int64_t now_ns, std::span<TickRecord> records, LoopState& state) {
  std::array<Input, kMaxNeedles> inputs;
  std::array<Output, kMaxNeedles> outputs;
  for (std::uint32_t i = 0; i < records.size(); ++i) {
    records[i] = {};
    records[i].needle = i;
    inputs[i] = next_input(config.hand[i], devices[i], state.hand[i], now_ns, records[i]);
  }
  tick(kernel, std::span(inputs).first(records.size()), std::span(outputs).first(records.size()));
  for (std::uint32_t i = 0; i < records.size(); ++i) {
    HandState& hand = state.hand[i];
    hand.output = outputs[i];
    records[i].input = inputs[i];
    records[i].output = outputs[i];
    records[i].command_n = send_force(config.hand[i], kernel, i, devices[i], hand);
    note_guard(hand, records[i]);
    exchange_mail(state.mailbox[i], hand.guard);
  }
}

// Only the one thread that writes the counter may call this.
void count(std::atomic<std::uint64_t>& counter, std::uint64_t more) {
  counter.store(counter.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

template <typename T>
void push(Ring<T>* ring, const T& item, bool wait_for_room, const std::atomic<bool>& unread,
          std::atomic<std::uint64_t>& lost) {
  if (ring == nullptr) return;
  bool done = ring->push(item);
  while (!done && wait_for_room && !unread.load(std::memory_order_relaxed)) {
    std::this_thread::yield();
    done = ring->push(item);
  }
  if (!done) count(lost, 1);
}

void hand_out(const Outlets& outlets, const Kernel& kernel, std::span<const TickRecord> records,
              LoopState& state) {
  const std::uint32_t happened = records[0].output.events;
  if (happened != state.events_seen) {
    std::array<Event, kMaxEvents> buffer;
    const std::uint32_t fresh = happened - state.events_seen;
    const std::uint32_t known =
        events(kernel, std::span(buffer).first(std::min(fresh, kMaxEvents)));
    count(state.lost_events, fresh - known);
    for (std::uint32_t i = 0; i < known; ++i) {
      push(outlets.events, buffer[i], outlets.wait_for_room, state.unread, state.lost_events);
    }
    state.events_seen = happened;
  }
  for (const TickRecord& r : records) {
    push(outlets.records, r, outlets.wait_for_room, state.unread, state.lost_records);
  }
}

void show(const LoopConfig& config, const Outlets& outlets, const Kernel& kernel,
          std::span<const TickRecord> records, std::uint64_t round, const LoopState& state) {
  if (config.display_every_ticks == 0) return;
  if (round % config.display_every_ticks != 0 && state.ticks != config.ticks) return;
  if (outlets.newest != nullptr) {
    NewestTick& newest = outlets.newest->draft();
    newest.needles = static_cast<std::uint32_t>(records.size());
    std::copy(records.begin(), records.end(), newest.record.begin());
    outlets.newest->publish();
  }
  if (outlets.display == nullptr) return;
  outlets.display->publish(kernel, records, state.missed_ticks, state.lost_records);
}

// One tick of a paused loop: devices are read and guarded, needles wait as with the clutch.
void hold_hands(const LoopConfig& config, const Kernel& kernel, std::span<const Device> devices,
                std::int64_t now_ns, std::span<TickRecord> records, LoopState& state) {
  for (std::uint32_t i = 0; i < records.size(); ++i) {
    HandState& hand = state.hand[i];
    if (config.hand[i].scripted) {
      guard_skip(hand.guard, now_ns);
      continue;
    }
    hand.grip.waits = true;
    (void)next_input(config.hand[i], devices[i], hand, now_ns, records[i]);
    records[i].command_n = send_force(config.hand[i], kernel, i, devices[i], hand);
    hand.grip.waits = false;
    note_guard(hand, records[i]);
    exchange_mail(state.mailbox[i], hand.guard);
  }
}

// The next grid point after `now_ns`; grid points skipped are counted.
std::int64_t next_grid_point(const LoopConfig& config, LoopState& state, std::int64_t grid_ns,
                             std::int64_t now_ns) {
  const std::int64_t next_ns = grid_ns + config.period_ns;
  if (now_ns <= next_ns) return next_ns;
  const std::int64_t missed = (now_ns - next_ns + config.period_ns - 1) / config.period_ns;
  count(state.missed_ticks, static_cast<std::uint64_t>(missed));
  // The guards are told at once: there may be no further tick in which they would see it.
  for (HandState& each : state.hand) guard_late(each.guard, missed * config.period_ns);
  return next_ns + missed * config.period_ns;
}

}  // namespace

namespace {

// Runs one tick, measures it, and hands its results on.
void run_tick(const LoopConfig& config, Kernel& kernel, std::span<const Device> devices,
              std::int64_t grid_ns, std::int64_t late_ns, std::span<TickRecord> records,
              const Outlets& outlets, LoopState& state) {
  const std::int64_t start_ns = monotonic_now_ns();
  tick_hands(config, kernel, devices, grid_ns, records, state);
  const std::int64_t tick_ns = monotonic_now_ns() - start_ns;
  ++state.ticks;
  const bool hashed = config.hash_every_ticks != 0 && state.ticks % config.hash_every_ticks == 0;
  const std::uint64_t state_hash = hashed ? hash(kernel) : 0;
  for (TickRecord& r : records) {
    r.tick_ns = clamped_ns(tick_ns);
    r.late_ns = clamped_ns(late_ns);
    r.state_hash = state_hash;
  }
  hand_out(outlets, kernel, records, state);
  histogram_add(state.tick_time, tick_ns);
  histogram_add(state.lateness, late_ns);
}

// The end of a run: the force that is left fades, on the loop's grid.
void let_go(const LoopConfig& config, std::span<const Device> devices, const Clock& clock,
            std::int64_t grid_ns, LoopState& state) {
  const std::int64_t end_ns = grid_ns + kDecayNs;
  for (bool done = false; !done && grid_ns <= end_ns; grid_ns += config.period_ns) {
    clock.sleep_until_ns(clock.self, grid_ns);
    done = true;
    for (std::size_t i = 0; i < devices.size(); ++i) {
      HandState& hand = state.hand[i];
      Sample unused;  // a relay learns the time from this read; a script is over
      if (devices[i].motor != nullptr) (void)devices[i].read(devices[i].self, grid_ns, unused);
      const bool gone = guard_end(config.hand[i].guard, hand.guard, hand.torque_guard, grid_ns);
      devices[i].write(devices[i].self,
                       guard_command(config.hand[i].guard, hand.guard, hand.torque_guard));
      done = done && gone;
    }
  }
}

}  // namespace

void run_loop(const LoopConfig& config, Kernel& kernel, std::span<const Device> devices,
              const Clock& clock, const Outlets& outlets, LoopState& state) {
  std::int64_t grid_ns = clock.now_ns(clock.self) + config.period_ns;
  std::array<TickRecord, kMaxNeedles> buffer = {};
  const std::span records = std::span(buffer).first(std::min(devices.size(), buffer.size()));
  std::uint64_t round = 0;
  while (state.ticks < config.ticks && !state.stop.load(std::memory_order_relaxed)) {
    state.next_ns.store(grid_ns, std::memory_order_relaxed);
    clock.sleep_until_ns(clock.self, grid_ns);
    const std::int64_t late_ns = clock.now_ns(clock.self) - grid_ns;
    for (HandState& each : state.hand) guard_late(each.guard, late_ns);
    if (state.paused.load(std::memory_order_relaxed)) {
      hold_hands(config, kernel, devices, grid_ns, records, state);
      // In virtual time the clock does not wait: without this, a pause would take a whole
      // processor.
      if (outlets.wait_for_room) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } else {
      run_tick(config, kernel, devices, grid_ns, late_ns, records, outlets, state);
    }
    show(config, outlets, kernel, records, ++round, state);
    grid_ns = next_grid_point(config, state, grid_ns, clock.now_ns(clock.self));
  }
  if (config.lets_go) let_go(config, devices, clock, grid_ns, state);
}

}  // namespace stylet::hal
