// SPDX-License-Identifier: Apache-2.0
// Scores of attempts, for people and for machines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "hal/score/score.h"
#include "stylet/organ.h"

namespace stylet::app {

struct ScoredRecording {
  std::string name;  // of the recording; may be empty
  std::vector<hal::Target> targets;
  std::vector<std::string> layers;  // names of the organ's materials; empty: unknown
  hal::Score score;
};

std::vector<std::string> layer_names(const Organ& organ);

// One row for each figure, one column for each attempt.
std::string score_table(std::span<const ScoredRecording> attempts);
nlohmann::ordered_json score_json(const ScoredRecording& attempt);
// A float has seven digits; NaN and infinities become null.
nlohmann::ordered_json json_number(float value);

}  // namespace stylet::app
