/* SPDX-License-Identifier: Apache-2.0 */
/* What the project for Godot wrote, once more through the interface in C: the same tips give the
 * same force in every frame, bit for bit, and the same state in the end.
 *
 * usage: replay ORGAN LOG TICKS_OF_A_FRAME */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stylet/stylet.h>

/* The organ's z is up, Godot's y. */
static stylet_vec3 from_godot(const float v[3]) {
  const stylet_vec3 out = {v[0], 0 - v[2], v[1]};
  return out;
}

int main(int argc, char** argv) {
  stylet_organ* organ = NULL;
  stylet_simulation* simulation = NULL;
  stylet_needle needle;
  stylet_needle_init(&needle, sizeof needle);
  needle.bending_nm2 = 0.02F;
  if (argc != 4 || stylet_organ_read(argv[1], &organ, NULL) != STYLET_OK ||
      stylet_simulation_create(organ, NULL, &needle, 1, &simulation, NULL) != STYLET_OK) {
    return 2;
  }
  FILE* const log = fopen(argv[2], "rb");
  float frame[6];
  int frames = 0, others = 0;
  float most_n = 0;
  const stylet_vec3 down = {0, 0, -1};
  while (log != NULL && fread(frame, sizeof frame[0], 6, log) == 6) {
    stylet_output out = {.struct_bytes = sizeof out};
    const stylet_input in = {sizeof in, 1,
                             stylet_pose_of_tip(from_godot(frame), down, needle.length_m), 0};
    for (int i = 0; i < atoi(argv[3]); ++i) stylet_simulation_tick(simulation, &in, 1, &out, 1);
    const stylet_vec3 felt = from_godot(frame + 3);
    if (felt.x != out.force_n.x || felt.y != out.force_n.y || felt.z != out.force_n.z) ++others;
    if (out.force_n.z > most_n) most_n = out.force_n.z;
    ++frames;
  }
  printf("frames %d, other forces %d, at most %.3f N\n", frames, others, (double)most_n);
  const unsigned long long hash = stylet_simulation_hash(simulation);
  printf("state %016llx\n", hash);
  return 0;
}
