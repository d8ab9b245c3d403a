// SPDX-License-Identifier: Apache-2.0
#include "hal/base/thread_rights.h"

#include <pthread.h>
#include <sched.h>

#include <cstddef>
#include <cstring>

namespace stylet::hal {

int rise_to(int priority) {
  const sched_param parameters = {priority};
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

int stay_on(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  return pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

std::string why_refused(int error) {
  return std::strerror(error);
}

}  // namespace stylet::hal
