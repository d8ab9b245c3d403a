// SPDX-License-Identifier: GPL-3.0-or-later
#include "speed.h"

#include <cstring>
#include <ctime>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include "build.h"
#include "file.h"
#include "info.h"
#include "refusal.h"
#include "stylet/kernel.h"
#include "stylet/resonance.h"
#include "sweep.h"

namespace stylet::bake {
namespace {

using Json = nlohmann::ordered_json;

struct CostPoint {
  double voxel_substeps, us;
};

// Least squares of the relative error, so that small organs count as much as large ones.
Machine fitted(const std::string& name, const std::vector<CostPoint>& points) {
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
  for (const CostPoint& p : points) {
    const double weight = 1 / (p.us * p.us);
    w += weight;
    wx += weight * p.voxel_substeps;
    wy += weight * p.us;
    wxx += weight * p.voxel_substeps * p.voxel_substeps;
    wxy += weight * p.voxel_substeps * p.us;
  }
  const double slope = (w * wxy - wx * wy) / (w * wxx - wx * wx);
  return {name, (wy - slope * wx) / w, slope};
}

// ---- a kernel with memory of its own ------------------------------------------------------------

class OwnKernel {
 public:
  OwnKernel(const Organ& organ, const Config& config) {
    Sizes bytes{};
    (void)sizes(organ, config, bytes);  // what it refuses, create refuses
    const auto block = [&](std::size_t size) {
      blocks_.push_back(std::vector<std::byte>(size + kBlockAlignment));
      void* start = blocks_.back().data();
      std::size_t room = blocks_.back().size();
      std::align(kBlockAlignment, size, start, room);
      return std::span(static_cast<std::byte*>(start), size);
    };
    const Memory memory = {block(bytes.model_bytes), block(bytes.state_bytes),
                           block(bytes.scratch_bytes)};
    if (create(organ, config, memory, kernel_) != Status::kOk) {
      refuse("the kernel does not take this organ");
    }
  }
  Kernel& get() { return kernel_; }

 private:
  std::vector<std::vector<std::byte>> blocks_;
  Kernel kernel_;
};

// ---- measuring ----------------------------------------------------------------------------------

constexpr double kBlockEdgeM = 5e-3;

std::vector<std::byte> gel_block(const std::array<int, 3>& voxels) {
  Input input;
  input.path = "block";
  input.tissue = "gel";
  input.metres_per_unit = kBlockEdgeM;
  for (unsigned i = 0; i < 8; ++i) {
    input.read.mesh.points.push_back({(i & 1U) != 0 ? 1.0 * voxels[0] : 0,
                                      (i & 2U) != 0 ? 1.0 * voxels[1] : 0,
                                      (i & 4U) != 0 ? 1.0 * voxels[2] : 0});
  }
  input.read.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  BuildOptions options;
  options.voxel_edge_m = kBlockEdgeM;
  options.held = parse_regions({"z<10%"}, 1);
  return build({input}, options, [](const char*, double) {}).bytes;
}

// Near the middle of the voxels in x and y: not on a face between them.
Vec3 near_middle(const Organ& organ) {
  double x = 0, y = 0;
  for (const OrganRun& run : organ.runs) {
    x += run.count * (run.x + 0.5 * run.count);
    y += run.count * (run.y % organ.sheet_rows + 0.5);
  }
  const auto at = [&](double sum) { return static_cast<float>(sum / organ.voxel_count + 0.3); };
  const float edge_m = organ.voxel_edge_m;
  return {organ.origin_m.x + at(x) * edge_m, organ.origin_m.y + at(y) * edge_m,
          organ.origin_m.z + static_cast<float>(organ.size_z + 1) * edge_m};
}

CostPoint time_block(const std::array<int, 3>& voxels) {
  const std::vector<std::byte> bytes = gel_block(voxels);
  const Organ organ = open_organ("block", bytes);
  const Config config;
  return {swept_voxels(organ) * config.substeps,
          time_tick(organ, static_cast<double>(config.period_s), config.substeps).value()};
}

Json material_masses(const Organ& organ, double period_s, std::uint32_t substeps,
                     Inertia inertia) {
  Config config;
  config.inertia = inertia;
  config.period_s = static_cast<float>(period_s);
  config.substeps = substeps;
  OwnKernel kernel(organ, config);
  Json masses = Json::object();
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    const MassReport mass = mass_report(kernel.get(), i);
    if (mass.real_kg > 0) {
      masses[organ_material(organ, i).name] =
          static_cast<double>(mass.stepped_kg) / static_cast<double>(mass.real_kg);
    }
  }
  return masses;
}

// The first resonance, and from which frequency on a moving hand feels the step's inertia.
Json resonance_facts(const Organ& organ, double period_s, std::uint32_t substeps, Inertia inertia) {
  Config config;
  config.inertia = inertia;
  config.period_s = static_cast<float>(period_s);
  config.substeps = substeps;
  OwnKernel kernel(organ, config);
  const Resonance of = first_resonance(kernel.get());
  Json facts = {{"real_hz", of.real_hz}, {"stepped_hz", of.stepped_hz}};
  if (of.departs_hz < kFastestHandHz) facts["departs_hz"] = of.departs_hz;  // else none feels it
  return facts;
}

// Time that this thread was given: what else the machine does must not make an organ coarser.
double own_time_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

}  // namespace

Machine read_machine(const std::filesystem::path& bench_csv) {
  const std::string file = bench_csv.string();
  std::istringstream lines(read_file(bench_csv));
  std::vector<CostPoint> points;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.starts_with("tick_elastic,")) continue;
    char organ[64] = {};
    double voxels = 0, us = 0, ns = 0;
    if (std::sscanf(line.c_str(), "tick_elastic,%63[^,],%lf,%lf,%lf", organ, &voxels, &us, &ns) !=
            4 ||
        !(voxels >= 1 && us > 0 && ns > 0)) {
      refuse("{}:{}: expected measure,organ,voxels,median_us,ns_per_voxel_substep", file, number);
    }
    points.push_back({us * 1e3 / ns, us});
  }
  if (points.size() < 2) {
    refuse("{}: {} lines of tick_elastic: expected two at least, as stylet-bench writes them", file,
           points.size());
  }
  return fitted(bench_csv.stem().string(), points);
}

std::optional<double> time_tick(const Organ& organ, double period_s, std::uint32_t substeps) {
  constexpr int kInsertion = 500, kMeasured = 200;
  constexpr float kStepM = 1e-4F;
  constexpr float kSteel18GNm2 = 0.02F;
  const Vec3 above = near_middle(organ);
  float distance_m = 0;
  if (!organ_raycast(organ, above, {0, 0, -1}, distance_m)) return std::nullopt;
  Config config;
  config.period_s = static_cast<float>(period_s);
  config.substeps = substeps;
  config.needle[0].bending_nm2 = kSteel18GNm2;
  OwnKernel kernel(organ, config);
  stylet::Input hand = {};
  hand.valid = 1;
  hand.handle.rotation = {1, 0, 0, 0};
  hand.handle.position_m = {above.x, above.y,
                            above.z - distance_m + config.needle[0].length_m + 0.01F};
  std::vector<double> us;
  for (int i = 0; i < kInsertion + kMeasured; ++i) {
    if (i < kInsertion) hand.handle.position_m.z -= kStepM;
    const double start_us = own_time_us();
    (void)tick(kernel.get(), hand);
    if (i >= kInsertion) us.push_back(own_time_us() - start_us);
  }
  std::nth_element(us.begin(), us.begin() + kMeasured / 2, us.end());
  return us[kMeasured / 2];
}

Machine measure_machine(const Progress& progress) {
  progress("timing the kernel", 0);
  const CostPoint small = time_block({12, 12, 14});
  progress("timing the kernel", 0.3);
  const CostPoint large = time_block({26, 26, 30});
  Machine here = fitted("this machine", {small, large});
  here.is_here = true;
  return here;
}

double tick_us(const Machine& machine, double voxels, std::uint32_t substeps) {
  return machine.start_us + machine.us_per_voxel_substep * voxels * substeps;
}

std::uint32_t most_voxels(const Machine& machine, double period_s, std::uint32_t substeps) {
  const double room_us = period_s * 1e6 * kShareOfPeriod - machine.start_us;
  const double voxels = room_us / (machine.us_per_voxel_substep * substeps);
  constexpr double kLeast = 8;
  if (!(voxels >= kLeast)) {
    refuse("--fit: a tick of {:.0f} us has room for {:.0f} voxels on {}: expected a lower rate",
           period_s * 1e6, std::max(0.0, voxels), machine.name);
  }
  return static_cast<std::uint32_t>(std::min(voxels, double{kMaxVoxels}));
}

double period_of(const std::string& rate) {
  double hertz = 0;
  char unit[8] = {};
  const int fields = std::sscanf(rate.c_str(), "%lf %7s", &hertz, unit);
  const bool kilo = std::strcmp(unit, "kHz") == 0;
  hertz *= kilo ? 1e3 : 1;
  const auto limit = [](float seconds) { return std::round(1 / static_cast<double>(seconds)); };
  if (fields != 2 || (!kilo && std::strcmp(unit, "Hz") != 0) ||
      !(hertz >= limit(kMaxPeriodS) && hertz <= limit(kMinPeriodS))) {
    refuse("--fit '{}': expected a rate from {} Hz to {} kHz, such as 1kHz", rate,
           limit(kMaxPeriodS), limit(kMinPeriodS) / 1e3);
  }
  return 1 / hertz;
}

nlohmann::ordered_json speed_facts(const Organ& organ, double period_s, std::uint32_t substeps,
                                   const Machine* machine) {
  Json rows = Json::array();
  const double voxels = swept_voxels(organ);
  for (const std::uint32_t each : {1U, 2U, 4U, 8U, 16U}) {
    Json row = {{"substeps", each},
                {"mass_factor", material_masses(organ, period_s, each, Inertia::kAddedMass)}};
    if (machine != nullptr) row["tick_us"] = tick_us(*machine, voxels, each);
    rows.push_back(row);
  }
  Json facts = {{"period_us", period_s * 1e6}, {"substeps", substeps}, {"by_substeps", rows}};
  facts["true_mass_factor"] = material_masses(organ, period_s, substeps, Inertia::kTrueMass);
  facts["resonance"] = resonance_facts(organ, period_s, substeps, Inertia::kAddedMass);
  facts["true_mass_resonance"] = resonance_facts(organ, period_s, substeps, Inertia::kTrueMass);
  if (machine != nullptr) {
    facts["machine"] = {{"name", machine->name},
                        {"start_us", machine->start_us},
                        {"ns_per_voxel_substep", machine->us_per_voxel_substep * 1e3}};
    facts["share_of_period"] = kShareOfPeriod;
    facts["swept_voxels"] = voxels;
    facts["tick_us"] = tick_us(*machine, voxels, substeps);
    const std::optional<double> timed =
        machine->is_here ? time_tick(organ, period_s, substeps) : std::nullopt;
    if (timed) facts["timed_us"] = *timed;
  }
  return facts;
}

namespace {

std::string inertia_text(const Json& of, const char* mass) {
  if (!(of["real_hz"].get<double>() > 0)) return "";
  return fmt::format("inertia       {}: first resonance {:.3g} Hz, really {:.3g}; {}\n", mass,
                     of["stepped_hz"].get<double>(), of["real_hz"].get<double>(),
                     of.contains("departs_hz")
                         ? fmt::format("the force on a hand may be a tenth off from {:.2g} Hz on",
                                       of["departs_hz"].get<double>())
                         : "no hand feels the difference");
}

}  // namespace

std::string speed_text(const nlohmann::ordered_json& facts) {
  std::string text;
  if (facts.contains("machine")) {
    text += fmt::format(
        "tick          {:.0f} us of {:.0f} on {}, {} substeps{}\n", facts["tick_us"].get<double>(),
        facts["period_us"].get<double>(), facts["machine"]["name"].get<std::string>(),
        facts["substeps"].get<std::uint32_t>(),
        facts.contains("timed_us")
            ? fmt::format("; timed on this organ {:.0f} us", facts["timed_us"].get<double>())
            : "");
  }
  const auto factors = [](const Json& masses) {
    std::string all;
    for (const auto& [name, factor] : masses.items()) {
      all += fmt::format("  {} x{:.3g}", name, factor.get<double>());
    }
    return all;
  };
  for (const Json& row : facts["by_substeps"]) {
    text += fmt::format(
        "mass          {:>2} substeps{}{}\n", row["substeps"].get<std::uint32_t>(),
        row.contains("tick_us") ? fmt::format(", {:.0f} us", row["tick_us"].get<double>()) : "",
        factors(row["mass_factor"]));
  }
  text += fmt::format("mass          {:>2} substeps of true mass{}\n",
                      facts["substeps"].get<std::uint32_t>(), factors(facts["true_mass_factor"]));
  return text + inertia_text(facts["resonance"], "added mass") +
         inertia_text(facts["true_mass_resonance"], "true mass");
}

}  // namespace stylet::bake
