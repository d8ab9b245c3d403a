// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/membranes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/most_off.h"
#include "base/refusal.h"
#include "meshes/distance.h"
#include "meshes/read_mesh.h"
#include "meshes/simplify.h"
#include "stylet/levels.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

// x=MM, y=MM or z=MM.
bool is_plane(const std::string& from) {
  return from.size() >= 2 && from[0] >= 'x' && from[0] <= 'z' && from[1] == '=';
}

double plane_m(const std::string& text, const std::string& from) {
  double mm = 0;
  const char* const end = from.data() + from.size();
  const auto [read, error] = std::from_chars(from.data() + 2, end, mm);
  if (error != std::errc{} || read != end || !std::isfinite(mm)) {
    refuse("--membrane '{}': expected MESH:TISSUE, or x=MM:TISSUE, also with y and z", text);
  }
  return mm * 1e-3;
}

// A rectangle through all of the lattice.
Mesh plane_through(std::size_t axis, double at_m, const CellGrid& grid) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto extent = [&](std::size_t a) { return grid.edge_m * grid.size[a]; };
  Mesh mesh;
  for (const auto& [along_u, along_v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    std::array<double, 3> p{};
    p[axis] = at_m;
    p[u] = grid.origin_m[u] + along_u * extent(u);
    p[v] = grid.origin_m[v] + along_v * extent(v);
    mesh.points.push_back({p[0], p[1], p[2]});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A triangle that is there twice, turned over or not, would count twice in the lattice's tension.
Mesh without_repeats(const Mesh& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> number;
  std::set<Triangle> seen;
  Mesh out;
  for (const Triangle& t : mesh.triangles) {
    Triangle here{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec p = mesh.points[t[i]];
      const auto next = static_cast<std::uint32_t>(out.points.size());
      const auto [place, is_new] = number.try_emplace({p.x, p.y, p.z}, next);
      if (is_new) out.points.push_back(p);
      here[i] = place->second;
    }
    Triangle sorted = here;
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(sorted).second) out.triangles.push_back(here);
  }
  return out;
}

// Most middles of triangles in a cell: quick, and about as many as the cell's list would have.
double crowding(const Mesh& mesh, const CellGrid& grid) {
  std::map<std::array<double, 3>, std::size_t> middles;
  std::size_t most = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec sum = mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]];
    const Vec at = (sum * (1.0 / 3) - grid.origin_m) * (1 / grid.edge_m);
    most = std::max(most, ++middles[{std::floor(at.x), std::floor(at.y), std::floor(at.z)}]);
  }
  return static_cast<double>(most);
}

// A surface with so many triangles in a cell that a tick could not test them all gets fewer. The
// user is told if it moves by that.
Mesh simple_enough(const Membrane& membrane, Mesh mesh, std::uint16_t material,
                   const CellGrid& grid, std::vector<std::string>& warnings) {
  constexpr int kMostTries = 8;
  constexpr double kMostMovedM = 1e-4;
  // Other membranes may lie in the same cell.
  constexpr double kWanted = kMaxTrianglesPerCell / 2.0;
  const Mesh whole = mesh;
  const double crowd = crowding(mesh, grid);
  if (crowd > kWanted) {
    mesh = with_fewer_triangles(
        mesh, static_cast<std::size_t>(0.7 * kWanted / crowd *
                                       static_cast<double>(mesh.triangles.size())));
  }
  for (int i = 0; i < kMostTries; ++i) {
    const auto most = static_cast<double>(most_in_a_cell(list_membranes({{mesh, material}}, grid)));
    if (most <= kWanted) break;
    mesh = with_fewer_triangles(
        mesh, static_cast<std::size_t>(0.9 * kWanted / most *
                                       static_cast<double>(mesh.triangles.size())));
  }
  if (mesh.triangles.size() == whole.triangles.size()) return mesh;
  const double moved_m = mesh.triangles.empty() ? 0 : deviation(whole, mesh).most_m;
  if (mesh.triangles.empty() || moved_m > kMostMovedM) {
    warnings.push_back(fmt::format(
        "membrane {} ({}): {} triangles are too many for voxels of {:.3g} mm; with {} it lies up "
        "to {:.2g} mm beside where it was: expected finer voxels, or a smoother surface",
        membrane.tissue, membrane.from, whole.triangles.size(), grid.edge_m * 1e3,
        mesh.triangles.size(), moved_m * 1e3));
  }
  return mesh;
}

void warn_of_unlikely(const Membrane& membrane, const Mesh& mesh, const Tissue& tissue,
                      std::vector<std::string>& warnings) {
  constexpr double kSmallestM = 1e-3;
  const double side_m = longest_side(bounds(mesh));
  if (side_m < kSmallestM) {
    warnings.push_back(fmt::format(
        "membrane {} ({}): its longest side is {:.2g} mm: expected a millimetre or more; check "
        "--units and --scale",
        membrane.tissue, membrane.from, side_m * 1e3));
  }
  const bool tears = tissue.fracture_toughness_j_per_m2 > 0;
  if (tears || tissue.puncture_force_n > tissue.cutting_force_n) return;
  warnings.push_back(fmt::format(
      "membrane {}: its puncture force of {:.3g} N is not above its cutting force of {:.3g} N: "
      "expected more, or it holds no needle",
      membrane.tissue, tissue.puncture_force_n, tissue.cutting_force_n));
}

// Calls visit(cell) for the cells of a level that have a voxel and some of the surfaces' area.
template <typename Visit>
void each_in_tissue(const std::vector<MembraneSurface>& surfaces, const Lattice& level,
                    Visit visit) {
  const Grid& grid = level.grid;
  for (const OrganMembraneCell& c : list_membranes(surfaces, cells_of(grid)).cells) {
    const bool is_voxel = level.voxel_of_cell[cell_index(grid, c.x, c.y, c.z)] != kNoVoxel;
    if (is_voxel && c.area > 0) visit(c);
  }
}

// Only the part that lies in tissue is met.
void warn_of_outside(const Membrane& membrane, const MembraneSurface& surface,
                     std::span<const Lattice> levels, std::vector<std::string>& warnings) {
  double inside_m2 = 0;
  for (const Lattice& level : levels) {
    const double edge_m = level.grid.edge_m;
    each_in_tissue({surface}, level, [&](const OrganMembraneCell& c) {
      inside_m2 += static_cast<double>(c.area) * edge_m * edge_m;
    });
  }
  const Mesh& mesh = surface.mesh_m;
  const double part = inside_m2 / area_m2(mesh);
  if (!(part > 0)) {
    refuse(
        "--membrane {}:{}: no part of it lies in the organ: expected a surface in its frame; "
        "check --units and --scale",
        membrane.from, membrane.tissue);
  }
  if (part >= 1 - kMostOff || membrane.is_plane) return;
  warnings.push_back(fmt::format(
      "membrane {} ({}): {:.0f} % of its {:.3g} cm2 lie outside all tissue, where no needle meets "
      "them",
      membrane.tissue, membrane.from, 100 * (1 - part), area_m2(mesh) * 1e4));
}

// What finer voxels carry. The tip looks for membranes in the coarsest cells.
void add_finer_areas(const std::vector<MembraneSurface>& surfaces, std::span<const Lattice> levels,
                     MembraneLists& lists) {
  for (std::uint32_t i = 1; i < levels.size(); ++i) {
    const std::uint32_t first = first_plane(levels.front().grid.size[2], i);
    each_in_tissue(surfaces, levels[i], [&](OrganMembraneCell cell) {
      cell.z = static_cast<std::uint16_t>(first + cell.z);
      cell.first = cell.count = 0;
      lists.cells.push_back(cell);
    });
  }
}

}  // namespace

CellGrid cells_of(const Grid& grid) {
  return {grid.origin_m, grid.edge_m, {grid.size[0], grid.size[1], grid.size[2]}};
}

std::vector<Membrane> parse_membranes(const std::vector<std::string>& texts,
                                      const MeshUnits& units) {
  std::vector<Membrane> membranes;
  for (const std::string& text : texts) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
      refuse("--membrane '{}': expected MESH:TISSUE, or x=MM:TISSUE, also with y and z", text);
    }
    Membrane membrane;
    membrane.from = text.substr(0, colon);
    membrane.tissue = text.substr(colon + 1);
    membrane.is_plane = is_plane(membrane.from);
    if (membrane.is_plane) {
      membrane.axis = static_cast<std::size_t>(membrane.from[0] - 'x');
      membrane.at_m = plane_m(text, membrane.from);
    } else {
      ReadMesh read = read_mesh(membrane.from);
      membrane.metres_per_unit = take_metres(read, membrane.from, units);
      membrane.mesh_m = std::move(read.mesh);
      membrane.sha256 = read.sha256;
      membrane.notes = std::move(read.notes);
      scale_to_metres(membrane.mesh_m, membrane.from, membrane.metres_per_unit);
      constexpr double kFarthestM = 8;  // as the organ format has it
      const Box box = bounds(membrane.mesh_m);
      for (const Vec& p : {box.low, box.high}) {
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthestM) continue;
        refuse("--membrane '{}': it reaches farther than {} m: check --units and --scale", text,
               kFarthestM);
      }
      membrane.from = std::filesystem::path(membrane.from).filename().string();
      if (!(area_m2(membrane.mesh_m) > 0)) {
        refuse("--membrane '{}': {} triangles without area: expected a surface", text,
               membrane.mesh_m.triangles.size());
      }
    }
    membranes.push_back(std::move(membrane));
  }
  return membranes;
}

std::vector<SourceRecord> membrane_records(const std::vector<Membrane>& membranes) {
  std::vector<SourceRecord> records;
  for (const Membrane& m : membranes) {
    if (m.sha256.empty()) continue;
    records.push_back({m.from, m.tissue, m.sha256, m.metres_per_unit, 0,
                       static_cast<std::uint32_t>(m.mesh_m.triangles.size())});
  }
  return records;
}

MembraneLists place_membranes(const std::vector<Membrane>& membranes,
                              std::span<const Lattice> levels, MaterialList& materials,
                              std::vector<std::string>& warnings) {
  const CellGrid grid = cells_of(levels.front().grid);
  std::vector<MembraneSurface> surfaces;
  for (const Membrane& membrane : membranes) {
    const Tissue& tissue = find_tissue(materials.own, membrane.tissue);
    const std::uint16_t material = number_of(materials, tissue);
    Mesh mesh = membrane.is_plane ? plane_through(membrane.axis, membrane.at_m, grid)
                                  : without_repeats(membrane.mesh_m);
    warn_of_unlikely(membrane, mesh, tissue, warnings);
    mesh = simple_enough(membrane, std::move(mesh), material, grid, warnings);
    surfaces.push_back({std::move(mesh), material});
    warn_of_outside(membrane, surfaces.back(), levels, warnings);
  }
  MembraneLists lists = list_membranes(surfaces, grid);
  const std::size_t most = most_in_a_cell(lists);
  if (most > kMaxTrianglesPerCell) {
    refuse(
        "--membrane: {} triangles in one voxel of {:.3g} mm: expected at most {}: finer voxels, "
        "or smoother surfaces",
        most, grid.edge_m * 1e3, kMaxTrianglesPerCell);
  }
  add_finer_areas(surfaces, levels, lists);
  return lists;
}

}  // namespace stylet::offline
