// SPDX-License-Identifier: Apache-2.0
#include "hal/doctor/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "hal/device/devices.h"
#include "hal/doctor/checks.h"

namespace stylet::hal {
namespace {

using std::string;

Verdict verdict_of(Condition state, Verdict severity) {
  switch (state) {
    case Condition::kGood:
      return Verdict::kOk;
    case Condition::kBesides:
      return Verdict::kInfo;
    case Condition::kMinor:
      return severity == Verdict::kFail ? Verdict::kWarn : Verdict::kInfo;
    case Condition::kBad:
      return severity;
    case Condition::kUnknown:
      break;
  }
  return Verdict::kUnknown;
}

void replace_all(string& text, const string& what, const string& with) {
  for (std::size_t at = text.find(what); at != string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), with);
    at += with.size();
  }
}

// ---- what is known of devices only by trying ----------------------------------------------------

Finding device_priority(const Patient& patient) {
  static constexpr Check kPriority = {
      "device priority", Verdict::kWarn, nullptr,
      "put \"@realtime - rtprio 90\" into /etc/security/limits.conf: threads that talk to devices "
      "must run above the loop, or samples and forces come late"};
  const Trial& trial = patient.trials->device_fifo;
  const string value = trial.granted
                           ? fmt::format("SCHED_FIFO {} granted", kDevicePriority)
                           : fmt::format("SCHED_FIFO {} refused ({})", kDevicePriority, trial.why);
  const Condition state = trial.granted ? Condition::kGood : Condition::kBad;
  return finding_of(kPriority, {state, value, "sched_setscheduler"}, patient);
}

Finding device_watchdog(const Patient& patient) {
  static constexpr Check kWatchdog = {
      "device watchdog", Verdict::kWarn, nullptr,
      "install the newest SDK and firmware: without a watchdog, if the driver hangs, its last "
      "force stays until this program switches it off, and for good if this program hangs, too"};
  const bool taken = *patient.trials->watchdog;
  const Seen seen = {taken ? Condition::kGood : Condition::kBad, taken ? "taken" : "refused",
                     "dhdSetWatchdog"};
  return finding_of(kWatchdog, seen, patient);
}

// ---- disturbances -------------------------------------------------------------------------------

// Intel's counter of system management interrupts.
std::optional<std::uint64_t> read_smi_count(const Patient& patient) {
  constexpr std::streamoff kRegister = 0x34;
  std::ifstream file(fmt::format("{}/dev/cpu/{}/msr", patient.root, patient.cpu), std::ios::binary);
  std::array<char, sizeof(std::uint64_t)> bytes{};
  if (!file.seekg(kRegister) || !file.read(bytes.data(), bytes.size())) return std::nullopt;
  std::uint64_t count = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  return count;
}

// Parses lines of "25:" or "LOC:", the counts of each processor, and a description.
std::map<string, std::uint64_t> count_interrupts(const Patient& patient, const HostTree& tree) {
  std::map<string, std::uint64_t> counts;
  const std::vector<string> lines = lines_of(read_text(tree, "/proc/interrupts").value_or(""));
  if (lines.empty()) return counts;
  const std::vector<string> processors = words_of(lines[0]);
  const auto column =
      std::find(processors.begin(), processors.end(), fmt::format("CPU{}", patient.cpu));
  if (column == processors.end()) return counts;
  const auto index = static_cast<std::size_t>(column - processors.begin()) + 1;
  for (const string& line : lines) {
    const std::vector<string> words = words_of(line);
    if (words.size() <= processors.size() || words[0] == "LOC:") continue;
    const string name =
        parse_number(words[0].substr(0, words[0].size() - 1)) ? words[0] + words.back() : words[0];
    counts[name] = parse_number(words[index]).value_or(0);
  }
  return counts;
}

Seen interrupts_between(const Disturbances& before, const Disturbances& after, double seconds) {
  const string path = "/proc/interrupts";
  if (before.interrupts.empty() || after.interrupts.empty()) return not_read(path);
  string came;
  for (const auto& [name, count] : after.interrupts) {
    const auto earlier = before.interrupts.find(name);
    const std::uint64_t start = earlier == before.interrupts.end() ? 0 : earlier->second;
    if (count > start)
      came += fmt::format("{}{} {}", came.empty() ? "" : ", ", name, count - start);
  }
  if (came.empty())
    return {Condition::kGood, fmt::format("none in {:g} s but its timer", seconds), path};
  return {Condition::kBad, fmt::format("{} in {:g} s", came, seconds), path};
}

Seen growth(const std::optional<std::uint64_t>& before, const std::optional<std::uint64_t>& after,
            double seconds, const string& path) {
  if (!before || !after) return not_read(path);
  return {*before == *after ? Condition::kGood : Condition::kBad,
          fmt::format("{} in {:g} s", *after - *before, seconds), path};
}

string throttle_path(int cpu) {
  return fmt::format("/sys/devices/system/cpu/cpu{}/thermal_throttle/core_throttle_count", cpu);
}

}  // namespace

Finding finding_of(const Check& check, const Seen& seen, const Patient& patient) {
  Finding finding = {check.name,     verdict_of(seen.state, check.severity),
                     check.severity, seen.value,
                     seen.source,    ""};
  if (seen.state == Condition::kGood || seen.state == Condition::kBesides) return finding;
  finding.remedy = check.remedy;
  replace_all(finding.remedy, "{cpu}", std::to_string(patient.cpu));
  replace_all(finding.remedy, "{priority}", std::to_string(patient.priority));
  return finding;
}

const char* verdict_name(Verdict verdict) {
  constexpr const char* kNames[] = {"ok", "info", "warn", "fail", "unknown"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const char* fitness_name(Fitness fitness) {
  constexpr const char* kNames[] = {"ready", "degraded", "not suitable"};
  return kNames[static_cast<std::size_t>(fitness)];
}

Fitness fitness(std::span<const Finding> findings) {
  Fitness worst = Fitness::kReady;
  for (const Finding& each : findings) {
    if (each.verdict == Verdict::kFail) return Fitness::kUnfit;
    const bool doubtful = each.verdict == Verdict::kWarn ||
                          (each.verdict == Verdict::kUnknown && each.severity != Verdict::kInfo);
    if (doubtful) worst = Fitness::kDegraded;
  }
  return worst;
}

std::vector<Finding> examine(const Patient& patient) {
  const HostTree tree = {patient.root};
  std::vector<Finding> findings;
  for (const auto checks : {kernel_checks(), processor_checks(), device_checks()}) {
    for (const Check& check : checks) {
      findings.push_back(finding_of(check, check.look(patient, tree), patient));
    }
  }
  if (patient.trials) findings.push_back(device_priority(patient));
  if (patient.trials && patient.trials->watchdog) findings.push_back(device_watchdog(patient));
  return findings;
}

Disturbances count_disturbances(const Patient& patient) {
  const HostTree tree = {patient.root};
  return {count_interrupts(patient, tree), read_smi_count(patient),
          parse_number(read_text(tree, throttle_path(patient.cpu)).value_or(""))};
}

std::vector<Finding> compare_disturbances(const Patient& patient, const Disturbances& before,
                                          const Disturbances& after, double seconds) {
  static constexpr Check kInterrupts = {
      "interrupts", Verdict::kWarn, nullptr,
      "see isolation and interrupt routing; TLB and CAL come from other threads that share this "
      "program's memory, RES from the scheduler"};
  static constexpr Check kFirmware = {
      "firmware interrupts", Verdict::kWarn, nullptr,
      "modprobe msr and run as root to count them; switch off power management and legacy USB in "
      "the firmware to be rid of them"};
  static constexpr Check kHeat = {"throttled by heat", Verdict::kWarn, nullptr,
                                  "cool the machine; fix a lower frequency"};
  const HostTree tree = {patient.root};
  const string vendor =
      value_of(read_text(tree, "/proc/cpuinfo").value_or(""), "vendor_id").value_or("");
  const Seen firmware = vendor.empty() || vendor == "GenuineIntel"
                            ? growth(before.system_management, after.system_management, seconds,
                                     fmt::format("/dev/cpu/{}/msr (0x34)", patient.cpu))
                            : Seen{Condition::kBesides, "no counter on " + vendor, "/proc/cpuinfo"};
  return {finding_of(kInterrupts, interrupts_between(before, after, seconds), patient),
          finding_of(kFirmware, firmware, patient),
          finding_of(kHeat,
                     growth(before.throttled, after.throttled, seconds, throttle_path(patient.cpu)),
                     patient)};
}

}  // namespace stylet::hal
