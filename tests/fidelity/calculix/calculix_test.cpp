// SPDX-License-Identifier: Apache-2.0
// The lattice against an independent solver: CalculiX's values of the same bodies (calculix.csv).
//
// Both must have converged: halving CalculiX's bricks changes a value by less than 2 %, halving the
// voxels by less than 5 %. Then they must agree within 5 %, and finer voxels must come closer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bodies.h"

namespace stylet::test {
namespace {

const Bodies& bodies() {
  static const Bodies kBodies = read_bodies(STYLET_CALCULIX_FOLDER "/bodies.json");
  return kBodies;
}

const BodyCase& body_named(const std::string& name) {
  for (const BodyCase& body : bodies().cases) {
    if (body.name == name) return body;
  }
  throw std::runtime_error("bodies.json: no case " + name);
}

// CalculiX's values of one body, from coarse to fine bricks.
std::vector<Values> reference(const std::string& name, double poisson) {
  std::vector<Values> out(bodies().brick_edges_m.size());
  std::ifstream file(STYLET_CALCULIX_FOLDER "/calculix.csv");
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    std::string cell[5];
    for (std::string& c : cell) std::getline(row, c, ',');
    if (cell[0] != name || std::stod(cell[1]) != poisson) continue;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (std::stod(cell[2]) == bodies().brick_edges_m[i]) out[i][cell[3]] = std::stod(cell[4]);
    }
  }
  return out;
}

struct BodyAt {
  std::string name;
  double poisson;
};

void PrintTo(const BodyAt& at, std::ostream* out) {
  *out << at.name << ", nu " << at.poisson;
}

std::vector<BodyAt> all_bodies() {
  std::vector<BodyAt> out;
  for (const BodyCase& body : bodies().cases) {
    for (const double poisson : bodies().poisson_ratios) out.push_back({body.name, poisson});
  }
  return out;
}

constexpr double kAsGoodAsEqual = 0.005;

class FidelityCalculix : public testing::TestWithParam<BodyAt> {};

TEST_P(FidelityCalculix, ForceAndDisplacementAgree) {
  const auto& [name, poisson] = GetParam();
  const BodyCase& body = body_named(name);
  const std::vector<Values> bricks = reference(name, poisson);
  std::vector<Values> voxels;
  for (const double edge_m : body.voxel_edges_m) {
    voxels.push_back(solve_body(bodies(), body, poisson, edge_m));
  }
  ASSERT_EQ(bricks.back().size(), voxels.back().size());
  const std::size_t last_brick = bricks.size() - 1, last_voxel = voxels.size() - 1;
  for (const auto& [quantity, value] : voxels[last_voxel]) {
    const double wanted = bricks[last_brick].at(quantity);
    EXPECT_NEAR(bricks[last_brick - 1].at(quantity) / wanted, 1, 0.02) << "bricks, " << quantity;
    EXPECT_NEAR(voxels[last_voxel - 1].at(quantity) / value, 1, 0.05) << "voxels, " << quantity;
    EXPECT_NEAR(value / wanted, 1, 0.05) << quantity;
  }
  // The force on the loaded box or its displacement; for a needle the first probe.
  const auto& [leading, wanted] = *bricks[last_brick].begin();
  double last_error = HUGE_VAL;
  for (const Values& values : voxels) {
    const double error = std::abs(values.at(leading) / wanted - 1);
    EXPECT_LT(error, std::max(last_error, kAsGoodAsEqual)) << leading;
    last_error = error;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, FidelityCalculix, testing::ValuesIn(all_bodies()),
                         [](const testing::TestParamInfo<BodyAt>& row) {
                           return row.param.name + "_nu" +
                                  std::to_string(std::lround(row.param.poisson * 100));
                         });

// The comparison is sharp enough to tell materials apart: a punch on tissue with one Poisson ratio
// does not pass as one on tissue with the other.
TEST(FidelityCalculixSharpness, OtherPoissonRatioIsRefused) {
  const BodyCase& body = body_named("punch");
  const double wanted = reference("punch", 0.45).back().at("force_n");
  const double edge_m = body.voxel_edges_m[1];
  EXPECT_NEAR(solve_body(bodies(), body, 0.45, edge_m).at("force_n") / wanted, 1, 0.05);
  EXPECT_GT(std::abs(solve_body(bodies(), body, 0.3, edge_m).at("force_n") / wanted - 1), 0.05);
}

}  // namespace
}  // namespace stylet::test
