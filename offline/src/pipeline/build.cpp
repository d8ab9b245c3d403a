// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/build.h"

#include <bit>
#include <filesystem>

#include "base/most_off.h"
#include "base/refusal.h"
#include "pipeline/given.h"
#include "pipeline/membranes.h"
#include "pipeline/pieces.h"
#include "pipeline/refine.h"
#include "pipeline/skins.h"
#include "pipeline/slides.h"
#include "pipeline/voxel_materials.h"
#include "pipeline/wrapping.h"
#include "stylet/limits.h"
#include "voxels/crop.h"
#include "voxels/gaps.h"
#include "voxels/hanging.h"
#include "voxels/losses.h"
#include "voxels/mixed.h"
#include "voxels/sample_cell.h"
#include "voxels/sheets.h"
#include "voxels/sweep.h"

namespace stylet::offline {
namespace {

constexpr double kSmallestPlausibleM = 5e-3;
constexpr double kLargestPlausibleM = 2.0;

// The limits are floats; an edge that rounds to a limit is allowed.
bool allowed_voxel_edge(double edge_m) {
  const auto rounded = static_cast<float>(edge_m);
  return rounded >= kMinVoxelEdgeM && rounded <= kMaxVoxelEdgeM;
}

// Scales all meshes to metres and repairs them.
std::vector<Solid> make_solids(std::vector<Input>& inputs, Box& box_out, const Progress& progress) {
  for (Input& i : inputs) scale_to_metres(i.read.mesh, i.path, i.metres_per_unit);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    progress("repairing", static_cast<double>(i) / static_cast<double>(inputs.size()));
    solids.push_back(repair(std::move(inputs[i].read.mesh)));
    if (solids.back().surface.triangles.empty()) {
      refuse("{}: all {} triangles are degenerate: expected a surface", inputs[i].path,
             solids.back().counts.triangles_read);
    }
    for (const Vec& p : solids.back().surface.points) grow(box_out, p);
  }
  return solids;
}

// Replaces each input by a skin around it, and tells what that changed.
void wrap_all(std::vector<Solid>& solids, const std::vector<Content>& contents,
              const std::vector<Input>& inputs, double edge_m, Box& box_out,
              std::vector<std::string>& warnings, const Progress& progress) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    progress("wrapping", static_cast<double>(i) / static_cast<double>(solids.size()));
    Wrapped wrapped = wrap(solids[i], contents[i], edge_m, inputs[i].path);
    solids[i] = std::move(wrapped.solid);
    std::ranges::move(wrapped.warnings, std::back_inserter(warnings));
    for (const Vec& p : solids[i].surface.points) grow(box_out, p);
  }
}

InputReport report_of(const Input& input, const Solid& solid, const Occupancy& occupancy,
                      const Grid& grid) {
  InputReport report{input.path,
                     input.tissue,
                     input.read.counts,
                     solid.counts,
                     solid.closed,
                     solid.oriented,
                     0,
                     0,
                     occupancy.decided_by_winding};
  const Box box = bounds(solid.surface);
  report.mesh_volume_m3 =
      signed_volume(solid.surface.points, solid.boundary, (box.low + box.high) * 0.5);
  std::size_t samples = 0;
  for (const std::uint64_t bits : occupancy.inside) {
    samples += static_cast<std::size_t>(std::popcount(bits));
  }
  const double edge = grid.edge_m;
  report.filled_volume_m3 = static_cast<double>(samples) / 64 * edge * edge * edge;
  return report;
}

// Adds those of a level's voxels.
void add_fixed_corners(const Lattice& lattice, const Claimed& claimed, std::uint32_t level,
                       const std::vector<Region>& held_regions, std::vector<std::uint8_t>& fixed) {
  const Grid& grid = lattice.grid;
  std::vector<std::uint8_t> held = held_corners(grid, claimed.box, held_regions);
  hold_cut(claimed.levels[level], inherited(claimed.cut, grid, level), held);
  for (const std::uint32_t cell : lattice.cell_of_voxel) {
    const std::uint32_t x = cell % grid.size[0], row = cell / grid.size[0];
    const std::uint32_t y = row % grid.size[1], z = row / grid.size[1];
    std::uint32_t bits = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const std::size_t at =
          corner_index(grid, x + (corner & 1U), y + (corner >> 1U & 1U), z + (corner >> 2U));
      bits |= static_cast<std::uint32_t>(held[at]) << corner;
    }
    fixed.push_back(static_cast<std::uint8_t>(bits));
  }
}

std::vector<std::uint8_t> fixed_corners(const std::vector<Lattice>& lattices,
                                        const Claimed& claimed,
                                        const std::vector<Region>& held_regions) {
  if (held_regions.empty() && claimed.cut.empty()) return {};
  std::vector<std::uint8_t> fixed;
  for (std::uint32_t level = 0; level < lattices.size(); ++level) {
    add_fixed_corners(lattices[level], claimed, level, held_regions, fixed);
  }
  if (std::ranges::count(fixed, 0) == std::ssize(fixed))
    refuse(
        "--fix: no corner of the organ lies in these regions: expected at least one corner, or "
        "--fix none");
  return fixed;
}

Mesh join(const std::vector<Solid>& solids) {
  Mesh all;
  for (const Solid& solid : solids) {
    add_mesh(all, solid.surface);
    if (all.points.size() > kMaxVertices || all.triangles.size() > kMaxTriangles) {
      refuse("{} surface points and {} triangles: expected at most {} and {}", all.points.size(),
             all.triangles.size(), kMaxVertices, kMaxTriangles);
    }
  }
  return all;
}

std::vector<Mesh> surfaces_of(std::vector<Solid> solids) {
  std::vector<Mesh> surfaces;
  for (Solid& solid : solids) surfaces.push_back(std::move(solid.surface));
  return surfaces;
}

void embed_surface(const Mesh& mesh, const std::vector<Lattice>& lattices, OrganParts& parts) {
  Surface surface = embed(lattices, mesh.points, mesh.triangles);
  SphereTree tree = sphere_tree(surface.rest_m, mesh.triangles, surface.voxel_of);
  for (const std::uint32_t i : tree.order) parts.triangles.push_back(mesh.triangles[i]);
  parts.vertices = std::move(surface.vertices);
  parts.spheres = std::move(tree.nodes);
}

std::vector<SourceRecord> source_records(const std::vector<Input>& inputs,
                                         const BuildReport& report) {
  std::vector<SourceRecord> records;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    records.push_back({std::filesystem::path(inputs[i].path).filename().string(), inputs[i].tissue,
                       inputs[i].read.sha256, inputs[i].metres_per_unit, inputs[i].priority,
                       static_cast<std::uint32_t>(report.inputs[i].repair.triangles_read)});
  }
  return records;
}

Claims claim_voxels(const Grid& grid, const std::vector<Input>& inputs,
                    const std::vector<Solid>& solids, BuildReport& report,
                    const Progress& progress) {
  Claims claims = no_claims(grid);
  std::vector<int> priorities;
  for (const Input& input : inputs) priorities.push_back(input.priority);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Occupancy occupancy = voxelize(grid, solids[i], progress);
    report.inputs.push_back(report_of(inputs[i], solids[i], occupancy, grid));
    add_claim(claims, occupancy, static_cast<std::uint16_t>(i), priorities);
  }
  return claims;
}

// The claims of each level; the report is that of the finest one.
std::vector<Claims> claim_levels(const Grid& coarsest, std::uint32_t halvings,
                                 const std::vector<Input>& inputs, const std::vector<Solid>& solids,
                                 BuildReport& report, const Progress& progress) {
  std::vector<Claims> levels;
  for (const Grid& grid : level_grids(coarsest, halvings)) {
    report.inputs.clear();
    levels.push_back(claim_voxels(grid, inputs, solids, report, progress));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (report.inputs[i].filled_volume_m3 > 0) continue;
    refuse(
        "{}: longest side {:.4g} mm, encloses no volume at a voxel edge of {:.6g} mm: expected a "
        "surface with an inside, a finer voxel edge, other --units, or --wrap",
        inputs[i].path, longest_side(bounds(solids[i].surface)) * 1e3,
        levels.back().grid.edge_m * 1e3);
  }
  return levels;
}

// What a tick sweeps at an edge. If the edge was refused, a value that leads the search on: an edge
// too fine for the format counts as eight times the allowed number, one refused for another reason
// as an eighth of it, because a finer edge may be accepted.
struct TriedEdge {
  double swept = 0;
  std::optional<Refusal> refusal;
};

TriedEdge try_edge(double edge_m, double most, const SweptAtEdge& swept_at) {
  try {
    return {std::max(1.0, swept_at(edge_m)), {}};
  } catch (const TooFine&) {
    return {8 * most, {}};
  } catch (const Refusal& refusal) {
    return {most / 8, refusal};
  }
}

// The finest edge, in steps of 0.05 mm, at which a tick sweeps at most `most` voxels; the next
// finer step has been tried. Swept voxels grow about with the inverse cube of the edge.
double finest_edge(const Box& box, double most, const SweptAtEdge& swept_at) {
  constexpr double kStepM = 5e-5;
  constexpr double kLeastSteps = 2, kMostSteps = 2000;
  constexpr int kMostRefusals = 3;                      // in a row, each at half the edge
  double good = kMostSteps + 1, bad = kLeastSteps - 1;  // in steps; at first just outside limits
  double next = std::ceil(longest_side(box) / std::cbrt(most) / kStepM);
  TriedEdge coarse;  // the result at `good`
  for (int refusals = 0; good - bad > 1 && refusals < kMostRefusals;) {
    next = std::clamp(next, bad + 1, good - 1);
    const TriedEdge tried = try_edge(next * kStepM, most, swept_at);
    refusals = tried.refusal ? refusals + 1 : 0;
    (tried.swept <= most ? good : bad) = next;
    if (tried.swept <= most) coarse = tried;
    next = std::round(next * std::cbrt(tried.swept / most));
  }
  if (coarse.refusal) throw Refusal(*coarse.refusal);
  if (good > kMostSteps)
    refuse("--fit: even with a voxel edge of 100 mm the organ needs more than {} voxels", most);
  return good * kStepM;
}

// Volume that a sample of each mesh represents, so that all together give the mesh's volume. If
// samples are far off that volume, or an open mesh has none, the user is told, and a sample
// represents a 64th of a cell.
std::vector<double> sample_volumes(const Grid& grid, BuildReport& report) {
  const double sample_m3 = grid.edge_m * grid.edge_m * grid.edge_m / 64;
  std::vector<double> volumes;
  for (const InputReport& input : report.inputs) {
    volumes.push_back(sample_m3);
    const double ratio = input.mesh_volume_m3 / input.filled_volume_m3;
    if (!input.closed) {
      report.warnings.push_back(fmt::format(
          "{}: its surface is open ({} edges belong to one triangle only); {:.3g} ml are taken as "
          "its inside: expected a closed surface; look at the result before use",
          input.path, input.repair.border_edges, input.filled_volume_m3 * 1e6));
      continue;
    }
    if (std::abs(ratio - 1) <= kMostOff) {
      volumes.back() *= ratio;
      continue;
    }
    report.warnings.push_back(fmt::format(
        "{}: its surface encloses {:.3g} ml, of which {:.3g} ml are sampled at a voxel edge of "
        "{:.3g} mm: expected finer voxels, or pieces that do not overlap",
        input.path, input.mesh_volume_m3 * 1e6, input.filled_volume_m3 * 1e6, grid.edge_m * 1e3));
  }
  return volumes;
}

SamplePlaces mesh_samples() {
  SamplePlaces places;
  for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = sample_point(i);
  return places;
}

void measure_shares(const Claims& claims, const std::vector<Solid>& solids, BuildReport& report) {
  const std::vector<double> given_m3 = given_volumes_m3(claims, solids.size());
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const InputReport& input = report.inputs[i];
    const PieceCount count = mesh_pieces(claims, static_cast<std::uint16_t>(i), solids[i].surface);
    report.shares.push_back({std::filesystem::path(input.path).filename().string(), input.tissue,
                             input.mesh_volume_m3, input.filled_volume_m3, given_m3[i],
                             count.pieces, count.lost});
  }
}

}  // namespace

std::vector<double> given_volumes_m3(const Claims& claims, std::size_t owner_count) {
  std::vector<double> samples(owner_count, 0);
  for (std::size_t cell = 0; cell < claims.owner.size(); ++cell) {
    if (is_kept(claims, cell)) samples[claims.owner[cell]] += claims.owner_fill[cell];
  }
  const double edge_m = claims.grid.edge_m;
  for (double& each : samples) each *= edge_m * edge_m * edge_m / 64;
  return samples;
}

void warn_of_size(const Box& box, std::vector<std::string>& warnings) {
  const double side = longest_side(box);
  if (side < kSmallestPlausibleM || side > kLargestPlausibleM) {
    warnings.push_back(fmt::format(
        "the longest side is {:.4g} mm: expected 5 mm to 2 m for an organ; check --units and "
        "--scale",
        side * 1e3));
  }
}

double choose_edge(const Box& box, const BuildOptions& options, const SweptAtEdge& swept_at) {
  if (options.most_voxels > 0) return finest_edge(box, options.most_voxels, swept_at);
  if (options.voxels_across == 0) return options.voxel_edge_m;
  const double edge_m = longest_side(box) / options.voxels_across;
  if (!allowed_voxel_edge(edge_m)) {
    refuse(
        "--voxels-across {}: voxel edge {:.6g} mm, as the longest side is {:.6g} mm: expected 0.1 "
        "to 100 mm; check --units and --scale",
        options.voxels_across, edge_m * 1e3, longest_side(box) * 1e3);
  }
  return edge_m;
}

void require_voxel_edge(double edge_m) {
  if (!allowed_voxel_edge(edge_m)) {
    refuse("voxel edge {:.6g} mm: expected 0.1 to 100 mm", edge_m * 1e3);
  }
}

Built build(std::vector<Input> inputs, const BuildOptions& options, const Progress& progress) {
  Built built;
  constexpr std::size_t kMostInputs = 1000;
  if (inputs.empty() || inputs.size() > kMostInputs) {
    refuse("{} inputs: expected 1 to {}", inputs.size(), kMostInputs);
  }
  std::vector<std::string>& warnings = built.report.warnings;
  for (const Input& i : inputs) std::ranges::copy(i.read.notes, std::back_inserter(warnings));
  Box box;
  std::vector<Solid> solids = make_solids(inputs, box, progress);
  std::vector<std::string> tissues;
  for (const Input& input : inputs) tissues.push_back(input.tissue);
  std::vector<Content> contents;
  if (options.wrap) std::ranges::transform(solids, std::back_inserter(contents), content_of);
  const std::uint32_t halvings = most_halvings(options.refinements);
  const double edge_m = choose_edge(box, options, [&](double each_m) {
    BuildReport unused;
    std::vector<Solid> tried = solids;
    Box tried_box = box;
    if (options.wrap) {
      wrap_all(tried, contents, inputs, each_m, tried_box, unused.warnings, progress);
    }
    const Grid grid = make_grid(tried_box, each_m);
    return swept_voxels({claim_levels(grid, halvings, inputs, tried, unused, progress),
                         mesh_samples(),
                         tissues,
                         tried_box,
                         join(tried),
                         {},
                         {},
                         {},
                         {}},
                        options, progress);
  });
  if (options.wrap) wrap_all(solids, contents, inputs, edge_m, box, warnings, progress);
  warn_of_size(box, warnings);
  const Grid grid = make_grid(box, edge_m);
  std::vector<Claims> levels = claim_levels(grid, halvings, inputs, solids, built.report, progress);
  const SamplePlaces places = mesh_samples();
  const Grid finest = levels.back().grid;
  if (options.measured) {
    measure_shares(levels.back(), solids, built.report);
    if (!options.split) built.report.closed_gaps = closed_gaps(levels.back(), places);
  }
  Claimed claimed = {std::move(levels), places, tissues, box, join(solids), {}, {}, {}, {}};
  if (!options.slides.empty()) claimed.surface_m = surfaces_of(std::move(solids));
  claimed.sample_m3 = sample_volumes(finest, built.report);
  cut_away(claimed, options);
  if (options.measured) built.input_m = claimed.mesh;
  claimed.sources = source_records(inputs, built.report);
  built.bytes = assemble(std::move(claimed), options, warnings, progress);
  return built;
}

void cut_away(Claimed& claimed, const BuildOptions& options) {
  const Grid& grid = claimed.levels.front().grid;
  claimed.cut = cut_cells(grid, claimed.box, options.crop);
  claimed.mesh = crop_surface(std::move(claimed.mesh), grid, claimed.cut);
}

namespace {

// Fills gaps and numbers voxels, level by level, and splits parts if that is asked for.
std::vector<Lattice> lattices_of(Claimed& claimed, const BuildOptions& options,
                                 std::vector<std::string>& warnings, const Progress& progress) {
  if (!options.gap_tissue.empty()) {
    progress("filling gaps", 0);
    const auto owner = static_cast<std::uint16_t>(claimed.tissues.size());
    std::size_t filled = 0;
    for (Claims& claims : claimed.levels) filled += fill_gaps(claims, options.gap_m, owner);
    if (filled > 0) claimed.tissues.push_back(options.gap_tissue);
  }
  progress("embedding surface", 0);
  std::vector<Lattice> lattices =
      make_lattices(claimed.levels, claimed.mesh.points, absent_cells(claimed, options, warnings));
  if (voxel_count(lattices) == 0) {
    refuse("--crop: no voxel lies in all of these regions: expected at least one");
  }
  if (!options.split && options.slides.empty()) return lattices;
  progress("splitting at gaps", 0);
  return split_parts(claimed.levels, claimed.places, std::move(lattices), claimed.cut,
                     {options.split, apart_owners(options.slides, claimed.tissues)});
}

// Moves the lattice into the parts of the organ file.
void take_lattices(std::vector<Lattice> lattices, OrganParts& parts) {
  const Lattice& coarsest = lattices.front();
  const LatticeSize size = lattice_size(lattices);
  parts.origin_m = coarsest.grid.origin_m;
  parts.edge_m = coarsest.grid.edge_m;
  parts.size_x = size.x;
  parts.size_z = size.z;
  parts.sheets = coarsest.sheets;
  parts.sheet_rows = size.rows;
  parts.levels = static_cast<std::uint32_t>(lattices.size());
  parts.level_planes = coarsest.grid.size[2];
  parts.hanging = hanging_nodes(lattices);
  parts.runs = runs_of(lattices);
  parts.ties = ties_of(lattices);
  parts.cell_parts = parts_of(lattices);
  for (const Lattice& each : lattices) {
    parts.voxel_fill.insert(parts.voxel_fill.end(), each.fill.begin(), each.fill.end());
  }
}

// Adds materials and mixed voxels of a level to the parts, and what its voxels hold to `held`.
void add_tissues(Claims& claims, const Lattice& lattice, const Claimed& claimed,
                 const BuildOptions& options, MaterialList& materials, OrganParts& parts,
                 std::vector<Held>& held) {
  const TissueNumbers numbers =
      number_tissues(claimed.tissues, options, lattice.grid.edge_m, materials);
  const std::vector<std::uint8_t> layers = cell_layers(claims, numbers);
  std::vector<std::uint16_t> owner_of_voxel = owners(claims, lattice);
  settle_owners(claims, lattice, apart_owners(options.slides, claimed.tissues), owner_of_voxel);
  const VoxelMaterials of_voxel = voxel_materials(claims, lattice, owner_of_voxel, claimed.tissues,
                                                  numbers, layers, options, materials);
  std::vector<OrganMixed> mixed = mixed_voxels(
      claims, claimed.places, lattice, {owner_of_voxel, of_voxel.material, layers}, numbers);
  add_held(held_volumes(lattice, mixed, of_voxel.given), held);
  const auto before = static_cast<std::uint32_t>(parts.voxel_material.size());
  for (OrganMixed& each : mixed) each.voxel += before;
  parts.mixed.insert(parts.mixed.end(), mixed.begin(), mixed.end());
  parts.voxel_material.insert(parts.voxel_material.end(), of_voxel.material.begin(),
                              of_voxel.material.end());
}

// What the readers said of the meshes that options name.
void warn_of_meshes(const BuildOptions& options, std::vector<std::string>& warnings) {
  const auto add = [&warnings](const auto& mesh) {
    std::ranges::copy(mesh.notes, std::back_inserter(warnings));
  };
  std::ranges::for_each(options.held, add);
  std::ranges::for_each(options.membranes, add);
}

}  // namespace

double swept_voxels(Claimed claimed, const BuildOptions& options, const Progress& progress) {
  cut_away(claimed, options);
  std::vector<std::string> unused;
  return swept_voxels(lattices_of(claimed, options, unused, progress));
}

std::vector<std::byte> assemble(Claimed claimed, const BuildOptions& options,
                                std::vector<std::string>& warnings, const Progress& progress) {
  warn_of_meshes(options, warnings);
  OrganParts parts;
  parts.name = options.name;
  const Given given = given_of(claimed, options);  // before gaps are filled
  std::vector<Lattice> lattices = lattices_of(claimed, options, warnings, progress);
  MaterialList materials{options.own_tissues, {}};
  warn_of_slopes(claimed,
                 number_tissues(claimed.tissues, options, lattices.front().grid.edge_m, materials),
                 warnings);
  std::vector<Held> held(kMaxMaterials);
  for (std::size_t level = 0; level < lattices.size(); ++level) {
    add_tissues(claimed.levels[level], lattices[level], claimed, options, materials, parts, held);
  }
  warn_of_losses(held, lattices, given, materials.tissues, warnings);
  parts.membranes = place_membranes(options.membranes, lattices, materials, warnings);
  parts.skins = place_skins(claimed.mesh, lattices, parts.voxel_material, materials.tissues);
  SlideLists slides = place_slides(options.slides, claimed, lattices, warnings);
  parts.slide_points = std::move(slides.points);
  parts.slide_grounds = std::move(slides.grounds);
  parts.slide_bodies = std::move(slides.bodies);
  parts.materials = std::move(materials.tissues);
  parts.voxel_fixed = fixed_corners(lattices, claimed, options.held);
  embed_surface(claimed.mesh, lattices, parts);
  take_lattices(std::move(lattices), parts);
  parts.tool_version = options.tool_version;
  parts.options = options.options_text;
  parts.sources = std::move(claimed.sources);
  std::ranges::move(membrane_records(options.membranes), std::back_inserter(parts.sources));
  progress("writing", 0);
  return write_organ(parts);
}

}  // namespace stylet::offline
