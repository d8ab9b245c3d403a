// SPDX-License-Identifier: Apache-2.0
// Which process this is. What has threads remembers it: after a fork the child has a copy of
// everything but the threads, and would wait for ever for them.
#pragma once

#include <cstdint>

#ifndef _WIN32
#include <unistd.h>
#endif

namespace stylet::c {

inline std::int64_t this_process() {
#ifdef _WIN32
  return 0;  // there is no fork
#else
  return getpid();
#endif
}

}  // namespace stylet::c
