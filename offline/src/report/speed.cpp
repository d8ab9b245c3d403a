// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/speed.h"

#include <Eigen/Dense>
#include <cstring>
#include <ctime>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include "asset/organ_shape.h"
#include "base/file.h"
#include "base/refusal.h"
#include "pipeline/build.h"
#include "report/info.h"
#include "stylet/limits.h"
#include "stylet/resonance.h"
#include "voxels/sweep.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

struct CostPoint {
  double voxel_substeps, passes, us;
};

// Least squares of relative errors, so that small organs count as much as large ones.
Machine fitted(const std::string& name, const std::vector<CostPoint>& points) {
  Eigen::MatrixXd of(points.size(), 3);
  for (Eigen::Index i = 0; i < of.rows(); ++i) {
    const CostPoint& p = points[static_cast<std::size_t>(i)];
    of.row(i) << 1 / p.us, p.voxel_substeps / p.us, p.voxel_substeps * p.passes / p.us;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factored(of);
  if (factored.rank() < 3) {
    refuse(
        "{}: expected rows of tick_elastic for at least two organs, with added and with true mass",
        name);
  }
  const Eigen::Vector3d line = factored.solve(Eigen::VectorXd::Ones(of.rows()));
  return {name, line[0], line[1], line[2]};
}

// ---- a kernel with memory of its own ------------------------------------------------------------

class OwnKernel {
 public:
  OwnKernel(const Organ& organ, const Config& config) {
    Sizes bytes{};
    (void)sizes(organ, config, bytes);  // create refuses whatever sizes refuses
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
  options.held = parse_regions({"z<10%"}, {});
  return build({input}, options, [](const char*, double) {}).bytes;
}

// A place near the middle of the voxels in x and y, but not on a face between voxels.
Vec3 near_middle(const Organ& organ) {
  double x = 0, y = 0;
  for (const Cell& cell : cells_of(organ)) {
    x += cell[0] + 0.5 * cell.size;
    y += cell[1] + 0.5 * cell.size;
  }
  const auto at = [&](double sum) { return static_cast<float>(sum / organ.voxel_count + 0.3); };
  const auto edge_m = static_cast<float>(cell_edge_m(organ));
  return {organ.origin_m.x + at(x) * edge_m, organ.origin_m.y + at(y) * edge_m,
          organ.origin_m.z + static_cast<float>(size_in_space(organ)[2] + 1) * edge_m};
}

Config config_of(const Stepping& stepping) {
  Config config;
  config.inertia = stepping.inertia;
  config.period_s = static_cast<float>(stepping.period_s);
  config.substeps = stepping.substeps;
  return config;
}

// Uses true mass and the longest period, with which the stiffest gel needs all passes; the cost of
// a pass does not depend on this.
void time_block(const std::array<int, 3>& voxels, std::vector<CostPoint>& points) {
  const std::vector<std::byte> bytes = gel_block(voxels);
  const Organ organ = open_organ("block", bytes);
  for (const Inertia inertia : {Inertia::kAddedMass, Inertia::kTrueMass}) {
    const Stepping stepping = {static_cast<double>(kMaxPeriodS), 1, inertia};
    points.push_back({swept_voxels(organ), static_cast<double>(passes_of(organ, stepping)),
                      time_tick(organ, stepping).value()});
  }
}

Json material_masses(const Organ& organ, const Kernel& kernel) {
  Json masses = Json::object();
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    const MassReport mass = mass_report(kernel, i);
    if (mass.real_kg > 0) {
      masses[organ_material(organ, i).name] =
          static_cast<double>(mass.stepped_kg) / static_cast<double>(mass.real_kg);
    }
  }
  return masses;
}

Json stepped_facts(const Organ& organ, const Stepping& stepping, const Machine* machine) {
  OwnKernel kernel(organ, config_of(stepping));
  const std::uint32_t passes = filter_passes(kernel.get());
  Json facts = {{"passes", passes}, {"mass_factor", material_masses(organ, kernel.get())}};
  if (machine != nullptr) {
    facts["tick_us"] = tick_us(*machine, swept_voxels(organ), stepping.substeps, passes);
  }
  return facts;
}

// The first resonance, and from which frequency on a moving hand feels the step's inertia.
Json resonance_facts(const Organ& organ, const Stepping& stepping) {
  OwnKernel kernel(organ, config_of(stepping));
  const Resonance of = first_resonance(kernel.get());
  Json facts = {{"real_hz", of.real_hz}, {"stepped_hz", of.stepped_hz}};
  if (of.departs_hz < kFastestHandHz) facts["departs_hz"] = of.departs_hz;  // else no hand feels it
  return facts;
}

// Processor time of this thread: other work of the machine must not make an organ coarser.
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
    if (!line.starts_with("tick_elastic,") && !line.starts_with("tick_elastic_added,")) continue;
    double voxels = 0, substeps = 0, passes = 0, us = 0;
    if (std::sscanf(line.c_str(), "%*[^,],%*[^,],%lf,%lf,%lf,%lf,%*f", &voxels, &substeps, &passes,
                    &us) != 4 ||
        !(voxels >= 1 && substeps >= 1 && passes >= 0 && us > 0)) {
      refuse("{}:{}: expected measure,organ,voxels,substeps,passes,median_us,ns_per_voxel_substep",
             file, number);
    }
    points.push_back({voxels * substeps, passes, us});
  }
  if (points.size() < 3) {
    refuse("{}: {} rows of tick_elastic: expected at least three, as stylet-bench writes them",
           file, points.size());
  }
  return fitted(bench_csv.stem().string(), points);
}

std::optional<double> time_tick(const Organ& organ, const Stepping& stepping) {
  constexpr int kInsertion = 500, kMeasured = 200;
  constexpr float kStepM = 1e-4F;
  constexpr float kSteel18GNm2 = 0.02F;
  const Vec3 above = near_middle(organ);
  float distance_m = 0;
  if (!organ_raycast(organ, above, {0, 0, -1}, distance_m)) return std::nullopt;
  Config config = config_of(stepping);
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
  std::vector<CostPoint> points;
  progress("timing the kernel", 0);
  time_block({12, 12, 14}, points);
  progress("timing the kernel", 0.3);
  time_block({26, 26, 30}, points);
  Machine here = fitted("this machine", points);
  here.is_here = true;
  return here;
}

std::uint32_t passes_of(const Organ& organ, const Stepping& stepping) {
  return filter_passes(OwnKernel(organ, config_of(stepping)).get());
}

double tick_us(const Machine& machine, double voxels, std::uint32_t substeps,
               std::uint32_t passes) {
  return machine.start_us +
         (machine.us_per_voxel_substep + machine.us_per_voxel_pass * passes) * voxels * substeps;
}

std::uint32_t most_voxels(const Machine& machine, const Stepping& stepping) {
  const std::uint32_t passes = stepping.inertia == Inertia::kTrueMass ? kMaxFilterPasses : 0;
  const double room_us = stepping.period_s * 1e6 * kShareOfPeriod - machine.start_us;
  const double voxels =
      room_us / (tick_us(machine, 1, stepping.substeps, passes) - machine.start_us);
  constexpr double kLeast = 8;
  if (!(voxels >= kLeast)) {
    refuse("--fit: a tick of {:.0f} us has room for {:.0f} voxels on {}: expected a lower rate",
           stepping.period_s * 1e6, std::max(0.0, voxels), machine.name);
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

nlohmann::ordered_json inertia_facts(const Organ& organ, const Stepping& stepping) {
  return {{"period_us", stepping.period_s * 1e6},
          {"substeps", stepping.substeps},
          {"inertia", stepping.inertia == Inertia::kTrueMass ? "true_mass" : "added_mass"},
          {"resonance", resonance_facts(organ, stepping)}};
}

nlohmann::ordered_json speed_facts(const Organ& organ, const Stepping& stepping,
                                   const Machine* machine) {
  Json rows = Json::array();
  for (const std::uint32_t each : {1U, 2U, 4U, 8U, 16U}) {
    Json row = {{"substeps", each}};
    for (const Inertia inertia : {Inertia::kTrueMass, Inertia::kAddedMass}) {
      row[inertia == Inertia::kTrueMass ? "true_mass" : "added_mass"] =
          stepped_facts(organ, {stepping.period_s, each, inertia}, machine);
    }
    rows.push_back(row);
  }
  const Json own = stepped_facts(organ, stepping, machine);
  Json facts = inertia_facts(organ, stepping);
  facts["passes"] = own["passes"];
  facts["by_substeps"] = rows;
  if (machine != nullptr) {
    facts["machine"] = {{"name", machine->name},
                        {"start_us", machine->start_us},
                        {"ns_per_voxel_substep", machine->us_per_voxel_substep * 1e3},
                        {"ns_per_voxel_pass", machine->us_per_voxel_pass * 1e3}};
    facts["share_of_period"] = kShareOfPeriod;
    facts["swept_voxels"] = swept_voxels(organ);
    facts["tick_us"] = own["tick_us"];
    const std::optional<double> timed =
        machine->is_here ? time_tick(organ, stepping) : std::nullopt;
    if (timed) facts["timed_us"] = *timed;
  }
  return facts;
}

std::string stepping_text(const nlohmann::ordered_json& facts) {
  const auto substeps = facts["substeps"].get<std::uint32_t>();
  return fmt::format("{} substep{} of {} mass", substeps, substeps == 1 ? "" : "s",
                     facts["inertia"] == "true_mass" ? "true" : "added");
}

std::string inertia_text(const nlohmann::ordered_json& facts) {
  const Json& of = facts["resonance"];
  if (!(of["real_hz"].get<double>() > 0)) return "";
  return fmt::format(
      "inertia       {}: first resonance {:.3g} Hz, that of the real mass {:.3g} Hz; {}\n",
      stepping_text(facts), of["stepped_hz"].get<double>(), of["real_hz"].get<double>(),
      of.contains("departs_hz")
          ? fmt::format("above {:.2g} Hz the force on a moving hand may be off by a tenth",
                        of["departs_hz"].get<double>())
          : "no hand feels the difference");
}

std::string speed_text(const nlohmann::ordered_json& facts) {
  std::string text;
  if (facts.contains("machine")) {
    text += fmt::format("tick          {:.0f} us of {:.0f} on {}, {}{}\n",
                        facts["tick_us"].get<double>(), facts["period_us"].get<double>(),
                        facts["machine"]["name"].get<std::string>(), stepping_text(facts),
                        facts.contains("timed_us") ? fmt::format("; timed on this organ {:.0f} us",
                                                                 facts["timed_us"].get<double>())
                                                   : "");
  }
  for (const auto& [inertia, name] :
       {std::pair("true_mass", "true mass"), std::pair("added_mass", "added mass")}) {
    for (const Json& row : facts["by_substeps"]) {
      const Json& of = row[inertia];
      text += fmt::format("{:<13} {:>2} substeps", name, row["substeps"].get<std::uint32_t>());
      if (of["passes"] > 0) text += fmt::format(", {} passes", of["passes"].get<std::uint32_t>());
      if (of.contains("tick_us")) text += fmt::format(", {:.0f} us", of["tick_us"].get<double>());
      for (const auto& [material, factor] : of["mass_factor"].items()) {
        text += fmt::format("  {} x{:.3g}", material, factor.get<double>());
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace stylet::offline
