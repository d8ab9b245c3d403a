// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/display.h"

#include <algorithm>

namespace stylet::hal {
namespace {

DisplayState empty_state(const Kernel& kernel) {
  DisplayState state;
  state.moved_m.resize(particle_count(kernel));
  return state;
}

}  // namespace

Display::Display(const Kernel& kernel) : slots_(empty_state(kernel)) {}

void Display::publish(const Kernel& kernel, std::span<const TickRecord> records,
                      std::uint64_t missed_ticks, std::uint64_t lost_records) {
  DisplayState& out = slots_.draft();
  out.needles = static_cast<std::uint32_t>(std::min(records.size(), out.hand.size()));
  std::copy_n(records.begin(), out.needles, out.hand.begin());
  for (std::uint32_t i = 0; i < out.needles; ++i) {
    out.nodes[i] = needle_shape(kernel, i, out.node_m[i]);
  }
  out.constraint_particles = stylet::constraint_particles(kernel, out.constraint_particle);
  out.touches = obstacle_touches(kernel, out.touch);
  out.missed_ticks = missed_ticks;
  out.lost_records = lost_records;
  particles(kernel, out.moved_m);
  slots_.publish();
}

}  // namespace stylet::hal
