// SPDX-License-Identifier: Apache-2.0
// The kernel's lattice steps for the instruction sets of this processor, simplest first. All give
// the same bits; a kernel made by `create` has the last of them.
#pragma once

#include <vector>

#include "stylet/kernel.h"

namespace stylet {
void lattice_step_baseline(const Kernel& kernel);
#if defined(__x86_64__)
void lattice_step_avx2(const Kernel& kernel);
void lattice_step_avx512(const Kernel& kernel);
#endif
}  // namespace stylet

namespace stylet::test {

struct Variant {
  const char* name;
  void (*step)(const Kernel&);
};

inline std::vector<Variant> variants_here() {
  std::vector<Variant> all = {{"baseline", lattice_step_baseline}};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") != 0) all.push_back({"avx2", lattice_step_avx2});
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0) {
    all.push_back({"avx512", lattice_step_avx512});
  }
#endif
  return all;
}

}  // namespace stylet::test
