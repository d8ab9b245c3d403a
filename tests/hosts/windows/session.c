/* SPDX-License-Identifier: Apache-2.0 */
/* Sessions drawn from a seed, through the interface in C: what came of them, one line each, for
 * windows_test.py to compare between systems. Draws and poses use integers and + - * / alone.
 *
 * usage: session drawn ORGAN SEED      configuration, needles, bones, insertion, copies, a batch
 *        session save ORGAN SEED FILE  writes the state in the middle of an insertion
 *        session load ORGAN SEED FILE  goes on from that state
 *        session guard SEED            guards of every known model, with drawn samples
 *        session loop ORGAN SEED       the loop in virtual time, with a device of its own
 *        session live ORGAN URI        the loop in real time; URI "own": the same device */
#define _POSIX_C_SOURCE 200809L /* nanosleep */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stylet/stylet_loop.h>
#include <time.h>

enum { TICKS = 1500, COPIES = 3, GUARD_TICKS = 2000 };

/* ==== Numbers ================================================================================ */

static uint64_t g_draw;

static uint32_t draw(uint32_t below) {
  g_draw ^= g_draw << 13;
  g_draw ^= g_draw >> 7;
  g_draw ^= g_draw << 17;
  return (uint32_t)(g_draw >> 33) % below;
}
/* In steps of a thousandth of the way from `least` to `most`. */
static float between(float least, float most) {
  return least + (most - least) * ((float)draw(1001) / 1000.0F);
}
static void seed(const char* text) {
  g_draw = 0x9E3779B97F4A7C15U ^ strtoull(text, NULL, 10) * 0xD1342543DE82EF95U;
  for (int i = 0; i < 8; ++i) draw(2);
}

static uint64_t sum_of(uint64_t sum, const void* bytes, size_t count) {
  const unsigned char* const all = bytes;
  for (size_t i = 0; i < count; ++i) sum = (sum ^ all[i]) * 0x100000001B3U;
  return sum;
}
static const uint64_t kNoSum = 0xCBF29CE484222325U;

static void say(const char* what, uint64_t sum) {
  printf("%s %08lx%08lx\n", what, (unsigned long)(sum >> 32), (unsigned long)(sum & 0xFFFFFFFFU));
}
static void must(stylet_status status, const stylet_refusal* why) {
  if (status == STYLET_OK) return;
  printf("refused %d %s\n", (int)status, why == NULL ? stylet_status_name(status) : why->text);
  exit(1);
}

/* ==== A drawn session ======================================================================== */

typedef struct {
  stylet_organ* organ;
  stylet_simulation* simulation;
  uint32_t needles;
  stylet_needle needle[2];
  stylet_vec3 from[2], way[2];
  float speed_m; /* of a tick */
} session;

static void open_organ(session* s, const char* path) {
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_organ_read(path, &s->organ, &why), &why);
  stylet_organ_info info = {.struct_bytes = sizeof info};
  must(stylet_organ_get_info(s->organ, &info), NULL);
  printf("organ %s %u voxels ", info.name, (unsigned)info.voxels);
  say("bytes", info.hash);
}

/* From above the skin, a little aslant; the tip begins 1 mm before it. */
static void draw_way(session* s, uint32_t needle) {
  stylet_organ_info info = {.struct_bytes = sizeof info};
  must(stylet_organ_get_info(s->organ, &info), NULL);
  const float part = between(0.35F, 0.65F), other = between(0.35F, 0.65F);
  const stylet_vec3 way = {between(-0.2F, 0.2F), between(-0.2F, 0.2F), -1};
  stylet_vec3 from = {info.low_m.x + part * (info.high_m.x - info.low_m.x),
                      info.low_m.y + other * (info.high_m.y - info.low_m.y),
                      info.high_m.z + 0.01F};
  float to_skin_m = 0.01F;
  (void)stylet_organ_raycast(s->organ, from, way, &to_skin_m);
  from.z -= to_skin_m - 1e-3F;
  s->from[needle] = from;
  s->way[needle] = way;
}

static void draw_needle(stylet_needle* needle) {
  must(stylet_needle_init(needle, sizeof *needle), NULL);
  needle->length_m = between(0.08F, 0.2F);
  needle->outer_radius_m = between(0.3e-3F, 0.9e-3F);
  needle->bending_nm2 = draw(3) == 0 ? 0 : between(0.005F, 0.05F);
  if (needle->bending_nm2 > 0) {
    needle->rods = 4 + draw(20);
    needle->bevel_per_m = draw(2) == 0 ? 0 : between(0.5F, 5);
    needle->torsion_nm2 = draw(2) == 0 ? 0 : between(0.005F, 0.05F);
  }
}

static void draw_bones(session* s) {
  stylet_obstacle bones[2];
  const uint32_t count = draw(3);
  for (uint32_t i = 0; i < count; ++i) {
    must(stylet_obstacle_init(&bones[i], sizeof bones[i]), NULL);
    const stylet_vec3 half = {between(2e-3F, 8e-3F), between(2e-3F, 8e-3F), between(2e-3F, 8e-3F)};
    must(draw(2) == 0 ? stylet_obstacle_box(&bones[i], half)
                      : stylet_obstacle_sphere(&bones[i], half.x), NULL);
    bones[i].pose.position_m = s->from[0];
    bones[i].pose.position_m.x += between(-5e-3F, 5e-3F);
    bones[i].pose.position_m.z -= between(0.015F, 0.03F);
  }
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_simulation_set_obstacles(s->simulation, bones, count, &why), &why);
}

static void draw_session(session* s, const char* organ, const char* number) {
  seed(number);
  memset(s, 0, sizeof *s);
  open_organ(s, organ);
  stylet_config config;
  must(stylet_config_init(&config, sizeof config), NULL);
  config.mode = draw(4) == 0;
  if (config.mode == 0) {
    config.inertia = draw(2);
    config.substeps = 4 + draw(8);
    config.tissue_damping_s = between(0, 0.01F);
    config.breathing_amplitude_m.z = draw(2) == 0 ? 0 : 2e-3F;
  }
  s->needles = 1 + draw(2);
  for (uint32_t i = 0; i < s->needles; ++i) {
    draw_needle(&s->needle[i]);
    draw_way(s, i);
  }
  s->speed_m = between(5e-6F, 30e-6F);
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_simulation_create(s->organ, &config, s->needle, s->needles, &s->simulation, &why),
       &why);
  draw_bones(s);
}

/* In, and in the last third back; now and then a sample is missing. */
static stylet_input input_at(const session* s, uint32_t needle, uint32_t tick) {
  const uint32_t turn = 2 * TICKS / 3;
  const float gone_m = s->speed_m * (float)(tick < turn ? tick : 2 * turn - tick);
  const stylet_vec3 from = s->from[needle], way = s->way[needle];
  const stylet_vec3 tip = {from.x + gone_m * way.x, from.y + gone_m * way.y,
                           from.z + gone_m * way.z};
  const stylet_input input = {sizeof input, tick % 97 != 96,
                              stylet_pose_of_tip(tip, way, s->needle[needle].length_m), 0};
  return input;
}

static void tick_through(const session* s, stylet_simulation* simulation, uint32_t first,
                         uint32_t last, uint64_t* sum) {
  for (uint32_t tick = first; tick < last; ++tick) {
    stylet_input in[2];
    stylet_output out[2] = {{.struct_bytes = sizeof out[0]}, {.struct_bytes = sizeof out[0]}};
    for (uint32_t i = 0; i < s->needles; ++i) in[i] = input_at(s, i, tick);
    must(stylet_simulation_tick(simulation, in, s->needles, out, s->needles), NULL);
    if (sum != NULL) *sum = sum_of(*sum, out, s->needles * sizeof out[0]);
  }
}

static void say_what_happened(const session* s) {
  stylet_event events[STYLET_MAX_EVENTS];
  const uint32_t count = stylet_simulation_events(s->simulation, events, STYLET_MAX_EVENTS);
  for (uint32_t i = 0; i < count; ++i) {
    printf("event %s tick %lu needle %u\n", stylet_event_name(events[i].kind),
           (unsigned long)events[i].tick, (unsigned)events[i].needle);
  }
  stylet_energy energy = {.struct_bytes = sizeof energy};
  must(stylet_simulation_get_energy(s->simulation, &energy), NULL);
  say("energy", sum_of(kNoSum, &energy, sizeof energy));
  const uint32_t vertices = stylet_simulation_surface(s->simulation, NULL, 0);
  stylet_vec3* const surface = malloc(vertices * sizeof *surface);
  (void)stylet_simulation_surface(s->simulation, surface, vertices);
  say("surface", sum_of(kNoSum, surface, vertices * sizeof *surface));
  free(surface);
}

static void run_batch(const session* s, stylet_simulation* const* copies, uint32_t ticks) {
  stylet_batch* batch = NULL;
  must(stylet_batch_create(copies, COPIES, 2, &batch), NULL);
  const size_t each = (size_t)ticks * s->needles;
  stylet_input* const inputs = malloc(COPIES * each * sizeof *inputs);
  for (size_t i = 0; i < COPIES * each; ++i) {
    inputs[i] = input_at(s, (uint32_t)(i % s->needles),
                         TICKS / 2 + (uint32_t)(i % each) / s->needles);
  }
  must(stylet_batch_run(batch, inputs, NULL, ticks), NULL);
  free(inputs);
  stylet_batch_free(batch);
}

static void run_drawn(const char* organ, const char* number) {
  session s;
  draw_session(&s, organ, number);
  uint64_t sum = kNoSum;
  tick_through(&s, s.simulation, 0, TICKS / 2, &sum);
  say("half", stylet_simulation_hash(s.simulation));
  stylet_simulation* copies[COPIES];
  for (int i = 0; i < COPIES; ++i) must(stylet_simulation_clone(s.simulation, &copies[i]), NULL);
  tick_through(&s, s.simulation, TICKS / 2, TICKS, &sum);
  say("state", stylet_simulation_hash(s.simulation));
  say("forces", sum);
  say_what_happened(&s);
  run_batch(&s, copies, TICKS - TICKS / 2);
  for (int i = 0; i < COPIES; ++i) {
    say("copy", stylet_simulation_hash(copies[i]));
    stylet_simulation_free(copies[i]);
  }
  stylet_simulation_free(s.simulation);
  stylet_organ_free(s.organ);
}

/* ==== A state that goes from one system to another =========================================== */

static void save(const char* organ, const char* number, const char* path) {
  session s;
  draw_session(&s, organ, number);
  tick_through(&s, s.simulation, 0, TICKS / 2, NULL);
  const size_t bytes = stylet_simulation_snapshot_bytes(s.simulation);
  void* const all = malloc(bytes);
  must(stylet_simulation_snapshot(s.simulation, all, bytes), NULL);
  FILE* const file = fopen(path, "wb");
  if (file == NULL || fwrite(all, 1, bytes, file) != bytes || fclose(file) != 0) exit(2);
  say("saved", sum_of(kNoSum, all, bytes));
}

static void load(const char* organ, const char* number, const char* path) {
  session s;
  draw_session(&s, organ, number);
  const size_t bytes = stylet_simulation_snapshot_bytes(s.simulation);
  void* const all = malloc(bytes);
  FILE* const file = fopen(path, "rb");
  if (file == NULL || fread(all, 1, bytes, file) != bytes || fgetc(file) != EOF) exit(2);
  must(stylet_simulation_restore(s.simulation, all, bytes), NULL);
  uint64_t sum = kNoSum;
  tick_through(&s, s.simulation, TICKS / 2, TICKS, &sum);
  say("forces", sum);
  say("state", stylet_simulation_hash(s.simulation));
}

/* ==== Guards ================================================================================= */

static stylet_sample drawn_sample(uint64_t seq, int64_t t_ns, stylet_vec3* at_m) {
  at_m->x += between(-2e-5F, 2e-5F);
  at_m->y += between(-2e-5F, 2e-5F);
  at_m->z += between(-2e-5F, 2e-5F);
  if (draw(700) == 0) at_m->x += 0.5F; /* faster than a hand */
  const stylet_sample sample = {sizeof sample, draw(2), seq, t_ns, {*at_m, {1, 0, 0, 0}}, 0};
  return sample;
}

static stylet_vec3 drawn_force(void) {
  const stylet_vec3 force = {between(-5, 5), between(-5, 5), between(-5, 5)};
  const stylet_vec3 none = {0, 0, (float)NAN};
  return draw(900) == 0 ? none : force;
}

static void guard_of(const char* model) {
  stylet_guard_config config = {.struct_bytes = sizeof config};
  must(stylet_guard_config_for(&config, model), NULL);
  config.acknowledge_button = 0;
  stylet_guard* guard = NULL;
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_guard_create(&config, &guard, &why), &why);
  uint64_t sum = sum_of(kNoSum, &config, sizeof config);
  stylet_vec3 at_m = {0, 0, 0};
  uint64_t seq = 0;
  for (int64_t tick = 1; tick <= GUARD_TICKS; ++tick) {
    const stylet_sample sample = drawn_sample(seq += draw(20) != 0, tick * 1000000, &at_m);
    (void)stylet_guard_sample(guard, draw(50) == 0 ? NULL : &sample, tick * 1000000);
    const stylet_vec3 sent = stylet_guard_force(guard, drawn_force());
    sum = sum_of(sum, &sent, sizeof sent);
  }
  stylet_guard_report report = {.struct_bytes = sizeof report};
  must(stylet_guard_get_report(guard, &report), NULL);
  sum = sum_of(sum, &report, sizeof report);
  printf("%s: %lu faults, %lu forces limited, ", model, (unsigned long)report.faults,
         (unsigned long)report.force_limited);
  say("sum", sum);
  stylet_guard_free(guard);
}

static void guard_models(const char* number) {
  seed(number);
  const char* model;
  for (uint32_t i = 0; (model = stylet_device_model(i)) != NULL; ++i) guard_of(model);
}

/* ==== Loops ================================================================================== */

/* A hand that goes in and trembles, and sums what it is told to feel. */
typedef struct {
  uint64_t seq, sum;
  stylet_vec3 at_m;
  int closed;
} own_device;

static int read_own(void* self, int64_t now_ns, stylet_sample* sample_out) {
  own_device* const own = self;
  own->at_m.z -= 1e-5F + between(-1e-6F, 1e-6F);
  sample_out->seq = ++own->seq;
  sample_out->t_ns = now_ns;
  sample_out->pose.position_m = own->at_m;
  sample_out->pose.rotation.w = 1;
  return draw(40) != 0;
}
static void write_own(void* self, const stylet_command* command) {
  own_device* const own = self;
  own->sum = sum_of(own->sum, &command->force_n, sizeof command->force_n);
}

static stylet_device* device_of(own_device* own) {
  const stylet_device_functions functions = {.struct_bytes = sizeof functions,
                                             .self = own,
                                             .read = read_own,
                                             .write = write_own,
                                             .max_force_n = 3,
                                             .max_slew_n_per_s = 1000};
  stylet_device* device = NULL;
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_device_from_functions(&functions, &device, &why), &why);
  return device;
}

static stylet_loop* loop_of(session* s, stylet_device* const* devices, uint64_t ticks,
                            uint32_t virtual_time) {
  stylet_hand hands[2];
  for (uint32_t i = 0; i < s->needles; ++i) {
    must(stylet_hand_init(&hands[i], sizeof hands[i]), NULL);
    hands[i].start = stylet_pose_of_tip(s->from[i], s->way[i], s->needle[i].length_m);
  }
  stylet_loop_config config;
  must(stylet_loop_config_init(&config, sizeof config), NULL);
  config.ticks = ticks;
  config.virtual_time = virtual_time;
  config.helpers = virtual_time == 1 ? 2 : 0;
  stylet_loop* loop = NULL;
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_loop_create(s->simulation, &config, devices, hands, NULL, &loop, &why), &why);
  return loop;
}

static void run_loop(const char* organ, const char* number) {
  session s;
  draw_session(&s, organ, number);
  own_device own = {.sum = kNoSum};
  stylet_device* devices[2] = {device_of(&own), NULL};
  must(stylet_device_simulated(0.02F, 0.02F, 0.2F, &devices[1]), NULL);
  stylet_loop* const loop = loop_of(&s, devices, TICKS, 1);
  must(stylet_loop_run(loop), NULL);
  stylet_hand_report felt = {.struct_bytes = sizeof felt};
  stylet_output out = {.struct_bytes = sizeof out};
  while (stylet_loop_take(loop) != 0) must(stylet_loop_get_hand(loop, 0, &felt), NULL);
  must(stylet_loop_get_output(loop, 0, &out), NULL);
  printf("guard %s, fault %s\n", stylet_guard_mode_name(felt.mode), stylet_fault_name(felt.fault));
  say("shown", sum_of(kNoSum, &out, sizeof out));
  stylet_loop_free(loop);
  if (s.needles == 1) stylet_device_close(devices[1]);
  say("sent", own.sum);
  say("state", stylet_simulation_hash(s.simulation));
}

/* What a machine's clock has a part in is told in words, not as a sum. */
static void run_live(const char* organ, const char* uri) {
  session s;
  draw_session(&s, organ, "1");
  stylet_simulation_free(s.simulation);
  s.needles = 1;
  stylet_refusal why = {.struct_bytes = sizeof why};
  must(stylet_simulation_create(s.organ, NULL, s.needle, 1, &s.simulation, &why), &why);
  own_device own = {.sum = kNoSum};
  stylet_device* device = NULL;
  if (strcmp(uri, "own") == 0) {
    device = device_of(&own);
  } else {
    must(stylet_device_open(uri, 5, &device, &why), &why);
  }
  stylet_loop* const loop = loop_of(&s, &device, 500, 0);
  must(stylet_loop_start(loop), NULL);
  /* In any look: on a busy machine a single tick may come before its sample. */
  uint32_t answered = 0;
  stylet_loop_report report = {.struct_bytes = sizeof report, .runs = 1};
  for (const struct timespec look = {0, 5000000}; report.runs != 0; nanosleep(&look, NULL)) {
    stylet_hand_report felt = {.struct_bytes = sizeof felt};
    if (stylet_loop_take(loop) != 0) must(stylet_loop_get_hand(loop, 0, &felt), NULL);
    answered |= felt.answered;
    must(stylet_loop_get_report(loop, &report), NULL);
  }
  must(stylet_loop_wait(loop), NULL);
  printf("ticks %lu\nanswered %u\nlate p50 %.0f us\ntick p50 %.0f us\nlacks:\n%s",
         (unsigned long)report.ticks, (unsigned)answered, 1e-3 * (double)report.late_p50_ns,
         1e-3 * (double)report.tick_p50_ns, stylet_loop_lacks(loop));
  stylet_loop_free(loop);
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  if (argc == 4 && strcmp(what, "drawn") == 0) return run_drawn(argv[2], argv[3]), 0;
  if (argc == 5 && strcmp(what, "save") == 0) return save(argv[2], argv[3], argv[4]), 0;
  if (argc == 5 && strcmp(what, "load") == 0) return load(argv[2], argv[3], argv[4]), 0;
  if (argc == 3 && strcmp(what, "guard") == 0) return guard_models(argv[2]), 0;
  if (argc == 4 && strcmp(what, "loop") == 0) return run_loop(argv[2], argv[3]), 0;
  if (argc == 4 && strcmp(what, "live") == 0) return run_live(argv[2], argv[3]), 0;
  fprintf(stderr, "usage: the first comment of session.c\n");
  return 2;
}
