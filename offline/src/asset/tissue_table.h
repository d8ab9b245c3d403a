// SPDX-License-Identifier: GPL-3.0-or-later
// Tissues from a table, for programs whose tissues are not in a file. Apart from materials.h, as
// toml++ takes a second to compile.
#pragma once

#include "asset/materials.h"
#include "base/toml_file.h"

namespace stylet::offline {

// `file` names the table in refusals, and is the tissues' source unless they say their own.
std::vector<Tissue> tissues_of(const toml::table& root, const std::string& file);

}  // namespace stylet::offline
