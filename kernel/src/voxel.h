// SPDX-License-Identifier: Apache-2.0
// One voxel of the deformed lattice: sums over its corners, its frame, and which voxels share a
// point.
//
// Promises: a fixed number of operations; no allocation. Units SI, world frame.
#pragma once

#include "layout.h"
#include "math.h"

namespace stylet {

// Partly filled voxels count at least this much, else thin slivers have no stiffness of their own.
constexpr float kMinFill = 0.1F;
constexpr std::uint32_t kNoRow = 0xFFFFFFFFU;
constexpr std::uint32_t kNotMixed = 0xFFFFFFFFU;

struct Corners {
  Vec3 mean_m;        // displacement
  float gradient[9];  // of the displacement, row-major
};
// Sums over the eight corners of a voxel, displacements u.
Corners sum_corners(const View& view, std::uint32_t slot, std::uint32_t row_index);

Vec3 rest_centre(const View& view, std::uint32_t slot, const Row& row);

// Best rotation of a matrix near `start`.
Quat rotation_of(const float a[9], Quat start);
// Of a voxel's corners alone.
Quat corner_rotation(const View& view, std::uint32_t slot, const Corners& corners);

// Frame of a voxel from its corners alone: x = rotation * rest offset + centre.
struct VoxelFrame {
  Mat3 rotation;
  Vec3 centre_m;  // now
  Vec3 rest_centre_m;
};
VoxelFrame voxel_frame(const View& view, std::uint32_t slot, std::uint32_t row);

// Weights of the voxels around a rest point, times fill; 0 shares outside the tissue. Tent weights
// change smoothly along a way; even ones are the same for all places between the same centres.
enum class Sharing { kTent, kEven };
std::uint32_t find_shares(const View& view, Vec3 rest_m, Share shares_out[kSharesPerParticle],
                          Sharing sharing = Sharing::kTent);

// Present place of a rest point, trilinear in the voxel that holds it; false outside the tissue.
bool present_place(const View& view, Vec3 rest_m, Vec3& place_out_m);
bool inside_lattice(const View& view, Vec3 rest_m);

// What a rest point lies in, finer than voxels (OrganMixed); kNoTissue where there is none.
std::uint32_t material_at(const View& view, Vec3 rest_m);

}  // namespace stylet
