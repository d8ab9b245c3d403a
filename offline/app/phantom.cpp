// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ phantom: builds the organ of a test body.
#include "meshes/phantom.h"

#include <fmt/format.h>

#include <memory>

#include "base/file.h"
#include "base/refusal.h"
#include "commands.h"
#include "organ_command.h"

namespace stylet::offline {
namespace {

struct PhantomArguments : CommonArguments {
  std::string kind;
  std::vector<double> size_mm{100, 60, 60};
  double diameter_mm = 60;
  bool size_given = false, diameter_given = false;
  std::string tissue;
  std::string mesh_out;
};

// Facets about as large as voxels, since all finer facets of a voxel would move together; and at
// most a few thousand of them.
double facet_size(const PhantomArguments& a, double longest_m) {
  constexpr double kMostAcross = 40;
  const double edge_m = a.voxels_across > 0 ? longest_m / a.voxels_across : a.voxel_mm * 1e-3;
  return std::clamp(edge_m, longest_m / kMostAcross, longest_m / 4);
}

Mesh make_phantom(const PhantomArguments& a) {
  constexpr double kMostMm = 2000;
  const auto in_range = [](double mm) { return mm > 0 && mm <= kMostMm; };
  if (a.kind == "ball") {
    if (!in_range(a.diameter_mm)) refuse("--diameter-mm {}: expected 0 to 2000", a.diameter_mm);
    const double diameter_m = a.diameter_mm * 1e-3;
    return ball_phantom(diameter_m, facet_size(a, diameter_m));
  }
  if (a.kind == "liver") return liver_phantom(facet_size(a, kLiverPhantomLengthM));
  for (const double mm : a.size_mm) {
    if (!in_range(mm)) refuse("--size-mm {}: expected three lengths of 0 to 2000", mm);
  }
  const Vec size_m = Vec{a.size_mm[0], a.size_mm[1], a.size_mm[2]} * 1e-3;
  return block_phantom(size_m, facet_size(a, std::max({size_m.x, size_m.y, size_m.z})));
}

void run_phantom(PhantomArguments a) {
  if (a.kind == "layered" && a.layers.empty())
    a.layers = {"skin:5", "fat:10", "muscle:15", "liver:70"};
  if (a.kind != "layered" && !a.layers.empty()) refuse("--layer: expected only with layered");
  if (a.kind != "ball" && a.diameter_given) refuse("--diameter-mm: expected only with ball");
  if (a.kind != "block" && a.kind != "layered" && a.size_given) {
    refuse("--size-mm: expected only with block and layered");
  }
  if (a.tissue.empty()) a.tissue = a.kind == "liver" ? "liver" : "gel";
  BuildOptions options = limited_options(a, {});
  options.layers = parse_layers(a.layers, "--layer");
  if (options.name.empty()) options.name = a.kind + " phantom";
  Input input;
  input.path = a.kind + "-phantom";
  input.tissue = options.layers.empty() ? a.tissue : options.layers.front().tissue;
  input.metres_per_unit = 1;
  input.read.mesh = make_phantom(a);
  const std::string off = off_text(input.read.mesh);
  input.read.sha256 = sha256_hex(off);
  options.options_text += a.kind == "ball"    ? fmt::format(" --diameter-mm {}", a.diameter_mm)
                          : a.kind == "liver" ? ""
                                              : fmt::format(" --size-mm {},{},{}", a.size_mm[0],
                                                            a.size_mm[1], a.size_mm[2]);
  if (!a.layers.empty()) options.options_text += " --layer " + joined(a.layers);
  Outputs outputs;
  if (!a.mesh_out.empty()) outputs.add(a.mesh_out, off);
  std::vector<Input> inputs = {std::move(input)};
  choose_capsule(a, {inputs.front().tissue}, options);
  settle_places({inputs.front().tissue}, options);
  finish([&](const BuildOptions& o, const Progress& p) { return build(std::move(inputs), o, p); },
         options, a, outputs);
}

}  // namespace

void add_phantom(CLI::App& app) {
  const auto arguments = std::make_shared<PhantomArguments>();
  PhantomArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("phantom", "Make an organ file of a test body");
  command->footer(
      "Examples:\n"
      "  stylet-organ phantom liver --voxel-mm 5 -o liver-phantom.organ\n"
      "  stylet-organ phantom block --size-mm 100,60,60 --tissue gel -o block.organ\n"
      "  stylet-organ phantom layered --layer skin:5 --layer fat:10 --layer liver:85 -o "
      "layers.organ");
  command->add_option("kind", a.kind, "Body to make")
      ->type_name("BODY")
      ->required()
      ->check(CLI::IsMember({"block", "layered", "ball", "liver"}));
  command->add_option("--size-mm", a.size_mm, "Block and layered: lengths along x, y, z")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->capture_default_str();
  command->add_option("--diameter-mm", a.diameter_mm, "Ball: its diameter")
      ->type_name("MM")
      ->capture_default_str();
  command->add_option("--tissue", a.tissue, "Tissue of the body (default: gel; for liver: liver)")
      ->type_name("TISSUE");
  command
      ->add_option("--layer", a.layers,
                   "Layered: a layer as TISSUE:THICKNESS_MM; given once for each layer, along +x; "
                   "the last one fills the rest")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command->add_option("--mesh-out", a.mesh_out, "Also write the surface, in metres, as OFF")
      ->type_name("FILE");
  add_common(*command, a);
  command->callback([arguments, command] {
    arguments->size_given = command->count("--size-mm") > 0;
    arguments->diameter_given = command->count("--diameter-mm") > 0;
    run_phantom(*arguments);
  });
}

}  // namespace stylet::offline
