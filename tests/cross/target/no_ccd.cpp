// SPDX-License-Identifier: Apache-2.0
// Stands for the only function of libccd that the kernel calls, for a needle that appears inside
// bone. No recorded insertion has one. If one does, this ends the program, so that it is noticed.
#include <ccd/ccd.h>

extern "C" int ccdMPRPenetration(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*,
                                 ccd_vec3_t*) {
  __builtin_trap();
}
