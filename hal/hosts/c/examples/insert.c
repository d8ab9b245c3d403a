/* SPDX-License-Identifier: Apache-2.0 */
/* A needle in an organ, from C: 20 mm into it at 10 mm/s from above, and the force on the way.
 *
 *   cc insert.c $(pkg-config --cflags --libs stylet) -o insert && ./insert liver.organ */
#include <stdio.h>
#include <stylet/stylet.h>

int main(int argc, char** argv) {
  stylet_refusal why = {.struct_bytes = sizeof why};
  stylet_organ* organ = NULL;
  stylet_simulation* simulation = NULL;
  if (argc != 2 || stylet_organ_read(argv[1], &organ, &why) != STYLET_OK) {
    return fprintf(stderr, "usage: insert ORGAN\n%s\n", why.text), 1;
  }
  stylet_organ_info info = {.struct_bytes = sizeof info};
  stylet_organ_get_info(organ, &info);

  stylet_needle needle; /* 18G, 150 mm, rigid, unless said otherwise */
  stylet_needle_init(&needle, sizeof needle);
  needle.bending_nm2 = 0.02F;
  if (stylet_simulation_create(organ, NULL, &needle, 1, &simulation, &why) != STYLET_OK) {
    return fprintf(stderr, "%s\n", why.text), 1;
  }

  /* From above the middle of the organ, straight down. */
  const stylet_vec3 down = {0, 0, -1};
  stylet_vec3 at = {(info.low_m.x + info.high_m.x) / 2, (info.low_m.y + info.high_m.y) / 2,
                    info.high_m.z + 0.01F};
  float to_skin_m = 0;
  stylet_organ_raycast(organ, at, down, &to_skin_m);
  at.z -= to_skin_m - 1e-3F; /* the tip begins 1 mm above the skin */

  stylet_output out = {.struct_bytes = sizeof out};
  for (int tick = 0; tick <= 2100; ++tick) {
    const stylet_vec3 tip = {at.x, at.y, at.z - 10e-3F * 1e-3F * (float)tick};
    const stylet_input in = {.struct_bytes = sizeof in,
                             .valid = 1,
                             .handle = stylet_pose_of_tip(tip, down, needle.length_m)};
    stylet_simulation_tick(simulation, &in, 1, &out, 1);
    if (tick % 100 == 0) printf("%6.2f mm  %6.3f N\n", 1e3 * out.depth_m, out.force_n.z);
  }
  printf("state %016llx\n", (unsigned long long)stylet_simulation_hash(simulation));
  stylet_simulation_free(simulation);
  stylet_organ_free(organ);
  return 0;
}
