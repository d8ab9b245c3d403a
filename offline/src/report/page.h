// SPDX-License-Identifier: GPL-3.0-or-later
// The quality report of an organ: report.html, a page that needs no other files, and report.json,
// the same facts for machines.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "asset/organ_shape.h"
#include "base/outputs.h"
#include "pipeline/build.h"

namespace stylet::offline {

// `facts` has the keys of build_facts, and `organ` and `quality` (organ_facts, quality_facts).
// `built` provides the input's surface, the obstacles and the targets.
void add_report(Outputs& outputs, const std::filesystem::path& folder,
                const nlohmann::ordered_json& facts, const Organ& organ, const Built& built);

}  // namespace stylet::offline
