// SPDX-License-Identifier: Apache-2.0
// Graded organs: a block of cells, each a voxel or split into eight, again and again. Nodes on the
// surface of coarser voxels hang on them. The surface is that of the finest voxels. Units: SI.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "owned_organ.h"
#include "session.h"
#include "split_cells.h"

namespace stylet::test {

struct Graded {
  std::uint16_t nx = 4, ny = 4, nz = 4;  // cells of level 0
  std::uint32_t levels = 2;
  float voxel_edge_m = 0.005F;  // of level 0
  std::vector<TinyMaterial> materials = {TinyMaterial{}};
  // Of a voxel of this level; empty: material 0.
  std::function<std::uint8_t(std::uint32_t level, int x, int y, int z)> material_at;
  Split split;
  std::uint32_t fixed_faces = 0;
  // Cells from here on along x are in a second sheet, joined to the first or not; 0: one sheet.
  std::uint16_t cut = 0;
  bool joined = true;
};

namespace graded_detail {

// z, y, x in the lattice: the order of the file.
using Place = std::array<std::uint32_t, 3>;

class Builder {
 public:
  explicit Builder(const Graded& graded) : graded_(graded) {
    const SplitCells cells({graded.nx, graded.ny, graded.nz}, graded.levels, graded.split);
    cells.each([&](const LevelCell& cell) {
      const auto& [level, x, y, z] = cell;
      voxels_[place(level, x, y, z)] = 0;
      at_[place(level, x, y, z)] = cell;
    });
    std::uint32_t count = 0;
    for (auto& [place, index] : voxels_) index = count++;
  }

  std::unique_ptr<Owner> owner() {
    const std::uint32_t finest = graded_.levels - 1;
    TinyOrgan fine;
    fine.nx = static_cast<std::uint16_t>(graded_.nx << finest);
    fine.ny = static_cast<std::uint16_t>(graded_.ny << finest);
    fine.nz = static_cast<std::uint16_t>(graded_.nz << finest);
    fine.voxel_edge_m = graded_.voxel_edge_m / static_cast<float>(1U << finest);
    fine.materials = graded_.materials;
    std::unique_ptr<Owner> owner(format::GetOrgan(tiny_organ(fine).data())->UnPack());
    for (format::Vertex& vertex : owner->vertices) vertex = embedded(vertex, fine);
    owner->format_version = 5;
    owner->voxel_edge_m = graded_.voxel_edge_m;
    owner->size_z = static_cast<std::uint16_t>(first_plane(graded_.levels) - 1);
    fill_voxels(*owner);
    owner->levels = std::make_unique<format::LevelsT>();
    owner->levels->count = static_cast<std::uint8_t>(graded_.levels);
    owner->levels->planes = graded_.nz;
    if (graded_.cut > 0) {
      owner->sheets = std::make_unique<format::SheetsT>();
      owner->sheets->rows = static_cast<std::uint16_t>(rows());
      owner->size_y = static_cast<std::uint16_t>(2 * rows());
    }
    fill_nodes(*owner);
    return owner;
  }

 private:
  std::uint32_t first_plane(std::uint32_t level) const {
    return level + graded_.nz * ((1U << level) - 1);
  }
  std::uint32_t rows() const { return (std::uint32_t{graded_.ny} << (graded_.levels - 1)) + 1; }
  std::uint32_t sheet_of(std::uint32_t level, std::uint32_t x) const {
    return graded_.cut > 0 && x >= std::uint32_t{graded_.cut} << level ? 1 : 0;
  }
  Place node(std::uint32_t sheet, std::uint32_t level, std::uint32_t x, std::uint32_t y,
             std::uint32_t z) const {
    return {first_plane(level) + z, y + sheet * rows(), x};
  }
  Place place(std::uint32_t level, std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return node(sheet_of(level, x), level, x, y, z);
  }
  bool has(std::uint32_t level, int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || z >= graded_.nz << level) return false;
    return voxels_.count(place(level, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                               static_cast<std::uint32_t>(z))) != 0;
  }

  // The voxel in which a vertex of a finest cell lies, and where in it.
  format::Vertex embedded(const format::Vertex& vertex, const TinyOrgan& fine) const {
    const std::uint32_t cell[3] = {vertex.voxel() % fine.nx, vertex.voxel() / fine.nx % fine.ny,
                                   vertex.voxel() / fine.nx / fine.ny};
    const std::uint32_t in_cell[3] = {vertex.fx(), vertex.fy(), vertex.fz()};
    for (std::uint32_t level = 0; level < graded_.levels; ++level) {
      const std::uint32_t shift = graded_.levels - 1 - level, ratio = 1U << shift;
      const auto found =
          voxels_.find(place(level, cell[0] >> shift, cell[1] >> shift, cell[2] >> shift));
      if (found == voxels_.end()) continue;
      std::uint16_t f[3];
      for (int a = 0; a < 3; ++a) {
        f[a] = static_cast<std::uint16_t>((65535 * (cell[a] % ratio) + in_cell[a]) / ratio);
      }
      return {found->second, f[0], f[1], f[2], 0};
    }
    std::abort();
  }

  void fill_voxels(Owner& owner) const {
    owner.runs.clear();
    owner.voxel_material.clear();
    owner.voxel_fixed.clear();
    Place last = {};
    std::uint16_t length = 0;
    const auto end_run = [&] {
      if (length == 0) return;
      owner.runs.emplace_back(static_cast<std::uint16_t>(last[2] + 1 - length),
                              static_cast<std::uint16_t>(last[1]),
                              static_cast<std::uint16_t>(last[0]), length);
    };
    for (const auto& [place, at] : at_) {
      const auto& [level, x, y, z] = at;
      if (length == 0 || place != Place{last[0], last[1], last[2] + 1}) {
        end_run();
        length = 0;
      }
      ++length;
      last = place;
      const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
      owner.voxel_material.push_back(graded_.material_at ? graded_.material_at(level, i, j, k) : 0);
      TinyOrgan block;
      block.nx = static_cast<std::uint16_t>(graded_.nx << level);
      block.ny = static_cast<std::uint16_t>(graded_.ny << level);
      block.nz = static_cast<std::uint16_t>(graded_.nz << level);
      block.fixed_faces = graded_.fixed_faces;
      owner.voxel_fixed.push_back(detail::fixed_corners(block, static_cast<std::uint16_t>(x),
                                                        static_cast<std::uint16_t>(y),
                                                        static_cast<std::uint16_t>(z)));
    }
    end_run();
    owner.voxel_fill.assign(owner.voxel_material.size(), 255);
  }

  // The voxel on which a node hangs: the coarsest that it touches, or none.
  bool find_coarser(std::uint32_t level, std::uint32_t sheet, const std::uint32_t (&at)[3],
                    Place& voxel_out) const {
    for (std::uint32_t coarse = 0; coarse < level; ++coarse) {
      const int ratio = 1 << (level - coarse);
      for (std::uint32_t side = 0; side < 8; ++side) {
        int cell[3];
        for (std::uint32_t a = 0; a < 3; ++a) {  // both cells where it is on their face
          const int n = static_cast<int>(at[a]);
          cell[a] = n % ratio == 0 && ((side >> a) & 1U) != 0 ? n / ratio - 1 : n / ratio;
        }
        if (!has(coarse, cell[0], cell[1], cell[2])) continue;
        const std::uint32_t other = sheet_of(coarse, static_cast<std::uint32_t>(cell[0]));
        if (!graded_.joined && other != sheet) continue;
        voxel_out = place(coarse, static_cast<std::uint32_t>(cell[0]),
                          static_cast<std::uint32_t>(cell[1]), static_cast<std::uint32_t>(cell[2]));
        return true;
      }
    }
    return false;
  }

  // Hanging nodes, and ties of the others.
  void fill_nodes(Owner& owner) const {
    std::map<Place, std::array<std::uint32_t, 5>> nodes;  // level, x, y, z, sheet
    for (const auto& [unused, at] : at_) {
      const auto& [level, x, y, z] = at;
      const std::uint32_t sheet = sheet_of(level, x);
      for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t n[3] = {x + (i & 1U), y + ((i >> 1U) & 1U), z + (i >> 2U)};
        nodes[node(sheet, level, n[0], n[1], n[2])] = {level, n[0], n[1], n[2], sheet};
      }
    }
    const auto u16 = [](std::uint32_t v) { return static_cast<std::uint16_t>(v); };
    for (const auto& [own, at] : nodes) {
      const auto& [level, x, y, z, sheet] = at;
      Place voxel = {};
      if (find_coarser(level, sheet, {x, y, z}, voxel)) {
        owner.levels->hanging.emplace_back(u16(own[2]), u16(own[1]), u16(own[0]), u16(voxel[2]),
                                           u16(voxel[1]), u16(voxel[0]));
      } else if (graded_.joined && sheet == 1 && nodes.count(node(0, level, x, y, z)) != 0) {
        owner.sheets->ties.emplace_back(u16(own[2]), u16(own[1]), u16(own[0]), u16(y));
      }
    }
  }

  const Graded& graded_;
  std::map<Place, std::uint32_t> voxels_;
  std::map<Place, LevelCell> at_;
};

}  // namespace graded_detail

inline std::unique_ptr<Owner> graded_organ(const Graded& graded) {
  return graded_detail::Builder(graded).owner();
}

// A graded organ in a kernel.
struct Body {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
};
inline Body make(const Graded& graded, const Config& config) {
  Body out = {packed(*graded_organ(graded)), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

}  // namespace stylet::test
