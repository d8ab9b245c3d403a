// SPDX-License-Identifier: Apache-2.0
// Two blocks, one on the other, that may slide: a floor in the first sheet of the lattice and a lid
// in the second, with a plane between them at any height and of any slope, also within voxels.
// Units: voxel edges, where a name says no other.
#pragma once

#include <algorithm>
#include <cmath>

#include "session.h"
#include "tiny_organ.h"

namespace stylet::test {

struct TwoParts {
  std::uint16_t floor_x = 8, floor_y = 6;  // voxels of the floor
  std::uint16_t lid_x = 8, lid_y = 6;      // of the lid, which lies from (at_x, at_y) on
  std::uint16_t at_x = 0, at_y = 0;
  std::uint16_t height = 8;
  float plane = 4, slope_x = 0, slope_y = 0;  // the plane is at z = plane + slope_x x + slope_y y
  float gap = 0;                              // between the floor and the lid, along z
  std::uint16_t gap_x = 0, gap_width = 0;     // columns from there on that the floor lacks
  float friction = 0;
  float voxel_edge_m = 0.005F;
  TinyMaterial floor, lid;
  bool held = true;  // the floor's low face
};

inline std::uint16_t rows_of(const TwoParts& p) {
  return static_cast<std::uint16_t>(std::max<int>(p.floor_y, p.at_y + p.lid_y) + 1);
}

namespace detail {

inline float plane_at(const TwoParts& p, float x, float y) {
  return p.plane + p.slope_x * x + p.slope_y * y;
}

// How far a place lies above the plane, along its normal.
inline float above(const TwoParts& p, float x, float y, float z) {
  return (z - plane_at(p, x, y)) / std::sqrt(1 + p.slope_x * p.slope_x + p.slope_y * p.slope_y);
}

// The part of a voxel that is above (or below) the plane, by 8 x 8 columns.
inline float part_above(const TwoParts& p, int x, int y, int z, bool lid) {
  float sum = 0;
  for (int i = 0; i < 64; ++i) {
    const float sx = static_cast<float>(x) + (static_cast<float>(i % 8) + 0.5F) / 8;
    const float sy = static_cast<float>(y) + (static_cast<float>(i / 8) + 0.5F) / 8;
    const float below = plane_at(p, sx, sy) - (lid ? 0 : p.gap) - static_cast<float>(z);
    sum += std::clamp(lid ? 1 - below : below, 0.0F, 1.0F) / 64;
  }
  return sum;
}

inline bool is_inside(const TwoParts& p, int x, int row, int z) {
  const int rows = rows_of(p), y = row % rows;
  const bool lid = row >= rows;
  const bool there =
      lid ? x >= p.at_x && x < p.at_x + p.lid_x && y >= p.at_y && y < p.at_y + p.lid_y
          : x < p.floor_x && y < p.floor_y;
  return there && part_above(p, x, y, z, lid) * 255 >= 0.5F;
}

// Where a cell holds both: the quarters above the plane are the lid's.
inline void add_quarters(const TwoParts& p, TinyOrgan& tiny) {
  for (std::uint16_t z = 0; z < tiny.nz; ++z) {
    for (std::uint16_t row = 0; row < tiny.ny; ++row) {
      const std::uint16_t y = row % tiny.sheet_rows;
      for (std::uint16_t x = 0; x < tiny.nx; ++x) {
        if (!is_inside(p, x, y, z) || !is_inside(p, x, y + tiny.sheet_rows, z)) continue;
        std::uint64_t lid = 0;
        for (std::uint32_t i = 0; i < 64; ++i) {
          const auto at = [i](std::uint16_t cell, std::uint32_t shift) {
            return static_cast<float>(cell) + (static_cast<float>((i >> shift) & 3U) + 0.5F) / 4;
          };
          if (above(p, at(x, 0), at(y, 2), at(z, 4)) > 0) lid |= std::uint64_t{1} << i;
        }
        const std::uint64_t own = row < tiny.sheet_rows ? ~lid : lid;
        tiny.parts.emplace_back(x, row, z, std::uint16_t{0}, own);
      }
    }
  }
}

// The floor's voxels, and how far their corners lie from its surface.
inline void add_grounds(const TwoParts& p, TinyOrgan& tiny) {
  const float steep = std::sqrt(1 + p.slope_x * p.slope_x + p.slope_y * p.slope_y);
  std::uint32_t voxel = 0;
  for (std::uint16_t z = 0; z < tiny.nz; ++z) {
    for (std::uint16_t y = 0; y < tiny.ny; ++y) {
      for (std::uint16_t x = 0; x < tiny.nx; ++x) {
        if (!is_inside(p, x, y, z)) continue;
        if (y < tiny.sheet_rows) {
          std::array<float, 8> distance = {};
          for (std::uint32_t i = 0; i < 8; ++i) {
            distance[i] =
                above(p, static_cast<float>(x + (i & 1U)), static_cast<float>(y + ((i >> 1U) & 1U)),
                      static_cast<float>(z + (i >> 2U))) +
                p.gap / steep;
          }
          const auto& d = distance;
          tiny.slide_grounds.emplace_back(voxel, d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]);
        }
        ++voxel;
      }
    }
  }
}

inline std::uint32_t voxel_of(const TwoParts& p, const TinyOrgan& tiny, int x, int row, int z) {
  std::uint32_t voxel = 0;
  for (int k = 0; k <= z; ++k) {
    for (int j = 0; j < tiny.ny; ++j) {
      for (int i = 0; i < tiny.nx; ++i) {
        if (k == z && j == row && i == x) return voxel;
        if (is_inside(p, i, j, k)) ++voxel;
      }
    }
  }
  return voxel;
}

// One in the middle of each column of the lid.
inline void add_points(const TwoParts& p, TinyOrgan& tiny) {
  const auto rows = tiny.sheet_rows;
  const float area = std::sqrt(1 + p.slope_x * p.slope_x + p.slope_y * p.slope_y);
  const auto fraction = [](float of) {
    return static_cast<std::uint16_t>(std::lround(65535 * of));
  };
  for (int y = p.at_y; y < p.at_y + p.lid_y; ++y) {
    for (int x = p.at_x; x < p.at_x + p.lid_x; ++x) {
      const float up = plane_at(p, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const int z = static_cast<int>(std::floor(up));
      // The floor's voxel below it; beside the floor, the nearest one.
      const int fx = std::min<int>(x, p.floor_x - 1), fy = std::min<int>(y, p.floor_y - 1);
      int low = z;
      while (!is_inside(p, fx, fy, low)) --low;
      const std::uint32_t below = voxel_of(p, tiny, fx, fy, low);
      const auto ground = std::find_if(tiny.slide_grounds.begin(), tiny.slide_grounds.end(),
                                       [&](const auto& g) { return g.voxel() == below; });
      tiny.slide_points.emplace_back(
          voxel_of(p, tiny, x, rows + y, z), fraction(0.5F), fraction(0.5F),
          fraction(up - static_cast<float>(z)), std::uint16_t{0}, area,
          static_cast<std::uint32_t>(ground - tiny.slide_grounds.begin()), p.friction);
    }
  }
}

}  // namespace detail

// Gives an organ both blocks. Its surface is the lid's, through which a needle enters.
inline void make_two_parts(const TwoParts& p, TinyOrgan& tiny_io) {
  TinyOrgan& tiny = tiny_io;
  tiny.nx = std::max(p.floor_x, static_cast<std::uint16_t>(p.at_x + p.lid_x));
  tiny.sheet_rows = rows_of(p);
  tiny.ny = static_cast<std::uint16_t>(2 * tiny.sheet_rows);
  tiny.nz = p.height;
  tiny.voxel_edge_m = p.voxel_edge_m;
  const int rows = tiny.sheet_rows;
  tiny.has_surface = [=](int, int y, int) { return y >= rows; };
  tiny.inside = [=](int x, int y, int z) { return detail::is_inside(p, x, y, z); };
  tiny.fill_at = [=](int x, int y, int z) {
    return static_cast<std::uint8_t>(
        std::lround(255 * detail::part_above(p, x, y % rows, z, y >= rows)));
  };
  detail::add_quarters(p, tiny);
  detail::add_grounds(p, tiny);
  detail::add_points(p, tiny);
}

inline std::unique_ptr<OpenOrgan> two_parts(const TwoParts& p) {
  TinyOrgan tiny;
  tiny.materials = {p.floor, p.lid};
  tiny.material_at = [rows = int{rows_of(p)}](int, int y, int) { return std::uint8_t{y >= rows}; };
  tiny.fixed_faces = p.held ? kLowZ : 0U;
  make_two_parts(p, tiny);
  return open_organ(tiny_organ(tiny));
}

// The setup "sliding": the needle of block_script goes through a lid into the floor; the lid lies
// on a slope and is dragged along.
inline std::unique_ptr<OpenOrgan> sliding_organ() {
  TwoParts parts;
  parts.floor_x = 6;
  parts.lid_x = 5;
  parts.floor_y = parts.lid_y = 5;
  parts.plane = 3.9F;
  parts.slope_x = 0.12F;
  parts.slope_y = -0.07F;
  parts.friction = 0.4F;
  parts.floor.relaxing_fraction = parts.lid.relaxing_fraction = 0.3F;
  parts.lid.youngs_modulus_pa = 30000;
  parts.lid.puncture_force_n = 0.2F;
  return two_parts(parts);
}
inline Config sliding_config() {
  Config config;
  config.gravity_m_per_s2 = {1, -2, -7};
  return config;
}

}  // namespace stylet::test
