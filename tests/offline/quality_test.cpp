// SPDX-License-Identifier: Apache-2.0
// The quality report: distances, pieces and gaps of simple bodies against known values, and the
// page as a user gets it.
#include "report/quality.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "meshes/phantom.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "random_bodies.h"
#include "report/page.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::Vec;

offline::BuildOptions measured_at(double voxel_mm) {
  offline::BuildOptions options;
  options.voxel_edge_m = voxel_mm * 1e-3;
  options.measured = true;
  return options;
}

offline::Quality quality_of(const offline::Built& built) {
  return offline::measure_quality(opened(built.bytes), built.input_m, [](const char*, double) {});
}

// ---- distances ----------------------------------------------------------------------------------

TEST(Distance, OfParallelBoxesIsTheGapAndAtTheCornersItsDiagonal) {
  const Mesh inner = box_mesh({0, 0, 0}, {10, 10, 10});
  const Mesh outer = box_mesh({-1, -1, -1}, {11, 11, 11});
  const offline::Deviation out = offline::deviation(outer, inner);
  const offline::Deviation in = offline::deviation(inner, outer);
  EXPECT_NEAR(out.most_m, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(in.most_m, 1, 1e-12);
  EXPECT_NEAR(in.mean_m, 1, 1e-12);
  EXPECT_GT(in.samples, 50'000U);
  // Mean over a face of 12 x 12 with a rim of 1 around it. In the middle 100 at 1; on the four rims
  // 4 * 10 at the mean of sqrt(1 + s^2) over 0..1, 1.1478; 4 corners at the mean over the unit
  // square, 1.2808.
  EXPECT_NEAR(out.mean_m, (100 + 40 * 1.1478 + 4 * 1.2808) / 144, 2e-3);
}

TEST(Distance, OfAMeshFromItselfIsZero) {
  const Mesh mesh = box_mesh({0, 0, 0}, {1, 2, 3});
  EXPECT_LT(offline::deviation(mesh, mesh).most_m, 1e-12);
}

// ---- what is kept, lost and glued ---------------------------------------------------------------

TEST(Quality, OfABoxOnTheGridFindsNoLoss) {
  const offline::Built built =
      build_quietly({input_of(box_mesh({0, 0, 0}, {40, 30, 20}), 1e-3)}, measured_at(5));
  const offline::Quality quality = quality_of(built);
  ASSERT_EQ(quality.pieces.size(), 1U);
  EXPECT_EQ(quality.pieces[0].voxels, 8U * 6 * 4);
  EXPECT_NEAR(quality.pieces[0].volume_m3 / 24e-6, 1, 1e-6);  // the edge is a float
  EXPECT_FALSE(quality.pieces[0].held);
  EXPECT_LT(quality.surface_to_input.most_m, 1e-7);
  EXPECT_LT(quality.faces_to_input.most_m, 1e-7);
  EXPECT_EQ(built.report.closed_gaps, 0U);
  ASSERT_EQ(built.report.shares.size(), 1U);
  EXPECT_NEAR(built.report.shares[0].given_m3, 24e-6, 1e-10);
  EXPECT_EQ(built.report.shares[0].pieces_lost, 0U);
  EXPECT_TRUE(offline::quality_facts(quality, built.report)["findings"].empty());
}

// Two slabs, 2 mm apart in voxels of 5 mm: one piece of tissue, and 12 x 12 gaps that are closed.
// In voxels of 1 mm there are two pieces, and no gap is closed.
TEST(Quality, GapNarrowerThanAVoxelIsReportedAsClosed) {
  const Mesh slabs = both(box_mesh({0, 0, 0}, {60, 60, 16}), box_mesh({0, 0, 18}, {60, 60, 35}));
  const offline::Built coarse = build_quietly({input_of(slabs, 1e-3)}, measured_at(5));
  EXPECT_EQ(coarse.report.closed_gaps, 144U);
  EXPECT_EQ(quality_of(coarse).pieces.size(), 1U);
  const auto facts = offline::quality_facts(quality_of(coarse), coarse.report);
  EXPECT_THAT(facts["findings"].dump(), testing::HasSubstr("closed at 144 places"));
  const offline::Built fine = build_quietly({input_of(slabs, 1e-3)}, measured_at(1));
  EXPECT_EQ(fine.report.closed_gaps, 0U);
  EXPECT_EQ(quality_of(fine).pieces.size(), 2U);
}

// A rod of 1 mm through voxels of 5 mm of liver, and a bead in the liver: neither has a voxel of
// its own.
TEST(Quality, ThinPartsWithoutAVoxelAreCounted) {
  const Mesh thin = both(box_mesh({2, 21, 21}, {38, 22, 22}), box_mesh({31, 31, 31}, {32, 32, 32}));
  const offline::Built built = build_quietly(
      {input_of(box_mesh({0, 0, 0}, {40, 40, 40}), 1e-3), input_of(thin, 1e-3, "vessel")},
      measured_at(5));
  ASSERT_EQ(built.report.shares.size(), 2U);
  const offline::ShareReport& vessel = built.report.shares[1];
  EXPECT_EQ(vessel.pieces, 2U);
  EXPECT_EQ(vessel.pieces_lost, 2U);
  EXPECT_NEAR(vessel.input_m3, 37e-9, 1e-15);
  EXPECT_EQ(vessel.given_m3, 0);
  const auto facts = offline::quality_facts(quality_of(built), built.report);
  EXPECT_THAT(facts["findings"].dump(), testing::HasSubstr("2 of 2 pieces have no voxel"));
}

TEST(Quality, PieceThatNothingHoldsIsReportedAsDrifting) {
  const Mesh apart = both(box_mesh({0, 0, 0}, {20, 20, 20}), box_mesh({40, 0, 0}, {60, 20, 20}));
  offline::BuildOptions options = measured_at(5);
  options.held = offline::parse_regions({"x<5%"}, {1e-3});
  const offline::Built built = build_quietly({input_of(apart, 1e-3)}, options);
  const offline::Quality quality = quality_of(built);
  ASSERT_EQ(quality.pieces.size(), 2U);
  EXPECT_NE(quality.pieces[0].held, quality.pieces[1].held);
  EXPECT_THAT(offline::quality_facts(quality, built.report)["findings"].dump(),
              testing::HasSubstr("1 of 2 separate pieces"));
}

// Boxes side by side, held below a given height: each wholly, in part or not at all.
TEST(Quality, PiecesThatCannotMoveAreReported) {
  Draw draw(31);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<offline::Input> inputs;
    std::size_t floating = 0, rigid = 0;
    const std::size_t count = 2 + draw.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = 30 * static_cast<double>(i);
      const auto some = [&](std::size_t least) {
        return 5 * static_cast<double>(least + draw.below(4));
      };
      const double low = some(0), high = low + some(1);
      const Mesh box = box_mesh({x, 0, low}, {x + 10, 15, high});
      inputs.push_back(input_of(box, 1e-3));
      floating += low > 10 ? 1U : 0U;
      rigid += high <= 10 ? 1U : 0U;
    }
    offline::BuildOptions options = measured_at(5);
    options.held = offline::parse_regions({"z<10"}, {1e-3});
    const auto built = build_quietly(inputs, options);
    const auto findings = offline::held_findings(offline::lattice_pieces(opened(built.bytes)));
    std::vector<std::string> expected;
    if (floating > 0)
      expected.push_back(fmt::format("{} of {} separate pieces are not", floating, count));
    if (rigid > 0)
      expected.push_back(fmt::format("{} of {} separate pieces are held", rigid, count));
    ASSERT_EQ(findings.size(), expected.size()) << repeat;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_THAT(findings[i], testing::StartsWith(expected[i])) << repeat;
    }
  }
}

// A map of 2 mm is filled by one tissue, except for one voxel of a lesion, which no sample of
// voxels of 15 mm meets. And a triangle without area is no piece of a mesh.
TEST(Quality, PiecesWithoutAnyVoxelAreCounted) {
  offline::LabelMap map;
  map.size = {30, 22, 22};
  map.step_m = {Vec{2e-3, 0, 0}, Vec{0, 2e-3, 0}, Vec{0, 0, 2e-3}};
  map.label.assign(30 * 22 * 22, 1);
  map.label[30 * 22 * 10 + 30 * 10 + 8] = 2;
  offline::Recipe recipe;
  recipe.groups = {{"liver", {1}}, {"tumour", {2}}};
  const offline::Built built =
      offline::build_labels("map.nrrd", map, recipe, measured_at(15), [](const char*, double) {});
  ASSERT_EQ(built.report.shares.size(), 2U);
  EXPECT_EQ(built.report.shares[0].pieces, 1U);
  EXPECT_EQ(built.report.shares[0].pieces_lost, 0U);
  EXPECT_EQ(built.report.shares[1].pieces, 1U);
  EXPECT_EQ(built.report.shares[1].pieces_lost, 1U);
  EXPECT_NEAR(built.report.shares[1].input_m3, 8e-9, 1e-15);
  EXPECT_THAT(built.report.warnings,
              testing::Contains(testing::HasSubstr("no voxel holds any and no needle feels it")));
  Mesh mesh = box_mesh({0, 0, 0}, {40, 30, 20});
  for (const double at : {5.0, 6.0, 7.0}) mesh.points.push_back({at, at, at});
  mesh.triangles.push_back({8, 9, 10});
  EXPECT_EQ(build_quietly({input_of(mesh, 1e-3)}, measured_at(5)).report.shares[0].pieces, 1U);
}

// Measuring does not change the organ.
TEST(Quality, MeasuringChangesNoByte) {
  const Mesh mesh = box_mesh({0, 0, 0}, {43, 30, 21});
  offline::BuildOptions options = measured_at(5);
  const offline::Built with = build_quietly({input_of(mesh, 1e-3)}, options);
  options.measured = false;
  EXPECT_EQ(with.bytes, build_quietly({input_of(mesh, 1e-3)}, options).bytes);
}

// ---- gaps ---------------------------------------------------------------------------------------

// Two slabs, 6 mm apart in voxels of 2 mm: three layers of 20 x 20 voxels fill the gap, and none
// lies beyond it; a gap of 8 mm stays open.
TEST(Gaps, NarrowOnesBecomeTheTissueAskedFor) {
  for (const double gap_mm : {6.0, 8.0}) {
    const double above = 10 + gap_mm;
    std::vector<offline::Input> inputs = {
        input_of(box_mesh({0, 0, 0}, {40, 40, 10}), 1e-3),
        input_of(box_mesh({0, 0, above}, {40, 40, above + 10}), 1e-3, "kidney", 1)};
    offline::BuildOptions options;
    options.voxel_edge_m = 2e-3;
    options.gap_tissue = "fat";
    options.gap_m = 6e-3;
    const auto bytes = build_quietly(std::move(inputs), options).bytes;
    const Organ organ = opened(bytes);
    const bool filled = gap_mm < 7;
    EXPECT_EQ(organ.voxel_count, 2U * 20 * 20 * 5 + (filled ? 3U * 20 * 20 : 0));
    EXPECT_EQ(organ.material_count, filled ? 3U : 2U);
    const auto pieces = offline::measure_quality(organ, {}, [](const char*, double) {}).pieces;
    EXPECT_EQ(pieces.size(), filled ? 1U : 2U);
  }
}

// OpenHELP's organs in their frame: the higher priority wins, shared volume counts once.
TEST(MeshSet, OfAnAbdomenIsOneLattice) {
  const std::filesystem::path organs = data_folder() / "organs";
  SKIP_WITHOUT(organs / "openhelp_Liver.stl");
  std::vector<offline::Input> inputs;
  const std::pair<const char*, const char*> set[] = {
      {"Abdominal_wall", "muscle"}, {"Liver", "liver"},
      {"Kidney_left", "kidney"},    {"Spleen", "gel"},
      {"Stomach", "fat"},           {"Pancreas", "prostate"}};
  double most_m3 = 0;
  for (const auto& [name, tissue] : set) {
    const auto path = organs / (std::string("openhelp_") + name + ".stl");
    inputs.push_back(
        {path.string(), tissue, static_cast<int>(inputs.size()), 1e-3, offline::read_mesh(path)});
  }
  const offline::Built built = build_quietly(std::move(inputs), measured_at(5));
  for (const offline::ShareReport& each : built.report.shares) {
    EXPECT_NEAR(each.sampled_m3 / each.input_m3, 1, 0.01) << each.from;
    EXPECT_EQ(each.pieces_lost, 0U) << each.from;
    most_m3 += each.input_m3;
  }
  // The last organ has the highest priority: it keeps all of its volume.
  EXPECT_NEAR(built.report.shares.back().given_m3 / built.report.shares.back().sampled_m3, 1, 1e-9);
  const Organ organ = opened(built.bytes);
  EXPECT_EQ(organ.material_count, 6U);
  EXPECT_LE(volume_m3(organ), most_m3 * 1.01);
  EXPECT_GT(volume_m3(organ), most_m3 * 0.9);
}

// ---- the page -----------------------------------------------------------------------------------

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Page, OfAPatientHasPicturesTablesAndTheSameBytesTwice) {
  const auto map = data_folder() / "labelmaps" / "ts_example_seg.nii.gz";
  SKIP_WITHOUT(map);
  const Scratch scratch;
  const auto build = [&](const std::string& name) {
    const std::string command = std::string(STYLET_ORGAN) + " build " + map.string() +
                                " --recipe " STYLET_RECIPES "/totalsegmentator.toml -o " +
                                (scratch.folder / "a.organ").string() + " --report " +
                                (scratch.folder / name).string() + " >/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return slurp(scratch.folder / name / "report.html");
  };
  const std::string page = build("one");
  EXPECT_EQ(count_of(page, "<svg class='on'"), 3U);
  EXPECT_GT(count_of(page, "<svg"), 3U * 16);
  EXPECT_EQ(count_of(page, "<input type='range'"), 3U);
  for (const char* side : {">R<", ">L<", ">A<", ">P<", ">S<", ">I<", " mm</text>"}) {
    EXPECT_GT(count_of(page, side), 16U) << side;
  }
  EXPECT_EQ(count_of(page, "data:image/png;base64,"), 2U);
  EXPECT_EQ(count_of(page, "<h2>"), 6U);
  EXPECT_EQ(page, build("two"));
  const auto facts = nlohmann::json::parse(slurp(scratch.folder / "one" / "report.json"));
  const auto& quality = facts["quality"];
  EXPECT_EQ(quality["tissues"].size(), 5U + 1);
  for (const auto& tissue : quality["tissues"]) {
    if (tissue["input_ml"] == 0.0) continue;
    EXPECT_NEAR(tissue["sampled_ml"].get<double>() / tissue["input_ml"].get<double>(), 1, 0.01);
  }
  // The smoothed surface stays within a voxel of the map, 3 mm.
  EXPECT_LT(quality["surface"]["hausdorff_mm"], 3.0);
  EXPECT_LT(quality["surface"]["mean_mm"], 1.0);
}

// A block of liver beside a rib, as NRRD, which knows the patient's sides, and as an Inrimage,
// which does not; fitted to a machine whose ticks take 30 us plus 20 ns for each voxel and substep.
TEST(Page, ShowsWhichSideIsWhichWhatLiesBesideAndWhatATickTakes) {
  const Scratch scratch;
  std::string voxels;
  for (int i = 0; i < 12 * 10 * 8; ++i) {
    const int x = i % 12, y = i / 12 % 10, z = i / 120;
    const bool rib = x >= 9 && x < 11 && y >= 2 && y < 8 && z >= 3 && z < 5;
    const bool liver = x >= 1 && x < 8 && y >= 1 && y < 9 && z >= 1 && z < 7;
    voxels += static_cast<char>(rib ? 2 : liver ? 1 : 0);
  }
  std::string head =
      "#INRIMAGE-4#{\nXDIM=12\nYDIM=10\nZDIM=8\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n"
      "CPU=decm\nVX=5\nVY=5\nVZ=5\n";
  head.resize(252, '\n');
  scratch.write("a.inr", head + "##}\n" + voxels);
  scratch.write("a.nrrd",
                "NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 12 10 8\n"
                "space directions: (5,0,0) (0,5,0) (0,0,5)\nspace origin: (0,0,0)\nencoding: "
                "raw\n\n" +
                    voxels);
  scratch.write("r.toml", "[tissues]\nliver = [1]\n[obstacles]\nrib = [2]\n[targets]\naim = [1]\n");
  scratch.write("box.csv",
                "measure,organ,voxels,substeps,passes,median_us,ns_per_voxel_substep\n"
                "tick_elastic_added,a,1000,2,0,70,35\ntick_elastic_added,b,20000,2,0,830,20.75\n"
                "tick_elastic,b,20000,1,7,850,42\n");
  const auto page_of = [&](const std::string& map, const std::string& machine) {
    const std::string command = "cd " + scratch.folder.string() + " && " STYLET_ORGAN " build " +
                                map + " --name 'a>b' --recipe r.toml --fit 1kHz " + machine +
                                " -o a.organ" + " --report " + map + ".page >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return slurp(scratch.folder / (map + ".page") / "report.html");
  };
  const std::string of_patient = page_of("a.nrrd", "--machine box.csv"),
                    of_axes = page_of("a.inr", "");
  for (const char* side : {">R<", ">L<", ">A<", ">P<", ">S<", ">I<"}) {
    EXPECT_GT(count_of(of_patient, side), 0U) << side;
    EXPECT_EQ(count_of(of_axes, side), 0U) << side;
  }
  for (const char* side : {">-x<", ">+x<", ">-y<", ">+y<", ">-z<", ">+z<"}) {
    EXPECT_EQ(count_of(of_patient, side), 0U) << side;
    EXPECT_GT(count_of(of_axes, side), 0U) << side;
  }
  EXPECT_EQ(count_of(of_patient, " on box: a tick of "), 1U);
  EXPECT_EQ(count_of(of_patient, "; timed on this organ "), 0U);
  EXPECT_EQ(count_of(of_axes, " on this machine: a tick of "), 1U);
  EXPECT_EQ(count_of(of_axes, "; timed on this organ "), 1U);
  EXPECT_GT(count_of(of_axes, "The letters are the axes of the input."), 0U);
  for (const std::string& page : {of_patient, of_axes}) {
    EXPECT_GT(count_of(page, "<title>obstacle rib</title>"), 0U);
    EXPECT_GT(count_of(page, "<title>target aim</title>"), 0U);
    EXPECT_EQ(count_of(page, "<h1>a&gt;b</h1>"), 1U);
    EXPECT_GT(count_of(page, "</i>obstacle<i"), 0U);
    EXPECT_EQ(count_of(page, "<th>tick, us</th>"), 1U);
  }
}

// A part cut from inside a block has no surface of the input: none to compare with, and none to
// show.
TEST(Page, OfAPartWithoutSurfaceShowsNone) {
  const Scratch scratch;
  offline::Mesh block = box_mesh({0, 0, 0}, {60, 60, 60});
  scratch.write("a.off", offline::off_text(block));
  scratch.write("b.off", offline::off_text(box_mesh({60, 0, 0}, {80, 60, 60})));
  const std::string command = "cd " + scratch.folder.string() +
                              " && " STYLET_ORGAN
                              " build a.off b.off:kidney --crop box:20,20,20,40,40,40 --fix none"
                              " --report page -o a.organ >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string page = slurp(scratch.folder / "page" / "report.html");
  EXPECT_EQ(count_of(page, "Made from a.off, b.off."), 1U);
  EXPECT_EQ(count_of(page, "surface that the needle meets"), 0U);
  EXPECT_EQ(count_of(page, "data:image/png;base64,"), 1U);
  const auto facts = nlohmann::json::parse(slurp(scratch.folder / "page" / "report.json"));
  EXPECT_TRUE(facts["quality"]["surface"].is_null());
}

// A free body has no resonance; a held one has.
TEST(Page, HasTheResonanceOfABodyThatIsHeld) {
  const Scratch scratch;
  scratch.write("a.off", offline::off_text(box_mesh({0, 0, 0}, {60, 60, 60})));
  for (const std::string fix : {"none", "z<10%"}) {
    const std::string command = "cd " + scratch.folder.string() +
                                " && " STYLET_ORGAN
                                " build a.off --report page -o a.organ --fix '" +
                                fix + "' >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string page = slurp(scratch.folder / "page" / "report.html");
    EXPECT_EQ(count_of(page, "first resonance"), fix == "none" ? 0U : 1U);
  }
}

}  // namespace
}  // namespace stylet::test
