// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/sort.h"
#include "lattice/hanging.h"
#include "lattice/shadow_plan.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// ---- cells --------------------------------------------------------------------------------------

void fill_cells(Plan& plan) {
  Model& model = plan.model;
  std::uint32_t count = 0;
  for (std::uint32_t level = 0; level + 1U < plan.organ.levels; ++level) {
    for_each_shadow_cell(plan.organ, level, [&](const LevelPlace& at) {
      ShadowCell& cell = model.shadow_cell[count++] = as_in_file<ShadowCell>(plan.organ, at);
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        cell.node[corner] = node_at_place(plan, corner_of(at, corner));
      }
    });
    if (level == 0) plan.shadows.coarse_cells = count;
  }
  sort(&model.shadow_cell[0], &model.shadow_cell[0] + count, comes_before<ShadowCell>);
}

ShadowCell& cell_around(const Plan& plan, const LevelPlace& child) {
  const ShadowCell wanted = as_in_file<ShadowCell>(
      plan.organ, {child.level - 1, child.sheet, child.x / 2, child.y / 2, child.z / 2});
  ShadowCell* const first = plan.model.shadow_cell;
  return *std::lower_bound(first, first + plan.model.head->counts.shadow_cells, wanted,
                           comes_before<ShadowCell>);
}

// A voxel of the organ or a shadow cell, above level 0: its corners are nodes of the cascade.
struct AnyCell {
  LevelPlace at;
  std::uint32_t node[8];
  float bound_n_per_m, fastest_per_s2;
  bool follows;  // its corners follow from the corners of the coarser cell that holds it
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
      for (std::uint32_t m = 0; h != nullptr && m < kMasters && h->weight[m] > 0; ++m) {
        next.add(node_of_particle(plan, h->master[m]), mean.weight[k] * h->weight[m]);
      }
    }
    mean = next;
  }
  return mean;
}

// Whether a node at a corner of a cell moves with corners of the coarser cell that holds the cell:
// with the corners that lie around the node's place, in the cell's own sheet. (Weights are powers
// of two: sums are exact.)
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

using VisitCell = Function<void(const AnyCell&)>;

void for_each_voxel_of(const Plan& plan, std::uint32_t level, VisitCell visit) {
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
void for_each_cell_of(const Plan& plan, std::uint32_t level, VisitCell visit) {
  for_each_voxel_of(plan, level, visit);
  for (std::uint32_t i = 0; i < plan.model.head->counts.shadow_cells; ++i) {
    const ShadowCell& shadow = plan.model.shadow_cell[i];
    const LevelPlace at = place_in_level(plan.organ, {shadow.x, shadow.y, shadow.z});
    if (at.level != level) continue;
    AnyCell cell = {at, {}, shadow.bound_n_per_m, shadow.fastest_per_s2, true};
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      cell.node[corner] = shadow.node[corner];
      cell.follows = cell.follows && follows(plan, corner_of(at, corner), shadow.node[corner]);
    }
    visit(cell);
  }
}

// ---- mobilities ---------------------------------------------------------------------------------

// Adds what each node of a level has to the coarser nodes that it gives to.
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
  Shadows& g = plan.shadows;
  float fastest = 0;
  for_each_cell_of(plan, level, [&](const AnyCell& cell) {
    fastest = max_of(fastest, cell.fastest_per_s2);
    if (cell.follows) {
      ShadowCell& around = cell_around(plan, cell.at);
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
    for (std::uint32_t i = g.shadow_begin[level]; i < g.shadow_begin[level + 1]; ++i) visit(i);
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
           (i >= g.shadow_begin[level] && i < g.shadow_begin[level + 1]);
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

// What contact of parts that slide may add at the finer levels; model.bound has it at level 0.
void add_slide_room_of_finer(Plan& plan) {
  Model& model = plan.model;
  for (std::uint32_t i = 0; has_slides(model) && i < plan.shadows.border_begin; ++i) {
    model.cascade_bound[i] += model.slide_room[plan.shadows.first_particle + i];
  }
}

// The largest squared frequency of the particles of level 0 to which it may add, if any.
float fastest_slid_per_s2(const Plan& plan) {
  const Model& model = plan.model;
  float fastest = 0;
  for (std::uint32_t i = 0; has_slides(model) && i < plan.shadows.first_particle; ++i) {
    if (!(model.slide_room[i] > 0)) continue;
    const float held = model.hourglass_n_per_m[i] / model.head->hourglass_weight;
    fastest = max_of(fastest, (model.bound[i] + held) / model.particle_kg[i]);
  }
  return fastest;
}

void fill_coarse(Plan& plan, float limit_per_s2) {
  Model& model = plan.model;
  ModelHead& head = *model.head;
  Shadows& g = plan.shadows;
  float fastest = 0;
  for_each_voxel_of(plan, 0,
                    [&](const AnyCell& cell) { fastest = max_of(fastest, cell.fastest_per_s2); });
  for (std::uint32_t i = 0; i < g.coarse_cells; ++i) {
    ShadowCell& cell = model.shadow_cell[i];
    fastest = max_of(fastest, cell.fastest_per_s2);
    for (const std::uint32_t node : cell.node) model.cascade_bound[node] += cell.bound_n_per_m;
    cell.bound_n_per_m /= 8;  // a mean is over eight corners
  }
  fastest = max_of(fastest, fastest_slid_per_s2(plan));
  g.fastest_per_s2 = min_of(fastest, most_filtered_per_s2(limit_per_s2));
  for (std::uint32_t i = g.border_begin; i < g.shadow_begin[1]; ++i) {
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

bool bound_coarse(Model& model, float limit_per_s2) {
  const Counts& counts = model.head->counts;
  bool faster = false;
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    faster = faster || model.step_per_mass[i] > limit_per_s2 * model.particle_kg[i];
  }
  if (!faster) return false;
  for (std::uint32_t z = 0; z <= counts.planes; ++z) {
    const Plane& plane = model.plane[z];
    for (std::uint32_t i = plane.particle_begin; i < plane.particle_end; ++i) {
      model.step_per_mass[i] = plane.level > 0 ? 0
                                               : model.bound[i] + model.hourglass_n_per_m[i] /
                                                                      model.head->hourglass_weight;
    }
  }
  return true;
}

void fill_bounds(Plan& plan, float limit_per_s2) {
  fill_cells(plan);
  fill_own_kg(plan);
  add_slide_room_of_finer(plan);
  const std::uint32_t levels = plan.organ.levels;
  const float coarse = coarse_limit_per_s2(limit_per_s2, levels);
  const float each = (limit_per_s2 - coarse) / static_cast<float>(levels - 1);
  for (std::uint32_t level = levels - 1; level > 0; --level) fill_level(plan, level, each);
  fill_coarse(plan, coarse);
  fill_own_kg(plan);
}

}  // namespace stylet
