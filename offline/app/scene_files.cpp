// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_files.h"

#include <fmt/format.h>

#include <tuple>

namespace stylet::offline {

using Json = nlohmann::ordered_json;

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

}  // namespace stylet::offline
