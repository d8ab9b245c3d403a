// SPDX-License-Identifier: Apache-2.0
// Simulations of stylet.h: a kernel and its memory in one block, created, ticked, saved, copied.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal/hosts/c/configuration.h"
#include "hal/hosts/c/handles.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"
#include "hal/hosts/c/ticking.h"
#include "hal/loop/mapping.h"

namespace stylet::c {
namespace {

constexpr std::size_t up(std::size_t bytes) {
  return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}

// The block: the simulation, then the kernel's three; more, so that any address can be aligned.
std::size_t block_bytes(const Sizes& need) {
  return up(sizeof(stylet_simulation)) + up(need.model_bytes) + up(need.state_bytes) +
         up(need.scratch_bytes) + kBlockAlignment;
}

stylet_status size_up(const stylet_organ* organ, const Config& config, Sizes& need,
                      stylet_refusal* refusal_out) {
  ConfigRefusal why;
  const Status status = sizes(organ->organ, config, need, &why);
  if (status != Status::kOk) return refuse_config(refusal_out, status, why);
  // Where addresses have 32 bits, the sum may not fit though each block does.
  constexpr std::size_t kMost = SIZE_MAX / 4;
  const bool fits = need.model_bytes < kMost && need.state_bytes < kMost &&
                    need.scratch_bytes < kMost - 2 * sizeof(stylet_simulation);
  return fits ? stylet_status{STYLET_OK} : refuse(refusal_out, STYLET_ORGAN_TOO_LARGE);
}

// The same of a caller's configuration.
stylet_status size_up(const stylet_organ* organ, const stylet_config* config,
                      const stylet_needle* needles, std::uint32_t needle_count, Config& own,
                      Sizes& need, stylet_refusal* refusal_out) {
  const stylet_status status = read_config(config, needles, needle_count, own, refusal_out);
  return status == STYLET_OK ? size_up(organ, own, need, refusal_out) : status;
}

// `memory` has block_bytes(need); whose it is, own_memory says.
stylet_simulation* build(const stylet_organ* organ, const Config& config, const Sizes& need,
                         void* memory) {
  auto at = up(reinterpret_cast<std::uintptr_t>(memory));
  auto* const made = new (reinterpret_cast<void*>(at)) stylet_simulation;
  at += up(sizeof(stylet_simulation));
  const auto take = [&at](std::size_t bytes) {
    auto* const first = reinterpret_cast<std::byte*>(at);
    at += up(bytes);
    return std::span(first, bytes);
  };
  const Memory blocks = {take(need.model_bytes), take(need.state_bytes), take(need.scratch_bytes)};
  std::memset(blocks.scratch.data(), 0, blocks.scratch.size());  // no tick meets a new page
  made->organ = keep(organ);
  made->config = config;
  (void)create(organ->organ, config, blocks, made->kernel);  // succeeds: the sizes are its own
  return made;
}

stylet_status make(const stylet_organ* organ, const Config& config,
                   stylet_simulation** simulation_out, stylet_refusal* refusal_out) {
  Sizes need = {};
  const stylet_status status = size_up(organ, config, need, refusal_out);
  if (status != STYLET_OK) return status;
  void* const memory = ::operator new(block_bytes(need), std::nothrow);
  if (memory == nullptr) return refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  *simulation_out = build(organ, config, need, memory);
  (*simulation_out)->own_memory = memory;
  return refuse(refusal_out, STYLET_OK);
}

}  // namespace

stylet_simulation* keep(stylet_simulation* simulation) {
  simulation->users.fetch_add(1, std::memory_order_relaxed);
  return simulation;
}

}  // namespace stylet::c

using namespace stylet;

stylet_status stylet_simulation_create(const stylet_organ* organ, const stylet_config* config,
                                       const stylet_needle* needles, uint32_t needle_count,
                                       stylet_simulation** simulation_out,
                                       stylet_refusal* refusal_out) {
  if (simulation_out != nullptr) *simulation_out = nullptr;
  if (organ == nullptr) return c::refuse_missing(refusal_out, "organ");
  if (simulation_out == nullptr) return c::refuse_missing(refusal_out, "simulation_out");
  Config own;
  const stylet_status status = c::read_config(config, needles, needle_count, own, refusal_out);
  return status == STYLET_OK ? c::make(organ, own, simulation_out, refusal_out) : status;
}

stylet_status stylet_simulation_bytes(const stylet_organ* organ, const stylet_config* config,
                                      const stylet_needle* needles, uint32_t needle_count,
                                      size_t* bytes_out, stylet_refusal* refusal_out) {
  if (bytes_out != nullptr) *bytes_out = 0;
  if (organ == nullptr) return c::refuse_missing(refusal_out, "organ");
  if (bytes_out == nullptr) return c::refuse_missing(refusal_out, "bytes_out");
  Config own;
  Sizes need = {};
  const stylet_status status =
      c::size_up(organ, config, needles, needle_count, own, need, refusal_out);
  if (status != STYLET_OK) return status;
  *bytes_out = c::block_bytes(need);
  return c::refuse(refusal_out, STYLET_OK);
}

stylet_status stylet_simulation_create_in(const stylet_organ* organ, const stylet_config* config,
                                          const stylet_needle* needles, uint32_t needle_count,
                                          void* memory, size_t bytes,
                                          stylet_simulation** simulation_out,
                                          stylet_refusal* refusal_out) {
  if (simulation_out != nullptr) *simulation_out = nullptr;
  if (organ == nullptr) return c::refuse_missing(refusal_out, "organ");
  if (simulation_out == nullptr) return c::refuse_missing(refusal_out, "simulation_out");
  if (memory == nullptr) return c::refuse_missing(refusal_out, "memory");
  Config own;
  Sizes need = {};
  const stylet_status status =
      c::size_up(organ, config, needles, needle_count, own, need, refusal_out);
  if (status != STYLET_OK) return status;
  if (bytes < c::block_bytes(need)) {
    return c::refuse_value(refusal_out, STYLET_MEMORY_TOO_SMALL, "bytes",
                           static_cast<double>(bytes),
                           "what stylet_simulation_bytes says, or more");
  }
  *simulation_out = c::build(organ, own, need, memory);
  return c::refuse(refusal_out, STYLET_OK);
}

void stylet_simulation_free(stylet_simulation* simulation) {
  if (simulation == nullptr) return;
  if (simulation->users.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  void* const memory = simulation->own_memory;
  stylet_organ* const organ = simulation->organ;
  simulation->~stylet_simulation();
  if (memory != nullptr) ::operator delete(memory);
  stylet_organ_free(organ);
}

stylet_status stylet_simulation_clone(const stylet_simulation* simulation,
                                      stylet_simulation** simulation_out) {
  if (simulation_out == nullptr) return STYLET_ARGUMENT_MISSING;
  *simulation_out = nullptr;
  stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return status;
  const std::size_t bytes = snapshot_bytes(simulation->kernel);
  const stylet_organ::Block saved = c::make_block(bytes);
  if (saved == nullptr) return STYLET_OUT_OF_MEMORY;
  stylet_simulation* copy = nullptr;
  status = c::make(simulation->organ, simulation->config, &copy, nullptr);
  if (status != STYLET_OK) return status;
  const std::span<std::byte> all(saved.get(), bytes);
  copy->obstacle = simulation->obstacle;
  copy->obstacle_count = simulation->obstacle_count;
  Status done = set_obstacles(copy->kernel, {copy->obstacle.data(), copy->obstacle_count});
  if (done == Status::kOk) done = snapshot(simulation->kernel, all);
  if (done == Status::kOk) done = restore(copy->kernel, all);
  if (done != Status::kOk) {
    stylet_simulation_free(copy);
    return static_cast<stylet_status>(done);
  }
  *simulation_out = copy;
  return STYLET_OK;
}

stylet_status stylet_simulation_set_obstacles(stylet_simulation* simulation,
                                              const stylet_obstacle* obstacles, uint32_t count,
                                              stylet_refusal* refusal_out) {
  stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return c::refuse_unready(refusal_out, status);
  std::array<ObstacleConfig, kMaxObstacles> own;
  if (count > kMaxObstacles) {
    const ConfigRefusal many = {"obstacles", 0, static_cast<double>(count), 0, kMaxObstacles};
    return c::refuse_config(refusal_out, Status::kConfigValueOutOfRange, many);
  }
  const std::span<ObstacleConfig> used(own.data(), count);
  status = c::read_obstacles(obstacles, used, refusal_out);
  if (status != STYLET_OK) return status;
  ConfigRefusal why;
  const Status set = set_obstacles(simulation->kernel, used, &why);
  if (set == Status::kObstaclesTooLate) {
    return c::refuse_value(refusal_out, STYLET_OBSTACLES_TOO_LATE, "obstacles",
                           static_cast<double>(stats(simulation->kernel).ticks),
                           "0 ticks: obstacles are set before the first tick, or after a reset");
  }
  if (set != Status::kOk) return c::refuse_config(refusal_out, set, why);
  simulation->obstacle = own;
  simulation->obstacle_count = count;
  return c::refuse(refusal_out, STYLET_OK);
}

stylet_status stylet_simulation_reset(stylet_simulation* simulation) {
  const stylet_status status = c::ready(simulation);
  if (status == STYLET_OK) reset(simulation->kernel);
  return status;
}

stylet_status stylet_simulation_tick(stylet_simulation* simulation, const stylet_input* inputs,
                                     uint32_t input_count, stylet_output* outputs_out,
                                     uint32_t output_count) {
  const auto refuse = [&](stylet_status status) {
    const std::size_t room = std::min<std::size_t>(output_count, kMaxNeedles);
    return c::refuse_outputs(status, outputs_out, room);
  };
  const stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return refuse(status);
  if ((inputs == nullptr && input_count > 0) || (outputs_out == nullptr && output_count > 0)) {
    return refuse(STYLET_ARGUMENT_MISSING);
  }
  const std::uint32_t needles = simulation->config.needle_count;
  if (input_count > needles || output_count > needles) {
    return refuse(STYLET_ARGUMENT_OUT_OF_RANGE);
  }
  const c::Arrays arrays =
      c::arrays(input_count > 0 ? inputs : nullptr, output_count > 0 ? outputs_out : nullptr);
  if (!c::sizes_known(arrays, input_count)) return refuse(STYLET_STRUCT_SIZE_UNKNOWN);
  c::tick_plain(*simulation, arrays, input_count, output_count);
  return STYLET_OK;
}

stylet_status stylet_simulation_run(stylet_simulation* simulation, const stylet_input* inputs,
                                    stylet_output* outputs_out, uint32_t ticks) {
  const std::size_t all = std::size_t{stylet_simulation_needles(simulation)} * ticks;
  const auto refuse = [&](stylet_status status) {
    return c::refuse_outputs(status, outputs_out, all);
  };
  const stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return refuse(status);
  if (ticks == 0) return STYLET_OK;
  if (inputs == nullptr) return refuse(STYLET_ARGUMENT_MISSING);
  const c::Arrays arrays = c::arrays(inputs, outputs_out);
  if (!c::sizes_known(arrays, all)) return refuse(STYLET_STRUCT_SIZE_UNKNOWN);
  c::run_plain(*simulation, arrays, ticks);
  return STYLET_OK;
}

stylet_pose stylet_pose_of_tip(stylet_vec3 tip_m, stylet_vec3 direction, float length_m) {
  const Vec3 way = c::unit(direction);
  const Quat turn = hal::needle_rotation(way);
  return {{tip_m.x - length_m * way.x, tip_m.y - length_m * way.y, tip_m.z - length_m * way.z},
          {turn.w, turn.x, turn.y, turn.z}};
}

uint64_t stylet_simulation_hash(const stylet_simulation* simulation) {
  return c::ready(simulation) == STYLET_OK ? hash(simulation->kernel) : 0;
}

size_t stylet_simulation_snapshot_bytes(const stylet_simulation* simulation) {
  return simulation == nullptr ? 0 : snapshot_bytes(simulation->kernel);
}

stylet_status stylet_simulation_snapshot(const stylet_simulation* simulation, void* out,
                                         size_t bytes) {
  const stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return status;
  if (out == nullptr) return STYLET_ARGUMENT_MISSING;
  return static_cast<stylet_status>(
      snapshot(simulation->kernel, {static_cast<std::byte*>(out), bytes}));
}

stylet_status stylet_simulation_restore(stylet_simulation* simulation, const void* in,
                                        size_t bytes) {
  const stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return status;
  if (in == nullptr) return STYLET_ARGUMENT_MISSING;
  if (bytes != snapshot_bytes(simulation->kernel)) return STYLET_SNAPSHOT_DOES_NOT_MATCH;
  return static_cast<stylet_status>(
      restore(simulation->kernel, {static_cast<const std::byte*>(in), bytes}));
}

const char* stylet_simulation_difference(const stylet_simulation* a, const stylet_simulation* b,
                                         uint64_t* index_out) {
  if (index_out != nullptr) *index_out = 0;
  if (c::ready(a) != STYLET_OK || c::ready(b) != STYLET_OK) return "simulation";
  const Difference found = difference(a->kernel, b->kernel);
  if (index_out != nullptr) *index_out = found.index;
  return found.field;
}

stylet_status stylet_simulation_set_helpers(stylet_simulation* simulation, uint32_t helpers) {
  const stylet_status status = c::ready(simulation);
  if (status != STYLET_OK) return status;
  if (helpers > kMaxHelpers) return STYLET_ARGUMENT_OUT_OF_RANGE;
  const std::size_t bytes = helpers == 0 ? 0 : team_bytes(simulation->kernel, helpers);
  stylet_organ::Block memory = c::make_block(std::max<std::size_t>(bytes, 1));
  if (memory == nullptr) return STYLET_OUT_OF_MEMORY;
  const Status set = set_team(simulation->kernel, helpers, {memory.get(), bytes});
  if (set != Status::kOk) return static_cast<stylet_status>(set);
  simulation->team = std::move(memory);
  return STYLET_OK;
}

int stylet_simulation_help(stylet_simulation* simulation, uint32_t looks) {
  return simulation != nullptr && help(simulation->kernel, looks) ? 1 : 0;
}
