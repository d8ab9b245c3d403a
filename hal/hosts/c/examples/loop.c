/* SPDX-License-Identifier: Apache-2.0 */
/* A haptic device with the guard in its loop, from C: the device of a URI, or a simulated hand that
 * pushes 20 mm in and comes back, holds an elastic needle above an organ.
 *
 *   cc loop.c $(pkg-config --cflags --libs stylet) -o loop && ./loop liver.organ [URI] */
#include <stdio.h>
#include <stylet/stylet_loop.h>
#include <time.h>

int main(int argc, char** argv) {
  stylet_refusal why = {.struct_bytes = sizeof why};
  stylet_organ* organ = NULL;
  stylet_simulation* simulation = NULL;
  stylet_device* device = NULL;
  stylet_loop* loop = NULL;
  stylet_organ_info info = {.struct_bytes = sizeof info};
  stylet_needle needle;
  stylet_needle_init(&needle, sizeof needle);
  needle.bending_nm2 = 0.02F;
  if (argc < 2 || stylet_organ_read(argv[1], &organ, &why) != STYLET_OK ||
      stylet_simulation_create(organ, NULL, &needle, 1, &simulation, &why) != STYLET_OK) {
    return fprintf(stderr, "usage: loop ORGAN [URI]\n%s\n", why.text), 1;
  }
  if (argc > 2 && stylet_device_open(argv[2], 10, &device, &why) != STYLET_OK) {
    return fprintf(stderr, "%s\n", why.text), 1;
  }
  if (argc == 2) stylet_device_simulated(0.02F, 0.02F, 0.5F, &device);

  stylet_organ_get_info(organ, &info);
  const stylet_vec3 down = {0, 0, -1};
  const stylet_vec3 above = {(info.low_m.x + info.high_m.x) / 2,
                             (info.low_m.y + info.high_m.y) / 2, info.high_m.z};
  stylet_hand hand;
  stylet_hand_init(&hand, sizeof hand);
  hand.start = stylet_pose_of_tip(above, down, needle.length_m);
  stylet_loop_config config;
  stylet_loop_config_init(&config, sizeof config);
  config.ticks = 3000; /* 3 s; 0 is until stylet_loop_ask_to_stop */
  if (stylet_loop_create(simulation, &config, &device, &hand, NULL, &loop, &why) != STYLET_OK ||
      stylet_loop_start(loop) != STYLET_OK) {
    return fprintf(stderr, "%s\n", why.text), 1;
  }

  stylet_loop_report report = {.struct_bytes = sizeof report, .runs = 1};
  for (const struct timespec frame = {0, 100000000}; report.runs; nanosleep(&frame, NULL)) {
    stylet_output out = {.struct_bytes = sizeof out};
    stylet_hand_report felt = {.struct_bytes = sizeof felt};
    if (stylet_loop_take(loop)) stylet_loop_get_output(loop, 0, &out);
    stylet_loop_get_hand(loop, 0, &felt); /* draw here: stylet_loop_surface, _needle_shape */
    printf("%5.1f mm  %6.3f N  %s\n", 1e3 * out.depth_m, felt.sent_force_n.z,
           stylet_fault_name(felt.fault));
    stylet_loop_get_report(loop, &report);
  }
  stylet_loop_free(loop); /* closes the device, too */
  stylet_simulation_free(simulation);
  stylet_organ_free(organ);
  return 0;
}
