// SPDX-License-Identifier: GPL-3.0-or-later
// Turns the parts of an organ into the bytes of an organ file (kernel/schema/organ.fbs).
//
// Promises: the bytes depend only on the parts, and organ_open has accepted them. Units: metres.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asset/materials.h"
#include "asset/membranes.h"
#include "asset/sphere_tree.h"
#include "base/geometry.h"
#include "stylet/organ.h"

namespace stylet::offline {

struct SourceRecord {
  std::string path;  // file name without folders
  std::string tissue;
  std::string sha256;
  double metres_per_unit = 0;
  int priority = 0;
  std::uint32_t triangle_count = 0;
};

struct OrganParts {
  std::string name;
  Vec origin_m;
  double edge_m = 0;
  std::uint32_t size_x = 0, size_z = 0;      // of the lattice, in voxels
  std::uint32_t sheets = 1, sheet_rows = 0;  // sheets follow one another along y
  std::uint32_t levels = 1, level_planes = 0;
  std::vector<OrganHanging> hanging;  // only with several levels
  std::vector<OrganSkin> skins;       // sorted by voxel
  std::vector<OrganRun> runs;
  std::vector<OrganTie> ties;            // only with several sheets
  std::vector<OrganPart> cell_parts;     // only with several sheets
  std::vector<std::uint8_t> voxel_fill;  // 1..255
  std::vector<std::uint8_t> voxel_material;
  std::vector<OrganMixed> mixed;
  std::vector<std::uint8_t> voxel_fixed;  // empty: a free body
  std::vector<Tissue> materials;
  std::vector<OrganVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<OrganSphere> spheres;
  MembraneLists membranes;
  std::vector<OrganSlidePoint> slide_points;
  std::vector<OrganSlideGround> slide_grounds;
  std::vector<std::uint8_t> slide_bodies;  // of each ground, with levels
  std::string tool_version;
  std::string options;
  std::vector<SourceRecord> sources;
};

std::vector<std::byte> write_organ(const OrganParts& parts);

// A refusal by organ_open as "place[index] = value: expected ...".
std::string describe(const OrganRefusal& refusal);

}  // namespace stylet::offline
