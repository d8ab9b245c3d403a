// SPDX-License-Identifier: Apache-2.0
#include "hal/base/clock.h"

namespace stylet::hal {
namespace {

std::int64_t virtual_now(void* self) {
  return static_cast<VirtualTime*>(self)->now_ns;
}

void virtual_sleep(void* self, std::int64_t t_ns) {
  VirtualTime& time = *static_cast<VirtualTime*>(self);
  if (t_ns > time.now_ns) time.now_ns = t_ns;
}

}  // namespace

Clock virtual_clock(VirtualTime& time) {
  return {&time, virtual_now, virtual_sleep};
}

}  // namespace stylet::hal
