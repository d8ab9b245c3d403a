/* SPDX-License-Identifier: Apache-2.0 */
/* Stylet for every language that can call C: organs, needles in them, the force on the hand; the
 * guard and the loop of a haptic device. Plain C99; libstylet.so exports these functions and
 * nothing else.
 *
 * Units: SI. Frames: world is the organ's rest frame, right-handed; a device has its own.
 *
 * Structs that may grow begin with `struct_bytes`, which the caller sets to sizeof of the struct
 * it was compiled with (stylet_..._init sets it where there are defaults). A newer library uses its
 * defaults for fields that the caller's struct does not have; an older one refuses a value in a
 * field that it does not know. In an array, struct_bytes of the first element holds for all. A
 * program compiled with a header of version 0.2 or later runs with every later library.
 *
 * Functions that return stylet_status return STYLET_OK or what was wrong. A call that fails leaves
 * simulations, guards and loops as they were. A handle that it should have given is then null, and
 * a struct that it should have filled is zero after struct_bytes; a refusal says what was wrong.
 * Null is refused where a pointer is needed, but refusal_out may be null, and _free accepts null.
 *
 * Functions that copy arrays write at most `capacity` elements and return how many there are, so
 * a call with (NULL, 0) asks for the number (those for events return how many they wrote). While a
 * loop has a simulation, functions that copy its state out give nothing: ask the loop instead.
 *
 * Handles hold what they need: a simulation keeps its organ, a loop its simulation. Memory that is
 * passed need not be aligned and may be freed after the call, unless a function says otherwise.
 * A simulation, batch or guard may be used by one thread at a time, an organ by any number.
 *
 * In the child of a fork, simulations and batches can be used; a batch gets threads of its own. A
 * running loop and devices stay with the parent: in the child, waiting for them and their reports
 * are refused, and free and close only forget them.
 *
 * The following functions of a simulation neither allocate, lock, log nor make system calls: reset,
 * tick, run, set_obstacles, help, and those that copy its state out. The same inputs give the same
 * bits, whatever the compiler, the processor and the number of threads. */
#ifndef STYLET_STYLET_H
#define STYLET_STYLET_H

#include <stddef.h>
#include <stdint.h>

#ifndef _WIN32
#define STYLET_API __attribute__((visibility("default")))
#elif defined(STYLET_BUILDS_LIBRARY)
#define STYLET_API __declspec(dllexport)
#else
#define STYLET_API __declspec(dllimport)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ==== Version ================================================================================ */
#define STYLET_VERSION_MAJOR 0
#define STYLET_VERSION_MINOR 2
#define STYLET_VERSION_PATCH 0

/* Of the library that runs: major << 16 | minor << 8 | patch. */
STYLET_API uint32_t stylet_version(void);
STYLET_API const char* stylet_version_text(void);
/* Compiler, and the instruction set that the tissue step uses on this processor. */
STYLET_API const char* stylet_build_text(void);
/* A library reads the snapshots of every library with the same number. */
STYLET_API uint64_t stylet_state_layout(void);

/* ==== Status, limits and other numbers, which never change meaning =========================== */
typedef uint16_t stylet_status;
enum {
  STYLET_OK = 0,
  /* the organ's bytes */
  STYLET_ORGAN_TOO_SMALL = 100,
  STYLET_ORGAN_NOT_AN_ORGAN_FILE = 101,
  STYLET_ORGAN_VERSION_UNKNOWN = 102,
  STYLET_ORGAN_STRUCTURE_DAMAGED = 103,
  STYLET_ORGAN_VALUE_OUT_OF_RANGE = 104,
  STYLET_ORGAN_INDEX_OUT_OF_RANGE = 105,
  STYLET_ORGAN_SIZES_DISAGREE = 106,
  STYLET_ORGAN_ORDER_WRONG = 107,
  STYLET_ORGAN_TOO_LARGE = 108,
  /* the configuration */
  STYLET_CONFIG_VALUE_OUT_OF_RANGE = 200,
  STYLET_OBSTACLES_TOO_LATE = 201,
  /* memory and snapshots */
  STYLET_MEMORY_TOO_SMALL = 300,
  STYLET_MEMORY_NOT_ALIGNED = 301, /* never here: this interface aligns memory */
  STYLET_SNAPSHOT_DOES_NOT_MATCH = 302,
  STYLET_SNAPSHOT_DAMAGED = 303,
  /* the call */
  STYLET_ARGUMENT_MISSING = 400,    /* null where a pointer is needed */
  STYLET_STRUCT_SIZE_UNKNOWN = 401, /* struct_bytes not set, or an unknown field set */
  STYLET_OUT_OF_MEMORY = 402,
  STYLET_FILE_UNREADABLE = 403,
  STYLET_CONTENT_DAMAGED = 404, /* the organ file does not match its checksum */
  STYLET_ARGUMENT_OUT_OF_RANGE = 405,
  STYLET_DEVICE_FAILED = 406,
  STYLET_LOOP_RUNS = 407 /* a loop has this simulation, or this loop was started before */
};
STYLET_API const char* stylet_status_name(stylet_status status);

#define STYLET_MAX_NEEDLES 4
#define STYLET_MAX_OBSTACLES 16
#define STYLET_MAX_HULL_VERTICES 64
#define STYLET_MAX_MATERIALS 64
#define STYLET_MAX_RODS 128
#define STYLET_MAX_CONSTRAINT_PARTICLES 128 /* of a needle's shaft; its tip has one more */
#define STYLET_MAX_TOUCHES 16               /* of a needle */
#define STYLET_MAX_EVENTS 64
#define STYLET_MAX_SUBSTEPS 32
#define STYLET_MAX_HELPERS 15
#define STYLET_NO_LAYER 0xFFFFFFFFU

/* What was refused, and why. */
typedef struct {
  uint32_t struct_bytes;
  stylet_status status;
  uint16_t reserved;
  char place[64]; /* part of the file, or a field such as "needle.length_m" */
  uint64_t index; /* of the element in that part, or of the needle or obstacle */
  double value;
  double least, most; /* accepted range, if a configuration was refused */
  char expected[96];  /* in words, if a file was refused */
  char text[256];     /* all of this as one line */
} stylet_refusal;

typedef struct {
  float x, y, z;
} stylet_vec3;
/* Unit quaternion, Hamilton's convention: it turns handle coordinates into world coordinates. */
typedef struct {
  float w, x, y, z;
} stylet_quat;
typedef struct {
  stylet_vec3 position_m;
  stylet_quat rotation;
} stylet_pose;

/* ==== Organ ================================================================================== */
typedef struct stylet_organ stylet_organ;

/* Checks structure, values and the file's checksum. */
STYLET_API stylet_status stylet_organ_read(const char* path, stylet_organ** organ_out,
                                           stylet_refusal* refusal_out);
/* The same for bytes in memory, which are copied. */
STYLET_API stylet_status stylet_organ_from_bytes(const void* bytes, size_t count,
                                                 stylet_organ** organ_out,
                                                 stylet_refusal* refusal_out);
/* Simulations that were made from it stay valid. */
STYLET_API void stylet_organ_free(stylet_organ* organ);

typedef struct {
  uint32_t struct_bytes;
  uint32_t format_version;
  uint64_t hash;    /* of all bytes */
  const char* name; /* valid as long as the organ */
  float voxel_edge_m;
  stylet_vec3 origin_m; /* corner of voxel (0, 0, 0) */
  uint32_t size_x, size_y, size_z;
  uint32_t voxels, vertices, triangles, materials;
  stylet_vec3 low_m, high_m; /* box around the surface at rest */
} stylet_organ_info;
STYLET_API stylet_status stylet_organ_get_info(const stylet_organ* organ,
                                               stylet_organ_info* info_out);

typedef struct {
  uint32_t struct_bytes;
  float density_kg_per_m3;
  const char* name; /* valid as long as the organ, as is source */
  const char* source;
  float youngs_modulus_pa, poisson_ratio;
  float relaxing_fraction, relaxation_time_s;
  float puncture_force_n, cutting_force_n, recut_fraction;
  float coulomb_friction_n_per_m, static_friction_n_per_m;
  float stribeck_velocity_m_per_s, viscous_friction_n_s_per_m2;
  float puncture_velocity_exponent;
  float membrane_n_per_m;
  float strain_stiffening;
  /* If above 0, forces follow from these and the needle, instead of the numbers above. */
  float fracture_toughness_j_per_m2, toughness_velocity_exponent;
  float needle_friction_coefficient;
  /* Fluid in the tissue: its pressure above the air's; its flow per pressure to or from a needle's
   * opening (0: none flows); its viscosity (0: that of the needle's filling). */
  float fluid_pressure_pa, fluid_conductance_m3_per_pa_s, fluid_viscosity_pa_s;
} stylet_material;
STYLET_API stylet_status stylet_organ_get_material(const stylet_organ* organ, uint32_t index,
                                                   stylet_material* material_out);

/* x, y, z: place in the organ's lattice. If voxels have several sizes, the levels lie one after the
 * other along z; voxel_edge_m is that of the coarsest, and stylet_organ_cubes has all. */
typedef struct {
  uint16_t x, y, z;
  uint8_t material, fixed; /* bit i: corner i is held, corner dx + 2 dy + 4 dz */
  float fill;              /* of the voxel, 0 to 1 */
} stylet_voxel;
STYLET_API uint32_t stylet_organ_voxels(const stylet_organ* organ, stylet_voxel* out,
                                        uint32_t capacity);
/* The space that a voxel takes up at rest, whatever its level; one for each, in the same order. */
typedef struct {
  stylet_vec3 low_m; /* its corner with the least x, y and z */
  float edge_m;
} stylet_cube;
STYLET_API uint32_t stylet_organ_cubes(const stylet_organ* organ, stylet_cube* out,
                                       uint32_t capacity);
/* Corners of the surface's triangles, three a triangle, counter-clockwise seen from outside.
 * `capacity` and result count triangles. */
STYLET_API uint32_t stylet_organ_triangles(const stylet_organ* organ, uint32_t* out,
                                           uint32_t capacity);
/* The vertices of the surface at rest, and the material of each. */
STYLET_API uint32_t stylet_organ_vertices(const stylet_organ* organ, stylet_vec3* out,
                                          uint32_t capacity);
STYLET_API uint32_t stylet_organ_vertex_materials(const stylet_organ* organ, uint8_t* out,
                                                  uint32_t capacity);
/* 1: the ray meets the surface at rest at this distance; 0: it does not. The direction need not
 * have unit length. Visits every triangle: not for the loop. */
STYLET_API int stylet_organ_raycast(const stylet_organ* organ, stylet_vec3 origin_m,
                                    stylet_vec3 direction, float* distance_out_m);

/* ==== Simulation ============================================================================= */
typedef struct {
  uint32_t struct_bytes;
  uint32_t mode; /* 0: every parameter a physical quantity; 1: the rules of the paper */
  float period_s;
  uint32_t substeps;
  uint32_t inertia; /* 0: mass is added where the step needs it; 1: tissue has its true mass */
  float tissue_damping_s;    /* Kelvin-Voigt time constant */
  float surround_drag_per_s; /* drag of what surrounds the organ, per mass */
  float hourglass_weight;
  float paper_alpha;                 /* mode 1: stiffness factor of goals, 0 to 1 */
  stylet_vec3 breathing_amplitude_m; /* of all attachments, A sin^4(pi t / T) */
  float breathing_period_s;
  stylet_vec3 gravity_m_per_s2; /* beyond that which shaped the organ; comes in over 1 s */
} stylet_config;
STYLET_API stylet_status stylet_config_init(stylet_config* config, size_t struct_bytes);

/* The needle leaves the handle along its -z; unbent, its tip is at (0, 0, -length_m) there. Bevel
 * and bend face the handle's +x. */
typedef struct {
  uint32_t struct_bytes;
  float length_m, outer_radius_m;
  /* Shaft length that one constraint particle carries, 0.1 to 50 mm; where it is longer than a
   * voxel's edge, the shaft is 10 to 26 % too soft sideways. */
  float unit_m;
  float bending_nm2; /* EI of the shaft; 0: rigid */
  uint32_t rods;     /* of the elastic chain */
  float bevel_per_m; /* curvature of the path a bevelled tip cuts in stiff tissue */
  float bent_length_m, bent_angle_rad; /* pre-bent tip */
  float torsion_nm2;                   /* GJ of the shaft; 0: the tip rolls with the hand */
  float tip_half_angle_rad;            /* half of the tip's included angle */
  /* Length of the crack that the tip tears, in outer diameters: 1 with edges, 1.5 a cone. Felt in
   * tissues whose toughness is given. */
  float torn_diameters;
  uint32_t hub; /* 0: closed, nothing flows; 1: open to the air; 2: a syringe */
  /* Only read if the hub is not closed. */
  float bore_radius_m;
  float opening_m;    /* its middle, from the tip */
  float filling_pa_s; /* viscosity of what needle and syringe are filled with */
  float plunger_radius_m, plunger_friction_n;
  float syringe_m3, syringe_filled; /* its volume, and the part that is full at the start */
  float syringe_gas_m3;             /* volume of gas in it, at the air's pressure */
} stylet_needle;
STYLET_API stylet_status stylet_needle_init(stylet_needle* needle, size_t struct_bytes);
/* Makes it the needle of this name, such as "22G-quincke": diameters, length, stiffness (it bends),
 * tip and opening; unit_m, rods, hub, filling and syringe stay. STYLET_ARGUMENT_OUT_OF_RANGE: no
 * needle has this name. */
STYLET_API stylet_status stylet_needle_preset(stylet_needle* needle, const char* name);
/* The names of the needles, by number from 0; null after the last. */
STYLET_API const char* stylet_needle_preset_name(uint32_t index);

/* A body that no needle enters: the convex hull of the vertices, grown by rounding_m. */
typedef struct {
  uint32_t struct_bytes;
  uint32_t vertex_count; /* 1: a sphere */
  stylet_pose pose;
  stylet_vec3 vertices_m[STYLET_MAX_HULL_VERTICES];
  float rounding_m;
  float stiffness_n_per_m; /* of a contact, normal and (sticking) tangential */
  float largest_force_n;   /* limit of the normal force as the needle is pressed in */
  float friction;          /* Coulomb coefficient */
} stylet_obstacle;
/* A sphere of 10 mm that is like bone: 20 N/mm, at most 50 N, friction 0.3. */
STYLET_API stylet_status stylet_obstacle_init(stylet_obstacle* obstacle, size_t struct_bytes);
STYLET_API stylet_status stylet_obstacle_box(stylet_obstacle* obstacle, stylet_vec3 half_m);
STYLET_API stylet_status stylet_obstacle_sphere(stylet_obstacle* obstacle, float radius_m);

typedef struct stylet_simulation stylet_simulation;

/* `needles` may be null for one default needle if needle_count is 0 or 1. */
STYLET_API stylet_status stylet_simulation_create(
    const stylet_organ* organ, const stylet_config* config, const stylet_needle* needles,
    uint32_t needle_count, stylet_simulation** simulation_out, stylet_refusal* refusal_out);
/* For hosts that provide all memory: how many bytes create_in needs, and creation in them. They
 * must neither move nor be freed before stylet_simulation_free, which does not free them. */
STYLET_API stylet_status stylet_simulation_bytes(const stylet_organ* organ,
                                                 const stylet_config* config,
                                                 const stylet_needle* needles,
                                                 uint32_t needle_count, size_t* bytes_out,
                                                 stylet_refusal* refusal_out);
STYLET_API stylet_status stylet_simulation_create_in(
    const stylet_organ* organ, const stylet_config* config, const stylet_needle* needles,
    uint32_t needle_count, void* memory, size_t bytes, stylet_simulation** simulation_out,
    stylet_refusal* refusal_out);
/* A second simulation in the same state, which shares the organ. */
STYLET_API stylet_status stylet_simulation_clone(const stylet_simulation* simulation,
                                                 stylet_simulation** simulation_out);
STYLET_API void stylet_simulation_free(stylet_simulation* simulation);

/* Bodies fixed in the world; they replace those given before. Only before the first tick. */
STYLET_API stylet_status stylet_simulation_set_obstacles(stylet_simulation* simulation,
                                                         const stylet_obstacle* obstacles,
                                                         uint32_t count,
                                                         stylet_refusal* refusal_out);
/* Back to tick 0: tissue at rest, needles away, no track. Obstacles stay. */
STYLET_API stylet_status stylet_simulation_reset(stylet_simulation* simulation);

typedef struct {
  uint32_t struct_bytes;
  uint32_t valid;     /* 0: no sample in this tick; the last one is used again, and counted */
  stylet_pose handle; /* of the needle's base, in the world */
  float plunger_n;    /* on a syringe's plunger, towards the needle */
} stylet_input;

enum { STYLET_FREE = 0, STYLET_CONTACT = 1, STYLET_INSERTED = 2, STYLET_RETRACTING = 3 };

enum {
  STYLET_FLAG_INPUT_NOT_FINITE = 1 << 0,
  STYLET_FLAG_INPUT_CLAMPED = 1 << 1, /* too fast, far or strong: the limit was used */
  STYLET_FLAG_INPUT_MISSING = 1 << 2,
  STYLET_FLAG_CP_POOL_FULL = 1 << 3,
  STYLET_FLAG_CP_VOXEL_POOL_FULL = 1 << 4,
  STYLET_FLAG_CONTACT_BUDGET = 1 << 5,
  STYLET_FLAG_OBSTACLE_POOL_FULL = 1 << 6,
  STYLET_FLAG_NEEDLE_UNSTABLE = 1 << 7
};
#define STYLET_FLAG_FAULT 0x80000000U /* latched: force is zero until reset */

/* Forces on the hand at the handle, in the world. */
typedef struct {
  uint32_t struct_bytes;
  uint32_t flags;
  uint64_t tick; /* ticks since reset, this one included */
  stylet_vec3 force_n, torque_nm;
  /* Parts of force_n: tip against a surface not yet punctured; tip in tissue, along the shaft;
   * shaft, along it; tip and shaft, across it; contact with obstacles. */
  stylet_vec3 stiffness_n, cutting_n, friction_n, clamping_n, obstacle_n;
  stylet_vec3 tip_m;
  float depth_m; /* of the tip along its track, in tissue at rest */
  uint32_t phase;
  uint32_t layer; /* material under the tip, or STYLET_NO_LAYER */
  uint32_t constraint_particles;
  uint32_t events;         /* since reset, of all needles */
  float stiffness_n_per_m; /* upper bound of the stiffness felt between two ticks */
  /* Fluid in a needle whose hub is not closed: pressures above the air's; flow and injected volume,
   * positive towards the tissue; way and speed of the plunger; part of the bore that is filled with
   * the tissue's fluid. */
  float opening_pa, hub_pa;
  float flow_m3_per_s, injected_m3;
  float plunger_m, plunger_m_per_s;
  float filled;
  uint32_t reserved;
} stylet_output;

/* One tick: input i moves needle i, and output i is its answer. Either count may be less than the
 * number of needles; a needle without input keeps its pose. */
STYLET_API stylet_status stylet_simulation_tick(stylet_simulation* simulation,
                                                const stylet_input* inputs, uint32_t input_count,
                                                stylet_output* outputs_out, uint32_t output_count);
/* Many ticks: inputs[tick][needle]. outputs_out[tick][needle] may be null. */
STYLET_API stylet_status stylet_simulation_run(stylet_simulation* simulation,
                                               const stylet_input* inputs,
                                               stylet_output* outputs_out, uint32_t ticks);

/* The pose at which an unbent needle of this length has its tip at tip_m and points in this
 * direction, which may have any length (zero: -z). */
STYLET_API stylet_pose stylet_pose_of_tip(stylet_vec3 tip_m, stylet_vec3 direction, float length_m);

/* ---- its state, to be shown */
STYLET_API uint32_t stylet_simulation_needles(const stylet_simulation* simulation);
/* The deformed surface: one position for each vertex of the organ. */
STYLET_API uint32_t stylet_simulation_surface(const stylet_simulation* simulation, stylet_vec3* out,
                                              uint32_t capacity);
/* A needle from handle to tip: rods + 1 places, 2 if it is rigid; none before its first pose. */
STYLET_API uint32_t stylet_simulation_needle_shape(const stylet_simulation* simulation,
                                                   uint32_t needle, stylet_vec3* out,
                                                   uint32_t capacity);
/* The displacement of each particle of the lattice from its place at rest. */
STYLET_API uint32_t stylet_simulation_particles(const stylet_simulation* simulation,
                                                stylet_vec3* moved_out_m, uint32_t capacity);
/* Eight particles for each voxel of the organ, corner dx + 2 dy + 4 dz. `capacity` and result
 * count particles. */
STYLET_API uint32_t stylet_simulation_voxel_corners(const stylet_simulation* simulation,
                                                    uint32_t* out, uint32_t capacity);

typedef struct {
  stylet_vec3 position_m, goal_m, force_on_needle_n;
  float arc_length_m; /* from the tip */
  uint32_t is_tip, needle;
} stylet_constraint_particle;
STYLET_API uint32_t stylet_simulation_constraint_particles(const stylet_simulation* simulation,
                                                           stylet_constraint_particle* out,
                                                           uint32_t capacity);
typedef struct {
  stylet_vec3 position_m, normal, force_on_needle_n;
  uint32_t obstacle, needle;
} stylet_obstacle_touch;
STYLET_API uint32_t stylet_simulation_obstacle_touches(const stylet_simulation* simulation,
                                                       stylet_obstacle_touch* out,
                                                       uint32_t capacity);

enum {
  STYLET_EVENT_CONTACT = 0,
  STYLET_EVENT_RELEASE = 1, /* contact was lost without a puncture */
  STYLET_EVENT_PUNCTURE = 2,
  STYLET_EVENT_REENTRY = 3, /* the tip entered an existing track */
  STYLET_EVENT_EXIT = 4,
  STYLET_EVENT_LAYER = 5,             /* the tip crossed into another material */
  STYLET_EVENT_OBSTACLE = 6,          /* the needle touched an obstacle */
  STYLET_EVENT_FLASHBACK = 7,         /* fluid of the tissue has come to the hub */
  STYLET_EVENT_LOSS_OF_RESISTANCE = 8 /* a pressed plunger gives way in the tissue */
};
STYLET_API const char* stylet_event_name(uint32_t kind);
typedef struct {
  uint64_t tick;
  uint32_t kind, layer;
  float depth_m, force_n; /* force along the shaft; of the last two kinds, on the plunger */
  uint32_t needle, reserved;
} stylet_event;
/* The newest events, oldest first. Returns how many it wrote. */
STYLET_API uint32_t stylet_simulation_events(const stylet_simulation* simulation, stylet_event* out,
                                             uint32_t capacity);

/* ---- its counters, energy and mass */
typedef struct {
  uint32_t used, used_max, capacity;
} stylet_pool;
typedef struct {
  uint32_t struct_bytes;
  uint32_t filter_passes; /* in a substep, with true mass */
  uint64_t ticks;
  stylet_pool constraint_particles, coupled_voxels, tracks, obstacle_contacts;
  uint64_t input_not_finite, input_clamped, input_missing;
  uint64_t cp_pool_full, cp_voxel_pool_full, contact_budget, fault;
  uint64_t obstacle_pool_full, needle_unstable;
  float coupling_shortfall; /* largest missing part of a constraint particle's stiffness */
  float unit_in_voxels;     /* the longest needle unit, in voxel edges */
} stylet_stats;
STYLET_API stylet_status stylet_simulation_get_stats(const stylet_simulation* simulation,
                                                     stylet_stats* stats_out);
typedef struct {
  uint32_t struct_bytes;
  uint32_t reserved;
  double elastic_j, kinetic_j, coupling_j, bending_j;
  double work_by_hand_j; /* since reset */
  /* Dissipated since reset, by constraint particles and by contacts with obstacles. */
  double friction_j, cutting_j, relaxation_j, obstacles_j;
  double sliding_j; /* dissipated by parts of the organ that slide on each other */
} stylet_energy;
STYLET_API stylet_status stylet_simulation_get_energy(const stylet_simulation* simulation,
                                                      stylet_energy* energy_out);
/* The mass of a material, and the mass that the step computes with (more if mass is added). */
STYLET_API stylet_status stylet_simulation_get_mass(const stylet_simulation* simulation,
                                                    uint32_t material, float* real_out_kg,
                                                    float* stepped_out_kg);

/* ---- to save, restore and compare it */
STYLET_API uint64_t stylet_simulation_hash(const stylet_simulation* simulation);
STYLET_API size_t stylet_simulation_snapshot_bytes(const stylet_simulation* simulation);
STYLET_API stylet_status stylet_simulation_snapshot(const stylet_simulation* simulation, void* out,
                                                    size_t bytes);
/* Refuses bytes that are not a snapshot with this organ, configuration and obstacles. */
STYLET_API stylet_status stylet_simulation_restore(stylet_simulation* simulation, const void* in,
                                                   size_t bytes);
/* Name of the first field of the state that differs ("organ", "config"); null: none does. */
STYLET_API const char* stylet_simulation_difference(const stylet_simulation* a,
                                                    const stylet_simulation* b,
                                                    uint64_t* index_out);

/* ---- threads of the host that take part in the tissue step */
/* How many threads call help; 0: none may. Not while one is in it. Bits do not depend on it. */
STYLET_API stylet_status stylet_simulation_set_helpers(stylet_simulation* simulation,
                                                       uint32_t helpers);
/* Looks `looks` times (about 40 ns each) for a part of the step, and computes it; 1: it found one.
 * Helpers need the priority and the floating-point mode of the thread that ticks. */
STYLET_API int stylet_simulation_help(stylet_simulation* simulation, uint32_t looks);

/* ==== Batch: many simulations at once ======================================================== */
typedef struct stylet_batch stylet_batch;

/* threads 0: one for each processor. As long as the batch exists, use its simulations only through
 * it or between its calls. */
STYLET_API stylet_status stylet_batch_create(stylet_simulation* const* simulations, uint32_t count,
                                             uint32_t threads, stylet_batch** batch_out);
STYLET_API void stylet_batch_free(stylet_batch* batch);
/* The number of needles of all simulations together. */
STYLET_API uint32_t stylet_batch_needles(const stylet_batch* batch);
/* Many ticks of each: inputs[simulation][tick][needle], outputs_out likewise, or null. */
STYLET_API stylet_status stylet_batch_run(stylet_batch* batch, const stylet_input* inputs,
                                          stylet_output* outputs_out, uint32_t ticks);

#ifdef __cplusplus
}
#endif
#endif
