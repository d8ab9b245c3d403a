// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/info.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "asset/materials.h"
#include "asset/organ_shape.h"
#include "asset/write_organ.h"
#include "base/file.h"
#include "base/refusal.h"
#include "meshes/read_mesh.h"
#include "organ_generated.h"
#include "stylet/content_sum.h"
#include "stylet/kernel.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const flatbuffers::String* text) {
  return text != nullptr ? text->str() : "";
}

// Voxels of a level or a material, and how many of level 0 would be filled by them.
struct Sum {
  std::size_t voxels = 0;
  double fill = 0;

  void add(const Organ& organ, std::size_t voxel, std::uint32_t level) {
    ++voxels;
    fill += organ.voxel_fill[voxel] / 255.0 / static_cast<double>(1U << (3 * level));
  }
  double ml(const Organ& organ) const {
    const double edge_mm = shown(organ.voxel_edge_m) * 1e3;
    return fill * edge_mm * edge_mm * edge_mm * 1e-3;
  }
};

// The sums by level and by material.
struct Sums {
  std::vector<Sum> of_level, of_material;
  Sum all;
};
Sums sums_of(const Organ& organ) {
  Sums sums{std::vector<Sum>(organ.levels), std::vector<Sum>(organ.material_count), {}};
  const std::vector<Cell> cells = cells_of(organ);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t level = level_of(organ, cells[i]);
    sums.of_level[level].add(organ, i, level);
    sums.of_material[organ.voxel_material[i]].add(organ, i, level);
    sums.all.add(organ, i, level);
  }
  return sums;
}

Json level_facts(const Organ& organ, const Sums& sums) {
  Json list = Json::array();
  for (std::uint32_t level = 0; level < organ.levels; ++level) {
    list.push_back({{"voxel_edge_mm", shown(organ.voxel_edge_m) * 1e3 / (1U << level)},
                    {"voxels", sums.of_level[level].voxels},
                    {"volume_ml", sums.of_level[level].ml(organ)}});
  }
  return list;
}

Json material_facts(const Organ& organ, const Sums& sums) {
  Json list = Json::array();
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    const Material m = organ_material(organ, i);
    Json facts{{"name", m.name},
               {"voxels", sums.of_material[i].voxels},
               {"volume_ml", sums.of_material[i].ml(organ)}};
    for (const MaterialNumber& number : kMaterialNumbers) {
      facts[number.key] = shown(m.*number.field) * (1 / number.si_per_unit);
    }
    facts["source"] = m.source;
    list.push_back(std::move(facts));
  }
  return list;
}

// What a needle meets at its tip, if it does not follow from the toughness among the numbers below.
std::string forces_text(const Json& m) {
  if (m["fracture_toughness_j_per_m2"].get<double>() > 0) return "";
  return fmt::format("  puncture {:.3g} N  cutting {:.3g} N", m["puncture_force_n"].get<double>(),
                     m["cutting_force_n"].get<double>());
}

// Numbers of friction, and those that not every tissue has: a new one is among them.
std::string numbers_text(const Json& m) {
  std::string text(12, ' ');
  bool listed = false;
  for (const MaterialNumber& number : kMaterialNumbers) {
    listed = listed || number.field == &Material::coulomb_friction_n_per_m;
    const double value = m[number.key].get<double>();
    if (listed && value != 0) text += fmt::format("  {} {:.4g}", number.key, value);
  }
  return text;
}

Json byte_facts(const Organ& organ, std::size_t total) {
  const std::size_t lattice = organ.runs.size_bytes() + organ.voxel_material.size_bytes() +
                              organ.voxel_fill.size_bytes() + organ.voxel_fixed.size_bytes() +
                              organ.mixed.size_bytes() + organ.ties.size_bytes() +
                              organ.parts.size_bytes() + organ.hanging.size_bytes();
  const std::size_t membranes = organ.membrane_points.size_bytes() +
                                organ.membrane_triangles.size_bytes() +
                                organ.membrane_cells.size_bytes();
  const std::size_t slides = organ.slide_points.size_bytes() + organ.slide_grounds.size_bytes() +
                             organ.slide_bodies.size_bytes();
  const std::size_t known = lattice + organ.vertices.size_bytes() + organ.triangles.size_bytes() +
                            organ.spheres.size_bytes() + membranes + slides +
                            organ.skins.size_bytes();
  Json facts{{"total", total},
             {"lattice", lattice},
             {"vertices", organ.vertices.size_bytes()},
             {"triangles", organ.triangles.size_bytes()},
             {"sphere_tree", organ.spheres.size_bytes()},
             {"membranes", membranes},
             {"slides", slides},
             {"skins", organ.skins.size_bytes()},
             {"materials_provenance_and_tables", total - known},
             {"lattice_per_voxel", static_cast<double>(lattice) / organ.voxel_count}};
  facts["per_vertex"] = organ.vertices.empty() ? 0 : sizeof(OrganVertex);
  return facts;
}

// Each membrane's tissue, the cells of level 0 that it passes through, and its area in them.
Json membrane_facts(const Organ& organ) {
  Json list = Json::array();
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    double squares = 0;
    std::size_t cells = 0;
    for (const OrganMembraneCell& cell : organ.membrane_cells) {
      if (cell.material != i || cell.count == 0) continue;  // of finer levels: area alone
      ++cells;
      squares += static_cast<double>(cell.area);
    }
    if (cells == 0) continue;
    const double edge_mm = shown(organ.voxel_edge_m) * 1e3;
    list.push_back({{"tissue", organ_material(organ, i).name},
                    {"cells", cells},
                    {"area_cm2", squares * edge_mm * edge_mm * 1e-2}});
  }
  return list;
}

// Which tissues slide on which: the points, and the area that they stand for.
Json slide_facts(const Organ& organ) {
  const std::vector<Cell> cells = cells_of(organ);
  struct Points {
    std::size_t points = 0;
    double squares = 0;
  };
  std::map<std::tuple<std::uint8_t, std::uint8_t, float>, Points> sums;
  for (const OrganSlidePoint& p : organ.slide_points) {
    const std::uint32_t ground = organ.slide_grounds[p.ground].voxel;
    Points& sum = sums[{organ.voxel_material[p.voxel], organ.voxel_material[ground], p.friction}];
    ++sum.points;
    const std::uint32_t level = level_of(organ, cells[p.voxel]);
    sum.squares += static_cast<double>(p.area) / (1U << 2 * level);  // of level 0
  }
  Json list = Json::array();
  for (const auto& [which, sum] : sums) {
    const auto [tissue, ground, friction] = which;
    const double edge_mm = shown(organ.voxel_edge_m) * 1e3;
    list.push_back({{"tissue", organ_material(organ, tissue).name},
                    {"ground", organ_material(organ, ground).name},
                    {"friction", shown(friction)},
                    {"points", sum.points},
                    {"area_cm2", sum.squares * edge_mm * edge_mm * 1e-2}});
  }
  return list;
}

// Voxels share corners, and each is to be counted once: so all held corners are collected as places
// in the lattice, and repeated places are dropped.
std::size_t held_corner_count(const Organ& organ) {
  const auto place_of = [](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (z << 40U) | (y << 20U) | x;
  };
  std::vector<std::uint64_t> corners;
  std::size_t voxel = 0;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
      for (std::uint32_t c = 0; c < 8 && !organ.voxel_fixed.empty(); ++c) {
        if ((organ.voxel_fixed[voxel] >> c & 1U) == 0) continue;
        corners.push_back(
            place_of(run.x + i + (c & 1U), run.y + (c >> 1U & 1U), run.z + (c >> 2U)));
      }
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<std::uint64_t> hanging;  // no particles of their own
  for (const OrganHanging& h : organ.hanging) hanging.push_back(place_of(h.x, h.y, h.z));
  const auto hangs = [&](std::uint64_t corner) {
    return std::binary_search(hanging.begin(), hanging.end(), corner);
  };
  return static_cast<std::size_t>(
      std::count_if(corners.begin(), corners.end(), std::not_fn(hangs)));
}

Json provenance_facts(const format::Organ& root) {
  const format::Provenance* p = root.provenance();
  if (p == nullptr) return nullptr;
  Json sources = Json::array();
  if (p->sources() != nullptr) {
    for (const format::Source* s : *p->sources()) {
      sources.push_back({{"path", text_of(s->path())},
                         {"tissue", text_of(s->tissue())},
                         {"sha256", text_of(s->sha256())},
                         {"metres_per_unit", s->metres_per_unit()},
                         {"priority", s->priority()},
                         {"triangles", s->triangle_count()}});
    }
  }
  return {{"tool_version", text_of(p->tool_version())},
          {"options", text_of(p->options())},
          {"sources", sources}};
}

Json kernel_facts(const Organ& organ) {
  Sizes bytes{};
  const Status status = sizes(organ, Config{}, bytes);
  if (status != Status::kOk) return {{"status", status_name(status)}};
  return {{"status", "ok"},
          {"model_bytes", bytes.model_bytes},
          {"state_bytes", bytes.state_bytes},
          {"scratch_bytes", bytes.scratch_bytes}};
}

double megabytes(const Json& bytes) {
  return bytes.get<double>() * 1e-6;
}

std::string count_line(const Json& counts) {
  std::string text;
  for (const auto& [name, count] : counts.items()) {
    if (count.get<std::size_t>() == 0) continue;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count.get<std::size_t>(), words);
  }
  return text.empty() ? "nothing" : text;
}

}  // namespace

Organ open_organ(const std::string& file, std::span<const std::byte> bytes) {
  Organ organ;
  OrganRefusal refusal;
  if (organ_open(bytes, organ, &refusal) != Status::kOk) {
    if (is_mesh_name(file)) {
      refuse("{}: a mesh: expected an organ file; `stylet-organ build` makes an organ of it", file);
    }
    refuse("{}: {}", file, describe(refusal));
  }
  if (!has_its_bytes(bytes, organ)) {
    refuse(
        "{}: content_sha256: {}: expected {}, the sum of its bytes: a byte has changed since the "
        "file was written",
        file, organ.content_sha256.empty() ? "none" : hex_of(organ.content_sha256),
        hex_of(content_sha256(bytes, organ)));
  }
  return organ;
}

nlohmann::ordered_json organ_facts(const Organ& organ, std::span<const std::byte> bytes) {
  const auto& root = *format::GetOrgan(bytes.data());
  const Sums sums = sums_of(organ);
  const double edge_mm = shown(organ.voxel_edge_m) * 1e3;
  return {{"name", organ.name},
          {"hash", fmt::format("{:016x}", organ.hash)},
          {"content_sha256", hex_of(organ.content_sha256)},
          {"format_version", root.format_version()},
          {"voxel_edge_mm", edge_mm},
          {"origin_mm",
           {shown(organ.origin_m.x) * 1e3, shown(organ.origin_m.y) * 1e3,
            shown(organ.origin_m.z) * 1e3}},
          {"levels", level_facts(organ, sums)},
          {"hanging_nodes", organ.hanging.size()},
          {"lattice_size", {organ.size_x, organ.sheet_rows, organ.size_z}},
          {"sheets", organ.size_y / organ.sheet_rows},
          {"voxels_that_share_cells", organ.parts.size()},
          {"voxels", organ.voxel_count},
          {"mixed_voxels", organ.mixed.size()},
          {"runs", organ.runs.size()},
          {"volume_ml", sums.all.ml(organ)},
          {"held_corners", held_corner_count(organ)},
          {"surface_vertices", organ.vertices.size()},
          {"surface_triangles", organ.triangles.size()},
          {"sphere_nodes", organ.spheres.size()},
          {"materials", material_facts(organ, sums)},
          {"membranes", membrane_facts(organ)},
          {"slides", slide_facts(organ)},
          {"bytes", byte_facts(organ, bytes.size())},
          {"kernel_memory", kernel_facts(organ)},
          {"provenance", provenance_facts(root)}};
}

namespace {

// The edges of all voxels, and how the lattice is stored.
std::string lattice_text(const Json& f) {
  const bool graded = f["levels"].size() > 1;
  const double coarse_mm = f["voxel_edge_mm"].get<double>();
  const std::string edges = graded ? fmt::format("{:.6g} to {:.6g}", coarse_mm,
                                                 f["levels"].back()["voxel_edge_mm"].get<double>())
                                   : fmt::format("{:.6g}", coarse_mm);
  return fmt::format(
      "lattice       {} voxels of {} mm in {} x {} x {}{}, {:.4g} ml; {} hold two tissues, or "
      "tissue and none\n",
      f["voxels"].get<std::size_t>(), edges, f["lattice_size"][0].get<int>(),
      f["lattice_size"][1].get<int>(), f["lattice_size"][2].get<int>(),
      graded ? " (stored one level after the other)" : "", f["volume_ml"].get<double>(),
      f["mixed_voxels"].get<std::size_t>());
}

// Only if there are several.
std::string levels_text(const Json& f) {
  std::string text;
  const Json& levels = f["levels"];
  for (std::size_t i = 0; i < levels.size() && levels.size() > 1; ++i) {
    text +=
        fmt::format("level {}       {} voxels of {:.6g} mm, {:.4g} ml\n", i,
                    levels[i]["voxels"].get<std::size_t>(),
                    levels[i]["voxel_edge_mm"].get<double>(), levels[i]["volume_ml"].get<double>());
  }
  return text;
}

// Membranes, and where parts slide.
std::string surfaces_text(const Json& f) {
  std::string text;
  for (const auto& m : f["membranes"]) {
    text += fmt::format("membrane      {:<14} {:>8} cells  {:>9.4g} cm2  (cells of {:.6g} mm)\n",
                        m["tissue"].get<std::string>(), m["cells"].get<std::size_t>(),
                        m["area_cm2"].get<double>(), f["voxel_edge_mm"].get<double>());
  }
  for (const auto& s : f["slides"]) {
    text += fmt::format("slide         {:<14} {:>8} points {:>9.4g} cm2  on {}, friction {:.3g}\n",
                        s["tissue"].get<std::string>(), s["points"].get<std::size_t>(),
                        s["area_cm2"].get<double>(), s["ground"].get<std::string>(),
                        s["friction"].get<double>());
  }
  return text;
}

}  // namespace

std::string organ_text(const nlohmann::ordered_json& f) {
  std::string text = fmt::format("organ         {}  (hash {})\n", f["name"].get<std::string>(),
                                 f["hash"].get<std::string>());
  text += lattice_text(f);
  text +=
      fmt::format("held          {} corners\nsurface       {} vertices, {} triangles, {} spheres\n",
                  f["held_corners"].get<std::size_t>(), f["surface_vertices"].get<std::size_t>(),
                  f["surface_triangles"].get<std::size_t>(), f["sphere_nodes"].get<std::size_t>());
  text += levels_text(f);
  if (f["sheets"].get<int>() > 1) {
    text += fmt::format("gaps          {} voxels share cells with others they do not touch\n",
                        f["voxels_that_share_cells"].get<std::size_t>());
  }
  for (const auto& m : f["materials"]) {
    text += fmt::format(
        "material      {:<14} {:>8} voxels {:>9.4g} ml  E {:.4g} kPa  nu {:.2g}{}\n{}\n",
        m["name"].get<std::string>(), m["voxels"].get<std::size_t>(), m["volume_ml"].get<double>(),
        m["youngs_modulus_kpa"].get<double>(), m["poisson_ratio"].get<double>(), forces_text(m),
        numbers_text(m));
  }
  text += surfaces_text(f);
  const auto& b = f["bytes"];
  text += fmt::format(
      "file          {:.3f} MB: lattice {:.3f} ({:.2f} bytes per voxel), vertices {:.3f}, "
      "triangles "
      "{:.3f}, spheres {:.3f}\n",
      megabytes(b["total"]), megabytes(b["lattice"]), b["lattice_per_voxel"].get<double>(),
      megabytes(b["vertices"]), megabytes(b["triangles"]), megabytes(b["sphere_tree"]));
  const auto& k = f["kernel_memory"];
  text += k["status"] == "ok"
              ? fmt::format("kernel needs  {:.2f} MB model, {:.2f} MB state, {:.2f} MB scratch\n",
                            megabytes(k["model_bytes"]), megabytes(k["state_bytes"]),
                            megabytes(k["scratch_bytes"]))
              : fmt::format("kernel needs  unknown: {}\n", k["status"].get<std::string>());
  if (f["provenance"].is_null()) return text;
  text += fmt::format("made by       {}: {}\n", f["provenance"]["tool_version"].get<std::string>(),
                      f["provenance"]["options"].get<std::string>());
  for (const auto& s : f["provenance"]["sources"]) {
    text += fmt::format(
        "from          {} ({} triangles, {} m per unit, priority {}) as {}, sha256 "
        "{}\n",
        s["path"].get<std::string>(), s["triangles"].get<std::size_t>(),
        s["metres_per_unit"].get<double>(), s["priority"].get<int>(),
        s["tissue"].get<std::string>(), s["sha256"].get<std::string>());
  }
  return text;
}

nlohmann::ordered_json build_facts(const BuildReport& report) {
  Json inputs = Json::array();
  for (const InputReport& i : report.inputs) {
    inputs.push_back({{"path", i.path},
                      {"tissue", i.tissue},
                      {"triangles", i.repair.triangles_read},
                      {"pieces", i.repair.pieces},
                      {"closed", i.closed},
                      {"oriented", i.oriented},
                      {"mesh_volume_ml", i.mesh_volume_m3 * 1e6},
                      {"filled_volume_ml", i.filled_volume_m3 * 1e6},
                      {"found",
                       {{"border_edges", i.repair.border_edges},
                        {"non_manifold_edges", i.repair.non_manifold_edges},
                        {"inconsistent_edges", i.repair.inconsistent_edges},
                        {"polygons", i.read.polygons}}},
                      {"repaired",
                       {{"points_merged", i.repair.points_merged},
                        {"triangles_turned", i.repair.triangles_turned},
                        {"degenerate_triangles_dropped", i.repair.degenerate},
                        {"duplicate_triangles_dropped", i.repair.duplicates},
                        {"unused_points_dropped", i.repair.points_unused},
                        {"unreadable_unused_points_dropped", i.read.unusable_points},
                        {"faces_of_1_or_2_corners_dropped", i.read.short_faces},
                        {"lines_and_points_dropped", i.read.lines_and_points},
                        {"cells_behind_holes_filled", i.decided_by_winding}}}});
  }
  Json labels = Json::array();
  for (const LabelReport& i : report.labels) {
    labels.push_back({{"tissue", i.tissue},
                      {"voxels", i.voxels},
                      {"map_volume_ml", i.map_volume_m3 * 1e6},
                      {"filled_volume_ml", i.filled_volume_m3 * 1e6}});
  }
  return {{"inputs", inputs}, {"labels", labels}, {"warnings", report.warnings}};
}

std::string build_text(const nlohmann::ordered_json& facts) {
  std::string text;
  for (const auto& i : facts["inputs"]) {
    text += fmt::format("input         {} as {}: {} triangles, {} pieces, {}, {}\n",
                        i["path"].get<std::string>(), i["tissue"].get<std::string>(),
                        i["triangles"].get<std::size_t>(), i["pieces"].get<std::size_t>(),
                        i["closed"].get<bool>() ? "closed" : "open",
                        i["oriented"].get<bool>() ? "oriented" : "not orientable (rays vote)");
    text += fmt::format("found         {}\nrepaired      {}\n", count_line(i["found"]),
                        count_line(i["repaired"]));
    text += fmt::format("volume        mesh {:.6g} ml, voxels {:.6g} ml\n",
                        i["mesh_volume_ml"].get<double>(), i["filled_volume_ml"].get<double>());
  }
  for (const auto& i : facts["labels"]) {
    text += fmt::format("tissue        {:<14} {:>8} voxels of the map, {:.6g} ml, here {:.6g} ml\n",
                        i["tissue"].get<std::string>(), i["voxels"].get<std::size_t>(),
                        i["map_volume_ml"].get<double>(), i["filled_volume_ml"].get<double>());
  }
  return text;
}

}  // namespace stylet::offline
