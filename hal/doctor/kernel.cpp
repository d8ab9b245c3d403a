// SPDX-License-Identifier: Apache-2.0
// Checks of the kernel as a whole: preemption, clocks, rights, and what it does in the background.
#include <fmt/format.h>

#include <algorithm>

#include "hal/doctor/checks.h"

namespace stylet::hal {
namespace {

using std::string;

// ---- kernel and clocks --------------------------------------------------------------------------

bool is_preempt_rt(const HostTree& tree) {
  return read_text(tree, "/proc/version").value_or("").find("PREEMPT_RT") != string::npos;
}

Seen preempt_rt(const Patient&, const HostTree& tree) {
  const auto version = read_text(tree, "/proc/version");
  if (!version) return not_read("/proc/version");
  const std::vector<string> words = words_of(*version);
  const string release = words.size() > 2 ? words[2] : *version;
  if (is_preempt_rt(tree)) return {Condition::kGood, release + " PREEMPT_RT", "/proc/version"};
  if (read_text(tree, "/sys/kernel/realtime") == "1") {
    return {Condition::kGood, release, "/sys/kernel/realtime"};
  }
  const string config_path = "/boot/config-" + release;
  const auto config = read_text(tree, config_path);
  if (config && config->find("CONFIG_PREEMPT_RT=y") != string::npos) {
    return {Condition::kGood, release + " CONFIG_PREEMPT_RT", config_path};
  }
  return {Condition::kBad, release + " without PREEMPT_RT", "/proc/version"};
}

Seen virtual_machine(const Patient&, const HostTree& tree) {
  const string path = "/proc/cpuinfo";
  const auto flags = value_of(read_text(tree, path).value_or(""), "flags");
  if (!flags) return not_read(path + " (flags)");
  const std::vector<string> words = words_of(*flags);
  const bool guest = std::find(words.begin(), words.end(), "hypervisor") != words.end();
  return {guest ? Condition::kBad : Condition::kGood, guest ? "under a hypervisor" : "none", path};
}

Seen clock_resolution(const Patient& patient, const HostTree& tree) {
  if (patient.trials) {
    const std::int64_t ns = patient.trials->clock_resolution_ns;
    return {ns == 1 ? Condition::kGood : Condition::kBad, fmt::format("{} ns", ns),
            "clock_getres(CLOCK_MONOTONIC)"};
  }
  const string path = "/proc/timer_list";
  const auto list = read_text(tree, path);
  if (!list) return not_read(path);
  const auto resolution = value_of(*list, ".resolution");
  if (!resolution) return not_read(path + " (.resolution)");
  return {*resolution == "1 nsecs" ? Condition::kGood : Condition::kBad, *resolution, path};
}

Seen clock_source(const Patient&, const HostTree& tree) {
  const string path = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
  const auto source = read_text(tree, path);
  if (!source) return not_read(path);
  const bool good = *source == "tsc" || *source == "arch_sys_counter";
  const bool slow = *source == "hpet" || *source == "acpi_pm" || *source == "jiffies";
  return {good ? Condition::kGood : slow ? Condition::kBad : Condition::kMinor, *source, path};
}

// ---- rights -------------------------------------------------------------------------------------

constexpr unsigned kCapIpcLock = 14, kCapSysNice = 23;

bool has_capability(const HostTree& tree, unsigned bit) {
  const string status = read_text(tree, "/proc/self/status").value_or("");
  const auto set = parse_number(value_of(status, "CapEff").value_or(""), 16);
  return set && (*set >> bit & 1U) != 0;
}

// The soft limit in a line of /proc/self/limits.
std::optional<string> limit_of(const HostTree& tree, const string& name) {
  for (const string& line : lines_of(read_text(tree, "/proc/self/limits").value_or(""))) {
    if (!line.starts_with(name)) continue;
    const std::vector<string> words = words_of(line.substr(name.size()));
    if (!words.empty()) return words[0];
  }
  return std::nullopt;
}

Seen from_trial(const Trial& trial, const string& what, const char* source) {
  if (trial.granted) return {Condition::kGood, what + " granted", source};
  return {Condition::kBad, fmt::format("{} refused ({})", what, trial.why), source};
}

Seen priority_right(const Patient& patient, const HostTree& tree) {
  const string what = fmt::format("SCHED_FIFO {}", patient.priority);
  if (patient.trials) return from_trial(patient.trials->fifo, what, "sched_setscheduler");
  if (has_capability(tree, kCapSysNice)) {
    return {Condition::kGood, "CAP_SYS_NICE", "/proc/self/status (CapEff)"};
  }
  const auto limit = limit_of(tree, "Max realtime priority");
  const auto number = parse_number(limit.value_or(""));
  if (!limit || (!number && *limit != "unlimited")) return not_read("/proc/self/limits");
  const bool enough = !number || *number >= static_cast<std::uint64_t>(patient.priority);
  return {enough ? Condition::kGood : Condition::kBad, "at most " + *limit,
          "/proc/self/limits (Max realtime priority)"};
}

Seen memory_right(const Patient& patient, const HostTree& tree) {
  if (patient.trials) return from_trial(patient.trials->lock, "locking memory", "mlockall");
  if (has_capability(tree, kCapIpcLock)) {
    return {Condition::kGood, "CAP_IPC_LOCK", "/proc/self/status (CapEff)"};
  }
  const auto limit = limit_of(tree, "Max locked memory");
  if (!limit) return not_read("/proc/self/limits");
  return {*limit == "unlimited" ? Condition::kGood : Condition::kBad,
          "at most " + *limit + " bytes", "/proc/self/limits (Max locked memory)"};
}

// ---- settings -----------------------------------------------------------------------------------

// One file, and its good values. A kernel built without the feature lacks the file as well as
// `feature`, in a folder that does exist.
Seen setting(const HostTree& tree, const string& path, const string& feature,
             std::initializer_list<const char*> good) {
  const auto text = read_text(tree, path);
  if (!text) {
    const string parent = feature.substr(0, feature.rfind('/'));
    if (!exists(tree, feature) && exists(tree, parent))
      return {Condition::kGood, "not built in", path};
    return not_read(path);
  }
  const string value = chosen(*text);
  const bool is_good = std::find(good.begin(), good.end(), value) != good.end();
  return {is_good ? Condition::kGood : Condition::kBad, value, path};
}

Seen rt_throttling(const Patient&, const HostTree& tree) {
  const string path = "/proc/sys/kernel/sched_rt_runtime_us";
  return setting(tree, path, path, {"950000", "-1"});
}

Seen swap(const Patient&, const HostTree& tree) {
  const string path = "/proc/swaps";
  const auto text = read_text(tree, path);
  if (!text) return not_read(path);
  const std::size_t areas = lines_of(*text).size();  // not counting one line of headings
  if (areas <= 1) return {Condition::kGood, "none", path};
  return {Condition::kBad, fmt::format("{} areas", areas - 1), path};
}

Seen huge_pages(const Patient&, const HostTree& tree) {
  const string folder = "/sys/kernel/mm/transparent_hugepage";
  return setting(tree, folder + "/enabled", folder, {"madvise", "never"});
}

Seen same_page_merging(const Patient&, const HostTree& tree) {
  const string folder = "/sys/kernel/mm/ksm";
  return setting(tree, folder + "/run", folder, {"0"});
}

Seen compaction(const Patient&, const HostTree& tree) {
  const string path = "/proc/sys/vm/compaction_proactiveness";
  return setting(tree, path, path, {"0"});
}

Seen lockup_detectors(const Patient& patient, const HostTree& tree) {
  const string path = "/proc/sys/kernel/watchdog";
  const Seen soft = setting(tree, path, path, {"0"});
  const string nmi_path = "/proc/sys/kernel/nmi_watchdog";
  const Seen nmi = setting(tree, nmi_path, nmi_path, {"0"});
  if (soft.state != Condition::kBad && nmi.state != Condition::kBad) {
    return soft.state == Condition::kGood ? nmi : soft;
  }
  const string mask_path = "/proc/sys/kernel/watchdog_cpumask";
  const auto mask = read_text(tree, mask_path);
  if (!mask) return not_read(mask_path);
  const bool here = list_holds(*mask, patient.cpu);
  return {here ? Condition::kBad : Condition::kGood, "on processors " + *mask, mask_path};
}

Seen timer_migration(const Patient&, const HostTree& tree) {
  const string path = "/proc/sys/kernel/timer_migration";
  return setting(tree, path, path, {"0"});
}

Seen tracer(const Patient&, const HostTree& tree) {
  const string folder = "/sys/kernel/tracing";
  return setting(tree, folder + "/current_tracer", folder, {"nop"});
}

Seen efi_runtime(const Patient&, const HostTree& tree) {
  const string path = "/proc/cmdline";
  const auto line = read_text(tree, path);
  if (!line) return not_read(path);
  if (!exists(tree, "/sys/firmware/efi")) {
    if (!exists(tree, "/sys/firmware")) return not_read("/sys/firmware/efi");
    return {Condition::kGood, "no EFI", "/sys/firmware/efi"};
  }
  const bool off = line->find("efi=noruntime") != string::npos ||
                   (is_preempt_rt(tree) && line->find("efi=runtime") == string::npos);
  return {off ? Condition::kGood : Condition::kBad, off ? "off" : "on", path};
}

Seen mitigations(const Patient&, const HostTree& tree) {
  const string folder = "/sys/devices/system/cpu/vulnerabilities";
  const std::vector<string> names = names_in(tree, folder);
  if (names.empty()) return not_read(folder);
  const auto mitigated = std::count_if(names.begin(), names.end(), [&](const string& name) {
    const string path = folder + "/" + name;
    return read_text(tree, path).value_or("").starts_with("Mitigation");
  });
  return {Condition::kBesides, fmt::format("{} of {} vulnerabilities", mitigated, names.size()),
          folder};
}

Seen pcie_sleep(const Patient&, const HostTree& tree) {
  const string folder = "/sys/module/pcie_aspm";
  return setting(tree, folder + "/parameters/policy", folder, {"performance"});
}

constexpr Check kChecks[] = {
    {"RT kernel", Verdict::kFail, preempt_rt, "install linux-image-rt-amd64 and boot it"},
    {"virtual machine", Verdict::kWarn, virtual_machine,
     "run without a virtual machine: in it timing depends on the host, and measurements say "
     "nothing about the machine"},
    {"clock resolution", Verdict::kFail, clock_resolution,
     "boot a kernel with CONFIG_HIGH_RES_TIMERS, without highres=off"},
    {"clock source", Verdict::kFail, clock_source,
     "boot with clocksource=tsc; dmesg says why the kernel gave it up"},
    {"real-time priority", Verdict::kFail, priority_right,
     "run as root, or put \"@realtime - rtprio 90\" into /etc/security/limits.conf and your user "
     "into the group realtime"},
    {"locked memory", Verdict::kFail, memory_right,
     "run as root, or put \"@realtime - memlock unlimited\" into /etc/security/limits.conf and "
     "your user into the group realtime"},
    {"RT throttling", Verdict::kInfo, rt_throttling,
     "sysctl kernel.sched_rt_runtime_us=950000: a loop that never sleeps then leaves 5 % to other "
     "programs; a normal loop never reaches this limit"},
    {"swap", Verdict::kWarn, swap, "swapoff -a, and take swap out of /etc/fstab"},
    {"huge pages", Verdict::kWarn, huge_pages,
     "boot with transparent_hugepage=madvise: while Linux merges pages, a thread that uses them "
     "has to wait"},
    {"page merging", Verdict::kWarn, same_page_merging, "echo 0 > /sys/kernel/mm/ksm/run"},
    {"compaction", Verdict::kWarn, compaction, "sysctl vm.compaction_proactiveness=0"},
    {"lockup detectors", Verdict::kWarn, lockup_detectors,
     "boot with nowatchdog, or sysctl kernel.watchdog=0 kernel.nmi_watchdog=0"},
    {"timer migration", Verdict::kInfo, timer_migration, "sysctl kernel.timer_migration=0"},
    {"tracing", Verdict::kWarn, tracer,
     "as root: mount -t tracefs nodev /sys/kernel/tracing, echo nop > "
     "/sys/kernel/tracing/current_tracer"},
    {"EFI runtime", Verdict::kInfo, efi_runtime,
     "boot with efi=noruntime: a call into the firmware stops every processor"},
    {"mitigations", Verdict::kInfo, mitigations, ""},
    {"PCIe sleep", Verdict::kInfo, pcie_sleep,
     "boot with pcie_aspm.policy=performance: a sleeping link answers late"},
};

}  // namespace

std::span<const Check> kernel_checks() {
  return kChecks;
}

}  // namespace stylet::hal
