// SPDX-License-Identifier: Apache-2.0
// One voxel of the deformed lattice: sums over its corners, its frame, and the search for voxels
// that hold a point.
//
// Promises: a fixed number of operations; no allocation. Units SI, frame of the attachments.
// PHYSICS 2.1, 10.1.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// Partly filled voxels count at least this much, else thin slivers would have no stiffness.
constexpr float kMinFill = 0.1F;
constexpr std::uint32_t kNoRow = 0xFFFFFFFFU;
constexpr std::uint32_t kNotMixed = 0xFFFFFFFFU;

struct Corners {
  Vec3 mean_m;        // displacement
  float gradient[9];  // of the displacement, row-major
};
// Sums over the eight corners of a voxel, displacements u.
Corners sum_corners(const Model& model, const State& state, std::uint32_t slot,
                    std::uint32_t row_index);

// The row that holds a voxel, or kNoRow; y and z must be within the lattice. It is the last row in
// its place of the table that does not begin behind the voxel.
inline std::uint32_t row_at(const Model& model, std::int32_t x, std::uint32_t y, std::uint32_t z) {
  const Counts& counts = model.head->counts;
  const auto order = [](std::int32_t of_x, std::uint32_t of_y, std::uint32_t of_z) {
    return (static_cast<std::int64_t>(of_z) << 40U) + (static_cast<std::int64_t>(of_y) << 20U) +
           of_x;
  };
  std::uint32_t index = model.row_of[(z * model.head->size_y + y) >> counts.row_shift];
  if (index == kNoRow) return kNoRow;
  for (std::uint32_t bit = counts.row_bits; bit > 0; --bit) {
    const std::uint32_t next = index + (1U << (bit - 1));
    if (next >= counts.rows) continue;
    const Row& row = model.row[next];
    if (order(row.x0, row.y, model.plane[row.plane].z) <= order(x, y, z)) index = next;
  }
  const Row& row = model.row[index];
  const bool holds = row.y == y && x >= row.x0 && x < row.x0 + row.count;
  return holds && model.plane[row.plane].z == z ? index : kNoRow;
}

// Particle at an existing node of the lattice.
std::uint32_t node_at(const Model& model, std::uint32_t x, std::uint32_t y, std::uint32_t z);

inline const Level& level_of(const Model& model, const Row& row) {
  return model.head->level[model.plane[row.plane].level];
}

// Cell of a voxel in space, in edges of its level from the lattice's origin.
inline Vec3 cell_of(const Model& model, std::uint32_t slot, const Row& row) {
  const std::uint32_t sheet_rows = model.head->sheet_rows;
  const std::uint32_t y = row.y < sheet_rows ? row.y : row.y % sheet_rows;
  return {static_cast<float>(row.x0 + (slot - row.slot)), static_cast<float>(y),
          static_cast<float>(model.plane[row.plane].z_in_level)};
}

Vec3 rest_centre(const Model& model, std::uint32_t slot, const Row& row);

// The number of the one particle that a node and the nodes tied to it are.
inline std::uint32_t particle_of(const Model& model, std::uint32_t node) {
  return model.head->counts.sheets > 1 ? model.representative[node] : node;
}
// Gives each of the tied nodes that are one particle the sum of their values.
void sum_tied(const Model& model, float* of_node);

// Whether a voxel's material has a thin skin.
inline bool has_skin(const Model& model, std::uint32_t slot) {
  return model.head->material[model.slot_material[slot]].skin_shear_n_per_m > 0;
}

// The best rotation of a matrix, searched near `start`.
Quat rotation_of(const float a[9], Quat start);
// The same for a voxel's corners alone.
Quat corner_rotation(const State& state, std::uint32_t slot, const Corners& corners);

// Frame of a voxel from its corners alone: x = rotation * rest offset + centre.
struct VoxelFrame {
  Mat3 rotation;
  Vec3 centre_m;  // now
  Vec3 rest_centre_m;
};
VoxelFrame voxel_frame(const Model& model, const State& state, std::uint32_t slot,
                       std::uint32_t row);

// Weights of the voxels around a rest point, times fill; no voxels outside the tissue. Tent weights
// change smoothly along a path. Equal weights are the same for all places between the same centres.
// Stiff ones are tent weights times the root of fill and stiffness (coupling/support.cpp says why).
enum class Weighting { kTent, kEven, kStiff };
std::uint32_t find_supports(const Model& model, Vec3 rest_m,
                            Support supports_out[kSupportsPerParticle],
                            Weighting weighting = Weighting::kTent);

// Present place of a rest point, trilinear in the voxel that holds it; false outside the tissue.
bool present_place(const Model& model, const State& state, Vec3 rest_m, Vec3& place_out_m);
bool inside_lattice(const Model& model, Vec3 rest_m);

// The material at a rest point, finer than voxels (OrganMixed); kNoTissue outside of all tissue.
std::uint32_t material_at(const Model& model, Vec3 rest_m);
// The same for a place that tissue holds. If the voxel's plane leaves the place outside of all
// tissue, the voxel's own material is returned: builds know such a plane to an eighth of an edge,
// so a place of the surface may lie beyond it.
std::uint32_t material_held_at(const Model& model, Vec3 rest_m);

}  // namespace stylet
