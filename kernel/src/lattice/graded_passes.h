// SPDX-License-Identifier: Apache-2.0
// How a graded lattice moves after the sweep: momenta go down the cascade (lattice/shadow.h), the
// passes of filter_passes.h filter level 0, velocities come up, and hanging nodes follow. Part of
// the lattice sweep, compiled with it once per instruction set.
//
// The passes go one by one through all planes of level 0, not as a wave: after each pass, the
// border of level 0 takes what the shadows beside it give.
//
// Internal linkage throughout, as in lanes.h. PHYSICS 3.5.
#pragma once

#include "lattice/filter_passes.h"
#include "lattice/hanging.h"
#include "lattice/shadow.h"

namespace stylet {
namespace {

// As Wave, but an array has all planes of level 0, each from its first tile of nodes.
struct GradedWave {
  float *starts, *bounds, *iterates, *sends;
  float *work, *packed;
  std::ptrdiff_t floats, all;  // of a plane's array, and of all planes'
  const Plane* plane;

  std::ptrdiff_t place(std::uint32_t z) const {
    return static_cast<std::ptrdiff_t>(plane[z].tiles.node) * kTileFloats;
  }
  float* start(std::uint32_t z) const { return starts + place(z); }
  float* bound(std::uint32_t z) const { return bounds + place(z); }
  float* of_pass(std::uint32_t j) const { return j > 1 ? iterates + j % 3 * all : starts; }
  float* iterate(std::uint32_t j, std::uint32_t z) const { return of_pass(j) + place(z); }
  float* sent(std::uint32_t, std::uint32_t z) const { return sends + z % 2 * floats; }
};

GradedWave graded_wave_in(const Model& model, float* memory) {
  const auto floats = static_cast<std::ptrdiff_t>(model.head->counts.tile_floats);
  const std::ptrdiff_t all =
      static_cast<std::ptrdiff_t>(model.head->counts.coarse_tiles) * kTileFloats;
  float* const sends = memory + kGradedArrays * all;
  float* const work = sends + (kGradedPlanes - 1) * floats;
  return {memory, memory + all, memory + 2 * all, sends, work, work + floats,
          floats, all,          model.plane};
}

// The passes for level 0.
void pass_coarse(const Model& model, const State& state, const Scratch& scratch,
                 const GradedWave& wave, CascadeVectors& vectors) {
  const std::uint32_t planes = model.head->shadows.coarse_planes;
  const auto empty = [](float* tile) { std::fill_n(tile, kTileFloats, 0.0F); };
  for (std::uint32_t i = 0; i < kGradedPlanes; ++i) empty(wave.sends + i * wave.floats);
  for (std::uint32_t z = 0; z < planes; ++z) {
    for (std::uint32_t i = 0; i < kGradedArrays; ++i) empty(wave.start(z) + i * wave.all);
    start_plane(model, state, scratch, z, wave.start(z), wave.bound(z));
  }
  start_shadows(model, vectors, wave.starts, wave.bounds);
  for (std::uint32_t j = 1; j <= model.head->filter.passes; ++j) {
    for (std::uint32_t z = 0; z < planes; ++z) {
      pass_plane(model, wave, j, z, wave.iterate(j + 1, z));
    }
    pass_shadows(model, vectors, j, wave.of_pass(j + 1));
  }
}

// Filters and moves all particles.
void filter_graded(const Model& model, State& state, Scratch& scratch, Motion& motion) {
  const std::uint32_t planes = model.head->counts.planes + 1;  // of particles
  const Shadows& shadows = model.head->shadows;
  if (shadows.on == 0) {
    move_unfiltered(model, state, 0, planes, motion);
    return;
  }
  const GradedWave wave = graded_wave_in(model, scratch.filter);
  const auto axis = static_cast<std::ptrdiff_t>(model.head->counts.particles_per_plane);
  CascadeVectors vectors = cascade_vectors(model, wave.packed + 3 * axis);
  give_down(model, state, scratch, vectors.all);
  pass_coarse(model, state, scratch, wave, vectors);
  give_up(model, vectors);
  for (std::uint32_t z = 0; z < shadows.coarse_planes; ++z) {
    move_filtered(model, state, wave.iterate(model.head->filter.passes + 1, z), wave.packed, z,
                  motion);
  }
  for (std::uint32_t z = shadows.coarse_planes; z < planes; ++z) {
    pack_fine(model, model.plane[z], vectors.all, wave.packed, axis);
    move_plane(model.plane[z], state, wave.packed, axis, motion);
  }
}

// After the sweep: hanging nodes give their momentum to their masters. Then all particles move, and
// the nodes follow.
void finish_graded(const Model& model, State& state, Scratch& scratch, Motion& motion) {
  give_momentum(model, state, motion.most_momentum);
  filter_graded(model, state, scratch, motion);
  const std::ptrdiff_t axis = state.uy - state.ux;
  for (float* const values : {&state.ux[0], &state.vx[0], &state.ex[0]}) {
    follow(model, values, axis);
  }
}

}  // namespace
}  // namespace stylet
