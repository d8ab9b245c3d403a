// SPDX-License-Identifier: Apache-2.0
// Loops of stylet_loop.h: hal's servo loop with a caller's simulation, devices and guards.
#include "hal/loop/loop.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/clock.h"
#include "hal/base/countdown.h"
#include "hal/device/devices.h"
#include "hal/guard/bounds.h"
#include "hal/hosts/c/hands.h"
#include "hal/hosts/c/process.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"
#include "hal/hosts/c/ticking.h"
#include "hal/loop/display.h"
#include "hal/loop/fit.h"
#include "hal/loop/helpers.h"
#include "hal/loop/host.h"
#include "hal/loop/instance.h"

using namespace stylet;

struct stylet_loop {
  stylet_simulation* simulation = nullptr;
  stylet_loop_config config = {};
  hal::LoopConfig hal_config;
  std::vector<stylet_device*> held;  // closed at the end
  std::vector<hal::Device> devices;
  std::unique_ptr<hal::LoopState> state = std::make_unique<hal::LoopState>();
  std::unique_ptr<hal::Display> display;
  std::unique_ptr<hal::Ring<Event>> events;
  hal::HostState host;
  std::thread thread;
  std::atomic<bool> started{false}, runs{false};
  std::int64_t process = 0;              // that began it
  hal::Countdown ended{1};               // counted once it no longer runs
  std::atomic<std::thread::id> servo{};  // the thread that is in the loop
  std::atomic<int> inside{0};            // threads that are in run or wait
  std::string lacks;
  std::vector<std::string> trouble;

  // For the surface: where its vertices rest, and the particles of each voxel's corners.
  std::vector<stylet_vec3> rest_m;
  std::vector<std::uint32_t> corners;
  const hal::DisplayState* shown = nullptr;

  ~stylet_loop();
};

namespace stylet::c {
namespace {

constexpr int kWarmUpTicks = 200;
// Between two looks at 60 Hz with a loop of 1 kHz some ten are usual.
constexpr std::size_t kKeptEvents = 4096;
// More ticks than anybody waits for: until it is stopped.
constexpr std::uint64_t kEndless = 1ULL << 60U;

stylet_loop_config default_config() {
  return {sizeof(stylet_loop_config), -1, 80, 0, 0, 0, 0, 16};
}

stylet_hand default_hand() {
  return {sizeof(stylet_hand), -1, {{0, 0, 0}, {1, 0, 0, 0}}, 1, 1, 0};
}

stylet_status check(const stylet_loop_config& config, const stylet_loop& loop,
                    stylet_refusal* refusal_out) {
  const bool real = std::ranges::any_of(loop.held, [](const auto* d) { return d->opened; });
  const bool renders =
      std::ranges::any_of(loop.devices, [](const auto& d) { return d.info.max_force_n > 0; });
  FirstOutside first(0);
  first.check("loop.processor", config.processor, -1, 4095);
  first.check("loop.priority", config.priority, 0, hal::kDevicePriority - 1);
  first.check("loop.helpers", config.helpers, 0, kMaxHelpers);
  first.check("loop.virtual_time", config.virtual_time, 0, real ? 0 : 1);
  first.check("loop.show_every_ticks", config.show_every_ticks, 1, 100'000);
  const double period_ns = 1e9 * static_cast<double>(loop.simulation->config.period_s);
  if (renders && config.virtual_time == 0) {
    first.check("period_s", 1e-9 * period_ns, 0, 1e-9 * hal::kLongestDevicePeriodNs);
  }
  return told(first, refusal_out);
}

stylet_status check(const stylet_hand& hand, std::uint32_t index, stylet_refusal* refusal_out) {
  const auto wide = [](float value) { return static_cast<double>(value); };
  const stylet_quat q = hand.start.rotation;
  const stylet_vec3 p = hand.start.position_m;
  FirstOutside first(index);
  first.check("hand.clutch_button", hand.clutch_button, -1, 31);
  first.check("hand.start.rotation", wide(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z), 0.99,
              1.01);
  first.check("hand.start.position_m", wide(std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z)), 0, 10);
  first.check("hand.motion_scale", wide(hand.motion_scale), 0.01, 100);
  first.check("hand.force_scale", wide(hand.force_scale), 0.01, 100);
  first.check("hand.coupling_stiffness_n_per_m", wide(hand.coupling_stiffness_n_per_m), 0,
              hal::kStiffnessBoundsNPerM.most);
  return told(first, refusal_out);
}

hal::HandConfig hand_config(const stylet_hand& hand, const CheckedGuard& guard, float period_s,
                            const stylet_device& device) {
  hal::HandConfig out;
  out.mapping = {pose(hand.start).rotation, pose(hand.start).position_m};
  out.grip.period_s = period_s;
  out.grip.motion_scale = hand.motion_scale;
  out.grip.force_scale = hand.force_scale;
  out.grip.clutch_button = hand.clutch_button;
  out.grip.enabled = !device.scripted;  // a script's places are the needle's
  out.guard = guard.config;
  out.guard.period_s = out.coupling.period_s = period_s;
  out.coupling.stiffness_n_per_m = hand.coupling_stiffness_n_per_m;
  out.coupling.max_force_n = guard.config.max_force_n / hand.force_scale;
  hal::fit_to_device(device.device.info, out.grip, out.guard, out.coupling);
  const float most_nm = device.device.info.max_torque_nm;
  out.max_torque_nm = std::min(guard.max_torque_nm, most_nm);
  out.scripted = device.scripted;
  return out;
}

// Takes the caller's devices, hands and guards, one of each for a needle.
stylet_status take_hands(stylet_loop& loop, stylet_device* const* devices, const stylet_hand* hands,
                         const stylet_guard_config* guards, stylet_refusal* refusal_out) {
  const std::uint32_t hand_bytes = hands == nullptr ? 0 : stride_of(hands);
  const std::uint32_t guard_bytes = guards == nullptr ? 0 : stride_of(guards);
  for (std::uint32_t i = 0; i < loop.simulation->config.needle_count; ++i) {
    if (devices[i] == nullptr) return refuse_missing(refusal_out, "devices", i);
    if (devices[i]->taken) {
      return refuse_value(refusal_out, STYLET_ARGUMENT_OUT_OF_RANGE, "devices", i,
                          "a device that no other loop or needle has", i, "taken");
    }
    stylet_hand hand = default_hand();
    if (hands != nullptr && !take(element(hands, hand_bytes, i), hand_bytes, hand)) {
      return refuse_struct(refusal_out, "hand", hands, i);
    }
    stylet_status status = check(hand, i, refusal_out);
    CheckedGuard guard;
    guard.max_torque_nm = devices[i]->device.info.max_torque_nm;
    if (status == STYLET_OK && guards != nullptr) {
      status = read_guard(element(guards, guard_bytes, i), guard_bytes, i, guard, refusal_out);
    }
    if (status != STYLET_OK) return status;
    loop.hal_config.hand[i] =
        hand_config(hand, guard, loop.simulation->config.period_s, *devices[i]);
    loop.devices.push_back(devices[i]->device);
    loop.held.push_back(devices[i]);
    devices[i]->taken = true;
  }
  return STYLET_OK;
}

void prepare_to_show(stylet_loop& loop) {
  const Kernel& kernel = loop.simulation->kernel;
  const Organ& organ = loop.simulation->organ->organ;
  loop.display = std::make_unique<hal::Display>(kernel);
  loop.events = std::make_unique<hal::Ring<Event>>(kKeptEvents);
  loop.rest_m.resize(organ.vertices.size());
  (void)stylet_organ_vertices(loop.simulation->organ, loop.rest_m.data(),
                              static_cast<std::uint32_t>(loop.rest_m.size()));
  loop.corners.resize(8 * std::size_t{organ.voxel_count});
  (void)voxel_corners(kernel, loop.corners);
}

void tell(stylet_loop& loop, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) loop.lacks += line + "\n";
}

void warm(stylet_loop& loop) {
  if (stats(loop.simulation->kernel).ticks > 0) return;  // it is under way: nothing to forget
  std::vector<Input> starts;
  for (std::uint32_t i = 0; i < loop.devices.size(); ++i) {
    const hal::Mapping& mapping = loop.hal_config.hand[i].mapping;
    starts.push_back({hal::to_world(mapping, {{}, {1, 0, 0, 0}}), 1});
  }
  hal::warm_up(loop.simulation->kernel, starts, kWarmUpTicks);
}

// The loop's thread, from its rights to the last tick.
void servo(stylet_loop& loop) {
  const bool real_time = loop.config.virtual_time == 0;
  hal::HelperConfig helping = {loop.config.helpers, false, {}, loop.config.priority};
  if (real_time && loop.config.lock_memory != 0) hal::prepare_process(loop.host);
  if (real_time && loop.config.priority > 0) {
    const std::vector<int> processors = hal::loop_processors(loop.config.processor);
    if (!processors.empty()) {
      hal::prepare_thread(processors[0], loop.config.priority, loop.host.report);
    }
    helping.real_time = processors.size() > loop.config.helpers;
    if (helping.real_time) helping.cpus.assign(processors.begin() + 1, processors.end());
  }
  std::unique_ptr<hal::Helpers> helpers;
  if (helping.count > 0) {
    helpers = std::make_unique<hal::Helpers>(loop.simulation->kernel, helping, *loop.state,
                                             loop.host.report);
  }
  warm(loop);
  hal::VirtualTime time;
  const hal::Clock clock = real_time ? hal::monotonic_clock() : hal::virtual_clock(time);
  const hal::Outlets outlets = {nullptr, loop.events.get(), loop.display.get(), false, nullptr};
  hal::run_loop(loop.hal_config, loop.simulation->kernel, loop.devices, clock, outlets,
                *loop.state);
}

void serve(stylet_loop& loop) noexcept {
  loop.servo.store(std::this_thread::get_id());
  try {
    servo(loop);
  } catch (const std::exception& error) {
    tell(loop, {error.what()});
  }
  tell(loop, loop.host.report.lacks);
  loop.servo.store({});
  loop.runs.store(false, std::memory_order_release);
  loop.ended.count_down();
}

// A vertex moves as the corners of its voxel do, in proportion to how near they are.
stylet_vec3 moved(const stylet_loop& loop, const OrganVertex& vertex, std::size_t index) {
  constexpr float kScale = 1.0F / 65535.0F;
  const float at[3] = {static_cast<float>(vertex.fx) * kScale,
                       static_cast<float>(vertex.fy) * kScale,
                       static_cast<float>(vertex.fz) * kScale};
  stylet_vec3 out = loop.rest_m[index];
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    float weight = 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      weight *= ((corner >> axis) & 1U) != 0 ? at[axis] : 1 - at[axis];
    }
    const Vec3 by = loop.shown->moved_m[loop.corners[8 * std::size_t{vertex.voxel} + corner]];
    out.x += weight * by.x;
    out.y += weight * by.y;
    out.z += weight * by.z;
  }
  return out;
}

std::uint64_t ns(double us) {
  return static_cast<std::uint64_t>(1e3 * us);
}

// A thread that is in a call for the loop, which may not go away under it.
struct Inside {
  stylet_loop& loop;
  explicit Inside(stylet_loop& of) : loop(of) { loop.inside.fetch_add(1); }
  ~Inside() { loop.inside.fetch_sub(1); }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
};

// A fork copied it: the thread that could end it, and answer for its device, is not here.
bool runs_elsewhere(const stylet_loop& loop) {
  return loop.runs.load() && loop.process != this_process();
}

stylet_status begin(stylet_loop* loop) {
  if (loop == nullptr) return STYLET_ARGUMENT_MISSING;
  if (loop->started.exchange(true)) return STYLET_LOOP_RUNS;
  loop->process = this_process();
  loop->runs.store(true);
  return STYLET_OK;
}

}  // namespace
}  // namespace stylet::c

stylet_loop::~stylet_loop() {
  state->stop.store(true);
  if (runs.load()) ended.wait();
  const bool elsewhere = started.load() && process != c::this_process();
  while (!elsewhere && inside.load() > 0) std::this_thread::yield();
  if (elsewhere && thread.joinable()) thread.detach();
  if (thread.joinable()) thread.join();
  for (stylet_device* each : held) {
    each->taken = false;
    stylet_device_close(each);
  }
  if (simulation == nullptr) return;
  simulation->in_loop.store(false, std::memory_order_release);
  stylet_simulation_free(simulation);
}

stylet_status stylet_loop_config_init(stylet_loop_config* config, size_t struct_bytes) {
  return c::init(c::default_config(), config, struct_bytes);
}

stylet_status stylet_hand_init(stylet_hand* hand, size_t struct_bytes) {
  return c::init(c::default_hand(), hand, struct_bytes);
}

stylet_status stylet_loop_create(stylet_simulation* simulation, const stylet_loop_config* config,
                                 stylet_device* const* devices, const stylet_hand* hands,
                                 const stylet_guard_config* guards, stylet_loop** loop_out,
                                 stylet_refusal* refusal_out) try {
  if (loop_out != nullptr) *loop_out = nullptr;
  if (loop_out == nullptr) return c::refuse_missing(refusal_out, "loop_out");
  if (devices == nullptr) return c::refuse_missing(refusal_out, "devices");
  stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return c::refuse_unready(refusal_out, status);
  auto made = std::make_unique<stylet_loop>();
  made->config = c::default_config();
  if (config != nullptr && !c::take(config, made->config)) {
    return c::refuse_struct(refusal_out, "loop", config);
  }
  made->simulation = c::keep(simulation);
  const auto give_back = [&made](stylet_status why) {
    for (stylet_device* each : made->held) each->taken = false;
    made->held.clear();  // they stay the caller's
    return why;
  };
  status = c::take_hands(*made, devices, hands, guards, refusal_out);
  if (status == STYLET_OK) status = c::check(made->config, *made, refusal_out);
  if (status != STYLET_OK) return give_back(status);
  hal::LoopConfig& loop = made->hal_config;
  loop.period_ns = std::llround(1e9 * static_cast<double>(simulation->config.period_s));
  loop.ticks = made->config.ticks == 0 ? c::kEndless : made->config.ticks;
  loop.display_every_ticks = made->config.show_every_ticks;
  made->trouble.resize(made->devices.size());
  try {
    c::prepare_to_show(*made);
  } catch (...) {
    give_back(STYLET_OUT_OF_MEMORY);
    throw;
  }
  simulation->in_loop.store(true, std::memory_order_release);
  *loop_out = made.release();
  return c::refuse(refusal_out, STYLET_OK);
} catch (const std::exception&) {
  return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
}

stylet_status stylet_loop_start(stylet_loop* loop) {
  const stylet_status status = c::begin(loop);
  if (status != STYLET_OK) return status;
  try {
    loop->thread = std::thread([loop] { c::serve(*loop); });
  } catch (const std::exception&) {
    loop->runs.store(false);
    loop->ended.count_down();
    return STYLET_OUT_OF_MEMORY;
  }
  return STYLET_OK;
}

stylet_status stylet_loop_run(stylet_loop* loop) {
  if (loop == nullptr) return STYLET_ARGUMENT_MISSING;
  const c::Inside inside(*loop);
  const stylet_status status = c::begin(loop);
  if (status == STYLET_OK) c::serve(*loop);
  return status;
}

void stylet_loop_ask_to_stop(stylet_loop* loop) {
  if (loop != nullptr) loop->state->stop.store(true);
}

stylet_status stylet_loop_wait(stylet_loop* loop) {
  if (loop == nullptr) return STYLET_ARGUMENT_MISSING;
  if (loop->servo.load() == std::this_thread::get_id()) return STYLET_LOOP_RUNS;
  if (c::runs_elsewhere(*loop)) return STYLET_LOOP_RUNS;
  const c::Inside inside(*loop);
  if (loop->runs.load()) loop->ended.wait();
  return STYLET_OK;
}

void stylet_loop_free(stylet_loop* loop) {
  if (loop == nullptr || c::runs_elsewhere(*loop)) return;
  // From a function of a device: the loop cannot end under itself.
  if (loop->servo.load() == std::this_thread::get_id()) return stylet_loop_ask_to_stop(loop);
  delete loop;
}

void stylet_loop_pause(stylet_loop* loop, int paused) {
  if (loop != nullptr) loop->state->paused.store(paused != 0);
}

int stylet_loop_take(stylet_loop* loop) {
  if (loop == nullptr) return 0;
  const hal::DisplayState* const newest = loop->display->take();
  if (newest == nullptr) return 0;
  loop->shown = newest;
  return 1;
}

stylet_status stylet_loop_get_output(const stylet_loop* loop, uint32_t needle,
                                     stylet_output* output_out) {
  if (loop == nullptr || output_out == nullptr) return c::missing(output_out);
  stylet_output out = {};
  const bool there = needle < loop->devices.size();
  if (there && loop->shown != nullptr) out = c::to_output(loop->shown->hand[needle].output);
  if (!c::give(out, output_out)) return STYLET_STRUCT_SIZE_UNKNOWN;
  return there ? STYLET_OK : STYLET_ARGUMENT_OUT_OF_RANGE;
}

uint32_t stylet_loop_surface(const stylet_loop* loop, stylet_vec3* out, uint32_t capacity) {
  if (loop == nullptr) return 0;
  const Organ& organ = loop->simulation->organ->organ;
  const std::size_t fits =
      out == nullptr ? 0 : std::min<std::size_t>(capacity, loop->rest_m.size());
  for (std::size_t i = 0; i < fits; ++i) {
    out[i] = loop->shown == nullptr ? loop->rest_m[i] : c::moved(*loop, organ.vertices[i], i);
  }
  return static_cast<std::uint32_t>(loop->rest_m.size());
}

uint32_t stylet_loop_needle_shape(const stylet_loop* loop, uint32_t needle, stylet_vec3* out,
                                  uint32_t capacity) {
  if (loop == nullptr || loop->shown == nullptr || needle >= loop->devices.size()) return 0;
  const std::uint32_t nodes = std::min(loop->shown->nodes[needle], kMaxRods + 1);
  for (std::uint32_t i = 0; out != nullptr && i < std::min(nodes, capacity); ++i) {
    out[i] = c::plain(loop->shown->node_m[needle][i]);
  }
  return nodes;
}

stylet_status stylet_loop_get_hand(const stylet_loop* loop, uint32_t needle,
                                   stylet_hand_report* report_out) {
  if (loop == nullptr || report_out == nullptr) return c::missing(report_out);
  stylet_hand_report out = {};
  const bool there = needle < loop->devices.size();
  if (there && loop->shown != nullptr) {
    const hal::TickRecord& hand = loop->shown->hand[needle];
    out.mode = static_cast<std::uint32_t>(hand.mode);
    out.fault = static_cast<std::uint32_t>(hand.fault);
    out.fault_number = hand.fault_number;
    out.sent_force_n = c::plain(hand.command_n);
    out.answered = hand.answered;
  }
  if (!c::give(out, report_out)) return STYLET_STRUCT_SIZE_UNKNOWN;
  return there ? STYLET_OK : STYLET_ARGUMENT_OUT_OF_RANGE;
}

uint32_t stylet_loop_events(stylet_loop* loop, stylet_event* out, uint32_t capacity) {
  if (loop == nullptr || out == nullptr) return 0;
  std::uint32_t count = 0;
  for (Event event; count < capacity && loop->events->pop(event); ++count) {
    out[count] = {event.tick,
                  static_cast<std::uint32_t>(event.kind),
                  event.layer,
                  event.depth_m,
                  event.force_n,
                  event.needle,
                  0};
  }
  return count;
}

stylet_status stylet_loop_acknowledge(stylet_loop* loop, uint32_t needle, uint32_t fault,
                                      uint32_t fault_number) {
  if (loop == nullptr) return STYLET_ARGUMENT_MISSING;
  if (needle >= loop->devices.size()) return STYLET_ARGUMENT_OUT_OF_RANGE;
  loop->state->mailbox[needle].seen.store({static_cast<hal::Fault>(fault), fault_number},
                                          std::memory_order_relaxed);
  return STYLET_OK;
}

stylet_status stylet_loop_get_report(const stylet_loop* loop, stylet_loop_report* report_out) {
  if (loop == nullptr || report_out == nullptr) return c::missing(report_out);
  if (c::runs_elsewhere(*loop)) return c::nothing(STYLET_LOOP_RUNS, report_out);
  stylet_loop_report out = {};
  const hal::LoopState& state = *loop->state;
  out.runs = loop->runs.load(std::memory_order_acquire) ? 1 : 0;
  out.missed_ticks = state.missed_ticks.load();
  out.lost_events = state.lost_events.load();
  if (out.runs == 0) {
    const auto at = hal::histogram_quantile_us;
    out.ticks = state.ticks;
    out.tick_p50_ns = c::ns(at(state.tick_time, 0.5));
    out.tick_p999_ns = c::ns(at(state.tick_time, 0.999));
    out.tick_max_ns = static_cast<std::uint64_t>(state.tick_time.max_ns);
    out.late_p50_ns = c::ns(at(state.lateness, 0.5));
    out.late_p999_ns = c::ns(at(state.lateness, 0.999));
    out.late_max_ns = static_cast<std::uint64_t>(state.lateness.max_ns);
  }
  return c::answer(out, report_out);
}

const char* stylet_loop_lacks(const stylet_loop* loop) {
  // The loop's thread writes it at its end.
  const bool ended = loop != nullptr && !loop->runs.load(std::memory_order_acquire);
  return ended ? loop->lacks.c_str() : "";
}

const char* stylet_loop_trouble(stylet_loop* loop, uint32_t needle) try {
  if (loop == nullptr || needle >= loop->devices.size()) return "";
  loop->trouble[needle] = hal::trouble_of(loop->devices[needle]);
  return loop->trouble[needle].c_str();
} catch (const std::exception&) {
  return "out of memory";
}
