// SPDX-License-Identifier: Apache-2.0
// What a user's settings lead to, and which settings are refused. For the program some are already
// refused by its command line, but not for the Python module. Recipes and tissues from tables are
// those from files with the same content.
#include "pipeline/settings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "asset/tissue_table.h"
#include "base/refusal.h"
#include "maps/recipe_table.h"
#include "offline_support.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Recipe;
using offline::Settings;
using testing::ElementsAre;
using testing::HasSubstr;

Recipe recipe_with(const std::vector<std::string>& tissues) {
  Recipe recipe;
  for (std::uint16_t i = 0; i < tissues.size(); ++i) {
    recipe.groups.push_back({tissues[i], {static_cast<std::uint16_t>(i + 1)}});
  }
  return recipe;
}

BuildOptions for_labels(const Settings& settings, const Recipe& recipe) {
  BuildOptions options = offline::common_options(settings, {1e-3});
  const std::string path = "folder/seg.nii.gz", text = "recipe.toml";
  offline::choose_for_labels(settings, {path, text}, recipe, options);
  return options;
}

BuildOptions for_mesh(const Settings& settings, const std::string& tissue) {
  BuildOptions options = offline::common_options(settings, {1});
  offline::Input input;
  input.path = "folder/Liver.final.stl";
  input.tissue = tissue;
  offline::choose_for_meshes(settings, {input}, options);
  return options;
}

TEST(Settings, DefaultsAreReportedInFull) {
  const BuildOptions of_map = for_labels({}, recipe_with({"gel", "liver"}));
  EXPECT_EQ(of_map.options_text,
            "--voxel-mm 5 --fix x>90% --fix z<10% --recipe recipe.toml --capsule liver_capsule");
  EXPECT_EQ(of_map.name, "seg");
  EXPECT_EQ(of_map.capsule, "liver_capsule");
  EXPECT_EQ(of_map.capsule_of, "liver");
  EXPECT_FALSE(of_map.split);
  EXPECT_EQ(of_map.tool_version, offline::tool_version());
  EXPECT_THAT(of_map.tool_version, testing::MatchesRegex("stylet-organ [0-9]+.[0-9]+.[0-9]+"));
  const BuildOptions of_mesh = for_mesh({}, "gel");
  EXPECT_EQ(of_mesh.options_text,
            "--voxel-mm 5 --fix x>90% --fix z<10% --units mm --scale 1 --capsule none");
  EXPECT_EQ(of_mesh.name, "Liver.final");
  EXPECT_EQ(of_mesh.capsule, "");
}

TEST(Settings, EverySettingIsUsedAndReported) {
  const Scratch scratch;
  Settings s;
  s.name = "mine";
  s.voxels_across = 30;
  s.fix = {"touching:" +
           scratch.write("plate.off", offline::off_text(box_mesh({}, {1, 1, 1}))).string()};
  s.crop = {"y<40%"};
  s.materials = scratch.write("own.toml", "[gel]\nyoungs_modulus_kpa = 3\n").string();
  s.layers = {"fat:2.5", "gel:10"};
  s.layers_of = "muscle";
  s.layers_along = "-z";
  s.fill_gaps = "fat:100";
  s.split_gaps = s.wrap = true;
  s.capsule = "skin";
  const BuildOptions o = for_mesh(s, "muscle");
  EXPECT_EQ(o.options_text,
            "--voxels-across 30 --fix touching:plate.off --crop y<40% --materials own.toml --units "
            "mm --scale 1 --wrap --split-gaps --fill-gaps fat:100 --layers-of muscle "
            "--layers-along -z --layer fat:2.5 gel:10 --capsule skin");
  EXPECT_EQ(o.name, "mine");
  EXPECT_EQ(o.voxels_across, 30U);
  EXPECT_EQ(o.held.size(), 1U);
  EXPECT_EQ(o.held[0].mesh_m.points.size(), 8U);
  EXPECT_EQ(o.crop.size(), 1U);
  ASSERT_EQ(o.own_tissues.size(), 1U);
  EXPECT_EQ(o.own_tissues[0].youngs_modulus_pa, 3000);
  ASSERT_EQ(o.layers.size(), 2U);
  EXPECT_DOUBLE_EQ(o.layers[0].thickness_m, 2.5e-3);
  EXPECT_EQ(o.layers[1].tissue, "gel");
  EXPECT_EQ(o.layer_course.axis, 2U);
  EXPECT_TRUE(o.layer_course.backwards);
  EXPECT_EQ(o.layer_course.of, "muscle");
  EXPECT_EQ(o.gap_tissue, "fat");
  EXPECT_DOUBLE_EQ(o.gap_m, 0.1);
  EXPECT_TRUE(o.split && o.wrap);
  EXPECT_EQ(o.capsule, "skin");
  EXPECT_EQ(o.capsule_of, "");
}

TEST(Settings, LayersDivideTheOnlyTissueThereIs) {
  Settings s;
  s.layers = {"fat:2.5"};
  EXPECT_EQ(for_mesh(s, "muscle").layer_course.of, "muscle");
  EXPECT_EQ(for_labels(s, recipe_with({"gel"})).layer_course.of, "gel");
  s.layers_of = "muscle";
  const std::string said = for_mesh(s, "muscle").options_text;
  s.layers_of = "";
  EXPECT_EQ(for_mesh(s, "muscle").options_text, said);
}

TEST(Settings, SettingsForALabelMapAreUsedAndReported) {
  Settings s;
  s.layers = {"fat:2.5"};
  s.layers_of = "gel";
  s.fill_gaps = "fat:20";
  s.split_gaps = true;
  const BuildOptions o = for_labels(s, recipe_with({"gel"}));
  EXPECT_EQ(o.options_text,
            "--voxel-mm 5 --fix x>90% --fix z<10% --recipe recipe.toml --split-gaps "
            "--fill-gaps fat:20 --layers-of gel --layers-along +x --layer fat:2.5 --capsule none");
  ASSERT_EQ(o.layers.size(), 1U);
  EXPECT_EQ(o.layer_course.of, "gel");
  EXPECT_EQ(o.gap_tissue, "fat");
  EXPECT_DOUBLE_EQ(o.gap_m, 0.02);
  EXPECT_TRUE(o.split);
}

TEST(Settings, ARateIsReportedInsteadOfTheEdge) {
  Settings s;
  s.fit = "1kHz";
  EXPECT_THAT(for_mesh(s, "gel").options_text, testing::StartsWith("--fit 1kHz --fix"));
}

TEST(Settings, LiverHasItsCapsuleButNotUnderLayersOfAll) {
  Settings s;
  s.layers = {"liver:5", "liver:90"};
  BuildOptions options;
  options.layers = offline::parse_layers(s.layers, "--layer");
  offline::choose_capsule(s, {"liver"}, options);
  EXPECT_EQ(options.capsule, "");
  options.layer_course.of = "liver";
  offline::choose_capsule(s, {"liver"}, options);
  EXPECT_EQ(options.capsule, "liver_capsule");
  s.capsule = "none";
  offline::choose_capsule(s, {"liver"}, options);
  EXPECT_EQ(options.capsule, "");
}

TEST(Settings, WallAndGapsOfARecipe) {
  Recipe recipe = recipe_with({"gel"});
  recipe.wall = {{"fat", 0.01}, {"skin", 0.002}};
  recipe.open_gaps = true;
  const BuildOptions options = for_labels({}, recipe);
  EXPECT_THAT(options.wall, ElementsAre("fat", "skin"));
  EXPECT_TRUE(options.split);
  recipe.wall[0].tissue = "fatt";
  EXPECT_THAT(refusal_of([&] { (void)for_labels({}, recipe); }), HasSubstr("tissue 'fatt'"));
  EXPECT_THAT(refusal_of([&] { (void)for_labels({}, recipe_with({"livr"})); }),
              HasSubstr("tissue 'livr'"));
}

TEST(Settings, SettingsThatContradictEachOtherAreRefused) {
  Settings layered;
  layered.layers = {"fat:3"};
  layered.layers_of = "gel";
  for (const char* along : {"", "x", "+", "z+", "+w", "-{", "++x", "*x"}) {
    layered.layers_along = along;
    EXPECT_THAT(refusal_of([&] { (void)for_mesh(layered, "gel"); }),
                HasSubstr(fmt::format("--layers-along '{}': expected one of", along)));
  }
  for (const char* along : {"+x", "-x", "+y", "-y", "+z", "-z"}) {
    layered.layers_along = along;
    EXPECT_EQ(for_mesh(layered, "gel").layer_course.axis, static_cast<std::size_t>(along[1] - 'x'));
  }
  for (const char* layer : {"fat", "fat:", "fat:x", "fat:3x", "fat:0", "fat:-1", "fat:nan", ""}) {
    EXPECT_THAT(refusal_of([&] { (void)offline::parse_layers({layer}, "--layer"); }),
                HasSubstr(fmt::format("--layer '{}': expected TISSUE:MM", layer)));
  }
  Settings s;
  s.layers_of = "gel";  // without layers
  EXPECT_THAT(refusal_of([&] { (void)for_mesh(s, "gel"); }), HasSubstr("together with --layer"));
  s.layers = {"fat:3"};  // of another tissue
  EXPECT_THAT(refusal_of([&] { (void)for_mesh(s, "liver"); }), HasSubstr("--layers-of 'gel'"));
  s.layers_of = "";  // whose tissues differ
  const Recipe two = recipe_with({"gel", "liver"});
  EXPECT_THAT(refusal_of([&] { (void)for_labels(s, two); }), HasSubstr("--layers-of ''"));
  s = {};
  for (const char* gap : {"fat:100.001", "fat:1e9"}) {
    s.fill_gaps = gap;
    EXPECT_THAT(refusal_of([&] { (void)for_mesh(s, "gel"); }), HasSubstr("at most 100 mm"));
  }
  s.fill_gaps = "fatt:3";
  EXPECT_THAT(refusal_of([&] { (void)for_mesh(s, "gel"); }), HasSubstr("tissue 'fatt'"));
}

TEST(Tables, AreFilesWithTheSameContent) {
  const Scratch scratch;
  const std::string text =
      "[tissues]\nliver = [5, \"vein\"]\n[names]\nvein = 9\n[crop]\naround = [5]\nmargin_mm = 3\n";
  const Recipe read = offline::read_recipe(scratch.write("r.toml", text));
  const Recipe given = offline::recipe_of(toml::parse(text), "recipe");
  EXPECT_EQ(given.groups[0].labels, read.groups[0].labels);
  EXPECT_EQ(given.names, read.names);
  EXPECT_EQ(given.crop_around, read.crop_around);
  EXPECT_EQ(given.crop_margin_m, read.crop_margin_m);
  const toml::table stiff{{"gel", toml::table{{"youngs_modulus_kpa", 7.5}}}};
  const auto tissues = offline::tissues_of(stiff, "materials");
  ASSERT_EQ(tissues.size(), 1U);
  EXPECT_EQ(tissues[0].youngs_modulus_pa, 7500);
  EXPECT_EQ(tissues[0].source, "materials");
}

TEST(Tables, RefusalsOfTablesNameNoLine) {
  const toml::table wrong{{"tissues", toml::table{{"liver", "all"}}}};
  EXPECT_EQ(refusal_of([&] { (void)offline::recipe_of(wrong, "recipe"); }),
            "recipe: liver: expected a list of labels");
  const toml::table soft{{"gel", toml::table{{"softness", 1}}}};
  EXPECT_THAT(refusal_of([&] { (void)offline::tissues_of(soft, "materials"); }),
              testing::StartsWith("materials: softness: unknown key"));
}

}  // namespace
}  // namespace stylet::test
