// SPDX-License-Identifier: Apache-2.0
// stylet-snapshot RECORDING TICK...: the shapes behind a recording, for pictures and tests.
//
// Replays the recording up to each tick (rising) and prints one JSON object: per tick the needles
// from handle to tip, the constraint particles with place, goal and force, the energy, and the
// surface's points; once, by how much force and torque at the handles missed the sums over
// particles and contacts, in the worst tick of all on the way. Units: metres, newtons, joules;
// frame: world.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

struct Vec {
  double x = 0, y = 0, z = 0;
};
Vec wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vec minus(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
double size(const Vec& v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
void add(Vec& sum, const Vec& v) {
  sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z};
}

// Sum of what particles and contacts do to one needle, and of the sizes that went into it.
struct Wrench {
  Vec force_n, torque_nm;
  double force_size_n = 0, torque_size_nm = 0;

  void take(const Vec& handle, Vec3 place, Vec3 force) {
    const Vec f = wide(force), arm = minus(wide(place), handle);
    add(force_n, f);
    add(torque_nm,
        {arm.y * f.z - arm.z * f.y, arm.z * f.x - arm.x * f.z, arm.x * f.y - arm.y * f.x});
    force_size_n += size(f);
    torque_size_nm += size(arm) * size(f);
  }
};

// The largest miss so far, of force and of torque, as shares of what was summed.
struct WorstWrench {
  double force_share = 0, torque_share = 0;
  std::uint64_t tick = 0;  // of the larger one
};

void check_wrench(const Kernel& kernel, std::uint32_t needle, const Input& input,
                  const Output& output, WorstWrench& worst) {
  constexpr double kNoForceN = 1e-9;  // below it there is nothing to compare
  static std::vector<ConstraintParticle> particles(kMaxNeedles * (kMaxConstraintParticles + 1));
  static std::vector<ObstacleTouch> touches(kMaxNeedles * kMaxTouches);
  const Vec handle = wide(input.handle.position_m);
  Wrench sum;
  const std::uint32_t held = constraint_particles(kernel, particles);
  for (const ConstraintParticle& p : std::span(particles).first(held)) {
    if (p.needle == needle) sum.take(handle, p.position_m, p.force_on_needle_n);
  }
  const std::uint32_t touching = obstacle_touches(kernel, touches);
  for (const ObstacleTouch& t : std::span(touches).first(touching)) {
    if (t.needle == needle) sum.take(handle, t.position_m, t.force_on_needle_n);
  }
  const double force =
      size(minus(wide(output.force_n), sum.force_n)) / std::max(sum.force_size_n, kNoForceN);
  const double torque =
      size(minus(wide(output.torque_nm), sum.torque_nm)) / std::max(sum.torque_size_nm, kNoForceN);
  if (std::max(force, torque) > std::max(worst.force_share, worst.torque_share)) {
    worst.tick = output.tick;
  }
  worst.force_share = std::max(worst.force_share, force);
  worst.torque_share = std::max(worst.torque_share, torque);
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
  WorstWrench worst;
  for (const std::uint64_t at : ticks) {
    for (; done < at; ++done) {
      for (std::uint32_t n = 0; n < config.needle_count; ++n) {
        recording.read(done, row, n);
        inputs[n] = row[0].input;
      }
      tick(instance.kernel, inputs, outputs);
      for (std::uint32_t n = 0; n < config.needle_count; ++n) {
        check_wrench(instance.kernel, n, inputs[n], outputs[n], worst);
      }
    }
    out["shapes"].push_back(shape_of(instance.kernel, organ.organ, config, at));
  }
  out["wrench"] = {{"force_share", worst.force_share},
                   {"torque_share", worst.torque_share},
                   {"tick", worst.tick},
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
