// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sample_parts.h"

#include <bit>
#include <limits>

namespace stylet::offline {

Near near_samples(const SamplePlaces& places, Vec offset, double reach) {
  Near near{};
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = 0; j < near.size(); ++j) {
      const bool is_near = length(places[j] + offset - places[i]) < reach;
      near[i] |= static_cast<std::uint64_t>(is_near) << j;
    }
  }
  return near;
}

std::uint64_t reached(std::uint64_t from, const Near& near) {
  std::uint64_t all = 0;
  for (; from != 0; from &= from - 1) all |= near[static_cast<unsigned>(std::countr_zero(from))];
  return all;
}

std::vector<std::uint64_t> connected_parts(std::uint64_t bits, const Near& near) {
  std::vector<std::uint64_t> parts;
  while (bits != 0) {
    std::uint64_t part = bits & (~bits + 1), before = 0;
    while (part != before) {
      before = part;
      part |= reached(part, near) & bits;
    }
    parts.push_back(part);
    bits &= ~part;
  }
  return parts;
}

double distance_to(std::uint64_t bits, const SamplePlaces& places, Vec offset, Vec place) {
  double least = std::numeric_limits<double>::infinity();
  for (; bits != 0; bits &= bits - 1) {
    const Vec at = places[static_cast<unsigned>(std::countr_zero(bits))] + offset;
    least = std::min(least, length(at - place));
  }
  return least;
}

}  // namespace stylet::offline
