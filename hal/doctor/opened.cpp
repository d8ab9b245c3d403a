// SPDX-License-Identifier: Apache-2.0
#include "hal/doctor/opened.h"

#include <fmt/format.h>

#include "hal/doctor/checks.h"

namespace stylet::hal {
namespace {

using std::string;

// The guard was tried with hands that lost as many of their samples (GUARD.md, "Which motion is
// accepted").
constexpr double kMostLost = 0.1;
// A device that sends fewer samples counts as silent between two of them.
constexpr double kFewestPerS = 1e9 / static_cast<double>(kQuietNs);

double ms(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

double ms(const Histogram& histogram, double fraction) {
  return histogram_quantile_us(histogram, fraction) * 1e-3;
}

struct Watched {
  const string& uri;
  const DeviceInfo& info;
  const DeviceProbe& probe;
  double watchdog_ms;  // without a new sample for so long there is a fault

  Finding finding(const Check& check, Condition state, const string& value) const {
    return finding_of(check, {state, value, uri}, {});
  }
  // A time that the guard limits to the watchdog's. Half of it is a narrow margin.
  Condition limited(double time_ms) const {
    if (time_ms <= watchdog_ms / 2) return Condition::kGood;
    if (ms(probe.latest_tick_ns) > watchdog_ms / 2) return Condition::kUnknown;
    return time_ms <= watchdog_ms ? Condition::kMinor : Condition::kBad;
  }
  // What to add to such a time.
  string own_lateness() const {
    const double late_ms = ms(probe.latest_tick_ns);
    return late_ms > watchdog_ms / 2
               ? fmt::format("; this machine itself was up to {:.1f} ms late", late_ms)
               : "";
  }
};

Finding samples(const Watched& w) {
  static constexpr Check kCheck = {
      "device samples", Verdict::kWarn, nullptr,
      "let the device send a sample every millisecond: with fewer than 400 a second it counts as "
      "silent between two of them"};
  const double per_s = static_cast<double>(w.probe.samples) / w.probe.seconds;
  const Histogram& apart = w.probe.interval;
  return w.finding(
      kCheck, per_s >= kFewestPerS ? Condition::kGood : Condition::kBad,
      fmt::format("{:.0f} a second, {} {:.2f} (p50), {:.2f} (p99) and at most {:.2f} ms apart",
                  per_s, w.info.sends_times ? "taken" : "got by the driver", ms(apart, 0.5),
                  ms(apart, 0.99), ms(apart.max_ns)));
}

Finding packets(const Watched& w, const PacketCount& count) {
  static constexpr Check kCheck = {
      "device packets", Verdict::kFail, nullptr,
      "use a cable instead of radio, and a network or a switch of its own; useless packets come "
      "from another version of the packets, or from another program"};
  const std::uint64_t sent = count.came + count.late + count.lost;
  const bool many = static_cast<double>(count.lost) > kMostLost * static_cast<double>(sent);
  const bool whole = count.lost == 0 && count.late == 0 && count.useless == 0;
  return w.finding(kCheck,
                   many    ? Condition::kBad
                   : whole ? Condition::kGood
                           : Condition::kMinor,
                   fmt::format("of {} sent, {} were lost and {} came after a newer one; {} useless",
                               sent, count.lost, count.late, count.useless));
}

Finding forces(const Watched& w, const PacketCount& count) {
  static constexpr Check kCheck = {
      "device forces", Verdict::kWarn, nullptr,
      "if the device's samples have the number of the newest force (hal/device/packets.md): let "
      "the firewall pass UDP packets from this machine to the device"};
  return w.finding(kCheck, count.forces_arrive ? Condition::kGood : Condition::kMinor,
                   count.forces_arrive ? "packets to the device arrive there"
                                       : "the device does not say whether any arrive there");
}

Finding gaps(const Watched& w) {
  static constexpr Check kCheck = {
      "device gaps", Verdict::kFail, nullptr,
      "use a cable instead of radio; on the device's machine, give the program that sends a "
      "real-time priority; on this one, do what is advised above"};
  const double gap_ms = ms(w.probe.longest_gap_ns);
  return w.finding(kCheck, w.limited(gap_ms),
                   fmt::format("at most {:.1f} ms without a new sample, a fault at {:g} ms{}",
                               gap_ms, w.watchdog_ms, w.own_lateness()));
}

Finding delay(const Watched& w) {
  static constexpr Check kCheck = {
      "device delay", Verdict::kFail, nullptr,
      "as for device gaps: a sample that is older than the watchdog's time is refused, and a force "
      "ends early by the delay of its sample"};
  const Histogram& age = w.probe.age;
  const string ages = fmt::format("{:.2f} (p50), {:.2f} (p99) and at most {:.2f} ms", ms(age, 0.5),
                                  ms(age, 0.99), ms(age.max_ns));
  const string refused =
      fmt::format("samples are refused at {:g} ms{}", w.watchdog_ms, w.own_lateness());
  const Condition limited = w.limited(ms(age.max_ns));
  if (w.info.sends_times) {
    return w.finding(
        kCheck, limited,
        fmt::format("samples come {} later than if all were as fast as the fastest; {}", ages,
                    refused));
  }
  return w.finding(kCheck, limited == Condition::kGood ? Condition::kBesides : limited,
                   fmt::format("not known: the device sends no sample times; the way from its "
                               "driver to the loop takes {}; {}",
                               ages, refused));
}

// What the guard and the driver say in the end.
Finding state(const Watched& w, const Device& device) {
  static constexpr Check kCheck = {"device state", Verdict::kFail, nullptr,
                                   "see stylet devices probe, and hal/device/details.md"};
  const string trouble = trouble_of(device), note = note_of(device);
  if (!trouble.empty()) return w.finding(kCheck, Condition::kBad, trouble);
  if (w.probe.fault != Fault::kNone) {
    return w.finding(
        kCheck, Condition::kBad,
        fmt::format("fault: {} ({})", fault_name(w.probe.fault), refusal_name(w.probe.refused)));
  }
  if (!note.empty()) return w.finding(kCheck, Condition::kMinor, note);
  return w.finding(kCheck, Condition::kGood, "no fault");
}

string described(const DeviceInfo& info) {
  const string serial =
      info.identity[0] != 0 ? fmt::format(", serial number {}", info.identity) : "";
  return fmt::format("{}{}, at most {:g} N", info.name, serial, info.max_force_n);
}

constexpr Check kOpens = {"device opens", Verdict::kFail, nullptr,
                          "see hal/device/README.md for what this device needs"};

}  // namespace

std::vector<Finding> judge_opened(const string& uri, const Device& device,
                                  const DeviceProbe& probe) {
  const double watchdog_s = static_cast<double>(watchdog_of(device.info, GuardConfig{}.watchdog_s));
  const Watched watched = {uri, device.info, probe, watchdog_s * 1e3};
  std::vector<Finding> found = {watched.finding(kOpens, Condition::kGood, described(device.info))};
  found.push_back(samples(watched));
  if (probe.packets) found.push_back(packets(watched, *probe.packets));
  if (probe.packets) found.push_back(forces(watched, *probe.packets));
  found.push_back(gaps(watched));
  found.push_back(delay(watched));
  found.push_back(state(watched, device));
  return found;
}

// "URI: what is wrong: what to do".
Finding judge_refused(const string& uri, const string& why) {
  string value = why.starts_with(uri + ": ") ? why.substr(uri.size() + 2) : why;
  string remedy = kOpens.remedy;
  if (const std::size_t at = value.rfind(": "); at != string::npos) {
    remedy = value.substr(at + 2);
    value.resize(at);
  }
  return {kOpens.name, Verdict::kFail, kOpens.severity, value, uri, remedy};
}

}  // namespace stylet::hal
