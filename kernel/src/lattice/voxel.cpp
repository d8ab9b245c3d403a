// SPDX-License-Identifier: Apache-2.0
#include "lattice/voxel.h"

#include "lattice/rotation.h"

namespace stylet {
namespace {

// Calls visit(slot, row) for the filled voxels of all sheets in a cell of space.
template <typename Visit>
void each_voxel(const Model& model, std::int32_t x, std::int32_t y, std::int32_t z, Visit visit) {
  const ModelHead& head = *model.head;
  if (y < 0 || y >= head.sheet_rows || z < 0 || z >= head.size_z) return;
  for (std::int32_t sheet_y = y; sheet_y < head.size_y; sheet_y += head.sheet_rows) {
    const std::uint32_t index =
        row_at(model, x, static_cast<std::uint32_t>(sheet_y), static_cast<std::uint32_t>(z));
    if (index == kNoRow) continue;
    const Row& row = model.row[index];
    const std::uint32_t slot = row.slot + static_cast<std::uint32_t>(x - row.x0);
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

// A filled voxel of a cell in space, from all sheets: the owner of the place `f`; else any of them.
bool voxel_around(const Model& model, Vec3 cell, Vec3 f, std::uint32_t& slot_out,
                  std::uint32_t& row_out) {
  bool found = false;
  each_voxel(model, static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y),
             static_cast<std::int32_t>(cell.z), [&](std::uint32_t slot, std::uint32_t row) {
               if (found && !is_own(model, slot, f)) return;
               found = true;
               slot_out = slot;
               row_out = row;
             });
  return found;
}

// The particle at a voxel's corner (bits x, y, z), or the one that it is tied to. Only with sheets.
std::uint32_t corner_particle(const Model& model, std::uint32_t slot, const Row& row,
                              std::uint32_t corner) {
  return model.representative[row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U)];
}

// The eight cells around a place, the lowest first; where the place lies between their centres.
struct Around {
  std::int32_t x0, y0, z0;
  Vec3 f;
};

Around cells_around(const ModelHead& head, Vec3 rest_m) {
  const Vec3 g = head.inverse_edge_per_m * (rest_m - head.origin_m) - Vec3{0.5F, 0.5F, 0.5F};
  // Truncation of a shifted value: floor without libm. Points as far out as the bounds have no
  // voxel, and a NaN becomes such a point.
  const auto whole = [](float v) {
    return static_cast<std::int32_t>(max_of(-2, min_of(v, 70000)) + 4.0F) - 4;
  };
  const std::int32_t x0 = whole(g.x), y0 = whole(g.y), z0 = whole(g.z);
  return {x0,
          y0,
          z0,
          {clamp(g.x - static_cast<float>(x0), 0, 1), clamp(g.y - static_cast<float>(y0), 0, 1),
           clamp(g.z - static_cast<float>(z0), 0, 1)}};
}

float tent(const Around& around, std::int32_t corner) {
  const Vec3& f = around.f;
  return ((corner & 1) != 0 ? f.x : 1 - f.x) * ((corner & 2) != 0 ? f.y : 1 - f.y) *
         ((corner & 4) != 0 ? f.z : 1 - f.z);
}

template <typename Visit>
void each_voxel(const Model& model, const Around& around, std::int32_t corner, Visit visit) {
  each_voxel(model, around.x0 + (corner & 1), around.y0 + ((corner >> 1) & 1),
             around.z0 + (corner >> 2), visit);
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
    each_voxel(model, around, corner, [&](std::uint32_t slot, std::uint32_t row_index) {
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

Corners sum_corners(const Model& model, const State& state, std::uint32_t slot,
                    std::uint32_t row_index) {
  const Row& row = model.row[row_index];
  const std::uint32_t along = slot - row.slot;
  const float scale = model.head->inverse_edge_per_m * 0.25F;
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
  const ModelHead& head = *model.head;
  return head.origin_m + head.edge_m * (cell_of(model, slot, row) + Vec3{0.5F, 0.5F, 0.5F});
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

namespace {

// The voxel in which a rest point lies, and where in it (0 to 1 along each axis); false if in none.
bool find_voxel(const Model& model, Vec3 rest_m, std::uint32_t& slot_out, std::uint32_t& row_out,
                Vec3& part_out) {
  const ModelHead& head = *model.head;
  const Vec3 g = head.inverse_edge_per_m * (rest_m - head.origin_m);
  if (!(g.x >= 0 && g.y >= 0 && g.z >= 0 && g.x < static_cast<float>(head.size_x) &&
        g.y < static_cast<float>(head.sheet_rows) && g.z < static_cast<float>(head.size_z))) {
    return false;
  }
  const Vec3 low = {static_cast<float>(static_cast<std::uint32_t>(g.x)),
                    static_cast<float>(static_cast<std::uint32_t>(g.y)),
                    static_cast<float>(static_cast<std::uint32_t>(g.z))};
  part_out = g - low;
  return voxel_around(model, low, part_out, slot_out, row_out);
}

}  // namespace

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

VoxelFrame voxel_frame(const Model& model, const State& state, std::uint32_t slot,
                       std::uint32_t row) {
  const Corners corners = sum_corners(model, state, slot, row);
  const Vec3 rest = rest_centre(model, slot, model.row[row]);
  return {rotation_matrix(corner_rotation(state, slot, corners)), rest + corners.mean_m, rest};
}

std::uint32_t find_supports(const Model& model, Vec3 rest_m,
                            Support supports_out[kSupportsPerParticle], Weighting weighting) {
  const ModelHead& head = *model.head;
  const Around around = cells_around(head, rest_m);
  const bool one_sheet = head.counts.sheets == 1;
  const std::uint32_t particle = one_sheet ? 0 : common_particle(model, around);
  std::uint32_t count = 0;
  float sum = 0;
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    const float of_corner = weighting == Weighting::kEven ? 0.125F : tent(around, corner);
    bool taken = false;  // one voxel per cell is enough
    each_voxel(model, around, corner, [&](std::uint32_t slot, std::uint32_t row_index) {
      const float fill = model.slot_fill[slot];
      const float part =
          weighting == Weighting::kStiff ? std::sqrt(fill * model.slot_k[slot]) : fill;
      const float weight = of_corner * part;
      const auto common = 7U - static_cast<std::uint32_t>(corner);
      if (taken || !(weight > 0) ||
          !(one_sheet || corner_particle(model, slot, model.row[row_index], common) == particle)) {
        return;
      }
      supports_out[count++] = {slot, row_index, weight, {}, {}, {}};
      sum = sum + weight;
      taken = true;
    });
  }
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
