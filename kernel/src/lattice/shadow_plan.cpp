// SPDX-License-Identifier: Apache-2.0
#include "lattice/shadow_plan.h"

#include <algorithm>
#include <functional>

#include "base/sort.h"
#include "lattice/hanging.h"
#include "lattice/shadow_sheets.h"
#include "lattice/tiles.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Part of the step's limit that is the coarsest level's. With less its filter needs more passes, or
// mass where seven are not enough; with more the finer levels' short waves are slower still.
constexpr float kCoarsePart = 0.8F;

ShadowNode shadow_at(const Organ& organ, const LevelPlace& at) {
  return as_in_file<ShadowNode>(organ, {at.level, shadow_sheet(organ, at), at.x, at.y, at.z});
}

void fill_nodes(Plan& plan) {
  const Counts& counts = plan.model.head->counts;
  Shadows& g = plan.shadows;
  std::uint32_t border = 0, shadows = 0;
  for (std::uint32_t level = 0; level + 1 < counts.levels; ++level) {
    for_each_shadow_corner(plan.organ, level, [&](const LevelPlace& at) {
      LatticePlace node = {};
      if (!find_level_node(plan.organ, at, node)) {
        plan.model.shadow[shadows++] = shadow_at(plan.organ, at);
      } else if (level == 0) {
        plan.model.border[border++] =
            particle_of(plan.model, node_at(plan.model, node.x, node.y, node.z));
      }
    });
  }
  for (std::uint32_t i = 0; i < counts.hanging; ++i) {
    for (const std::uint32_t master : plan.model.hanging[i].master) {
      if (master < g.first_particle) plan.model.border[border++] = master;
    }
  }
  std::uint32_t* const first = plan.model.border;
  sort(first, first + border, std::less<>{});
  border = static_cast<std::uint32_t>(std::unique(first, first + border) - first);
  ShadowNode* const shadow = plan.model.shadow;
  sort(shadow, shadow + shadows, comes_before<ShadowNode>);
  const auto same = [](const ShadowNode& a, const ShadowNode& b) {
    return order_of(a) == order_of(b);
  };
  shadows = static_cast<std::uint32_t>(std::unique(shadow, shadow + shadows, same) - shadow);
  g.border_end = g.border_begin + border;
  for (std::uint32_t i = 0; i < border; ++i) {
    plan.model.border_place[i] = place_in_tiles(plan.model, first[i]);
  }
  for (std::uint32_t level = 0; level <= kMaxLevels; ++level) {
    const std::uint32_t z = first_plane(plan.organ.level_planes, level);
    const auto below = [&](const ShadowNode& each) { return each.z < z; };
    const ShadowNode* const at = std::partition_point(shadow, shadow + shadows, below);
    g.shadow_begin[level] = g.border_end + static_cast<std::uint32_t>(at - shadow);
  }
}

// Where levels begin among planes and particles.
void fill_ranges(Plan& plan) {
  const Counts& counts = plan.model.head->counts;
  Shadows& g = plan.shadows;
  const Plane* const first = plan.model.plane;
  const Plane* const end = first + counts.planes + 1;
  const auto begin_of = [&](std::uint32_t level) {
    const Plane* const plane =
        std::partition_point(first, end, [&](const Plane& p) { return p.level < level; });
    return plane == end ? counts.particles : plane->particle_begin;
  };
  g.coarse_planes = static_cast<std::uint32_t>(
      std::partition_point(first, end, [](const Plane& p) { return p.level < 1; }) - first);
  g.first_particle = begin_of(1);
  for (std::uint32_t level = 1; level <= kMaxLevels; ++level) {
    g.fine_begin[level] = begin_of(level) - g.first_particle;
  }
  g.border_begin = counts.particles - g.first_particle;
}

// What a node of the cascade gets from the coarser ones around its place, as shares from `next` on.
void list_parents(const Plan& plan, const LevelPlace& at, std::uint32_t child,
                  HangingShare*& next) {
  for_each_parent(at, [&](const LevelPlace& parent, float weight) {
    *next++ = {child, node_at_place(plan, parent), weight, at.level};
  });
}

// What a node of the lattice gets.
void list_shares(const Plan& plan, const LevelPlace& at, HangingShare*& next) {
  const Model& model = plan.model;
  const LatticePlace place = place_in_lattice(plan.organ, at);
  const std::uint32_t particle = node_at(model, place.x, place.y, place.z);
  const std::uint32_t child = node_of_particle(plan, particle);
  if (const HangingNode* const h = hanging_at(model, particle); h != nullptr) {
    for (std::uint32_t m = 0; m < kMasters; ++m) {
      if (h->weight[m] > 0) {
        *next++ = {child, node_of_particle(plan, h->master[m]), h->weight[m], at.level};
      }
    }
    return;
  }
  if (is_free(model, particle)) list_parents(plan, at, child, next);
}

// Brings shares into order, and finds where each level's begin.
void sort_shares(HangingShare* shares, HangingShare* end, bool finest_first,
                 std::uint32_t (&begin_out)[kMaxLevels + 1]) {
  order_shares(shares, end, finest_first);
  for (std::uint32_t level = 0; level <= kMaxLevels; ++level) {
    const auto before = [&](const HangingShare& s) {
      return finest_first ? s.count > level : s.count < level;
    };
    begin_out[level] =
        static_cast<std::uint32_t>(std::partition_point(shares, end, before) - shares);
  }
}

void fill_shares_of_levels(Plan& plan) {
  Model& model = plan.model;
  HangingShare* const up = model.up_share;
  HangingShare* end = up;
  for (std::uint32_t level = 1; level < plan.organ.levels; ++level) {
    for_each_level_node(plan.organ, level,
                        [&](const LevelPlace& at) { list_shares(plan, at, end); });
    for (std::uint32_t i = plan.shadows.shadow_begin[level];
         i < plan.shadows.shadow_begin[level + 1]; ++i) {
      const ShadowNode& shadow = model.shadow[i - plan.shadows.border_end];
      list_parents(plan, place_in_level(plan.organ, {shadow.x, shadow.y, shadow.z}), i, end);
    }
  }
  HangingShare* const down = model.down_share;
  HangingShare* down_end = down;
  for (const HangingShare* s = up; s != end; ++s) {
    *down_end++ = {s->from, s->to, s->share, s->count};
  }
  sort_shares(up, end, false, plan.shadows.up_begin);
  sort_shares(down, down_end, true, plan.shadows.down_begin);
}

}  // namespace

bool is_free(const Model& model, std::uint32_t node) {
  return particle_of(model, node) == node && !hangs(model, node) && model.step_per_mass[node] > 0;
}

std::uint32_t node_of_particle(const Plan& plan, std::uint32_t particle) {
  const Shadows& g = plan.shadows;
  if (particle >= g.first_particle) return particle - g.first_particle;
  const std::uint32_t* const first = plan.model.border;
  const std::uint32_t* const end = first + (g.border_end - g.border_begin);
  const std::uint32_t* const at = std::lower_bound(first, end, particle);
  return g.border_begin + static_cast<std::uint32_t>(at - first);
}

std::uint32_t particle_of_node(const Plan& plan, std::uint32_t node) {
  const Shadows& g = plan.shadows;
  if (node < g.border_begin) return g.first_particle + node;
  return node < g.border_end ? plan.model.border[node - g.border_begin] : kNone;
}

std::uint32_t node_at_place(const Plan& plan, const LevelPlace& at) {
  LatticePlace node = {};
  if (find_level_node(plan.organ, at, node)) {
    return node_of_particle(plan,
                            particle_of(plan.model, node_at(plan.model, node.x, node.y, node.z)));
  }
  const ShadowNode* const first = plan.model.shadow;
  const std::uint32_t count = plan.shadows.shadow_begin[kMaxLevels] - plan.shadows.border_end;
  const ShadowNode* const found =
      std::lower_bound(first, first + count, shadow_at(plan.organ, at), comes_before<ShadowNode>);
  return plan.shadows.border_end + static_cast<std::uint32_t>(found - first);
}

Shares up_shares(const Plan& plan, std::uint32_t level) {
  const HangingShare* const first = plan.model.up_share;
  return {first + plan.shadows.up_begin[level], first + plan.shadows.up_begin[level + 1]};
}

Shares down_shares(const Plan& plan, std::uint32_t level) {
  const HangingShare* const first = plan.model.down_share;
  return {first + plan.shadows.down_begin[level], first + plan.shadows.down_begin[level - 1]};
}

float coarse_limit_per_s2(float limit_per_s2, std::uint32_t levels) {
  return levels > 1 ? kCoarsePart * limit_per_s2 : limit_per_s2;
}

void count_shadows(const Organ& organ, std::uint64_t fine, Counts& counts_io) {
  Counts& c = counts_io;
  for (std::uint32_t level = 0; level + 1 < c.levels; ++level) {
    for_each_shadow_cell(organ, level, [&](auto&) { ++c.shadow_cells; });
    for_each_shadow_corner(organ, level, [&](const LevelPlace& at) {
      LatticePlace node = {};
      if (!find_level_node(organ, at, node)) {
        ++c.shadows;
      } else if (level == 0) {
        ++c.border;
      }
    });
  }
  c.border += kMasters * c.hanging;  // masters; most of them are corners of shadow cells as well
  const auto share = [&](const LevelPlace& at) {
    for_each_parent(at, [&](auto...) { ++c.shadow_shares; });
  };
  for (std::uint32_t level = 1; level < c.levels; ++level) {
    for_each_level_node(organ, level, share);
    if (level + 1 == c.levels) continue;
    for_each_shadow_corner(organ, level, [&](const LevelPlace& at) {
      LatticePlace node = {};
      if (!find_level_node(organ, at, node)) share(at);
    });
  }
  c.shadow_shares += c.hanging_shares;
  c.cascade = static_cast<std::uint32_t>(fine) + c.border + c.shadows;
}

void fill_shadows(const Organ& organ, Model& model, float limit_per_s2) {
  Plan plan = {organ, model, model.head->shadows};
  Shadows& g = plan.shadows;
  g.on = 1;
  fill_ranges(plan);
  fill_nodes(plan);
  fill_shares_of_levels(plan);
  fill_bounds(plan, limit_per_s2);
  count_shares(model.up_share, model.up_share + g.up_begin[kMaxLevels]);
  count_shares(model.down_share, model.down_share + g.down_begin[0]);
}

}  // namespace stylet
