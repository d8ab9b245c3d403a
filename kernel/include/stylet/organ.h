// SPDX-License-Identifier: Apache-2.0
// An organ: read-only view of an organ file's bytes, checked once, then trusted.
//
// Promises: organ_open allocates nothing and keeps pointers into the caller's bytes, which must
// outlive the Organ and every kernel made from it. Time is linear in the file's size. After kOk
// every index is in range, every number finite and within limits.h, so no tick checks the organ
// again. Units: SI; frame: world (the rest frame). Format: kernel/schema/organ.fbs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/material.h"
#include "stylet/status.h"
#include "stylet/units.h"

namespace stylet {

// Same bytes as the structs of the schema; organ.cpp asserts it.
struct OrganRun {
  std::uint16_t x, y, z, count;
};
struct OrganVertex {
  std::uint32_t voxel;
  std::uint16_t fx, fy, fz, reserved;
};
struct OrganTriangle {
  std::uint32_t a, b, c;
};
struct OrganMixed {  // a voxel with two tissues, or one and none
  std::uint32_t voxel;
  std::uint16_t material, reserved;  // kNoTissue: none
  float nx, ny, nz, limit;           // `material` is where n . (place in voxel, 0 to 1) > limit
};
constexpr std::uint16_t kNoTissue = 0xFFFF;
struct OrganSphere {
  float x, y, z, radius;
  std::uint32_t first, count;  // count = 0: children first, first + 1; else triangles of a leaf
};

struct OrganTie {
  std::uint16_t x, y, z, to_y;
};
struct OrganPart {
  std::uint16_t x, y, z, reserved;
  std::uint64_t quarters;
};

struct OrganPoint {
  float x, y, z;
};
struct OrganMembraneCell {  // a membrane in a cell of space, of any level
  std::uint16_t x, y, z, material;
  std::uint32_t first, count;  // of membrane_triangles; none at a finer level
  float area;                  // within the cell, in squares of the edge
};

struct OrganSlidePoint {  // of one part's surface, where it faces a part that it may slide along
  std::uint32_t voxel;
  std::uint16_t fx, fy, fz, reserved;
  float area;            // in squares of the edge
  std::uint32_t ground;  // of slide_grounds, at rest
  float friction;
};
struct OrganSlideGround {  // a voxel of the other part, near its surface
  std::uint32_t voxel;
  float distance[8];  // of its corners to that surface, in edges, positive outside
};

struct OrganSkin {  // the surface in a voxel of a material with a skin
  std::uint32_t voxel;
  float area;  // in squares of the voxel's edge
};

struct OrganHanging {  // a node, and the voxel of a coarser level with which it moves
  std::uint16_t x, y, z, voxel_x, voxel_y, voxel_z;
};

struct Organ {
  const void* root = nullptr;  // the FlatBuffers table; only organ.cpp looks inside
  const char* name = nullptr;
  std::uint64_t hash = 0;  // of all bytes
  std::uint32_t format_version = 0;
  float voxel_edge_m = 0;
  Vec3 origin_m = {};
  std::uint16_t size_x = 0, size_y = 0, size_z = 0;
  std::uint16_t sheet_rows = 0;    // row y lies at y % sheet_rows in space; size_y of one sheet
  std::uint16_t levels = 1;        // each has half the edge of the one before (organ.fbs)
  std::uint16_t level_planes = 0;  // size_z of the coarsest level alone
  std::uint32_t voxel_count = 0;
  std::uint32_t material_count = 0;
  std::span<const OrganRun> runs;
  std::span<const std::uint8_t> voxel_material;
  std::span<const std::uint8_t> voxel_fill;
  std::span<const std::uint8_t> voxel_fixed;  // empty, or one per voxel
  std::span<const OrganMixed> mixed;          // sorted by voxel
  std::span<const OrganVertex> vertices;
  std::span<const OrganTriangle> triangles;
  std::span<const OrganSphere> spheres;
  std::span<const OrganTie> ties;
  std::span<const OrganPart> parts;
  std::span<const OrganPoint> membrane_points;
  std::span<const OrganTriangle> membrane_triangles;
  std::span<const OrganMembraneCell> membrane_cells;  // sorted by z, y, x, material
  std::span<const OrganSlidePoint> slide_points;
  std::span<const OrganSlideGround> slide_grounds;  // sorted by voxel
  std::span<const std::uint8_t> slide_bodies;       // of each ground; empty: their sheets
  std::span<const OrganHanging> hanging;            // sorted by z, y, x
  std::span<const OrganSkin> skins;                 // sorted by voxel
  // SHA-256 of all bytes of the file but these 32, or empty (format version 1). Whoever loads a
  // file checks it: the kernel cannot compute a SHA-256.
  std::span<const std::uint8_t> content_sha256;
};

// Why a file was refused: where, which value, what was expected. Strings are static.
struct OrganRefusal {
  Status status = Status::kOk;
  const char* place = "";
  std::uint64_t index = 0;
  double value = 0;
  const char* expected = "";
};

Status organ_open(std::span<const std::byte> bytes, Organ& organ_out,
                  OrganRefusal* refusal_out = nullptr);

// `index` < organ.material_count.
Material organ_material(const Organ& organ, std::uint32_t index);

// Place at rest of a vertex whose voxel is number `voxel_x`, `voxel_y`, `voxel_z` of the lattice;
// of a lattice with sheets, voxel_y is its run's y modulo sheet_rows; with levels, voxel_z is its
// run's z, which also says the level.
Vec3 organ_vertex_place(const Organ& organ, std::uint32_t voxel_x, std::uint32_t voxel_y,
                        std::uint32_t voxel_z, const OrganVertex& vertex);

// First crossing of the rest surface along a ray (cold path: visits every triangle). False if
// there is none. `direction` has unit length; `distance_out_m` >= 0.
bool organ_raycast(const Organ& organ, Vec3 origin_m, Vec3 direction, float& distance_out_m);

}  // namespace stylet
