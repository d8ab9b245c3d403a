// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/crop.h"

#include <algorithm>

#include "base/refusal.h"

namespace stylet::offline {

std::vector<Region> parse_crop(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    if (text != "none" && !text.starts_with("touching:")) continue;
    refuse("--crop '{}': expected x>MM, x<MM (or y, z; MM may be N%) or box:X0,Y0,Z0,X1,Y1,Z1",
           text);
  }
  return parse_regions(texts, {}, "--crop");
}

std::vector<std::uint8_t> cut_cells(const Grid& grid, const Box& extent_m,
                                    const std::vector<Region>& regions) {
  if (regions.empty()) return {};
  std::vector<std::uint8_t> cut(cell_count(grid), 0);
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x, ++cell) {
        const Vec middle = grid.origin_m + Vec{x + 0.5, y + 0.5, z + 0.5} * grid.edge_m;
        cut[cell] =
            std::all_of(regions.begin(), regions.end(),
                        [&](const Region& each) { return holds(each, extent_m, middle, 0); })
                ? 0
                : 1;
      }
    }
  }
  return cut;
}

Mesh crop_surface(Mesh surface_m, const Grid& grid, const std::vector<std::uint8_t>& cut) {
  if (cut.empty()) return surface_m;
  constexpr std::uint32_t kGone = 0xFFFFFFFF, kStays = 0;
  std::vector<std::uint32_t> number(surface_m.points.size(), kGone);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (cut[cell_of(grid, surface_m.points[i])] == 0) number[i] = kStays;
  }
  std::erase_if(surface_m.triangles, [&](const Triangle& t) {
    return number[t[0]] == kGone || number[t[1]] == kGone || number[t[2]] == kGone;
  });
  std::fill(number.begin(), number.end(), kGone);
  Mesh part;
  for (Triangle& t : surface_m.triangles) {
    for (std::uint32_t& corner : t) {
      if (number[corner] == kGone) {
        number[corner] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(surface_m.points[corner]);
      }
      corner = number[corner];
    }
  }
  part.triangles = std::move(surface_m.triangles);
  return part;
}

void hold_cut(const Claims& claims, const std::vector<std::uint8_t>& cut,
              std::vector<std::uint8_t>& held) {
  const Grid& grid = claims.grid;
  for (std::size_t cell = 0; cell < cut.size(); ++cell) {
    if (cut[cell] == 0 || !is_kept(claims, cell)) continue;
    const auto x = static_cast<std::uint32_t>(cell % grid.size[0]);
    const auto row = static_cast<std::uint32_t>(cell / grid.size[0]);
    const std::uint32_t y = row % grid.size[1], z = row / grid.size[1];
    for (std::uint32_t c = 0; c < 8; ++c) {
      held[corner_index(grid, x + (c & 1U), y + (c >> 1U & 1U), z + (c >> 2U))] = 1;
    }
  }
}

}  // namespace stylet::offline
