// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/sweep.h"

#include "base/refusal.h"
#include "stylet/kernel.h"
#include "voxels/hanging.h"

namespace stylet::offline {
namespace {

double state_bytes(const Organ& organ) {
  Sizes bytes{};
  const bool fits = sizes(organ, Config{}, bytes) == Status::kOk;
  if (!fits) throw TooFine("the lattice is too large for the kernel: expected a larger voxel edge");
  return static_cast<double>(bytes.state_bytes);
}

// An organ with only what sizes() reads.
Organ bare_organ(const std::array<std::uint32_t, 3>& size, std::span<const OrganRun> runs) {
  Organ organ;
  organ.root = runs.data();  // not null means opened; sizes() does not follow the pointer
  organ.size_x = static_cast<std::uint16_t>(size[0]);
  organ.size_y = organ.sheet_rows = static_cast<std::uint16_t>(size[1]);
  organ.size_z = static_cast<std::uint16_t>(size[2]);
  organ.runs = runs;
  for (const OrganRun& run : runs) organ.voxel_count += run.count;
  return organ;
}

double block_bytes(const std::array<std::uint32_t, 3>& size) {
  std::vector<OrganRun> runs;
  for (std::uint32_t z = 0; z < size[2]; ++z) {
    for (std::uint32_t y = 0; y < size[1]; ++y) {
      OrganRun run{};
      run.y = static_cast<std::uint16_t>(y);
      run.z = static_cast<std::uint16_t>(z);
      run.count = static_cast<std::uint16_t>(size[0]);
      runs.push_back(run);
    }
  }
  return state_bytes(bare_organ(size, runs));
}

double voxels_of(double bytes) {
  constexpr std::array<std::uint32_t, 3> kSmall = {12, 12, 14}, kLarge = {26, 26, 30};
  constexpr double kSmallVoxels = 12 * 12 * 14, kLargeVoxels = 26 * 26 * 30;
  static const double small = block_bytes(kSmall), large = block_bytes(kLarge);
  const double each = (large - small) / (kLargeVoxels - kSmallVoxels);
  return std::max(1.0, kSmallVoxels + (bytes - small) / each);
}

}  // namespace

double swept_voxels(const Organ& organ) {
  return voxels_of(state_bytes(organ));
}

double swept_voxels(std::span<const Lattice> levels) {
  const Lattice& coarsest = levels.front();
  const LatticeSize size = lattice_size(levels);
  const std::vector<OrganRun> runs = runs_of(levels);
  const std::vector<OrganTie> ties = ties_of(levels);
  const std::vector<OrganPart> parts = parts_of(levels);
  const std::vector<OrganHanging> hanging = hanging_nodes(levels);
  Organ organ = bare_organ({size.x, size.rows, size.z}, runs);
  organ.size_y = static_cast<std::uint16_t>(size.rows * coarsest.sheets);
  organ.levels = static_cast<std::uint16_t>(levels.size());
  organ.level_planes = static_cast<std::uint16_t>(coarsest.grid.size[2]);
  organ.ties = ties;
  organ.parts = parts;
  organ.hanging = hanging;
  return voxels_of(state_bytes(organ));
}

}  // namespace stylet::offline
