/* SPDX-License-Identifier: Apache-2.0 */
/* Loaded before a program (LD_PRELOAD): counts its requests for memory of at least LARGE bytes, and
 * tells the number at its end. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

static atomic_ulong g_large;

void* malloc(size_t bytes) {
  static void* (*real)(size_t);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "malloc");
  if (bytes >= LARGE) ++g_large;
  return real(bytes);
}

void* realloc(void* block, size_t bytes) {
  static void* (*real)(void*, size_t);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "realloc");
  if (bytes >= LARGE) ++g_large;
  return real(block, bytes);
}

__attribute__((destructor)) static void tell(void) {
  printf("large blocks %lu\n", (unsigned long)g_large);
}
