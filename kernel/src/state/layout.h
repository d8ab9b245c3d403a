// SPDX-License-Identifier: Apache-2.0
// Where all data lives: three blocks, each a list of parallel arrays; state and scratch hold no
// pointers.
//
// One table per block (the STYLET_..._FIELDS macros) gives the view, the size, the reset, the hash,
// the field-by-field difference and the checks of a snapshot; no other code computes an offset.
// Every array starts on a cache line. Units: SI; displacements are from the place at rest, in
// metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "laws/filter.h"
#include "laws/fluid.h"
#include "laws/fracture.h"
#include "needle/obstacle.h"
#include "needle/rod.h"
#include "organ/runs.h"
#include "state/derived.h"
#include "state/lattice_plan.h"
#include "state/members.h"
#include "state/needle_state.h"
#include "state/slide.h"
#include "stylet/kernel.h"
#include "stylet/levels.h"
#include "stylet/limits.h"
#include "stylet/organ.h"

namespace stylet {

// All sizes of arrays, from the organ and the number of needles.
struct Counts {
  std::uint32_t voxels;                   // of the organ file
  std::uint32_t planes;                   // voxel planes; there is one more plane of particles
  std::uint32_t rows;                     // stretches of voxels along x (runs.h)
  std::uint32_t row_grid;                 // blocks of places (y, z), 2^row_shift in each
  std::uint32_t row_shift, row_bits;      // each block has at most 2^row_bits rows
  std::uint32_t slots;                    // padded voxels
  std::uint32_t slots_at_once;            // slots whose sums are kept together
  std::uint32_t particles;                // padded particles
  std::uint32_t particles_per_plane;      // of the fullest plane, padded
  std::uint32_t windows[2];               // of 8 and of 16 lanes, lattice/plan.h
  std::uint32_t sheets, ties;             // 1 and 0 without parts that share a cell
  std::uint32_t levels;                   // of voxels; 1: all have one edge
  std::uint32_t hanging, hanging_shares;  // nodes; what they give to masters (PHYSICS 2.9)
  // Of a graded lattice with true mass (lattice/shadow.h): nodes of the cascade, shadows among
  // them, shadow cells, particles of level 0 beside them, shares from level to level.
  std::uint32_t cascade, shadows, shadow_cells, border, shadow_shares;
  std::uint32_t stiffening_slots;             // zero if no tissue stiffens
  std::uint32_t needles;                      // of the configuration
  std::uint32_t membrane_needles, membranes;  // needles and 1; zero if there are none
  std::uint32_t fluids;                       // needles, or zero if the hubs of all are closed
  // Parts that slide on each other: points and grounds; particles, and 1; zero if there are none.
  std::uint32_t slide_points, grounds, slid_particles, slides;
  // Zero where a particle moves at once, with added mass and one level: particles, slots and ties;
  // tiles (lattice/tiles.h); floats of a plane of tiles, and of a filter's scratch.
  std::uint32_t filtered_particles, filtered_slots, filtered_ties;
  std::uint32_t tiles, tile_floats, coarse_tiles;  // the last: of level 0
  std::uint64_t filter_floats;
};

// Slots that the lattice sweep matches at a time: they and their results stay in the nearest
// cache. (With 128 the step takes 0.7 % more instructions, with 160 up to 2 % more time.)
constexpr std::uint32_t kChunk = 144;
static_assert(kChunk % kLanes == 0);

struct ModelHead {
  Organ organ;                       // a copy: only the file's bytes are the caller's
  std::byte* team;                   // see set_team; here, so that all copies of a Kernel know it
  Config config;                     // as create took it
  Counts counts;                     // of all arrays
  std::uint64_t organ_hash;          // of the file
  float edge_m, inverse_edge_per_m;  // of level 0
  Level level[kMaxLevels];           // coarsest first
  Vec3 origin_m;                     // low corner of the lattice, in the rest frame
  std::uint16_t size_x, size_y, size_z, sheet_rows;  // in voxels; lines y of all sheets, of one
  Rules rules;                                       // of Config::mode
  float substep_s;                                   // length of a substep
  float hourglass_weight;                            // chi
  Filter filter;                                     // not used with added mass
  Shadows shadows;                                   // of a graded lattice with true mass
  float velocity_keep;                    // factor of the slip speed's low pass, per tick
  float cone_length_m[kMaxNeedles];       // of the tips, cone.h
  std::uint32_t obstacle_count;           // of obstacles that set_obstacles took
  std::uint32_t material_count;           // of the organ file
  MaterialModel material[kMaxMaterials];  // by the file's index
};

struct StateHead {
  std::uint64_t tick;           // ticks since reset
  std::uint32_t latched_fault;  // 1: stopped until reset
  std::uint32_t track_count;    // tracks kept
  std::uint32_t track_next;     // the one to overwrite next
  float max_displacement_m;     // of any particle, along an axis; bounds the search for surfaces
  float coupling_shortfall;     // the largest since reset, a fraction
  std::uint32_t event_count;    // events since reset, those that the ring has lost included
  std::uint32_t coupled_max;    // coupled voxels of one tick, the most since reset
  std::uint32_t track_max;      // tracks kept, the most since reset
  // What was refused, clamped, cut short or left out since reset, each with its flag.
  std::uint64_t input_not_finite, input_clamped, input_missing;
  std::uint64_t cp_pool_full, cp_voxel_pool_full, contact_budget, fault_count;
  std::uint64_t obstacle_pool_full, needle_unstable;
  // Since reset: the hand's work and what was dissipated (PHYSICS 14.2).
  double work_by_hand_j, friction_j, cutting_j, relaxation_j, obstacles_j;
};

struct ScratchHead {
  std::uint32_t coupled_count;     // coupled voxels of this tick
  std::uint32_t substeps_to_come;  // of this tick, after this one
  std::uint32_t padding[14];       // to a cache line; zero
};

// F(name, type, count); `c` is Counts. The comment above an entry says what the array holds and, at
// its end, which code writes it. For the spring of a constraint particle, `stretch` is how far this
// tick pulls it, and `place` is where its end is in this substep. Only with true mass: the bounds
// on the stiffness of a voxel and of a particle (laws/filter.h); `coupling_bound`, which
// constraint particles add to the bound of a particle in this tick; momentum over mass (w). Only
// with sheets: `representative`, and `quarters` (sub-samples, organ.fbs).
#define STYLET_MODEL_FIELDS(F)                                                           \
  /* head: configuration, counts, materials, what creation derived */                    \
  F(head, ModelHead, 1)                                                                  \
  /* plane: voxel planes from the bottom up, and one more of particles */                \
  F(plane, Plane, c.planes + 1)                                                          \
  /* row: stretches of voxels along x, by plane, y and x */                              \
  F(row, Row, c.rows)                                                                    \
  /* window8: what the sweep gathers per 8 lanes (lattice/plan.h) */                     \
  F(window8, Window, c.windows[0])                                                       \
  /* window16: the same for 16 lanes */                                                  \
  F(window16, Window, c.windows[1])                                                      \
  /* tie: nodes of different sheets that are one particle */                             \
  F(tie, TiedNode, c.ties)                                                               \
  /* tile: what the filter's passes take, true mass only (lattice/tiles.h) */            \
  F(tile, Tile, c.tiles)                                                                 \
  /* piece: where tiles lie among slots and particles */                                 \
  F(piece, Piece, c.tiles)                                                               \
  /* tied_place: tied nodes by their places in tiles */                                  \
  F(tied_place, TiedNode, c.filtered_ties)                                               \
  /* hanging: nodes on the surface of coarser voxels (lattice/hanging.h) */              \
  F(hanging, HangingNode, c.hanging)                                                     \
  /* hanging_share: what they give to each master */                                     \
  F(hanging_share, HangingShare, c.hanging_shares)                                       \
  /* shadow: where shadows lie (lattice/shadow.h) */                                     \
  F(shadow, ShadowNode, c.shadows)                                                       \
  /* shadow_cell: cells with finer voxels in them, of level 0 first */                   \
  F(shadow_cell, ShadowCell, c.shadow_cells)                                             \
  /* border: particles of level 0 beside them */                                         \
  F(border, std::uint32_t, c.border)                                                     \
  /* border_place: where they lie in tiles */                                            \
  F(border_place, std::uint32_t, c.border)                                               \
  /* down_share: what nodes of the cascade give to coarser ones, finest first */         \
  F(down_share, HangingShare, c.shadow_shares)                                           \
  /* up_share: what nodes of the cascade get from coarser ones, coarsest first */        \
  F(up_share, HangingShare, c.shadow_shares)                                             \
  /* cascade_kg: kg: of a node of the cascade, without what it gets; 0 of a shadow */    \
  F(cascade_kg, float, c.cascade)                                                        \
  /* cascade_mobility: 1/kg: velocity over momentum of what it moves itself */           \
  F(cascade_mobility, float, c.cascade)                                                  \
  /* cascade_bound: N/m: bound on its stiffness */                                       \
  F(cascade_bound, float, c.cascade)                                                     \
  /* row_of: first row of a place (y, z), to find the row of a voxel */                  \
  F(row_of, std::uint32_t, c.row_grid)                                                   \
  /* voxel_slot: slot of each of the organ file's voxels */                              \
  F(voxel_slot, std::uint32_t, c.voxels)                                                 \
  /* voxel_row: its row */                                                               \
  F(voxel_row, std::uint32_t, c.voxels)                                                  \
  /* slot_k: N/m: spring of a corner, of a voxel; 0 in a hole */                         \
  F(slot_k, float, c.slots)                                                              \
  /* slot_volume: 1: lambda over 2 G of a voxel */                                       \
  F(slot_volume, float, c.slots)                                                         \
  /* slot_stiffening: 1: strain stiffening; only if some tissue of the organ has it */   \
  F(slot_stiffening, float, c.stiffening_slots)                                          \
  /* slot_fill: 1: part of the voxel that is tissue */                                   \
  F(slot_fill, float, c.slots)                                                           \
  /* slot_material: index of its material */                                             \
  F(slot_material, std::uint8_t, c.slots)                                                \
  /* slot_mixed: its entry in the organ's mixed voxels, or kNotMixed */                  \
  F(slot_mixed, std::uint32_t, c.slots)                                                  \
  /* step_per_mass: s/kg: time step over stepped mass; 0 where it is held */             \
  F(step_per_mass, float, c.particles)                                                   \
  /* particle_kg: kg: its tissue's mass, without what the step adds */                   \
  F(particle_kg, float, c.particles)                                                     \
  /* hourglass_n_per_m: resistance of a particle to hourglass motion, over its voxels */ \
  F(hourglass_n_per_m, float, c.particles)                                               \
  /* before_bound: what pieces read before the first bound and do not use */             \
  F(before_bound, float, c.filtered_slots > 0 ? kLanes : 0)                              \
  /* slot_bound: N/m: bound on a voxel's stiffness, true mass only (laws/filter.h) */    \
  F(slot_bound, float, c.filtered_slots)                                                 \
  /* bound: N/m: the same for a particle */                                              \
  F(bound, float, c.filtered_particles)                                                  \
  /* rod: each needle's chain of rods at rest */                                         \
  F(rod, RodModel, c.needles)                                                            \
  /* forces: what each needle meets in each tissue (laws/fracture.h) */                  \
  F(forces, NeedleForces, kMaxMaterials* c.needles)                                      \
  /* bore: each needle's, unless all hubs are closed (laws/fluid.h) */                   \
  F(bore, Bore, c.fluids)                                                                \
  /* opening: what each needle's opening meets in each tissue, likewise */               \
  F(opening, Opening, kMaxMaterials* c.fluids)                                           \
  /* obstacle: convex bodies, as set_obstacles took them */                              \
  F(obstacle, Obstacle, kMaxObstacles)                                                   \
  /* representative: with sheets only: the particle that each node is */                 \
  F(representative, std::uint32_t, c.sheets > 1 ? c.particles : 0)                       \
  /* quarters: with sheets only: which quarters of its cell a voxel owns (organ.fbs) */  \
  F(quarters, std::uint64_t, c.sheets > 1 ? c.slots : 0)                                 \
  /* slide_point: points of parts that slide on a ground (coupling/slides.h) */          \
  F(slide_point, SlidePoint, c.slide_points)                                             \
  /* ground: what they slide on */                                                       \
  F(ground, SlideGround, c.grounds)                                                      \
  /* slide_room: N/m: stiffness that contact of parts may add to a particle */           \
  F(slide_room, float, c.slid_particles)

#define STYLET_STATE_FIELDS(F)                                                            \
  /* head: tick, faults, counters and energy books; written by all steps */               \
  F(head, StateHead, 1)                                                                   \
  /* ux: m: displacement from the rest place; written by the lattice step */              \
  F(ux, float, c.particles)                                                               \
  F(uy, float, c.particles)                                                               \
  F(uz, float, c.particles)                                                               \
  /* vx: m/s: velocity; written by the lattice step */                                    \
  F(vx, float, c.particles)                                                               \
  F(vy, float, c.particles)                                                               \
  F(vz, float, c.particles)                                                               \
  /* wx: m/s: momentum over mass, true mass only; written by the lattice step */          \
  F(wx, float, c.filtered_particles)                                                      \
  F(wy, float, c.filtered_particles)                                                      \
  F(wz, float, c.filtered_particles)                                                      \
  /* ex: m: u + tau v, what voxels are matched to; written by the lattice step */         \
  F(ex, float, c.particles)                                                               \
  F(ey, float, c.particles)                                                               \
  F(ez, float, c.particles)                                                               \
  /* qw: 1: rotation of a voxel's last match, a unit quaternion; lattice step */          \
  F(qw, float, c.slots)                                                                   \
  F(qx, float, c.slots)                                                                   \
  F(qy, float, c.slots)                                                                   \
  F(qz, float, c.slots)                                                                   \
  /* needle: each needle's pose, phase and track; written by tick.cpp and coupling/ */    \
  F(needle, NeedleState, c.needles)                                                       \
  /* shaft: each needle's constraint particles, its tip the last; written by coupling/ */ \
  F(shaft, Particle, kNeedleParticles* c.needles)                                         \
  /* rod_shape: joints of an elastic needle; written by coupling/bend */                  \
  F(rod_shape, RodShape, c.needles)                                                       \
  /* node: m: its nodes, handle first; written by coupling/bend */                        \
  F(node, Vec3, (kMaxRods + 1) * c.needles)                                               \
  /* touch: what it touches of obstacles; written by coupling/touches */                  \
  F(touch, Touch, kMaxTouches* c.needles)                                                 \
  /* fluid: in each needle, unless all hubs are closed; written by coupling/flow */       \
  F(fluid, FluidState, c.fluids)                                                          \
  /* track: holes in the tissue; written by coupling/track and insertion */               \
  F(track, Track, kMaxTracks)                                                             \
  /* event: the last kMaxEvents events, a ring; written by state/events */                \
  F(event, Event, kMaxEvents)                                                             \
  /* membrane: what each tip has met of membranes; written by coupling/membranes */       \
  F(membrane, MembraneState, c.membrane_needles)                                          \
  /* holes: those that tips have made in membranes; likewise */                           \
  F(holes, MembraneHoles, c.membranes)                                                    \
  /* slide: where points of parts that slide are; written by coupling/slides */           \
  F(slide, SlideState, c.slide_points)                                                    \
  /* slide_books: what their friction has taken; likewise */                              \
  F(slide_books, SlideBooks, c.slides)

#define STYLET_SCRATCH_FIELDS(F)                                                             \
  /* head: counts of this tick; written by tick and coupling/match */                        \
  F(head, ScratchHead, 1)                                                                    \
  /* before_sums: what windows read before the first sum and do not use; nobody writes it */ \
  F(before_sums, float, kLanes)                                                              \
  /* sums: N: forces that voxels send to their corners, a chunk of slots; lattice step */    \
  F(sums, float, 12 * c.slots_at_once)                                                       \
  /* force: N: forces on two planes of particles; written by the lattice step */             \
  F(force, float, 6 * c.particles_per_plane)                                                 \
  /* coupled: voxels that hold constraint particles in this tick; coupling/match */          \
  F(coupled, CoupledVoxel, kMaxCoupledVoxels* c.needles)                                     \
  /* member: their particles' supports, lists by voxel; coupling/match */                    \
  F(member, Member, kMaxMembers* c.needles)                                                  \
  /* stretch: m: how far this tick pulls each particle's spring; tick and coupling/ */       \
  F(stretch, Vec3, kNeedleParticles* c.needles)                                              \
  /* place: m: where that spring's end is in this substep; lattice/matches */                \
  F(place, Vec3, kNeedleParticles* c.needles)                                                \
  /* plane_first: first entry of each plane in plane_order; coupling/match */                \
  F(plane_first, std::uint32_t, c.planes + 2)                                                \
  /* plane_order: coupled voxels by plane; coupling/match */                                 \
  F(plane_order, std::uint32_t, kMaxCoupledVoxels* c.needles)                                \
  /* group: the same in lanes (coupling/match); changes for corners (lattice/match_lanes) */ \
  F(group, MatchGroup, kMaxCoupledVoxels / kLanes * c.needles)                               \
  /* slot_mark: entry of a slot in `coupled`, if that points back; coupling/match */         \
  F(slot_mark, std::uint32_t, c.slots)                                                       \
  /* coupling_bound: N/m: what constraint particles add to `bound`; coupling/match */        \
  F(coupling_bound, float, c.filtered_particles)                                             \
  /* filter: passes of the filter, true mass only; lattice/filter_passes */                  \
  F(filter, float, c.filter_floats)                                                          \
  /* loads: on the rods: forces of particles (needle/rod.h); coupling/bend */                \
  F(loads, RodLoads, 1)                                                                      \
  /* rod: the rods' equilibrium at work; needle/rod */                                       \
  F(rod, RodScratch, 1)                                                                      \
  /* rod_result: the result of it; needle/rod */                                             \
  F(rod_result, RodResult, 1)                                                                \
  /* touch: touches of this tick, before they are kept; coupling/touches */                  \
  F(touch, Touch, kMaxTouches)                                                               \
  /* slide_contact: contacts of points in a substep; coupling/slides */                      \
  F(slide_contact, SlideContact, c.slide_points)                                             \
  /* slide_use: N/m: stiffness that they would add to a particle; coupling/slides */         \
  F(slide_use, float, c.slid_particles)                                                      \
  /* slide_force: N: on particles, x, y and z; coupling/slides */                            \
  F(slide_force, float, 3 * c.slid_particles)

// How many fields each block has.
#define STYLET_FIELD_ONE(name, type, count) +1
constexpr std::size_t kModelFields = 0 STYLET_MODEL_FIELDS(STYLET_FIELD_ONE);
constexpr std::size_t kStateFields = 0 STYLET_STATE_FIELDS(STYLET_FIELD_ONE);
constexpr std::size_t kScratchFields = 0 STYLET_SCRATCH_FIELDS(STYLET_FIELD_ONE);
#undef STYLET_FIELD_ONE

// An array of a block, constant where its owner is: a `const State&` can be read, not written.
template <typename T>
class Field {
 public:
  Field() = default;
  Field(T* first) : first_(first) {}  // NOLINT: an array is given by its first element
  operator T*() { return first_; }
  operator const T*() const { return first_; }
  T* operator->() { return first_; }
  const T* operator->() const { return first_; }
  T& operator*() { return *first_; }
  const T& operator*() const { return *first_; }
  template <typename Index>
  T& operator[](Index i) {
    return first_[i];
  }
  template <typename Index>
  const T& operator[](Index i) const {
    return first_[i];
  }
  Field& operator+=(std::ptrdiff_t count) {
    first_ += count;
    return *this;
  }

 private:
  T* first_;
};

// A function's signature says what it may write. `const Model&`: derived at creation, constant in a
// tick. `State&`: what a tick leaves to the next one. `Scratch&`: what it keeps within itself. The
// fields of one needle (rod, forces; needle, shaft, tip, rod_shape, node, touch, membrane) are
// `needle_index`'s.
#define STYLET_FIELD(name, type, count) Field<type> name;
struct Model {
  STYLET_MODEL_FIELDS(STYLET_FIELD)
  std::uint32_t needle_index;  // the needle whose fields it shows

  const Organ& organ() const { return head->organ; }
  const NeedleConfig& needle_config() const { return head->config.needle[needle_index]; }
};
struct State {
  STYLET_STATE_FIELDS(STYLET_FIELD)
  Field<Particle> tip;         // the needle's last particle
  std::uint32_t needle_index;  // the needle whose fields it shows
};
struct Scratch {
  STYLET_SCRATCH_FIELDS(STYLET_FIELD)
};
#undef STYLET_FIELD

// kOrganTooLarge if a block does not fit into this machine's addresses.
Status block_sizes(const Counts& counts, Sizes& sizes_out);
const Counts& counts_of(const Kernel& kernel);

Model model_of(std::byte* block, const Counts& counts);
State state_of(std::byte* block, const Counts& counts);
Scratch scratch_of(std::byte* block, const Counts& counts);

struct View {
  // All three blocks of a kernel.
  Model model;
  State state;
  Scratch scratch;
};
inline bool stiffens(const Model& model) {
  return model.head->counts.stiffening_slots != 0;
}
inline bool has_membranes(const Model& model) {
  return model.head->counts.membrane_needles != 0;
}
inline bool has_slides(const Model& model) {
  return model.head->counts.slides != 0;
}
inline bool is_graded(const Model& model) {
  return model.head->counts.levels > 1;
}
// Or several levels, where masters move once all have given them what they got.
inline bool has_true_mass(const Model& model) {
  return model.head->counts.filtered_particles != 0;
}
// The view of the first needle; below, of any needle.
View view_of(const Kernel& kernel);
View needle_view(const View& view, std::uint32_t needle);
Model needle_model(const Model& model, std::uint32_t needle);
State needle_state(const State& state, std::uint32_t needle);

// A field of the state: where it lies in the block, and how large it is.
struct StateField {
  const char* name;           // in the table
  std::size_t at;             // bytes from the block's beginning
  std::size_t element_bytes;  // of one element
  std::size_t count;          // of elements
};
using StateFields = std::array<StateField, kStateFields>;
StateFields fields_of_state(const Counts& counts);

std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t bytes);
std::uint64_t hash_state(const Kernel& kernel);
Difference first_difference(const Kernel& a, const Kernel& b);

}  // namespace stylet
