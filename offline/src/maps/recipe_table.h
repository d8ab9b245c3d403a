// SPDX-License-Identifier: GPL-3.0-or-later
// A recipe from a table, for programs whose recipe is not in a file. Apart from recipe.h, as toml++
// takes a second to compile.
#pragma once

#include "base/toml_file.h"
#include "maps/recipe.h"

namespace stylet::offline {

// `file` names the table in refusals. Promise: that of read_recipe.
Recipe recipe_of(const toml::table& root, const std::string& file, const FileNames& of_map = {});

}  // namespace stylet::offline
