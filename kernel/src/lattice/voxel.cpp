// SPDX-License-Identifier: Apache-2.0
#include "lattice/voxel.h"

#include "lattice/rotation.h"

namespace stylet {
namespace {

// A cell of space at a level, in edges of that level.
struct Cell {
  std::int32_t x, y, z;
  std::uint32_t level;
};

// Calls visit(slot, row) for the level's filled voxels of all sheets in a cell of space.
template <typename Visit>
void each_voxel(const Model& model, const Cell& cell, Visit visit) {
  const ModelHead& head = *model.head;
  const Level& level = head.level[cell.level];
  const auto planes = static_cast<std::int32_t>(level.planes);
  if (cell.y < 0 || cell.y >= head.sheet_rows || cell.z < 0 || cell.z >= planes) return;
  const std::uint32_t z = level.first_plane + static_cast<std::uint32_t>(cell.z);
  for (std::int32_t sheet_y = cell.y; sheet_y < head.size_y; sheet_y += head.sheet_rows) {
    const std::uint32_t index = row_at(model, cell.x, static_cast<std::uint32_t>(sheet_y), z);
    if (index == kNoRow) continue;
    const Row& row = model.row[index];
    const std::uint32_t slot = row.slot + static_cast<std::uint32_t>(cell.x - row.x0);
    if (model.slot_k[slot] > 0) visit(slot, index);  // else a hole in the row
  }
}

// Whether a place in a voxel's cell (0 to 1 along each axis) is its own. Only with sheets.
bool is_own(const Model& model, std::uint32_t slot, Vec3 f) {
  const auto quarter = [](float v) {
    return static_cast<std::uint32_t>(max_of(0, min_of(4 * v, 3)));
  };
  const std::uint32_t bit = quarter(f.x) + 4 * quarter(f.y) + 16 * quarter(f.z);
  return ((model.quarters[slot] >> bit) & 1U) != 0;
}

// The level's filled voxel of a cell in space, from all sheets: the voxel that owns the place `f`;
// if none owns it, any filled voxel of the cell.
bool voxel_around(const Model& model, const Cell& cell, Vec3 f, std::uint32_t& slot_out,
                  std::uint32_t& row_out) {
  bool found = false;
  each_voxel(model, cell, [&](std::uint32_t slot, std::uint32_t row) {
    if (found && !is_own(model, slot, f)) return;
    found = true;
    slot_out = slot;
    row_out = row;
  });
  return found;
}

// The voxel in which a rest point lies, of the finest level that has one there, and where in it (0
// to 1 along each axis); false if in none.
bool find_voxel(const Model& model, Vec3 rest_m, std::uint32_t& slot_out, std::uint32_t& row_out,
                Vec3& part_out) {
  const ModelHead& head = *model.head;
  for (std::uint32_t level = head.counts.levels; level-- > 0;) {
    const Level& own = head.level[level];
    const Vec3 g = own.inverse_edge_per_m * (rest_m - head.origin_m);
    if (!(g.x >= 0 && g.y >= 0 && g.z >= 0 && g.x < static_cast<float>(head.size_x) &&
          g.y < static_cast<float>(head.sheet_rows) && g.z < static_cast<float>(own.planes))) {
      continue;
    }
    const Cell cell = {static_cast<std::int32_t>(g.x), static_cast<std::int32_t>(g.y),
                       static_cast<std::int32_t>(g.z), level};
    part_out = g - Vec3{static_cast<float>(cell.x), static_cast<float>(cell.y),
                        static_cast<float>(cell.z)};
    if (voxel_around(model, cell, part_out, slot_out, row_out)) return true;
  }
  return false;
}

// The particle at a voxel's corner (bits x, y, z), or the one that it is tied to. Only with sheets.
std::uint32_t corner_particle(const Model& model, std::uint32_t slot, const Row& row,
                              std::uint32_t corner) {
  return model.representative[row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U)];
}

// The eight cells of a level around a place, the lowest first; where the place lies between their
// centres.
struct Around {
  Cell low;
  Vec3 f;

  Cell cell(std::int32_t corner) const {
    return {low.x + (corner & 1), low.y + ((corner >> 1) & 1), low.z + (corner >> 2), low.level};
  }
};

Around cells_around(const ModelHead& head, std::uint32_t level, Vec3 rest_m) {
  const Vec3 g =
      head.level[level].inverse_edge_per_m * (rest_m - head.origin_m) - Vec3{0.5F, 0.5F, 0.5F};
  // Truncation of a shifted value: floor without libm. Points as far out as the bounds have no
  // voxel, and a NaN becomes such a point.
  const auto whole = [](float v) {
    return static_cast<std::int32_t>(max_of(-2, min_of(v, 70000)) + 4.0F) - 4;
  };
  const std::int32_t x0 = whole(g.x), y0 = whole(g.y), z0 = whole(g.z);
  return {{x0, y0, z0, level},
          {clamp(g.x - static_cast<float>(x0), 0, 1), clamp(g.y - static_cast<float>(y0), 0, 1),
           clamp(g.z - static_cast<float>(z0), 0, 1)}};
}

float tent(const Around& around, std::int32_t corner) {
  const Vec3& f = around.f;
  return ((corner & 1) != 0 ? f.x : 1 - f.x) * ((corner & 2) != 0 ? f.y : 1 - f.y) *
         ((corner & 4) != 0 ? f.z : 1 - f.z);
}

// The level whose cells around a place hold it: the level of the voxel in which the place lies; if
// it lies in no voxel, the finest level with a voxel around the place.
std::uint32_t level_around(const Model& model, Vec3 rest_m) {
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  if (!is_graded(model)) return 0;
  if (find_voxel(model, rest_m, slot, row, part)) return model.plane[model.row[row].plane].level;
  std::uint32_t level = model.head->counts.levels - 1;
  for (bool any = false; level > 0 && !any; level -= any ? 0 : 1) {
    const Around around = cells_around(*model.head, level, rest_m);
    for (std::int32_t corner = 0; corner < 8; ++corner) {
      each_voxel(model, around.cell(corner), [&](auto...) { any = true; });
    }
  }
  return level;
}

// How far within its cell a place is moved, in edges: on a face it could be either cell's.
constexpr float kInset = 1.0F / 16;

// For a cell around a place that belongs to another level: the coarser voxel that holds the cell,
// or, of the finer voxels in the cell, the one nearest to the place.
bool voxel_across(const Model& model, const Around& around, std::int32_t corner,
                  std::uint32_t& slot_out, std::uint32_t& row_out) {
  const ModelHead& head = *model.head;
  const Cell cell = around.cell(corner);
  // The cell's point nearest to the place, but within the cell.
  const auto nearest = [](float f, bool high) {
    return high ? max_of(f - 0.5F, kInset) : min_of(f + 0.5F, 1 - kInset);
  };
  const Vec3 f = {nearest(around.f.x, (corner & 1) != 0), nearest(around.f.y, (corner & 2) != 0),
                  nearest(around.f.z, (corner & 4) != 0)};
  const Vec3 at_m =
      head.origin_m +
      head.level[cell.level].edge_m * (Vec3{static_cast<float>(cell.x), static_cast<float>(cell.y),
                                            static_cast<float>(cell.z)} +
                                       f);
  Vec3 part = {};
  return find_voxel(model, at_m, slot_out, row_out, part);
}

// The eight cells have one node in common. With sheets, the part in which the place lies says which
// particle is there; parts without that particle do not hold the place.
std::uint32_t common_particle(const Model& model, const Around& around) {
  std::uint32_t particle = 0;
  float best = 0;
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    // In its own cell, which has the highest tent, the place chooses among the parts.
    const auto in_cell = [&](float f, int bit) {
      return ((corner >> bit) & 1) != 0 ? f - 0.5F : f + 0.5F;
    };
    const Vec3 f = {in_cell(around.f.x, 0), in_cell(around.f.y, 1), in_cell(around.f.z, 2)};
    const float weight = tent(around, corner);
    each_voxel(model, around.cell(corner), [&](std::uint32_t slot, std::uint32_t row_index) {
      const Row& row = model.row[row_index];
      const float rank = is_own(model, slot, f) ? 2 * weight : weight;
      if (!(rank > best)) return;
      best = rank;
      particle = corner_particle(model, slot, row, 7U - static_cast<std::uint32_t>(corner));
    });
  }
  return particle;
}

}  // namespace

// Found through any voxel row beside it.
std::uint32_t node_at(const Model& model, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const ModelHead& head = *model.head;
  for (std::uint32_t side = 0; side < 8; ++side) {
    const std::uint32_t dx = side & 1U, dy = (side >> 1U) & 1U, dz = side >> 2U;
    if (x < dx || y < dy || z < dz || y - dy >= head.size_y || z - dz >= head.size_z) continue;
    const std::uint32_t row = row_at(model, static_cast<std::int32_t>(x - dx), y - dy, z - dz);
    if (row != kNoRow) return model.row[row].node[side >> 1U] + x - model.row[row].x0;
  }
  return 0;
}

Corners sum_corners(const Model& model, const State& state, std::uint32_t slot,
                    std::uint32_t row_index) {
  const Row& row = model.row[row_index];
  const std::uint32_t along = slot - row.slot;
  const float scale = level_of(model, row).inverse_edge_per_m * 0.25F;
  const float* u[3] = {state.ux, state.uy, state.uz};
  Corners out = {};
  float mean[3] = {};
  for (int c = 0; c < 3; ++c) {
    float low[4], high[4];
    for (int n = 0; n < 4; ++n) {
      low[n] = u[c][row.node[n] + along];
      high[n] = u[c][row.node[n] + along + 1];
    }
    const float s0 = low[0] + high[0], s1 = low[1] + high[1];
    const float s2 = low[2] + high[2], s3 = low[3] + high[3];
    const float d0 = high[0] - low[0], d1 = high[1] - low[1];
    const float d2 = high[2] - low[2], d3 = high[3] - low[3];
    mean[c] = ((s0 + s1) + (s2 + s3)) * 0.125F;
    out.gradient[3 * c] = ((d0 + d1) + (d2 + d3)) * scale;
    out.gradient[3 * c + 1] = ((s1 - s0) + (s3 - s2)) * scale;
    out.gradient[3 * c + 2] = ((s2 + s3) - (s0 + s1)) * scale;
  }
  out.mean_m = {mean[0], mean[1], mean[2]};
  return out;
}

Vec3 rest_centre(const Model& model, std::uint32_t slot, const Row& row) {
  const float edge_m = level_of(model, row).edge_m;
  return model.head->origin_m + edge_m * (cell_of(model, slot, row) + Vec3{0.5F, 0.5F, 0.5F});
}

void sum_tied(const Model& model, float* of_node) {
  const std::uint32_t ties = model.head->counts.ties;
  for (std::uint32_t i = 0; i < ties; ++i) {
    of_node[model.tie[i].representative] += of_node[model.tie[i].node];
  }
  for (std::uint32_t i = 0; i < ties; ++i) {
    of_node[model.tie[i].node] = of_node[model.tie[i].representative];
  }
}

Quat rotation_of(const float a[9], Quat start) {
  Quat q = start;
  for (int i = 0; i < 2; ++i) {
    rotation_step<1>(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], q.w, q.x, q.y, q.z);
  }
  return q;
}

Quat corner_rotation(const State& state, std::uint32_t slot, const Corners& corners) {
  const float* g = corners.gradient;
  const float a[9] = {1 + g[0], g[1], g[2], g[3], 1 + g[4], g[5], g[6], g[7], 1 + g[8]};
  return rotation_of(a, {state.qw[slot], state.qx[slot], state.qy[slot], state.qz[slot]});
}

bool present_place(const Model& model, const State& state, Vec3 rest_m, Vec3& place_out_m) {
  std::uint32_t slot = 0, row_index = 0;
  Vec3 f = {};
  if (!find_voxel(model, rest_m, slot, row_index, f)) return false;
  const Row& row = model.row[row_index];
  place_out_m = rest_m;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t p = row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U);
    const float weight = ((corner & 1U) != 0 ? f.x : 1 - f.x) *
                         ((corner & 2U) != 0 ? f.y : 1 - f.y) *
                         ((corner & 4U) != 0 ? f.z : 1 - f.z);
    place_out_m = place_out_m + weight * Vec3{state.ux[p], state.uy[p], state.uz[p]};
  }
  return true;
}

bool inside_lattice(const Model& model, Vec3 rest_m) {
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  return find_voxel(model, rest_m, slot, row, part);
}

std::uint32_t material_at(const Model& model, Vec3 rest_m) {
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  if (!find_voxel(model, rest_m, slot, row, part)) return kNoTissue;
  const std::uint32_t mixed = model.slot_mixed[slot];
  if (mixed == kNotMixed) return model.slot_material[slot];
  const OrganMixed& two = model.organ().mixed[mixed];
  const bool beyond = dot({two.nx, two.ny, two.nz}, part) > two.limit;
  return beyond ? two.material : model.slot_material[slot];
}

std::uint32_t material_held_at(const Model& model, Vec3 rest_m) {
  const std::uint32_t there = material_at(model, rest_m);
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  if (there != kNoTissue || !find_voxel(model, rest_m, slot, row, part)) return there;
  return model.slot_material[slot];
}

VoxelFrame voxel_frame(const Model& model, const State& state, std::uint32_t slot,
                       std::uint32_t row) {
  const Corners corners = sum_corners(model, state, slot, row);
  const Vec3 rest = rest_centre(model, slot, model.row[row]);
  return {rotation_matrix(corner_rotation(state, slot, corners)), rest + corners.mean_m, rest};
}

namespace {

// A place's supports as they are found. Cells of one level may lie in the same coarser voxel.
struct Supports {
  Support* of;
  std::uint32_t count = 0;
  float sum = 0;  // of weights

  void add(std::uint32_t slot, std::uint32_t row, float weight) {
    sum = sum + weight;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (of[i].slot == slot) {
        of[i].weight = of[i].weight + weight;
        return;
      }
    }
    of[count++] = {slot, row, weight, {}, {}, {}};
  }
};

}  // namespace

std::uint32_t find_supports(const Model& model, Vec3 rest_m,
                            Support supports_out[kSupportsPerParticle], Weighting weighting) {
  const ModelHead& head = *model.head;
  const Around around = cells_around(head, level_around(model, rest_m), rest_m);
  const bool one_sheet = head.counts.sheets == 1;
  const std::uint32_t particle = one_sheet ? 0 : common_particle(model, around);
  Supports found = {supports_out};
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    const float of_corner = weighting == Weighting::kEven ? 0.125F : tent(around, corner);
    const auto weight_of = [&](std::uint32_t slot) {
      const float fill = model.slot_fill[slot];
      return of_corner *
             (weighting == Weighting::kStiff ? std::sqrt(fill * model.slot_k[slot]) : fill);
    };
    bool taken = false;  // one voxel per cell is enough
    each_voxel(model, around.cell(corner), [&](std::uint32_t slot, std::uint32_t row_index) {
      const float weight = weight_of(slot);
      const auto common = 7U - static_cast<std::uint32_t>(corner);
      if (taken || !(weight > 0) ||
          !(one_sheet || corner_particle(model, slot, model.row[row_index], common) == particle)) {
        return;
      }
      found.add(slot, row_index, weight);
      taken = true;
    });
    std::uint32_t slot = 0, row = 0;
    if (taken || !is_graded(model) || !one_sheet ||
        !voxel_across(model, around, corner, slot, row)) {
      continue;
    }
    const float weight = weight_of(slot);
    if (weight > 0) found.add(slot, row, weight);
  }
  std::uint32_t count = found.count;
  float sum = found.sum;
  if (count > 0 && head.rules.one_support) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < count; ++i) {
      if (supports_out[i].weight > supports_out[best].weight) best = i;
    }
    supports_out[0] = supports_out[best];
    count = 1;
    sum = supports_out[0].weight;
  }
  for (std::uint32_t i = 0; i < count; ++i) supports_out[i].weight = supports_out[i].weight / sum;
  return count;
}

}  // namespace stylet
