/* SPDX-License-Identifier: Apache-2.0 */
/* A loop of your own with the guard in it, from C: read the device, ask the guard whether that may
 * be used, tick, send what the guard lets through. Here the device is a hand that is computed.
 *   cc guard.c $(pkg-config --cflags --libs stylet) -o guard && ./guard liver.organ */
#include <stdio.h>
#include <stylet/stylet_loop.h>
#include <time.h>
/* Yours: 1 if it answered. x right, y up, z toward the operator; seq grows with each measurement.
 */
static int read_device(int tick, int64_t now_ns, stylet_sample* out) {
  const stylet_pose away = {{0, 0, -2e-5F * (float)tick}, {1, 0, 0, 0}}; /* 20 mm/s */
  *out = (stylet_sample){sizeof *out, 0, (uint64_t)tick + 1, now_ns, away};
  return 1;
}
static int64_t sleep_until(int64_t then_ns) { /* returns when it really is */
  struct timespec t = {then_ns / 1000000000, then_ns % 1000000000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL);
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

int main(int argc, char** argv) {
  stylet_refusal why = {.struct_bytes = sizeof why};
  stylet_organ* organ = NULL;
  stylet_simulation* simulation = NULL;
  stylet_guard* guard = NULL;
  stylet_guard_config limits = {.struct_bytes = sizeof limits};
  stylet_guard_config_for(&limits, "touch"); /* or _init, and your device's own */
  if (argc != 2 || stylet_organ_read(argv[1], &organ, &why) != STYLET_OK ||
      stylet_simulation_create(organ, NULL, NULL, 1, &simulation, &why) != STYLET_OK ||
      stylet_guard_create(&limits, &guard, &why) != STYLET_OK) {
    return fprintf(stderr, "usage: guard ORGAN\n%s\n", why.text), 1;
  }
  const stylet_vec3 down = {0, 0, -1};
  stylet_organ_info info = {.struct_bytes = sizeof info};
  stylet_organ_get_info(organ, &info);
  stylet_input in = {.struct_bytes = sizeof in};
  stylet_guard_report told = {.struct_bytes = sizeof told};
  stylet_output out = {.struct_bytes = sizeof out};
  stylet_sample sample = {0};
  int64_t now_ns = sleep_until(0), next_ns = now_ns;
  for (int tick = 0, ended = 0; !ended; ++tick, now_ns = sleep_until(next_ns += 1000000)) {
    if (tick < 1500) {
      stylet_sample* given = read_device(tick, now_ns, &sample) ? &sample : NULL;
      in.valid = (uint32_t)stylet_guard_sample(guard, given, now_ns);
      const stylet_vec3 tip = {0, 0, info.high_m.z + 1e-3F + sample.pose.position_m.z};
      in.handle = stylet_pose_of_tip(tip, down, 0.15F);
      stylet_simulation_tick(simulation, &in, 1, &out, 1);
      stylet_guard_force(guard, out.force_n);
    } else { /* the force fades; it never stops at once */
      ended = stylet_guard_end(guard, now_ns);
    }
    stylet_guard_get_report(guard, &told); /* yours: write told.force_n to the device */
    if (tick % 100 == 0) printf("%6.3f N  %s\n", told.force_n.z, stylet_fault_name(told.fault));
  }
  stylet_guard_free(guard);
  stylet_simulation_free(simulation);
  stylet_organ_free(organ);
  return 0;
}
