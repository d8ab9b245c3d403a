/* SPDX-License-Identifier: Apache-2.0 */
/* A program of version 0.2.0: it is compiled with the headers of that version, which lie beside it,
 * and must run with every later library. It uses each kind of call and prints what a user of that
 * version relied on. */
#include <stdio.h>
#include <stdlib.h>
#include <stylet/stylet.h>
#include <stylet/stylet_loop.h>

static void need(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "not so: %s\n", what);
  exit(1);
}

static stylet_simulation* begin(const stylet_organ* organ) {
  stylet_refusal why = {.struct_bytes = sizeof why};
  stylet_config config;
  stylet_needle needle;
  stylet_obstacle bone;
  stylet_simulation* simulation = NULL;
  need(stylet_config_init(&config, sizeof config) == STYLET_OK, "config");
  need(stylet_needle_init(&needle, sizeof needle) == STYLET_OK, "needle");
  need(stylet_obstacle_init(&bone, sizeof bone) == STYLET_OK, "obstacle");
  needle.length_m = -1;
  need(stylet_simulation_create(organ, &config, &needle, 1, &simulation, &why) ==
           STYLET_CONFIG_VALUE_OUT_OF_RANGE, "a negative length is refused");
  printf("%s\n", why.place);
  needle.length_m = 0.15F;
  need(stylet_simulation_create(organ, &config, &needle, 1, &simulation, &why) == STYLET_OK,
       why.text);
  bone.pose.position_m.x = 1;
  need(stylet_simulation_set_obstacles(simulation, &bone, 1, &why) == STYLET_OK, why.text);
  return simulation;
}

/* A hand at rest is pushed with 100 N: what the guard lets through is within its limit. */
static void try_guard(void) {
  stylet_guard_config config;
  stylet_guard* guard = NULL;
  need(stylet_guard_config_init(&config, sizeof config) == STYLET_OK, "guard's configuration");
  need(stylet_guard_create(&config, &guard, NULL) == STYLET_OK, "guard");
  const stylet_vec3 push = {0, 0, 100};
  stylet_vec3 sent = {0, 0, 0};
  for (int64_t tick = 1; tick <= 1000; ++tick) {
    const stylet_sample at = {.struct_bytes = sizeof at, .seq = (uint64_t)tick,
                              .t_ns = tick * 1000000, .pose = {{0, 0, 0}, {1, 0, 0, 0}}};
    (void)stylet_guard_sample(guard, &at, tick * 1000000);
    sent = stylet_guard_force(guard, push);
  }
  need(sent.z > 0 && sent.z <= config.max_force_n, "the guard's limit");
  stylet_guard_free(guard);
}

int main(int argc, char** argv) {
  stylet_organ* organ = NULL;
  need(argc == 2 && stylet_organ_read(argv[1], &organ, NULL) == STYLET_OK, "usage: insert ORGAN");
  need(stylet_version() >= (STYLET_VERSION_MAJOR << 16 | STYLET_VERSION_MINOR << 8), "version");
  stylet_organ_info info = {.struct_bytes = sizeof info};
  need(stylet_organ_get_info(organ, &info) == STYLET_OK && info.voxels > 0, "organ");
  stylet_simulation* simulation = begin(organ);

  stylet_output out[2] = {{.struct_bytes = sizeof out[0]}};
  out[1].flags = 0xA5A5A5A5U; /* behind what is asked for */
  const stylet_vec3 down = {0, 0, -1};
  for (int tick = 0; tick < 500; ++tick) {
    const stylet_vec3 tip = {(info.low_m.x + info.high_m.x) / 2,
                             (info.low_m.y + info.high_m.y) / 2,
                             info.high_m.z + 1e-3F - 1e-5F * (float)tick};
    const stylet_input in = {sizeof in, 1, stylet_pose_of_tip(tip, down, 0.15F)};
    need(stylet_simulation_tick(simulation, &in, 1, out, 1) == STYLET_OK, "tick");
  }
  need(out[0].tick == 500 && out[0].flags == 0 && out[0].force_n.z > 0, "a force upwards");
  need(out[1].flags == 0xA5A5A5A5U, "one output is written");
  stylet_stats stats = {.struct_bytes = sizeof stats};
  stylet_energy energy = {.struct_bytes = sizeof energy};
  need(stylet_simulation_get_stats(simulation, &stats) == STYLET_OK && stats.ticks == 500, "stats");
  need(stylet_simulation_get_energy(simulation, &energy) == STYLET_OK && energy.elastic_j > 0,
       "energy");
  need(stylet_simulation_surface(simulation, NULL, 0) == info.vertices, "surface");
  try_guard();
  printf("%s\n", stylet_status_name(STYLET_OK));
  stylet_simulation_free(simulation);
  stylet_organ_free(organ);
  return 0;
}
