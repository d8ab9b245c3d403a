// SPDX-License-Identifier: Apache-2.0
// A mathematical library that is wrong in the seventh digit, to be preloaded. Programs whose
// results must not depend on the machine's library give the same results with it. Real libraries
// differ in the last place, which rounding from double to float hides from a test most of the time,
// but not always. Square root, rounding and the like are left alone: IEEE 754 fixes them.
#include <dlfcn.h>

namespace {

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

// Whole numbers are left alone: every library gets them right.
template <typename Number>
Number shaken(Number v) {
  const bool is_whole =
      !(v < Number(1e9) && v > Number(-1e9)) || v == static_cast<Number>(static_cast<long>(v));
  return is_whole ? v : v * static_cast<Number>(1 + 3e-7);
}

}  // namespace

#define STYLET_SHAKEN_1(type, name)                        \
  extern "C" type name(type x) noexcept {                  \
    static const auto exact = real<type (*)(type)>(#name); \
    return shaken(exact(x));                               \
  }
#define STYLET_SHAKEN_2(type, name)                              \
  extern "C" type name(type x, type y) noexcept {                \
    static const auto exact = real<type (*)(type, type)>(#name); \
    return shaken(exact(x, y));                                  \
  }
#define STYLET_SHAKEN_ALL_1(name) STYLET_SHAKEN_1(double, name) STYLET_SHAKEN_1(float, name##f)
#define STYLET_SHAKEN_ALL_2(name) STYLET_SHAKEN_2(double, name) STYLET_SHAKEN_2(float, name##f)

STYLET_SHAKEN_ALL_1(sin)
STYLET_SHAKEN_ALL_1(cos)
STYLET_SHAKEN_ALL_1(tan)
STYLET_SHAKEN_ALL_1(asin)
STYLET_SHAKEN_ALL_1(acos)
STYLET_SHAKEN_ALL_1(atan)
STYLET_SHAKEN_ALL_1(sinh)
STYLET_SHAKEN_ALL_1(cosh)
STYLET_SHAKEN_ALL_1(tanh)
STYLET_SHAKEN_ALL_1(exp)
STYLET_SHAKEN_ALL_1(exp2)
STYLET_SHAKEN_ALL_1(expm1)
STYLET_SHAKEN_ALL_1(log)
STYLET_SHAKEN_ALL_1(log2)
STYLET_SHAKEN_ALL_1(log10)
STYLET_SHAKEN_ALL_1(log1p)
STYLET_SHAKEN_ALL_1(cbrt)
STYLET_SHAKEN_ALL_2(pow)
STYLET_SHAKEN_ALL_2(atan2)
STYLET_SHAKEN_ALL_2(hypot)

extern "C" void sincos(double x, double* sine, double* cosine) noexcept {
  *sine = sin(x);
  *cosine = cos(x);
}
extern "C" void sincosf(float x, float* sine, float* cosine) noexcept {
  *sine = sinf(x);
  *cosine = cosf(x);
}
