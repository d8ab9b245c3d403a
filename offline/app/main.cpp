// SPDX-License-Identifier: GPL-3.0-or-later
// The program stylet-organ: build, phantom, hull, labels, info, check. Exit codes: 0 done, 1 input
// refused or file damaged, 2 wrong usage.

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "base/file.h"
#include "base/outputs.h"
#include "base/refusal.h"
#include "meshes/hull.h"
#include "meshes/phantom.h"
#include "pipeline/build.h"
#include "pipeline/label_organ.h"
#include "progress_bar.h"
#include "report/info.h"
#include "report/page.h"
#include "report/quality.h"
#include "report/speed.h"
#include "stylet/command_texts.h"
#include "stylet/kernel.h"
#include "stylet/limits.h"
#include "voxels/crop.h"

namespace stylet::bake {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kToolVersion = "stylet-organ " STYLET_VERSION;
constexpr int kExitRefused = 1;
constexpr int kExitUsage = 2;

// ---- what the command line says -----------------------------------------------------------------

struct CommonArguments {  // of build and phantom
  std::string output;
  std::string name;
  double voxel_mm = 5;
  std::uint32_t voxels_across = 0;
  std::string capsule = "auto";
  std::vector<std::string> fix = kDefaultFix;
  std::vector<std::string> crop;
  std::string materials;
  std::string fit;  // rate
  std::string machine;
  std::uint32_t substeps = 0;  // the usual ones of the inertia
  Inertia inertia = Config{}.inertia;
  std::string report;  // folder
  bool sum = false;
  std::uint64_t memory_limit_bytes = 0;
  bool json = false;
};

struct BuildArguments : CommonArguments {
  std::vector<std::string> inputs;
  std::string units = "mm";
  double scale = 1;
  bool wrap = false;
  std::vector<std::string> layers;
  std::string layers_of;
  std::string layers_along = "+x";
  std::string recipe;
  std::string fill_gaps;
  bool split_gaps = false;
};

struct PhantomArguments : CommonArguments {
  std::string kind;
  std::vector<double> size_mm{100, 60, 60};
  double diameter_mm = 60;
  bool size_given = false, diameter_given = false;
  std::string tissue;
  std::vector<std::string> layers;
  std::string mesh_out;
};

struct HullArguments {
  std::string input;
  std::string units = "mm";
  std::size_t most_vertices = kMaxHullVertices;
  std::string output;
  bool json = false;
};

struct FileArguments {
  std::string file;
  bool json = false;
};

const std::map<std::string, double> kMetresPerUnit{
    {"mm", 1e-3}, {"cm", 1e-2}, {"dm", 1e-1}, {"m", 1.0}};

const std::map<std::string, Inertia> kInertias{{"true_mass", Inertia::kTrueMass},
                                               {"added_mass", Inertia::kAddedMass}};

void add_common(CLI::App& command, CommonArguments& a) {
  command.add_option("-o,--output", a.output, "Organ file to write")->type_name("FILE")->required();
  command.add_option("--name", a.name, "Name of the organ (default: that of the first input)");
  auto* edge = command.add_option("--voxel-mm", a.voxel_mm, "Edge of a voxel")
                   ->type_name("MM")
                   ->capture_default_str();
  auto* across =
      command
          .add_option("--voxels-across", a.voxels_across, "Instead: voxels along the longest side")
          ->type_name("NUMBER")
          ->check(cli::between(1U, 65535U))
          ->excludes(edge);
  auto* fit = command.add_option("--fit", a.fit,
                                 "Rate, such as 1kHz: the finest voxel edge whose tick takes half "
                                 "the period at most");
  fit->type_name("RATE")->excludes(edge)->excludes(across);
  command
      .add_option("--machine", a.machine,
                  "CSV of stylet-bench on the machine to fit to (default: measured here)")
      ->type_name("FILE")
      ->needs(fit);
  command.add_option("--inertia", a.inertia, "loop.inertia of the scene, to reckon with")
      ->type_name("true_mass|added_mass")
      ->transform(CLI::CheckedTransformer(kInertias))
      ->default_str("true_mass");
  command
      .add_option("--substeps", a.substeps,
                  "loop.substeps of the scene, to reckon with (default: 1, with added mass 2)")
      ->type_name("NUMBER")
      ->check(cli::between(1U, kMaxSubsteps));
  command
      .add_option(
          "--capsule", a.capsule,
          "Tissue of the voxels at the outer surface; auto: liver_capsule on liver; or none")
      ->type_name("TISSUE")
      ->capture_default_str();
  command
      .add_option("--fix", a.fix,
                  "What is held in space, repeatable: x>MM, x<MM (or y, z; MM may be N%), "
                  "box:X0,Y0,Z0,X1,Y1,Z1, touching:MESH, or none")
      ->type_name("REGION")
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      .add_option("--crop", a.crop,
                  "Only the part of the organ that lies in x>MM, x<MM (or y, z; MM may be N%) or "
                  "box:X0,Y0,Z0,X1,Y1,Z1, repeatable: in all of them; held where it is cut")
      ->type_name("REGION")
      ->allow_extra_args(false);
  command.add_option("--materials", a.materials, "TOML file with tissues of your own")
      ->type_name("FILE");
  command
      .add_option("--report", a.report,
                  "Folder for a quality report: report.html with pictures, report.json")
      ->type_name("FOLDER");
  command
      .add_option("--memory-limit", a.memory_limit_bytes,
                  "Refuse instead of taking more memory, such as 2GiB (default: no limit)")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(false));
  command.add_flag("--sum", a.sum,
                   "Also write OUTPUT.sha256, which check and sha256sum -c compare with");
  command.add_flag("--json", a.json, "Report as one JSON object on standard output");
}

// ---- build and phantom --------------------------------------------------------------------------

std::string joined(const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& t : texts) text += (text.empty() ? "" : " ") + t;
  return text;
}

// Without folders, so that the bytes do not depend on where the files lie.
std::string without_folder(const std::string& fix) {
  const std::string word = "touching:";
  if (!fix.starts_with(word)) return fix;
  return word + std::filesystem::path(fix.substr(word.size())).filename().string();
}

// The heap and all mappings of our own; what goes beyond fails as if memory were out.
void limit_memory(std::uint64_t bytes) {
  constexpr std::uint64_t kLeast = std::uint64_t{64} << 20U;
  if (bytes == 0) return;
  if (bytes < kLeast) refuse("--memory-limit {} bytes: expected at least 64MiB", bytes);
  const rlimit limit = {bytes, bytes};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) {
    refuse("--memory-limit: the system does not take it: {}", std::strerror(errno));
  }
}

// The machine that --fit reckons with.
std::optional<Machine> chosen_machine(const CommonArguments& a) {
  if (a.fit.empty()) return std::nullopt;
  (void)period_of(a.fit);  // before anything takes time
  return a.machine.empty() ? measure_machine(progress_bar()) : read_machine(a.machine);
}

BuildOptions common_options(const CommonArguments& a, double metres_per_unit) {
  limit_memory(a.memory_limit_bytes);
  BuildOptions options;
  options.name = a.name;
  options.voxel_edge_m = a.voxel_mm * 1e-3;
  require_voxel_edge(options.voxel_edge_m);
  options.voxels_across = a.voxels_across;
  options.held = parse_regions(a.fix, metres_per_unit);
  options.crop = parse_crop(a.crop);
  if (!a.materials.empty()) options.own_tissues = read_tissues(a.materials);
  options.measured = !a.report.empty();
  options.tool_version = kToolVersion;
  options.options_text = a.voxels_across > 0 ? fmt::format("--voxels-across {}", a.voxels_across)
                         : !a.fit.empty()    ? "--fit " + a.fit
                                             : fmt::format("--voxel-mm {}", a.voxel_mm);
  for (const std::string& fix : a.fix) options.options_text += " --fix " + without_folder(fix);
  for (const std::string& crop : a.crop) options.options_text += " --crop " + crop;
  if (!a.materials.empty()) {
    options.options_text +=
        " --materials " + std::filesystem::path(a.materials).filename().string();
  }
  return options;
}

// Hulls of obstacles beside the organ, and a scene with them and the targets.
Json add_scene(Outputs& outputs, const Built& built, const std::filesystem::path& organ) {
  if (built.obstacles.empty() && built.targets.empty()) return nullptr;
  const std::string stem = organ.stem().string();
  Json facts = {{"file", organ.parent_path() / (stem + ".scene.toml")},
                {"obstacles", Json::array()},
                {"targets", Json::array()}};
  std::vector<std::string> files;
  for (const NamedHull& each : built.obstacles) {
    const auto& [name, hull] = std::tie(each.name, each.hull);
    files.push_back(stem + "." + name + ".toml");
    outputs.add(organ.parent_path() / files.back(),
                hull_toml(hull, organ.filename().string() + ": " + name, ""));
    facts["obstacles"].push_back({{"name", name},
                                  {"file", organ.parent_path() / files.back()},
                                  {"volume_ml", hull.volume_m3 * 1e6},
                                  {"label_ml", each.label_m3 * 1e6},
                                  {"deviation_mm", hull.deviation_m * 1e3}});
  }
  for (const Target& target : built.targets) {
    const Vec mm = target.middle_m * 1e3;
    facts["targets"].push_back({{"name", target.name},
                                {"middle_mm", {mm.x, mm.y, mm.z}},
                                {"volume_ml", target.volume_m3 * 1e6},
                                {"diameter_mm", target.radius_m * 2e3}});
  }
  outputs.add(facts["file"].get<std::string>(),
              scene_toml(organ.filename().string(), files, built.targets));
  return facts;
}

std::string scene_text(const Json& scene) {
  std::string text;
  if (scene.is_null()) return text;
  for (const Json& body : scene["obstacles"]) {
    text += fmt::format("obstacle      {}: hull of {:.4g} ml around labels of {:.4g} ml, {}\n",
                        body["name"].get<std::string>(), body["volume_ml"].get<double>(),
                        body["label_ml"].get<double>(), body["file"].get<std::string>());
  }
  for (const Json& target : scene["targets"]) {
    text += fmt::format("target        {}: {:.4g} ml at {}\n", target["name"].get<std::string>(),
                        target["volume_ml"].get<double>(), target["middle_mm"].dump());
  }
  return text + fmt::format("scene         {}\n", scene["file"].get<std::string>());
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    fmt::print(stderr, "stylet-organ: warning: {}\n", warning);
  }
}

// What would be refused after minutes of work.
void check_outputs(const CommonArguments& a) {
  check_output(a.output);
  if (!a.report.empty()) check_output_folder(a.report);
}

Stepping stepping_of(const CommonArguments& a) {
  Stepping stepping;
  if (!a.fit.empty()) stepping.period_s = period_of(a.fit);
  stepping.inertia = a.inertia;
  const std::uint32_t usual = a.inertia == Inertia::kTrueMass ? 1 : 2;
  stepping.substeps = a.substeps > 0 ? a.substeps : usual;
  return stepping;
}

// Of organs with more, which no tick of a millisecond has room for, a build says what a hand feels
// of the step's inertia only when it is asked to look (--fit, --report): it takes seconds there.
constexpr std::uint32_t kInertiaVoxels = 100'000;

// Builds, writes and reports. The progress bar goes before the report comes.
void finish(const std::function<Built(const BuildOptions&, const Progress&)>& make,
            BuildOptions options, const CommonArguments& a, Outputs& outputs) {
  check_outputs(a);
  const Stepping stepping = stepping_of(a);
  const std::optional<Machine> machine = chosen_machine(a);
  if (machine) options.most_voxels = most_voxels(*machine, stepping);
  const Progress progress = progress_bar();
  const Built built = make(options, progress);
  outputs.add(a.output, built.bytes);
  if (a.sum) {
    outputs.add(a.output + kSumEnding, sum_line(a.output, built.bytes));
  } else if (has_sum_line(a.output)) {  // of the organ that was there before
    outputs.remove(a.output + kSumEnding);
  }
  warn(built.report.warnings);
  const Organ organ = open_organ(a.output, built.bytes);
  Json facts = build_facts(built.report);
  facts["output"] = a.output;
  facts["organ"] = organ_facts(organ, built.bytes);
  facts["scene"] = add_scene(outputs, built, a.output);
  const bool asked = machine || !a.report.empty();
  if (asked) {
    facts["speed"] = speed_facts(organ, stepping, machine ? &*machine : nullptr);
  } else if (organ.voxel_count <= kInertiaVoxels) {
    facts["speed"] = inertia_facts(organ, stepping);
  }
  if (!a.report.empty()) {
    const Quality quality = measure_quality(organ, built.input_m, progress);
    facts["quality"] = quality_facts(quality, built.report);
    add_report(outputs, a.report, facts, organ, built);
  }
  outputs.commit();
  if (a.json) {
    fmt::print("{}\n", facts.dump(2));
  } else {
    fmt::print("{}{}{}{}{}wrote         {}\n", build_text(facts), organ_text(facts["organ"]),
               asked ? speed_text(facts["speed"]) : "",
               facts.contains("speed") ? inertia_text(facts["speed"]) : "",
               scene_text(facts["scene"]), a.output);
  }
}

// A liver without its capsule would be entered at a quarter of the force over three times the way:
// whoever says only "liver" gets the organ as it is found.
template <typename HaveTissue>  // inputs, or groups of labels
void choose_capsule(const std::string& wanted, const std::vector<HaveTissue>& sources,
                    BuildOptions& options) {
  const bool all_layers = !options.layers.empty() && options.layer_course.of.empty();
  const bool any_liver = std::any_of(sources.begin(), sources.end(), [](const HaveTissue& source) {
    return source.tissue == "liver";
  });
  if (wanted == "auto") {
    options.capsule = any_liver && !all_layers ? "liver_capsule" : "";
    options.capsule_of = "liver";
  } else {
    options.capsule = wanted == "none" ? "" : wanted;
  }
  options.options_text += " --capsule " + (options.capsule.empty() ? "none" : options.capsule);
}

// PATH[:TISSUE[:PRIORITY]]; a file that has colons in its name is taken as it is.
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

// TISSUE:MM, each.
std::vector<Layer> parse_layers(const std::vector<std::string>& texts, const char* option) {
  std::vector<Layer> layers;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    double mm = 0;
    if (colon == std::string::npos || !CLI::detail::lexical_cast(text.substr(colon + 1), mm) ||
        !(mm > 0)) {
      refuse("{} '{}': expected TISSUE:MM", option, text);
    }
    layers.push_back({mm * 1e-3, text.substr(0, colon)});
  }
  return layers;
}

void choose_gaps(const BuildArguments& a, BuildOptions& options) {
  options.split = a.split_gaps;
  if (a.split_gaps) options.options_text += " --split-gaps";
  if (a.fill_gaps.empty()) return;
  const std::vector<Layer> gap = parse_layers({a.fill_gaps}, "--fill-gaps");
  constexpr double kWidestGapM = 0.1;  // wider ones lie between organs, not between their meshes
  if (!(gap.front().thickness_m > 0 && gap.front().thickness_m <= kWidestGapM)) {
    refuse("--fill-gaps '{}': expected a width of more than 0 and at most {:g} mm", a.fill_gaps,
           kWidestGapM * 1e3);
  }
  options.gap_tissue = find_tissue(options.own_tissues, gap.front().tissue).name;
  options.gap_m = gap.front().thickness_m;
  options.options_text += " --fill-gaps " + a.fill_gaps;
}

// Layers in place of one of the inputs' tissues.
template <typename HaveTissue>  // as above
void choose_layers(const BuildArguments& a, const std::vector<HaveTissue>& sources,
                   BuildOptions& options) {
  options.layers = parse_layers(a.layers, "--layer");
  if (a.layers.empty() && a.layers_of.empty()) return;
  const auto is_replaced = [&](const HaveTissue& source) { return source.tissue == a.layers_of; };
  if (a.layers.empty() || std::none_of(sources.begin(), sources.end(), is_replaced)) {
    refuse("--layers-of '{}': expected the tissue of an input, and --layer with it", a.layers_of);
  }
  options.layer_course = {static_cast<std::size_t>(a.layers_along[1] - 'x'),
                          a.layers_along[0] == '-', a.layers_of};
  options.options_text += fmt::format(" --layers-of {} --layers-along {} --layer {}", a.layers_of,
                                      a.layers_along, joined(a.layers));
}

void run_build_labels(const BuildArguments& a) {
  if (a.inputs.size() != 1) refuse("--recipe: {} inputs: expected one label map", a.inputs.size());
  const std::string& path = a.inputs.front();
  BuildOptions options = common_options(a, 1e-3);
  (void)read_file(a.recipe);  // one that is not there is told before a map is read for a minute
  const LabelMap map = read_label_map(path);
  const Recipe recipe = read_recipe(a.recipe, {path, map.names});
  for (const LabelGroup& group : recipe.groups) {
    (void)find_tissue(options.own_tissues, group.tissue);
  }
  for (const WallLayer& layer : recipe.wall) {
    options.wall.push_back(find_tissue(options.own_tissues, layer.tissue).name);
  }
  options.options_text += " --recipe " + std::filesystem::path(a.recipe).filename().string();
  if (options.name.empty()) {
    const std::string file = std::filesystem::path(path).filename().string();
    options.name = file.substr(0, file.find('.'));
  }
  choose_gaps(a, options);
  options.split = options.split || recipe.open_gaps;
  choose_layers(a, recipe.groups, options);
  choose_capsule(a.capsule, recipe.groups, options);
  Outputs outputs;
  finish([&](const BuildOptions& o,
             const Progress& p) { return build_labels(path, map, recipe, o, p); },
         options, a, outputs);
}

void run_build(const BuildArguments& a) {
  if (!a.recipe.empty()) return run_build_labels(a);
  for (const std::string& input : a.inputs) {
    if (is_label_map(input)) refuse("{}: expected --recipe, as this is a label map", input);
  }
  constexpr double kLeastScale = 1e-9, kMostScale = 1e9;
  if (!(a.scale >= kLeastScale && a.scale <= kMostScale)) {
    refuse("--scale {}: expected {} to {}", a.scale, kLeastScale, kMostScale);
  }
  const double metres_per_unit = kMetresPerUnit.at(a.units) * a.scale;
  BuildOptions options = common_options(a, metres_per_unit);
  options.wrap = a.wrap;
  options.options_text +=
      fmt::format(" --units {} --scale {}{}", a.units, a.scale, a.wrap ? " --wrap" : "");
  std::vector<Input> inputs;
  for (const std::string& text : a.inputs) {
    inputs.push_back(parse_input(text));
    (void)find_tissue(options.own_tissues, inputs.back().tissue);
    inputs.back().metres_per_unit = metres_per_unit;
    inputs.back().read = read_mesh(inputs.back().path);
  }
  if (options.name.empty()) {
    options.name = std::filesystem::path(inputs.front().path).stem().string();
  }
  choose_gaps(a, options);
  choose_layers(a, inputs, options);
  choose_capsule(a.capsule, inputs, options);
  Outputs outputs;
  finish([&](const BuildOptions& o, const Progress& p) { return build(std::move(inputs), o, p); },
         options, a, outputs);
}

// Facets about as large as voxels, since finer ones would move with the same voxel anyway; but no
// more than a few thousand of them.
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
  BuildOptions options = common_options(a, 1e-3);
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
  choose_capsule(a.capsule, inputs, options);
  finish([&](const BuildOptions& o, const Progress& p) { return build(std::move(inputs), o, p); },
         options, a, outputs);
}

// ---- hull ---------------------------------------------------------------------------------------

void run_hull(const HullArguments& a) {
  const ReadMesh read = read_mesh(a.input);
  std::vector<Vec> points_m;
  for (const Triangle& t : read.mesh.triangles) {
    for (const std::uint32_t i : t)
      points_m.push_back(read.mesh.points[i] * kMetresPerUnit.at(a.units));
  }
  const Hull hull = simple_hull(a.input, points_m, a.most_vertices);
  const std::string source = std::filesystem::path(a.input).filename().string();
  const std::string text = hull_toml(hull, source, read.sha256);
  write_file(a.output, text);
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

// ---- labels -------------------------------------------------------------------------------------

void run_labels(const FileArguments& a) {
  const LabelMap map = read_label_map(a.file);
  warn(map.notes);
  const double volume_ml = voxel_volume_m3(map) * 1e6;
  Json list = Json::array();
  for (const LabelCount& each : count_labels(map)) {
    const auto name = map.names.find(each.label);
    list.push_back({{"label", each.label},
                    {"name", name != map.names.end() ? name->second : ""},
                    {"voxels", each.voxels},
                    {"volume_ml", static_cast<double>(each.voxels) * volume_ml},
                    {"centroid_mm",
                     {each.centroid_m.x * 1e3, each.centroid_m.y * 1e3, each.centroid_m.z * 1e3}}});
  }
  if (a.json) {
    const Json facts = {
        {"file", a.file}, {"size", map.size}, {"notes", map.notes}, {"labels", list}};
    fmt::print("{}\n", facts.dump(2));
    return;
  }
  fmt::print("{}: {} x {} x {} voxels of {:.6g} mm3\n{:>8}{:>12}{:>14}\n", a.file, map.size[0],
             map.size[1], map.size[2], volume_ml * 1e3, "label", "voxels", "ml");
  for (const Json& each : list) {
    const std::string name = each["name"].get<std::string>();
    fmt::print("{:>8}{:>12}{:>14.6g}{}\n", each["label"].get<int>(),
               each["voxels"].get<std::size_t>(), each["volume_ml"].get<double>(),
               name.empty() ? "" : "  " + name);
  }
}

// ---- info and check -----------------------------------------------------------------------------

void run_info(const FileArguments& a) {
  const std::string bytes = read_file(a.file);
  const auto view = std::as_bytes(std::span(bytes));
  const Json facts = organ_facts(open_organ(a.file, view), view);
  fmt::print("{}", a.json ? facts.dump(2) + "\n" : organ_text(facts));
}

void run_check(const FileArguments& a) {
  const std::string bytes = read_file(a.file);
  const SumCheck sum = check_sum(a.file, bytes);
  const Organ organ = open_organ(a.file, std::as_bytes(std::span(bytes)));
  if (sum == SumCheck::kDiffers) {
    refuse("{}: the bytes are whole, but not those of {}{}: expected the file that lay beside it",
           a.file, a.file, kSumEnding);
  }
  Sizes need{};
  if (const Status status = sizes(organ, Config{}, need); status != Status::kOk) {
    refuse("{}: {} voxels: {}", a.file, organ.voxel_count, status_name(status));
  }
  if (a.json) {
    const Json facts = {{"file", a.file},
                        {"ok", true},
                        {"voxels", organ.voxel_count},
                        {"hash", fmt::format("{:016x}", organ.hash)},
                        {"bytes_are_those_built", !organ.content_sha256.empty()},
                        {"sum_beside_it_agrees", sum == SumCheck::kSame}};
    fmt::print("{}\n", facts.dump(2));
    return;
  }
  fmt::print(
      "{}: ok: {} voxels, hash {:016x}, {}{}\n", a.file, organ.voxel_count, organ.hash,
      organ.content_sha256.empty() ? "without a sum of its bytes" : "the bytes that were built",
      sum == SumCheck::kSame ? ", those of the sum beside it" : "");
}

// ---- commands -----------------------------------------------------------------------------------

void add_build(CLI::App& app, BuildArguments& a) {
  CLI::App* command = app.add_subcommand("build", "Make an organ file from meshes");
  command->footer(
      "Examples:\n"
      "  stylet-organ build Liver.stl --units mm --voxel-mm 5 -o liver.organ\n"
      "  stylet-organ build wall.stl:muscle Liver.stl:liver:1 --capsule liver_capsule -o "
      "torso.organ\n"
      "  stylet-organ build scan.ply --voxels-across 60 --fix 'x>95%' --wrap -o scan.organ\n"
      "  stylet-organ build seg.nii.gz --recipe totalsegmentator.toml -o patient.organ");
  command
      ->add_option(
          "inputs", a.inputs,
          "Meshes (.obj .stl .ply .off), each PATH[:TISSUE[:PRIORITY]]; tissue liver and "
          "priority 0 unless given; the higher priority wins a voxel; with --recipe one label map")
      ->type_name("FILE")
      ->required();
  command->add_option("--units", a.units, "Unit of the meshes")
      ->type_name("UNIT")
      ->check(CLI::IsMember(kMetresPerUnit))
      ->capture_default_str();
  command->add_option("--scale", a.scale, "Factor on top of the unit")
      ->type_name("NUMBER")
      ->capture_default_str();
  auto* wrap = command->add_flag(
      "--wrap", a.wrap, "Last resort: replace each mesh by a closed skin around it (adds volume)");
  command
      ->add_option("--recipe", a.recipe,
                   "The input is a label map (see labels --help); this TOML file "
                   "says which labels are which tissue")
      ->type_name("FILE")
      ->excludes(wrap);
  command
      ->add_option("--layer", a.layers,
                   "TISSUE:THICKNESS_MM, repeatable, from the outside; the last fills the rest")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command
      ->add_option("--fill-gaps", a.fill_gaps,
                   "TISSUE:MM: gaps between inputs up to so wide become this tissue")
      ->type_name("GAP");
  command->add_flag("--split-gaps", a.split_gaps,
                    "Parts that lie in one voxel without touching get a voxel each, so that gaps "
                    "from a third of a voxel on do not glue");
  command->add_option("--layers-of", a.layers_of, "Tissue that the layers take the place of")
      ->type_name("TISSUE");
  command->add_option("--layers-along", a.layers_along, "The way in through the layers")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"+x", "-x", "+y", "-y", "+z", "-z"}))
      ->capture_default_str();
  add_common(*command, a);
  command->callback([&a] { run_build(a); });
}

void add_phantom(CLI::App& app, PhantomArguments& a) {
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
  command->add_option("--tissue", a.tissue, "What it is made of (default: gel; of liver: liver)")
      ->type_name("TISSUE");
  command
      ->add_option("--layer", a.layers,
                   "Layered: TISSUE:THICKNESS_MM along +x, repeatable; the last fills the rest")
      ->type_name("LAYER")
      ->allow_extra_args(false);
  command->add_option("--mesh-out", a.mesh_out, "Also write the surface, in metres, as OFF")
      ->type_name("FILE");
  add_common(*command, a);
  command->callback([&a, command] {
    a.size_given = command->count("--size-mm") > 0;
    a.diameter_given = command->count("--diameter-mm") > 0;
    run_phantom(a);
  });
}

void add_hull(CLI::App& app, HullArguments& a) {
  CLI::App* command = app.add_subcommand("hull", "Make an obstacle, as TOML, of a mesh");
  command->footer(
      "Example:\n"
      "  stylet-organ hull rib.stl --units mm --max-vertices 64 -o rib.toml\n"
      "The body is convex: hollows of the mesh are filled. Coordinates stay those of the mesh.");
  command->add_option("input", a.input, "Mesh (.obj .stl .ply .off)")
      ->type_name("FILE")
      ->required();
  command->add_option("--units", a.units, "Unit of the mesh")
      ->type_name("UNIT")
      ->check(CLI::IsMember(kMetresPerUnit))
      ->capture_default_str();
  command->add_option("--max-vertices", a.most_vertices, "Vertices to keep")
      ->type_name("NUMBER")
      ->check(cli::between(kLeastHullVertices, std::size_t{kMaxHullVertices}))
      ->capture_default_str();
  command->add_option("-o,--output", a.output, "TOML file to write")->type_name("FILE")->required();
  command->add_flag("--json", a.json, "Report as one JSON object on standard output");
  command->callback([&a] { run_hull(a); });
}

void add_labels(CLI::App& app, FileArguments& a) {
  CLI::App* command = app.add_subcommand("labels", "Show what a label map holds");
  command
      ->add_option("file", a.file,
                   "Label map: .nrrd .nhdr .nii .nii.gz .mha .mhd .inr .inr.gz, a DICOM "
                   "segmentation (.dcm), or the folder of a DICOM series")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", a.json, "As one JSON object");
  command->footer("Example:\n  stylet-organ labels seg.nii.gz");
  command->callback([&a] { run_labels(a); });
}

void add_info_and_check(CLI::App& app, FileArguments& info, FileArguments& check) {
  CLI::App* show = app.add_subcommand("info", "Show what an organ file holds and needs");
  show->add_option("file", info.file, "Organ file")->type_name("FILE")->required();
  show->add_flag("--json", info.json, "As one JSON object");
  show->footer("Example:\n  stylet-organ info liver.organ --json");
  show->callback([&info] { run_info(info); });
  CLI::App* test = app.add_subcommand("check", "Check that an organ file is whole");
  test->add_option("file", check.file, "Organ file")->type_name("FILE")->required();
  test->add_flag("--json", check.json, "As one JSON object");
  test->footer(
      "Example:\n  stylet-organ check liver.organ\n"
      "Every value is checked as the kernel does, then every byte by the SHA-256 in the file; with "
      "FILE.sha256 beside it (build --sum), whether it is that file.");
  test->callback([&check] { run_check(check); });
}

int run(int argc, char** argv) {
  CLI::App app{"Makes and checks organ files, the anatomy that stylet runs on", "stylet-organ"};
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", kToolVersion);
  cli::add_text_options(app, kToolVersion);
  app.footer(
      "Examples:\n"
      "  stylet-organ build Liver.stl --units mm --voxel-mm 5 -o liver.organ\n"
      "  stylet-organ phantom liver --voxel-mm 5 -o liver-phantom.organ\n"
      "  stylet-organ info liver.organ\n"
      "Exit codes: 0 done, 1 input refused or file damaged, 2 wrong usage.");
  BuildArguments build_arguments;
  PhantomArguments phantom_arguments;
  HullArguments hull_arguments;
  FileArguments labels_arguments, info_arguments, check_arguments;
  add_build(app, build_arguments);
  add_phantom(app, phantom_arguments);
  add_hull(app, hull_arguments);
  add_labels(app, labels_arguments);
  add_info_and_check(app, info_arguments, check_arguments);
  try {
    cli::refuse_separate_values(app, argc, argv);
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      throw CLI::RequiredError("A command (build, phantom, hull, labels, info or check)");
    }
    if (std::fflush(stdout) != 0) refuse("standard output: {}", std::strerror(errno));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "stylet-organ: out of memory: expected a coarser voxel edge, a smaller input or a "
               "larger --memory-limit\n");
    return kExitRefused;
  } catch (const std::exception& error) {
    fmt::print(stderr, "stylet-organ: {}\n", error.what());
    return kExitRefused;
  }
  return 0;
}

}  // namespace
}  // namespace stylet::bake

int main(int argc, char** argv) {
  // A limit of file sizes is a full disk: the write says so, and nothing half written stays.
  (void)std::signal(SIGXFSZ, SIG_IGN);
  return stylet::bake::run(argc, argv);
}
