// SPDX-License-Identifier: Apache-2.0
// Plays random scenes and prints what the hands feel, for toolchain/sensitivity.py, which plays
// them with one constant of the kernel changed.
//
// stylet-sensitivity [--first N] [--scenes N] [--deeper METRES] [--parts N]
//
// Scene i is of kind i mod 6 and has its own seed, counted from --first. For each scene there is a
// line of numbers with their names, then one with the three components of each hand's force
// averaged over 50 ms, again and again. --deeper applies to all hands, all the time. --parts
// divides each tick of 1 ms into so many, with the same substeps. The sines of a hand's way are
// those of the C library, so that bits are not the same everywhere.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "base/math.h"
#include "base/vec3d.h"
#include "drawn_scene.h"

namespace stylet::test {
namespace {

constexpr double kTickS = 1e-3, kWindowS = 0.05;
constexpr int kTicksPerBalance = 50;  // of energy, for which every voxel is read

struct Options {
  std::uint64_t first = 0, scenes = kKinds;
  double deeper_m = 0;
  std::uint32_t parts = 1;
};

struct Felt {
  std::vector<Vec3> window_n;  // of all hands in turn
  double tremble_n = 0;        // largest change of force in a millisecond of a judged rest
  double least_j = 0;          // least work of the hands less what is stored
  double most_stored_j = 0, left_j = 0;
  bool finite = true, unstable = false, held = false;
  std::uint64_t hash = 0;
};

double length(Vec3 v) {
  return norm(to_double(v));
}

// The energy of an elastic needle is left out: it is never below zero.
void balance(const Kernel& kernel, Felt& felt) {
  const Energy e = energy(kernel);
  const double stored_j = e.elastic + e.kinetic + e.coupling;
  felt.left_j = stored_j;
  felt.most_stored_j = std::max(felt.most_stored_j, stored_j);
  if (!felt.unstable) felt.least_j = std::min(felt.least_j, e.work_by_hand - stored_j);
}

struct Play {
  std::array<Vec3, kMaxNeedles> last_n{}, sum_n{};
  std::array<Output, kMaxNeedles> out{};
};

void tick_hands(const DrawnScene& scene, const Options& options, double time_s, Kernel& kernel,
                Play& play, Felt& felt) {
  std::array<Input, kMaxNeedles> inputs{};
  std::array<bool, kMaxNeedles> at_rest{};
  const std::size_t count = scene.hands.size();
  for (std::size_t i = 0; i < count; ++i) {
    const HandPlace place = hand_place(scene.hands[i], time_s, options.deeper_m);
    inputs[i] = {place.pose, 1};
    at_rest[i] = place.at_rest;
  }
  tick(kernel, std::span(inputs).first(count), std::span(play.out).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Output& out = play.out[i];
    felt.finite =
        felt.finite && (out.flags & kFlagFault) == 0 && std::isfinite(length(out.force_n));
    felt.unstable = felt.unstable || (out.flags & kFlagNeedleUnstable) != 0;
    const double change = options.parts * length(out.force_n - play.last_n[i]);
    if (at_rest[i]) felt.tremble_n = std::max(felt.tremble_n, change);
    play.last_n[i] = out.force_n;
    play.sum_n[i] = play.sum_n[i] + out.force_n;
  }
}

Felt feel(DrawnScene& scene, const Options& options) {
  scene.config.period_s = static_cast<float>(kTickS / options.parts);
  scene.config.substeps = std::max(scene.config.substeps / options.parts, 1U);
  Session session = make_session(scene.organ->organ, scene.config);
  if (set_obstacles(session.kernel, scene.obstacles) != Status::kOk) std::abort();
  Felt felt;
  Play play;
  const auto per_window =
      static_cast<int>(std::lround(kWindowS / kTickS)) * static_cast<int>(options.parts);
  const auto windows = static_cast<int>(scene.duration_s / kWindowS);
  for (int i = 0; i < windows * per_window; ++i) {
    const double time_s = (i + 1) * kTickS / options.parts;
    tick_hands(scene, options, time_s, session.kernel, play, felt);
    if (i % kTicksPerBalance == 0) balance(session.kernel, felt);
    if ((i + 1) % per_window != 0) continue;
    for (std::size_t hand = 0; hand < scene.hands.size(); ++hand) {
      felt.window_n.push_back((1 / static_cast<float>(per_window)) * play.sum_n[hand]);
      play.sum_n[hand] = {};
    }
  }
  balance(session.kernel, felt);
  felt.held = stats(session.kernel).constraint_particles.used != 0;
  felt.hash = hash(session.kernel);
  return felt;
}

void print(std::uint64_t index, const DrawnScene& scene, const Felt& felt) {
  std::printf("scene %llu kind %s hands %zu finite %d unstable %d held %d ",
              static_cast<unsigned long long>(index), kind_name(scene.kind), scene.hands.size(),
              felt.finite ? 1 : 0, felt.unstable ? 1 : 0, felt.held ? 1 : 0);
  std::printf("tremble_n %.9g least_j %.9g left_fraction %.9g hash %016llx\n", felt.tremble_n,
              felt.least_j, felt.left_j / std::max(felt.most_stored_j, 1e-12),
              static_cast<unsigned long long>(felt.hash));
  for (const Vec3& n : felt.window_n) {
    std::printf("%.9g %.9g %.9g ", static_cast<double>(n.x), static_cast<double>(n.y),
                static_cast<double>(n.z));
  }
  std::printf("\n");
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--first") options.first = std::strtoull(argv[i + 1], nullptr, 10);
    if (name == "--scenes") options.scenes = std::strtoull(argv[i + 1], nullptr, 10);
    if (name == "--deeper") options.deeper_m = std::strtod(argv[i + 1], nullptr);
    if (name == "--parts") {
      options.parts = static_cast<std::uint32_t>(std::strtoul(argv[i + 1], nullptr, 10));
    }
  }
  return options;
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  const Options options = parse(argc, argv);
  for (std::uint64_t i = options.first; i < options.first + options.scenes; ++i) {
    DrawnScene scene = draw_scene(i / kKinds, static_cast<Kind>(i % kKinds));
    print(i, scene, feel(scene, options));
  }
  return 0;
}
