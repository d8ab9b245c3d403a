// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/display.h"

#include <algorithm>

#include "hal/base/clock.h"

namespace stylet::hal {

Display::Display(const Kernel& kernel)
    : memory_(sizeof(Memory) + 3 * sizeof(Vec3) * particle_count(kernel)), index_(at().middle) {}

Display::Display(int descriptor) : memory_(SharedMemory::of(descriptor)), index_(at().middle) {
  if (memory_.bytes().size() < sizeof(Memory)) throw SideError("a display's memory is too small");
}

std::span<Vec3> Display::moved(std::uint32_t slot) const {
  const std::span<std::byte> all = memory_.bytes().subspan(sizeof(Memory));
  const std::size_t each = all.size() / (3 * sizeof(Vec3));
  return std::span(reinterpret_cast<Vec3*>(all.data()), 3 * each).subspan(slot * each, each);
}

void Display::publish(const Kernel& kernel, std::span<const TickRecord> records,
                      std::uint64_t missed_ticks, std::uint64_t lost_records) {
  DisplayedTick& out = at().slot[index_.draft()];
  const std::size_t needles = std::min(records.size(), out.hand.size());
  out.needles = static_cast<std::uint32_t>(needles);
  std::copy_n(records.begin(), needles, out.hand.begin());
  for (std::uint32_t i = 0; i < needles; ++i) {
    out.nodes[i] = needle_shape(kernel, i, out.node_m[i]);
  }
  out.constraint_particles = stylet::constraint_particles(kernel, out.constraint_particle);
  out.touches = obstacle_touches(kernel, out.touch);
  out.missed_ticks = missed_ticks;
  out.lost_records = lost_records;
  out.published_ns = monotonic_now_ns();
  particles(kernel, moved(index_.draft()));
  index_.publish();
}

const DisplayState* Display::take() {
  if (!index_.take()) return nullptr;
  static_cast<DisplayedTick&>(taken_) = at().slot[index_.taken()];
  taken_.moved_m = moved(index_.taken());
  return &taken_;
}

}  // namespace stylet::hal
