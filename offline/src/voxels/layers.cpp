// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/layers.h"

#include <bit>

namespace stylet::offline {

std::uint8_t layer_at(const TissueNumbers& numbers, double depth_m) {
  std::uint8_t i = 0;
  while (i + 1U < numbers.layers.size() && depth_m >= numbers.layers[i].thickness_m) {
    depth_m -= numbers.layers[i].thickness_m;
    ++i;
  }
  return i;
}

namespace {

// Whether layers replace the tissue at a place, in lattice coordinates.
bool is_layered_at(const Claims& claims, const TissueNumbers& numbers, Vec place) {
  std::array<std::uint32_t, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(place[axis] >= 0 && place[axis] < claims.grid.size[axis])) return false;
    at[axis] = static_cast<std::uint32_t>(place[axis]);
  }
  const std::size_t cell = cell_index(claims.grid, at[0], at[1], at[2]);
  return is_kept(claims, cell) && numbers.is_layered[claims.owner[cell]] != 0;
}

}  // namespace

double thickness_across(const Claims& claims, const TissueNumbers& numbers, const Mesh& mesh_m) {
  // Voxel edges from the surface. Half of a voxel's diagonal is 0.87: a plane does not reach into
  // voxels so far from it, which therefore tell what lies on either side.
  constexpr double kOut = 1.5, kIn = 1;
  double rows = 0, weighted = 0;
  for (const Triangle& t : mesh_m.triangles) {
    const Vec a = to_lattice(claims.grid, mesh_m.points[t[0]]);
    const Vec b = to_lattice(claims.grid, mesh_m.points[t[1]]);
    const Vec c = to_lattice(claims.grid, mesh_m.points[t[2]]);
    const Vec normal = cross(b - a, c - a), middle = (a + b + c) * (1.0 / 3);
    const double along = normal[numbers.course.axis], size = length(normal);
    if (along == 0) continue;  // rows pass it by
    // Inwards, if rows enter here, whichever way the triangle is turned.
    const Vec in = normal * (((along < 0) == numbers.course.backwards ? 1 : -1) / size);
    if (is_layered_at(claims, numbers, middle - in * kOut) ||
        !is_layered_at(claims, numbers, middle + in * kIn)) {
      continue;
    }
    rows += std::abs(along);
    weighted += along * along / size;
  }
  return rows > 0 ? weighted / rows : 1;
}

std::vector<std::uint8_t> cell_layers(const Claims& claims, const TissueNumbers& numbers) {
  if (numbers.layers.empty()) return {};
  constexpr double kSamples = 64;
  const Grid& grid = claims.grid;
  const std::size_t along = numbers.course.axis, u = (along + 1) % 3, v = (along + 2) % 3;
  std::vector<std::uint8_t> layers(cell_count(grid), kNotLayered);
  std::array<std::uint32_t, 3> at{};
  for (at[u] = 0; at[u] < grid.size[u]; ++at[u]) {
    for (at[v] = 0; at[v] < grid.size[v]; ++at[v]) {
      double above = 0;  // filled, in edges
      for (std::uint32_t step = 0; step < grid.size[along]; ++step) {
        at[along] = numbers.course.backwards ? grid.size[along] - 1 - step : step;
        const std::size_t cell = cell_index(grid, at[0], at[1], at[2]);
        if (!is_kept(claims, cell) || numbers.is_layered[claims.owner[cell]] == 0) {
          above = 0;
          continue;
        }
        const double fill = std::popcount(claims.inside[cell]) / kSamples;
        layers[cell] = layer_at(numbers, (above + 0.5 * fill) * grid.edge_m);
        above += fill;
      }
    }
  }
  return layers;
}

std::uint8_t voxel_layer(const TissueNumbers& numbers, const std::vector<std::uint8_t>& cell_layers,
                         std::size_t cell, std::uint16_t owner) {
  if (cell_layers.empty() || numbers.is_layered[owner] == 0) return kNotLayered;
  return cell_layers[cell] != kNotLayered ? cell_layers[cell] : std::uint8_t{0};
}

}  // namespace stylet::offline
