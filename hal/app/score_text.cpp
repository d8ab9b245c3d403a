// SPDX-License-Identifier: Apache-2.0
#include "hal/app/score_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace stylet::app {
namespace {

using Json = nlohmann::ordered_json;
using CellText = std::function<std::string(const ScoredRecording&)>;

std::string layer_name(const ScoredRecording& attempt, std::uint32_t layer) {
  if (layer < attempt.layers.size()) return attempt.layers[layer];
  return layer == kNoLayer ? "outside" : fmt::format("layer {}", layer);
}

// The first rows of every table.
struct Figure {
  const char* label;
  CellText cell;
};
std::vector<Figure> figures() {
  const auto one = [](const char* format, double value) {
    return fmt::format(fmt::runtime(format), value);
  };
  return {
      {"duration, s", [=](const ScoredRecording& a) { return one("{:.2f}", a.score.duration_s); }},
      {"way of the tip, mm",
       [=](const ScoredRecording& a) { return one("{:.1f}", a.score.path_m * 1e3); }},
      {"  in tissue, mm",
       [=](const ScoredRecording& a) { return one("{:.1f}", a.score.depth_path_m * 1e3); }},
      {"withdrawals",
       [](const ScoredRecording& a) { return fmt::format("{}", a.score.withdrawals); }},
      {"peak force, N",
       [=](const ScoredRecording& a) {
         return one("{:.2f}", static_cast<double>(a.score.peak_force_n));
       }},
      {"  across the course, N",
       [=](const ScoredRecording& a) {
         return one("{:.2f}", static_cast<double>(a.score.peak_lateral_n));
       }},
      {"mean force in tissue, N",
       [=](const ScoredRecording& a) { return one("{:.2f}", a.score.mean_force_n); }},
      {"faults of the guard",
       [](const ScoredRecording& a) { return fmt::format("{}", a.score.faults); }},
      {"punctures",
       [](const ScoredRecording& a) { return fmt::format("{}", a.score.puncture_count); }},
  };
}

CellText puncture_cell(std::size_t index) {
  return [index](const ScoredRecording& attempt) -> std::string {
    if (index >= attempt.score.punctures.size()) return "";
    const hal::PunctureScore& puncture = attempt.score.punctures[index];
    return fmt::format("{} {:.2f} N", layer_name(attempt, puncture.layer),
                       static_cast<double>(puncture.force_n));
  };
}

const char* verdict(const hal::Target& target, const hal::TargetScore& score) {
  if (target.forbidden) return score.reached ? "touched" : "clear";
  return score.reached ? "reached" : "missed";
}

CellText target_cell(const std::string& name) {
  return [name](const ScoredRecording& attempt) -> std::string {
    for (std::size_t i = 0; i < attempt.targets.size(); ++i) {
      if (attempt.targets[i].name != name) continue;
      const hal::TargetScore& score = attempt.score.targets[i];
      return fmt::format("{:.1f} mm {}", static_cast<double>(score.closest_m) * 1e3,
                         verdict(attempt.targets[i], score));
    }
    return "";
  };
}

using Row = std::vector<std::string>;
Row row_of(const std::string& label, const CellText& cell,
           std::span<const ScoredRecording> attempts) {
  Row row = {label};
  for (const ScoredRecording& each : attempts) row.push_back(cell(each));
  return row;
}

std::vector<Row> rows_of(std::span<const ScoredRecording> attempts) {
  std::vector<Row> rows = {row_of(
      "score", [](const ScoredRecording& attempt) { return attempt.name; }, attempts)};
  for (const Figure& each : figures()) rows.push_back(row_of(each.label, each.cell, attempts));
  std::size_t punctures = 0;
  for (const ScoredRecording& each : attempts)
    punctures = std::max(punctures, each.score.punctures.size());
  for (std::size_t i = 0; i < punctures; ++i) {
    rows.push_back(row_of(fmt::format("  {}", i + 1), puncture_cell(i), attempts));
  }
  std::vector<std::string> seen;
  for (const ScoredRecording& attempt : attempts) {
    for (const hal::Target& target : attempt.targets) {
      if (std::find(seen.begin(), seen.end(), target.name) != seen.end()) continue;
      seen.push_back(target.name);
      rows.push_back(row_of((target.forbidden ? "keep out of " : "target ") + target.name,
                            target_cell(target.name), attempts));
    }
  }
  return rows;
}

}  // namespace

std::vector<std::string> layer_names(const Organ& organ) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    names.emplace_back(organ_material(organ, i).name);
  }
  return names;
}

std::string score_table(std::span<const ScoredRecording> attempts) {
  const std::vector<Row> rows = rows_of(attempts);
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
      std::size_t width = 0;
      for (const Row& each : rows) width = std::max(width, each[column].size());
      line += column == 0 ? fmt::format("{:<{}}", row[column], width)
                          : fmt::format("  {:>{}}", row[column], width);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

Json json_number(float value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.7g}", static_cast<double>(value)));
}

Json score_json(const ScoredRecording& attempt) {
  const hal::Score& score = attempt.score;
  Json out = {{"duration_s", json_number(static_cast<float>(score.duration_s))},
              {"path_m", json_number(static_cast<float>(score.path_m))},
              {"depth_path_m", json_number(static_cast<float>(score.depth_path_m))},
              {"withdrawals", score.withdrawals},
              {"peak_force_n", json_number(score.peak_force_n)},
              {"peak_lateral_n", json_number(score.peak_lateral_n)},
              {"mean_force_n", json_number(static_cast<float>(score.mean_force_n))},
              {"faults", score.faults},
              {"puncture_count", score.puncture_count},
              {"punctures", Json::array()},
              {"targets", Json::array()}};
  for (const hal::PunctureScore& each : score.punctures) {
    out["punctures"].push_back({{"tick", each.tick},
                                {"needle", each.needle},
                                {"layer", layer_name(attempt, each.layer)},
                                {"force_n", json_number(each.force_n)}});
  }
  for (std::size_t i = 0; i < attempt.targets.size(); ++i) {
    out["targets"].push_back({{"name", attempt.targets[i].name},
                              {"forbidden", attempt.targets[i].forbidden},
                              {"closest_m", json_number(score.targets[i].closest_m)},
                              {"reached", score.targets[i].reached}});
  }
  return out;
}

}  // namespace stylet::app
