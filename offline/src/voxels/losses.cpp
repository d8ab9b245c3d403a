// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/losses.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/most_off.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

// Adds the volume of each layer in a cell, from the lengths of the rows in it.
void add_layers(const CellHere& here, const TissueNumbers& numbers, double edge_m, double row_m3,
                std::vector<double>& given_m3) {
  for (std::uint32_t s = 0; s < kCellSamples; ++s) {
    double top = 0;
    for (std::size_t i = 0; i < numbers.layers.size() && top < here.to[s]; ++i) {
      const bool last = i + 1 == numbers.layers.size();
      const double bottom = last ? here.to[s] : top + numbers.layers[i].thickness_m / edge_m;
      const double length = std::min(bottom, here.to[s]) - std::max(top, here.from[s]);
      given_m3[numbers.layers[i].material] += std::max(0.0, length) * row_m3;
      top = bottom;
    }
  }
}

std::string with_percent(double held_m3, double given_m3) {
  const int percent = static_cast<int>(std::lround(100 * (held_m3 / given_m3 - 1)));
  return fmt::format("{:.3g} ml ({:+} %)", held_m3 * 1e6, percent);
}

}  // namespace

std::vector<double> given_volumes(const Claims& claims, const SamplePlaces& places,
                                  const TissueNumbers& numbers,
                                  const std::vector<std::uint8_t>& cut,
                                  const std::vector<double>& sample_m3) {
  std::vector<double> given_m3(kMaxMaterials, 0), layers_m3(kMaxMaterials, 0);
  double all_m3 = 0;  // volume of all layers, by samples
  CellWalk(claims, places, numbers, Sides::kUpright)
      .each_cell([&](std::size_t cell, const CellHere& here) {
        if (!cut.empty() && cut[cell] != 0) return;
        int layered = 0;
        double layered_m3 = 0;
        for (const std::uint16_t owner : here.owner) {
          if (owner == kNoOwner) continue;
          if (!is_layered(numbers, owner)) {
            given_m3[numbers.of_owner[owner]] += sample_m3[owner];
          } else {
            ++layered;
            layered_m3 += sample_m3[owner];
          }
        }
        if (layered > 0) {
          add_layers(here, numbers, claims.grid.edge_m, layered_m3 / layered, layers_m3);
        }
        all_m3 += layered_m3;
      });
  // Rows end at planes through cells, samples do not: scale all layers to the samples' volume.
  const double rows_m3 = std::accumulate(layers_m3.begin(), layers_m3.end(), 0.0);
  for (std::size_t i = 0; i < given_m3.size() && rows_m3 > 0; ++i) {
    given_m3[i] += layers_m3[i] * all_m3 / rows_m3;
  }
  return given_m3;
}

std::vector<Held> held_volumes(const Lattice& lattice, const std::vector<OrganMixed>& mixed,
                               const std::vector<std::uint8_t>& material_of_voxel) {
  const double edge_m = lattice.grid.edge_m, cell_m3 = edge_m * edge_m * edge_m;
  std::vector<Held> held(kMaxMaterials);
  auto plane = mixed.begin();
  for (std::uint32_t voxel = 0; voxel < material_of_voxel.size(); ++voxel) {
    Held& own = held[material_of_voxel[voxel]];
    const double filled_m3 = lattice.fill[voxel] / 255.0 * cell_m3;
    own.voxel_m3 += filled_m3;
    if (plane == mixed.end() || plane->voxel != voxel) {
      own.met_m3 += filled_m3;
      continue;
    }
    const auto exact = [](float value) { return static_cast<double>(value); };
    const double before =
        volume_before({exact(plane->nx), exact(plane->ny), exact(plane->nz)}, exact(plane->limit));
    own.met_m3 += before * cell_m3;
    if (plane->material != kNoTissue) held[plane->material].met_m3 += (1 - before) * cell_m3;
    ++plane;
  }
  return held;
}

double volume_before(Vec normal, double limit) {
  constexpr double kNone = 1e-6;  // a smaller component of the normal is taken as 0
  std::array<double, 3> m = {normal.x, normal.y, normal.z};
  for (double& each : m) {
    limit -= std::min(each, 0.0);  // mirrors the cube, so that no component is negative
    each = std::abs(each);
  }
  const double sum = m[0] + m[1] + m[2];
  if (!(sum > 0)) return limit >= 0 ? 1 : 0;
  limit /= sum;
  if (limit <= 0 || limit >= 1) return limit <= 0 ? 0 : 1;
  for (double& each : m) each = each / sum < kNone ? 0 : each / sum;
  std::sort(m.begin(), m.end());
  const bool mirrored = limit > 0.5;
  const double a = mirrored ? 1 - limit : limit, both = m[0] + m[1];
  const auto square = [](double x) { return x * x; };
  double volume = 0;
  if (a < m[0]) {
    volume = a * a * a / (6 * m[0] * m[1] * m[2]);
  } else if (a < m[1]) {
    volume = (3 * a * (a - m[0]) + square(m[0])) / (6 * m[1] * m[2]);
  } else if (a >= std::min(both, m[2]) && both <= m[2]) {
    volume = (a - both / 2) / m[2];
  } else {
    double cubes =
        square(a) * (3 * both - a) + square(m[0]) * (m[0] - 3 * a) + square(m[1]) * (m[1] - 3 * a);
    if (a >= m[2]) cubes += square(a) * (3 * m[2] - a) + square(m[2]) * (m[2] - 3 * a);
    volume = cubes / (6 * m[0] * m[1] * m[2]);
  }
  return mirrored ? 1 - volume : volume;
}

std::string loss(const std::string& what, double given_m3, const Held& held, double edge_m,
                 double finest_m) {
  if (!(given_m3 > 0)) return "";
  const double met = held.met_m3 / given_m3 - 1, voxels = held.voxel_m3 / given_m3 - 1;
  if (std::max(std::abs(met), std::abs(voxels)) <= kMostOff) return "";
  const std::string finest = finest_m > 0 ? fmt::format(" to {:.3g}", finest_m * 1e3) : "";
  const std::string given =
      fmt::format("{}: at a voxel edge of {:.3g}{} mm, of the {:.3g} ml given", what, edge_m * 1e3,
                  finest, given_m3 * 1e6);
  if (!(held.met_m3 > 0)) {
    return fmt::format("{} no voxel holds any and no needle feels it: expected finer voxels",
                       given);
  }
  return fmt::format("{} a needle meets {} and voxels hold {}: expected finer voxels", given,
                     with_percent(held.met_m3, given_m3), with_percent(held.voxel_m3, given_m3));
}

}  // namespace stylet::offline
