// SPDX-License-Identifier: Apache-2.0
// What creation of the cascade shares between its two halves: nodes with their shares
// (shadow_plan.cpp), and bounds with mobilities (shadow_bounds.cpp). See shadow.h.
//
// Promises: no allocation; at creation only. Units SI.
#pragma once

#include "lattice/shadow.h"
#include "lattice/shadow_walk.h"
#include "state/layout.h"

namespace stylet {

// What creation knows of the cascade while it builds it.
struct Plan {
  const Organ& organ;
  Model& model;
  Shadows& shadows;
};

template <typename Place>
bool comes_before(const Place& a, const Place& b) {
  return order_of(a) < order_of(b);
}

// A place as ShadowNode or ShadowCell have it.
template <typename Place>
Place as_in_file(const Organ& organ, const LevelPlace& at) {
  const LatticePlace place = place_in_lattice(organ, at);
  Place out = {};
  out.x = static_cast<std::uint16_t>(place.x);
  out.y = static_cast<std::uint16_t>(place.y);
  out.z = static_cast<std::uint16_t>(place.z);
  return out;
}

// Whether a particle moves by itself: it is not attached, not hanging, not tied to another one.
bool is_free(const Model& model, std::uint32_t node);

// The node of the cascade that is this particle; a particle of level 0 must be in the border. And
// the particle that is this node of the cascade; kNone for a shadow.
std::uint32_t node_of_particle(const Plan& plan, std::uint32_t particle);
constexpr std::uint32_t kNone = 0xFFFFFFFFU;
std::uint32_t particle_of_node(const Plan& plan, std::uint32_t node);
// The node of the cascade at a corner of a shadow cell.
std::uint32_t node_at_place(const Plan& plan, const LevelPlace& at);

// The shares of a level, up and down. Until creation ends, HangingShare::count is the level.
struct Shares {
  const HangingShare *first, *end;
};
Shares up_shares(const Plan& plan, std::uint32_t level);
Shares down_shares(const Plan& plan, std::uint32_t level);

// Cells, mobilities and bounds; needs nodes and shares.
void fill_bounds(Plan& plan, float limit_per_s2);

}  // namespace stylet
