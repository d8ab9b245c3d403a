// SPDX-License-Identifier: Apache-2.0
// stylet-organ hull: obstacles from meshes, as close as reported; a refusal is one line.
#include "meshes/hull.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <random>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "stylet/limits.h"

namespace stylet::test {
namespace {

using offline::Vec;

// Largest distance by which `points` lie outside the hull, over many directions: a lower bound of
// the deviation that needs no hull.
double sampled_deviation(const std::vector<Vec>& points, const std::vector<Vec>& vertices) {
  std::mt19937_64 engine(1);
  const auto draw = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-52 - 1; };
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec direction = {draw(), draw(), draw()};
    if (offline::length(direction) < 0.1) continue;
    direction = direction * (1 / offline::length(direction));
    const auto reach = [&](const std::vector<Vec>& of) {
      double most = -1e9;
      for (const Vec& p : of) most = std::max(most, dot(p, direction));
      return most;
    };
    const double outside = reach(points) - reach(vertices);
    EXPECT_GE(outside, -1e-12);  // the body is nowhere larger than the mesh's hull
    worst = std::max(worst, outside);
  }
  return worst;
}

TEST(Hull, OfABlockIsItsEightCorners) {
  const offline::Mesh block = offline::block_phantom({0.04, 0.03, 0.02}, 0.005);
  const offline::Hull hull = offline::simple_hull("block", block.points, kMaxHullVertices);
  EXPECT_EQ(hull.vertices_m.size(), 8U);
  EXPECT_EQ(hull.deviation_m, 0);
  EXPECT_NEAR(hull.volume_m3, 0.04 * 0.03 * 0.02, 1e-12);
}

// Leaves holes of many sizes in the heap, different ones for each seed.
std::vector<std::vector<char>> litter(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<char>> blocks(4000);
  for (std::vector<char>& block : blocks) block.resize(16 + engine() % 8000);
  std::shuffle(blocks.begin(), blocks.end(), engine);
  blocks.resize(blocks.size() / 2);
  return blocks;
}

// In a surface of voxels many corners lie in one plane, equally far from a body. If the hull's
// order depended on addresses, it would choose different ones each time.
TEST(Hull, IsTheSameWhateverLiesInTheHeap) {
  std::vector<Vec> corners;
  for (int z = -9; z <= 9; ++z) {
    for (int y = -9; y <= 9; ++y) {
      for (int x = -9; x <= 9; ++x) {
        if (x * x + 2 * y * y + z * z <= 81)
          corners.push_back(Vec{1.0 * x, 1.0 * y, 1.0 * z} * 0.003);
      }
    }
  }
  const offline::Hull first = offline::simple_hull("voxels", corners, 24);
  const double volume_m3 = offline::hull_volume_m3(corners);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<std::vector<char>> blocks = litter(seed);
    const offline::Hull hull = offline::simple_hull("voxels", corners, 24);
    EXPECT_EQ(hull.vertices_m, first.vertices_m);
    EXPECT_EQ(hull.hull_vertices, first.hull_vertices);
    EXPECT_EQ(hull.volume_m3, first.volume_m3);
    EXPECT_EQ(hull.deviation_m, first.deviation_m);
    EXPECT_EQ(offline::hull_volume_m3(corners), volume_m3);
  }
}

TEST(Hull, OfABallIsAsCloseAsItSays) {
  const offline::Mesh ball = offline::ball_phantom(0.06, 0.004);
  double last = 1;
  for (const std::size_t most : {4U, 8U, 16U, 32U, 64U}) {
    const offline::Hull hull = offline::simple_hull("ball", ball.points, most);
    EXPECT_EQ(hull.vertices_m.size(), most);
    EXPECT_LT(hull.deviation_m, last);
    last = hull.deviation_m;
    const double sampled = sampled_deviation(ball.points, hull.vertices_m);
    EXPECT_LE(sampled, hull.deviation_m + 1e-12);
    EXPECT_GT(sampled, 0.8 * hull.deviation_m);
    for (const Vec& v : hull.vertices_m) {
      EXPECT_NE(std::find(ball.points.begin(), ball.points.end(), v), ball.points.end());
    }
  }
  // 64 evenly spread points leave caps of about 0.35 rad: 30 mm (1 - cos 0.35) = 1.8 mm; points
  // chosen greedily leave more.
  EXPECT_LT(last, 3.6e-3);
}

// Four points anywhere: the volume is a sixth of their determinant.
TEST(Hull, OfFourPointsIsTheirTetrahedronWhereverItIs) {
  std::mt19937_64 engine(28);
  const auto draw = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-52 - 1; };
  for (int i = 0; i < 100; ++i) {
    const Vec from = {0.2 * draw(), 0.2 * draw(), 0.2 * draw()};
    std::vector<Vec> points;
    for (int p = 0; p < 4; ++p) points.push_back(from + Vec{draw(), draw(), draw()} * 0.03);
    const double determinant =
        dot(points[1] - points[0], cross(points[2] - points[0], points[3] - points[0]));
    if (std::abs(determinant) < 1e-7) continue;  // nearly flat
    const offline::Hull hull = offline::simple_hull("four", points, kMaxHullVertices);
    EXPECT_NEAR(hull.volume_m3, std::abs(determinant) / 6, 1e-12) << i;
  }
}

TEST(Hull, OfRealBonesIsWithinTwoMillimetres) {
  for (const char* name : {"cgal_femur.off", "sofa_pelvis_f.obj"}) {
    const auto path = data_folder() / "organs" / name;
    SKIP_WITHOUT(path);
    std::vector<Vec> points;
    for (const Vec& p : offline::read_mesh(path).mesh.points) points.push_back(p * 0.1);
    const offline::Hull hull = offline::simple_hull(name, points, kMaxHullVertices);
    std::printf("%s: %zu of %zu vertices, %.3f mm\n", name, hull.vertices_m.size(),
                hull.hull_vertices, hull.deviation_m * 1e3);
    EXPECT_LT(hull.deviation_m, 2e-3);
    EXPECT_LE(sampled_deviation(points, hull.vertices_m), hull.deviation_m + 1e-12);
  }
}

// Seconds of this process's own time, the shortest of five.
double seconds_for_ball(std::size_t count) {
  std::mt19937_64 engine(count);
  std::normal_distribution<double> draw;
  std::vector<Vec> points;
  while (points.size() < count) {
    const Vec p = {draw(engine), draw(engine), draw(engine)};
    points.push_back(p * (0.1 / offline::length(p)));
  }
  double least = 1e9;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t start = std::clock();
    EXPECT_EQ(offline::simple_hull("ball", points, 32).hull_vertices, count);
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// Every point is a vertex of the hull, which is the largest possible choice.
TEST(HullTimed, TakesTimeInProportionToThePoints) {
  const double few = seconds_for_ball(8000), many = seconds_for_ball(32000);
  std::printf("8000 points: %.3f s; 32 000: %.3f s\n", few, many);
  // n log n would take 4.6 times as long, n^2 16 times; the bound is the geometric mean of 4 and
  // 16.
  EXPECT_LT(many, 8 * few);
}

TEST(Hull, RefusesPointsWithoutAnInside) {
  EXPECT_EQ(offline::hull_volume_m3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 0);
  const auto refusal = [](const std::vector<Vec>& points) -> std::string {
    try {
      (void)offline::simple_hull("bone.stl", points, 64);
    } catch (const offline::Refusal& refused) {
      return refused.what();
    }
    return "";
  };
  const std::vector<Vec> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}};
  EXPECT_EQ(refusal(square),
            "bone.stl: all points lie in one plane: expected a mesh with an inside");
  EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), "");
  EXPECT_NE(refusal({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "");
  EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "");
  EXPECT_NE(refusal({{0, 0, 0}, {11, 0, 0}, {0, 1, 0}, {0, 0, 1}}).find("--units"),
            std::string::npos);
}

// ---- the program --------------------------------------------------------------------------------

int run(const Scratch& scratch, const std::string& arguments) {
  const std::string command =
      fmt::format("{} hull {} > '{}' 2> '{}'", STYLET_ORGAN, arguments,
                  (scratch.folder / "out").string(), (scratch.folder / "err").string());
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Hull, ProgramWritesTheSameTomlTwice) {
  const Scratch scratch;
  const auto mesh =
      scratch.write("ball \"1\".off", offline::off_text(offline::ball_phantom(60, 4)));
  const auto one = scratch.folder / "one.toml", two = scratch.folder / "two.toml";
  const std::string input = fmt::format("'{}' --units mm --max-vertices 20 -o ", mesh.string());
  ASSERT_EQ(run(scratch, input + one.string()), 0) << slurp(scratch.folder / "err");
  EXPECT_NE(slurp(scratch.folder / "out").find("deviation"), std::string::npos);
  ASSERT_EQ(run(scratch, input + two.string()), 0);
  const std::string text = slurp(one);
  EXPECT_EQ(text, slurp(two));
  EXPECT_NE(text.find("source = \"ball \\\"1\\\".off\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("deviation_mm = "), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '['), 21);
}

TEST(Hull, ProgramRefusesInOneLineAndLeavesNothing) {
  const Scratch scratch;
  const auto flat =
      scratch.write("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n");
  const auto output = scratch.folder / "a.toml";
  const auto refused = [&](const std::string& arguments, int code) {
    EXPECT_EQ(run(scratch, arguments + " -o " + output.string()), code);
    const std::string said = slurp(scratch.folder / "err");
    if (code == 1) {
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    }
    EXPECT_FALSE(std::filesystem::exists(output));
  };
  refused(flat.string(), 1);
  refused((scratch.folder / "none.stl").string(), 1);
  refused(flat.string() + " --max-vertices 65", 2);
  refused(flat.string() + " --max-vertices 3", 2);
  refused(flat.string() + " --units foot", 2);
}

}  // namespace
}  // namespace stylet::test
