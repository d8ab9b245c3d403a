// SPDX-License-Identifier: Apache-2.0
// How long a step of the tissue and a tick take, on liver-like lattices and on organ files named as
// arguments: for every instruction set of this processor, and next to other programs on the same
// lattices.
//
// tissue: the lattice step with everything physical on and a needle inserted. tick: the whole
// kernel, needle inserted and pulled sideways; tick_elastic: with an elastic needle in breathing
// tissue. cadence: kernel and guard at a real period, the processor spinning in between. bullet,
// eigen: peers.h. threads: that step by one thread (`alone`) and with one helper thread (`shared`);
// and by two threads that each do steps of their own, each on a processor of its own (`beside`).
// `shared` cannot take less than the time of `beside` over the number of all its steps; without
// `beside` there is no figure for it (summary.h). The repetitions of all are shuffled. What counts
// is the median of the single runs in a repetition, and then the median of these; for threads, only
// of the repetitions in which `beside` was fastest.
#include <benchmark/benchmark.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/input_file.h"
#include "hal/guard/guard.h"
#include "liver.h"
#include "machine.h"
#include "peers.h"
#include "processors.h"
#include "state/layout.h"
#include "summary.h"
#include "variants.h"

namespace stylet::test {
namespace {

namespace fs = std::filesystem;

// An organ, and what is made from it only once: sessions with the needle inserted, steps of peers.
struct Subject {
  std::string name;
  std::unique_ptr<OpenOrgan> opened;
  std::map<std::string, std::vector<std::byte>> inserted;
  std::map<std::string, std::function<void()>> peer;

  const Organ& organ() const { return opened->organ; }
};

// The step without passes, as peers have none: mass is added instead.
Config added_mass(Config config, std::uint32_t substeps) {
  config.inertia = Inertia::kAddedMass;
  config.substeps = substeps;
  return config;
}

// A kernel with the needle inserted, whose tissue step is the variant's.
Session inserted_session(Subject& subject, const Config& config, const Variant& variant) {
  Session session = make_session(subject.organ(), config);
  const Script script = script_for(subject.organ(), config);
  const std::string key(reinterpret_cast<const char*>(&config), sizeof(config));
  std::vector<std::byte>& bytes = subject.inserted[key];
  if (bytes.empty()) {
    run(session.kernel, script, 0, kPauseBegin);
    bytes.resize(snapshot_bytes(session.kernel));
    if (snapshot(session.kernel, bytes) != Status::kOk) std::abort();
  }
  if (restore(session.kernel, bytes) != Status::kOk) std::abort();
  session.kernel.step = variant.step;
  // A snapshot does not contain the scratch memory, in which a tick tells its steps which voxels
  // hold the needle: so one tick more.
  tick(session.kernel, scripted_input(script, kPauseBegin));
  if (view_of(session.kernel).scratch.head->coupled_count == 0) std::abort();
  return session;
}

// Which time: real time, or the processor time of this thread. On a quiet machine they are the
// same.
enum class Time { kPassing, kOwn };

double now_us(Time time) {
  timespec t{};
  clock_gettime(time == Time::kOwn ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

double middle(std::vector<double>& of) {
  const auto at = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
  std::nth_element(of.begin(), at, of.end());
  return *at;
}

// Times runs, several together where they are short; a median is not moved by the few that the
// machine interrupts.
class Stopwatch {
 public:
  Stopwatch(benchmark::State& state, Time time, int runs)
      : state_(state), time_(time), runs_(runs) {}
  ~Stopwatch() {
    if (!us_.empty()) state_.counters[kMedian] = middle(us_);
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

  template <typename Body>
  void time(const Body& body) {
    const double start = now_us(time_);
    for (int i = 0; i < runs_; ++i) body();
    us_.push_back((now_us(time_) - start) / runs_);
  }

 private:
  benchmark::State& state_;
  Time time_;
  int runs_;
  std::vector<double> us_;
};

// So many runs at a time that reading the clock, which takes a microsecond, does not matter.
int runs_for(const Subject& subject) {
  return subject.organ().voxel_count < 10000 ? 8 : 1;
}

void describe(benchmark::State& state, const Subject& subject, std::uint32_t substeps,
              std::uint32_t passes) {
  state.counters[kVoxels] = subject.organ().voxel_count;
  state.counters[kSubsteps] = substeps;
  state.counters[kPasses] = passes;
}

void bench_tissue(benchmark::State& state, Subject& subject, const Config& config,
                  const Variant& variant) {
  Session session = inserted_session(subject, config, variant);
  {
    Stopwatch watch(state, Time::kOwn, runs_for(subject));
    for (auto _ : state) watch.time([&] { session.kernel.step(session.kernel); });
  }
  describe(state, subject, 1, filter_passes(session.kernel));
}

// Steps of a turn: as many as take 2 ms, and at least 16, so that one step more or less of the
// other thread matters little.
int turn_steps(const Kernel& kernel) {
  const double start = now_us(Time::kPassing);
  kernel.step(kernel);
  return std::max(16, static_cast<int>(2000 / (now_us(Time::kPassing) - start)));
}

// The real time of one step, over `steps` of them. One step before them is left out: it fetches the
// data that the other thread had.
double step_us(const Kernel& kernel, int steps) {
  kernel.step(kernel);
  const double start = now_us(Time::kPassing);
  for (int i = 0; i < steps; ++i) kernel.step(kernel);
  return (now_us(Time::kPassing) - start) / steps;
}

// The other one of two threads.
class Other {
 public:
  enum class Does { kNothing, kStepsOfItsOwn, kHelps, kEnds };

  Other(const Kernel& own, const Kernel& helped, int processor)
      : thread_([this, &own, &helped, processor] {
          stay_on({processor});
          while (follow(own, helped)) {
          }
        }) {}
  ~Other() {
    ask(Does::kEnds);
    thread_.join();
  }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;

  // Returns once the thread does so.
  void ask(Does what) {
    asked_.store(what);
    while (does_.load() != what) {
    }
  }
  std::uint64_t own_steps() const { return own_steps_.load(); }  // so far

 private:
  bool follow(const Kernel& own, const Kernel& helped) {
    const Does now = asked_.load();
    does_.store(now);
    if (now == Does::kHelps) help(helped, 100);
    if (now == Does::kStepsOfItsOwn) {
      own.step(own);
      own_steps_.fetch_add(1);
    }
    return now != Does::kEnds;
  }

  std::atomic<Does> asked_ = Does::kNothing, does_ = Does::kEnds;
  std::atomic<std::uint64_t> own_steps_ = 0;
  std::thread thread_;
};

// Steps of one thread alone, of two threads with nothing in common, and of one with a helper, by
// turns of milliseconds, so that all of them meet the machine in the same state. For alone and
// shared: the median of the turns. For beside: the whole time over the number of steps that both
// did in it, since medians of single steps do not show that two threads take turns on one
// processor.
void bench_threads(benchmark::State& state, Subject& subject, const Variant& variant) {
  const std::vector<int> allowed = allowed_processors();
  const auto two = two_processors(allowed);
  if (!two || !stay_on({two->first})) {
    state.SkipWithError("two threads need two processors, this process may use one only");
    return;
  }
  const auto session = [&] {
    return inserted_session(subject, config_of(Setup::kPhysical), variant);
  };
  const Session own = session(), others = session();
  Session helped = session();
  const Block memory = make_block(team_bytes(helped.kernel, 1));
  if (set_team(helped.kernel, 1, memory.span()) != Status::kOk) std::abort();
  const int steps = turn_steps(own.kernel);
  std::vector<double> alone, shared;
  double beside_us = 0, beside_steps = 0;
  {
    Other other(others.kernel, helped.kernel, two->second);
    for (auto _ : state) {
      other.ask(Other::Does::kNothing);
      alone.push_back(step_us(own.kernel, steps));
      other.ask(Other::Does::kStepsOfItsOwn);
      own.kernel.step(own.kernel);
      const std::uint64_t before = other.own_steps();
      const double start = now_us(Time::kPassing);
      for (int i = 0; i < steps; ++i) own.kernel.step(own.kernel);
      beside_us += now_us(Time::kPassing) - start;
      beside_steps += steps + static_cast<double>(other.own_steps() - before);
      other.ask(Other::Does::kHelps);
      shared.push_back(step_us(helped.kernel, steps));
    }
  }
  stay_on(allowed);
  state.counters[kAlone] = middle(alone);
  state.counters[kBeside] = beside_us / beside_steps;
  state.counters[kShared] = middle(shared);
  describe(state, subject, 1, filter_passes(own.kernel));
}

void bench_tick(benchmark::State& state, Subject& subject, const Config& config,
                const Variant& variant) {
  const Script script = script_for(subject.organ(), config);
  Session session = inserted_session(subject, config, variant);
  std::uint64_t at = kPauseBegin;
  {
    Stopwatch watch(state, Time::kOwn, runs_for(subject));
    for (auto _ : state) {
      watch.time([&] {
        tick(session.kernel, scripted_input(script, at));
        at = at + 1 < kPauseEnd ? at + 1 : kPauseBegin;
      });
    }
  }
  describe(state, subject, config.substeps, filter_passes(session.kernel));
}

// As the loop does it: sample, tick, guard, then wait for the next period.
void bench_cadence(benchmark::State& state, Subject& subject, const Config& config,
                   const Variant& variant) {
  const Script script = script_for(subject.organ(), config);
  Session session = inserted_session(subject, config, variant);
  hal::GuardConfig guard;
  guard.period_s = config.period_s;
  hal::GuardState guarded = hal::guard_start();
  const std::int64_t period_ns = std::llround(1e9 * static_cast<double>(config.period_s));
  hal::Sample sample = {0, 0, {{}, {1, 0, 0, 0}}, 0};
  const double period_us = 1e6 * static_cast<double>(config.period_s);
  double next_us = now_us(Time::kPassing);
  std::uint64_t at = kPauseBegin;
  {
    Stopwatch watch(state, Time::kPassing, 1);
    for (auto _ : state) {
      next_us = std::max(next_us + period_us, now_us(Time::kPassing));
      while (now_us(Time::kPassing) < next_us) {
      }
      watch.time([&] {
        ++sample.seq;
        sample.t_ns += period_ns;
        (void)hal::guard_sample(guard, guarded, true, sample, sample.t_ns);
        const Output output = tick(session.kernel, scripted_input(script, at));
        benchmark::DoNotOptimize(hal::guard_force(guard, guarded, output.force_n));
      });
      at = at + 1 < kPauseEnd ? at + 1 : kPauseBegin;
    }
  }
  describe(state, subject, config.substeps, filter_passes(session.kernel));
}

// Denormal numbers flushed to zero in this scope: bodies that come to rest are twenty times slower
// with them. Our own step keeps out of that range by itself.
struct FlushDenormals {
#if defined(__x86_64__)
  unsigned before = _mm_getcsr();
  FlushDenormals() {
    _mm_setcsr(before | 0x8040U);
  }
  ~FlushDenormals() {
    _mm_setcsr(before);
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
#endif
};

void bench_peer(benchmark::State& state, Subject& subject, const std::string& name,
                std::function<void()> (*make)(const Organ&)) {
  [[maybe_unused]] const FlushDenormals flush;
  std::function<void()>& step = subject.peer[name];
  if (!step) {
    // Until the drag at one end is felt at the other. Before that voxels are at rest, and their SVD
    // costs only a third.
    const Organ& organ = subject.organ();
    step = make(organ);
    for (std::uint32_t i = 0; i < 0U + organ.size_x + organ.size_y + organ.size_z; ++i) step();
  }
  {
    Stopwatch watch(state, Time::kOwn, 1);
    for (auto _ : state) watch.time(step);
  }
  describe(state, subject, 1, 0);
}

// All together take minutes: on a terminal, show what is being measured.
void tell(const std::string& name) {
  static const bool terminal = isatty(STDERR_FILENO) == 1;
  static const double start_us = now_us(Time::kPassing);
  if (!terminal) return;
  std::cerr << "\r" << std::setw(5) << std::lround(1e-6 * (now_us(Time::kPassing) - start_us))
            << " s  " << std::left << std::setw(48) << name << std::right << std::flush;
}

template <typename Body>
benchmark::internal::Benchmark* add(const std::string& name, Body body) {
  const auto told = [name, body](benchmark::State& state) {
    tell(name);
    body(state);
  };
  return benchmark::RegisterBenchmark(name.c_str(), told)->Unit(benchmark::kMicrosecond);
}

void register_subject(Subject& subject) {
  for (const Variant& variant : variants_here()) {
    const std::string tail = "/" + subject.name + "/" + variant.name;
    const Config rigid = config_of(Setup::kPhysical), elastic = config_of(Setup::kElastic);
    add("threads" + tail, [&subject, variant](auto& s) {
      bench_threads(s, subject, variant);
    })->UseRealTime();
    for (const auto& [name, config] :
         {std::pair("tissue", rigid), std::pair("tissue_added", added_mass(rigid, 1))}) {
      add(name + tail, [&subject, config = config, variant](auto& s) {
        bench_tissue(s, subject, config, variant);
      });
    }
    for (const auto& [name, config] :
         {std::pair("tick", rigid), std::pair("tick_added", added_mass(rigid, 2)),
          std::pair("tick_elastic", elastic),
          std::pair("tick_elastic_added", config_of(Setup::kAddedMass))}) {
      add(name + tail, [&subject, config = config, variant](auto& s) {
        bench_tick(s, subject, config, variant);
      });
    }
  }
}

void register_peers(Subject& subject) {
  add("bullet/" + subject.name,
      [&subject](auto& s) { bench_peer(s, subject, "bullet", bullet_step); });
  add("eigen/" + subject.name,
      [&subject](auto& s) { bench_peer(s, subject, "eigen", eigen_step); });
}

void register_cadence(Subject& subject, const std::string& name, float period_s,
                      std::uint32_t substeps) {
  Config config = config_of(Setup::kPhysical);
  config.period_s = period_s;
  config.substeps = substeps;
  for (const Variant& variant : variants_here()) {
    add("cadence_" + name + "/" + subject.name + "/" + variant.name,
        [&subject, config, variant](auto& s) { bench_cadence(s, subject, config, variant); })
        ->UseRealTime()
        ->MinTime(0.5);
  }
}

bool add_file(const fs::path& path, std::vector<Subject>& subjects) {
  if (const std::string why = hal::why_unreadable(path.string()); !why.empty()) {
    std::cerr << path.string() << ": " << why << ": expected an organ file\n";
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  if (!file) {
    std::cerr << path.string() << ": cannot be read: expected an organ file\n";
    return false;
  }
  auto opened = std::make_unique<OpenOrgan>();
  opened->bytes.resize(bytes.size());
  if (!bytes.empty()) std::memcpy(opened->bytes.data(), bytes.data(), bytes.size());
  OrganRefusal refusal;
  if (organ_open(opened->bytes, opened->organ, &refusal) != Status::kOk) {
    std::cerr << path.string() << ": " << status_name(refusal.status) << ": " << refusal.place
              << "\n";
    return false;
  }
  subjects.push_back({path.stem().string(), std::move(opened), {}, {}});
  return true;
}

void add_livers(std::vector<Subject>& subjects) {
  for (const auto& [name, voxels] :
       {std::pair("liver_1k", 1000), std::pair("liver_5k", 5000), std::pair("liver_20k", 20000),
        std::pair("liver_100k", 100000)}) {
    subjects.push_back({name, liver_organ(static_cast<std::size_t>(voxels)), {}, {}});
  }
}

void register_livers(std::vector<Subject>& subjects) {
  for (Subject& subject : subjects) register_peers(subject);
  register_cadence(subjects[1], "1khz", 1e-3F, 1);
  register_cadence(subjects[1], "1khz_2substeps", 1e-3F, 2);
  register_cadence(subjects[2], "4khz", 0.25e-3F, 1);
}

// Takes `--results=FOLDER` out of the arguments.
std::string take_results_folder(int& argc, char** argv) {
  const std::string option = "--results=";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind(option, 0) != 0) continue;
    std::copy(argv + i + 1, argv + argc, argv + i);
    --argc;
    return word.substr(option.size());
  }
  return {};
}

constexpr const char* kHelp =
    "usage: stylet bench [ORGAN...] [--results=FOLDER] [--benchmark_filter=REGEX] ...\n"
    "\n"
    "Measures the tissue step and the tick with every instruction set this processor has, on the\n"
    "organ files given. Without any it takes six minutes, on liver-like lattices of 1000 to\n"
    "100 000 voxels, and also measures Bullet's soft body, the textbook's method with Eigen, and\n"
    "ticks at a real period. Ends with a table of medians and ratios; --results writes them as\n"
    "CSV, a file for each instruction set. Measure while nothing else runs.\n"
    "\n"
    "  tissue    a step of the tissue, everything physical on, needle inserted\n"
    "  tick      the whole kernel; tick_elastic: with elastic needle and breathing tissue\n"
    "  tissue_added, tick_added, tick_elastic_added\n"
    "            the same with added mass, so without the filter; a tick has two substeps\n"
    "  cadence   kernel and guard at a real period\n"
    "  threads   three measures in turn. alone: one thread. beside: two threads that have nothing\n"
    "            in common, the least time that shared can take. shared: one thread and a helper.\n"
    "            These are of the repetitions in which beside took least, alone_any and so on of\n"
    "            all. There is no figure where beside is not twice as fast as alone, since the\n"
    "            two threads then did not run at the same time\n"
    "\n"
    "stylet bench --benchmark_filter=tissue/liver_5k     one measure of one body\n"
    "stylet bench liver.organ                            how long a tick of this organ takes\n"
    "\n"
    "The other options are those of Google Benchmark:\n\n";

void print_help() {
  std::cout << kHelp << std::flush;
  benchmark::PrintDefaultHelp();
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  const std::string folder = take_results_folder(argc, argv);
  std::vector<std::string> defaults = {"--benchmark_enable_random_interleaving=true",
                                       "--benchmark_repetitions=15", "--benchmark_min_time=0.1"};
  std::vector<char*> words(argv, argv + argc);  // the user's options come later and win
  for (std::string& word : defaults) words.insert(words.begin() + 1, word.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data(), print_help);
  std::vector<Subject> subjects;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[static_cast<std::size_t>(i)];
    if (word.starts_with('-')) {
      std::cerr << word << ": no such option (stylet bench --help)\n";
      return 2;
    }
    if (!add_file(word, subjects)) return 1;
  }
  const bool livers = subjects.empty();
  if (livers) add_livers(subjects);
  for (Subject& subject : subjects) register_subject(subject);
  if (livers) register_livers(subjects);
  benchmark::AddCustomContext("processor", processor_name());
  benchmark::AddCustomContext("compiler", __VERSION__);
  Summary summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  summary.print(std::cerr);  // standard output holds the measurements alone, perhaps as JSON
  if (!folder.empty()) summary.write(folder);
  benchmark::Shutdown();
  return 0;
}
