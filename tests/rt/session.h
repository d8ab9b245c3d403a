// SPDX-License-Identifier: Apache-2.0
// A small organ, a kernel in memory of its own, and a scripted hand: what the real-time tests and
// benchmarks run.
//
// Promises: the script is a function of the tick alone and uses only + - * / on floats, so it is
// the same for every compiler; `run` neither allocates nor calls the system.
// Units: SI. Frame: world; the needle comes from +z.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <ostream>
#include <span>
#include <utility>
#include <vector>

#include "stylet/kernel.h"
#include "tiny_organ.h"

namespace stylet::test {

// Memory at an address that is a multiple of kBlockAlignment.
struct Block {
  struct Free {
    void operator()(std::byte* owned) const {
      ::operator delete (owned, std::align_val_t{kBlockAlignment});
    }
  };
  std::unique_ptr<std::byte, Free> bytes;
  std::size_t size = 0;

  std::span<std::byte> span() const { return {bytes.get(), size}; }
};

inline Block make_block(std::size_t size, std::byte fill = std::byte{0}) {
  Block block;
  block.bytes.reset(
      static_cast<std::byte*>(::operator new (size, std::align_val_t{kBlockAlignment})));
  block.size = size;
  std::fill_n(block.bytes.get(), size, fill);
  return block;
}

// An opened organ with the bytes to which it refers.
struct OpenOrgan {
  std::vector<std::byte> bytes;
  Organ organ;
};

inline std::unique_ptr<OpenOrgan> open_organ(std::vector<std::byte> bytes) {
  auto opened = std::make_unique<OpenOrgan>();
  opened->bytes = std::move(bytes);
  if (organ_open(opened->bytes, opened->organ) != Status::kOk) std::abort();
  return opened;
}

// What a block may have besides: tissue inside that stiffens with its strain; a membrane across the
// way of the needle of block_script, 10 mm below the top.
struct BlockTissue {
  float strain_stiffening = 0;
  bool membrane = false;
};

inline void add_membrane(TinyOrgan& tiny) {
  TinyMaterial membrane;
  membrane.name = "membrane";
  membrane.puncture_force_n = 0.3F;
  membrane.membrane_n_per_m = 300;
  const Vec3 size_m = {tiny.voxel_edge_m * tiny.nx, tiny.voxel_edge_m * tiny.ny,
                       tiny.voxel_edge_m * tiny.nz - 0.01F};
  const Vec3 a = {0, 0, size_m.z - 4e-3F}, b = {size_m.x, 0, size_m.z};
  const Vec3 c = {size_m.x, size_m.y, size_m.z + 4e-3F}, d = {0, size_m.y, size_m.z};
  tiny.membranes = {
      {static_cast<std::uint16_t>(tiny.materials.size()), {{a, b, d}, {b, c, d}}, 1.0F}};
  tiny.materials.push_back(membrane);
}

// A block of voxels of 5 mm that hangs on its low z face, with a stiffer layer of one voxel on top.
// What is inside holds fluid for needles with a syringe.
inline std::unique_ptr<OpenOrgan> block_organ(std::uint16_t nx, std::uint16_t ny, std::uint16_t nz,
                                              BlockTissue has = {}) {
  TinyOrgan tiny;
  tiny.nx = nx;
  tiny.ny = ny;
  tiny.nz = nz;
  tiny.fixed_faces = kLowZ;
  TinyMaterial capsule;
  capsule.name = "capsule";
  capsule.youngs_modulus_pa = 200000;
  capsule.puncture_force_n = 0.2F;
  capsule.relaxing_fraction = 0.3F;
  TinyMaterial inside;
  inside.relaxing_fraction = 0.3F;
  inside.viscous_friction_n_s_per_m2 = 50;
  inside.strain_stiffening = has.strain_stiffening;
  inside.fluid_pressure_pa = 1500;
  inside.fluid_conductance_m3_per_pa_s = 1e-9F;
  tiny.materials = {inside, capsule};
  tiny.material_at = [nz](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return static_cast<std::uint8_t>(z + 1 == nz ? 1 : 0);
  };
  if (has.membrane) add_membrane(tiny);
  return open_organ(tiny_organ(tiny));
}

// The setup "stiffening", in an organ of its own: tissue stiffens and sinks under its weight, a
// membrane lies in it, and the needle has a syringe. As fat's, PHYSICS 2.7: twofold in a shear of
// 0.2.
constexpr BlockTissue kStiffening = {40, true};
inline Config stiffening_config() {
  Config config;
  config.gravity_m_per_s2 = {2, -3, -7};
  config.needle[0].hub = Hub::kSyringe;
  config.needle[0].opening_m = 1e-3F;
  return config;
}

struct Session {
  Block model, state, scratch;
  Kernel kernel;
};

inline Session make_session(const Organ& organ, const Config& config) {
  Sizes bytes{};
  if (sizes(organ, config, bytes) != Status::kOk) std::abort();
  Session session{make_block(bytes.model_bytes),
                  make_block(bytes.state_bytes),
                  make_block(bytes.scratch_bytes),
                  {}};
  const Memory memory{session.model.span(), session.state.span(), session.scratch.span()};
  if (create(organ, config, memory, session.kernel) != Status::kOk) std::abort();
  return session;
}

// The hand goes again and again from 12 mm above the surface 27 mm into the tissue at 26 mm/s,
// pauses, is pulled sideways at the end of the pause, and goes out; each time at another place,
// tilted a little. A syringe is pressed on the way in and drawn on the way out. Now and then a
// sample is missing or not a number.
constexpr std::uint64_t kCycleTicks = 4000;
constexpr std::uint64_t kPauseBegin = 1500, kPauseEnd = 2500;  // needle at its deepest

struct Script {
  Vec3 entry_m;  // on the surface, the tissue below
  float needle_length_m;
};

// Middle of the top of a block.
inline Script block_script(const Organ& organ, const Config& config) {
  const float edge_m = organ.voxel_edge_m;
  return {{organ.origin_m.x + 0.5F * static_cast<float>(organ.size_x) * edge_m,
           organ.origin_m.y + 0.5F * static_cast<float>(organ.sheet_rows) * edge_m,
           organ.origin_m.z + static_cast<float>(organ.size_z) * edge_m},
          config.needle[0].length_m};
}

inline Input scripted_input(const Script& script, std::uint64_t tick) {
  constexpr float kStepM = 26e-6F, kPullM = 4e-6F;
  const std::uint64_t cycle = tick / kCycleTicks, at = tick % kCycleTicks;
  const auto steps = [](std::uint64_t count) { return static_cast<float>(count); };
  float depth_m = -0.012F;
  float pull_m = 0;
  if (at < kPauseBegin) {
    depth_m += kStepM * steps(at);
  } else if (at < kPauseEnd) {
    depth_m += kStepM * steps(kPauseBegin);
    pull_m = at > 2000 ? kPullM * steps(at - 2000) : 0;
  } else {
    depth_m += kStepM * steps(kCycleTicks - at);
    pull_m = kPullM * steps(kCycleTicks - at) / 3;
  }
  const float tilt = 0.02F * (steps(cycle % 7) - 3);  // half the angle, small
  Input input{};
  input.handle.rotation = {1 - 0.5F * tilt * tilt, tilt, 0, 0};
  input.handle.position_m = {
      script.entry_m.x + pull_m + 3.7e-3F * (steps(cycle % 5) - 2),
      script.entry_m.y + 3.1e-3F * (steps(cycle % 3) - 1) - 2 * tilt * script.needle_length_m,
      script.entry_m.z + script.needle_length_m - depth_m};
  input.valid = tick % 997 == 996 ? 0 : 1;
  input.plunger_n = at < kPauseEnd ? 8 : -4;
  if (tick % 4999 == 4998) input.handle.position_m.y = std::numeric_limits<float>::quiet_NaN();
  return input;
}

inline void run(Kernel& kernel, const Script& script, std::uint64_t first_tick,
                std::uint64_t tick_count) {
  for (std::uint64_t i = first_tick; i < first_tick + tick_count; ++i) {
    tick(kernel, scripted_input(script, i));
  }
}

// What the real-time tests run: both modes with a rigid needle; and everything at once: an elastic,
// bevelled needle in breathing tissue with bone in its way, with true mass and with added mass.
enum class Setup { kPhysical, kPaper, kElastic, kAddedMass };
constexpr Setup kSetups[] = {Setup::kPhysical, Setup::kPaper, Setup::kElastic, Setup::kAddedMass};

inline const char* setup_name(Setup setup) {
  constexpr const char* kNames[] = {"physical", "paper", "elastic", "added_mass"};
  return kNames[static_cast<int>(setup)];
}
inline void PrintTo(Setup setup, std::ostream* out) {
  *out << setup_name(setup);
}

inline Config config_of(Setup setup) {
  Config config;
  config.mode = setup == Setup::kPaper ? Mode::kPaper : Mode::kPhysical;
  if (setup != Setup::kElastic && setup != Setup::kAddedMass) return config;
  config.needle[0].outer_radius_m = 0.359e-3F;
  config.needle[0].bending_nm2 = 2.318e-3F;  // 22G
  config.needle[0].bevel_per_m = 5;
  config.breathing = {{0, 1e-3F, 3e-3F}, 3};
  if (setup == Setup::kElastic) return config;
  config.substeps = 2;
  config.inertia = Inertia::kAddedMass;
  return config;
}

// A ball of bone 25 mm under the middle of the surface, for the elastic needles.
inline std::vector<ObstacleConfig> obstacles_of(const Organ& organ, Setup setup) {
  if (setup != Setup::kElastic && setup != Setup::kAddedMass) return {};
  ObstacleConfig ball;
  make_sphere(ball, 4e-3F);
  ball.pose.position_m = block_script(organ, config_of(setup)).entry_m;
  ball.pose.position_m.z -= 25e-3F;
  ball.stiffness_n_per_m = 3000;
  ball.largest_force_n = 20;
  ball.friction = 0.2F;
  return {ball};
}

inline Session make_session(const Organ& organ, Setup setup) {
  Session session = make_session(organ, config_of(setup));
  if (set_obstacles(session.kernel, obstacles_of(organ, setup)) != Status::kOk) std::abort();
  return session;
}

}  // namespace stylet::test
