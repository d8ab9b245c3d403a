// SPDX-License-Identifier: Apache-2.0
// How long a tick takes, on blocks of voxels, on organ files, and on the OpenHELP liver where the
// data is there.
//
// tissue: the lattice step alone, needle outside. tick: the whole kernel with the needle inserted,
// pulled sideways. Each for every instruction set this processor has; the median of several
// repetitions counts.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "session.h"
#include "variants.h"

namespace stylet::test {
namespace {

namespace fs = std::filesystem;

struct Subject {
  std::string name;
  std::unique_ptr<OpenOrgan> opened;
};

// Where the needle enters: from above, on the line through the middle of the organ's voxels.
Script script_for(const Organ& organ, const Config& config) {
  Script script = block_script(organ, config);
  double x = 0, y = 0, count = 0;
  for (const OrganRun& run : organ.runs) {
    x += run.count * (run.x + 0.5 * run.count);
    y += run.count * (run.y + 0.5);
    count += run.count;
  }
  script.entry_m.x = organ.origin_m.x + organ.voxel_edge_m * static_cast<float>(x / count);
  script.entry_m.y = organ.origin_m.y + organ.voxel_edge_m * static_cast<float>(y / count);
  const Vec3 above_m = {script.entry_m.x, script.entry_m.y, script.entry_m.z + 0.01F};
  float distance_m = 0;
  if (organ_raycast(organ, above_m, {0, 0, -1}, distance_m)) {
    script.entry_m.z = above_m.z - distance_m;
  }
  return script;
}

void report(benchmark::State& state, const Organ& organ, const Config& config) {
  using benchmark::Counter;
  const double steps = static_cast<double>(organ.voxel_count) * config.substeps;
  state.counters["per_voxel_substep"] =
      Counter(steps, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["voxels"] = organ.voxel_count;
}

void bench_tissue(benchmark::State& state, const Organ& organ, const Variant& variant) {
  const Config config = config_of(Setup::kPhysical);
  Session session = make_session(organ, config);
  session.kernel.step = variant.step;
  run(session.kernel, script_for(organ, config), 0, kCycleTicks);
  for (auto _ : state) session.kernel.step(session.kernel);
  report(state, organ, config);
}

void bench_tick(benchmark::State& state, const Organ& organ, Setup setup, const Variant& variant) {
  const Config config = config_of(setup);
  const Script script = script_for(organ, config);
  Session session = make_session(organ, config);
  session.kernel.step = variant.step;
  run(session.kernel, script, 0, kPauseBegin);
  std::uint64_t at = kPauseBegin;
  Output output{};
  for (auto _ : state) {
    output = tick(session.kernel, scripted_input(script, at));
    at = at + 1 < kPauseEnd ? at + 1 : kPauseBegin;
  }
  report(state, organ, config);
  state.counters["cps"] = output.constraint_particles;
}

void register_subject(const Subject& subject) {
  const Organ& organ = subject.opened->organ;
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(name.c_str(), body)
        ->Unit(benchmark::kMicrosecond)
        ->MinTime(0.1)
        ->Repetitions(5)
        ->DisplayAggregatesOnly();
  };
  for (const Variant& variant : variants_here()) {
    const std::string tail = "/" + subject.name + "/" + variant.name;
    add("tissue" + tail,
        [&organ, variant](benchmark::State& state) { bench_tissue(state, organ, variant); });
    add("tick" + tail, [&organ, variant](benchmark::State& state) {
      bench_tick(state, organ, Setup::kPhysical, variant);
    });
    add("tick_elastic" + tail, [&organ, variant](benchmark::State& state) {
      bench_tick(state, organ, Setup::kElastic, variant);
    });
  }
  add("tick_paper/" + subject.name, [&organ](benchmark::State& state) {
    bench_tick(state, organ, Setup::kPaper, variants_here().back());
  });
}

std::vector<std::byte> read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  std::vector<std::byte> result(bytes.size());
  std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

bool add_file(const fs::path& path, const std::string& name, std::vector<Subject>& subjects) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    std::cerr << path.string() << ": cannot be read: expected an organ file\n";
    return false;
  }
  auto opened = std::make_unique<OpenOrgan>();
  opened->bytes = read_bytes(path);
  OrganRefusal refusal;
  if (organ_open(opened->bytes, opened->organ, &refusal) != Status::kOk) {
    std::cerr << path.string() << ": " << status_name(refusal.status) << ": " << refusal.place
              << "\n";
    return false;
  }
  subjects.push_back({name, std::move(opened)});
  return true;
}

// Without its report: standard output is for the measurements.
bool run_silently(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  int status = 0;
  const bool started =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  return started && waitpid(child, &status, 0) == child && status == 0;
}

// The OpenHELP liver at 5 mm, built by the stylet-organ beside this program.
void add_openhelp(std::vector<Subject>& subjects) {
  const char* data = std::getenv("STYLET_DATA");
  const fs::path mesh =
      fs::path(data != nullptr ? data : STYLET_DATA_DEFAULT) / "organs/openhelp_Liver.stl";
  const fs::path builder = fs::read_symlink("/proc/self/exe").parent_path() / "stylet-organ";
  if (!fs::exists(mesh) || !fs::exists(builder)) {
    std::cerr << "no OpenHELP liver: " << (fs::exists(mesh) ? builder : mesh).string()
              << " is not there\n";
    return;
  }
  const fs::path organ =
      fs::temp_directory_path() / ("stylet-bench-" + std::to_string(getpid()) + ".organ");
  if (run_silently({builder.string(), "build", mesh.string(), "--units", "mm", "--voxel-mm", "5",
                    "-o", organ.string()})) {
    add_file(organ, "openhelp_liver", subjects);
  }
  fs::remove(organ);
}

void describe_machine() {
  std::ifstream cpus("/proc/cpuinfo");
  std::string line, model = "unknown processor";
  while (std::getline(cpus, line)) {
    if (line.rfind("model name", 0) == 0) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  }
  benchmark::AddCustomContext("processor", model);
  benchmark::AddCustomContext("compiler", __VERSION__);
  std::string names;
  for (const Variant& variant : variants_here()) names += std::string(variant.name) + " ";
  benchmark::AddCustomContext("instruction sets", names);
}

}  // namespace
}  // namespace stylet::test

// usage: stylet-bench [ORGAN...] [--benchmark_filter=...]
int main(int argc, char** argv) {
  using namespace stylet::test;
  benchmark::Initialize(&argc, argv);
  std::vector<Subject> subjects;
  subjects.push_back({"block_1k", block_organ(10, 10, 10)});
  subjects.push_back({"block_5k", block_organ(17, 17, 17)});
  subjects.push_back({"block_20k", block_organ(27, 27, 27)});
  for (int i = 1; i < argc; ++i) {
    if (!add_file(argv[i], fs::path(argv[i]).stem().string(), subjects)) return 1;
  }
  if (argc == 1) add_openhelp(subjects);
  for (const Subject& subject : subjects) register_subject(subject);
  describe_machine();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
