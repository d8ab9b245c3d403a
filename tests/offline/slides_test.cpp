// SPDX-License-Identifier: Apache-2.0
// Tissues that slide: parts share nothing, areas and distances are those of the surfaces, whatever
// their slope and the voxels' edge, and a user is told of what does not meet.
#include "voxels/slides.h"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "base/refusal.h"
#include "meshes/near_surface.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "pipeline/label_organ.h"
#include "pipeline/settings.h"
#include "pipeline/slides.h"
#include "random_bodies.h"
#include "report/quality.h"
#include "session.h"
#include "state/layout.h"
#include "voxels/crop.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;
using offline::Mesh;
using offline::NearSurface;
using offline::Vec;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

BuildOptions sliding(double voxel_mm, const std::string& text = "muscle:liver:0.2") {
  BuildOptions options;
  options.voxel_edge_m = voxel_mm * 1e-3;
  options.slides = offline::parse_slides({text});
  return options;
}

Mesh scaled(Mesh mesh, double by) {
  for (Vec& p : mesh.points) p = p * by;
  return mesh;
}

// ---- what an organ says, in the patient's frame -------------------------------------------------

struct Voxel {
  std::uint32_t x, y, z;  // y in the lattice, over all sheets
};
std::vector<Voxel> voxels_of(const Organ& organ) {
  std::vector<Voxel> voxels;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) voxels.push_back({run.x + i, run.y, run.z});
  }
  return voxels;
}

Vec low_of(const Organ& organ, const Voxel& v) {
  const double edge = static_cast<double>(organ.voxel_edge_m);
  const Vec origin = {static_cast<double>(organ.origin_m.x), static_cast<double>(organ.origin_m.y),
                      static_cast<double>(organ.origin_m.z)};
  return origin + Vec{1.0 * v.x, 1.0 * (v.y % organ.sheet_rows), 1.0 * v.z} * edge;
}

Vec place_of(const Organ& organ, const std::vector<Voxel>& voxels, const OrganSlidePoint& p) {
  const Vec part = Vec{1.0 * p.fx, 1.0 * p.fy, 1.0 * p.fz} * (1.0 / 65535);
  return low_of(organ, voxels[p.voxel]) + part * static_cast<double>(organ.voxel_edge_m);
}

double area_m2(const Organ& organ) {
  double squares = 0;
  for (const OrganSlidePoint& p : organ.slide_points) squares += static_cast<double>(p.area);
  const double edge = static_cast<double>(organ.voxel_edge_m);
  return squares * edge * edge;
}

std::string material_of(const Organ& organ, std::uint32_t voxel) {
  return organ_material(organ, organ.voxel_material[voxel]).name;
}

using Node = std::array<std::uint32_t, 3>;

// The particles of all voxels with a material.
std::set<Node> particles_of(const Organ& organ, const std::string& material) {
  std::map<Node, std::uint32_t> tied;
  for (const OrganTie& tie : organ.ties) tied[{tie.x, tie.y, tie.z}] = tie.to_y;
  std::set<Node> particles;
  const std::vector<Voxel> voxels = voxels_of(organ);
  for (std::uint32_t voxel = 0; voxel < voxels.size(); ++voxel) {
    if (material_of(organ, voxel) != material) continue;
    const Voxel& v = voxels[voxel];
    for (std::uint32_t i = 0; i < 8; ++i) {
      Node node = {v.x + (i & 1U), v.y + (i >> 1U & 1U), v.z + (i >> 2U)};
      const auto found = tied.find(node);
      if (found != tied.end()) node[1] = found->second;
      particles.insert(node);
    }
  }
  return particles;
}

std::size_t shared_particles(const Organ& organ, const std::string& one, const std::string& other) {
  const std::set<Node> of_one = particles_of(organ, one), of_other = particles_of(organ, other);
  return static_cast<std::size_t>(
      std::ranges::count_if(of_other, [&](const Node& node) { return of_one.contains(node); }));
}

// A point goes from voxel to voxel of its ground within a sheet.
std::set<std::uint32_t> sheets_of(const Organ& organ, const std::string& tissue) {
  std::set<std::uint32_t> sheets;
  const std::vector<Voxel> voxels = voxels_of(organ);
  for (std::uint32_t i = 0; i < voxels.size(); ++i) {
    if (material_of(organ, i) == tissue) sheets.insert(voxels[i].y / organ.sheet_rows);
  }
  return sheets;
}

// Every point is in a voxel of its tissue, and every ground in one of its own.
void expect_in_their_parts(const Organ& organ, const std::string& tissue,
                           const std::string& ground) {
  for (const OrganSlidePoint& p : organ.slide_points) {
    ASSERT_EQ(material_of(organ, p.voxel), tissue);
  }
  for (const OrganSlideGround& g : organ.slide_grounds) {
    ASSERT_EQ(material_of(organ, g.voxel), ground);
  }
}

// ---- nearest places of surfaces -----------------------------------------------------------------

// Around a box, the nearest place and the side are known, also beside its edges and corners.
TEST(NearSurface, TellsInsideFromOutside) {
  Draw draw(5);
  const auto frame = random_frame(draw);
  const NearSurface surface(turned(box_mesh({-3, -2, -1}, {3, 2, 1}), frame));
  for (int i = 0; i < 20000; ++i) {
    const Vec at = {draw.between(-5, 5), draw.between(-5, 5), draw.between(-5, 5)};
    const Vec off = {std::abs(at.x) - 3, std::abs(at.y) - 2, std::abs(at.z) - 1};
    const double inner = std::max({off.x, off.y, off.z});
    const Vec outer = {std::max(off.x, 0.0), std::max(off.y, 0.0), std::max(off.z, 0.0)};
    const double wanted = inner < 0 ? inner : length(outer);
    const Vec there = frame[0] * at.x + frame[1] * at.y + frame[2] * at.z;
    ASSERT_NEAR(surface.outside(there), wanted, 1e-9);
  }
}

// An open surface goes on beyond its rim as the plane that it ends in.
TEST(NearSurface, GoesOnBeyondTheRim) {
  Mesh square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const NearSurface surface(square);
  EXPECT_NEAR(surface.outside({3, 0.2, 0.7}), 0.7, 1e-12);
  EXPECT_NEAR(surface.outside({-2, -2, -0.3}), -0.3, 1e-12);
  EXPECT_NEAR(surface.outside({0.5, 0.5, -0.3}), -0.3, 1e-12);
}

// ---- organs -------------------------------------------------------------------------------------

// Two blocks with a plane between them in any direction.
TEST(Slides, PlanesInAnyDirection) {
  Draw draw(17);
  for (int round = 0; round < 12; ++round) {
    const double voxel_mm = draw.between(2.5, 7), half = 30, gap = round % 3 == 2 ? 0.4 : 0;
    const double level = draw.between(-4, 4);
    const auto frame = round == 0 ? std::array<Vec, 3>{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}
                                  : random_frame(draw);
    const Mesh low = turned(box_mesh({-half, -half, -25}, {half, half, level}), frame);
    const Mesh high = turned(box_mesh({-half, -half, level + gap}, {half, half, 25}), frame);
    const auto built =
        build_quietly({input_of(low, 1e-3, "kidney"), input_of(high, 1e-3, "muscle")},
                      sliding(voxel_mm, "muscle:kidney:0.2"));
    SCOPED_TRACE(testing::Message() << "round " << round << " edge " << voxel_mm);
    EXPECT_THAT(built.report.warnings, IsEmpty());
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.format_version, 4U);
    EXPECT_EQ(shared_particles(organ, "kidney", "muscle"), 0U);
    EXPECT_THAT(sheets_of(organ, "kidney"), testing::SizeIs(1));
    EXPECT_THAT(sheets_of(organ, "muscle"), testing::SizeIs(1));
    expect_in_their_parts(organ, "muscle", "kidney");
    EXPECT_NEAR(area_m2(organ), 60e-3 * 60e-3, 0.02 * 60e-3 * 60e-3);
    const std::vector<Voxel> voxels = voxels_of(organ);
    const double edge_mm = static_cast<double>(organ.voxel_edge_m) * 1e3;
    double most_off = 0;
    for (const OrganSlidePoint& p : organ.slide_points) {
      EXPECT_EQ(p.friction, 0.2F);
      const Vec at = place_of(organ, voxels, p) * 1e3;
      most_off = std::max(most_off, std::abs(dot(at, frame[2]) - level - gap));
    }
    EXPECT_LT(most_off, 0.3 * edge_mm);  // points are moved to voxels with samples
    for (const OrganSlideGround& g : organ.slide_grounds) {
      const Vec corner_mm = low_of(organ, voxels[g.voxel]) * 1e3;
      for (unsigned i = 0; i < 8; ++i) {
        const Vec at =
            corner_mm + Vec{1.0 * (i & 1U), 1.0 * (i >> 1U & 1U), 1.0 * (i >> 2U)} * edge_mm;
        ASSERT_NEAR(static_cast<double>(g.distance[i]) * edge_mm, dot(at, frame[2]) - level, 1e-4);
      }
    }
  }
}

// A ball in a shell: all of the ball's surface lies on the shell's inner one, also where the shell
// is thinner than a voxel.
TEST(Slides, BallsInShells) {
  Draw draw(29);
  for (int round = 0; round < 5; ++round) {
    const double radius_mm = draw.between(18, 28), shell_mm = draw.between(3, 9);
    const Vec at = {draw.between(-2, 2), draw.between(-2, 2), draw.between(-2, 2)};
    const auto ball = [&](double r) {
      Mesh mesh = scaled(offline::ball_phantom(2 * r * 1e-3, 2.5e-3), 1e3);
      for (Vec& p : mesh.points) p = p + at;
      return mesh;
    };
    Mesh shell = ball(radius_mm + shell_mm), hollow = ball(radius_mm);
    for (offline::Triangle& t : hollow.triangles) std::swap(t[1], t[2]);
    append(shell, hollow);
    const double voxel_mm = draw.between(2.5, 6);
    SCOPED_TRACE(testing::Message()
                 << "round " << round << " edge " << voxel_mm << " shell " << shell_mm);
    const auto built =
        build_quietly({input_of(shell, 1e-3, "muscle"), input_of(ball(radius_mm), 1e-3, "kidney")},
                      sliding(voxel_mm, "kidney:muscle"));
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(shared_particles(organ, "kidney", "muscle"), 0U);
    const double area = 4 * std::numbers::pi * radius_mm * radius_mm * 1e-6;
    EXPECT_NEAR(area_m2(organ), area, 0.03 * area);
    const std::vector<Voxel> voxels = voxels_of(organ);
    const double edge_mm = static_cast<double>(organ.voxel_edge_m) * 1e3;
    for (const OrganSlideGround& g : organ.slide_grounds) {
      const Vec corner_mm = low_of(organ, voxels[g.voxel]) * 1e3;
      for (unsigned i = 0; i < 8; ++i) {
        const Vec to =
            corner_mm + Vec{1.0 * (i & 1U), 1.0 * (i >> 1U & 1U), 1.0 * (i >> 2U)} * edge_mm - at;
        ASSERT_NEAR(static_cast<double>(g.distance[i]) * edge_mm, radius_mm - length(to), 0.15);
      }
    }
  }
}

// An organ of higher priority in a body that encloses it: the body's inner surface is the organ's.
TEST(Slides, AnOrganInABodyAroundIt) {
  const Mesh organ_m = box_mesh({15, 12, 9}, {45, 40, 33}),
             body = box_mesh({0, 0, 0}, {60, 60, 50});
  for (const std::string which : {"kidney:muscle", "muscle:kidney"}) {
    const auto built =
        build_quietly({input_of(body, 1e-3, "muscle", 0), input_of(organ_m, 1e-3, "kidney", 1)},
                      sliding(3.7, which));
    const Organ organ = opened(built.bytes);
    const double area = 2e-6 * (30 * 28 + 30 * 24 + 28 * 24);
    EXPECT_NEAR(area_m2(organ), area, 0.02 * area) << which;
    EXPECT_EQ(shared_particles(organ, "kidney", "muscle"), 0U);
    const std::vector<Voxel> voxels = voxels_of(organ);
    const double sign = which == "kidney:muscle" ? 1 : -1;
    for (const OrganSlideGround& g : organ.slide_grounds) {
      const Vec at = low_of(organ, voxels[g.voxel]) * 1e3;
      const double inner =
          std::min({at.x - 15, 45 - at.x, at.y - 12, 40 - at.y, at.z - 9, 33 - at.z});
      if (inner <= 0) continue;  // beside edges and corners no face is nearest
      ASSERT_NEAR(static_cast<double>(g.distance[0]) * 3.7, sign * inner, 1e-3) << which;
    }
  }
}

// The ground goes on below its surface, however thin it is, and its far side is not met.
TEST(Slides, ThinGroundsAndThinParts) {
  for (const double thin_mm : {1.2, 2.0, 3.5}) {
    const Mesh low = box_mesh({0, 0, 0}, {60, 60, 20});
    const Mesh mid = box_mesh({0, 0, 20}, {60, 60, 20 + thin_mm});
    for (const std::string which : {"muscle:kidney", "kidney:muscle"}) {
      const auto built = build_quietly(
          {input_of(low, 1e-3, "kidney"), input_of(mid, 1e-3, "muscle")}, sliding(4.7, which));
      const Organ organ = opened(built.bytes);
      EXPECT_NEAR(area_m2(organ), 3600e-6, 0.03 * 3600e-6) << thin_mm << " " << which;
      const double sign = which == "muscle:kidney" ? 1 : -1;
      const std::vector<Voxel> voxels = voxels_of(organ);
      for (const OrganSlideGround& g : organ.slide_grounds) {
        const double z_mm = low_of(organ, voxels[g.voxel]).z * 1e3;
        ASSERT_NEAR(static_cast<double>(g.distance[0]) * 4.7, sign * (z_mm - 20), 1e-4);
      }
    }
  }
}

// Without slides organs are what they were, also with gaps that stay open.
TEST(Slides, OthersHaveNone) {
  const Mesh low = box_mesh({0, 0, 0}, {50, 50, 17}), high = box_mesh({0, 0, 17}, {50, 50, 40});
  BuildOptions options = sliding(5);
  options.slides.clear();
  for (const bool split : {false, true}) {
    options.split = split;
    const auto built =
        build_quietly({input_of(low, 1e-3, "kidney"), input_of(high, 1e-3, "muscle")}, options);
    const Organ organ = opened(built.bytes);
    EXPECT_EQ(organ.format_version, 2U);
    EXPECT_GT(shared_particles(organ, "kidney", "muscle"), 0U);
  }
}

TEST(Slides, TwoGroundsAndAThirdTissue) {
  const Mesh low = box_mesh({0, 0, 0}, {30, 60, 20}), beside = box_mesh({30, 0, 0}, {60, 60, 20});
  const Mesh lid = box_mesh({0, 0, 20}, {60, 60, 35}), top = box_mesh({0, 0, 35}, {60, 60, 45});
  BuildOptions options = sliding(4.1);
  options.slides = offline::parse_slides({"muscle:kidney:0.3", "muscle:prostate:0"});
  const auto built =
      build_quietly({input_of(low, 1e-3, "kidney"), input_of(beside, 1e-3, "prostate"),
                     input_of(lid, 1e-3, "muscle"), input_of(top, 1e-3, "fat")},
                    options);
  const Organ organ = opened(built.bytes);
  EXPECT_EQ(shared_particles(organ, "muscle", "kidney"), 0U);
  EXPECT_EQ(shared_particles(organ, "muscle", "prostate"), 0U);
  EXPECT_GT(shared_particles(organ, "kidney", "prostate"), 0U);  // these two are joined
  EXPECT_GT(shared_particles(organ, "muscle", "fat"), 0U);
  std::map<std::string, double> squares;
  for (const OrganSlidePoint& p : organ.slide_points) {
    squares[p.friction > 0 ? "kidney" : "prostate"] += static_cast<double>(p.area) * 4.1 * 4.1;
    EXPECT_EQ(material_of(organ, p.voxel), "muscle");
  }
  constexpr double kHalfARow = 60 * 4.1 / 2;  // a point is on one ground or on the other
  EXPECT_NEAR(squares["kidney"], 1800, kHalfARow);
  EXPECT_NEAR(squares["kidney"] + squares["prostate"], 3600, 20);
  for (const OrganSlideGround& g : organ.slide_grounds) {
    ASSERT_NEAR(static_cast<double>(g.distance[0]) * 4.1,
                low_of(organ, voxels_of(organ)[g.voxel]).z * 1e3 - 20, 1e-4);
  }
}

TEST(Slides, AUserIsToldOfWhatDoesNotMeet) {
  const Mesh low = box_mesh({0, 0, 0}, {40, 40, 20}), far = box_mesh({0, 0, 60}, {40, 40, 80});
  const auto apart = build_quietly({input_of(low, 1e-3, "kidney"), input_of(far, 1e-3, "muscle")},
                                   sliding(5, "muscle:kidney"));
  EXPECT_THAT(
      apart.report.warnings,
      Contains("--slide 'muscle:kidney': no surface of muscle faces kidney within 10 mm; they "
               "are apart there and nothing keeps one out of the other: expected surfaces "
               "that touch, or nearly"));
  EXPECT_EQ(opened(apart.bytes).format_version, 2U);
  // Another tissue between them joins both in the only voxels that lie there.
  const Mesh deep = box_mesh({0, 0, 0}, {40, 40, 17}), film = box_mesh({0, 0, 17}, {40, 40, 19});
  const Mesh lid = box_mesh({0, 0, 19}, {40, 40, 40});
  const auto joined = build_quietly(
      {input_of(deep, 1e-3, "kidney"), input_of(lid, 1e-3, "muscle"), input_of(film, 1e-3, "fat")},
      sliding(8, "muscle:kidney"));
  EXPECT_THAT(joined.report.warnings,
              Contains(HasSubstr("--slide 'muscle:kidney': 16 of 16 cm2 are left out, because "
                                 "another tissue joins both parts")));
}

TEST(Slides, AUserIsToldOfOverlapsAndOfNothing) {
  const Mesh low = box_mesh({0, 0, 0}, {40, 40, 40});
  const auto built = [&](const Mesh& part, int priority, const std::string& crop = "") {
    BuildOptions options = sliding(4, "muscle:kidney");
    if (!crop.empty()) options.crop = offline::parse_crop({crop});
    return build_quietly({input_of(low, 1e-3, "kidney", priority), input_of(part, 1e-3, "muscle")},
                         options);
  };
  const auto overlapping = built(box_mesh({0, 0, 28}, {40, 40, 68}), 0);
  EXPECT_THAT(overlapping.report.warnings,
              Contains("--slide 'muscle:kidney': no surface of muscle faces kidney within 10 mm; "
                       "they overlap by 19.2 ml: expected surfaces that touch, or nearly, or a "
                       "higher priority for one of the two"));
  const std::string none =
      "--slide 'muscle:kidney': muscle has no voxel, so that nothing slides: expected some of it "
      "that is neither cropped away nor covered by a tissue of higher priority";
  EXPECT_THAT(built(box_mesh({12, 12, 12}, {28, 28, 28}), 1).report.warnings, Contains(none));
  const auto cropped = built(box_mesh({0, 0, 40}, {40, 40, 60}), 0, "z<30");
  EXPECT_THAT(cropped.report.warnings, Contains(none));
  EXPECT_THAT(cropped.report.warnings, testing::Not(Contains(HasSubstr("no surface"))));
}

// Where the ground has priority, a part that reaches into it has the ground's surface as its foot,
// and no more of it, however large the triangles are; and no points are beside one that the ground
// gives way to.
TEST(Slides, NoPointsBesideAPartThatOverlaps) {
  for (const double deep_mm : {1.0, 3.0, 7.0, 13.0}) {
    for (const int priority : {-1, 1}) {
      const auto built =
          build_quietly({input_of(box_mesh({0, 0, 0}, {60, 60, 20}), 1e-3, "kidney", priority),
                         input_of(box_mesh({10, 10, 20 - deep_mm}, {50, 50, 40}), 1e-3, "muscle")},
                        sliding(4, "muscle:kidney"));
      SCOPED_TRACE(testing::Message() << deep_mm << " " << priority);
      EXPECT_THAT(built.report.warnings, testing::Not(Contains(HasSubstr("left out"))));
      const Organ organ = opened(built.bytes);
      if (priority > 0) {
        EXPECT_NEAR(area_m2(organ), 1600e-6, 0.04 * 1600e-6);
      }
      const std::vector<Voxel> voxels = voxels_of(organ);
      for (const OrganSlidePoint& p : organ.slide_points) {
        const Vec at = place_of(organ, voxels, p) * 1e3;
        const double beyond = std::max(std::abs(at.x - 30), std::abs(at.y - 30)) - 20;
        ASSERT_LT(beyond, 2);
      }
    }
  }
}

// What lies on a held part, or bears it, does not drift.
TEST(Slides, WhatLiesOnAHeldPartIsBorne) {
  const auto findings = [](const std::string& held, double gap_mm) {
    BuildOptions options = sliding(5, "muscle:kidney");
    options.held = offline::parse_regions({held}, {1e-3});
    const auto built = build_quietly(
        {input_of(box_mesh({0, 0, 0}, {40, 40, 20}), 1e-3, "kidney"),
         input_of(box_mesh({5, 5, 20 + gap_mm}, {35, 35, 40 + gap_mm}), 1e-3, "muscle")},
        options);
    return offline::held_findings(offline::lattice_pieces(opened(built.bytes)));
  };
  EXPECT_THAT(findings("z<1", 0), IsEmpty());
  EXPECT_THAT(findings("z>39", 0), IsEmpty());
  EXPECT_THAT(findings("z<1", 15), testing::ElementsAre(HasSubstr("1 of 2 separate pieces")));
  EXPECT_THAT(findings("none", 0), testing::ElementsAre(HasSubstr("2 of 2 separate pieces")));
}

TEST(Slides, WhatCannotBeMeantIsRefused) {
  for (const char* text : {"", "liver", ":liver", "liver:", "a:b:c:d", "a:b:c:", "::"}) {
    EXPECT_EQ(
        refusal_of([&] { (void)offline::parse_slides({text}); }),
        "--slide '" + std::string(text) + "': expected TISSUE:GROUND or TISSUE:GROUND:FRICTION");
  }
  for (const char* word : {"", "x", "-0.1", "2.1", "nan", "inf", "0.1 ", "1e9"}) {
    const std::string text = "a:b:" + std::string(word);
    EXPECT_EQ(refusal_of([&] { (void)offline::parse_slides({text}); }),
              "--slide '" + text + "': friction " + word + ": expected a number from 0 to 2");
  }
  const auto check = [](const std::vector<std::string>& texts) {
    BuildOptions options;
    options.slides = offline::parse_slides(texts);
    options.layers = offline::parse_layers({"skin:3", "fascia:2"}, "--layer");
    options.layer_course.of = "muscle";
    return refusal_of([&] { offline::check_slides(options, {"liver", "muscle", "fat"}); });
  };
  EXPECT_EQ(check({"liver:muscle", "fat:muscle:0", "liver:fat"}), "");
  EXPECT_EQ(check({"liver:bone"}),
            "--slide 'liver:bone': bone: expected the tissue of one of the inputs");
  EXPECT_EQ(check({"liver:skin:0.10"}),
            "--slide 'liver:skin:0.10': skin is a layer, and layers slide with the input that they "
            "divide: expected the input's tissue, muscle");
  EXPECT_EQ(check({"liver:liver"}),
            "--slide 'liver:liver': liver cannot slide on itself: expected two tissues");
  EXPECT_EQ(check({"liver:fat", "liver:fat:0.3"}),
            "--slide 'liver:fat:0.3': liver slides on fat already (--slide 'liver:fat'): expected "
            "each pair of tissues once");
  EXPECT_EQ(check({"liver:fat", "fat:liver"}),
            "--slide 'fat:liver': liver slides on fat already (--slide 'liver:fat'): expected only "
            "one of two tissues to be the ground");
  std::vector<std::string> tissues, texts;
  for (int i = 0; i < 33; ++i) {
    tissues.push_back(std::to_string(i));
    if (i > 0) texts.push_back(tissues[0] + ":" + tissues.back());
  }
  BuildOptions many;
  many.slides = offline::parse_slides(texts);
  EXPECT_EQ(refusal_of([&] { offline::check_slides(many, tissues); }),
            "--slide: 33 tissues: expected at most 31");
}

// ---- in the kernel ------------------------------------------------------------------------------

// What touches at rest stays at rest, whatever cells the surface runs through.
TEST(Slides, RestIsRest) {
  Draw draw(3);
  for (int round = 0; round < 8; ++round) {
    const auto frame = random_frame(draw);
    const double level = draw.between(-4, 4);
    const Mesh low = turned(box_mesh({-25, -25, -20}, {25, 25, level}), frame);
    const Mesh high = turned(box_mesh({-25, -25, level}, {25, 25, 20}), frame);
    const auto built =
        build_quietly({input_of(low, 1e-3, "kidney"), input_of(high, 1e-3, "muscle")},
                      sliding(draw.between(3, 6), "muscle:kidney"));
    const Organ organ = opened(built.bytes);
    Session session = make_session(organ, Config{});
    for (int i = 0; i < 50; ++i) (void)tick(session.kernel, Input{});
    constexpr float kRoundingM = 1e-8F;
    EXPECT_LT(view_of(session.kernel).state.head->max_displacement_m, kRoundingM) << round;
  }
}

// A slab lies on another by its weight alone.
TEST(Slides, TheGroundBearsTheWeight) {
  for (const double level : {17.2, 20.0, 23.1}) {
    BuildOptions options = sliding(5, "muscle:kidney:0");
    options.held = offline::parse_regions({"z<1"}, {1e-3});
    const auto built =
        build_quietly({input_of(box_mesh({0, 0, 0}, {60, 60, level}), 1e-3, "kidney"),
                       input_of(box_mesh({10, 10, level}, {50, 50, 40}), 1e-3, "muscle")},
                      options);
    const Organ organ = opened(built.bytes);
    Config config;
    config.gravity_m_per_s2 = {0, 0, -9.81F};
    Session session = make_session(organ, config);
    for (int i = 0; i < 3000; ++i) (void)tick(session.kernel, Input{});
    const View view = view_of(session.kernel);
    double force = 0;
    for (std::uint32_t p = 0; p < view.model.head->counts.slide_points; ++p) {
      force += static_cast<double>(view.state.slide[p].stiffness_n_per_m *
                                   view.scratch.slide_contact[p].depth_m *
                                   view.scratch.slide_contact[p].slope.z);
    }
    const std::uint32_t lid = organ.voxel_material[organ.slide_points[0].voxel];
    const double density = static_cast<double>(organ_material(organ, lid).density_kg_per_m3);
    const double weight = 9.81 * density * 40e-3 * 40e-3 * (40 - level) * 1e-3;
    EXPECT_NEAR(force, weight, 0.05 * weight) << level;
    EXPECT_LT(view.state.head->max_displacement_m, 2e-3F) << level;
  }
}

// A plate as thin as a voxel is the ground of a slab and slides on another: each bears what lies on
// it.
TEST(Slides, AThinPlateBetweenTwoBearsAndIsBorne) {
  for (const double thick : {3.1, 5.0, 7.3}) {
    BuildOptions options = sliding(5, "muscle:kidney:0");
    // The last keeps the slab and the low one apart: the plate is too thin to do it.
    options.slides = offline::parse_slides({"muscle:kidney:0", "liver:muscle:0", "liver:kidney:0"});
    options.held = offline::parse_regions({"z<1"}, {1e-3});
    const double top = 18.4 + thick;
    const auto built =
        build_quietly({input_of(box_mesh({0, 0, 0}, {60, 60, 18.4}), 1e-3, "kidney"),
                       input_of(box_mesh({5, 5, 18.4}, {55, 55, top}), 1e-3, "muscle"),
                       input_of(box_mesh({10, 10, top}, {50, 50, 45}), 1e-3, "liver")},
                      options);
    const Organ organ = opened(built.bytes);
    Config config;
    config.gravity_m_per_s2 = {0, 0, -9.81F};
    Session session = make_session(organ, config);
    for (int i = 0; i < 3000; ++i) (void)tick(session.kernel, Input{});
    const View view = view_of(session.kernel);
    std::map<std::string, double> force, mass;
    for (std::uint32_t p = 0; p < view.model.head->counts.slide_points; ++p) {
      const SlideContact& c = view.scratch.slide_contact[p];
      force[material_of(organ, organ.slide_points[p].voxel)] +=
          static_cast<double>(view.state.slide[p].stiffness_n_per_m * c.depth_m * c.slope.z);
    }
    for (std::uint32_t voxel = 0; voxel < organ.voxel_count; ++voxel) {
      const auto material = organ_material(organ, organ.voxel_material[voxel]);
      mass[material_of(organ, voxel)] += static_cast<double>(material.density_kg_per_m3) * 125e-9 *
                                         organ.voxel_fill[voxel] / 255.0;
    }
    EXPECT_NEAR(force["liver"], 9.81 * mass["liver"], 0.05 * 9.81 * mass["liver"]) << thick;
    const double both = 9.81 * (mass["liver"] + mass["muscle"]);
    EXPECT_NEAR(force["muscle"], both, 0.05 * both) << thick;
  }
}

// How far the points have gone along x, on average, m.
double gone_x_m(const View& view) {
  double sum = 0;
  for (std::uint32_t p = 0; p < view.model.head->counts.slide_points; ++p) {
    const SlidePoint& point = view.model.slide_point[p];
    for (std::size_t i = 0; i < 8; ++i) {
      sum += static_cast<double>(point.weight[i] * view.state.ux[point.node[i]]);
    }
  }
  return sum / view.model.head->counts.slide_points;
}

// A slab slides on another body, as on a slope. A needle goes through both and holds it.
TEST(Slides, ANeedleCrossesAndHoldsWhatSlides) {
  BuildOptions options = sliding(4.6, "muscle:kidney:0.3");
  options.held = offline::parse_regions({"z<1"}, {1e-3});
  const auto built =
      build_quietly({input_of(box_mesh({0, 0, 0}, {100, 60, 30.7}), 1e-3, "kidney"),
                     input_of(box_mesh({10, 10, 30.7}, {70, 50, 45}), 1e-3, "muscle")},
                    options);
  const Organ organ = opened(built.bytes);
  for (const bool with_needle : {false, true}) {
    Config config;
    config.gravity_m_per_s2 = {3.6F, 0, -9.81F};
    Session session = make_session(organ, config);
    const View view = view_of(session.kernel);
    std::set<std::string> met;
    std::vector<double> gone_mm;
    for (int t = 0; t < 1600; ++t) {
      const float way_mm = std::clamp(0.1F * static_cast<float>(t - 600), 0.0F, 32.0F);
      const float tip_mm = with_needle ? 47 - way_mm : 100;
      Input input{};
      input.handle = {{48e-3F, 30e-3F, tip_mm * 1e-3F + config.needle[0].length_m}, {1, 0, 0, 0}};
      input.valid = 1;
      const Output out = tick(session.kernel, input);
      ASSERT_TRUE(std::isfinite(out.force_n.x + out.force_n.y + out.force_n.z));
      if (out.layer != kNoLayer) met.insert(organ_material(organ, out.layer).name);
      gone_mm.push_back(gone_x_m(view) * 1e3);
    }
    EXPECT_GT(gone_mm[600], 1);  // it slides before the needle comes
    EXPECT_EQ(met.size(), with_needle ? 2U : 0U);
    if (with_needle) {
      EXPECT_LT(gone_mm[1599], gone_mm[600] + 2);
      EXPECT_NEAR(gone_mm[1599], gone_mm[1399], 0.5);
    } else {
      EXPECT_GT(gone_mm[1599], 8);
    }
  }
}

// ---- label maps ---------------------------------------------------------------------------------

// A map of 48 x 48 x 40 mm in two halves, below and above a height.
offline::LabelMap two_halves(std::uint32_t height) {
  offline::LabelMap map;
  map.size = {24, 24, 20};
  map.step_m = {Vec{2e-3, 0, 0}, {0, 2e-3, 0}, {0, 0, 2e-3}};
  for (std::uint32_t i = 0; i < 24 * 24 * 20; ++i) {
    map.label.push_back(i / (24 * 24) < height ? 1 : 2);
  }
  return map;
}

TEST(Slides, LabelsSlideAsMeshesDo) {
  for (const std::uint32_t height : {7U, 10U, 12U}) {
    for (const double voxel_mm : {2.6, 4.0, 5.3}) {
      offline::Recipe recipe = {{}, {{"kidney", {1}}, {"muscle", {2}}}};
      recipe.smoothing = 0;
      const auto built =
          offline::build_labels("map.nrrd", two_halves(height), recipe,
                                sliding(voxel_mm, "muscle:kidney"), [](const char*, double) {});
      SCOPED_TRACE(testing::Message() << height << " " << voxel_mm);
      EXPECT_THAT(built.report.warnings, IsEmpty());
      const Organ organ = opened(built.bytes);
      EXPECT_EQ(shared_particles(organ, "kidney", "muscle"), 0U);
      expect_in_their_parts(organ, "muscle", "kidney");
      EXPECT_NEAR(area_m2(organ), 48e-3 * 48e-3, 0.02 * 48e-3 * 48e-3);
      const std::vector<Voxel> voxels = voxels_of(organ);
      const double plane_mm = 2.0 * height - 1;
      for (const OrganSlideGround& g : organ.slide_grounds) {
        const double z_mm = low_of(organ, voxels[g.voxel]).z * 1e3;
        ASSERT_NEAR(static_cast<double>(g.distance[0]) * voxel_mm, z_mm - plane_mm, 1e-4);
      }
      // A needle finds the surfaces of both: each half is closed.
      double volume = 0;
      for (const OrganTriangle& t : organ.triangles) {
        const auto at = [&](std::uint32_t v) {
          const OrganVertex& vertex = organ.vertices[v];
          return low_of(organ, voxels[vertex.voxel]) +
                 Vec{1.0 * vertex.fx, 1.0 * vertex.fy, 1.0 * vertex.fz} * (voxel_mm * 1e-3 / 65535);
        };
        volume += dot(at(t.a), cross(at(t.b), at(t.c))) / 6;
      }
      EXPECT_NEAR(volume, 48e-3 * 48e-3 * 40e-3, 0.03 * 48e-3 * 48e-3 * 40e-3);
    }
  }
}

// Labels in any disorder, with gaps that stay open or not: parts are apart, and the kernel takes
// the file, which says that points are in no ground.
TEST(Slides, AnyLabels) {
  Draw draw(41);
  for (int round = 0; round < 6; ++round) {
    offline::LabelMap map = two_halves(10);
    const double noise = draw.between(0, 1), grain = draw.between(1, 4);
    std::vector<std::uint16_t> drawn;
    for (int i = 0; i < 24 * 24 * 20; ++i) {
      drawn.push_back(static_cast<std::uint16_t>(draw.below(round % 2 == 0 ? 2 : 3) + 1));
    }
    for (std::size_t i = 0; i < map.label.size(); ++i) {
      const auto coarse = static_cast<std::size_t>(static_cast<double>(i) / grain);
      if (draw.between(0, 1) < noise) map.label[i] = drawn[coarse] % 3;
    }
    const offline::Recipe recipe = {{}, {{"kidney", {1}}, {"muscle", {2}}}};
    BuildOptions options = sliding(draw.between(2.5, 7), "muscle:kidney");
    options.split = draw.coin();
    try {
      const auto built =
          offline::build_labels("map.nrrd", map, recipe, options, [](const char*, double) {});
      const Organ organ = opened(built.bytes);
      EXPECT_EQ(shared_particles(organ, "kidney", "muscle"), 0U) << round;
      for (const OrganSlidePoint& p : organ.slide_points) {
        ASSERT_EQ(material_of(organ, p.voxel), "muscle") << round;
      }
    } catch (const offline::Refusal& refused) {
      EXPECT_THAT(refused.what(), HasSubstr("sheets")) << round;
    }
  }
}

// A map much finer than the voxels, with noise where two tissues meet: no point stands for more
// than the kernel allows, and none of the area is lost.
TEST(Slides, CrumpledSurfaces) {
  Draw draw(43);
  offline::LabelMap map = two_halves(10);
  for (Vec& step : map.step_m) step = step * 0.25;
  for (std::size_t i = 24 * 24 * 6; i < 24 * 24 * 14; ++i) map.label[i] = draw.coin() ? 1 : 2;
  offline::Recipe recipe = {{}, {{"kidney", {1}}, {"muscle", {2}}}};
  recipe.smoothing = 0;
  const auto built = offline::build_labels("map.nrrd", map, recipe, sliding(7, "muscle:kidney"),
                                           [](const char*, double) {});
  const Organ organ = opened(built.bytes);
  ASSERT_FALSE(organ.slide_points.empty());
  double most = 0;
  for (const OrganSlidePoint& p : organ.slide_points) {
    most = std::max(most, static_cast<double>(p.area));
  }
  EXPECT_GT(most, 1);
  EXPECT_GT(area_m2(organ), 10 * 12e-3 * 12e-3);
}

TEST(Slides, ARecipeSaysWhatSlides) {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return offline::read_recipe(
        scratch.write("r.toml", "[tissues]\nliver = [1]\nmuscle = [2]\n" + text));
  };
  const auto slides = read(
                          "[[slide]]\ntissue = \"liver\"\non = \"muscle\"\n[[slide]]\n"
                          "tissue = \"fat\"\non = \"liver\"\nfriction = 0.25\n")
                          .slides;
  ASSERT_EQ(slides.size(), 2U);
  EXPECT_EQ(offline::text_of(slides[0]), "liver:muscle:0.1");
  EXPECT_EQ(offline::text_of(slides[1]), "fat:liver:0.25");
  EXPECT_THAT(slides[1].from, testing::EndsWith("r.toml:7: [[slide]]"));
  for (const char* bad :
       {"[slide]\ntissue = \"a\"\n", "[[slide]]\ntissue = \"a\"\n",
        "[[slide]]\ntissue = \"a\"\non = 1\n", "[[slide]]\ntissue = \"a\"\non = \"b\"\nx = 1\n"}) {
    const std::string said = refusal_of([&] { (void)read(bad); });
    EXPECT_THAT(said, HasSubstr("[[slide]]: expected tissue")) << bad;
  }
  EXPECT_THAT(
      refusal_of([&] { (void)read("[[slide]]\ntissue = \"a\"\non = \"b\"\nfriction = 3\n"); }),
      HasSubstr("r.toml:7: friction: expected a number from 0 to 2"));
}

// What a user writes is in the file, and gives the same organ again.
TEST(Slides, TheOptionIsInTheFile) {
  offline::Settings settings;
  settings.slides = {"muscle:kidney:0.25"};
  settings.voxel_mm = 4;
  std::vector<offline::Input> inputs = {
      input_of(box_mesh({0, 0, 0}, {40, 40, 20}), 1e-3, "kidney"),
      input_of(box_mesh({0, 0, 20}, {40, 40, 40}), 1e-3, "muscle")};
  BuildOptions options = offline::common_options(settings, {1e-3});
  offline::choose_for_meshes(settings, inputs, options);
  EXPECT_THAT(options.options_text, HasSubstr(" --slide muscle:kidney:0.25"));
  const auto built = build_quietly(inputs, options), again = build_quietly(inputs, options);
  EXPECT_EQ(built.bytes, again.bytes);
  settings.slides = {"muscle:liver"};
  options = offline::common_options(settings, {1e-3});
  EXPECT_EQ(refusal_of([&] { offline::choose_for_meshes(settings, inputs, options); }),
            "--slide 'muscle:liver': liver: expected the tissue of one of the inputs");
}

}  // namespace
}  // namespace stylet::test
