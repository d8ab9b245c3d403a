// SPDX-License-Identifier: Apache-2.0
#include "lattice/lattice.h"

namespace stylet {

void lattice_step_baseline(const Kernel& kernel);
#if defined(__x86_64__)
void lattice_step_avx2(const Kernel& kernel);
void lattice_step_avx512(const Kernel& kernel);
#endif

LatticeStep lattice_step_for_this_processor() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0) {
    return lattice_step_avx512;
  }
  if (__builtin_cpu_supports("avx2") != 0) return lattice_step_avx2;
#endif
  return lattice_step_baseline;
}

const char* instruction_set() {
  const LatticeStep step = lattice_step_for_this_processor();
#if defined(__x86_64__)
  if (step == lattice_step_avx512) return "avx512";
  if (step == lattice_step_avx2) return "avx2";
#endif
  (void)step;
  return "baseline";
}

}  // namespace stylet
