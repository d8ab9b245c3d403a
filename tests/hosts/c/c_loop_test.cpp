// SPDX-License-Identifier: Apache-2.0
// Guard, devices and loop of the C interface against hal's own: the same forces, bit for bit;
// mistakes are reported; devices that a loop holds are closed once, without force.
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "c_support.h"
#include "hal/device/drivers/simulated_hand.h"
#include "hal/loop/fit.h"
#include "hal/loop/loop.h"

namespace stylet::test {
namespace {

using namespace hal;

stylet_refusal no_refusal() {
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  return why;
}

GuardHandle c_guard(const stylet_guard_config& config) {
  stylet_guard* made = nullptr;
  stylet_refusal why = no_refusal();
  EXPECT_EQ(stylet_guard_create(&config, &made, &why), STYLET_OK) << why.text;
  return GuardHandle(made);
}

// Sessions with silence, jumps, numbers that are not finite, forces that are too large, late ticks.
TEST(CGuard, RandomSessionsAreThoseOfHalsGuard) {
  Draw draw(31);
  for (int session = 0; session < 40; ++session) {
    GuardConfig config;
    config.max_force_n = draw.between(1, 12);
    config.max_slew_n_per_s = config.max_force_n / kDecayS * draw.between(1, 4);
    config.buzz_n = draw.between(0.2, 2);
    config.passivity_damping_n_s_per_m = draw.chance(0.5) ? 0 : draw.between(0, 5);
    stylet_guard_config config_c;
    ASSERT_EQ(stylet_guard_config_init(&config_c, sizeof config_c), STYLET_OK);
    config_c.max_force_n = config.max_force_n;
    config_c.max_slew_n_per_s = config.max_slew_n_per_s;
    config_c.buzz_n = config.buzz_n;
    config_c.passivity_damping_n_s_per_m = config.passivity_damping_n_s_per_m;
    config_c.max_torque_nm = 0.1F;
    const GuardHandle c = c_guard(config_c);
    GuardState force = guard_start(), torque = guard_start();
    std::int64_t now_ns = 1'000'000'000;
    Sample sample = {1, now_ns, {{0, 0, 0}, {1, 0, 0, 0}}, 0};
    for (int i = 0; i < 2000; ++i) {
      const std::int64_t passed_ns = 1'000'000 * (draw.chance(0.99) ? 1 : draw.below(60));
      now_ns += passed_ns;
      const bool answered = draw.chance(0.98);
      if (answered) {
        ++sample.seq;
        sample.t_ns = now_ns;
        sample.pose.position_m.x += draw.between(-1e-4, 1e-4);
        if (draw.chance(0.002)) sample.pose.position_m.y = std::nanf("");
        if (draw.chance(0.002)) sample.pose.position_m = {draw.between(-1, 1), 0, 0};
      }
      const Vec3 asked = {
          draw.between(-3, 3), draw.between(-1, 1),
          draw.chance(0.001) ? std::numeric_limits<float>::infinity() : draw.between(-20, 20)};
      const Vec3 p = sample.pose.position_m;
      const stylet_sample sample_c = {sizeof sample_c,
                                      sample.buttons,
                                      sample.seq,
                                      sample.t_ns,
                                      {{p.x, p.y, p.z}, {1, 0, 0, 0}},
                                      0};
      const bool used = guard_sample(config, force, answered, sample, now_ns);
      ASSERT_EQ(stylet_guard_sample(c.get(), answered ? &sample_c : nullptr, now_ns), used ? 1 : 0);
      const Vec3 sent = guard_force(config, force, asked);
      const stylet_vec3 sent_c = stylet_guard_force(c.get(), {asked.x, asked.y, asked.z});
      ASSERT_EQ(std::memcmp(&sent, &sent_c, sizeof sent), 0) << session << " " << i;
      const Vec3 turned = guard_torque(config, 0.1F, force, torque, {0.01F, 0, asked.y});
      const stylet_vec3 turned_c = stylet_guard_torque(c.get(), {0.01F, 0, asked.y});
      ASSERT_EQ(std::memcmp(&turned, &turned_c, sizeof turned), 0) << session << " " << i;
      if (draw.chance(0.01)) {
        const Fault seen = force.fault;
        const bool rearmed = seen != Fault::kNone && guard_rearm(force, seen);
        ASSERT_EQ(stylet_guard_rearm(c.get(), static_cast<std::uint32_t>(seen)), rearmed ? 1 : 0);
      }
    }
    stylet_guard_report report = {};
    report.struct_bytes = sizeof report;
    ASSERT_EQ(stylet_guard_get_report(c.get(), &report), STYLET_OK);
    EXPECT_EQ(report.mode, static_cast<std::uint32_t>(force.mode));
    EXPECT_EQ(report.fault, static_cast<std::uint32_t>(force.fault));
    EXPECT_EQ(report.faults, force.counters.faults);
    EXPECT_EQ(report.samples_used, force.counters.samples_used);
    EXPECT_EQ(report.samples_not_finite, force.counters.samples_not_finite);
    EXPECT_EQ(report.force_limited, force.counters.force_limited);
  }
}

TEST(CGuard, EveryLimitIsCheckedAndReported) {
  struct Outside {
    const char* field;
    float stylet_guard_config::*of;
    float value;
  };
  const Outside outside[] = {
      {"guard.period_s", &stylet_guard_config::period_s, 0},
      {"guard.max_force_n", &stylet_guard_config::max_force_n, 101},
      {"guard.max_force_n", &stylet_guard_config::max_force_n, std::nanf("")},
      {"guard.max_slew_n_per_s", &stylet_guard_config::max_slew_n_per_s, 300},  // 8 N in 20 ms: 400
      {"guard.watchdog_s", &stylet_guard_config::watchdog_s, 0.02F},
      {"guard.buzz_n", &stylet_guard_config::buzz_n, 0},
      {"guard.device_delay_s", &stylet_guard_config::device_delay_s, 0.017F},
      {"guard.max_torque_nm", &stylet_guard_config::max_torque_nm, -1},
  };
  for (const Outside& each : outside) {
    stylet_guard_config config;
    ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
    config.*each.of = each.value;
    stylet_guard* made = nullptr;
    stylet_refusal why = no_refusal();
    EXPECT_EQ(stylet_guard_create(&config, &made, &why), STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    EXPECT_EQ(made, nullptr);
    EXPECT_STREQ(why.place, each.field);
  }
}

float force_left(const stylet_guard* guard) {
  stylet_guard_report report = {};
  report.struct_bytes = sizeof report;
  EXPECT_EQ(stylet_guard_get_report(guard, &report), STYLET_OK);
  return report.force_n.z;
}

// The force at the end of a run falls linearly to zero in 20 ms of the caller's clock, however
// often the guard is called; it also ends with a clock that jumps, stands still or runs backwards.
TEST(CGuard, EndFollowsTheClockAndComesInAnyCase) {
  Draw draw(31);
  stylet_guard_config config;
  ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
  constexpr std::int64_t kBegin = 1'000'000'000, kFadeNs = 20'000'000, kPeriodNs = 1'000'000;
  const auto armed = [&](std::int64_t& now_ns) {
    GuardHandle guard = c_guard(config);
    now_ns = kBegin;
    for (int i = 1; i <= 400; ++i, now_ns += kPeriodNs) {
      const stylet_sample sample = {
          sizeof sample, 0, static_cast<std::uint64_t>(i), now_ns, {{0, 0, 0}, {1, 0, 0, 0}}, 0};
      EXPECT_EQ(stylet_guard_sample(guard.get(), &sample, now_ns), 1);
      (void)stylet_guard_force(guard.get(), {0, 0, 3});
    }
    now_ns -= kPeriodNs;  // of the last sample
    return guard;
  };
  for (int n = 0; n < 20; ++n) {
    std::int64_t now_ns = 0;
    const GuardHandle guard = armed(now_ns);
    const std::int64_t begin_ns = now_ns;
    const float begin_n = force_left(guard.get());
    ASSERT_GT(begin_n, 1);
    const auto longest_ns = static_cast<double>(draw.between(2'000, 3'000'000));
    int ended = 0;
    while (ended == 0) {
      now_ns += 1 + static_cast<std::int64_t>(draw.between(0, longest_ns));
      ended = stylet_guard_end(guard.get(), now_ns);
      const auto passed_ns = static_cast<float>(now_ns - begin_ns);
      if (ended == 0) {  // falls to zero at the fade's last whole period
        const float left_n = force_left(guard.get()), close_n = begin_n * 1e-4F;
        EXPECT_LE(left_n, begin_n * (1 - passed_ns / kFadeNs) + close_n);
        EXPECT_GE(left_n, begin_n * (1 - passed_ns / (kFadeNs - kPeriodNs)) - close_n);
      }
    }
    EXPECT_EQ(force_left(guard.get()), 0);
    EXPECT_GE(now_ns - begin_ns, kFadeNs - kPeriodNs);  // the last period need not begin
  }
  const std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t other : {std::int64_t{0}, kBegin, -most - 1, most}) {
    std::int64_t now_ns = 0;
    const GuardHandle guard = armed(now_ns);
    int calls = 1;
    while (stylet_guard_end(guard.get(), other) == 0) ASSERT_LE(++calls, 20) << other;
    EXPECT_EQ(calls, other == most ? 1 : 20) << other;
    EXPECT_EQ(force_left(guard.get()), 0);
  }
}

// Every known model's own limits are within those that a guard accepts.
TEST(CGuard, KnowsTheModels) {
  std::uint32_t count = 0;
  for (; stylet_device_model(count) != nullptr; ++count) {
    stylet_guard_config config;
    ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
    ASSERT_EQ(stylet_guard_config_for(&config, stylet_device_model(count)), STYLET_OK);
    const DeviceModel& model = *find_device_model(stylet_device_model(count));
    EXPECT_LE(config.max_force_n, model.max_force_n);
    EXPECT_LE(config.continuous_force_n, model.continuous_force_n);
    (void)c_guard(config);
  }
  EXPECT_GE(count, 4U);
  stylet_guard_config config;
  ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
  EXPECT_EQ(stylet_guard_config_for(&config, "a broomstick"), STYLET_ARGUMENT_OUT_OF_RANGE);
}

// A device of the test behind the callbacks: hal's simulated hand.
struct OwnHand {
  SimulatedHand hand;
  Device device;
  std::vector<Vec3> sent;
};

int read_own(void* self, std::int64_t now_ns, stylet_sample* out) {
  auto& own = *static_cast<OwnHand*>(self);
  Sample sample = {};
  if (!own.device.read(own.device.self, now_ns, sample)) return 0;
  const Vec3 p = sample.pose.position_m;
  const Quat q = sample.pose.rotation;
  out->seq = sample.seq;
  out->t_ns = sample.t_ns;
  out->buttons = sample.buttons;
  out->pose = {{p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}};
  return 1;
}

void write_own(void* self, const stylet_command* command) {
  auto& own = *static_cast<OwnHand*>(self);
  const Vec3 force = {command->force_n.x, command->force_n.y, command->force_n.z};
  own.sent.push_back(force);
  own.device.write(own.device.self, {.force_n = force});
}

DeviceInfo limits_of_own() {
  return {"own", 4, 1000, 500};
}

void start_own(OwnHand& own) {
  own.hand.script = make_script({{.travel_m = 0.02F, .speed_m_per_s = 0.03F, .hold_s = 0.1F},
                                 {.travel_m = 0, .speed_m_per_s = 0.05F}},
                                0);
  own.device = simulated_hand_device(own.hand, limits_of_own());
}

stylet_device_functions functions_of_own() {
  stylet_device_functions functions = {};
  functions.struct_bytes = sizeof functions;
  functions.read = read_own;
  functions.write = write_own;
  functions.max_force_n = limits_of_own().max_force_n;
  functions.max_slew_n_per_s = limits_of_own().max_slew_n_per_s;
  functions.max_stiffness_n_per_m = limits_of_own().max_stiffness_n_per_m;
  return functions;
}

stylet_device* own_device(OwnHand& own) {
  stylet_device_functions functions = functions_of_own();
  functions.self = &own;
  stylet_device* made = nullptr;
  EXPECT_EQ(stylet_device_from_functions(&functions, &made, nullptr), STYLET_OK);
  return made;
}

struct Bench {
  std::unique_ptr<OpenOrgan> opened = block_organ(6, 5, 6);
  OrganHandle organ = c_organ(*opened);
  Config config;
  SimulationHandle simulation;
  stylet_hand hand;
  stylet_loop_config loop_config;

  Bench() {
    config.needle[0].bending_nm2 = 0.02F;
    DrawnConfig same;
    same.cpp = config;
    EXPECT_EQ(stylet_config_init(&same.c, sizeof same.c), STYLET_OK);
    same.needles.push_back(test::to_c(config.needle[0]));
    simulation = c_simulation(organ.get(), same);
    EXPECT_EQ(stylet_hand_init(&hand, sizeof hand), STYLET_OK);
    const Vec3 entry = block_script(opened->organ, config).entry_m;
    hand.start = stylet_pose_of_tip({entry.x + 1e-3F, entry.y, entry.z + 1e-3F}, {0.1F, 0, -1},
                                    config.needle[0].length_m);
    EXPECT_EQ(stylet_loop_config_init(&loop_config, sizeof loop_config), STYLET_OK);
    loop_config.virtual_time = 1;
    loop_config.ticks = 1300;
  }

  // Runs in real time until it is stopped.
  void in_real_time() {
    loop_config.virtual_time = 0;
    loop_config.priority = 0;
    loop_config.ticks = 0;
    loop_config.show_every_ticks = 1;
  }
  LoopHandle loop(stylet_device* device) {
    stylet_loop* made = nullptr;
    stylet_refusal why = no_refusal();
    EXPECT_EQ(
        stylet_loop_create(simulation.get(), &loop_config, &device, &hand, nullptr, &made, &why),
        STYLET_OK)
        << why.text;
    return LoopHandle(made);
  }
};

// hal's loop with hal's fit, on the same devices.
std::vector<Vec3> sent_by_hal(const Bench& bench, std::uint64_t& hash_out) {
  Session cpp = make_session(bench.opened->organ, bench.config);
  OwnHand own;
  start_own(own);
  LoopConfig config;
  config.ticks = bench.loop_config.ticks;
  HandConfig& hand = config.hand[0];
  const stylet_pose start = bench.hand.start;
  hand.mapping = {{start.rotation.w, start.rotation.x, start.rotation.y, start.rotation.z},
                  {start.position_m.x, start.position_m.y, start.position_m.z}};
  hand.coupling.max_force_n = hand.guard.max_force_n;
  hand.grip.enabled = true;
  fit_to_device(limits_of_own(), hand.grip, hand.guard, hand.coupling);
  Device device = own.device;
  device.self = &own;
  device.read = [](void* self, std::int64_t now_ns, Sample& out) {
    return static_cast<OwnHand*>(self)->device.read(static_cast<OwnHand*>(self)->device.self,
                                                    now_ns, out);
  };
  device.write = [](void* self, const Command& command) {
    auto& to = *static_cast<OwnHand*>(self);
    to.sent.push_back(command.force_n);
    to.device.write(to.device.self, command);
  };
  VirtualTime time;
  auto state = std::make_unique<LoopState>();
  run_loop(config, cpp.kernel, {&device, 1}, virtual_clock(time), {}, *state);
  hash_out = hash(cpp.kernel);
  return own.sent;
}

TEST(CLoop, SendsWhatHalsLoopSends) {
  Bench bench;
  OwnHand own;
  start_own(own);
  stylet_device* device = own_device(own);
  LoopHandle loop = bench.loop(device);
  stylet_loop* const made = loop.get();
  ASSERT_EQ(stylet_loop_run(made), STYLET_OK);
  EXPECT_EQ(stylet_loop_run(made), STYLET_LOOP_RUNS);  // once
  std::uint64_t expected_hash = 0;
  const std::vector<Vec3> expected = sent_by_hal(bench, expected_hash);
  ASSERT_EQ(own.sent.size(), expected.size());
  float most = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(std::memcmp(&own.sent[i], &expected[i], sizeof(Vec3)), 0) << i;
    most = std::max(most, expected[i].z);
  }
  EXPECT_GT(most, 0.1F);  // the tissue was felt
  // Seen from outside: the last tick, its surface, its events.
  EXPECT_EQ(stylet_loop_take(made), 1);
  stylet_output out = {};
  out.struct_bytes = sizeof out;
  ASSERT_EQ(stylet_loop_get_output(made, 0, &out), STYLET_OK);
  EXPECT_EQ(out.tick, bench.loop_config.ticks);
  std::vector<stylet_vec3> shown(bench.opened->organ.vertices.size());
  (void)stylet_loop_surface(made, shown.data(), static_cast<std::uint32_t>(shown.size()));
  stylet_event events[64];
  const std::uint32_t happened = stylet_loop_events(made, events, 64);
  EXPECT_EQ(happened, out.events);
  ASSERT_GT(happened, 1U);
  EXPECT_EQ(events[0].kind, static_cast<std::uint32_t>(STYLET_EVENT_CONTACT));
  stylet_loop_report report = {};
  report.struct_bytes = sizeof report;
  ASSERT_EQ(stylet_loop_get_report(made, &report), STYLET_OK);
  EXPECT_EQ(report.ticks, bench.loop_config.ticks);
  EXPECT_EQ(report.runs, 0U);

  // While the loop exists nothing else ticks the simulation; afterwards it is as the loop left it.
  EXPECT_EQ(stylet_simulation_reset(bench.simulation.get()), STYLET_LOOP_RUNS);
  const std::size_t before = own.sent.size();
  loop.reset();
  ASSERT_GT(own.sent.size(), before);  // closed without force
  EXPECT_EQ(own.sent.back().z, 0);
  EXPECT_EQ(stylet_simulation_hash(bench.simulation.get()), expected_hash);
  std::vector<stylet_vec3> surface(shown.size());
  (void)stylet_simulation_surface(bench.simulation.get(), surface.data(),
                                  static_cast<std::uint32_t>(surface.size()));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(shown[i].x), static_cast<double>(surface[i].x), 1e-7);
    EXPECT_NEAR(static_cast<double>(shown[i].z), static_cast<double>(surface[i].z), 1e-7);
  }
}

TEST(CLoop, RunsInItsOwnThreadUntilItIsStopped) {
  Bench bench;
  bench.in_real_time();
  stylet_device* device = nullptr;
  ASSERT_EQ(stylet_device_simulated(0.01F, 0.05F, 10, &device), STYLET_OK);
  const LoopHandle loop = bench.loop(device);
  stylet_loop* const made = loop.get();
  ASSERT_EQ(stylet_loop_start(made), STYLET_OK);
  stylet_output out = {};
  out.struct_bytes = sizeof out;
  for (int i = 0; i < 2000 && out.tick < 100; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (stylet_loop_take(made) != 0) (void)stylet_loop_get_output(made, 0, &out);
  }
  EXPECT_GE(out.tick, 100U);
  stylet_loop_ask_to_stop(made);
  ASSERT_EQ(stylet_loop_wait(made), STYLET_OK);
  stylet_loop_report report = {};
  report.struct_bytes = sizeof report;
  ASSERT_EQ(stylet_loop_get_report(made, &report), STYLET_OK);
  EXPECT_EQ(report.runs, 0U);
  EXPECT_GE(report.ticks, 100U);
}

// A device goes silent: the fault is reported, and acknowledged by its number.
TEST(CLoop, ReportsAFaultAndTakesItsAcknowledgement) {
  struct Silent {
    std::uint64_t seq = 0;
    bool silent = false;
    float last_n = 0;
  } self;
  stylet_device_functions functions = {};
  functions.struct_bytes = sizeof functions;
  functions.self = &self;
  functions.max_force_n = 4;
  functions.max_slew_n_per_s = 1000;
  functions.read = [](void* of, std::int64_t now_ns, stylet_sample* out) {
    auto& own = *static_cast<Silent*>(of);
    ++own.seq;
    own.silent = own.seq > 200 && own.seq < 260;
    if (own.silent) return 0;
    out->seq = own.seq;
    out->t_ns = now_ns;
    out->pose = {{0, 0, -5e-3F}, {1, 0, 0, 0}};
    return 1;
  };
  functions.write = [](void* of, const stylet_command* command) {
    static_cast<Silent*>(of)->last_n = command->force_n.z;
  };
  stylet_device* device = nullptr;
  ASSERT_EQ(stylet_device_from_functions(&functions, &device, nullptr), STYLET_OK);
  Bench bench;
  bench.in_real_time();
  LoopHandle loop = bench.loop(device);
  stylet_loop* const made = loop.get();
  ASSERT_EQ(stylet_loop_start(made), STYLET_OK);
  stylet_hand_report hand = {};
  hand.struct_bytes = sizeof hand;
  const auto look_until = [&](bool faulted) {
    for (int i = 0; i < 5000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (stylet_loop_take(made) == 0) continue;
      (void)stylet_loop_get_hand(made, 0, &hand);
      if ((hand.fault != STYLET_FAULT_NONE) == faulted) return true;
      if (!faulted) (void)stylet_loop_acknowledge(made, 0, hand.fault, hand.fault_number);
    }
    return false;
  };
  ASSERT_TRUE(look_until(true));
  EXPECT_NE(hand.fault_number, 0U);
  EXPECT_STRNE(stylet_fault_name(hand.fault), "none");
  ASSERT_TRUE(look_until(false));
}

TEST(CLoop, RefusesWhatCannotRun) {
  Bench bench;
  OwnHand own;
  start_own(own);
  stylet_device* device = own_device(own);
  stylet_loop* made = nullptr;
  stylet_refusal why = no_refusal();
  const auto create = [&] {
    return stylet_loop_create(bench.simulation.get(), &bench.loop_config, &device, &bench.hand,
                              nullptr, &made, &why);
  };
  bench.hand.force_scale = 0;
  EXPECT_EQ(create(), STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "hand.force_scale");
  bench.hand.force_scale = 1;
  bench.hand.start.rotation = {0, 0, 0, 0};
  EXPECT_EQ(create(), STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "hand.start.rotation");
  bench.hand.start.rotation = {1, 0, 0, 0};
  bench.loop_config.helpers = 99;
  EXPECT_EQ(create(), STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "loop.helpers");
  EXPECT_EQ(made, nullptr);
  bench.loop_config.helpers = 0;
  // A device in two loops, or closed while a loop has it.
  ASSERT_EQ(create(), STYLET_OK) << why.text;
  const LoopHandle first(made);
  Bench other;
  EXPECT_EQ(
      stylet_loop_create(other.simulation.get(), nullptr, &device, nullptr, nullptr, &made, &why),
      STYLET_ARGUMENT_OUT_OF_RANGE);
  EXPECT_EQ(made, nullptr);
  stylet_device_close(device);
  EXPECT_TRUE(own.sent.empty());
  EXPECT_EQ(stylet_simulation_reset(other.simulation.get()), STYLET_OK);
}

// Devices that do not answer at first, or never: the needle waits far from the hand, and must not
// pull it there.
TEST(CLoop, ADeviceThatHasNotAnsweredFeelsNothing) {
  struct Late {
    int reads = 0, answers_from = 0;
    float most_n = 0;
  };
  for (const int answers_from : {1, 2, 1'000'000}) {
    Late self;
    self.answers_from = answers_from;
    stylet_device_functions functions = {};
    functions.struct_bytes = sizeof functions;
    functions.self = &self;
    functions.max_force_n = 4;
    functions.max_slew_n_per_s = 1000;
    functions.max_stiffness_n_per_m = 500;
    functions.read = [](void* of, std::int64_t now_ns, stylet_sample* out) {
      auto& own = *static_cast<Late*>(of);
      if (own.reads++ < own.answers_from) return 0;
      out->seq = static_cast<std::uint64_t>(own.reads);
      out->t_ns = now_ns;
      out->pose = {{0, 0, 0}, {1, 0, 0, 0}};
      return 1;
    };
    functions.write = [](void* of, const stylet_command* command) {
      auto& own = *static_cast<Late*>(of);
      const stylet_vec3 f = command->force_n;
      own.most_n = std::max(own.most_n, std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z));
    };
    stylet_device* device = nullptr;
    ASSERT_EQ(stylet_device_from_functions(&functions, &device, nullptr), STYLET_OK);
    Bench bench;
    bench.hand.start.position_m.z += 0.02F;  // in the air
    bench.loop_config.ticks = 400;
    const LoopHandle loop = bench.loop(device);
    stylet_loop* const made = loop.get();
    ASSERT_EQ(stylet_loop_run(made), STYLET_OK);
    EXPECT_EQ(self.most_n, 0) << answers_from;
  }
}

TEST(CGuard, LetsNothingThroughBeforeASampleNorTwiceForOne) {
  stylet_guard_config config;
  ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
  const GuardHandle silent = c_guard(config);
  for (int i = 1; i < 100; ++i) {
    (void)stylet_guard_sample(silent.get(), nullptr, 1'000'000 * i);
    EXPECT_EQ(stylet_guard_force(silent.get(), {0, 0, 1e9F}).z, 0);
  }
  const GuardHandle guard = c_guard(config);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(stylet_guard_force(guard.get(), {0, 0, 6}).z, 0);
  }
  const stylet_sample sample = {sizeof sample, 0, 1, 1'000'000'000, {{0, 0, 0}, {1, 0, 0, 0}}, 0};
  ASSERT_EQ(stylet_guard_sample(guard.get(), &sample, sample.t_ns), 1);
  const float once = stylet_guard_force(guard.get(), {0, 0, 6}).z;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(stylet_guard_force(guard.get(), {0, 0, 6}).z, once);
  }
}

// If a device no longer answers and the caller does not ask it, the force ends all the same.
TEST(CGuard, AForceFadesAfterATripEvenWithoutSamples) {
  stylet_guard_config config;
  ASSERT_EQ(stylet_guard_config_init(&config, sizeof config), STYLET_OK);
  config.ramp_s = 0;
  config.max_torque_nm = 1;
  for (const std::string what : {"tripped", "no number", "stalled"}) {
    const GuardHandle guard = c_guard(config);
    stylet_sample sample = {sizeof sample, 0, 1, 1'000'000'000, {{0, 0, 0}, {1, 0, 0, 0}}, 0};
    const auto tick = [&](std::int64_t passed_ns) {
      ++sample.seq;
      sample.t_ns += passed_ns;
      (void)stylet_guard_sample(guard.get(), &sample, sample.t_ns);
      (void)stylet_guard_torque(guard.get(), {0, 1, 0});
      return stylet_guard_force(guard.get(), {0, 0, 6}).z;
    };
    for (int i = 0; i < 50; ++i) (void)tick(1'000'000);
    ASSERT_EQ(tick(1'000'000), 6);
    const float torque_nm = stylet_guard_torque(guard.get(), {0, 0.1F, 0}).y;
    EXPECT_EQ(stylet_guard_torque(guard.get(), {0, -1, 0}).y, torque_nm) << "no time has passed";
    const float endless = std::numeric_limits<float>::infinity();
    if (what == "tripped") {
      ASSERT_EQ(stylet_guard_trip(guard.get(), 5), STYLET_OK);
    }
    if (what == "no number") {
      ASSERT_EQ(stylet_guard_force(guard.get(), {0, 0, endless}).z, 0);
    }
    if (what == "stalled") {
      ASSERT_EQ(tick(20'000'000), 6) << "19 ms are lost";
      for (int i = 0; i < 50; ++i) (void)tick(1'000'000);
      ASSERT_LT(tick(21'000'000), 6);
    }
    for (int i = 0; i < 20; ++i) {
      (void)stylet_guard_force(guard.get(), {0, 0, 6});
      (void)stylet_guard_torque(guard.get(), {0, 1, 0});
    }
    EXPECT_EQ(stylet_guard_force(guard.get(), {0, 0, 6}).z, 0) << what;
    EXPECT_EQ(stylet_guard_torque(guard.get(), {0, 1, 0}).y, 0) << what;
  }
}

// Freed while other threads run it or wait for it.
TEST(CLoop, MayBeFreedWhileItRuns) {
  for (const bool own_thread : {true, false}) {
    Bench bench;
    bench.in_real_time();
    stylet_device* device = nullptr;
    ASSERT_EQ(stylet_device_simulated(0.01F, 0.05F, 10, &device), STYLET_OK);
    stylet_loop* const made = bench.loop(device).release();
    if (own_thread) {
      ASSERT_EQ(stylet_loop_start(made), STYLET_OK);
    }
    std::thread other([made, own_thread] {
      (void)(own_thread ? stylet_loop_wait(made) : stylet_loop_run(made));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stylet_loop_free(made);
    other.join();
    EXPECT_EQ(stylet_simulation_reset(bench.simulation.get()), STYLET_OK);
  }
}

// The device itself pauses the loop once it feels something. Time is virtual: one millisecond for
// each write.
TEST(CLoop, PausedItsForceFades) {
  struct Pausing {
    OwnHand hand;
    stylet_loop* loop = nullptr;
    std::vector<float> after_n;  // forces during the pause
    bool paused = false;
  } self;
  start_own(self.hand);
  stylet_device_functions functions = functions_of_own();
  functions.self = &self;
  functions.read = [](void* of, std::int64_t now_ns, stylet_sample* out) {
    return read_own(&static_cast<Pausing*>(of)->hand, now_ns, out);
  };
  functions.write = [](void* of, const stylet_command* command) {
    auto& own = *static_cast<Pausing*>(of);
    write_own(&own.hand, command);
    if (own.paused) own.after_n.push_back(command->force_n.z);
    if (command->force_n.z > 0.1F && !own.paused) {
      own.paused = true;
      stylet_loop_pause(own.loop, 1);
    }
    if (own.after_n.size() == 200) stylet_loop_ask_to_stop(own.loop);
  };
  stylet_device* device = nullptr;
  ASSERT_EQ(stylet_device_from_functions(&functions, &device, nullptr), STYLET_OK);
  Bench bench;
  const LoopHandle loop = bench.loop(device);
  self.loop = loop.get();
  ASSERT_EQ(stylet_loop_run(loop.get()), STYLET_OK);
  ASSERT_GE(self.after_n.size(), 200U);
  EXPECT_GT(self.after_n[0], 0);
  for (std::size_t i = 21; i < self.after_n.size(); ++i) EXPECT_EQ(self.after_n[i], 0) << i;
}

TEST(CLoop, ARefusedDeviceStaysTheCallers) {
  Bench bench;
  OwnHand own;
  start_own(own);
  stylet_device* device = own_device(own);
  stylet_loop* made = nullptr;
  stylet_refusal why = no_refusal();
  bench.loop_config.helpers = 99;
  EXPECT_EQ(stylet_loop_create(bench.simulation.get(), &bench.loop_config, &device, &bench.hand,
                               nullptr, &made, &why),
            STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_EQ(stylet_simulation_reset(bench.simulation.get()), STYLET_OK);
  stylet_device_close(device);
  EXPECT_EQ(own.sent.size(), 1U);

  stylet_device* none = nullptr;
  EXPECT_EQ(stylet_device_open("phantom:", 0, &none, &why), STYLET_DEVICE_FAILED);
  EXPECT_EQ(none, nullptr);
  EXPECT_NE(std::string(why.text).find("phantom:"), std::string::npos) << why.text;
}

TEST(CDevice, PatienceMayHaveNoEndButMustBeANumber) {
  stylet_device* made = nullptr;
  stylet_refusal why = no_refusal();
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), -1.0, -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(stylet_device_open("phantom:", odd, &made, &why), STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    EXPECT_STREQ(why.place, "patience_s") << odd;
    EXPECT_EQ(made, nullptr);
  }
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  EXPECT_EQ(stylet_device_open("phantom:", kNoLimit, &made, &why), STYLET_DEVICE_FAILED);
}

}  // namespace
}  // namespace stylet::test
