// SPDX-License-Identifier: Apache-2.0
// stylet-snapshot RECORDING TICK...: the shapes behind a recording, for pictures and tests.
//
// Replays the recording up to each tick (rising) and prints one JSON object: per tick the needles
// from handle to tip, the constraint particles with place, goal and force, the energy, and the
// surface's points; once, what was checked in every tick on the way.
// Units: metres, newtons, joules; frame: world.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/loop/instance.h"
#include "hal/record/organ_file.h"
#include "hal/record/recording.h"
#include "hal/record/replay.h"
#include "promises.h"

namespace stylet::test {
namespace {

using Json = nlohmann::json;

Json json_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

Json needles_of(const Kernel& kernel, std::uint32_t count) {
  Json needles = Json::array();
  for (std::uint32_t n = 0; n < count; ++n) {
    std::vector<Vec3> places(kMaxRods + 1);
    places.resize(needle_shape(kernel, n, places));
    Json line = Json::array();
    for (const Vec3& place : places) line.push_back(json_of(place));
    needles.push_back(line);
  }
  return needles;
}

Json particles_of(const Kernel& kernel) {
  std::vector<ConstraintParticle> particles(kMaxNeedles * (kMaxConstraintParticles + 1));
  particles.resize(constraint_particles(kernel, particles));
  Json list = Json::array();
  for (const ConstraintParticle& p : particles) {
    list.push_back({{"position_m", json_of(p.position_m)},
                    {"goal_m", json_of(p.goal_m)},
                    {"force_n", json_of(p.force_on_needle_n)},
                    {"is_tip", p.is_tip != 0},
                    {"needle", p.needle}});
  }
  return list;
}

Json shape_of(const Kernel& kernel, const Organ& organ, const Config& config, std::uint64_t at) {
  std::vector<Vec3> points(organ.vertices.size());
  points.resize(surface(kernel, points));
  Json places = Json::array();
  for (const Vec3& point : points) places.push_back(json_of(point));
  const Energy energies = energy(kernel);
  return {{"tick", at},
          {"needles", needles_of(kernel, config.needle_count)},
          {"particles", particles_of(kernel)},
          {"coupling_energy_j", energies.coupling},
          {"elastic_energy_j", energies.elastic},
          {"dissipated_j", energies.friction + energies.cutting + energies.relaxation},
          {"surface_m", places}};
}

// What was seen in all ticks: the largest difference between force and torque at a handle and the
// sums they should be, as a fraction of what was summed (for a torque, times the needle's length);
// and the first broken promise.
struct Checks {
  double force_fraction = 0, torque_fraction = 0;
  std::string broken;
};

void check(const Kernel& kernel, const Config& config, std::span<const Output> outputs,
           Checks& checks) {
  constexpr double kNoForceN = 1e-9;  // below it there is nothing to compare
  for (std::uint32_t n = 0; n < outputs.size(); ++n) {
    const Wrench sum = wrench_on(kernel, n);
    const double size_n = std::max(sum.force.magnitude, kNoForceN);
    const double size_nm = size_n * static_cast<double>(config.needle[n].length_m);
    const double force = sum.force.distance(outputs[n].force_n) / size_n;
    const double torque = sum.torque.distance(outputs[n].torque_nm) / size_nm;
    checks.force_fraction = std::max(checks.force_fraction, force);
    checks.torque_fraction = std::max(checks.torque_fraction, torque);
  }
  const char* broken = broken_promise(kernel, outputs);
  if (broken == nullptr || !checks.broken.empty()) return;
  checks.broken = fmt::format("tick {}: {}", outputs[0].tick, broken);
}

void run(const std::string& path, std::vector<std::uint64_t> ticks) {
  const hal::RecordingReader recording(path);
  const hal::OrganFile organ =
      hal::load_organ(hal::find_recorded_organ(path, recording.info(), ""));
  const Config& config = recording.info().config;
  hal::KernelInstance instance(organ.organ, config, recording.info().obstacles);
  std::sort(ticks.begin(), ticks.end());
  if (ticks.empty() || ticks.back() > recording.ticks()) {
    throw std::runtime_error(fmt::format("{}: expected ticks up to {}", path, recording.ticks()));
  }
  Json out = {{"shapes", Json::array()}};
  std::vector<Input> inputs(config.needle_count);
  std::vector<Output> outputs(config.needle_count);
  std::vector<hal::TickRecord> row(1);
  std::uint64_t done = 0;
  Checks checks;
  for (const std::uint64_t at : ticks) {
    for (; done < at; ++done) {
      for (std::uint32_t n = 0; n < config.needle_count; ++n) {
        recording.read(done, row, n);
        inputs[n] = row[0].input;
      }
      tick(instance.kernel, inputs, outputs);
      check(instance.kernel, config, outputs, checks);
    }
    out["shapes"].push_back(shape_of(instance.kernel, organ.organ, config, at));
  }
  out["checks"] = {{"force_fraction", checks.force_fraction},
                   {"torque_fraction", checks.torque_fraction},
                   {"broken", checks.broken},
                   {"ticks", done}};
  fmt::print("{}\n", out.dump());
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: stylet-snapshot RECORDING TICK...\n");
    return 2;
  }
  try {
    std::vector<std::uint64_t> ticks;
    for (int i = 2; i < argc; ++i) ticks.push_back(std::stoull(argv[i]));
    stylet::test::run(argv[1], ticks);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stylet-snapshot: {}\n", error.what());
    return 1;
  }
  return 0;
}
