// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

#include "hal/app/commands.h"
#include "hal/app/doctor_text.h"
#include "hal/app/opening.h"
#include "hal/app/scene_name.h"
#include "hal/app/terminal.h"
#include "hal/base/contained.h"
#include "hal/doctor/opened.h"
#include "hal/record/replay.h"
#include "hal/scene/scene.h"
#include "stylet/resonance.h"

namespace stylet::app {
namespace {

// Allowed lateness of a wake-up and duration of a tick, within the period of 1 ms.
constexpr std::int64_t kWakeUpBudgetNs = 100'000;
constexpr std::int64_t kTickBudgetNs = 450'000;

// A kernel that ticks through a recording's inputs, over and over.
class Patrol {
 public:
  Patrol(const std::string& path, const std::string& organ_path) {
    const hal::RecordingReader recording(path);
    const hal::RecordingInfo& info = recording.info();
    if (recording.ticks() == 0) throw hal::RecordingError(path + ": no ticks: expected some");
    organ_ = hal::load_recorded_organ(path, info, organ_path);
    instance_ = std::make_unique<hal::KernelInstance>(organ_.organ, info.config, info.obstacles);
    needles_ = info.config.needle_count;
    inertia_ = info.config.inertia;
    inputs_.resize(recording.ticks() * needles_);
    std::vector<hal::TickRecord> records(recording.ticks());
    for (std::uint32_t needle = 0; needle < needles_; ++needle) {
      recording.read(0, records, needle);
      for (std::size_t t = 0; t < records.size(); ++t) {
        inputs_[t * needles_ + needle] = records[t].input;
      }
    }
  }

  const Kernel& kernel() const { return instance_->kernel; }
  Inertia inertia() const { return inertia_; }

  hal::Body body() {
    return {[this] {
              (void)tick(instance_->kernel, std::span(inputs_).subspan(next_, needles_),
                         std::span(outputs_).first(needles_));
              next_ += needles_;
            },
            [this] {
              if (next_ < inputs_.size()) return;
              reset(instance_->kernel);
              next_ = 0;
            }};
  }

 private:
  hal::OrganFile organ_;
  std::unique_ptr<hal::KernelInstance> instance_;
  Inertia inertia_ = Inertia::kTrueMass;
  std::vector<Input> inputs_;  // of all needles, tick by tick
  std::array<Output, kMaxNeedles> outputs_ = {};
  std::size_t needles_ = 1, next_ = 0;
};

hal::Finding judged(const Measurement& each, const char* what, const hal::Spread& spread,
                    std::int64_t budget_ns) {
  const hal::Measured& m = each.measured;
  hal::Finding finding;
  finding.name = fmt::format("{} {}", each.name, what);
  finding.severity = hal::Verdict::kFail;
  finding.verdict = m.missed > 0                          ? hal::Verdict::kFail
                    : spread.histogram.max_ns > budget_ns ? hal::Verdict::kWarn
                                                          : hal::Verdict::kOk;
  finding.value = fmt::format("at most {:.0f} us, {} of {} periods missed",
                              static_cast<double>(spread.histogram.max_ns) * 1e-3, m.missed,
                              m.cycles + m.missed);
  finding.source = fmt::format(
      "measured {}", m.host.lacks.empty() ? "as the loop runs" : "without the loop's rights");
  if (finding.verdict != hal::Verdict::kOk) {
    finding.remedy = fmt::format(
        "expected at most {} us and no period missed: do what is advised above", budget_ns / 1000);
  }
  return finding;
}

// Whether a moving hand feels mass that the recording's tissue does not have.
hal::Finding judged(const Resonance& of, Inertia inertia) {
  hal::Finding finding;
  finding.name = "inertia";
  finding.severity = hal::Verdict::kWarn;
  const bool departs = of.departs_hz < kFastestHandHz;
  finding.verdict = departs ? hal::Verdict::kWarn : hal::Verdict::kOk;
  finding.value = of.real_hz > 0
                      ? fmt::format("first resonance {:.3g} Hz instead of the tissue's {:.3g} Hz",
                                    of.stepped_hz, of.real_hz)
                      : "nothing holds the organ";
  finding.source = "the recording's organ, step and mass";
  if (departs) {
    finding.remedy = fmt::format(
        "above {:.2g} Hz the force on a moving hand may be off by a tenth: expected {}more "
        "loop.substeps",
        of.departs_hz, inertia == Inertia::kTrueMass ? "" : "loop.inertia = \"true_mass\", or ");
  }
  return finding;
}

void show_progress(std::uint64_t done, std::uint64_t all) {
  if (!terminal_rewrites_lines()) return;
  rewrite_line(fmt::format("{:.0f} of {:.0f} s", static_cast<double>(done) * 1e-3,
                           static_cast<double>(all) * 1e-3));
}

// In equal parts of the time: without ticks, with ticks (if there are any), and with load beside.
void measure_all(const DoctorOptions& options, DoctorReport& report) {
  std::unique_ptr<Patrol> patrol;
  if (!options.recording.empty()) {
    patrol = std::make_unique<Patrol>(options.recording, options.organ);
    report.findings.push_back(judged(first_resonance(patrol->kernel()), patrol->inertia()));
  }
  const hal::Body ticks = patrol ? patrol->body() : hal::Body{};
  report.measurements = {{"quiet", false, {}}, {"loaded", patrol != nullptr, {}}};
  if (patrol) report.measurements.insert(report.measurements.begin() + 1, {"busy", true, {}});
  const auto measurements = static_cast<double>(report.measurements.size());
  hal::MeasureConfig config = {.cpu = report.cpu, .priority = report.priority};
  config.cycles = static_cast<std::uint64_t>(std::ceil(options.measure_s * 1e3 / measurements));
  const std::uint64_t all = config.cycles * report.measurements.size();
  std::atomic<std::uint64_t> cycles{0};
  const std::atomic<bool> stop{false};
  const std::jthread watch([&](const std::stop_token& done) {
    (void)hal::contained("doctor", [&] {
      while (!done.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        show_progress(cycles.load(), all);
      }
      if (terminal_rewrites_lines()) rewrite_line("");
    });
  });
  for (Measurement& each : report.measurements) {
    config.load_others = &each == &report.measurements.back();
    hal::measure(config, each.has_body ? ticks : hal::Body{}, &cycles, stop, each.measured);
    report.findings.push_back(judged(each, "wake-up", each.measured.wake_up, kWakeUpBudgetNs));
    if (each.has_body) {
      report.findings.push_back(judged(each, "tick", each.measured.body, kTickBudgetNs));
    }
  }
}

// ---- devices ------------------------------------------------------------------------------------

std::vector<std::string> wanted_devices(const DoctorOptions& options) {
  std::vector<std::string> uris = options.devices;
  for (const std::string& uri : uris) {
    if (const std::string expected = hal::device_uri_fault(uri); !expected.empty()) {
      throw hal::DeviceError(fmt::format("--device: {}: expected {}", uri, expected));
    }
  }
  if (options.scene.empty()) return uris;
  const std::size_t given = uris.size();
  for (const hal::Hand& hand : hal::read_scene(scene_file(options.scene)).hands) {
    if (hand.device == "attached") uris.push_back(hand.uri);
  }
  if (uris.size() == given) {
    throw hal::SceneError(fmt::format(
        "{}: device.uri: missing: expected a scene that names a device, or --device URI",
        options.scene));
  }
  return uris;
}

void examine_device(const std::string& uri, const hal::Patient& patient, DoctorReport& report) {
  fmt::print(stderr, "stylet: waiting for {}\n", uri);
  std::atomic<bool> stop{false};
  const StopOnSignal stop_on_signal(stop);  // before the device is open
  try {
    const Opened opened(uri, hal::open_device);
    const auto seen = std::make_unique<hal::DeviceProbe>();
    std::async(std::launch::async, [&] {
      hal::HostReport host;
      hal::prepare_thread(patient.cpu, patient.priority, host);
      constexpr double kWatchedS = 1;
      hal::probe_device(opened.device, kWatchedS, false, hal::monotonic_clock(), stop, *seen);
    }).get();
    for (hal::Finding& each : hal::judge_opened(uri, opened.device, *seen)) {
      report.findings.push_back(std::move(each));
    }
  } catch (const hal::DeviceError& error) {
    if (stop_was_asked()) throw;
    report.findings.push_back(hal::judge_refused(uri, error.what()));
  }
}

// This machine, which can be asked and watched as well as looked at.
void examine_here(const DoctorOptions& options, hal::Patient& patient, DoctorReport& report) {
  const std::vector<std::string> uris = wanted_devices(options);
  hal::HostState host;  // holds what the loop would hold, until the end
  hal::prepare_process(host);
  patient.trials = hal::try_rights(host, options.cpu, options.priority, patient.cpu);
  report.cpu = patient.cpu;
  report.findings = hal::examine(patient);
  constexpr double kWatchedS = 1;
  const hal::Disturbances before = hal::count_disturbances(patient);
  std::this_thread::sleep_for(std::chrono::duration<double>(kWatchedS));
  const hal::Disturbances after = hal::count_disturbances(patient);
  for (hal::Finding& each : hal::compare_disturbances(patient, before, after, kWatchedS)) {
    report.findings.push_back(std::move(each));
  }
  for (const std::string& uri : uris) examine_device(uri, patient, report);
  if (options.measure_s > 0) measure_all(options, report);
}

}  // namespace

int doctor(const DoctorOptions& options) {
  hal::Patient patient = {options.root, std::max(options.cpu, 0), options.priority, {}};
  DoctorReport report = {options.root, patient.cpu, options.priority, {}, {}};
  if (options.root == "/") {
    examine_here(options, patient, report);
  } else {
    report.findings = hal::examine(patient);
  }
  fmt::print("{}", options.json ? json_text(report) : human_text(report));
  switch (hal::fitness(report.findings)) {
    case hal::Fitness::kReady:
      return kExitOk;
    case hal::Fitness::kDegraded:
      return kExitTrouble;
    case hal::Fitness::kUnfit:
      break;
  }
  return kExitHostUnfit;
}

}  // namespace stylet::app
