/* SPDX-License-Identifier: Apache-2.0 */
/* The hand's side of Stylet: the guard that keeps a force safe, haptic devices, and the loop that
 * runs a simulation with its period (it draws nothing). stylet.h has the rules of structs, errors
 * and handles.
 *
 * If Stylet opens the device, or calls functions of yours that read and write one, use the loop:
 * the guard is part of it. If a loop of your own drives the device, pass every force through a
 * guard. hal/guard/GUARD.md has the guard's states and limits. */
#ifndef STYLET_STYLET_LOOP_H
#define STYLET_STYLET_LOOP_H

#include <stylet/stylet.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ==== Guard ================================================================================== */

/* Why a guard lets no force through. Numbers never change meaning. */
enum {
  STYLET_FAULT_NONE = 0,
  STYLET_FAULT_FORCE_NOT_FINITE = 1,
  STYLET_FAULT_STALE_SAMPLES = 2, /* the device answers, but with nothing new or usable */
  STYLET_FAULT_DEVICE_SILENT = 3,
  STYLET_FAULT_TOO_LATE = 4, /* the loop missed too many ticks */
  STYLET_FAULT_KERNEL = 5,
  STYLET_FAULT_TOO_FAST = 6,     /* the device moved faster than a hand can, or jumped */
  STYLET_FAULT_BUZZ = 7,         /* the force swings faster than a hand can */
  STYLET_FAULT_ENERGY = 8,       /* the hand was given energy, and damping could not stop it */
  STYLET_FAULT_FORCE_EXPIRED = 9 /* the motors got no order in time and have stopped */
};
STYLET_API const char* stylet_fault_name(uint32_t fault);

enum {
  STYLET_GUARD_LET_GO = 0,  /* no force: the dead man's button must be seen released */
  STYLET_GUARD_UNARMED = 1, /* no force: the button must be pressed */
  STYLET_GUARD_RAMP = 2,    /* force fades in */
  STYLET_GUARD_LIVE = 3,
  STYLET_GUARD_RELEASE = 4, /* the button was released: force fades out */
  STYLET_GUARD_FADING = 5,  /* a fault is latched: force fades out */
  STYLET_GUARD_FAULT = 6    /* a fault is latched: no force */
};
STYLET_API const char* stylet_guard_mode_name(uint32_t mode);

typedef struct {
  uint32_t struct_bytes;
  float period_s;
  float max_force_n;
  float max_slew_n_per_s; /* at least max_force_n / 0.02 s, so that a fault can fade in time */
  float ramp_s;           /* after arming */
  float watchdog_s;       /* longest time without a new usable sample */
  float max_speed_m_per_s;
  float buzz_n;             /* amplitude */
  float continuous_force_n; /* root mean square over thermal_s that the motors bear */
  float thermal_s;
  int32_t dead_man_button;    /* -1: there is none, and the guard is armed from the start */
  int32_t acknowledge_button; /* pressing it anew acknowledges a latched fault; -1: none */
  /* The device itself: what it dissipates, how finely it measures, how late it answers. */
  float device_mass_kg, device_damping_n_s_per_m, device_friction_n;
  float device_resolution_m, device_delay_s;
  float stored_energy_j;             /* the most that the tissue can give back */
  float passivity_damping_n_s_per_m; /* the largest damping that the guard adds; 0: none */
  float max_torque_nm;               /* 0: no torque is let through */
} stylet_guard_config;
/* For an unknown device. */
STYLET_API stylet_status stylet_guard_config_init(stylet_guard_config* config, size_t struct_bytes);
/* For a known model, such as "touch" or "omega.7"; STYLET_ARGUMENT_OUT_OF_RANGE for others. */
STYLET_API stylet_status stylet_guard_config_for(stylet_guard_config* config, const char* model);
/* The names of the known models, by number from 0; null after the last. */
STYLET_API const char* stylet_device_model(uint32_t index);

typedef struct {
  uint32_t struct_bytes;
  uint32_t buttons; /* bit i: button i is pressed */
  uint64_t seq;     /* grows with every new sample */
  int64_t t_ns;     /* when it was taken, on the clock of now_ns */
  stylet_pose pose; /* of the handle, in the device's frame */
  float plunger_n;  /* on a syringe's plunger, of a device that has one */
} stylet_sample;

typedef struct {
  stylet_vec3 force_n, torque_nm; /* that the motors have */
  uint32_t arming;                /* of the newest order that they follow */
  uint32_t stopped;               /* orders of this arming no longer move anything */
} stylet_motor_report;

typedef struct stylet_guard stylet_guard;
STYLET_API stylet_status stylet_guard_create(const stylet_guard_config* config,
                                             stylet_guard** guard_out, stylet_refusal* refusal_out);
STYLET_API void stylet_guard_free(stylet_guard* guard);

/* Call these once a tick, in this order. None allocates, locks or makes a system call. All forces
 * act on the hand and are in the device's frame. Before the first usable sample the force is zero;
 * without a call of stylet_guard_sample in between it stays as it was, or goes on fading. */
/* Call this if the motors tell what force they have. */
STYLET_API stylet_status stylet_guard_motor(stylet_guard* guard, const stylet_motor_report* report);
/* 1: the simulation may use the sample. A null sample: the device did not answer. `now_ns` may come
 * from any clock that runs forwards; a period of the guard should pass between two calls. If 20 ms
 * are lost, at once or bit by bit, or the clock runs backwards, there is a fault:
 * STYLET_FAULT_TOO_LATE. If the clock stands still: STYLET_FAULT_STALE_SAMPLES. */
STYLET_API int stylet_guard_sample(stylet_guard* guard, const stylet_sample* sample,
                                   int64_t now_ns);
/* What to send instead of `force_n`. */
STYLET_API stylet_vec3 stylet_guard_force(stylet_guard* guard, stylet_vec3 force_n);
/* The same for a torque, after the force. */
STYLET_API stylet_vec3 stylet_guard_torque(stylet_guard* guard, stylet_vec3 torque_nm);
/* Call this instead of the others at the end of a run, until it returns 1: then the force has
 * faded, within 20 ms of `now_ns`, which is the clock of stylet_guard_sample. The report has the
 * force to send meanwhile. If the clock stands or runs backwards, each call counts as a period, so
 * that the end comes in any case. */
STYLET_API int stylet_guard_end(stylet_guard* guard, int64_t now_ns);

/* Latches a fault that the caller has noticed. */
STYLET_API stylet_status stylet_guard_trip(stylet_guard* guard, uint32_t fault);
/* Acknowledges the fault that somebody has seen. 1: it was the latched one; the guard begins anew.
 */
STYLET_API int stylet_guard_rearm(stylet_guard* guard, uint32_t fault_seen);

typedef struct {
  uint32_t struct_bytes;
  uint32_t mode, fault;
  uint32_t fault_number;          /* counts all faults of this guard, from 1; 0: none is latched */
  uint32_t arming;                /* grows each time the guard begins anew */
  uint32_t falls;                 /* 1: the force is being taken away, and must not grow */
  stylet_vec3 force_n, torque_nm; /* let through last */
  double energy_j;                /* that the hand has given, less what it got back */
  uint64_t samples_used, samples_missing, samples_repeated, samples_lost, samples_old;
  uint64_t samples_not_finite, samples_absurd, samples_jumped;
  uint64_t force_not_finite, force_limited, slew_limited, force_warm, force_damped;
  uint64_t faults, rearms;
} stylet_guard_report;
STYLET_API stylet_status stylet_guard_get_report(const stylet_guard* guard,
                                                 stylet_guard_report* report_out);

/* ==== Devices ================================================================================ */

typedef struct stylet_device stylet_device;

/* By URI, such as "hd:", "dhd:" or "udp:...": those that `stylet devices` lists, except haply:.
 * Waits up to patience_s for the device, or without limit if that is infinite. A device that fails
 * is opened again, by a thread other than the loop's. */
STYLET_API stylet_status stylet_device_open(const char* uri, double patience_s,
                                            stylet_device** device_out,
                                            stylet_refusal* refusal_out);

typedef struct {
  uint32_t struct_bytes;
  uint32_t arming; /* grows each time the guard begins anew */
  stylet_vec3 force_n, torque_nm;
  stylet_vec3 place_m;     /* of the sample for which the force was computed */
  float stiffness_n_per_m; /* by which the force falls as the device moves away from there */
  float max_force_n;
  uint32_t falls; /* 1: the guard is taking force away, and it must not grow */
  int64_t end_ns; /* when the force must be gone, CLOCK_MONOTONIC; 0: it only ages */
  stylet_vec3 tip_m, tip_direction; /* of the needle, in the device's frame */
} stylet_command;

/* A device of the caller's own. Its functions are called in the loop's thread, and must not wait.
 * If they are written in a managed language (C#, Python), its garbage collector may stop them; to
 * the guard the loop is then late. */
typedef struct {
  uint32_t struct_bytes;
  uint32_t reserved;
  void* self;
  /* 1: sample_out was filled; its struct_bytes stays. 0: no answer this time. */
  int (*read)(void* self, int64_t now_ns, stylet_sample* sample_out);
  void (*write)(void* self, const stylet_command* command);
  /* 1: report_out was filled. May be null, if the device does not tell. */
  int (*motor)(void* self, stylet_motor_report* report_out);
  float max_force_n; /* 0: it renders no force */
  float max_slew_n_per_s;
  float max_stiffness_n_per_m; /* that it renders without buzzing; 0: unknown */
  float continuous_force_n;    /* that its motors bear without limit of time; 0: unknown */
  float max_torque_nm;
  float force_life_s; /* time after its sample at which a force ends by itself; 0: it does not */
} stylet_device_functions;
STYLET_API stylet_status stylet_device_from_functions(const stylet_device_functions* functions,
                                                      stylet_device** device_out,
                                                      stylet_refusal* refusal_out);
/* A simulated hand: a mass on a spring that goes straight in along -z of its frame, stays there for
 * hold_s, and comes back. For trials without a device, and for tests. */
STYLET_API stylet_status stylet_device_simulated(float travel_m, float speed_m_per_s, float hold_s,
                                                 stylet_device** device_out);
/* Does nothing to a device that a loop has: it is closed when the loop is freed. */
STYLET_API void stylet_device_close(stylet_device* device);

/* ==== Loop =================================================================================== */

typedef struct {
  uint32_t struct_bytes;
  int32_t processor;         /* -1: an isolated one if there is one, otherwise the last */
  int32_t priority;          /* of SCHED_FIFO; 0: an ordinary thread */
  uint32_t helpers;          /* threads that take part in the tissue step */
  uint64_t ticks;            /* 0: until it is stopped */
  uint32_t virtual_time;     /* 1: as fast as it can, for trials; not with a real device */
  uint32_t lock_memory;      /* 1: locks all memory of this process: no page fault delays it */
  uint32_t show_every_ticks; /* how often the state that is shown is renewed */
} stylet_loop_config;
STYLET_API stylet_status stylet_loop_config_init(stylet_loop_config* config, size_t struct_bytes);

/* How a device holds a needle. */
typedef struct {
  uint32_t struct_bytes;
  int32_t clutch_button; /* while it is pressed the needle waits; -1: none */
  /* Where the needle's base begins, in the world, wherever the device is; from there it follows the
   * device. (A simulated hand begins at its own origin.) The device's axes are x right, y up, z
   * toward the operator; the needle points along -z. */
  stylet_pose start;
  float motion_scale, force_scale;  /* motion of needle / device, force on hand / needle */
  float coupling_stiffness_n_per_m; /* spring between device and needle; 0: as the device allows */
} stylet_hand;
STYLET_API stylet_status stylet_hand_init(stylet_hand* hand, size_t struct_bytes);

typedef struct stylet_loop stylet_loop;

/* The loop keeps the simulation: until the loop is freed, nothing else may tick it. `devices` and
 * `hands` have one element for each needle; so has `guards`, or it is null for the limits that each
 * device states. In either case the stricter of the guard's and the device's limits counts. The
 * loop closes the devices. */
STYLET_API stylet_status stylet_loop_create(stylet_simulation* simulation,
                                            const stylet_loop_config* config,
                                            stylet_device* const* devices, const stylet_hand* hands,
                                            const stylet_guard_config* guards,
                                            stylet_loop** loop_out, stylet_refusal* refusal_out);
/* A loop runs once. In a thread of its own: */
STYLET_API stylet_status stylet_loop_start(stylet_loop* loop);
/* Or in the caller's thread, until the ticks are done or another thread stops it. That thread keeps
 * the processor and the priority that it got for this. */
STYLET_API stylet_status stylet_loop_run(stylet_loop* loop);
/* Asks the loop to end: forces fade in at most 20 ms. From any thread. */
STYLET_API void stylet_loop_ask_to_stop(stylet_loop* loop);
/* Waits until the loop has ended. */
STYLET_API stylet_status stylet_loop_wait(stylet_loop* loop);
/* Stops the loop, waits for it and for the threads in run and wait, and closes its devices; then
 * the simulation can be ticked again. No other call for the loop may begin meanwhile. Called from a
 * function of a device, it only asks the loop to stop. */
STYLET_API void stylet_loop_free(stylet_loop* loop);
/* paused 1: needles wait and forces fade; 0: the loop goes on. From any thread. */
STYLET_API void stylet_loop_pause(stylet_loop* loop, int paused);

/* ---- its state, to be shown by one thread other than the loop's, while it runs or later */

/* 1: took the newest state that is to be shown; 0: there is nothing new since the last call. The
 * functions below tell about the state that was taken last. */
STYLET_API int stylet_loop_take(stylet_loop* loop);
STYLET_API stylet_status stylet_loop_get_output(const stylet_loop* loop, uint32_t needle,
                                                stylet_output* output_out);
STYLET_API uint32_t stylet_loop_surface(const stylet_loop* loop, stylet_vec3* out,
                                        uint32_t capacity);
STYLET_API uint32_t stylet_loop_needle_shape(const stylet_loop* loop, uint32_t needle,
                                             stylet_vec3* out, uint32_t capacity);
typedef struct {
  uint32_t struct_bytes;
  uint32_t mode, fault, fault_number; /* of the hand's guard */
  stylet_vec3 sent_force_n;           /* to the device, in its frame */
  uint32_t answered;                  /* 1: the device gave a sample */
  uint32_t reserved;
} stylet_hand_report;
STYLET_API stylet_status stylet_loop_get_hand(const stylet_loop* loop, uint32_t needle,
                                              stylet_hand_report* report_out);
/* Events since the last call, oldest first; returns how many it wrote. */
STYLET_API uint32_t stylet_loop_events(stylet_loop* loop, stylet_event* out, uint32_t capacity);

/* Says that somebody has seen this fault: once the force is gone, the guard begins anew. */
STYLET_API stylet_status stylet_loop_acknowledge(stylet_loop* loop, uint32_t needle, uint32_t fault,
                                                 uint32_t fault_number);

typedef struct {
  uint32_t struct_bytes;
  uint32_t runs; /* 1: the loop has not ended */
  uint64_t ticks, missed_ticks, lost_events;
  uint64_t tick_p50_ns, tick_p999_ns, tick_max_ns; /* from reading the device to writing */
  uint64_t late_p50_ns, late_p999_ns, late_max_ns; /* how late the loop woke up */
} stylet_loop_report;
/* The times are known when the loop has ended; before that they are zero. */
STYLET_API stylet_status stylet_loop_get_report(const stylet_loop* loop,
                                                stylet_loop_report* report_out);
/* What this machine refused the loop, so that it was not real-time: a line for each; empty:
 * nothing. Known when the loop has ended. */
STYLET_API const char* stylet_loop_lacks(const stylet_loop* loop);
/* Why a needle's device does not answer; empty: it does. Valid until the next such call. */
STYLET_API const char* stylet_loop_trouble(stylet_loop* loop, uint32_t needle);

#ifdef __cplusplus
}
#endif
#endif
