// SPDX-License-Identifier: Apache-2.0
// A block of voxels, or a body cut from it, as the bytes of an organ file, made in memory for
// tests.
//
// The surface is the outside of the voxels, two triangles a voxel face, outward; it is closed in
// space. Vertices are not shared between voxels, so every leaf of the sphere tree (one a boundary
// voxel) depends on that voxel's corners alone. Units: SI. Frame: the low corner of the block is at
// `origin_m`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "organ_generated.h"
#include "stylet/material.h"
#include "stylet/units.h"

namespace stylet::test {

// A gel. Numbers that are not named here have their smallest value.
inline constexpr Material kGel = [] {
  Material m = {};
  for (const MaterialNumber& number : kMaterialNumbers) m.*number.field = number.least;
  m.density_kg_per_m3 = 1000;
  m.youngs_modulus_pa = 5000;
  m.poisson_ratio = 0.45F;
  m.relaxation_time_s = 1;
  m.puncture_force_n = 0.5F;
  m.cutting_force_n = 0.2F;
  m.recut_fraction = 0.2F;
  m.coulomb_friction_n_per_m = 10;
  m.static_friction_n_per_m = 10;
  m.stribeck_velocity_m_per_s = 1e-3F;
  m.fluid_pressure_pa = 0;
  return m;
}();

#define STYLET_TINY_FIELD(field, ...) float field = kGel.field;
struct TinyMaterial {
  std::string name = "gel";
  STYLET_MATERIAL_NUMBERS(STYLET_TINY_FIELD)
};
#undef STYLET_TINY_FIELD

enum Face : std::uint32_t { kLowX = 1, kHighX = 2, kLowY = 4, kHighY = 8, kLowZ = 16, kHighZ = 32 };

// A membrane of this material, as triangles in the rest frame.
struct TinyMembrane {
  std::uint16_t material = 0;
  std::vector<std::array<Vec3, 3>> triangles;
  float area = 0;  // in each cell that lists it, in squares of the edge
};

struct TinyOrgan {
  std::uint16_t nx = 8, ny = 8, nz = 8;
  float voxel_edge_m = 0.005F;
  Vec3 origin_m = {};
  std::vector<TinyMaterial> materials = {TinyMaterial{}};
  // Material of voxel (x, y, z); empty: material 0 everywhere.
  std::function<std::uint8_t(std::uint16_t, std::uint16_t, std::uint16_t)> material_at;
  // Whether there is a voxel at (x, y, z); empty: everywhere in the block.
  std::function<bool(std::uint16_t, std::uint16_t, std::uint16_t)> inside;
  std::vector<format::Mixed> mixed;
  std::vector<TinyMembrane> membranes;  // by rising material
  std::uint32_t fixed_faces = 0;        // Face bits: the corners on these faces never move
  std::uint16_t sheet_rows = 0;         // of each sheet; 0: one sheet
  // How much of a voxel is filled, 255: all, and whether its free faces are part of the surface;
  // empty: all of them.
  std::function<std::uint8_t(std::uint16_t, std::uint16_t, std::uint16_t)> fill_at;
  std::function<bool(std::uint16_t, std::uint16_t, std::uint16_t)> has_surface;
  std::vector<format::Part> parts;  // of voxels that share a cell
  std::vector<format::SlidePoint> slide_points;
  std::vector<format::SlideGround> slide_grounds;
};

namespace detail {

inline bool has_voxel(const TinyOrgan& organ, int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x >= organ.nx || y >= organ.ny || z >= organ.nz) return false;
  return !organ.inside || organ.inside(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                       static_cast<std::uint16_t>(z));
}

struct Box {
  float low[3], high[3];
};

struct Leaf {
  Box box;
  std::uint32_t first, count;
};

inline format::SphereNode sphere_of(const std::vector<Leaf>& leaves, std::size_t begin,
                                    std::size_t end, std::uint32_t first, std::uint32_t count) {
  Box box = leaves[begin].box;
  for (std::size_t i = begin; i < end; ++i) {
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], leaves[i].box.low[a]);
      box.high[a] = std::max(box.high[a], leaves[i].box.high[a]);
    }
  }
  float centre[3], square = 0;
  for (int a = 0; a < 3; ++a) {
    centre[a] = 0.5F * (box.low[a] + box.high[a]);
    const float half = 0.5F * (box.high[a] - box.low[a]);
    square += half * half;
  }
  return {centre[0], centre[1], centre[2], std::sqrt(square) * 1.0001F, first, count};
}

// Median split along the widest axis; siblings next to each other, children behind their parent.
inline void split(std::vector<Leaf>& leaves, std::size_t begin, std::size_t end, std::size_t at,
                  std::vector<format::SphereNode>& nodes) {
  if (end - begin == 1) {
    nodes[at] = sphere_of(leaves, begin, end, leaves[begin].first, leaves[begin].count);
    return;
  }
  const format::SphereNode whole = sphere_of(leaves, begin, end, 0, 0);
  int axis = 0;
  float widest = -1;
  for (int a = 0; a < 3; ++a) {
    float low = leaves[begin].box.low[a], high = leaves[begin].box.high[a];
    for (std::size_t i = begin; i < end; ++i) {
      low = std::min(low, leaves[i].box.low[a]);
      high = std::max(high, leaves[i].box.high[a]);
    }
    if (high - low > widest) {
      widest = high - low;
      axis = a;
    }
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const auto where = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  std::nth_element(
      leaves.begin() + where(begin), leaves.begin() + where(middle), leaves.begin() + where(end),
      [axis](const Leaf& a, const Leaf& b) { return a.box.low[axis] < b.box.low[axis]; });
  const auto children = static_cast<std::uint32_t>(nodes.size());
  nodes.resize(nodes.size() + 2);
  nodes[at] = {whole.x(), whole.y(), whole.z(), whole.radius(), children, 0};
  split(leaves, begin, middle, children, nodes);
  split(leaves, middle, end, children + 1, nodes);
}

struct Surface {
  std::vector<format::Vertex> vertices;
  std::vector<format::Triangle> triangles;
  std::vector<format::SphereNode> nodes;
};

inline Surface surface_of(const TinyOrgan& organ) {
  Surface surface;
  std::vector<Leaf> leaves;
  const std::uint16_t size[3] = {organ.nx, organ.ny, organ.nz};
  const float origin[3] = {organ.origin_m.x, organ.origin_m.y, organ.origin_m.z};
  std::uint32_t voxel = 0;
  std::uint16_t at[3];
  for (at[2] = 0; at[2] < size[2]; ++at[2]) {
    for (at[1] = 0; at[1] < size[1]; ++at[1]) {
      for (at[0] = 0; at[0] < size[0]; ++at[0]) {
        if (!has_voxel(organ, at[0], at[1], at[2])) continue;
        Leaf leaf{{}, static_cast<std::uint32_t>(surface.triangles.size()), 0};
        const int in_space[3] = {at[0], organ.sheet_rows > 0 ? at[1] % organ.sheet_rows : at[1],
                                 at[2]};
        for (int a = 0; a < 3; ++a) {
          leaf.box.low[a] = origin[a] + static_cast<float>(in_space[a]) * organ.voxel_edge_m;
          leaf.box.high[a] = leaf.box.low[a] + organ.voxel_edge_m;
        }
        for (int axis = 0; axis < 3; ++axis) {
          for (int side = 0; side < 2; ++side) {
            int beside[3] = {at[0], at[1], at[2]};
            beside[axis] += side == 0 ? -1 : 1;
            if (has_voxel(organ, beside[0], beside[1], beside[2])) continue;
            if (organ.has_surface && !organ.has_surface(at[0], at[1], at[2])) continue;
            const auto base = static_cast<std::uint32_t>(surface.vertices.size());
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int corner = 0; corner < 4; ++corner) {
              std::uint16_t f[3];
              f[axis] = side != 0 ? 65535 : 0;
              f[u] = (corner == 1 || corner == 2) ? 65535 : 0;
              f[v] = corner >= 2 ? 65535 : 0;
              surface.vertices.emplace_back(voxel, f[0], f[1], f[2], std::uint16_t{0});
            }
            const std::uint32_t b = side != 0 ? 1 : 3, d = side != 0 ? 3 : 1;
            surface.triangles.emplace_back(base, base + b, base + 2);
            surface.triangles.emplace_back(base, base + 2, base + d);
            leaf.count += 2;
          }
        }
        if (leaf.count > 0) leaves.push_back(leaf);
        ++voxel;
      }
    }
  }
  surface.nodes.resize(1);
  split(leaves, 0, leaves.size(), 0, surface.nodes);
  return surface;
}

// Attached corners of one voxel, bit dx + 2 dy + 4 dz.
inline std::uint8_t fixed_corners(const TinyOrgan& organ, std::uint16_t x, std::uint16_t y,
                                  std::uint16_t z) {
  std::uint32_t bits = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t cx = x + (corner & 1U), cy = y + ((corner >> 1U) & 1U),
                        cz = z + (corner >> 2U);
    const std::uint32_t on = (cx == 0 ? kLowX : 0U) | (cx == organ.nx ? kHighX : 0U) |
                             (cy == 0 ? kLowY : 0U) | (cy == organ.ny ? kHighY : 0U) |
                             (cz == 0 ? kLowZ : 0U) | (cz == organ.nz ? kHighZ : 0U);
    if ((on & organ.fixed_faces) != 0) bits |= 1U << corner;
  }
  return static_cast<std::uint8_t>(bits);
}

// Each triangle in all cells that its box touches: they may be more than need be.
inline flatbuffers::Offset<format::Membranes> membranes_of(flatbuffers::FlatBufferBuilder& builder,
                                                           const TinyOrgan& organ) {
  std::vector<format::MembranePoint> points;
  std::vector<format::Triangle> triangles;
  std::vector<format::MembraneCell> cells;
  const auto box_of = [&](const std::array<Vec3, 3>& t) {
    Box box = {{1e9F, 1e9F, 1e9F}, {-1e9F, -1e9F, -1e9F}};
    for (const Vec3& p : t) {
      const float at[3] = {p.x - organ.origin_m.x, p.y - organ.origin_m.y, p.z - organ.origin_m.z};
      for (int a = 0; a < 3; ++a) {
        box.low[a] = std::min(box.low[a], at[a] / organ.voxel_edge_m - 0.01F);
        box.high[a] = std::max(box.high[a], at[a] / organ.voxel_edge_m + 0.01F);
      }
    }
    return box;
  };
  for (std::uint16_t z = 0; z < organ.nz; ++z) {
    for (std::uint16_t y = 0; y < organ.ny; ++y) {
      for (std::uint16_t x = 0; x < organ.nx; ++x) {
        for (const TinyMembrane& membrane : organ.membranes) {
          const auto first = static_cast<std::uint32_t>(triangles.size());
          for (const std::array<Vec3, 3>& t : membrane.triangles) {
            const Box box = box_of(t);
            const std::uint16_t at[3] = {x, y, z};
            bool touches = true;
            for (int a = 0; a < 3; ++a) {
              touches = touches && box.low[a] < static_cast<float>(at[a] + 1) &&
                        box.high[a] > static_cast<float>(at[a]);
            }
            if (!touches) continue;
            const auto base = static_cast<std::uint32_t>(points.size());
            for (const Vec3& p : t) points.emplace_back(p.x, p.y, p.z);
            triangles.emplace_back(base, base + 1, base + 2);
          }
          const auto count = static_cast<std::uint32_t>(triangles.size()) - first;
          if (count > 0)
            cells.emplace_back(x, y, z, membrane.material, first, count, membrane.area);
        }
      }
    }
  }
  return format::CreateMembranesDirect(builder, &points, &triangles, &cells);
}

inline flatbuffers::Offset<format::Material> material_of(flatbuffers::FlatBufferBuilder& builder,
                                                         const TinyMaterial& m) {
#define STYLET_AND_WRITE(field, ...) , m.field
  return format::CreateMaterialDirect(builder, m.name.c_str(),
                                      "test" STYLET_MATERIAL_NUMBERS(STYLET_AND_WRITE));
#undef STYLET_AND_WRITE
}

}  // namespace detail

inline std::vector<std::byte> tiny_organ(const TinyOrgan& organ) {
  flatbuffers::FlatBufferBuilder builder;
  std::vector<format::Run> runs;
  std::vector<std::uint8_t> material, fill, fixed;
  for (std::uint16_t z = 0; z < organ.nz; ++z) {
    for (std::uint16_t y = 0; y < organ.ny; ++y) {
      std::uint16_t length = 0;
      for (std::uint16_t x = 0; x < organ.nx; ++x) {
        if (!detail::has_voxel(organ, x, y, z)) continue;
        ++length;
        material.push_back(organ.material_at ? organ.material_at(x, y, z) : std::uint8_t{0});
        fill.push_back(organ.fill_at ? organ.fill_at(x, y, z) : std::uint8_t{255});
        fixed.push_back(detail::fixed_corners(organ, x, y, z));
        if (detail::has_voxel(organ, x + 1, y, z)) continue;
        runs.emplace_back(static_cast<std::uint16_t>(x + 1 - length), y, z, length);
        length = 0;
      }
    }
  }
  if (organ.fixed_faces == 0) fixed.clear();
  std::vector<flatbuffers::Offset<format::Material>> materials;
  for (const TinyMaterial& m : organ.materials) {
    materials.push_back(detail::material_of(builder, m));
  }
  const detail::Surface surface = detail::surface_of(organ);
  const bool has_membranes = !organ.membranes.empty(), slides = !organ.slide_points.empty();
  const bool has_sheets = organ.sheet_rows > 0;
  flatbuffers::Offset<format::Membranes> membranes;
  flatbuffers::Offset<format::Sheets> sheets;
  flatbuffers::Offset<format::Slides> slide;
  if (has_membranes) membranes = detail::membranes_of(builder, organ);
  if (has_sheets)
    sheets = format::CreateSheetsDirect(builder, organ.sheet_rows, nullptr, &organ.parts);
  if (slides) {
    slide = format::CreateSlidesDirect(builder, &organ.slide_points, &organ.slide_grounds);
  }
  const std::uint32_t plain = organ.mixed.empty() && !has_sheets ? 1 : 2;
  format::FinishOrganBuffer(
      builder,
      format::CreateOrganDirect(
          builder, slides ? 4 : (has_membranes ? 3 : plain), "tiny", organ.voxel_edge_m,
          organ.origin_m.x, organ.origin_m.y, organ.origin_m.z, organ.nx, organ.ny, organ.nz, &runs,
          &material, &fill, fixed.empty() ? nullptr : &fixed, &materials, &surface.vertices,
          &surface.triangles, &surface.nodes, 0, organ.mixed.empty() ? nullptr : &organ.mixed,
          sheets, nullptr, membranes, slide));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

}  // namespace stylet::test
