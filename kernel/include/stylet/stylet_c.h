/* SPDX-License-Identifier: Apache-2.0 */
/* The kernel for callers that are not C++: Unity, Unreal, Python, MATLAB, C. Plain C99, no
 * callbacks, no ownership: the caller gives all memory. Same promises, units (SI) and frames as
 * stylet/kernel.h, which documents every field; enumerations have the same numbers. Functions that
 * return uint16_t return a status: 0 is ok, stylet_status_name names every other one. */
#ifndef STYLET_STYLET_C_H
#define STYLET_STYLET_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes when a struct or function below changes; compare with stylet_c_version(). */
#define STYLET_C_VERSION 3
#define STYLET_MAX_NEEDLES 4
#define STYLET_MAX_HULL_VERTICES 64

typedef struct {
  float x, y, z;
} stylet_vec3;
typedef struct {
  float w, x, y, z;
} stylet_quat;
typedef struct {
  stylet_vec3 position_m;
  stylet_quat rotation;
} stylet_pose;

typedef struct {
  float length_m, outer_radius_m, unit_m;
  float bending_nm2;
  uint32_t rods;
  float bevel_per_m, bent_length_m, bent_angle_rad, torsion_nm2, tip_half_angle_rad;
} stylet_needle_config;

typedef struct {
  stylet_vec3 amplitude_m;
  float period_s;
} stylet_breathing_config;

typedef struct {
  stylet_pose pose;
  uint32_t vertex_count;
  stylet_vec3 vertices_m[STYLET_MAX_HULL_VERTICES];
  float rounding_m, stiffness_n_per_m, largest_force_n, friction;
} stylet_obstacle_config;

typedef struct {
  uint32_t mode; /* 0 physical, 1 paper */
  float period_s;
  uint32_t substeps;
  uint32_t inertia; /* 0 mass is added, 1 true mass */
  float tissue_damping_s;
  float surround_drag_per_s;
  float hourglass_weight;
  float paper_alpha;
  uint32_t needle_count;
  stylet_needle_config needle[STYLET_MAX_NEEDLES];
  stylet_breathing_config breathing;
} stylet_config;

typedef struct {
  size_t model_bytes, state_bytes, scratch_bytes;
} stylet_sizes;

/* Storage for the C++ objects; treat as opaque. Both may be moved and copied byte by byte, as
 * managed hosts do; a copy of a kernel is the same kernel. The organ's bytes must outlive organ and
 * kernel; the three blocks (aligned to 64 bytes) must outlive the kernel; neither may move. The
 * kernel does not need the stylet_organ after its creation. */
typedef struct {
  uint64_t opaque[40];
} stylet_organ;
typedef struct {
  uint64_t opaque[12];
} stylet_kernel;

typedef struct {
  stylet_pose handle;
  uint32_t valid;
} stylet_input;

typedef struct {
  stylet_vec3 stiffness_n, cutting_n, friction_n, clamping_n, obstacle_n;
} stylet_force_by_cause;

typedef struct {
  uint64_t tick;
  stylet_vec3 force_n, torque_nm;
  stylet_force_by_cause cause;
  stylet_vec3 tip_m;
  float depth_m;
  uint32_t phase, layer, constraint_particles, flags, events;
  float stiffness_n_per_m;
} stylet_output;

typedef struct {
  uint64_t tick;
  uint32_t kind, layer;
  float depth_m, force_n;
  uint32_t needle, reserved;
} stylet_event;

uint32_t stylet_c_version(void);
const char* stylet_status_name(uint16_t status);
const char* stylet_event_name(uint32_t kind);
void stylet_default_config(stylet_config* config_out);

uint16_t stylet_organ_open(const void* bytes, size_t count, stylet_organ* organ_out);
uint16_t stylet_kernel_sizes(const stylet_organ* organ, const stylet_config* config,
                             stylet_sizes* sizes_out);
uint16_t stylet_kernel_create(const stylet_organ* organ, const stylet_config* config, void* model,
                              size_t model_bytes, void* state, size_t state_bytes, void* scratch,
                              size_t scratch_bytes, stylet_kernel* kernel_out);
void stylet_kernel_reset(stylet_kernel* kernel);
void stylet_kernel_tick(stylet_kernel* kernel, const stylet_input* input,
                        stylet_output* output_out);
/* One input and one output for each of `count` needles. */
void stylet_kernel_tick_all(stylet_kernel* kernel, const stylet_input* inputs,
                            stylet_output* outputs_out, uint32_t count);
uint16_t stylet_kernel_set_obstacles(stylet_kernel* kernel, const stylet_obstacle_config* obstacles,
                                     uint32_t count);

/* Both return how many were written. */
uint32_t stylet_kernel_events(const stylet_kernel* kernel, stylet_event* out, uint32_t capacity);
uint32_t stylet_kernel_surface(const stylet_kernel* kernel, stylet_vec3* out, uint32_t capacity);

uint64_t stylet_kernel_hash(const stylet_kernel* kernel);
size_t stylet_kernel_snapshot_bytes(const stylet_kernel* kernel);
uint16_t stylet_kernel_snapshot(const stylet_kernel* kernel, void* out, size_t bytes);
uint16_t stylet_kernel_restore(stylet_kernel* kernel, const void* in, size_t bytes);

#ifdef __cplusplus
}
#endif
#endif
