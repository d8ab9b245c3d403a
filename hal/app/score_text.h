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

struct ScoredAttempt {
  std::string name;  // of the recording, or empty
  std::vector<hal::Target> targets;
  std::vector<std::string> layers;  // names of the organ's materials; empty: not known
  hal::Score score;
};

std::vector<std::string> layer_names(const Organ& organ);

// A row a figure, a column an attempt.
std::string score_table(std::span<const ScoredAttempt> attempts);
nlohmann::ordered_json score_json(const ScoredAttempt& attempt);
// Seven digits are what a float has; not a number is null.
nlohmann::ordered_json json_number(float value);

}  // namespace stylet::app
