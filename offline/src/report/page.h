// SPDX-License-Identifier: GPL-3.0-or-later
// The quality report of an organ: report.html, one page that needs nothing else, and report.json,
// the same facts for machines.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "asset/organ_shape.h"
#include "base/outputs.h"
#include "pipeline/build.h"

namespace stylet::bake {

// `facts` has the keys of build_facts, and `organ` and `quality` (organ_facts, quality_facts).
// Of `built` come the input's surface, obstacles and targets.
void add_report(Outputs& outputs, const std::filesystem::path& folder,
                const nlohmann::ordered_json& facts, const Organ& organ, const Built& built);

}  // namespace stylet::bake
