// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ hull: makes an obstacle, as TOML, from a mesh.
#include "meshes/hull.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/outputs.h"
#include "commands.h"
#include "meshes/read_mesh.h"
#include "stylet/command_texts.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

struct HullArguments {
  std::string input;
  std::string units;
  std::size_t most_vertices = kMaxHullVertices;
  std::string output;
  bool json = false;
};

void run_hull(const HullArguments& a) {
  ReadMesh read = read_mesh(a.input);
  MeshUnits units;
  if (!a.units.empty()) units.given_m = kMetresPerUnit.at(a.units);
  const double metres_per_unit = take_metres(read, a.input, units);
  warn(read.notes);
  std::vector<Vec> points_m;
  for (const Triangle& t : read.mesh.triangles) {
    for (const std::uint32_t i : t) points_m.push_back(read.mesh.points[i] * metres_per_unit);
  }
  const Hull hull = simple_hull(a.input, points_m, a.most_vertices);
  const std::string source = std::filesystem::path(a.input).filename().string();
  const std::string text = hull_toml(hull, source, read.sha256);
  tell_of_leftovers(write_file(a.output, text));
  if (a.json) {
    const Json facts = {{"source", source},
                        {"vertices", hull.vertices_m.size()},
                        {"hull_vertices", hull.hull_vertices},
                        {"deviation_mm", hull.deviation_m * 1e3},
                        {"volume_ml", hull.volume_m3 * 1e6},
                        {"output", a.output}};
    fmt::print("{}\n", facts.dump(2));
    return;
  }
  fmt::print(
      "hull          {} of {} vertices, {:.6g} ml\n"
      "deviation     {:.4f} mm at most inside the convex hull of {}\n"
      "wrote         {}\n",
      hull.vertices_m.size(), hull.hull_vertices, hull.volume_m3 * 1e6, hull.deviation_m * 1e3,
      source, a.output);
}

}  // namespace

void add_hull(CLI::App& app) {
  const auto arguments = std::make_shared<HullArguments>();
  HullArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("hull", "Make an obstacle for a scene (TOML) from a mesh");
  command->footer(
      "Example:\n"
      "  stylet-organ hull rib.stl --units mm --max-vertices 64 -o rib.toml\n"
      "The body is convex: hollows of the mesh are filled. Coordinates stay those of the mesh.");
  command->add_option("input", a.input, "Mesh (" + mesh_endings() + ")")
      ->type_name("FILE")
      ->required();
  command->add_option("--units", a.units, "Unit of the mesh (default: its own, else mm)")
      ->type_name("UNIT")
      ->check(CLI::IsMember(kMetresPerUnit));
  command->add_option("--max-vertices", a.most_vertices, "Most vertices that the hull may have")
      ->type_name("NUMBER")
      ->check(cli::between(kLeastHullVertices, std::size_t{kMaxHullVertices}))
      ->capture_default_str();
  command->add_option("-o,--output", a.output, "TOML file to write")->type_name("FILE")->required();
  command->add_flag("--json", a.json, "Report as one JSON object on standard output");
  command->callback([arguments] { run_hull(*arguments); });
}

}  // namespace stylet::offline
