// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/quality.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/disjoint_set.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned kAllCorners = 255;  // a bit for each corner of a voxel

// Visits half of the 26 neighbours, so that every pair of neighbours is visited once.
template <typename Visit>
void each_earlier_neighbour(const Cell& at, Visit visit) {
  for (int n = 0; n < 13; ++n) {
    const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 - 1;
    visit(std::int64_t{at[0]} + dx, std::int64_t{at[1]} + dy, std::int64_t{at[2]} + dz);
  }
}

// Some voxel that has this node of the lattice.
std::uint32_t voxel_at_node(const VoxelGrid& grid, std::int64_t x, std::int64_t y, std::int64_t z) {
  for (int n = 0; n < 8; ++n) {
    const std::uint32_t voxel = voxel_at(grid, x - (n & 1), y - (n >> 1 & 1), z - (n >> 2));
    if (voxel != kEmptyCell) return voxel;
  }
  return kEmptyCell;
}

}  // namespace

namespace {

// Marks pieces that lie on a held one, or bear it, maybe by way of others. `number` is the piece of
// each voxel.
void mark_borne(const Organ& organ, const std::vector<std::uint32_t>& number,
                std::vector<LatticePiece>& pieces) {
  std::vector<std::uint32_t> parent = each_by_itself(pieces.size());
  for (const OrganSlidePoint& point : organ.slide_points) {
    join(parent, number[point.voxel], number[organ.slide_grounds[point.ground].voxel]);
  }
  std::vector<bool> any_held(pieces.size(), false);
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].held) any_held[root_of(parent, i)] = true;
  }
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    pieces[i].borne = !pieces[i].held && any_held[root_of(parent, i)];
  }
}

}  // namespace

// Pieces connected through shared nodes within a sheet, through ties between sheets, and through
// nodes that hang between levels.
std::vector<LatticePiece> lattice_pieces(const Organ& organ) {
  const std::vector<Cell> cells = lattice_cells_of(organ);
  const VoxelGrid grid = voxel_grid(cells);
  std::vector<std::uint32_t> parent = each_by_itself(cells.size());
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    each_earlier_neighbour(cells[voxel], [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      const std::uint32_t other = voxel_at(grid, x, y, z);
      if (other != kEmptyCell) join(parent, voxel, other);
    });
  }
  for (const OrganTie& tie : organ.ties) {
    const std::uint32_t one = voxel_at_node(grid, tie.x, tie.y, tie.z);
    const std::uint32_t other = voxel_at_node(grid, tie.x, tie.to_y, tie.z);
    if (one != kEmptyCell && other != kEmptyCell) join(parent, one, other);
  }
  for (const OrganHanging& h : organ.hanging) {
    join(parent, voxel_at_node(grid, h.x, h.y, h.z),
         voxel_at(grid, h.voxel_x, h.voxel_y, h.voxel_z));
  }
  const std::vector<Cell> in_space = cells_of(organ);
  std::vector<LatticePiece> pieces;
  std::vector<std::uint32_t> number(cells.size());
  for (std::uint32_t voxel = 0; voxel < cells.size(); ++voxel) {
    const std::uint32_t root = root_of(parent, voxel);
    if (root == voxel) {
      number[root] = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    number[voxel] = number[root];
    LatticePiece& piece = pieces[number[root]];
    ++piece.voxels;
    const double edge = cell_edge_m(organ) * in_space[voxel].size;
    piece.volume_m3 += organ.voxel_fill[voxel] / 255.0 * edge * edge * edge;
    const unsigned corners = organ.voxel_fixed.empty() ? 0U : organ.voxel_fixed[voxel];
    piece.held = piece.held || corners != 0;
    piece.moves = piece.moves || corners != kAllCorners;
  }
  mark_borne(organ, number, pieces);
  std::stable_sort(pieces.begin(), pieces.end(), [](const LatticePiece& a, const LatticePiece& b) {
    return a.voxels > b.voxels;
  });
  return pieces;
}

std::vector<std::string> held_findings(const std::vector<LatticePiece>& pieces) {
  const auto count = [&](auto is) { return std::count_if(pieces.begin(), pieces.end(), is); };
  const auto floating = count([](const LatticePiece& p) { return !p.held && !p.borne; });
  const auto rigid = count([](const LatticePiece& p) { return !p.moves; });
  std::vector<std::string> findings;
  if (floating > 0 && pieces.size() > 1) {
    findings.push_back(fmt::format("{} of {} separate pieces are not held in space and will drift",
                                   floating, pieces.size()));
  }
  if (rigid > 0) {
    findings.push_back(fmt::format(
        "{} of {} separate pieces are held at every corner of every voxel and cannot move", rigid,
        pieces.size()));
  }
  return findings;
}

namespace {

Json deviation_facts(const Deviation& d) {
  return {{"mean_mm", d.mean_m * 1e3},
          {"most_mm", d.most_m * 1e3},
          {"where_mm", {d.where_m.x * 1e3, d.where_m.y * 1e3, d.where_m.z * 1e3}},
          {"samples", d.samples}};
}

Json surface_facts(const Quality& q) {
  if (q.surface_to_input.samples == 0) return nullptr;
  return {{"hausdorff_mm", std::max(q.surface_to_input.most_m, q.input_to_surface.most_m) * 1e3},
          {"mean_mm", (q.surface_to_input.mean_m + q.input_to_surface.mean_m) / 2 * 1e3},
          {"organ_to_input", deviation_facts(q.surface_to_input)},
          {"input_to_organ", deviation_facts(q.input_to_surface)}};
}

Json share_facts(const std::vector<ShareReport>& shares) {
  Json list = Json::array();
  for (const ShareReport& each : shares) {
    list.push_back({{"tissue", each.tissue},
                    {"from", each.from},
                    {"input_ml", each.input_m3 * 1e6},
                    {"sampled_ml", each.sampled_m3 * 1e6},
                    {"given_ml", each.given_m3 * 1e6},
                    {"input_pieces", each.pieces},
                    {"pieces_without_voxel", each.pieces_lost}});
  }
  return list;
}

void add_share_findings(const ShareReport& s, std::vector<std::string>& findings) {
  if (s.input_m3 > 0 && std::fabs(s.sampled_m3 / s.input_m3 - 1) > 0.01) {
    findings.push_back(fmt::format("{}: the filled volume differs from the input by {:+.1f} %",
                                   s.from, (s.sampled_m3 / s.input_m3 - 1) * 100));
  }
  if (s.sampled_m3 > 0 && s.given_m3 < 0.9 * s.sampled_m3) {
    findings.push_back(
        fmt::format("{}: {:.0f} % of its volume lies in voxels that other tissues own: it is thin "
                    "for this voxel edge, or lies inside another organ",
                    s.from, (1 - s.given_m3 / s.sampled_m3) * 100));
  }
  if (s.pieces_lost > 0) {
    findings.push_back(fmt::format("{}: {} of {} pieces have no voxel of their own", s.from,
                                   s.pieces_lost, s.pieces));
  }
}

std::vector<std::string> findings_of(const Quality& quality, const BuildReport& report) {
  std::vector<std::string> findings = report.warnings;
  for (const InputReport& input : report.inputs) {
    if (!input.closed) {
      findings.push_back(fmt::format(
          "{}: the mesh is open; {} cells behind holes were filled by the winding number",
          input.path, input.decided_by_winding));
    }
  }
  for (const ShareReport& each : report.shares) add_share_findings(each, findings);
  const std::vector<std::string> held = held_findings(quality.pieces);
  findings.insert(findings.end(), held.begin(), held.end());
  if (report.closed_gaps > 0) {
    findings.push_back(fmt::format(
        "gaps of the input are closed at {} places, where one voxel or two neighbours hold parts "
        "that do not touch: the parts stick together there; a finer voxel edge opens the gaps",
        report.closed_gaps));
  }
  return findings;
}

}  // namespace

Quality measure_quality(const Organ& organ, const Mesh& input_m, const Progress& progress) {
  const std::vector<Cell> cells = cells_of(organ);
  const VoxelGrid grid = voxel_grid(cells);
  Quality quality;
  quality.pieces = lattice_pieces(organ);
  quality.thin_voxels = static_cast<std::size_t>(
      std::count(organ.voxel_fill.begin(), organ.voxel_fill.end(), std::uint8_t{1}));
  if (input_m.triangles.empty()) return quality;
  const Mesh surface = surface_mesh(organ, cells).mesh;
  progress("measuring the surface", 0);
  if (!surface.triangles.empty()) {
    quality.surface_to_input = deviation(surface, input_m);
    quality.input_to_surface = deviation(input_m, surface);
  }
  progress("measuring the voxels", 0);
  const Mesh faces = voxel_faces(organ, cells, grid, [](const Cell&) { return true; }).mesh;
  quality.faces_to_input = deviation(faces, input_m);
  return quality;
}

nlohmann::ordered_json quality_facts(const Quality& quality, const BuildReport& report) {
  constexpr std::size_t kMostPieces = 20;
  Json pieces = Json::array();
  for (std::size_t i = 0; i < std::min(kMostPieces, quality.pieces.size()); ++i) {
    const LatticePiece& piece = quality.pieces[i];
    pieces.push_back(
        {{"voxels", piece.voxels}, {"volume_ml", piece.volume_m3 * 1e6}, {"held", piece.held}});
  }
  return {{"findings", findings_of(quality, report)},
          {"tissues", share_facts(report.shares)},
          {"surface", surface_facts(quality)},
          {"voxel_faces_to_input", deviation_facts(quality.faces_to_input)},
          {"piece_count", quality.pieces.size()},
          {"largest_pieces", pieces},
          {"thin_voxels", quality.thin_voxels},
          {"closed_gaps", report.closed_gaps}};
}

}  // namespace stylet::offline
