// SPDX-License-Identifier: Apache-2.0
// What is seen of a simulation between two ticks: shapes, particles, events, counters, energies.
#include <algorithm>
#include <bit>
#include <type_traits>

#include "hal/hosts/c/handles.h"
#include "hal/hosts/c/sized.h"
#include "hal/hosts/c/ticking.h"

using namespace stylet;

// What is copied as it is has the same bytes here and there.
static_assert(sizeof(stylet_vec3) == sizeof(Vec3));
static_assert(sizeof(stylet_event) == sizeof(Event));
static_assert(offsetof(stylet_event, depth_m) == offsetof(Event, depth_m));
static_assert(sizeof(stylet_constraint_particle) == sizeof(ConstraintParticle));
static_assert(offsetof(stylet_constraint_particle, is_tip) == offsetof(ConstraintParticle, is_tip));
static_assert(sizeof(stylet_obstacle_touch) == sizeof(ObstacleTouch));
static_assert(offsetof(stylet_obstacle_touch, obstacle) == offsetof(ObstacleTouch, obstacle));
static_assert(STYLET_MAX_NEEDLES == kMaxNeedles && STYLET_MAX_OBSTACLES == kMaxObstacles &&
              STYLET_MAX_HULL_VERTICES == kMaxHullVertices &&
              STYLET_MAX_MATERIALS == kMaxMaterials && STYLET_MAX_RODS == kMaxRods &&
              STYLET_MAX_CONSTRAINT_PARTICLES == kMaxConstraintParticles &&
              STYLET_MAX_TOUCHES == kMaxTouches && STYLET_MAX_EVENTS == kMaxEvents &&
              STYLET_MAX_SUBSTEPS == kMaxSubsteps && STYLET_MAX_HELPERS == kMaxHelpers);

namespace {

// Null: not now.
const Kernel* kernel_of(const stylet_simulation* simulation) {
  return c::ready(simulation) == STYLET_OK ? &simulation->kernel : nullptr;
}

const Organ& organ_of(const stylet_simulation* simulation) {
  return simulation->organ->organ;
}

template <typename To, typename From>
std::span<To> room(From* out, std::size_t capacity) {
  return {reinterpret_cast<To*>(out), out == nullptr ? 0 : capacity};
}

// Of what has at most kMost elements: all of them, of which as many are copied as fit.
template <typename To, std::size_t kMost, typename From, typename Ask>
std::uint32_t ask_all(From* out, std::uint32_t capacity, const Ask& ask) {
  To all[kMost];
  const std::uint32_t count = ask(std::span<To>(all));
  const std::uint32_t fits = out == nullptr ? 0 : std::min(count, capacity);
  for (std::uint32_t i = 0; i < fits; ++i) out[i] = std::bit_cast<From>(all[i]);
  return count;
}

stylet_pool plain(const Pool& pool) {
  return {pool.used, pool.used_max, pool.capacity};
}

}  // namespace

uint32_t stylet_simulation_needles(const stylet_simulation* simulation) {
  return simulation == nullptr ? 0 : simulation->config.needle_count;
}

uint32_t stylet_simulation_surface(const stylet_simulation* simulation, stylet_vec3* out,
                                   uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr) return 0;
  (void)surface(*kernel, room<Vec3>(out, capacity));
  return static_cast<std::uint32_t>(organ_of(simulation).vertices.size());
}

uint32_t stylet_simulation_needle_shape(const stylet_simulation* simulation, uint32_t needle,
                                        stylet_vec3* out, uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr || needle >= simulation->config.needle_count) return 0;
  return ask_all<Vec3, kMaxRods + 1>(
      out, capacity, [&](std::span<Vec3> all) { return needle_shape(*kernel, needle, all); });
}

uint32_t stylet_simulation_particles(const stylet_simulation* simulation, stylet_vec3* moved_out_m,
                                     uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr) return 0;
  (void)particles(*kernel, room<Vec3>(moved_out_m, capacity));
  return particle_count(*kernel);
}

uint32_t stylet_simulation_voxel_corners(const stylet_simulation* simulation, uint32_t* out,
                                         uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr) return 0;
  (void)voxel_corners(*kernel, room<std::uint32_t>(out, capacity));
  return 8 * organ_of(simulation).voxel_count;
}

uint32_t stylet_simulation_constraint_particles(const stylet_simulation* simulation,
                                                stylet_constraint_particle* out,
                                                uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr) return 0;
  return ask_all<ConstraintParticle, kMaxNeedles*(kMaxConstraintParticles + 1)>(
      out, capacity,
      [&](std::span<ConstraintParticle> all) { return constraint_particles(*kernel, all); });
}

uint32_t stylet_simulation_obstacle_touches(const stylet_simulation* simulation,
                                            stylet_obstacle_touch* out, uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  if (kernel == nullptr) return 0;
  return ask_all<ObstacleTouch, kMaxNeedles * kMaxTouches>(
      out, capacity, [&](std::span<ObstacleTouch> all) { return obstacle_touches(*kernel, all); });
}

uint32_t stylet_simulation_events(const stylet_simulation* simulation, stylet_event* out,
                                  uint32_t capacity) {
  const Kernel* const kernel = kernel_of(simulation);
  return kernel == nullptr ? 0 : events(*kernel, room<Event>(out, capacity));
}

stylet_status stylet_simulation_get_stats(const stylet_simulation* simulation,
                                          stylet_stats* stats_out) {
  const stylet_status status = c::ready(simulation);
  if (stats_out == nullptr) return STYLET_ARGUMENT_MISSING;
  stylet_stats out = {};
  if (status == STYLET_OK) {
    const Stats s = stats(simulation->kernel);
    out = {0,
           filter_passes(simulation->kernel),
           s.ticks,
           plain(s.constraint_particles),
           plain(s.coupled_voxels),
           plain(s.tracks),
           plain(s.obstacle_contacts),
           s.input_not_finite,
           s.input_clamped,
           s.input_missing,
           s.cp_pool_full,
           s.cp_voxel_pool_full,
           s.contact_budget,
           s.fault,
           s.obstacle_pool_full,
           s.needle_unstable,
           s.coupling_shortfall,
           s.unit_in_voxels};
  }
  return c::give(out, stats_out) ? status : stylet_status{STYLET_STRUCT_SIZE_UNKNOWN};
}

stylet_status stylet_simulation_get_energy(const stylet_simulation* simulation,
                                           stylet_energy* energy_out) {
  const stylet_status status = c::ready(simulation);
  if (energy_out == nullptr) return STYLET_ARGUMENT_MISSING;
  stylet_energy out = {};
  if (status == STYLET_OK) {
    const Energy e = energy(simulation->kernel);
    out = {0,          0,         e.elastic,    e.kinetic,  e.coupling, e.bending, e.work_by_hand,
           e.friction, e.cutting, e.relaxation, e.obstacles, e.sliding};
  }
  return c::give(out, energy_out) ? status : stylet_status{STYLET_STRUCT_SIZE_UNKNOWN};
}

stylet_status stylet_simulation_get_mass(const stylet_simulation* simulation, uint32_t material,
                                         float* real_out_kg, float* stepped_out_kg) {
  MassReport mass = {0, 0};
  stylet_status status = c::ready(simulation);
  if (status == STYLET_OK && material >= organ_of(simulation).material_count) {
    status = STYLET_ARGUMENT_OUT_OF_RANGE;
  }
  if (status == STYLET_OK) mass = mass_report(simulation->kernel, material);
  if (real_out_kg != nullptr) *real_out_kg = mass.real_kg;
  if (stepped_out_kg != nullptr) *stepped_out_kg = mass.stepped_kg;
  return status;
}
