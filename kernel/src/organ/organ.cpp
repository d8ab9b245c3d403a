// SPDX-License-Identifier: Apache-2.0
// The only code that reads untrusted bytes: FlatBuffers' verifier checks structure, we check
// meaning. Why only here: after organ_open has returned kOk the tick may index without checks.

#include "stylet/organ.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "organ/check_levels.h"
#include "organ/check_slides.h"
#include "organ/checker.h"
#include "organ/runs.h"
#include "organ_generated.h"
#include "stylet/levels.h"
#include "stylet/limits.h"

namespace stylet {
namespace {

static_assert(std::endian::native == std::endian::little, "organ files are used in place");
static_assert(sizeof(OrganRun) == sizeof(format::Run));
static_assert(sizeof(OrganVertex) == sizeof(format::Vertex));
static_assert(sizeof(OrganTriangle) == sizeof(format::Triangle));
static_assert(sizeof(OrganMixed) == sizeof(format::Mixed));
static_assert(sizeof(OrganSphere) == sizeof(format::SphereNode));
static_assert(sizeof(OrganTie) == sizeof(format::Tie));
static_assert(sizeof(OrganPart) == sizeof(format::Part));
static_assert(sizeof(OrganPoint) == sizeof(format::MembranePoint));
static_assert(sizeof(OrganMembraneCell) == sizeof(format::MembraneCell));
static_assert(sizeof(OrganSlidePoint) == sizeof(format::SlidePoint));
static_assert(sizeof(OrganSkin) == sizeof(format::Skin));
static_assert(sizeof(OrganHanging) == sizeof(format::Hanging));
static_assert(sizeof(OrganSlideGround) == sizeof(format::SlideGround));

constexpr std::uint32_t kNewestFormat = 6;
constexpr float kMaxPointM = 8;  // every place that matters is nearer: see kMaxOriginM

template <typename Mine, typename Theirs>
std::span<const Mine> view(const flatbuffers::Vector<const Theirs*>* vector) {
  if (vector == nullptr) return {};
  return {reinterpret_cast<const Mine*>(vector->data()), vector->size()};
}

std::span<const std::uint8_t> view(const flatbuffers::Vector<std::uint8_t>* vector) {
  if (vector == nullptr) return {};
  return {vector->data(), vector->size()};
}

std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::byte b : bytes) {
    hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ULL;
  }
  return hash;
}

// Runs are inside the lattice, sorted and apart; they have as many voxels as the per-voxel arrays.
bool check_runs(Checker& check, const Organ& organ) {
  std::uint64_t voxels = 0;
  std::uint64_t last_row = 0;
  std::uint32_t last_end = 0;
  for (std::size_t i = 0; i < organ.runs.size(); ++i) {
    const OrganRun& run = organ.runs[i];
    const std::uint64_t row = (static_cast<std::uint64_t>(run.z) << 16U) | run.y;
    const std::uint32_t end = static_cast<std::uint32_t>(run.x) + run.count;
    if (!check.require(run.count > 0, Status::kOrganValueOutOfRange, "runs.count", i, 0,
                       "at least 1 voxel") ||
        !check.require(end <= organ.size_x && run.y < organ.size_y && run.z < organ.size_z,
                       Status::kOrganIndexOutOfRange, "runs", i, static_cast<double>(end),
                       "a run inside the lattice") ||
        !check.require(i == 0 || row > last_row || (row == last_row && run.x > last_end),
                       Status::kOrganOrderWrong, "runs", i, static_cast<double>(run.x),
                       "runs sorted by z, y, x with a gap between runs of a row")) {
      return false;
    }
    last_row = row;
    last_end = end;
    voxels += run.count;
  }
  return check.require(voxels == organ.voxel_count, Status::kOrganSizesDisagree, "voxel_material",
                       organ.voxel_count, static_cast<double>(voxels),
                       "as many entries as the runs have voxels");
}

bool check_voxels(Checker& check, const Organ& organ) {
  const std::size_t count = organ.voxel_count;
  if (!check.require(organ.voxel_fill.size() == count, Status::kOrganSizesDisagree, "voxel_fill",
                     organ.voxel_fill.size(), static_cast<double>(count), "one per voxel") ||
      !check.require(organ.voxel_fixed.empty() || organ.voxel_fixed.size() == count,
                     Status::kOrganSizesDisagree, "voxel_fixed", organ.voxel_fixed.size(),
                     static_cast<double>(count), "none, or one per voxel")) {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!check.require(organ.voxel_material[i] < organ.material_count,
                       Status::kOrganIndexOutOfRange, "voxel_material", i, organ.voxel_material[i],
                       "an index into materials") ||
        !check.require(organ.voxel_fill[i] > 0, Status::kOrganValueOutOfRange, "voxel_fill", i, 0,
                       "1 to 255")) {
      return false;
    }
  }
  return true;
}

// A tick uses these to compute the index of a voxel's entry, and their material numbers as indices.
bool check_mixed(Checker& check, const Organ& organ, std::uint32_t version) {
  if (!check.require(organ.mixed.empty() || version >= 2, Status::kOrganVersionUnknown, "mixed", 0,
                     version, "format version 2 where there are mixed voxels")) {
    return false;
  }
  for (std::size_t i = 0; i < organ.mixed.size(); ++i) {
    const OrganMixed& m = organ.mixed[i];
    if (!check.require(m.voxel < organ.voxel_count, Status::kOrganIndexOutOfRange, "mixed.voxel", i,
                       m.voxel, "a voxel of the lattice") ||
        !check.require(i == 0 || m.voxel > organ.mixed[i - 1].voxel, Status::kOrganOrderWrong,
                       "mixed.voxel", i, m.voxel, "voxels in rising order, each once") ||
        !check.require(m.material < organ.material_count || m.material == kNoTissue,
                       Status::kOrganIndexOutOfRange, "mixed.material", i, m.material,
                       "an index into materials, or 65535 for no tissue") ||
        !check.in_range(m.nx, -1, 1, "mixed.nx", i, "-1 to 1") ||
        !check.in_range(m.ny, -1, 1, "mixed.ny", i, "-1 to 1") ||
        !check.in_range(m.nz, -1, 1, "mixed.nz", i, "-1 to 1") ||
        !check.in_range(m.limit, -2, 2, "mixed.limit", i, "-2 to 2")) {
      return false;
    }
  }
  return true;
}

bool check_skins(Checker& check, const Organ& organ, std::uint32_t version) {
  if (!check.require(organ.skins.empty() || version >= 6, Status::kOrganVersionUnknown, "skins", 0,
                     version, "format version 6 where there are skins")) {
    return false;
  }
  for (std::size_t i = 0; i < organ.skins.size(); ++i) {
    const OrganSkin& s = organ.skins[i];
    if (!check.require(s.voxel < organ.voxel_count, Status::kOrganIndexOutOfRange, "skins.voxel", i,
                       s.voxel, "a voxel of the lattice") ||
        !check.require(i == 0 || s.voxel > organ.skins[i - 1].voxel, Status::kOrganOrderWrong,
                       "skins.voxel", i, s.voxel, "voxels in rising order, each once") ||
        !check.in_range(s.area, 0, kMaxTrianglesPerCell, "skins.area", i, "0 to 256")) {
      return false;
    }
  }
  return true;
}

// Static friction has no limit of its own from below: it is at least Coulomb's.
bool check_material(Checker& check, const Material& material, std::uint32_t index) {
  for (const MaterialNumber& number : kMaterialNumbers) {
    const bool at_rest = number.field == &Material::static_friction_n_per_m;
    const float least = at_rest ? material.coulomb_friction_n_per_m : number.least;
    if (!check.in_range(material.*number.field, least, number.most, number.name, index,
                        number.expected)) {
      return false;
    }
  }
  return true;
}

bool check_materials(Checker& check, const Organ& organ) {
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    if (!check_material(check, organ_material(organ, i), i)) return false;
  }
  return true;
}

bool check_surface(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.vertices.size(); ++i) {
    if (!check.require(organ.vertices[i].voxel < organ.voxel_count, Status::kOrganIndexOutOfRange,
                       "vertices.voxel", i, organ.vertices[i].voxel, "a voxel of the lattice")) {
      return false;
    }
  }
  const std::size_t vertex_count = organ.vertices.size();
  for (std::size_t i = 0; i < organ.triangles.size(); ++i) {
    const OrganTriangle& t = organ.triangles[i];
    for (const std::uint32_t corner : {t.a, t.b, t.c}) {
      if (!check.require(corner < vertex_count, Status::kOrganIndexOutOfRange, "triangles", i,
                         corner, "three indices into vertices")) {
        return false;
      }
    }
  }
  return true;
}

// Walks the whole tree once with a stack of the tick's size: every node must be reached exactly
// once, and the stack must be large enough.
bool check_depth(Checker& check, const Organ& organ) {
  std::uint32_t stack[kMaxTreeDepth];
  std::uint32_t top = 0;
  std::uint64_t visits = 0;
  if (!organ.spheres.empty()) stack[top++] = 0;
  while (top > 0 && visits <= organ.spheres.size()) {
    const std::uint32_t index = stack[--top];
    ++visits;
    const OrganSphere& node = organ.spheres[index];
    if (node.count > 0) continue;
    if (!check.require(top + 2 <= kMaxTreeDepth, Status::kOrganValueOutOfRange, "sphere_nodes",
                       index, top, "a tree at most 62 levels deep")) {
      return false;
    }
    stack[top++] = node.first + 1;
    stack[top++] = node.first;
  }
  return check.require(visits == organ.spheres.size(), Status::kOrganIndexOutOfRange,
                       "sphere_nodes", visits, static_cast<double>(organ.spheres.size()),
                       "every node the child of exactly one node");
}

// Children come after their parent, so a walk ends; leaves are inside the triangle list.
bool check_spheres(Checker& check, const Organ& organ) {
  const std::size_t count = organ.spheres.size();
  if (!check.require((count > 0) == !organ.triangles.empty(), Status::kOrganSizesDisagree,
                     "sphere_nodes", count, static_cast<double>(organ.triangles.size()),
                     "a sphere tree exactly where there are triangles")) {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const OrganSphere& s = organ.spheres[i];
    const bool finite = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) &&
                        std::isfinite(s.radius) && s.radius >= 0;
    const std::uint64_t end = static_cast<std::uint64_t>(s.first) + (s.count > 0 ? s.count : 2U);
    const bool inside = s.count > 0 ? end <= organ.triangles.size() : end <= count && s.first > i;
    if (!check.require(finite, Status::kOrganValueOutOfRange, "sphere_nodes", i,
                       static_cast<double>(s.radius), "finite spheres") ||
        !check.require(inside, Status::kOrganIndexOutOfRange, "sphere_nodes.first", i, s.first,
                       "children behind the parent, leaves inside triangles")) {
      return false;
    }
  }
  return check_depth(check, organ);
}

bool is_tied(const Organ& organ, const OrganTie& node) {
  return std::binary_search(
      organ.ties.begin(), organ.ties.end(), node,
      [](const OrganTie& a, const OrganTie& b) { return order_of(a) < order_of(b); });
}

// Each node is tied at most once, to a node that is not tied itself, at the same place in space.
bool check_ties(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.ties.size(); ++i) {
    const OrganTie& t = organ.ties[i];
    const OrganTie to = {t.x, t.to_y, t.z, 0};
    if (!check.require(i == 0 || order_of(t) > order_of(organ.ties[i - 1]),
                       Status::kOrganOrderWrong, "sheets.ties", i, t.x,
                       "ties sorted by z, y, x, one for a node") ||
        !check.require(t.z <= organ.size_z && t.y <= organ.size_y && t.to_y < t.y &&
                           (t.y - t.to_y) % organ.sheet_rows == 0,
                       Status::kOrganIndexOutOfRange, "sheets.ties", i, t.to_y,
                       "the same place of an earlier sheet") ||
        !check.require(has_node(organ, t.x, t.y, t.z) && has_node(organ, t.x, t.to_y, t.z),
                       Status::kOrganIndexOutOfRange, "sheets.ties", i, t.x,
                       "nodes of the lattice") ||
        !check.require(!is_tied(organ, to), Status::kOrganOrderWrong, "sheets.ties", i, t.to_y,
                       "a node that is not tied itself")) {
      return false;
    }
  }
  return true;
}

bool check_parts(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.parts.size(); ++i) {
    const OrganPart& p = organ.parts[i];
    if (!check.require(i == 0 || order_of(p) > order_of(organ.parts[i - 1]),
                       Status::kOrganOrderWrong, "sheets.parts", i, p.x,
                       "parts sorted by z, y, x, one for a voxel") ||
        !check.require(has_voxel(organ, {p.x, p.x + 1U}, p.y, p.z), Status::kOrganIndexOutOfRange,
                       "sheets.parts", i, p.x, "a voxel of the lattice")) {
      return false;
    }
  }
  return true;
}

bool check_sheets(Checker& check, const Organ& organ, std::uint32_t version) {
  if (static_cast<const format::Organ*>(organ.root)->sheets() == nullptr) return true;
  if (!check.require(version >= 2, Status::kOrganVersionUnknown, "sheets", 0, version,
                     "format version 2 where there are sheets") ||
      !check.require(organ.sheet_rows >= 2 && organ.size_y > organ.sheet_rows &&
                         organ.size_y % organ.sheet_rows == 0 &&
                         organ.size_y / organ.sheet_rows <= kMaxSheets,
                     Status::kOrganValueOutOfRange, "sheets.rows", 0, organ.sheet_rows,
                     "2 or more, and size_y 2 to 8 times as many")) {
    return false;
  }
  for (std::size_t i = 0; i < organ.runs.size(); ++i) {
    if (!check.require(organ.runs[i].y % organ.sheet_rows != organ.sheet_rows - 1,
                       Status::kOrganOrderWrong, "runs", i, organ.runs[i].y,
                       "the last row of each sheet empty")) {
      return false;
    }
  }
  return check_ties(check, organ) && check_parts(check, organ);
}

bool check_membrane_lists(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.membrane_points.size(); ++i) {
    const OrganPoint& p = organ.membrane_points[i];
    for (const float place_m : {p.x, p.y, p.z}) {
      if (!check.in_range(place_m, -kMaxPointM, kMaxPointM, "membranes.points", i, "within 8 m")) {
        return false;
      }
    }
  }
  for (std::size_t i = 0; i < organ.membrane_triangles.size(); ++i) {
    const OrganTriangle& t = organ.membrane_triangles[i];
    for (const std::uint32_t corner : {t.a, t.b, t.c}) {
      if (!check.require(corner < organ.membrane_points.size(), Status::kOrganIndexOutOfRange,
                         "membranes.triangles", i, corner, "three indices into points")) {
        return false;
      }
    }
  }
  return true;
}

bool is_cell(const Organ& organ, const OrganMembraneCell& c) {
  return c.z < organ.size_z && !is_between_levels(organ, c.z) &&
         is_in_space(organ, c.x + 1U, c.y + 1U, c.z);
}

// A membrane is looked for in the cells of level 0; finer ones have only its area.
bool has_its_triangles(const Organ& organ, const OrganMembraneCell& c) {
  if (level_of(organ.level_planes, c.z) > 0) return c.count == 0;
  return c.count > 0 && std::uint64_t{c.first} + c.count <= organ.membrane_triangles.size();
}

// Cells are in space, sorted, one for each membrane in them, with few enough triangles for a tick.
bool check_membrane_cells(Checker& check, const Organ& organ) {
  std::uint64_t last_place = 0, triangles = 0;
  for (std::size_t i = 0; i < organ.membrane_cells.size(); ++i) {
    const OrganMembraneCell& c = organ.membrane_cells[i];
    const std::uint64_t place = order_of(c);
    const bool same = i > 0 && place == last_place;
    triangles = (same ? triangles : 0) + c.count;
    if (!check.require(is_cell(organ, c), Status::kOrganIndexOutOfRange, "membranes.cells", i, c.x,
                       "a cell of the lattice") ||
        !check.require(i == 0 || place > last_place ||
                           (same && c.material > organ.membrane_cells[i - 1].material),
                       Status::kOrganOrderWrong, "membranes.cells", i, c.x,
                       "cells sorted by z, y, x, material") ||
        !check.require(c.material < organ.material_count, Status::kOrganIndexOutOfRange,
                       "membranes.cells.material", i, c.material, "an index into materials") ||
        !check.require(has_its_triangles(organ, c), Status::kOrganIndexOutOfRange,
                       "membranes.cells.first", i, c.first,
                       "triangles of the list, at least 1; none at a finer level") ||
        !check.require(triangles <= kMaxTrianglesPerCell, Status::kOrganValueOutOfRange,
                       "membranes.cells.count", i, static_cast<double>(triangles),
                       "at most 256 triangles in a cell") ||
        !check.in_range(c.area, 0, kMaxTrianglesPerCell, "membranes.cells.area", i, "0 to 256")) {
      return false;
    }
    last_place = place;
  }
  return true;
}

bool check_membranes(Checker& check, const Organ& organ, std::uint32_t version) {
  if (static_cast<const format::Organ*>(organ.root)->membranes() == nullptr) return true;
  return check.require(version >= 3, Status::kOrganVersionUnknown, "membranes", 0, version,
                       "format version 3 where there are membranes") &&
         check.require(organ.membrane_points.size() <= kMaxMembranePoints &&
                           organ.membrane_triangles.size() <= kMaxMembraneTriangles,
                       Status::kOrganValueOutOfRange, "membranes.points", 0,
                       static_cast<double>(organ.membrane_points.size()),
                       "at most 8000000 points, 16000000 triangles") &&
         check_membrane_lists(check, organ) && check_membrane_cells(check, organ);
}

bool check_lattice_header(Checker& check, const Organ& organ) {
  return check.require(organ.content_sha256.empty() || organ.content_sha256.size() == 32,
                       Status::kOrganSizesDisagree, "content_sha256", 0,
                       static_cast<double>(organ.content_sha256.size()), "32 bytes, or none") &&
         check.in_range(organ.voxel_edge_m, kMinVoxelEdgeM, kMaxVoxelEdgeM, "voxel_edge_m", 0,
                        "0.0001 to 0.1") &&
         check.in_range(organ.origin_m.x, -kMaxOriginM, kMaxOriginM, "origin_x_m", 0,
                        "within 4 m") &&
         check.in_range(organ.origin_m.y, -kMaxOriginM, kMaxOriginM, "origin_y_m", 0,
                        "within 4 m") &&
         check.in_range(organ.origin_m.z, -kMaxOriginM, kMaxOriginM, "origin_z_m", 0,
                        "within 4 m") &&
         check.require(static_cast<std::uint64_t>(organ.size_y) * organ.size_z <= kMaxRows,
                       Status::kOrganValueOutOfRange, "size_y", 0,
                       static_cast<double>(organ.size_y) * organ.size_z,
                       "at most 16000000 rows (size_y times size_z)") &&
         check.require(organ.voxel_count > 0 && organ.voxel_count <= kMaxVoxels,
                       Status::kOrganValueOutOfRange, "voxel_material", 0, organ.voxel_count,
                       "1 to 4000000 voxels") &&
         check.require(organ.material_count > 0 && organ.material_count <= kMaxMaterials,
                       Status::kOrganValueOutOfRange, "materials", 0, organ.material_count,
                       "1 to 64 materials") &&
         check.require(
             organ.vertices.size() <= kMaxVertices && organ.triangles.size() <= kMaxTriangles,
             Status::kOrganValueOutOfRange, "vertices", 0,
             static_cast<double>(organ.vertices.size()),
             "at most 8000000 vertices, 16000000 triangles");
}

Organ read(const format::Organ& root, std::span<const std::byte> bytes) {
  Organ organ;
  organ.root = &root;
  organ.name = root.name() != nullptr ? root.name()->c_str() : "";
  organ.hash = fnv1a(bytes);
  organ.voxel_edge_m = root.voxel_edge_m();
  organ.origin_m = {root.origin_x_m(), root.origin_y_m(), root.origin_z_m()};
  organ.size_x = root.size_x();
  organ.size_y = root.size_y();
  organ.size_z = root.size_z();
  organ.voxel_count = root.voxel_material()->size();
  organ.material_count = root.materials()->size();
  organ.runs = view<OrganRun>(root.runs());
  organ.voxel_material = view(root.voxel_material());
  organ.voxel_fill = view(root.voxel_fill());
  organ.voxel_fixed = view(root.voxel_fixed());
  organ.mixed = view<OrganMixed>(root.mixed());
  organ.skins = view<OrganSkin>(root.skins());
  organ.content_sha256 = view(root.content_sha256());
  organ.format_version = root.format_version();
  organ.vertices = view<OrganVertex>(root.vertices());
  organ.triangles = view<OrganTriangle>(root.triangles());
  organ.spheres = view<OrganSphere>(root.sphere_nodes());
  organ.sheet_rows = organ.size_y;
  if (const format::Sheets* sheets = root.sheets()) {
    organ.sheet_rows = sheets->rows();
    organ.ties = view<OrganTie>(sheets->ties());
    organ.parts = view<OrganPart>(sheets->parts());
  }
  if (const format::Membranes* membranes = root.membranes()) {
    organ.membrane_points = view<OrganPoint>(membranes->points());
    organ.membrane_triangles = view<OrganTriangle>(membranes->triangles());
    organ.membrane_cells = view<OrganMembraneCell>(membranes->cells());
  }
  organ.level_planes = organ.size_z;
  if (const format::Levels* levels = root.levels()) {
    organ.levels = levels->count();
    organ.level_planes = levels->planes();
    organ.hanging = view<OrganHanging>(levels->hanging());
  }
  if (const format::Slides* slides = root.slides()) {
    organ.slide_points = view<OrganSlidePoint>(slides->points());
    organ.slide_grounds = view<OrganSlideGround>(slides->grounds());
    organ.slide_bodies = view(slides->bodies());
  }
  return organ;
}

}  // namespace

Status organ_open(std::span<const std::byte> bytes, Organ& organ_out, OrganRefusal* refusal_out) {
  Checker check;
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  Organ organ;
  if (check.require(reinterpret_cast<std::uintptr_t>(data) % 8 == 0, Status::kMemoryNotAligned,
                    "file", 0, 0, "bytes that start at a multiple of 8") &&
      check.require(bytes.size() >= 16, Status::kOrganTooSmall, "file", 0,
                    static_cast<double>(bytes.size()), "at least 16 bytes") &&
      check.require(format::OrganBufferHasIdentifier(data), Status::kOrganNotAnOrganFile,
                    "identifier", 4, 0, "the letters STLO at byte 4")) {
    flatbuffers::Verifier verifier(data, bytes.size(), 16, 1U << 20U);
    if (check.require(format::VerifyOrganBuffer(verifier), Status::kOrganStructureDamaged, "file",
                      0, static_cast<double>(bytes.size()), "offsets and sizes inside the file")) {
      const format::Organ& root = *format::GetOrgan(data);
      const std::uint32_t version = root.format_version();
      if (check.require(version >= 1 && version <= kNewestFormat, Status::kOrganVersionUnknown,
                        "format_version", 0, version, "version 1 to 6")) {
        organ = read(root, bytes);
        (void)(check_lattice_header(check, organ) && check_runs(check, organ) &&
               check_sheets(check, organ, version) &&
               (root.levels() == nullptr || check_levels(check, organ)) &&
               check_materials(check, organ) && check_voxels(check, organ) &&
               check_mixed(check, organ, version) && check_skins(check, organ, version) &&
               check_surface(check, organ) && check_spheres(check, organ) &&
               check_membranes(check, organ, version) &&
               (root.slides() == nullptr || check_slides(check, organ)));
      }
    }
  }
  if (refusal_out != nullptr) *refusal_out = check.refusal;
  if (check.refusal.status == Status::kOk) organ_out = organ;
  return check.refusal.status;
}

#define STYLET_STORED(field, ...) m.field(),
Material organ_material(const Organ& organ, std::uint32_t index) {
  const auto& root = *static_cast<const format::Organ*>(organ.root);
  const format::Material& m = *root.materials()->Get(index);
  return {m.name()->c_str(), m.source() != nullptr ? m.source()->c_str() : "",
          STYLET_MATERIAL_NUMBERS(STYLET_STORED)};
}
#undef STYLET_STORED

}  // namespace stylet
