// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ labels: shows what a label map contains.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "maps/label_map.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

void add_labels(CLI::App& app) {
  const auto arguments = std::make_shared<FileArguments>();
  FileArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("labels", "Show what a label map holds");
  command
      ->add_option("file", a.file,
                   "Label map: .nrrd .nhdr .nii .nii.gz .mha .mhd .inr .inr.gz, a DICOM "
                   "segmentation (.dcm), or the folder of a DICOM series")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", a.json, "Print one JSON object");
  command->footer("Example:\n  stylet-organ labels seg.nii.gz");
  command->callback([arguments] { run_labels(*arguments); });
}

}  // namespace stylet::offline
