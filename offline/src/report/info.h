// SPDX-License-Identifier: GPL-3.0-or-later
// What an organ file contains and what a build found, as text for people and JSON for machines. The
// text is made from the JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "pipeline/build.h"
#include "stylet/organ.h"

namespace stylet::offline {

// Opens the bytes, or refuses them with one line that begins with `file`.
Organ open_organ(const std::string& file, std::span<const std::byte> bytes);

nlohmann::ordered_json organ_facts(const Organ& organ, std::span<const std::byte> bytes);
std::string organ_text(const nlohmann::ordered_json& facts);

nlohmann::ordered_json build_facts(const BuildReport& report);
std::string build_text(const nlohmann::ordered_json& facts);

}  // namespace stylet::offline
