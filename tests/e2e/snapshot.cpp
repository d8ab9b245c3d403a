// SPDX-License-Identifier: Apache-2.0
// stylet-snapshot RECORDING TICK...: the shapes behind a recording, for pictures and tests.
//
// Replays the recording up to each tick (rising) and prints one JSON object: per tick the needles
// from handle to tip, the constraint particles with place, goal and force, the energy, and the
// surface's points; once, the surface's triangles. Units: metres, newtons, joules; frame: world.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "stylet/hal/instance.h"
#include "stylet/hal/recording.h"
#include "stylet/hal/replay.h"

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
  Json out = {{"triangles", Json::array()}, {"shapes", Json::array()}};
  for (const OrganTriangle& t : organ.organ.triangles) {
    out["triangles"].push_back({t.a, t.b, t.c});
  }
  std::vector<Input> inputs(config.needle_count);
  std::vector<Output> outputs(config.needle_count);
  std::vector<hal::TickRecord> row(1);
  std::uint64_t done = 0;
  for (const std::uint64_t at : ticks) {
    for (; done < at; ++done) {
      for (std::uint32_t n = 0; n < config.needle_count; ++n) {
        recording.read(done, row, n);
        inputs[n] = row[0].input;
      }
      tick(instance.kernel, inputs, outputs);
    }
    out["shapes"].push_back(shape_of(instance.kernel, organ.organ, config, at));
  }
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
