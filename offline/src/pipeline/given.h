// SPDX-License-Identifier: GPL-3.0-or-later
// What the inputs of a build give of each tissue, and what a user is told where the organ has less
// or more of it. Units: metres.
#pragma once

#include "pipeline/build.h"
#include "pipeline/voxel_materials.h"
#include "voxels/losses.h"

namespace stylet::offline {

// Volumes that the inputs give, by material; materials of gaps and capsule are not numbered here.
struct Given {
  std::vector<Tissue> tissues;
  std::vector<bool> is_layer;
  std::vector<double> volume_m3;
};

// Sampled at the finest edge. `claimed` is as before gaps are filled.
Given given_of(const Claimed& claimed, const BuildOptions& options);

// Adds what the voxels of a level hold.
void add_held(const std::vector<Held>& here, std::vector<Held>& all_io);

// `held` is of `materials`, in the voxels of all lattices.
void warn_of_losses(const std::vector<Held>& held, const std::vector<Lattice>& lattices,
                    const Given& given, const std::vector<Tissue>& materials,
                    std::vector<std::string>& warnings);

// Of layers on a surface that slopes, which are thinner across it.
void warn_of_slopes(const Claimed& claimed, const TissueNumbers& numbers,
                    std::vector<std::string>& warnings);

}  // namespace stylet::offline
