// SPDX-License-Identifier: Apache-2.0
// Checks of the loop's processor: who else may use it, and whether it sleeps or changes its speed.
#include <fmt/format.h>

#include <algorithm>

#include "hal/doctor/checks.h"

namespace stylet::hal {
namespace {

using std::string;

constexpr std::uint64_t kLongestWakeUpUs = 10;
const string kProcessors = "/sys/devices/system/cpu";

string of_cpu(const Patient& patient, const string& file) {
  return fmt::format("{}/cpu{}/{}", kProcessors, patient.cpu, file);
}

// The value of `option=value` in the boot parameters.
string boot_option(const HostTree& tree, const string& option) {
  for (const string& word : words_of(read_text(tree, "/proc/cmdline").value_or(""))) {
    if (word.starts_with(option + "=")) return word.substr(option.size() + 1);
  }
  return "";
}

string or_none(const string& text) {
  return text.empty() ? "none" : text;
}

// ---- who else -----------------------------------------------------------------------------------

Seen isolated(const Patient& patient, const HostTree& tree) {
  const string path = kProcessors + "/isolated";
  const auto by_boot = read_text(tree, path);
  if (!by_boot) return not_read(path);
  if (list_holds(*by_boot, patient.cpu)) return {Condition::kGood, "isolated: " + *by_boot, path};
  const string set_path = "/sys/fs/cgroup/cpuset.cpus.isolated";
  const string by_set = read_text(tree, set_path).value_or("");
  if (list_holds(by_set, patient.cpu)) return {Condition::kGood, "isolated: " + by_set, set_path};
  return {Condition::kBad, "isolated: " + or_none(*by_boot), path};
}

Seen tick_mode(const Patient& patient, const HostTree& tree) {
  const string path = kProcessors + "/nohz_full";
  const auto list = read_text(tree, path);
  if (!list) {
    if (!exists(tree, kProcessors)) return not_read(path);
    return {Condition::kGood, "periodic when busy", path};
  }
  if (list_holds(*list, patient.cpu)) return {Condition::kBad, "nohz_full: " + *list, path};
  return {Condition::kGood, "nohz_full: " + or_none(*list), path};
}

Seen rcu_callbacks(const Patient& patient, const HostTree& tree) {
  const string path = "/proc/cmdline";
  if (!read_text(tree, path)) return not_read(path);
  const string list = boot_option(tree, "rcu_nocbs");
  const bool moved = list == "all" || list_holds(list, patient.cpu);
  return {moved ? Condition::kGood : Condition::kBad, "rcu_nocbs: " + or_none(list), path};
}

// The interrupts in use that may be delivered to the loop's processor.
Seen interrupt_routing(const Patient& patient, const HostTree& tree) {
  const auto table = read_text(tree, "/proc/interrupts");
  if (!table) return not_read("/proc/interrupts");
  std::size_t used = 0, unread = 0;
  string here;
  for (const string& line : lines_of(*table)) {
    const std::vector<string> words = words_of(line);
    if (words.empty() || !words[0].ends_with(':')) continue;
    const string number = words[0].substr(0, words[0].size() - 1);
    if (!parse_number(number)) continue;
    ++used;
    const string folder = "/proc/irq/" + number;
    auto list = read_text(tree, folder + "/effective_affinity_list");
    if (!list || list->empty()) list = read_text(tree, folder + "/smp_affinity_list");
    if (!list) ++unread;
    if (list && list_holds(*list, patient.cpu)) here += (here.empty() ? "" : ", ") + number;
  }
  const string path = "/proc/irq/*/effective_affinity_list";
  if (!here.empty()) return {Condition::kBad, fmt::format("here: {} (of {})", here, used), path};
  if (used == 0 || unread > 0) return not_read(path);
  return {Condition::kGood, fmt::format("none of {} comes here", used), path};
}

Seen workqueues(const Patient& patient, const HostTree& tree) {
  const string path = "/sys/devices/virtual/workqueue/cpumask";
  const auto mask = read_text(tree, path);
  const auto here = mask_holds(mask.value_or(""), patient.cpu);
  if (!here) return not_read(path);
  return {*here ? Condition::kBad : Condition::kGood, "mask " + *mask, path};
}

Seen smt_sibling(const Patient& patient, const HostTree& tree) {
  const string path = of_cpu(patient, "topology/thread_siblings_list");
  const auto siblings = read_text(tree, path);
  if (!siblings || siblings->empty()) return not_read(path);
  const std::vector<int> all = parse_cpu_list(*siblings);
  if (all.size() == 1) return {Condition::kGood, "none", path};
  const string reserved = read_text(tree, kProcessors + "/isolated").value_or("");
  const bool idle =
      std::all_of(all.begin(), all.end(), [&](int cpu) { return list_holds(reserved, cpu); });
  return {idle ? Condition::kGood : Condition::kBad,
          fmt::format("{}, {}", *siblings, idle ? "all isolated" : "not all isolated"), path};
}

// Real-time tasks that may run here before the loop. The kernel's own migration thread does not
// count: it is on every processor, which it stops on demand.
Seen tasks_above(const Patient& patient, const HostTree& tree) {
  string above;
  std::size_t seen = 0;
  for (const string& process : names_in(tree, "/proc")) {
    if (!parse_number(process)) continue;
    for (const string& thread : names_in(tree, "/proc/" + process + "/task")) {
      const auto task = read_task(tree, "/proc/" + process + "/task/" + thread);
      if (!task) continue;
      ++seen;
      if (task->priority < static_cast<std::uint64_t>(patient.priority)) continue;
      if (task->name.starts_with("migration/")) continue;
      if (!list_holds(task->cpus_allowed, patient.cpu)) continue;
      above += fmt::format("{}{} ({})", above.empty() ? "" : ", ", task->name, task->priority);
    }
  }
  const string path = "/proc/*/task/*/stat";
  if (seen == 0) return not_read(path);
  return {above.empty() ? Condition::kGood : Condition::kBad, or_none(above), path};
}

// ---- how fast -----------------------------------------------------------------------------------

Seen governor(const Patient& patient, const HostTree& tree) {
  const string path = of_cpu(patient, "cpufreq/scaling_governor");
  const auto name = read_text(tree, path);
  if (!name) return {Condition::kUnknown, "Linux does not set the frequency", path};
  const auto low = read_text(tree, of_cpu(patient, "cpufreq/scaling_min_freq"));
  const auto high = read_text(tree, of_cpu(patient, "cpufreq/scaling_max_freq"));
  if (*name != "performance") return {Condition::kBad, *name, path};
  if (!low || !high) return not_read(of_cpu(patient, "cpufreq/scaling_min_freq"));
  const bool fixed = *low == *high;
  return {fixed ? Condition::kGood : Condition::kMinor,
          fmt::format("{}, {} to {} kHz", *name, *low, *high), path};
}

Seen turbo(const Patient&, const HostTree& tree) {
  const string intel = kProcessors + "/intel_pstate/no_turbo";
  if (const auto off = read_text(tree, intel)) {
    return {*off == "1" ? Condition::kGood : Condition::kBad, *off == "1" ? "off" : "on", intel};
  }
  const string other = kProcessors + "/cpufreq/boost";
  const auto on = read_text(tree, other);
  if (!on) return not_read(other);
  return {*on == "0" ? Condition::kGood : Condition::kBad, *on == "0" ? "off" : "on", other};
}

Seen idle_states(const Patient& patient, const HostTree& tree) {
  if (patient.trials && patient.trials->awake.granted) {
    return {Condition::kGood, "kept awake while the loop runs", "/dev/cpu_dma_latency"};
  }
  const string folder = of_cpu(patient, "cpuidle");
  const std::vector<string> states = names_in(tree, folder);
  if (states.empty()) return not_read(folder);
  string deep;
  for (const string& state : states) {
    const auto latency_us =
        parse_number(read_text(tree, folder + "/" + state + "/latency").value_or(""));
    if (!latency_us) return not_read(folder + "/" + state + "/latency");
    if (*latency_us <= kLongestWakeUpUs) continue;
    if (read_text(tree, folder + "/" + state + "/disable") == "1") continue;
    const string name = read_text(tree, folder + "/" + state + "/name").value_or(state);
    deep += fmt::format("{}{} ({} us)", deep.empty() ? "" : ", ", name, *latency_us);
  }
  return {deep.empty() ? Condition::kGood : Condition::kBad, deep.empty() ? "none deep" : deep,
          folder + "/state*/latency"};
}

constexpr Check kChecks[] = {
    {"isolation", Verdict::kWarn, isolated,
     "boot with isolcpus=managed_irq,domain,{cpu}, or set loop.cpu (here: --cpu) to one that is "
     "isolated"},
    {"tick mode", Verdict::kInfo, tick_mode,
     "leave processor {cpu} out of nohz_full, or compare both with --measure: nohz_full makes "
     "every entry into the kernel slower, and the loop enters it a thousand times a second"},
    {"RCU callbacks", Verdict::kInfo, rcu_callbacks, "boot with rcu_nocbs={cpu}"},
    {"interrupt routing", Verdict::kWarn, interrupt_routing,
     "boot with irqaffinity= of the other processors, and stop irqbalance"},
    {"workqueues", Verdict::kWarn, workqueues,
     "write a mask without processor {cpu} to /sys/devices/virtual/workqueue/cpumask"},
    {"SMT sibling", Verdict::kWarn, smt_sibling,
     "boot with nosmt, or isolate both halves of the core"},
    {"tasks above the loop", Verdict::kWarn, tasks_above,
     "move them to other processors (taskset -p), or below priority {priority} (chrt -p)"},
    {"governor", Verdict::kFail, governor,
     "cpupower frequency-set -g performance, with the lowest frequency as high as the highest; "
     "if Linux cannot set it, fix the frequency in the firmware"},
    {"turbo", Verdict::kInfo, turbo,
     "ticks vary if the speed depends on temperature: echo 1 > "
     "/sys/devices/system/cpu/intel_pstate/no_turbo, or 0 > cpufreq/boost"},
    {"idle states", Verdict::kWarn, idle_states,
     "give your user the right to write /dev/cpu_dma_latency, or boot with "
     "processor.max_cstate=1"},
};

}  // namespace

std::span<const Check> processor_checks() {
  return kChecks;
}

}  // namespace stylet::hal
