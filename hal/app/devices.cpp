// SPDX-License-Identifier: Apache-2.0
// stylet devices, stylet devices probe, and stylet station.
#include "hal/device/devices.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>
#include <span>
#include <thread>

#include "hal/app/commands.h"
#include "hal/app/fault_desk.h"
#include "hal/app/opening.h"
#include "hal/app/stop_signal.h"
#include "hal/app/terminal.h"
#include "hal/base/contained.h"
#include "hal/base/output_file.h"
#include "hal/device/search.h"
#include "hal/doctor/probe.h"
#include "hal/loop/host.h"
#include "hal/loop/station.h"

namespace stylet::app {
namespace {

using Json = nlohmann::ordered_json;

Json spread(const hal::Histogram& histogram) {
  return {{"p50", hal::histogram_quantile_us(histogram, 0.5)},
          {"p99", hal::histogram_quantile_us(histogram, 0.99)},
          {"max", static_cast<double>(histogram.max_ns) * 1e-3}};
}

Json of(Vec3 v, float unit) {
  return {v.x / unit, v.y / unit, v.z / unit};
}

float along(Vec3 v, std::size_t way) {
  const float value = way / 2 == 0 ? v.x : way / 2 == 1 ? v.y : v.z;
  return way % 2 == 0 ? value : -value;
}

constexpr const char* kWays[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
constexpr float kSeenM = 0.5e-3F;  // smaller motion is a trembling hand

const char* verdict(const hal::PushSeen& push, std::size_t way) {
  const float moved_m = along(push.moved_m, way);
  if (std::fabs(moved_m) <= kSeenM) return "was not seen to move";
  return moved_m > 0 ? "went as it should" : "went the wrong way";
}

Json record_of(const std::string& uri, const hal::DeviceInfo& info, const hal::DeviceProbe& probe) {
  Json record = {{"uri", uri},
                 {"name", info.name},
                 {"serial_number", info.identity[0] != 0 ? Json(info.identity) : Json(nullptr)},
                 {"stylet_version", STYLET_VERSION},
                 {"limits",
                  {{"max_force_n", info.max_force_n},
                   {"max_torque_nm", info.max_torque_nm},
                   {"max_stiffness_n_per_m", info.max_stiffness_n_per_m}}},
                 {"seconds", probe.seconds},
                 {"ticks", probe.ticks},
                 {"samples", probe.samples},
                 {"samples_per_s", static_cast<double>(probe.samples) / probe.seconds},
                 {"repeated", probe.repeated},
                 {"lost", probe.packets ? probe.packets->lost : probe.lost},
                 {"unanswered", probe.unanswered},
                 {"interval_us", spread(probe.interval)},
                 {"age_us", spread(probe.age)},
                 {"sends_times", info.sends_times},
                 {"longest_gap_us", static_cast<double>(probe.longest_gap_ns) * 1e-3},
                 {"smallest_step_um",
                  {probe.step_m[0] * 1e6F, probe.step_m[1] * 1e6F, probe.step_m[2] * 1e6F}},
                 {"low_mm", of(probe.low_m, 1e-3F)},
                 {"high_mm", of(probe.high_m, 1e-3F)},
                 {"buttons_seen", probe.buttons_seen},
                 {"fault", hal::fault_name(probe.fault)},
                 {"pushes", Json::array()}};
  if (probe.refused != hal::Refusal::kNone) {
    record["refused"] = hal::refusal_name(probe.refused);
  }
  for (std::size_t i = 0; i < probe.push.size(); ++i) {
    if (!(probe.push[i].force_n > 0)) continue;
    record["pushes"].push_back({{"way", kWays[i]},
                                {"force_n", probe.push[i].force_n},
                                {"moved_mm", of(probe.push[i].moved_m, 1e-3F)},
                                {"hand", verdict(probe.push[i], i)}});
  }
  return record;
}

// Three numbers as text for people.
std::string short_of(const Json& v) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", v[0].get<double>(), v[1].get<double>(),
                     v[2].get<double>());
}

void tell(const Json& r) {
  fmt::print("{}: {}\n", r["uri"].get<std::string>(), r["name"].get<std::string>());
  const Json& serial = r["serial_number"];
  fmt::print("serial    {}\n", serial.is_null() ? "not told" : serial.get<std::string>());
  fmt::print("samples   {:.0f} a second, {} lost, {} ticks without a new one\n",
             r["samples_per_s"].get<double>(), r["lost"].get<std::uint64_t>(),
             r["repeated"].get<std::uint64_t>() + r["unanswered"].get<std::uint64_t>());
  for (const char* key : {"interval_us", "age_us"}) {
    fmt::print("{:<10}p50 {:.0f}, p99 {:.0f}, max {:.0f} us\n",
               std::string(key).substr(0, std::string(key).find('_')), r[key]["p50"].get<double>(),
               r[key]["p99"].get<double>(), r[key]["max"].get<double>());
  }
  if (!r["sends_times"].get<bool>()) {
    fmt::print("          both counted from when its driver got them: it sends no sample times\n");
  }
  fmt::print("gap       at most {:.0f} us without a new sample\n",
             r["longest_gap_us"].get<double>());
  fmt::print("steps     {} um, smallest seen of x, y, z\n", short_of(r["smallest_step_um"]));
  fmt::print("moved     from {} to {} mm\n", short_of(r["low_mm"]), short_of(r["high_mm"]));
  if (r.contains("about")) fmt::print("about     {}\n", r["about"].get<std::string>());
  fmt::print("buttons   pressed: {:#b}\n", r["buttons_seen"].get<std::uint32_t>());
  fmt::print("fault     {}{}\n", r["fault"].get<std::string>(),
             r.contains("refused") ? ": " + r["refused"].get<std::string>() : "");
  for (const Json& push : r["pushes"]) {
    fmt::print("push {}   {:.2f} N: the hand {}\n", push["way"].get<std::string>(),
               push["force_n"].get<double>(), push["hand"].get<std::string>());
  }
}

// The station's loop, until its end.
void serve(const StationOptions& options, const hal::StationConfig& config,
           const hal::Device& device, const hal::Link& link, const std::atomic<bool>& stop,
           hal::FaultMailbox& mailbox, hal::StationState& state) {
  const hal::Clock clock = hal::monotonic_clock();
  const std::int64_t start_ns = clock.now_ns(clock.self);
  std::int64_t next_ns = start_ns;
  constexpr std::int64_t kPeriodNs = 1'000'000;
  while (!stop.load()) {
    const double run_s = static_cast<double>(next_ns - start_ns) * 1e-9;
    if (options.seconds > 0 && run_s >= options.seconds) break;
    next_ns = std::max(next_ns, clock.now_ns(clock.self) - kPeriodNs) + kPeriodNs;
    clock.sleep_until_ns(clock.self, next_ns);
    hal::guard_late(state.guard, clock.now_ns(clock.self) - next_ns);
    hal::station_tick(config, state, device, link, next_ns);
    hal::exchange_mail(mailbox, state.guard);
  }
  for (bool gone = false; !gone; next_ns += kPeriodNs) {  // the guard's fade, 20 ms at most
    clock.sleep_until_ns(clock.self, next_ns);
    gone = hal::station_end(config, state, device, next_ns);
  }
}

}  // namespace

namespace {

struct PresenceText {
  const char* word;  // for people
  Json ready;        // for programs; null: unknown
};

PresenceText text_of(hal::Presence presence) {
  switch (presence) {
    case hal::Presence::kReady:
      return {"ready", true};
    case hal::Presence::kUnknown:
      return {"unknown", nullptr};
    case hal::Presence::kMissing:
      break;
  }
  return {"no", false};
}

}  // namespace

int list_devices(const DevicesOptions& options) {
  const std::vector<hal::DeviceSighting> all = hal::search_devices(options.root);
  if (options.json) {
    Json out = Json::array();
    for (const hal::DeviceSighting& each : all) {
      out.push_back({{"uri", each.uri},
                     {"name", each.name},
                     {"ready", text_of(each.presence).ready},
                     {"seen", each.seen},
                     {"remedy", each.remedy}});
    }
    fmt::print("{}\n", out.dump(2));
    return kExitOk;
  }
  std::size_t width = 0;
  for (const hal::DeviceSighting& each : all) width = std::max(width, each.uri.size());
  for (const hal::DeviceSighting& each : all) {
    fmt::print("{:<{}} {:<8}{}: {}\n", each.uri, width, text_of(each.presence).word, each.name,
               each.seen);
    if (!each.remedy.empty()) fmt::print("{:>{}}{}\n", "-> ", width + 13, each.remedy);
  }
  fmt::print(
      "\nSome things show only when a device is opened, such as its calibration, or whether a "
      "program sends: stylet devices probe URI\n");
  return kExitOk;
}

int probe(const ProbeOptions& options) {
  const std::string output = hal::checked_output(options.output, {});
  fmt::print(stderr, "stylet: waiting for {}\n", options.uri);
  std::atomic<bool> stop{false};
  const StopOnSignal stop_on_signal(stop);  // before the device is open
  const Opened opened(options.uri, hal::open_device);
  const hal::Device& device = opened.device;
  const bool pushes = options.push && device.info.max_force_n > 0;
  if (!options.json) {
    fmt::print(
        stderr, "{:g} s without force: move the device around and press its buttons{}\n",
        options.seconds,
        pushes ? "; then it pushes along its axes for 3 s with at most 1 N: hold it loosely" : "");
  }
  hal::HostReport host;
  hal::prepare_thread(-1, 80, host);
  const auto seen = std::make_unique<hal::DeviceProbe>();
  hal::probe_device(device, options.seconds, pushes, hal::monotonic_clock(), stop, *seen);
  Json record = record_of(options.uri, device.info, *seen);
  if (device.about != nullptr) record["about"] = device.about(device.self);
  if (!output.empty()) hal::write_output(output, record.dump(2) + "\n");
  if (options.json) {
    fmt::print("{}\n", record.dump(2));
  } else {
    tell(record);
  }
  const std::string trouble = hal::trouble_of(device);
  if (!trouble.empty()) fmt::print(stderr, "stylet: {}: {}\n", options.uri, trouble);
  return trouble.empty() && seen->fault == hal::Fault::kNone ? kExitOk : kExitTrouble;
}

int station(const StationOptions& options) {
  std::atomic<bool> stop{false};
  const StopOnSignal stop_on_signal(stop);  // before the device is open
  fmt::print(stderr, "stylet: waiting for {}\n", options.uri);
  const Opened opened(options.uri, hal::open_lasting_device);
  const hal::Link link = hal::udp_connect(options.to);
  hal::StationConfig config = hal::station_config(opened.device.info);
  config.guard.acknowledge_button = options.acknowledge_button;
  config.guard.dead_man_button = options.dead_man_button;
  hal::StationState state =
      hal::station_start(static_cast<std::uint32_t>(hal::monotonic_now_ns() / 1000));
  std::array<hal::FaultMailbox, 1> mailbox;
  FaultDesk desk(mailbox, {options.uri}, std::span(&opened.device, 1));
  hal::HostState host;
  hal::prepare_process(host);
  fmt::print(stderr, "stylet: {} is a station of {}; Ctrl-C ends it\n", options.uri, options.to);
  std::future<void> loop = std::async(std::launch::async, [&] {
    hal::prepare_thread(-1, 80, host.report);
    serve(options, config, opened.device, link, stop, mailbox[0], state);
  });
  const auto goes_on = [&] {
    return loop.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready;
  };
  while (goes_on()) (void)hal::contained("station", [&] { desk.look(); });
  loop.get();  // throws what the loop threw
  link.close(link.self);
  fmt::print("{} samples sent, {} forces taken, {} refused, {} ticks without one\n", state.sent.seq,
             state.models, state.refused, state.starved);
  if (state.guard.fault == hal::Fault::kNone) return kExitOk;
  const std::string trouble = hal::trouble_of(opened.device);
  if (!trouble.empty()) fmt::print(stderr, "stylet: {}: {}\n", options.uri, trouble);
  return kExitTrouble;
}

}  // namespace stylet::app
