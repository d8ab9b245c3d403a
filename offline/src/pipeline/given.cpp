// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/given.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/most_off.h"
#include "voxels/levels.h"

namespace stylet::offline {
namespace {

// What all materials of a tissue hold: a layer's modulus depends on whether it is thicker than a
// voxel (in_layer), so with levels it may be several.
Held held_of(const Tissue& tissue, const std::vector<Tissue>& materials,
             const std::vector<Held>& held, bool has_levels) {
  Held all;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const bool same_modulus = materials[i].youngs_modulus_pa == tissue.youngs_modulus_pa;
    if (materials[i].name != tissue.name || !(same_modulus || has_levels)) continue;
    all.met_m3 += held[i].met_m3;
    all.voxel_m3 += held[i].voxel_m3;
  }
  return all;
}

}  // namespace

Given given_of(const Claimed& claimed, const BuildOptions& options) {
  MaterialList list{options.own_tissues, {}};
  const Claims& finest = claimed.levels.back();
  const TissueNumbers numbers = number_tissues(claimed.tissues, options, finest.grid.edge_m, list);
  const auto level = static_cast<std::uint32_t>(claimed.levels.size() - 1);
  std::vector<bool> is_layer(list.tissues.size(), false);
  for (const TissueNumbers::Numbered& layer : numbers.layers) is_layer[layer.material] = true;
  return {list.tissues, is_layer,
          given_volumes(finest, claimed.places, numbers, inherited(claimed.cut, finest.grid, level),
                        claimed.sample_m3)};
}

void add_held(const std::vector<Held>& here, std::vector<Held>& all_io) {
  for (std::size_t i = 0; i < all_io.size(); ++i) {
    all_io[i].met_m3 += here[i].met_m3;
    all_io[i].voxel_m3 += here[i].voxel_m3;
  }
}

void warn_of_losses(const std::vector<Held>& held, const std::vector<Lattice>& lattices,
                    const Given& given, const std::vector<Tissue>& materials,
                    std::vector<std::string>& warnings) {
  const bool has_levels = lattices.size() > 1;
  const double finest_m = has_levels ? lattices.back().grid.edge_m : 0;
  for (std::size_t i = 0; i < given.tissues.size(); ++i) {
    const Tissue& tissue = given.tissues[i];
    const std::string text =
        loss((given.is_layer[i] ? "layer " : "tissue ") + tissue.name, given.volume_m3[i],
             held_of(tissue, materials, held, has_levels), lattices.front().grid.edge_m, finest_m);
    if (!text.empty()) warnings.push_back(text);
  }
}

void warn_of_slopes(const Claimed& claimed, const TissueNumbers& numbers,
                    std::vector<std::string>& warnings) {
  if (numbers.layers.empty()) return;
  const double left = thickness_across(claimed.levels.back(), numbers, claimed.mesh);
  if (1 - left <= kMostOff) return;
  constexpr double kDegrees = 180 / std::numbers::pi;
  warnings.push_back(fmt::format(
      "--layers-along {}{}: the outer surface slopes by {:.0f} degrees on average, so that layers "
      "are {:.0f} % thinner across it than asked for: expected a direction straight into the "
      "surface, or thicker layers",
      numbers.course.backwards ? '-' : '+', "xyz"[numbers.course.axis], std::acos(left) * kDegrees,
      100 * (1 - left)));
}

}  // namespace stylet::offline
