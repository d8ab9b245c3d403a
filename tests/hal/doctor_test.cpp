// SPDX-License-Identifier: Apache-2.0
// The doctor on captured machines: what it says of each; and every check can fail.
#include "hal/doctor/doctor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hal/base/host_tree.h"
#include "hal/device/link.h"
#include "hal/doctor/measure.h"

namespace stylet::hal {

void PrintTo(Verdict verdict, std::ostream* out) {
  *out << verdict_name(verdict);
}

namespace {

namespace fs = std::filesystem;
using Verdicts = std::map<std::string, Verdict>;
constexpr Verdict kOk = Verdict::kOk, kInfo = Verdict::kInfo, kWarn = Verdict::kWarn,
                  kFail = Verdict::kFail, kUnknown = Verdict::kUnknown;

// A tree in a folder of its own, from a file in which each line "== path" is followed by that
// file's text; a path that ends with / is a folder.
class Machine {
 public:
  explicit Machine(const std::string& name) {
    static int count = 0;
    root_ = fs::temp_directory_path() /
            ("stylet-doctor-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    fs::create_directories(root_);
    if (name.empty()) return;
    std::ifstream in(fs::path(STYLET_DOCTOR_TREES) / name);
    EXPECT_TRUE(in) << name;
    std::string path, text;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("== ")) {
        if (!path.empty()) write(path, text);
        path = line.substr(3);
        text.clear();
      } else {
        text += line + "\n";
      }
    }
    write(path, text);
  }
  ~Machine() { fs::remove_all(root_); }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  void write(const std::string& path, const std::string& text) {
    const fs::path file = root_.string() + path;
    fs::create_directories(file.parent_path());
    if (path.ends_with('/')) return;
    std::ofstream(file, std::ios::binary) << text;
  }
  void remove(const std::string& path) { fs::remove_all(root_.string() + path); }

  Patient patient(int cpu) const { return {root_.string(), cpu, 80, {}}; }
  Verdicts verdicts(int cpu) const {
    Verdicts all;
    for (const Finding& each : examine(patient(cpu))) all[each.name] = each.verdict;
    return all;
  }
  std::string root() const { return root_.string(); }

 private:
  fs::path root_;
};

const Finding& find(const std::vector<Finding>& findings, const std::string& name) {
  for (const Finding& each : findings) {
    if (each.name == name) return each;
  }
  throw std::out_of_range(name);
}

// ---- whole machines -----------------------------------------------------------------------------

TEST(Doctor, AMachineSetUpForTheLoopIsReady) {
  const Machine machine("ready.tree");
  const std::vector<Finding> findings = examine(machine.patient(3));
  EXPECT_EQ(fitness(findings), Fitness::kReady);
  for (const Finding& each : findings) {
    const bool stated = each.name == "mitigations";
    EXPECT_EQ(each.verdict, stated ? kInfo : kOk) << each.name << ": " << each.value;
    EXPECT_EQ(each.remedy, "") << each.name;
    EXPECT_NE(each.value, "") << each.name;
    EXPECT_NE(each.source, "") << each.name;
  }
}

TEST(Doctor, WhereNothingCanBeReadNothingIsOk) {
  const Machine machine("");
  const std::vector<Finding> findings = examine(machine.patient(0));
  EXPECT_EQ(findings.size(), 29U);
  for (const Finding& each : findings) {
    EXPECT_EQ(each.verdict, kUnknown) << each.name << ": " << each.value;
  }
  EXPECT_EQ(fitness(findings), Fitness::kDegraded);
}

TEST(Doctor, AGuestIsNotSuitable) {
  const Machine machine("guest.tree");
  const std::vector<Finding> findings = examine(machine.patient(1));
  EXPECT_EQ(fitness(findings), Fitness::kUnfit);
  const Verdicts expected = {{"RT kernel", kFail},
                             {"virtual machine", kWarn},
                             {"clock resolution", kUnknown},
                             {"clock source", kOk},
                             {"real-time priority", kOk},
                             {"locked memory", kOk},
                             {"RT throttling", kOk},
                             {"swap", kOk},
                             {"huge pages", kOk},
                             {"page merging", kOk},
                             {"compaction", kWarn},
                             {"lockup detectors", kWarn},
                             {"timer migration", kInfo},
                             {"tracing", kUnknown},
                             {"EFI runtime", kOk},
                             {"mitigations", kInfo},
                             {"PCIe sleep", kInfo},
                             {"isolation", kWarn},
                             {"tick mode", kOk},
                             {"RCU callbacks", kInfo},
                             {"interrupt routing", kWarn},
                             {"workqueues", kWarn},
                             {"SMT sibling", kOk},
                             {"tasks above the loop", kOk},
                             {"governor", kUnknown},
                             {"turbo", kUnknown},
                             {"idle states", kOk},
                             {"device power", kInfo},
                             {"device IRQ thread", kInfo}};
  EXPECT_EQ(machine.verdicts(1), expected);
  for (const Finding& each : findings) {
    const bool to_do = each.verdict == kWarn || each.verdict == kFail || each.verdict == kUnknown;
    if (to_do) {
      EXPECT_NE(each.remedy, "") << each.name;
    }
  }
  EXPECT_THAT(find(findings, "isolation").remedy,
              testing::StartsWith("boot with isolcpus=managed_irq,domain,1,"));
  EXPECT_EQ(find(findings, "interrupt routing").value, "here: 36 (of 2)");
}

// ---- every check can fail -----------------------------------------------------------------------

struct Change {
  std::string check;
  std::string path, text;  // text "-": the file is taken away
  Verdict expected;
  std::string value;  // part of the value that the finding shows
};
// The ready machine with one file changed: the check of that file fails, and no other.
void expect_seen_by_its_check_alone(const Change& change) {
  SCOPED_TRACE(change.check + ": " + change.path + ": " + change.text);
  Machine machine("ready.tree");
  Verdicts expected = machine.verdicts(3);
  ASSERT_TRUE(expected.contains(change.check));
  expected[change.check] = change.expected;
  if (change.text == "-") {
    machine.remove(change.path);
  } else {
    machine.write(change.path, change.text);
  }
  EXPECT_EQ(machine.verdicts(3), expected);
  const std::vector<Finding> findings = examine(machine.patient(3));
  EXPECT_THAT(find(findings, change.check).value, testing::HasSubstr(change.value));
}

const std::string kCpu = "/sys/devices/system/cpu";
const std::string kCpu3 = kCpu + "/cpu3";
const std::string kClock = "/sys/devices/system/clocksource/clocksource0/current_clocksource";

std::string task(const std::string& name, int priority) {
  return "90 (" + name +
         ") S 2 0 0 0 -1 0 0 0 0 0 0 0 0 0 -51 0 1 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 17 3 " +
         std::to_string(priority) + " 1 0 0";
}

const std::vector<Change> kKernelChanges = {
    Change{"clock resolution", "/proc/timer_list", "  .resolution: 4000000 nsecs", kFail,
           "4000000"},
    Change{"clock resolution", "/proc/timer_list", "-", kUnknown, ""},
    Change{"clock source", kClock, "hpet", kFail, "hpet"},
    Change{"clock source", kClock, "kvm-clock", kWarn, "kvm-clock"},
    Change{"clock source", kClock, "-", kUnknown, ""},
    Change{"virtual machine", "/proc/cpuinfo", "vendor_id : GenuineIntel\nflags : sse hypervisor",
           kWarn, ""},
    Change{"virtual machine", "/proc/cpuinfo", "Features : fp asimd", kUnknown, ""},
    Change{"RT throttling", "/proc/sys/kernel/sched_rt_runtime_us", "-1", kOk, "-1"},
    Change{"RT throttling", "/proc/sys/kernel/sched_rt_runtime_us", "500000", kInfo, "500000"},
    Change{"swap", "/proc/swaps", "Filename Type\n/dev/sda2 partition 1 0 -2\n", kWarn, "1 area"},
    Change{"swap", "/proc/swaps", "-", kUnknown, ""},
    Change{"huge pages", "/sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never",
           kWarn, "always"},
    Change{"huge pages", "/sys/kernel/mm/transparent_hugepage", "-", kOk, "not built in"},
    Change{"huge pages", "/sys/kernel/mm/transparent_hugepage/enabled", "-", kUnknown, ""},
    Change{"page merging", "/sys/kernel/mm/ksm/run", "1", kWarn, "1"},
    Change{"compaction", "/proc/sys/vm/compaction_proactiveness", "20", kWarn, "20"},
    Change{"compaction", "/proc/sys/vm/compaction_proactiveness", "-", kOk, "not built in"},
    Change{"compaction", "/proc/sys/vm", "-", kUnknown, ""},
    Change{"lockup detectors", "/proc/sys/kernel/watchdog", "1", kWarn, "0-3"},
    Change{"lockup detectors", "/proc/sys/kernel/nmi_watchdog", "1", kWarn, "0-3"},
    Change{"timer migration", "/proc/sys/kernel/timer_migration", "1", kInfo, "1"},
    Change{"tracing", "/sys/kernel/tracing/current_tracer", "function", kWarn, "function"},
    Change{"tracing", "/sys/kernel/tracing/current_tracer", "-", kUnknown, ""},
    Change{"tracing", "/sys/kernel/tracing", "-", kOk, "not built in"},
    Change{"EFI runtime", "/sys/firmware/efi", "-", kOk, "no EFI"},
    Change{"EFI runtime", "/sys/firmware", "-", kUnknown, ""},
    Change{"mitigations", kCpu + "/vulnerabilities", "-", kUnknown, ""},
    Change{"PCIe sleep", "/sys/module/pcie_aspm/parameters/policy", "[default] performance", kInfo,
           "default"},
    Change{"real-time priority", "/proc/self/limits",
           "Max realtime priority     79        90\nMax locked memory  unlimited x bytes", kFail,
           "at most 79"},
    Change{"locked memory", "/proc/self/limits",
           "Max realtime priority     90        90\nMax locked memory  8388608 x bytes", kFail,
           "8388608"},
    Change{"locked memory", "/proc/self/limits", "Max realtime priority     90        90", kUnknown,
           ""}};

const std::vector<Change> kProcessorChanges = {
    Change{"tick mode", kCpu + "/nohz_full", "2-3", kInfo, "2-3"},
    Change{"tick mode", kCpu + "/nohz_full", "(null)", kOk, "(null)"},
    Change{"interrupt routing", "/proc/irq/16/effective_affinity_list", "0-3", kWarn, "here: 16"},
    Change{"interrupt routing", "/proc/irq/16/effective_affinity_list", "-", kUnknown, ""},
    Change{"interrupt routing", "/proc/interrupts", "-", kUnknown, ""},
    Change{"workqueues", "/sys/devices/virtual/workqueue/cpumask", "ff", kWarn, "ff"},
    Change{"workqueues", "/sys/devices/virtual/workqueue/cpumask", "00000001,00000000", kOk, ""},
    Change{"workqueues", "/sys/devices/virtual/workqueue/cpumask", "what", kUnknown, ""},
    Change{"SMT sibling", kCpu3 + "/topology/thread_siblings_list", "1,3", kWarn, "1,3"},
    Change{"SMT sibling", kCpu3 + "/topology/thread_siblings_list", "3", kOk, "none"},
    Change{"SMT sibling", kCpu3 + "/topology/thread_siblings_list", "-", kUnknown, ""},
    Change{"governor", kCpu3 + "/cpufreq/scaling_governor", "powersave", kFail, "powersave"},
    Change{"governor", kCpu3 + "/cpufreq/scaling_min_freq", "800000", kWarn, "800000 to 3600000"},
    Change{"governor", kCpu3 + "/cpufreq/scaling_min_freq", "-", kUnknown, ""},
    Change{"governor", kCpu3 + "/cpufreq", "-", kUnknown, "Linux"},
    Change{"turbo", kCpu + "/intel_pstate/no_turbo", "0", kInfo, "on"},
    Change{"turbo", kCpu + "/intel_pstate/no_turbo", "-", kUnknown, ""},
    Change{"idle states", kCpu3 + "/cpuidle/state2/disable", "0", kWarn, "C6 (133 us)"},
    Change{"idle states", kCpu3 + "/cpuidle/state2/latency", "-", kUnknown, ""},
    Change{"idle states", kCpu3 + "/cpuidle", "-", kUnknown, ""},
    Change{"device power", "/sys/bus/usb/devices/1-2/power/control", "auto", kWarn,
           "3D Systems Touch at 1-2"},
    Change{"device power", "/sys/bus/usb/devices/1-2/idVendor", "1d6b", kInfo, "no haptic device"},
    Change{"device power", "/sys/bus/usb", "-", kInfo, "no USB"},
    Change{"device IRQ thread", "/proc/77/status", "Cpus_allowed_list:\t0-3", kWarn,
           "irq/16-xhci_hcd (50)"},
    Change{"device IRQ thread", "/proc/77/stat", "-", kInfo, ""}};

TEST(Doctor, EveryCheckCanFail) {
  for (const auto* changes : {&kKernelChanges, &kProcessorChanges}) {
    for (const Change& change : *changes) expect_seen_by_its_check_alone(change);
  }
}

TEST(Doctor, PreemptRtIsFoundWhereTheVersionDoesNotSayIt) {
  Machine machine("ready.tree");
  machine.remove("/proc/version");
  EXPECT_EQ(machine.verdicts(3)["RT kernel"], kUnknown);
  machine.write("/proc/version", "Linux version 6.12.1 #1 SMP");
  EXPECT_EQ(machine.verdicts(3)["RT kernel"], kFail);
  machine.write("/sys/kernel/realtime", "1\n");
  EXPECT_EQ(machine.verdicts(3)["RT kernel"], kOk);
  machine.remove("/sys/kernel/realtime");
  machine.write("/boot/config-6.12.1", "CONFIG_X=y\nCONFIG_PREEMPT_RT=y\n");
  EXPECT_EQ(machine.verdicts(3)["RT kernel"], kOk);
}

TEST(Doctor, IsolationByACpusetCountsToo) {
  Machine machine("ready.tree");
  machine.write(kCpu + "/isolated", "\n");
  EXPECT_EQ(machine.verdicts(3)["isolation"], kWarn);
  EXPECT_EQ(machine.verdicts(3)["SMT sibling"], kWarn);
  machine.write("/sys/fs/cgroup/cpuset.cpus.isolated", "2-3\n");
  EXPECT_EQ(machine.verdicts(3)["isolation"], kOk);
}

TEST(Doctor, BootLineSaysWhichProcessorsRunCallbacks) {
  Machine machine("ready.tree");
  machine.write("/proc/cmdline", "quiet rcu_nocbs=all");
  EXPECT_EQ(machine.verdicts(3)["RCU callbacks"], kOk);
  machine.write("/proc/cmdline", "quiet rcu_nocbs=1-2 efi=runtime");
  EXPECT_EQ(machine.verdicts(3)["RCU callbacks"], kInfo);
  EXPECT_EQ(machine.verdicts(3)["EFI runtime"], kInfo);
}

TEST(Doctor, ATaskAboveTheLoopIsNamedOnlyWhereItMayRun) {
  Machine machine("ready.tree");
  const std::string folder = "/proc/90/task/91";
  machine.write(folder + "/stat", task("a) (b", 80));
  machine.write(folder + "/status", "Cpus_allowed_list:\t0-3\n");
  const std::vector<Finding> findings = examine(machine.patient(3));
  EXPECT_EQ(find(findings, "tasks above the loop").verdict, kWarn);
  EXPECT_EQ(find(findings, "tasks above the loop").value, "a) (b (80)");
  machine.write(folder + "/status", "Cpus_allowed_list:\t0-2\n");
  EXPECT_EQ(machine.verdicts(3)["tasks above the loop"], kOk);
  machine.write(folder + "/status", "Cpus_allowed_list:\t0-3\n");
  machine.write(folder + "/stat", task("lower", 79));
  EXPECT_EQ(machine.verdicts(3)["tasks above the loop"], kOk);
}

// ---- what only a trial shows --------------------------------------------------------------------

TEST(Doctor, ATrialCountsMoreThanALimit) {
  const Machine machine("ready.tree");
  Patient patient = machine.patient(3);
  patient.trials = Trials{{true, ""}, {true, ""}, {true, ""}, 1, {true, ""}, std::nullopt};
  EXPECT_EQ(fitness(examine(patient)), Fitness::kReady);
  EXPECT_EQ(find(examine(patient), "device priority").verdict, kOk);
  patient.trials =
      Trials{{false, "not you"}, {false, "full"}, {false, ""}, 4'000'000, {false, "no"}, false};
  const std::vector<Finding> findings = examine(patient);
  EXPECT_EQ(find(findings, "real-time priority").verdict, kFail);
  EXPECT_EQ(find(findings, "real-time priority").value, "SCHED_FIFO 80 refused (not you)");
  EXPECT_EQ(find(findings, "device priority").verdict, kWarn);
  EXPECT_EQ(find(findings, "device priority").value, "SCHED_FIFO 90 refused (no)");
  EXPECT_EQ(find(findings, "device watchdog").verdict, kWarn);
  EXPECT_EQ(find(findings, "device watchdog").value, "refused");
  EXPECT_EQ(find(findings, "locked memory").verdict, kFail);
  EXPECT_EQ(find(findings, "clock resolution").verdict, kFail);
  EXPECT_EQ(find(findings, "idle states").verdict, kOk);  // no deep one is on
}

// ---- disturbances -------------------------------------------------------------------------------

Verdicts compared(const Machine& machine, const Disturbances& before) {
  Verdicts all;
  const Patient patient = machine.patient(3);
  for (const Finding& each :
       compare_disturbances(patient, before, count_disturbances(patient), 1)) {
    all[each.name] = each.verdict;
  }
  return all;
}

TEST(Disturbances, AreTheCountersThatGrew) {
  Machine machine("ready.tree");
  machine.write("/dev/cpu/3/msr", std::string(0x34, '\0') + std::string("\x05\0\0\0\0\0\0\0", 8));
  const Disturbances before = count_disturbances(machine.patient(3));
  EXPECT_EQ(before.system_management, 5U);
  EXPECT_EQ(before.throttled, 7U);
  EXPECT_EQ(before.interrupts.at("RES:"), 4U);
  EXPECT_EQ(before.interrupts.at("16:xhci_hcd"), 0U);
  EXPECT_FALSE(before.interrupts.contains("LOC:"));
  const Verdicts quiet = {
      {"interrupts", kOk}, {"firmware interrupts", kOk}, {"throttled by heat", kOk}};
  EXPECT_EQ(compared(machine, before), quiet);

  machine.write("/dev/cpu/3/msr", std::string(0x34, '\0') + std::string("\x06\0\0\0\0\0\0\0", 8));
  machine.write(kCpu3 + "/thermal_throttle/core_throttle_count", "8");
  machine.write("/proc/interrupts",
                "      CPU0 CPU1 CPU2 CPU3\n 16: 9 9 9 0 PCI-MSI 1 xhci_hcd\n LOC: 9 9 9 9999 x\n"
                " RES: 9 9 9 5 Rescheduling\n");
  const Verdicts disturbed = {
      {"interrupts", kWarn}, {"firmware interrupts", kWarn}, {"throttled by heat", kWarn}};
  EXPECT_EQ(compared(machine, before), disturbed);
}

TEST(Disturbances, AreUnknownIfTheyCannotBeCounted) {
  Machine machine("");
  const Verdicts unknown = {
      {"interrupts", kUnknown}, {"firmware interrupts", kUnknown}, {"throttled by heat", kUnknown}};
  EXPECT_EQ(compared(machine, count_disturbances(machine.patient(3))), unknown);
  machine.write("/proc/cpuinfo", "vendor_id : AuthenticAMD\n");
  EXPECT_EQ(compared(machine, {})["firmware interrupts"], kInfo);
}

// ---- verdict ------------------------------------------------------------------------------------

TEST(Fitness, IsTheWorstCertainVerdict) {
  const auto of = [](std::vector<std::pair<Verdict, Verdict>> verdict_and_severity) {
    std::vector<Finding> findings;
    for (const auto& [verdict, severity] : verdict_and_severity) {
      findings.push_back({"", verdict, severity, "", "", ""});
    }
    return fitness(findings);
  };
  EXPECT_EQ(of({{kOk, kFail}, {kInfo, kInfo}, {kUnknown, kInfo}}), Fitness::kReady);
  EXPECT_EQ(of({{kOk, kFail}, {kWarn, kWarn}}), Fitness::kDegraded);
  EXPECT_EQ(of({{kUnknown, kWarn}}), Fitness::kDegraded);
  EXPECT_EQ(of({{kUnknown, kFail}}), Fitness::kDegraded);
  EXPECT_EQ(of({{kFail, kFail}, {kWarn, kWarn}}), Fitness::kUnfit);
}

// ---- notations ----------------------------------------------------------------------------------

TEST(Notation, ListsAndMasks) {
  EXPECT_EQ(parse_cpu_list("0-2,5"), (std::vector<int>{0, 1, 2, 5}));
  EXPECT_TRUE(parse_cpu_list("").empty());
  EXPECT_TRUE(parse_cpu_list("(null)").empty());
  EXPECT_TRUE(parse_cpu_list("0-99999999999").empty());
  EXPECT_EQ(mask_holds("00000001,00000008", 3), true);
  EXPECT_EQ(mask_holds("00000001,00000008", 32), true);
  EXPECT_EQ(mask_holds("00000001,00000008", 33), false);
  EXPECT_EQ(mask_holds("8", 300), false);
  EXPECT_EQ(mask_holds("", 0), std::nullopt);
  EXPECT_EQ(mask_holds("0x8", 0), std::nullopt);
  EXPECT_EQ(chosen("a [b] c"), "b");
  EXPECT_EQ(chosen("b"), "b");
}

TEST(Notation, AFolderHasNoText) {
  const Machine machine("ready.tree");
  EXPECT_EQ(read_text({machine.root()}, "/proc"), std::nullopt);
  EXPECT_EQ(read_text({machine.root()}, "/nothing"), std::nullopt);
}

// ---- measuring ----------------------------------------------------------------------------------

TEST(Measure, CountsEveryCycleAndEveryMissedPeriod) {
  MeasureConfig config;
  config.cycles = 20;
  int runs = 0, rests = 0;
  const Body late = {[&] {
                       ++runs;
                       usleep(2500);
                     },
                     [&] { ++rests; }};
  Measured measured;
  std::atomic<std::uint64_t> progress{0};
  const std::atomic<bool> stop{false};
  measure(config, late, &progress, stop, measured);
  EXPECT_EQ(runs, 20);
  EXPECT_EQ(rests, 20);
  EXPECT_EQ(progress.load(), 20U);
  EXPECT_EQ(measured.cycles, 20U);
  EXPECT_GE(measured.missed, 40U);  // at least two in each 2.5 ms
  EXPECT_EQ(measured.wake_up.histogram.total, 20U);
  EXPECT_EQ(measured.body.histogram.total, 20U);
  EXPECT_GE(measured.body.min_ns, 2'500'000);
  EXPECT_GE(measured.body.mean_ns, static_cast<double>(measured.body.min_ns));
  EXPECT_LE(measured.body.mean_ns, static_cast<double>(measured.body.histogram.max_ns));
  EXPECT_GE(measured.wake_up.min_ns, 0);
}

TEST(Measure, StopEndsIt) {
  MeasureConfig config;
  config.cycles = 1'000'000'000;
  std::atomic<bool> stop{false};
  int runs = 0;
  const Body body = {[&] {
                       if (++runs == 3) stop.store(true);
                     },
                     {}};
  Measured measured;
  measure(config, body, nullptr, stop, measured);
  EXPECT_EQ(measured.cycles, 3U);
}

// ---- the program --------------------------------------------------------------------------------

struct Said {
  int exit_code;
  std::string out;
};

// `folder` is where its output goes.
Said call(const std::string& arguments, const Machine& folder) {
  const fs::path out = fs::path(folder.root()) / "said";
  const std::string command =
      std::string(STYLET_PROGRAM) + " doctor " + arguments + " > '" + out.string() + "' 2>&1";
  const int status = std::system(command.c_str());
  std::ostringstream text;
  text << std::ifstream(out).rdbuf();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
}

Said doctor(const Machine& machine, const std::string& arguments) {
  return call("--root '" + machine.root() + "' " + arguments, machine);
}

TEST(Program, ExitCodeIsTheVerdict) {
  Machine machine("ready.tree");
  EXPECT_EQ(doctor(machine, "--cpu 3").exit_code, 0);
  EXPECT_EQ(doctor(machine, "--cpu 1").exit_code, 3);  // not isolated
  machine.write(kClock, "hpet");
  EXPECT_EQ(doctor(machine, "--cpu 3").exit_code, 4);
  EXPECT_EQ(doctor(machine, "--cpu -4").exit_code, 2);
  EXPECT_EQ(doctor(machine, "--measure 1").exit_code, 2);  // a captured tree cannot be measured
  EXPECT_EQ(doctor(machine, "--replay a.h5").exit_code, 2);
}

TEST(Program, TextFitsAHundredColumnsAndNamesTheRemedy) {
  const Machine machine("guest.tree");
  const Said said = doctor(machine, "--cpu 1");
  for (const std::string& line : lines_of(said.out)) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(said.out, testing::HasSubstr("-> boot with isolcpus=managed_irq,domain,1"));
  EXPECT_THAT(said.out, testing::HasSubstr("\nnot suitable: "));
}

TEST(Program, JsonHasEveryFinding) {
  const Machine machine("guest.tree");
  const auto said = nlohmann::json::parse(doctor(machine, "--cpu 1 --json").out);
  EXPECT_EQ(said["verdict"], "not suitable");
  EXPECT_EQ(said["cpu"], 1);
  ASSERT_EQ(said["findings"].size(), 29U);
  for (const auto& each : said["findings"]) {
    for (const char* key : {"name", "verdict", "severity", "value", "source", "remedy"}) {
      EXPECT_TRUE(each.contains(key)) << key;
    }
  }
}

// Of this machine, since a captured one cannot be asked. Its other findings are whatever they are.
TEST(Program, OpensTheDevicesItIsAskedAbout) {
  const std::string port = std::to_string(20000 + getpid() % 12000);
  const Link taken = udp_listen(port);
  const Machine folder("");
  const Said said = call("--json --device udp:" + port, folder);
  taken.close(taken.self);
  EXPECT_EQ(said.exit_code, 4);
  std::string value;
  const auto findings = nlohmann::json::parse(said.out.substr(said.out.find('{')))["findings"];
  for (const auto& each : findings) {
    if (each["name"] == "device opens") value = each["value"];
  }
  EXPECT_EQ(value, "Address already in use");
  EXPECT_EQ(call("--device nothing:1", folder).exit_code, 1);
  EXPECT_EQ(call("--scene fig09-force-curve", folder).exit_code, 1);  // it names no device
  EXPECT_EQ(doctor(folder, "--device udp:" + port).exit_code, 2);
}

}  // namespace
}  // namespace stylet::hal
