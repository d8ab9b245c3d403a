/* SPDX-License-Identifier: Apache-2.0 */
/* The hand's side of Stylet: the guard that keeps a force safe, haptic devices, and the loop that
 * runs a simulation at its period and draws nothing. Rules of structs, errors, handles: stylet.h.
 *
 * Who lets Stylet open the device, or gives it functions that read and write one, uses the loop: it
 * has the guard in it. Who drives a device in a loop of their own passes every force through a
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
  int32_t dead_man_button;    /* -1: there is none, armed from the start */
  int32_t acknowledge_button; /* pressing it anew acknowledges what is latched; -1: none */
  /* What the device itself dissipates, how well it knows where it is, when it answers. */
  float device_mass_kg, device_damping_n_s_per_m, device_friction_n;
  float device_resolution_m, device_delay_s;
  float stored_energy_j;             /* how much the tissue may give back */
  float passivity_damping_n_s_per_m; /* largest damping that is added; 0: none */
  float max_torque_nm;               /* 0: no torque is let through */
} stylet_guard_config;
/* For a device that is not known. */
STYLET_API stylet_status stylet_guard_config_init(stylet_guard_config* config, size_t struct_bytes);
/* For a known model of device: "touch", "omega.7" and so on; others: ARGUMENT_OUT_OF_RANGE. */
STYLET_API stylet_status stylet_guard_config_for(stylet_guard_config* config, const char* model);
/* Name of a known model; null behind the last. */
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

/* Once a tick, in this order; none allocates, locks or makes a system call. All forces are in the
 * device's frame, on the hand. Before the first sample that may be used the force is zero; without
 * a call of stylet_guard_sample in between it stays what it was, or goes on fading. */
/* If the motors tell what force they have. */
STYLET_API stylet_status stylet_guard_motor(stylet_guard* guard, const stylet_motor_report* report);
/* 1: the simulation may use the sample. Null: the device did not answer. `now_ns` of any clock that
 * runs on, of which a period of the guard's should pass between two calls. 20 ms that are lost, at
 * once or bit by bit, are STYLET_FAULT_TOO_LATE, and so is a clock that runs backwards; one that
 * stands is STYLET_FAULT_STALE_SAMPLES. */
STYLET_API int stylet_guard_sample(stylet_guard* guard, const stylet_sample* sample,
                                   int64_t now_ns);
/* What to send instead of `force_n`. */
STYLET_API stylet_vec3 stylet_guard_force(stylet_guard* guard, stylet_vec3 force_n);
/* The same for a torque, after the force. */
STYLET_API stylet_vec3 stylet_guard_torque(stylet_guard* guard, stylet_vec3 torque_nm);
/* Instead of them at the end of a run, until it returns 1: the force has faded, 20 ms later by
 * `now_ns`, which is the clock of stylet_guard_sample. What is still to be sent is in the report.
 * To a clock that stands or goes back each call is a period, so that the end comes in any case. */
STYLET_API int stylet_guard_end(stylet_guard* guard, int64_t now_ns);

/* Latches a fault of the caller's own. */
STYLET_API stylet_status stylet_guard_trip(stylet_guard* guard, uint32_t fault);
/* 1: the fault that somebody has seen was the latched one, and the guard begins anew. */
STYLET_API int stylet_guard_rearm(stylet_guard* guard, uint32_t fault_seen);

typedef struct {
  uint32_t struct_bytes;
  uint32_t mode, fault;
  uint32_t fault_number;          /* counts all faults of this guard, from 1; 0: none is latched */
  uint32_t arming;                /* grows each time the guard begins anew */
  uint32_t falls;                 /* 1: the force is being taken away and must not grow */
  stylet_vec3 force_n, torque_nm; /* let through last */
  double energy_j;                /* that the hand has put in, less what it got back */
  uint64_t samples_used, samples_missing, samples_repeated, samples_lost, samples_old;
  uint64_t samples_not_finite, samples_absurd, samples_jumped;
  uint64_t force_not_finite, force_limited, slew_limited, force_warm, force_damped;
  uint64_t faults, rearms;
} stylet_guard_report;
STYLET_API stylet_status stylet_guard_get_report(const stylet_guard* guard,
                                                 stylet_guard_report* report_out);

/* ==== Devices ================================================================================ */

typedef struct stylet_device stylet_device;

/* By URI, as `stylet devices` lists them but for Haply's: "hd:", "dhd:", "udp:..." and so on. Waits
 * up to patience_s for it; with an infinity until it is there. A device that fails is opened again
 * by a thread that is not the loop's. */
STYLET_API stylet_status stylet_device_open(const char* uri, double patience_s,
                                            stylet_device** device_out,
                                            stylet_refusal* refusal_out);

typedef struct {
  uint32_t struct_bytes;
  uint32_t arming; /* grows each time the guard begins anew */
  stylet_vec3 force_n, torque_nm;
  stylet_vec3 place_m;     /* of the sample for which the force was computed */
  float stiffness_n_per_m; /* with which the force falls as the device moves away from there */
  float max_force_n;
  uint32_t falls; /* the guard takes force away: it must not grow */
  int64_t end_ns; /* the force must be gone by then, CLOCK_MONOTONIC; 0: it only ages */
  stylet_vec3 tip_m, tip_direction; /* of the needle, in the device's frame */
} stylet_command;

/* A device of the caller's own. Its functions are called in the loop's thread: they must not wait.
 * A function of a managed language (C#, Python) may be stopped by its collector: then the guard
 * sees a late loop. */
typedef struct {
  uint32_t struct_bytes;
  uint32_t reserved;
  void* self;
  /* 1: sample_out was filled; its struct_bytes stays. 0: no answer this time. */
  int (*read)(void* self, int64_t now_ns, stylet_sample* sample_out);
  void (*write)(void* self, const stylet_command* command);
  /* 1: report_out was filled. May be null: the device does not tell. */
  int (*motor)(void* self, stylet_motor_report* report_out);
  float max_force_n; /* 0: it renders none */
  float max_slew_n_per_s;
  float max_stiffness_n_per_m; /* that it renders without buzzing; 0: unknown */
  float continuous_force_n;    /* that its motors bear for ever; 0: unknown */
  float max_torque_nm;
  float force_life_s; /* a force ends by itself so long after its sample; 0: it does not */
} stylet_device_functions;
STYLET_API stylet_status stylet_device_from_functions(const stylet_device_functions* functions,
                                                      stylet_device** device_out,
                                                      stylet_refusal* refusal_out);
/* A hand that is computed: a mass on a spring that goes straight in along -z of its frame, holds,
 * and comes back. For trials without a device, and for tests. */
STYLET_API stylet_status stylet_device_simulated(float travel_m, float speed_m_per_s, float hold_s,
                                                 stylet_device** device_out);
/* A device that a loop has is closed when the loop is freed, and by nothing else. */
STYLET_API void stylet_device_close(stylet_device* device);

/* ==== Loop =================================================================================== */

typedef struct {
  uint32_t struct_bytes;
  int32_t processor;         /* -1: an isolated one if there is one, else the last */
  int32_t priority;          /* of SCHED_FIFO; 0: none is asked for */
  uint32_t helpers;          /* threads that take part in the tissue step */
  uint64_t ticks;            /* 0: until it is stopped */
  uint32_t virtual_time;     /* 1: as fast as it can, for trials; not with a real device */
  uint32_t lock_memory;      /* 1: locks all memory of this process, so that no page is late */
  uint32_t show_every_ticks; /* how often what is seen of it is renewed */
} stylet_loop_config;
STYLET_API stylet_status stylet_loop_config_init(stylet_loop_config* config, size_t struct_bytes);

/* How a device holds a needle. */
typedef struct {
  uint32_t struct_bytes;
  int32_t clutch_button; /* while it is pressed the needle waits; -1: none */
  /* Where the needle's base begins, in the world, wherever the device is; from there it follows the
   * device. (A computed hand begins at its own origin.) The device's axes are x right, y up, z
   * toward the operator; the needle points along -z. */
  stylet_pose start;
  float motion_scale, force_scale;  /* needle's motion over device's, hand's force over needle's */
  float coupling_stiffness_n_per_m; /* spring between device and needle; 0: what the device bears */
} stylet_hand;
STYLET_API stylet_status stylet_hand_init(stylet_hand* hand, size_t struct_bytes);

typedef struct stylet_loop stylet_loop;

/* The loop keeps the simulation; until it is freed nothing else ticks it. `devices` and `hands`:
 * one for each needle; `guards` too, or null for what each device says of itself. In either case
 * the stricter of the guard's and the device's limits counts. The loop closes the devices. */
STYLET_API stylet_status stylet_loop_create(stylet_simulation* simulation,
                                            const stylet_loop_config* config,
                                            stylet_device* const* devices, const stylet_hand* hands,
                                            const stylet_guard_config* guards,
                                            stylet_loop** loop_out, stylet_refusal* refusal_out);
/* A loop runs once. In a thread of its own: */
STYLET_API stylet_status stylet_loop_start(stylet_loop* loop);
/* Or in the caller's thread, until its ticks are done or another thread stops it; it keeps the
 * processor and the priority that it got for it: */
STYLET_API stylet_status stylet_loop_run(stylet_loop* loop);
/* Asks the loop to end: forces fade in at most 20 ms. From any thread. */
STYLET_API void stylet_loop_ask_to_stop(stylet_loop* loop);
/* Waits until the loop has ended. */
STYLET_API stylet_status stylet_loop_wait(stylet_loop* loop);
/* Stops it, waits, also for threads in run and wait, closes its devices; the simulation can be
 * ticked again. No other call for the loop may begin meanwhile. From a function of a device it only
 * asks to stop. */
STYLET_API void stylet_loop_free(stylet_loop* loop);
/* 1: needles wait and forces fade; 0: it goes on. From any thread. */
STYLET_API void stylet_loop_pause(stylet_loop* loop, int paused);

/* ---- what is seen of it, by one thread that is not the loop's, while it runs or after */

/* Takes the newest tick that is to be seen: 1; nothing new since the last call: 0. The functions
 * below tell of the tick that was taken last. */
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
  uint32_t answered;                  /* the device gave a sample */
  uint32_t reserved;
} stylet_hand_report;
STYLET_API stylet_status stylet_loop_get_hand(const stylet_loop* loop, uint32_t needle,
                                              stylet_hand_report* report_out);
/* Events since the last call, oldest first; returns how many it wrote. */
STYLET_API uint32_t stylet_loop_events(stylet_loop* loop, stylet_event* out, uint32_t capacity);

/* Tells that somebody has seen this fault: once the force is gone the guard begins anew. */
STYLET_API stylet_status stylet_loop_acknowledge(stylet_loop* loop, uint32_t needle, uint32_t fault,
                                                 uint32_t fault_number);

typedef struct {
  uint32_t struct_bytes;
  uint32_t runs; /* 1: it has not ended */
  uint64_t ticks, missed_ticks, lost_events;
  uint64_t tick_p50_ns, tick_p999_ns, tick_max_ns; /* from reading the device to writing */
  uint64_t late_p50_ns, late_p999_ns, late_max_ns; /* of waking up */
} stylet_loop_report;
/* The times are of a loop that has ended; before, they are zero. */
STYLET_API stylet_status stylet_loop_get_report(const stylet_loop* loop,
                                                stylet_loop_report* report_out);
/* What this machine refused the loop that makes it less than real-time, a line each; empty: nothing
 * was refused. Known once the loop has ended. */
STYLET_API const char* stylet_loop_lacks(const stylet_loop* loop);
/* Why a needle's device does not answer; empty: it does. Valid until the next call for it. */
STYLET_API const char* stylet_loop_trouble(stylet_loop* loop, uint32_t needle);

#ifdef __cplusplus
}
#endif
#endif
