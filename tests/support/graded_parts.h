// SPDX-License-Identifier: Apache-2.0
// Two blocks, one on the other, that may slide (two_parts.h), in voxels of several sizes: cells of
// space are split, whichever block they hold. Places are in edges of level 0.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "owned_organ.h"
#include "split_cells.h"
#include "stylet/levels.h"
#include "two_parts.h"

namespace stylet::test {

struct GradedParts {
  TwoParts parts;
  std::uint32_t levels = 2;
  Split split;
  std::uint32_t floor_held = kLowZ, lid_held = 0;  // faces of the space that hold them
  bool pieces_apart = false;                       // those of the floor are in sheets of their own
};

namespace graded_parts_detail {

// z, y, x in the lattice: the order of the file.
using Place = std::array<std::uint32_t, 3>;

struct Voxel {
  LevelCell cell;
  bool lid;
  float part;  // of the cell
  std::uint32_t index;
};

class Builder {
 public:
  explicit Builder(const GradedParts& graded)
      : graded_(graded),
        p_(graded.parts),
        size_({std::max<int>(p_.floor_x, p_.at_x + p_.lid_x), rows_of(p_) - 1, p_.height}) {
    SplitCells(size_, graded.levels, graded.split).each([&](const LevelCell& cell) {
      for (const bool lid : {false, true}) {
        const float part = part_of(cell, lid);
        if (part * 255 >= 0.5F) voxels_[place(cell, lid)] = {cell, lid, part, 0};
      }
    });
    std::uint32_t count = 0;
    for (auto& [unused, voxel] : voxels_) voxel.index = count++;
  }

  std::unique_ptr<Owner> owner() {
    const std::uint32_t finest = graded_.levels - 1;
    TinyOrgan fine;
    fine.nx = static_cast<std::uint16_t>(size_[0] << finest);
    fine.ny = static_cast<std::uint16_t>(size_[1] << finest);
    fine.nz = static_cast<std::uint16_t>(size_[2] << finest);
    fine.voxel_edge_m = p_.voxel_edge_m / static_cast<float>(1U << finest);
    fine.materials = {p_.floor, p_.lid};
    fine.inside = [&](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
      return around({finest, x, y, z}, true) != nullptr;
    };
    std::unique_ptr<Owner> owner(format::GetOrgan(tiny_organ(fine).data())->UnPack());
    embed(fine, owner->vertices);
    owner->format_version = 6;
    owner->voxel_edge_m = p_.voxel_edge_m;
    owner->sheets = std::make_unique<format::SheetsT>();
    owner->sheets->rows = static_cast<std::uint16_t>(rows());
    owner->size_y = static_cast<std::uint16_t>((graded_.pieces_apart ? 3 : 2) * rows());
    owner->size_z = static_cast<std::uint16_t>(first_plane(planes(), graded_.levels) - 1);
    owner->levels = std::make_unique<format::LevelsT>();
    owner->levels->count = static_cast<std::uint8_t>(graded_.levels);
    owner->levels->planes = static_cast<std::uint16_t>(planes());
    fill_voxels(*owner);
    hang(*owner);
    owner->slides = std::make_unique<format::SlidesT>();
    add_grounds(*owner->slides);
    add_points(*owner->slides);
    return owner;
  }

 private:
  std::uint32_t planes() const { return p_.height; }
  std::uint32_t rows() const {
    return (static_cast<std::uint32_t>(size_[1]) << (graded_.levels - 1)) + 1;
  }
  // The floor's piece beyond its gap may be in the third sheet.
  std::uint32_t sheet_of(std::uint32_t level, std::uint32_t x, bool lid) const {
    if (lid) return 1;
    return graded_.pieces_apart && edge(level) * static_cast<float>(x) >= p_.gap_x ? 2 : 0;
  }
  Place place(const LevelCell& cell, bool lid) const {
    const auto& [level, x, y, z] = cell;
    return {first_plane(planes(), level) + z, y + sheet_of(level, x, lid) * rows(), x};
  }
  static float edge(std::uint32_t level) { return edge_ratio(level); }
  static std::array<float, 3> low_of(const LevelCell& cell) {
    const auto& [level, x, y, z] = cell;
    return {edge(level) * static_cast<float>(x), edge(level) * static_cast<float>(y),
            edge(level) * static_cast<float>(z)};
  }

  // The part of a cell that a block fills, by 8 x 8 columns.
  float part_of(const LevelCell& cell, bool lid) const {
    const float h = edge(cell[0]);
    const auto [x, y, z] = low_of(cell);
    const auto is_in = [](float at, std::uint16_t low, std::uint16_t count) {
      return at >= static_cast<float>(low) && at < static_cast<float>(low + count);
    };
    const bool there = lid ? is_in(x, p_.at_x, p_.lid_x) && is_in(y, p_.at_y, p_.lid_y)
                           : is_in(x, 0, p_.floor_x) && is_in(y, 0, p_.floor_y) &&
                                 !is_in(x, p_.gap_x, p_.gap_width);
    float sum = 0;
    for (int i = 0; there && i < 64; ++i) {
      const float sx = x + h * (static_cast<float>(i % 8) + 0.5F) / 8;
      const float sy = y + h * (static_cast<float>(i / 8) + 0.5F) / 8;
      const float below = (detail::plane_at(p_, sx, sy) - (lid ? 0 : p_.gap) - z) / h;
      sum += std::clamp(lid ? 1 - below : below, 0.0F, 1.0F) / 64;
    }
    return sum;
  }

  const Voxel* at(const LevelCell& cell, bool lid) const {
    const auto found = voxels_.find(place(cell, lid));
    return found != voxels_.end() ? &found->second : nullptr;
  }
  // The block's voxel in which a cell of the finest level lies.
  const Voxel* around(const LevelCell& fine, bool lid) const {
    const Voxel* found = nullptr;
    for (std::uint32_t level = 0; level < graded_.levels && found == nullptr; ++level) {
      const std::uint32_t shift = fine[0] - level;
      found = at({level, fine[1] >> shift, fine[2] >> shift, fine[3] >> shift}, lid);
    }
    return found;
  }

  // Vertices of the finest cells, in the lid's voxels.
  void embed(const TinyOrgan& fine, std::vector<format::Vertex>& vertices) const {
    std::vector<LevelCell> cells;
    for (std::uint16_t z = 0; z < fine.nz; ++z) {
      for (std::uint16_t y = 0; y < fine.ny; ++y) {
        for (std::uint16_t x = 0; x < fine.nx; ++x) {
          if (fine.inside(x, y, z)) cells.push_back({graded_.levels - 1, x, y, z});
        }
      }
    }
    for (format::Vertex& vertex : vertices) {
      const LevelCell& cell = cells[vertex.voxel()];
      const Voxel& voxel = *around(cell, true);
      const std::uint32_t ratio = 1U << (cell[0] - voxel.cell[0]);
      const std::uint32_t in_cell[3] = {vertex.fx(), vertex.fy(), vertex.fz()};
      std::uint16_t f[3];
      for (std::size_t a = 0; a < 3; ++a) {
        f[a] = static_cast<std::uint16_t>((65535 * (cell[a + 1] % ratio) + in_cell[a]) / ratio);
      }
      vertex = {voxel.index, f[0], f[1], f[2], 0};
    }
  }

  void fill_voxels(Owner& owner) const {
    owner.runs.clear();
    owner.voxel_material.clear();
    owner.voxel_fill.clear();
    owner.voxel_fixed.clear();
    for (const auto& [place, voxel] : voxels_) {
      const auto& [level, x, y, z] = voxel.cell;
      const auto u16 = [](auto value) { return static_cast<std::uint16_t>(value); };
      const format::Run* const last = owner.runs.empty() ? nullptr : &owner.runs.back();
      const bool goes_on = last != nullptr && last->z() == place[0] && last->y() == place[1] &&
                           std::uint32_t{last->x()} + last->count() == place[2];
      if (goes_on) {
        owner.runs.back() = {last->x(), last->y(), last->z(), u16(last->count() + 1)};
      } else {
        owner.runs.emplace_back(u16(place[2]), u16(place[1]), u16(place[0]), u16(1));
      }
      owner.voxel_material.push_back(voxel.lid ? 1 : 0);
      owner.voxel_fill.push_back(static_cast<std::uint8_t>(std::lround(255 * voxel.part)));
      TinyOrgan block;
      block.nx = u16(size_[0] << level);
      block.ny = u16(size_[1] << level);
      block.nz = u16(size_[2] << level);
      block.fixed_faces = voxel.lid ? graded_.lid_held : graded_.floor_held;
      owner.voxel_fixed.push_back(detail::fixed_corners(block, u16(x), u16(y), u16(z)));
      if (at(voxel.cell, !voxel.lid) == nullptr) continue;
      owner.sheets->parts.emplace_back(u16(place[2]), u16(place[1]), u16(place[0]), u16(0),
                                       quarters_of(voxel));
    }
  }

  std::uint64_t quarters_of(const Voxel& voxel) const {
    const float h = edge(voxel.cell[0]);
    const auto low = low_of(voxel.cell);
    std::uint64_t quarters = 0;
    for (std::uint32_t i = 0; i < 64; ++i) {
      const auto place = [&](std::size_t a, std::uint32_t shift) {
        return low[a] + h * (static_cast<float>((i >> shift) & 3U) + 0.5F) / 4;
      };
      const bool above = detail::above(p_, place(0, 0), place(1, 2), place(2, 4)) > 0;
      if (above == voxel.lid) quarters |= std::uint64_t{1} << i;
    }
    return quarters;
  }

  // The coarser voxel of the block that a node touches.
  const Voxel* touched(const LevelCell& node, bool lid) const {
    for (std::uint32_t side = 0; side < 8; ++side) {
      LevelCell cell = {node[0] - 1, 0, 0, 0};
      bool there = true;
      for (std::uint32_t a = 1; a < 4; ++a) {
        const bool below = ((side >> (a - 1)) & 1U) != 0;
        there = there && (!below || (node[a] % 2 == 0 && node[a] > 0));
        cell[a] = node[a] / 2 - (below && there ? 1U : 0U);
      }
      const Voxel* const found = there ? at(cell, lid) : nullptr;
      if (found != nullptr) return found;
    }
    return nullptr;
  }

  void hang(Owner& owner) const {
    std::map<Place, Place> hangs;
    for (const auto& [unused, voxel] : voxels_) {
      const auto& [level, x, y, z] = voxel.cell;
      for (std::uint32_t i = 0; level > 0 && i < 8; ++i) {
        const LevelCell node = {level, x + (i & 1U), y + ((i >> 1U) & 1U), z + (i >> 2U)};
        const Voxel* const on = touched(node, voxel.lid);
        if (on != nullptr) hangs[place(node, voxel.lid)] = place(on->cell, voxel.lid);
      }
    }
    const auto u16 = [](std::uint32_t value) { return static_cast<std::uint16_t>(value); };
    for (const auto& [node, on] : hangs) {
      owner.levels->hanging.emplace_back(u16(node[2]), u16(node[1]), u16(node[0]), u16(on[2]),
                                         u16(on[1]), u16(on[0]));
    }
  }

  // All of the floor is ground.
  void add_grounds(format::SlidesT& slides) {
    const float steep = steepness();
    for (const auto& [unused, voxel] : voxels_) {
      if (voxel.lid) continue;
      const float h = edge(voxel.cell[0]);
      const auto low = low_of(voxel.cell);
      float d[8];
      for (std::uint32_t i = 0; i < 8; ++i) {
        const auto corner = [&](std::size_t a) {
          return low[a] + h * static_cast<float>((i >> a) & 1U);
        };
        d[i] = (detail::above(p_, corner(0), corner(1), corner(2)) + p_.gap / steep) / h;
      }
      ground_of_[voxel.index] = static_cast<std::uint32_t>(slides.grounds.size());
      slides.grounds.emplace_back(voxel.index, d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]);
      slides.bodies.push_back(7);
    }
  }

  float steepness() const {
    return std::sqrt(1 + p_.slope_x * p_.slope_x + p_.slope_y * p_.slope_y);
  }

  // The block's voxel nearest to the plane in a column of the finest cells.
  const Voxel* at_plane(std::uint32_t x, std::uint32_t y, bool lid) const {
    const std::uint32_t finest = graded_.levels - 1;
    const float h = edge(finest);
    const float up = detail::plane_at(p_, h * (static_cast<float>(x) + 0.5F),
                                      h * (static_cast<float>(y) + 0.5F));
    auto z = static_cast<std::uint32_t>(std::floor((up - (lid ? 0 : p_.gap)) / h));
    for (int tries = 0; tries < 64; ++tries, z += lid ? 1U : ~0U) {
      const Voxel* const found = around({finest, x, y, z}, lid);
      if (found != nullptr) return found;
    }
    std::abort();
  }

  // The finest level of all voxels at a place of the plane and in the cells of level 0 around it.
  std::uint32_t finest_near(float x, float y) const {
    const float z = detail::plane_at(p_, x, y);
    std::uint32_t finest = 0;
    for (const auto& [unused, voxel] : voxels_) {
      const float h = edge(voxel.cell[0]);
      const auto low = low_of(voxel.cell);
      const auto is_near = [&](float at, std::size_t a) {
        return low[a] < std::floor(at) + 2 && low[a] + h > std::floor(at) - 1;
      };
      if (is_near(x, 0) && is_near(y, 1) && is_near(z, 2)) finest = std::max(finest, voxel.cell[0]);
    }
    return finest;
  }

  // Points lie in the middles of squares that are as wide as the finest voxel near them, of both
  // blocks: when the lid moves a little, they still are no wider than the voxels that they meet.
  void add_points(format::SlidesT& slides) const {
    for (std::uint32_t y = p_.at_y; y < std::uint32_t{p_.at_y} + p_.lid_y; ++y) {
      for (std::uint32_t x = p_.at_x; x < std::uint32_t{p_.at_x} + p_.lid_x; ++x) {
        add_points_in(0, x, y, slides);
      }
    }
  }

  void add_points_in(std::uint32_t level, std::uint32_t x, std::uint32_t y,
                     format::SlidesT& slides) const {
    const float h = edge(level);
    const float at_x = h * (static_cast<float>(x) + 0.5F),
                at_y = h * (static_cast<float>(y) + 0.5F);
    const std::uint32_t finest = finest_near(at_x, at_y);
    if (finest > level) {
      for (std::uint32_t i = 0; i < 4; ++i) {
        add_points_in(level + 1, 2 * x + (i & 1U), 2 * y + (i >> 1U), slides);
      }
      return;
    }
    add_point(level, x, y, slides);
  }

  void add_point(std::uint32_t level, std::uint32_t x, std::uint32_t y,
                 format::SlidesT& slides) const {
    const float h = edge(level);
    const float at_x = h * (static_cast<float>(x) + 0.5F),
                at_y = h * (static_cast<float>(y) + 0.5F);
    const float up = detail::plane_at(p_, at_x, at_y);
    const std::uint32_t shift = graded_.levels - 1 - level, half = (1U << shift) / 2;
    const std::uint32_t fx = (x << shift) + half, fy = (y << shift) + half;
    const Voxel& own = *at_plane(fx, fy, true);
    const Voxel& below = *at_plane(fx, fy, false);
    const float edge_own = edge(own.cell[0]);
    const auto low = low_of(own.cell);
    const auto fraction = [&](float of, std::size_t a) {
      return static_cast<std::uint16_t>(
          std::lround(65535 * std::clamp((of - low[a]) / edge_own, 0.0F, 1.0F)));
    };
    slides.points.emplace_back(own.index, fraction(at_x, 0), fraction(at_y, 1), fraction(up, 2),
                               std::uint16_t{0}, steepness() * (h / edge_own) * (h / edge_own),
                               ground_of_.at(below.index), p_.friction);
  }

  const GradedParts& graded_;
  const TwoParts& p_;
  std::array<int, 3> size_;
  std::map<Place, Voxel> voxels_;
  std::map<std::uint32_t, std::uint32_t> ground_of_;  // by voxel
};

}  // namespace graded_parts_detail

inline std::unique_ptr<Owner> graded_parts(const GradedParts& graded) {
  return graded_parts_detail::Builder(graded).owner();
}

}  // namespace stylet::test
