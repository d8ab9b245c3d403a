// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ build: builds an organ from meshes or from a label map.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "asset/materials.h"
#include "base/file.h"
#include "base/refusal.h"
#include "commands.h"
#include "maps/label_map.h"
#include "maps/recipe.h"
#include "meshes/read_mesh.h"
#include "organ_command.h"
#include "pipeline/label_organ.h"

namespace stylet::offline {
namespace {

struct BuildArguments : CommonArguments {
  std::vector<std::string> inputs;
  std::string recipe;
};

// PATH[:TISSUE[:PRIORITY]]; if a file with the whole text as its name exists, it is the path.
Input parse_input(const std::string& text) {
  Input input;
  input.path = text;
  input.tissue = "liver";
  std::error_code error;
  if (std::filesystem::exists(text, error)) return input;
  const std::size_t first = text.find(':', text.find_last_of('/') + 1);
  if (first == std::string::npos) return input;
  input.path = text.substr(0, first);
  const std::size_t second = text.find(':', first + 1);
  input.tissue = text.substr(first + 1, second == std::string::npos ? second : second - first - 1);
  if (second != std::string::npos &&
      !CLI::detail::lexical_cast(text.substr(second + 1), input.priority)) {
    refuse("{}: priority '{}': expected a whole number", text, text.substr(second + 1));
  }
  return input;
}

void run_build_labels(const BuildArguments& a) {
  if (a.inputs.size() != 1) refuse("--recipe: {} inputs: expected one label map", a.inputs.size());
  const std::string& path = a.inputs.front();
  BuildOptions options = limited_options(a, {});
  (void)read_file(a.recipe);  // refuses a missing recipe before the minute that a map may take
  const LabelMap map = read_label_map(path);
  const Recipe recipe = read_recipe(a.recipe, {path, map.names});
  const std::string recipe_text = std::filesystem::path(a.recipe).filename().string();
  choose_for_labels(a, {path, recipe_text}, recipe, options);
  Outputs outputs;
  finish([&](const BuildOptions& o,
             const Progress& p) { return build_labels(path, map, recipe, o, p); },
         options, a, outputs);
}

void run_build(const BuildArguments& a) {
  if (!a.recipe.empty()) return run_build_labels(a);
  for (const std::string& input : a.inputs) {
    // A folder may have a mesh's name; read_mesh then says that it is a folder.
    if (!is_mesh_name(input) && is_label_map(input))
      refuse("{}: this is a label map: expected --recipe with it", input);
  }
  constexpr double kLeastScale = 1e-9, kMostScale = 1e9;
  if (!(a.scale >= kLeastScale && a.scale <= kMostScale)) {
    refuse("--scale {}: expected {} to {}", a.scale, kLeastScale, kMostScale);
  }
  const MeshUnits units = units_of(a);
  BuildOptions options = limited_options(a, units);
  std::vector<Input> inputs;
  for (const std::string& text : a.inputs) {
    Input& input = inputs.emplace_back(parse_input(text));
    (void)find_tissue(options.own_tissues, input.tissue);
    input.read = read_mesh(input.path);
    input.metres_per_unit = take_metres(input.read, input.path, units);
  }
  choose_for_meshes(a, inputs, options);
  Outputs outputs;
  finish([&](const BuildOptions& o, const Progress& p) { return build(std::move(inputs), o, p); },
         options, a, outputs);
}

}  // namespace

void add_build(CLI::App& app) {
  const auto arguments = std::make_shared<BuildArguments>();
  BuildArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("build", "Make an organ file from meshes or from a label map");
  command->footer(
      "Examples:\n"
      "  stylet-organ build Liver.stl --units mm --voxel-mm 5 -o liver.organ\n"
      "  stylet-organ build wall.stl:muscle Liver.stl:liver:1 --capsule liver_capsule -o "
      "torso.organ\n"
      "  stylet-organ build scan.ply --voxels-across 60 --fix 'x>95%' --wrap -o scan.organ\n"
      "  stylet-organ build seg.nii.gz --recipe totalsegmentator.toml -o patient.organ");
  command
      ->add_option("inputs", a.inputs,
                   "Meshes (" + mesh_endings() +
                       "), each as PATH[:TISSUE[:PRIORITY]] (default: liver, 0); where they "
                       "overlap, the one with the higher priority has the voxel. With --recipe: "
                       "one label map")
      ->type_name("FILE")
      ->required();
  command->add_option("--units", a.units, "Unit of the meshes (default: their own, else mm)")
      ->type_name("UNIT")
      ->check(CLI::IsMember(kMetresPerUnit));
  command->add_option("--scale", a.scale, "Factor for all coordinates, besides the unit")
      ->type_name("NUMBER")
      ->capture_default_str();
  auto* wrap = command->add_flag("--wrap", a.wrap,
                                 "Last resort for a mesh that is not closed: a closed skin around "
                                 "it takes its place; the report tells what that changed");
  command
      ->add_option("--recipe", a.recipe,
                   "TOML file that says which labels are which tissue; the input is then a label "
                   "map (see labels --help)")
      ->type_name("FILE")
      ->excludes(wrap);
  command
      ->add_option("--layer", a.layers,
                   "A layer as TISSUE:THICKNESS_MM; given once for each layer, from the outside "
                   "inwards; the last one fills the rest")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command
      ->add_option("--fill-gaps", a.fill_gaps,
                   "TISSUE:MM: fill gaps between inputs, up to this width, with this tissue")
      ->type_name("GAP");
  command->add_flag("--split-gaps", a.split_gaps,
                    "Keep gaps open from a third of a voxel on: parts that lie in one voxel "
                    "without touching get a voxel each");
  command->add_option("--layers-of", a.layers_of, "What --layer divides (default: all, if alike)")
      ->type_name("TISSUE");
  command
      ->add_option("--layers-along", a.layers_along, "Direction from the outermost layer inwards")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"+x", "-x", "+y", "-y", "+z", "-z"}))
      ->capture_default_str();
  add_common(*command, a);
  command->callback([arguments] { run_build(*arguments); });
}

}  // namespace stylet::offline
