// SPDX-License-Identifier: Apache-2.0
// Creation of the cascade (lattice/ghosts.h): its nodes, cells, shares, mobilities and bounds.
#include <algorithm>

#include "lattice/ghost_walk.h"
#include "lattice/ghosts.h"
#include "lattice/hanging.h"
#include "lattice/tiles.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// What creation knows of the cascade while it builds it.
struct Plan {
  const Organ& organ;
  Model& model;
  Ghosts& ghosts;
};

// ---- nodes --------------------------------------------------------------------------------------

std::uint32_t particle_of(const Model& model, std::uint32_t node) {
  return model.head->counts.sheets > 1 ? model.representative[node] : node;
}

template <typename Place>
std::uint64_t order_of(const Place& at) {
  return (std::uint64_t{at.z} << 32U) | (std::uint64_t{at.y} << 16U) | at.x;
}
template <typename Place>
bool comes_before(const Place& a, const Place& b) {
  return order_of(a) < order_of(b);
}

template <typename Place>
Place as_in_file(const Organ& organ, const LevelPlace& at) {
  const LatticePlace place = place_in_lattice(organ, at);
  Place out = {};
  out.x = static_cast<std::uint16_t>(place.x);
  out.y = static_cast<std::uint16_t>(place.y);
  out.z = static_cast<std::uint16_t>(place.z);
  return out;
}

// A ghost is the same in all sheets.
GhostNode ghost_at(const Organ& organ, const LevelPlace& at) {
  return as_in_file<GhostNode>(organ, {at.level, 0, at.x, at.y, at.z});
}

bool is_node(const Organ& organ, const LevelPlace& at) {
  const LatticePlace place = place_in_lattice(organ, at);
  return has_node(organ, place.x, place.y, place.z);
}

std::uint32_t particle_at(const Plan& plan, const LevelPlace& at) {
  const LatticePlace place = place_in_lattice(plan.organ, at);
  return node_at(plan.model, place.x, place.y, place.z);
}

// A particle's node of the cascade. One of level 0 must be of the border.
std::uint32_t node_of_particle(const Plan& plan, std::uint32_t particle) {
  const Ghosts& g = plan.ghosts;
  if (particle >= g.first_particle) return particle - g.first_particle;
  const std::uint32_t* const first = plan.model.border;
  const std::uint32_t* const end = first + (g.border_end - g.border_begin);
  const std::uint32_t* const at = std::lower_bound(first, end, particle);
  return g.border_begin + static_cast<std::uint32_t>(at - first);
}

// The node of the cascade at a corner of a ghost cell.
std::uint32_t node_at_place(const Plan& plan, const LevelPlace& at) {
  if (is_node(plan.organ, at)) {
    return node_of_particle(plan, particle_of(plan.model, particle_at(plan, at)));
  }
  // Another sheet or a coarser level may have a node here: then a finer node hangs on it.
  for (std::uint32_t finer = 1; at.level + finer < plan.organ.levels; ++finer) {
    const LevelPlace same = {at.level + finer, at.sheet, at.x << finer, at.y << finer,
                             at.z << finer};
    if (!is_node(plan.organ, same)) continue;
    const HangingNode* const h = hanging_at(plan.model, particle_at(plan, same));
    if (h == nullptr || h->weight[0] != 1) continue;
    if (level_of_particle(plan.model, h->master[0]) > at.level) continue;
    return node_of_particle(plan, h->master[0]);
  }
  const GhostNode* const first = plan.model.ghost;
  const std::uint32_t count = plan.ghosts.ghost_begin[kMaxLevels] - plan.ghosts.border_end;
  const GhostNode* const found =
      std::lower_bound(first, first + count, ghost_at(plan.organ, at), comes_before<GhostNode>);
  return plan.ghosts.border_end + static_cast<std::uint32_t>(found - first);
}

void fill_nodes(Plan& plan) {
  const Counts& counts = plan.model.head->counts;
  Ghosts& g = plan.ghosts;
  std::uint32_t border = 0, ghosts = 0;
  for (std::uint32_t level = 0; level + 1 < counts.levels; ++level) {
    for_each_ghost_corner(plan.organ, level, [&](const LevelPlace& at) {
      if (!is_node(plan.organ, at)) {
        plan.model.ghost[ghosts++] = ghost_at(plan.organ, at);
      } else if (level == 0) {
        plan.model.border[border++] = particle_of(plan.model, particle_at(plan, at));
      }
    });
  }
  for (std::uint32_t i = 0; i < counts.hanging; ++i) {
    for (const std::uint32_t master : plan.model.hanging[i].master) {
      if (master < g.first_particle) plan.model.border[border++] = master;
    }
  }
  std::uint32_t* const first = plan.model.border;
  std::sort(first, first + border);
  border = static_cast<std::uint32_t>(std::unique(first, first + border) - first);
  GhostNode* const ghost = plan.model.ghost;
  std::sort(ghost, ghost + ghosts, comes_before<GhostNode>);
  const auto same = [](const GhostNode& a, const GhostNode& b) {
    return order_of(a) == order_of(b);
  };
  ghosts = static_cast<std::uint32_t>(std::unique(ghost, ghost + ghosts, same) - ghost);
  g.border_end = g.border_begin + border;
  for (std::uint32_t i = 0; i < border; ++i) {
    plan.model.border_place[i] = place_in_tiles(plan.model, first[i]);
  }
  for (std::uint32_t level = 0; level <= kMaxLevels; ++level) {
    const std::uint32_t z = first_plane(plan.organ.level_planes, level);
    const auto below = [&](const GhostNode& each) { return each.z < z; };
    const GhostNode* const at = std::partition_point(ghost, ghost + ghosts, below);
    g.ghost_begin[level] = g.border_end + static_cast<std::uint32_t>(at - ghost);
  }
}

// Where levels begin among planes and particles.
void fill_ranges(Plan& plan) {
  const Counts& counts = plan.model.head->counts;
  Ghosts& g = plan.ghosts;
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

// ---- shares -------------------------------------------------------------------------------------

// A particle that moves by itself: not attached, not hanging, not tied to another one.
bool is_free(const Model& model, std::uint32_t node) {
  return particle_of(model, node) == node && !hangs(model, node) && model.step_per_mass[node] > 0;
}

// What a node gets from coarser ones, as shares from `next` on.
void list_shares(const Plan& plan, const LevelPlace& at, HangingShare*& next) {
  const Model& model = plan.model;
  std::uint32_t child = 0;
  if (is_node(plan.organ, at)) {
    const std::uint32_t particle = particle_at(plan, at);
    child = node_of_particle(plan, particle);
    if (const HangingNode* const h = hanging_at(model, particle); h != nullptr) {
      for (std::uint32_t m = 0; m < 4; ++m) {
        if (h->weight[m] > 0) {
          *next++ = {child, node_of_particle(plan, h->master[m]), h->weight[m], at.level};
        }
      }
      return;
    }
    if (!is_free(model, particle)) return;
  } else {
    child = node_at_place(plan, at);
    if (child < plan.ghosts.border_end) return;  // a coarser node, which no ghost stands for
  }
  for_each_parent(at, [&](const LevelPlace& parent, float weight) {
    *next++ = {child, node_at_place(plan, parent), weight, at.level};
  });
}

// Whether a place that is no node is a corner of a ghost cell of its sheet.
bool is_ghost(const Organ& organ, const LevelPlace& at) {
  if (is_node(organ, at)) return false;
  for (std::uint32_t side = 0; side < 8; ++side) {
    const std::uint32_t dx = side & 1U, dy = (side >> 1U) & 1U, dz = side >> 2U;
    if (at.x < dx || at.y < dy || at.z < dz) continue;
    if (is_ghost_cell(organ, {at.level, at.sheet, at.x - dx, at.y - dy, at.z - dz})) return true;
  }
  return false;
}

// The place of a ghost, in the first sheet that has it.
LevelPlace place_of(const Organ& organ, const GhostNode& ghost) {
  LevelPlace at = place_in_level(organ, {ghost.x, ghost.y, ghost.z});
  for (; at.sheet + 1 < organ.size_y / organ.sheet_rows && !is_ghost(organ, at); ++at.sheet) {
  }
  return at;
}

// The shares of a level in the list that `begin` describes.
struct Shares {
  const HangingShare *first, *end;
};
Shares up_shares(const Plan& plan, std::uint32_t level) {
  const HangingShare* const first = plan.model.up_share;
  return {first + plan.ghosts.up_begin[level], first + plan.ghosts.up_begin[level + 1]};
}
Shares down_shares(const Plan& plan, std::uint32_t level) {
  const HangingShare* const first = plan.model.down_share;
  return {first + plan.ghosts.down_begin[level], first + plan.ghosts.down_begin[level - 1]};
}

// Brings shares into the order of their levels, of who gets and of who gives. HangingShare::count
// is still the level.
void sort_shares(HangingShare* shares, HangingShare* end, bool finest_first,
                 std::uint32_t (&begin_out)[kMaxLevels + 1]) {
  std::sort(shares, end, [=](const HangingShare& a, const HangingShare& b) {
    if (a.count != b.count) return finest_first ? a.count > b.count : a.count < b.count;
    return a.to != b.to ? a.to < b.to : a.from < b.from;
  });
  for (std::uint32_t level = 0; level <= kMaxLevels; ++level) {
    const auto before = [&](const HangingShare& s) {
      return finest_first ? s.count > level : s.count < level;
    };
    begin_out[level] =
        static_cast<std::uint32_t>(std::partition_point(shares, end, before) - shares);
  }
}

// Counts for each that gets how many shares are its own.
void count_shares(HangingShare* first, const HangingShare* end) {
  while (first != end) {
    HangingShare* next = first;
    for (; next != end && next->to == first->to && next->count == first->count; ++next) {
    }
    first->count = static_cast<std::uint32_t>(next - first);
    first = next;
  }
}

void fill_shares_of_levels(Plan& plan) {
  Model& model = plan.model;
  HangingShare* const up = model.up_share;
  HangingShare* end = up;
  const auto list = [&](const LevelPlace& at) { list_shares(plan, at, end); };
  for (std::uint32_t level = 1; level < plan.organ.levels; ++level) {
    for_each_level_node(plan.organ, level, list);
    for (std::uint32_t i = plan.ghosts.ghost_begin[level]; i < plan.ghosts.ghost_begin[level + 1];
         ++i) {
      list(place_of(plan.organ, model.ghost[i - plan.ghosts.border_end]));
    }
  }
  HangingShare* const down = model.down_share;
  HangingShare* down_end = down;
  for (const HangingShare* s = up; s != end; ++s) {
    *down_end++ = {s->from, s->to, s->share, s->count};
  }
  sort_shares(up, end, false, plan.ghosts.up_begin);
  sort_shares(down, down_end, true, plan.ghosts.down_begin);
}

// ---- cells --------------------------------------------------------------------------------------

void fill_cells(Plan& plan) {
  Model& model = plan.model;
  std::uint32_t count = 0;
  for (std::uint32_t level = 0; level + 1U < plan.organ.levels; ++level) {
    for_each_ghost_cell(plan.organ, level, [&](const LevelPlace& at) {
      GhostCell& cell = model.ghost_cell[count++] = as_in_file<GhostCell>(plan.organ, at);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        cell.node[corner] = node_at_place(plan, corner_of(at, corner));
      }
    });
    if (level == 0) plan.ghosts.coarse_cells = count;
  }
  std::sort(&model.ghost_cell[0], &model.ghost_cell[0] + count, comes_before<GhostCell>);
}

GhostCell& cell_around(const Plan& plan, const LevelPlace& child) {
  const GhostCell wanted = as_in_file<GhostCell>(
      plan.organ, {child.level - 1, child.sheet, child.x / 2, child.y / 2, child.z / 2});
  GhostCell* const first = plan.model.ghost_cell;
  return *std::lower_bound(first, first + plan.model.head->counts.ghost_cells, wanted,
                           comes_before<GhostCell>);
}

// A voxel of the organ or a ghost cell, above level 0: its corners are nodes of the cascade.
struct AnyCell {
  LevelPlace at;
  std::uint32_t node[8];
  float bound_n_per_m, fastest_per_s2;
  bool follows;  // its corners follow from those of the cell around it
};

// A weighted mean of nodes.
struct Mean {
  static constexpr std::uint32_t kMost = 64;
  std::uint32_t count = 0;
  std::uint32_t node[kMost];
  float weight[kMost];
  bool whole = true;  // else it has more nodes

  void add(std::uint32_t of_node, float of_weight) {
    const std::uint32_t* const at = std::find(node, node + count, of_node);
    const auto i = static_cast<std::uint32_t>(at - node);
    if (i == kMost) {
      whole = false;
      return;
    }
    weight[i] = (i == count ? 0 : weight[i]) + of_weight;
    node[i] = of_node;
    if (i == count) ++count;
  }
  bool is(const Mean& other) const {
    bool same = whole && other.whole && count == other.count;
    for (std::uint32_t i = 0; i < count && same; ++i) {
      const std::uint32_t* const at = std::find(other.node, other.node + count, node[i]);
      same = at != other.node + count && other.weight[at - other.node] == weight[i];
    }
    return same;
  }
};

// The particle that a node of the cascade is; of a ghost, none.
constexpr std::uint32_t kNone = 0xFFFFFFFFU;
std::uint32_t particle_of_node(const Plan& plan, std::uint32_t node) {
  const Ghosts& g = plan.ghosts;
  if (node < g.border_begin) return g.first_particle + node;
  return node < g.border_end ? plan.model.border[node - g.border_begin] : kNone;
}

// The same with the masters of nodes that hang, and without nodes that are attached.
Mean without_hanging(const Plan& plan, Mean mean) {
  for (std::uint32_t i = 0; i < kMaxLevels; ++i) {  // masters hang on coarser levels
    Mean next;
    next.whole = mean.whole;
    for (std::uint32_t k = 0; k < mean.count; ++k) {
      const std::uint32_t particle = particle_of_node(plan, mean.node[k]);
      const HangingNode* const h = hanging_at(plan.model, particle);
      const bool moves = particle == kNone || plan.model.step_per_mass[particle] > 0;
      if (h == nullptr && moves) next.add(mean.node[k], mean.weight[k]);
      for (std::uint32_t m = 0; h != nullptr && m < 4 && h->weight[m] > 0; ++m) {
        next.add(node_of_particle(plan, h->master[m]), mean.weight[k] * h->weight[m]);
      }
    }
    mean = next;
  }
  return mean;
}

// Whether a node at a corner of a cell moves with the corners of the cell around that: with those
// that lie around its place, in the cell's own sheet. (Weights are powers of two: sums are exact.)
bool follows(const Plan& plan, const LevelPlace& place, std::uint32_t node) {
  Mean wanted, own;
  for_each_parent(place, [&](const LevelPlace& parent, float weight) {
    wanted.add(node_at_place(plan, parent), weight);
  });
  const Shares all = up_shares(plan, place.level);
  const auto before = [](const HangingShare& s, std::uint32_t to) { return s.to < to; };
  const HangingShare* s = std::lower_bound(all.first, all.end, node, before);
  for (; s != all.end && s->to == node; ++s) own.add(s->from, s->share);
  if (own.count == 0) own.add(node, 1);  // attached, or of a coarser level
  return without_hanging(plan, wanted).is(without_hanging(plan, own));
}

// The largest squared frequency of a voxel alone with this bound.
float fastest_of(const Model& model, std::uint32_t slot, float edge_m, float bound_n_per_m) {
  const std::uint32_t material = model.slot_material[slot];
  const float density = organ_material(model.head->organ, material).density_kg_per_m3;
  return 8 * bound_n_per_m / (density * model.slot_fill[slot] * (edge_m * edge_m * edge_m));
}

template <typename Visit>
void for_each_voxel_of(const Plan& plan, std::uint32_t level, Visit visit) {
  const Model& model = plan.model;
  std::uint32_t voxel = 0;
  for (const OrganRun& run : plan.organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
      const LevelPlace at = place_in_level(plan.organ, {run.x + i, run.y, run.z});
      if (at.level != level) continue;
      const Row& row = model.row[model.voxel_row[voxel]];
      const std::uint32_t slot = model.voxel_slot[voxel];
      AnyCell cell = {at, {}, 8 * model.slot_bound[slot], 0, true};
      // In level 0 with what constraint particles may add to any node; finer levels see what they
      // add in each tick.
      const float most = cell.bound_n_per_m + (level == 0 ? model.slot_k[slot] : 0);
      cell.fastest_per_s2 = fastest_of(model, slot, level_of(model, row).edge_m, most);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        if (level == 0) continue;  // nothing is below
        const std::uint32_t node = row.node[corner >> 1U] + slot - row.slot + (corner & 1U);
        cell.node[corner] = node_of_particle(plan, particle_of(model, node));
        cell.follows = cell.follows && follows(plan, corner_of(at, corner), cell.node[corner]);
      }
      visit(cell);
    }
  }
}

// Calls visit(AnyCell) for each cell of a level above 0.
template <typename Visit>
void for_each_cell_of(const Plan& plan, std::uint32_t level, Visit visit) {
  for_each_voxel_of(plan, level, visit);
  for (std::uint32_t i = 0; i < plan.model.head->counts.ghost_cells; ++i) {
    const GhostCell& ghost = plan.model.ghost_cell[i];
    const LevelPlace at = place_in_level(plan.organ, {ghost.x, ghost.y, ghost.z});
    if (at.level != level) continue;
    AnyCell cell = {at, {}, ghost.bound_n_per_m, ghost.fastest_per_s2, true};
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      cell.node[corner] = ghost.node[corner];
      cell.follows = cell.follows && follows(plan, corner_of(at, corner), ghost.node[corner]);
    }
    visit(cell);
  }
}

// ---- mobilities ---------------------------------------------------------------------------------

// Adds what nodes of a level have to the coarser ones that they give to.
void add_down(const Plan& plan, std::uint32_t level, float* of_nodes) {
  const Shares all = down_shares(plan, level);
  for (const HangingShare* s = all.first; s != all.end; ++s) {
    of_nodes[s->to] += s->share * of_nodes[s->from];
  }
}

// What one level moves by itself, and what it leaves to the coarser ones. While this goes on,
// cascade_kg are the masses with what nodes have got, and cascade_mobility is the mass that moves
// at finer levels already.
void fill_level(Plan& plan, std::uint32_t level, float limit_per_s2) {
  Model& model = plan.model;
  Ghosts& g = plan.ghosts;
  float fastest = 0;
  for_each_cell_of(plan, level, [&](const AnyCell& cell) {
    fastest = max_of(fastest, cell.fastest_per_s2);
    if (cell.follows) {
      GhostCell& around = cell_around(plan, cell.at);
      around.bound_n_per_m = max_of(around.bound_n_per_m, 2 * cell.bound_n_per_m);
      around.fastest_per_s2 = max_of(around.fastest_per_s2, cell.fastest_per_s2 / 4);
    } else {
      for (const std::uint32_t node : cell.node) model.cascade_bound[node] += cell.bound_n_per_m;
    }
  });
  g.limit_per_s2[level] = limit_per_s2;
  const float own = min_of(1 / static_cast<float>(plan.organ.levels),
                           limit_per_s2 / max_of(fastest, limit_per_s2 * 1e-6F));
  g.most_slowed = max_of(g.most_slowed, 1 / own);
  const auto for_each = [&](auto visit) {
    for (std::uint32_t i = g.fine_begin[level]; i < g.fine_begin[level + 1]; ++i) visit(i);
    for (std::uint32_t i = g.ghost_begin[level]; i < g.ghost_begin[level + 1]; ++i) visit(i);
  };
  const auto moves = [&](std::uint32_t i) {
    return i >= g.border_begin || is_free(model, g.first_particle + i);
  };
  for_each([&](std::uint32_t i) {
    if (moves(i)) model.cascade_mobility[i] += own * model.cascade_kg[i];
  });
  for (float* of_nodes :
       {&model.cascade_kg[0], &model.cascade_mobility[0], &model.cascade_bound[0]}) {
    add_down(plan, level, of_nodes);
  }
  for_each([&](std::uint32_t i) {
    const float kg = model.cascade_kg[i];
    model.cascade_mobility[i] = kg > 0 && moves(i) ? own / kg : 0;
  });
  const auto is_own = [&](std::uint32_t i) {
    return (i >= g.fine_begin[level] && i < g.fine_begin[level + 1]) ||
           (i >= g.ghost_begin[level] && i < g.ghost_begin[level + 1]);
  };
  for_each_cell_of(plan, level, [&](const AnyCell& cell) {
    if (!cell.follows) return;
    for (const std::uint32_t node : cell.node) {
      if (is_own(node)) model.cascade_bound[node] += cell.bound_n_per_m;
    }
  });
}

// The mass of a node alone; 0 if it is attached, hangs, or is tied to another.
float own_kg(const Model& model, std::uint32_t particle) {
  return is_free(model, particle) ? model.head->substep_s / model.step_per_mass[particle] : 0;
}

void fill_own_kg(Plan& plan) {
  Model& model = plan.model;
  for (std::uint32_t i = 0; i < model.head->counts.cascade; ++i) {
    const std::uint32_t particle = particle_of_node(plan, i);
    model.cascade_kg[i] = particle == kNone ? 0 : own_kg(model, particle);
  }
}

void fill_coarse(Plan& plan, float limit_per_s2) {
  Model& model = plan.model;
  ModelHead& head = *model.head;
  Ghosts& g = plan.ghosts;
  float fastest = 0;
  for_each_voxel_of(plan, 0,
                    [&](const AnyCell& cell) { fastest = max_of(fastest, cell.fastest_per_s2); });
  for (std::uint32_t i = 0; i < g.coarse_cells; ++i) {
    GhostCell& cell = model.ghost_cell[i];
    fastest = max_of(fastest, cell.fastest_per_s2);
    for (const std::uint32_t node : cell.node) model.cascade_bound[node] += cell.bound_n_per_m;
    cell.bound_n_per_m /= 8;  // a mean is over eight corners
  }
  g.fastest_per_s2 = min_of(fastest, most_filtered_per_s2(limit_per_s2));
  for (std::uint32_t i = g.border_begin; i < g.ghost_begin[1]; ++i) {
    const float kg = model.cascade_kg[i], moved = model.cascade_mobility[i];
    model.cascade_mobility[i] = kg > 0 ? (1 - moved / kg) / kg : 0;
    if (i >= g.border_end) continue;
    const std::uint32_t particle = model.border[i - g.border_begin];
    model.cascade_bound[i] += model.bound[particle];
    if (!is_free(model, particle)) model.cascade_mobility[i] = 0;
  }
  head.filter = choose_filter(limit_per_s2, g.fastest_per_s2);
}

}  // namespace

float coarse_limit_per_s2(float limit_per_s2, std::uint32_t levels) {
  return 2 * limit_per_s2 / static_cast<float>(levels + 1);
}

void count_ghosts(const Organ& organ, std::uint64_t fine, Counts& counts_io) {
  Counts& c = counts_io;
  for (std::uint32_t level = 0; level + 1 < c.levels; ++level) {
    for_each_ghost_cell(organ, level, [&](auto&) { ++c.ghost_cells; });
    for_each_ghost_corner(organ, level, [&](const LevelPlace& at) {
      if (!is_node(organ, at)) {
        ++c.ghosts;
      } else if (level == 0) {
        ++c.border;
      }
    });
  }
  c.border += 4 * c.hanging;  // masters; most of them are corners of ghost cells as well
  const auto share = [&](const LevelPlace& at) {
    for_each_parent(at, [&](auto...) { ++c.ghost_shares; });
  };
  for (std::uint32_t level = 1; level < c.levels; ++level) {
    for_each_level_node(organ, level, share);
    if (level + 1 == c.levels) continue;
    for_each_ghost_corner(organ, level, [&](const LevelPlace& at) {
      if (!is_node(organ, at)) share(at);
    });
  }
  c.ghost_shares += c.hanging_shares;
  c.cascade = static_cast<std::uint32_t>(fine) + c.border + c.ghosts;
}

void fill_ghosts(const Organ& organ, Model& model, float limit_per_s2) {
  Plan plan = {organ, model, model.head->ghosts};
  Ghosts& g = plan.ghosts;
  g.on = 1;
  fill_ranges(plan);
  fill_nodes(plan);
  fill_shares_of_levels(plan);
  fill_cells(plan);
  fill_own_kg(plan);
  const float each = limit_per_s2 / static_cast<float>(organ.levels + 1);
  for (std::uint32_t level = organ.levels - 1U; level > 0; --level) fill_level(plan, level, each);
  fill_coarse(plan, coarse_limit_per_s2(limit_per_s2, organ.levels));
  fill_own_kg(plan);
  count_shares(model.up_share, model.up_share + g.up_begin[kMaxLevels]);
  count_shares(model.down_share, model.down_share + g.down_begin[0]);
}

}  // namespace stylet
