// SPDX-License-Identifier: Apache-2.0
#include "voxel.h"

#include "rotation.h"

namespace stylet {

Corners sum_corners(const View& view, std::uint32_t slot, std::uint32_t row_index) {
  const Row& row = view.model.row[row_index];
  const std::uint32_t along = slot - row.slot;
  const float scale = view.model.head->inverse_edge_per_m * 0.25F;
  const float* u[3] = {view.state.ux, view.state.uy, view.state.uz};
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

Vec3 rest_centre(const View& view, std::uint32_t slot, const Row& row) {
  const ModelHead& head = *view.model.head;
  return head.origin_m + head.edge_m * Vec3{static_cast<float>(row.x0 + (slot - row.slot)) + 0.5F,
                                            static_cast<float>(row.y) + 0.5F,
                                            static_cast<float>(row.z) + 0.5F};
}

Quat rotation_of(const float a[9], Quat start) {
  Quat q = start;
  for (int i = 0; i < 2; ++i) {
    rotation_step<1>(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], q.w, q.x, q.y, q.z);
  }
  return q;
}

Quat corner_rotation(const View& view, std::uint32_t slot, const Corners& corners) {
  const float* g = corners.gradient;
  const float a[9] = {1 + g[0], g[1], g[2], g[3], 1 + g[4], g[5], g[6], g[7], 1 + g[8]};
  return rotation_of(
      a, {view.state.qw[slot], view.state.qx[slot], view.state.qy[slot], view.state.qz[slot]});
}

namespace {

// The voxel a rest point lies in, and where in it (0 to 1 along each axis); false outside them all.
bool find_voxel(const View& view, Vec3 rest_m, std::uint32_t& slot_out, std::uint32_t& row_out,
                Vec3& part_out) {
  const ModelHead& head = *view.model.head;
  const Vec3 g = head.inverse_edge_per_m * (rest_m - head.origin_m);
  if (!(g.x >= 0 && g.y >= 0 && g.z >= 0 && g.x < static_cast<float>(head.size_x) &&
        g.y < static_cast<float>(head.size_y) && g.z < static_cast<float>(head.size_z))) {
    return false;
  }
  const auto x = static_cast<std::uint32_t>(g.x), y = static_cast<std::uint32_t>(g.y);
  const auto z = static_cast<std::uint32_t>(g.z);
  row_out = view.model.row_of[z * head.size_y + y];
  if (row_out == kNoRow) return false;
  const Row& row = view.model.row[row_out];
  if (x < row.x0 || x >= static_cast<std::uint32_t>(row.x0) + row.count) return false;
  slot_out = row.slot + x - row.x0;
  part_out = g - Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  return view.model.slot_k[slot_out] > 0;  // else a hole in the row
}

}  // namespace

bool present_place(const View& view, Vec3 rest_m, Vec3& place_out_m) {
  std::uint32_t slot = 0, row_index = 0;
  Vec3 f = {};
  if (!find_voxel(view, rest_m, slot, row_index, f)) return false;
  const Row& row = view.model.row[row_index];
  place_out_m = rest_m;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t p = row.node[corner >> 1U] + slot - row.slot + (corner & 1U);
    const float weight = ((corner & 1U) != 0 ? f.x : 1 - f.x) *
                         ((corner & 2U) != 0 ? f.y : 1 - f.y) *
                         ((corner & 4U) != 0 ? f.z : 1 - f.z);
    place_out_m = place_out_m + weight * Vec3{view.state.ux[p], view.state.uy[p], view.state.uz[p]};
  }
  return true;
}

bool inside_lattice(const View& view, Vec3 rest_m) {
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  return find_voxel(view, rest_m, slot, row, part);
}

std::uint32_t material_at(const View& view, Vec3 rest_m) {
  std::uint32_t slot = 0, row = 0;
  Vec3 part = {};
  if (!find_voxel(view, rest_m, slot, row, part)) return kNoTissue;
  const std::uint32_t mixed = view.model.slot_mixed[slot];
  if (mixed == kNotMixed) return view.model.slot_material[slot];
  const OrganMixed& two = view.organ.mixed[mixed];
  const bool beyond = dot({two.nx, two.ny, two.nz}, part) > two.limit;
  return beyond ? two.material : view.model.slot_material[slot];
}

VoxelFrame voxel_frame(const View& view, std::uint32_t slot, std::uint32_t row) {
  const Corners corners = sum_corners(view, slot, row);
  const Vec3 rest = rest_centre(view, slot, view.model.row[row]);
  return {rotation_matrix(corner_rotation(view, slot, corners)), rest + corners.mean_m, rest};
}

std::uint32_t find_shares(const View& view, Vec3 rest_m, Share shares_out[kSharesPerParticle],
                          Sharing sharing) {
  const ModelHead& head = *view.model.head;
  const Vec3 g = head.inverse_edge_per_m * (rest_m - head.origin_m) - Vec3{0.5F, 0.5F, 0.5F};
  // Truncation of a shifted value: floor without libm. Points this far out have no voxel anyway.
  const auto whole = [](float v) {
    return static_cast<std::int32_t>(clamp(v, -2, 70000) + 4.0F) - 4;
  };
  const std::int32_t x0 = whole(g.x), y0 = whole(g.y), z0 = whole(g.z);
  const float fx = clamp(g.x - static_cast<float>(x0), 0, 1);
  const float fy = clamp(g.y - static_cast<float>(y0), 0, 1);
  const float fz = clamp(g.z - static_cast<float>(z0), 0, 1);
  std::uint32_t count = 0;
  float sum = 0;
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    const std::int32_t dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
    const std::int32_t x = x0 + dx, y = y0 + dy, z = z0 + dz;
    if (x < 0 || y < 0 || z < 0 || x >= head.size_x || y >= head.size_y || z >= head.size_z) {
      continue;
    }
    const std::uint32_t row_index =
        view.model.row_of[static_cast<std::uint32_t>(z * head.size_y + y)];
    if (row_index == kNoRow) continue;
    const Row& row = view.model.row[row_index];
    if (x < row.x0 || x >= row.x0 + row.count) continue;
    const std::uint32_t slot = row.slot + static_cast<std::uint32_t>(x - row.x0);
    const float tent = (dx != 0 ? fx : 1 - fx) * (dy != 0 ? fy : 1 - fy) * (dz != 0 ? fz : 1 - fz);
    const float weight = (sharing == Sharing::kEven ? 0.125F : tent) * view.model.slot_fill[slot];
    if (!(view.model.slot_k[slot] > 0) || !(weight > 0)) continue;
    shares_out[count++] = {slot, row_index, weight, {}, {}, {}};
    sum = sum + weight;
  }
  if (count > 0 && head.config.mode == Mode::kPaper) {  // one voxel, as in the paper
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < count; ++i) {
      if (shares_out[i].weight > shares_out[best].weight) best = i;
    }
    shares_out[0] = shares_out[best];
    count = 1;
    sum = shares_out[0].weight;
  }
  for (std::uint32_t i = 0; i < count; ++i) shares_out[i].weight = shares_out[i].weight / sum;
  return count;
}

}  // namespace stylet
