// SPDX-License-Identifier: Apache-2.0
// What a user may say of finer voxels, in an option or a recipe, and what is refused.
#include <gmock/gmock.h>

#include "maps/recipe_table.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "pipeline/settings.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::LabelMap;
using offline::Recipe;
using testing::AllOf;
using testing::HasSubstr;

TEST(RefineTexts, AreReadAndWritten) {
  const auto text = [](const std::string& given) {
    return offline::text_of(offline::parse_refinement(given, "--refine"));
  };
  EXPECT_EQ(text("way:1,-2,3.50:4,5,6:7"), "way:1,-2,3.5:4,5,6:7:1");
  EXPECT_EQ(text("box:0,0,0:1,2,3:2"), "box:0,0,0:1,2,3:2");
  EXPECT_EQ(text("labels:tumour,skin:3"), "labels:tumour,skin:3");
  EXPECT_EQ(text("surface"), "surface:1");
  for (const char* wrong : {"",
                            "surface:0",
                            "surface:4",
                            "surface:1.5",
                            "surface:",
                            "surface:1:1",
                            "way:0,0,0:1,1,1",
                            "way:0,0,0:1,1,1:0",
                            "way:0,0,0:1,1,1:-2",
                            "way:0,0:1,1,1:2",
                            "way:0,0,0:1,1,nan:2",
                            "box:0,0,0:1,1,0",
                            "box:0,0,0:0,1,1",
                            "box:0,0,0:1,1",
                            "box:0,0,0:1,1,1:1:1",
                            "labels:",
                            "labels:a,",
                            "labels:a:b",
                            "tissue:a",
                            "Surface",
                            "way:0,0,0:1,1,1:inf"}) {
    EXPECT_THAT(refusal_of([&] { (void)text(wrong); }),
                AllOf(HasSubstr("--refine '" + std::string(wrong) + "': expected way:"),
                      HasSubstr("1 to 3")))
        << wrong;
  }
}

BuildOptions options_for(const offline::Settings& settings, const Recipe& recipe) {
  BuildOptions options = offline::common_options(settings, {1e-3});
  const std::string path = "map.nrrd", text = "r.toml";
  offline::choose_for_labels(settings, {path, text}, recipe, options);
  return options;
}

Recipe recipe_from(const std::string& text) {
  return offline::recipe_of(toml::parse(text), "r.toml", {});
}

std::string refusal_for(const offline::Settings& settings, const std::string& recipe) {
  return refusal_of([&] { (void)options_for(settings, recipe_from(recipe)); });
}

constexpr const char* kTissues = "[tissues]\nkidney = [1]\nfat = [2]\n";

TEST(RefineTexts, TissuesAndRecipesAreChecked) {
  offline::Settings settings;
  settings.refine = {"labels:kidney,bone"};
  EXPECT_EQ(refusal_for(settings, kTissues),
            "--refine 'labels:kidney,bone': bone: expected a tissue of this organ: fat, kidney");
  settings.layers = {"skin:2", "fat:3"};
  settings.layers_of = "kidney";
  settings.refine = {"labels:kidney,skin"};
  EXPECT_EQ(refusal_for(settings, kTissues), "");
  settings = {};
  const std::string table = kTissues + std::string("[refine]\n");
  EXPECT_THAT(refusal_for(settings, table + "where = [\"surfaces\"]\n"),
              HasSubstr("r.toml:5: [refine] 'surfaces': expected way:"));
  for (const char* wrong : {"where = 3", "where = [3]", "", "where = []\nlevels = 2"}) {
    EXPECT_THAT(refusal_for(settings, table + wrong), HasSubstr("[refine]")) << wrong;
  }
  EXPECT_EQ(refusal_for(settings, table + "where = []"), "");
}

TEST(RefineTexts, WhatIsTooFineIsRefused) {
  const auto refusal = [](offline::Vec size_m, double voxel_mm) {
    BuildOptions options;
    options.voxel_edge_m = voxel_mm * 1e-3;
    options.refinements = {offline::parse_refinement("surface:3", "--refine")};
    return refusal_of([&] {
      (void)build_quietly({input_of(box_mesh({0, 0, 0}, size_m), 1)}, options);
    });
  };
  EXPECT_THAT(refusal({1, 0.8, 0.6}, 4),
              AllOf(HasSubstr("halved 3 times: 0.5 mm, and 3840000000 lattice cells"),
                    HasSubstr("expected at least 0.1 mm and at most 67108864 cells: fewer LEVELS, "
                              "or a larger voxel edge")));
  EXPECT_THAT(refusal({0.01, 0.01, 0.01}, 0.7), HasSubstr("halved 3 times: 0.0875 mm"));
  EXPECT_EQ(refusal({0.01, 0.01, 0.01}, 0.8), "");
  // Planes of all levels have 16 bits: 15 of level 0's and three between levels.
  EXPECT_THAT(refusal({0.004, 0.004, 4.4}, 1), HasSubstr("halved 3 times"));
}

// A cube of one tissue, with another in a corner.
LabelMap small_map() {
  LabelMap map;
  map.size = {12, 12, 12};
  map.step_m = {offline::Vec{1e-3, 0, 0}, offline::Vec{0, 1e-3, 0}, offline::Vec{0, 0, 1e-3}};
  for (std::uint32_t i = 0; i < 1728; ++i) map.label.push_back(i % 12 < 3 && i < 500 ? 2 : 1);
  return map;
}

TEST(RefineTexts, ARecipeSaysTheSameAsAnOption) {
  const auto bytes = [&](const offline::Settings& settings, const std::string& text) {
    const Recipe recipe = recipe_from(text);
    return offline::build_labels("map.nrrd", small_map(), recipe, options_for(settings, recipe),
                                 [](const char*, double) {})
        .bytes;
  };
  offline::Settings settings;
  settings.voxel_mm = 4;
  const auto by_recipe = bytes(
      settings, kTissues + std::string("[refine]\nwhere = [\"labels:fat:2\", \"surface\"]\n"));
  settings.refine = {"labels:fat:2", "surface"};
  EXPECT_EQ(bytes(settings, kTissues), by_recipe);
  EXPECT_EQ(opened(by_recipe).levels, 3);
}

}  // namespace
}  // namespace stylet::test
