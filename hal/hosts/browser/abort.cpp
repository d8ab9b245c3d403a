// SPDX-License-Identifier: Apache-2.0
// What the C++ library calls before it aborts. Its own tells why, by printf, which would be 8 kB of
// the library; a page could not show it.

extern "C" [[noreturn]] void abort_message(const char* /*format*/, ...) {
  __builtin_trap();
}
