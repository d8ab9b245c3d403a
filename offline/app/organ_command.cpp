// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_command.h"

#include <sys/resource.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file.h"
#include "base/refusal.h"
#include "commands.h"
#include "progress_bar.h"
#include "report/info.h"
#include "report/page.h"
#include "report/quality.h"
#include "report/speed.h"
#include "scene_files.h"
#include "stylet/command_texts.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

const std::map<std::string, Inertia> kInertias{{"true_mass", Inertia::kTrueMass},
                                               {"added_mass", Inertia::kAddedMass}};

// The options that set the voxel edge, or what determines it.
void add_resolution(CLI::App& command, CommonArguments& a) {
  auto* edge = command.add_option("--voxel-mm", a.voxel_mm, "Edge of a voxel")
                   ->type_name("MM")
                   ->capture_default_str();
  auto* across = command
                     .add_option("--voxels-across", a.voxels_across,
                                 "Number of voxels along the longest side, instead of their edge")
                     ->type_name("NUMBER")
                     ->check(cli::between(1U, 65535U))
                     ->excludes(edge);
  auto* fit = command.add_option("--fit", a.fit,
                                 "Rate of the loop, such as 1kHz: choose the finest voxel edge at "
                                 "which a tick takes at most half of the period");
  fit->type_name("RATE")->excludes(edge)->excludes(across);
  command
      .add_option("--machine", a.machine,
                  "CSV that stylet-bench wrote on the machine that is to run the organ (default: "
                  "this machine is measured)")
      ->type_name("FILE")
      ->needs(fit);
  command
      .add_option("--inertia", a.inertia,
                  "loop.inertia of the scene that will run the organ; --fit and the report of "
                  "speed and mass depend on it")
      ->type_name("INERTIA")
      ->transform(CLI::CheckedTransformer(kInertias).description("{true_mass,added_mass}"))
      ->default_str("true_mass");
  command
      .add_option("--substeps", a.substeps,
                  "loop.substeps of the scene that will run the organ; --fit and the report of "
                  "speed and mass depend on it (default: 1; with added_mass 2)")
      ->type_name("NUMBER")
      ->check(cli::between(1U, kMaxSubsteps));
}

// What there is besides voxels of one size that are joined.
void add_surfaces_and_sizes(CLI::App& command, CommonArguments& a) {
  command
      .add_option("--membrane", a.membranes,
                  "Surface thinner than a voxel, with its tissue: MESH:TISSUE, in the frame and "
                  "units of the meshes; or x=MM:TISSUE, also with y and z, a plane through the "
                  "whole organ. The needle meets it where it lies. Can be given several times")
      ->type_name("MEMBRANE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--slide", a.slides,
          "Two tissues of inputs that are not joined, but lie on each other, slide and come "
          "apart: TISSUE:GROUND or TISSUE:GROUND:FRICTION, with Coulomb's coefficient, 0.1 "
          "by default. Can be given several times")
      ->type_name("SLIDE")
      ->allow_extra_args(false);
  command
      .add_option("--refine", a.refine,
                  "Where voxels are finer: way:X,Y,Z:X,Y,Z:RADIUS_MM, around a needle's way from "
                  "entry to target; box:X,Y,Z:X,Y,Z; labels:TISSUE,TISSUE, where these tissues "
                  "are; surface, the outer one; in mm of the organ's frame. Each may end in "
                  ":LEVELS, 1 to 3: how many times the edge is halved there. Can be given several "
                  "times")
      ->type_name("WHERE")
      ->allow_extra_args(false);
}

// Limits the heap and our private mappings; allocations beyond fail as if memory were exhausted.
void limit_memory(std::uint64_t bytes) {
  constexpr std::uint64_t kLeast = std::uint64_t{64} << 20U;
  if (bytes == 0) return;
  if (bytes < kLeast) refuse("--memory-limit {} bytes: expected at least 64MiB", bytes);
  const rlimit limit = {bytes, bytes};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) {
    refuse("--memory-limit: the system refuses this limit: {}", std::strerror(errno));
  }
}

// The machine whose speed --fit uses.
std::optional<Machine> chosen_machine(const CommonArguments& a) {
  if (a.fit.empty()) return std::nullopt;
  (void)period_of(a.fit);  // refuses a wrong rate before the measurement, which takes time
  return a.machine.empty() ? measure_machine(progress_bar()) : read_machine(a.machine);
}

// Refuses at once what would otherwise be refused after minutes of work.
void check_outputs(const CommonArguments& a) {
  (void)checked_output(a.output);
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

// A build tells what a hand feels of the step's inertia. For organs with more voxels than this,
// too many for a tick of a millisecond, only with --fit or --report, because it takes seconds.
constexpr std::uint32_t kInertiaVoxels = 100'000;

}  // namespace

void add_common(CLI::App& command, CommonArguments& a) {
  command.add_option("-o,--output", a.output, "Organ file to write")->type_name("FILE")->required();
  command.add_option("--name", a.name, "Name of the organ (default: that of the first input)");
  add_resolution(command, a);
  command
      .add_option("--capsule", a.capsule,
                  "Tissue of the voxels at the outer surface, or none; auto: liver_capsule on "
                  "liver, none on other tissues")
      ->type_name("TISSUE")
      ->capture_default_str();
  command
      .add_option("--fix", a.fix,
                  "Region that is held in space, or none: x>MM or x<MM, also with y and z, where "
                  "MM may be a percentage of the extent such as 90%; box:X0,Y0,Z0,X1,Y1,Z1; "
                  "touching:MESH. Can be given several times: all of them are held")
      ->type_name("REGION")
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      .add_option(
          "--crop", a.crop,
          "Region to which the organ is cut: x>MM or x<MM, also with y and z, where MM may be a "
          "percentage of the extent such as 90%; box:X0,Y0,Z0,X1,Y1,Z1. Can be given several "
          "times: what lies in all of them stays. The organ is held where it is cut")
      ->type_name("REGION")
      ->allow_extra_args(false);
  add_surfaces_and_sizes(command, a);
  command.add_option("--materials", a.materials, "TOML file with tissues of your own")
      ->type_name("FILE");
  command
      .add_option("--report", a.report,
                  "Folder for a quality report: report.html with pictures, report.json")
      ->type_name("FOLDER");
  command
      .add_option("--memory-limit", a.memory_limit_bytes,
                  "Memory that may be used, such as 2GiB; a build that needs more is refused "
                  "(default: no limit)")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(false));
  command.add_flag("--sum", a.sum,
                   "Also write the file's SHA-256 to OUTPUT.sha256, for stylet-organ check and for "
                   "sha256sum -c");
  command.add_flag("--json", a.json, "Report as one JSON object on standard output");
}

BuildOptions limited_options(const CommonArguments& a, const MeshUnits& units) {
  limit_memory(a.memory_limit_bytes);
  BuildOptions options = common_options(a, units);
  options.measured = !a.report.empty();
  return options;
}

void finish(const std::function<Built(const BuildOptions&, const Progress&)>& make,
            BuildOptions options, const CommonArguments& a, Outputs& outputs) {
  check_outputs(a);
  const Stepping stepping = stepping_of(a);
  const std::optional<Machine> machine = chosen_machine(a);
  if (machine) {
    options.most_voxels = most_voxels(*machine, stepping);
  }
  const Progress progress = progress_bar();
  const Built built = make(options, progress);
  outputs.add(a.output, built.bytes);
  if (a.sum) {
    outputs.add(a.output + kSumEnding, sum_line(a.output, built.bytes));
  } else if (has_sum_line(a.output)) {  // the checksum of an older organ
    outputs.remove(a.output + kSumEnding);
  }
  warn(built.report.warnings);
  const Organ organ = open_organ(a.output, built.bytes);
  warn(held_findings(lattice_pieces(organ)));
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
  tell_of_leftovers(outputs.commit());
  if (a.json) {
    fmt::print("{}\n", facts.dump(2));
  } else {
    fmt::print("{}{}{}{}{}wrote         {}\n", build_text(facts), organ_text(facts["organ"]),
               asked ? speed_text(facts["speed"]) : "",
               facts.contains("speed") ? inertia_text(facts["speed"]) : "",
               scene_text(facts["scene"]), a.output);
  }
}

}  // namespace stylet::offline
