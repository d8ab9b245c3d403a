// SPDX-License-Identifier: GPL-3.0-or-later
// Which labels of a map become which tissue: a TOML file.
//
//   [names]            # optional: names of labels
//   liver = 5
//   [tissues]          # tissue = labels, by number or name
//   liver = ["liver"]
//   vessel = [52, 63]
//   [crop]             # optional: what is farther from these labels, along the map's axes, is left
//   out around = ["liver"] margin_mm = 20 [surface]          # optional smoothing = 10     # rounds
//   of Taubin's filter, 0 to 100
//
// Labels that no tissue asks for are left out of the organ.
// Promise: a recipe is taken whole or refused with `file:line: key: ...`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stylet::bake {

struct LabelGroup {
  std::string tissue;
  std::vector<std::uint16_t> labels;
};

struct Recipe {
  std::map<std::uint16_t, std::string> names;
  std::vector<LabelGroup> groups;  // by tissue, in the alphabet's order; no label is in two of them
  std::vector<std::uint16_t> crop_around = {};  // empty: the whole map
  double crop_margin_m = 0;
  int smoothing = 10;
};

Recipe read_recipe(const std::filesystem::path& toml_file);

}  // namespace stylet::bake
