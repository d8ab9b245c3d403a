// SPDX-License-Identifier: Apache-2.0
// Any text as a recipe, for a map with names of its own. It is refused with one line that names the
// file, or gives tissues with finite numbers, and each label belongs to only one tissue.
#include <cmath>
#include <set>

#include "base/refusal.h"
#include "maps/recipe.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  const test::InputFile file({data, size}, ".toml");
  const offline::FileNames names = {"map", {{1, "liver"}, {5, "Portal vein"}, {52, "aorta"}}};
  try {
    const offline::Recipe recipe = offline::read_recipe(file.path(), names);
    test::promise(!recipe.groups.empty(), "a recipe without a tissue");
    std::set<std::uint16_t> taken;
    for (const offline::LabelGroup& group : recipe.groups) {
      test::promise(!group.labels.empty(), "a tissue without labels");
      for (const std::uint16_t label : group.labels) {
        test::promise(label > 0 && taken.insert(label).second, "a label in two tissues");
      }
    }
    test::promise(
        std::isfinite(recipe.crop_margin_m) && recipe.crop_margin_m >= 0 && recipe.smoothing >= 0,
        "a recipe with a number that is not finite");
    for (const offline::WallLayer& layer : recipe.wall) {
      test::promise(std::isfinite(layer.thickness_m) && layer.thickness_m >= 0,
                    "a wall of no thickness");
    }
  } catch (const offline::Refusal& refused) {
    test::promise_one_line(refused.what());
    test::promise(std::string_view(refused.what()).find(file.path()) == 0,
                  "a refusal that does not name the file");
  }
  return 0;
}
