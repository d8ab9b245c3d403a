// SPDX-License-Identifier: Apache-2.0
// Tissue that stiffens (PHYSICS 2.7) against CalculiX's hyperelastic bodies of stiffening.csv.
//
// Blocks are held below and moved above, so far that they get stiffer by several times what the two
// may differ by. Both solvers must have converged, and agree within 2 %.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

struct Layer {
  double thickness_m, youngs_modulus_pa, stiffening;
};

struct Block {
  std::string name;
  Vec size_m, move_m;
  double twist_rad;
  bool both_ways;             // the mean with the opposite motion
  std::vector<Layer> layers;  // from the bottom up
};

struct Blocks {
  std::vector<double> poissons, brick_edges_m, voxel_edges_m;
  std::vector<Block> block;
};

Vec vec_of(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

const Blocks& blocks() {
  static const Blocks kBlocks = [] {
    std::ifstream file(STYLET_CALCULIX_FOLDER "/stiffening.json");
    const nlohmann::json json = nlohmann::json::parse(file);
    Blocks out;
    out.poissons = json.at("poisson_ratios").get<std::vector<double>>();
    out.brick_edges_m = json.at("brick_edges_m").get<std::vector<double>>();
    out.voxel_edges_m = json.at("voxel_edges_m").get<std::vector<double>>();
    for (const nlohmann::json& one : json.at("cases")) {
      Block block = {one.at("name").get<std::string>(),
                     vec_of(one.at("size_m")),
                     Vec::Zero(),
                     0,
                     one.value("both_ways", false),
                     {}};
      if (one.contains("move_m")) block.move_m = vec_of(one.at("move_m"));
      if (one.contains("twist_rad")) block.twist_rad = one.at("twist_rad");
      for (const nlohmann::json& layer : one.at("layers")) {
        block.layers.push_back({layer.at("thickness_m").get<double>(),
                                layer.at("youngs_modulus_pa").get<double>(),
                                layer.at("strain_stiffening").get<double>()});
      }
      out.block.push_back(block);
    }
    return out;
  }();
  return kBlocks;
}

// CalculiX's forces, from coarse to fine bricks.
std::vector<double> reference(const std::string& name, double poisson) {
  std::vector<double> out;
  std::ifstream file(STYLET_CALCULIX_FOLDER "/stiffening.csv");
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    std::string cell[4];
    for (std::string& c : cell) std::getline(row, c, ',');
    if (cell[0] == name && std::stod(cell[1]) == poisson) out.push_back(std::stod(cell[3]));
  }
  return out;
}

TinyOrgan organ_of(const Block& block, double poisson, double edge_m, bool stiffens) {
  const auto edges = [&](double length_m) {
    return static_cast<std::uint16_t>(std::lround(length_m / edge_m));
  };
  TinyOrgan tiny;
  tiny.nx = edges(block.size_m.x());
  tiny.ny = edges(block.size_m.y());
  tiny.nz = edges(block.size_m.z());
  tiny.voxel_edge_m = static_cast<float>(edge_m);
  tiny.fixed_faces = kLowZ;
  tiny.materials.clear();
  std::vector<std::uint8_t> material_at;
  for (const Layer& layer : block.layers) {
    material_at.insert(material_at.end(), edges(layer.thickness_m),
                       static_cast<std::uint8_t>(tiny.materials.size()));
    TinyMaterial material =
        elastic(static_cast<float>(layer.youngs_modulus_pa / (2 * (1 + poisson))),
                static_cast<float>(poisson));
    if (stiffens) material.strain_stiffening = static_cast<float>(layer.stiffening);
    tiny.materials.push_back(material);
  }
  tiny.material_at = [material_at](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return material_at[z];
  };
  return tiny;
}

// Force along the motion of the top, or the torque about its middle.
double solve_once(const Block& block, double poisson, double edge_m, bool stiffens) {
  const TinyOrgan tiny = organ_of(block, poisson, edge_m, stiffens);
  const bool bends = block.size_m.z() > 2 * block.size_m.x();
  const std::uint32_t wave = bends ? 3U * tiny.nz : tiny.nz;  // bending is slower
  Rig rig = make_rig(tiny, resting_config(1.0F / 3, static_cast<float>(poisson), wave));
  View view = rig.view();
  const Vec middle(block.size_m.x() / 2, block.size_m.y() / 2, block.size_m.z());
  const Mat turn = Eigen::AngleAxisd(block.twist_rad, Vec::UnitZ()).toRotationMatrix();
  std::vector<Vec> acting;  // of the nodes at the top: a force's part that counts
  for_each_node(view, [&](Node node) {
    const Vec arm = edge_m * in_edges(node) - middle;
    const Vec way = turn * arm - arm + block.move_m;
    const std::uint32_t at = node_index(view, node);
    if (node.z < tiny.nz) {  // begins where a bar would be, to come to rest soon
      const double part = static_cast<double>(node.z) / tiny.nz;
      if (node.z > 0) place(view, at, part * way);
      return;
    }
    const Vec turned = turn * arm;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      hold(rig, at, static_cast<std::size_t>(axis), way[axis]);
    }
    acting.push_back(block.twist_rad != 0 ? Vec(-turned.y(), turned.x(), 0)
                                          : Vec(block.move_m.normalized()));
  });
  settle(rig, 3e-6);
  double force = 0;
  for (std::size_t i = 0; i < rig.holds.size(); ++i) {
    force -= rig.holds[i].force_n * acting[i / 3][static_cast<Eigen::Index>(rig.holds[i].axis)];
  }
  return force;
}

double solve_block(Block block, double poisson, double edge_m, bool stiffens) {
  const double force = solve_once(block, poisson, edge_m, stiffens);
  if (!block.both_ways) return force;
  block.move_m = -block.move_m;
  return (force + solve_once(block, poisson, edge_m, stiffens)) / 2;
}

struct BlockAt {
  std::size_t block;
  double poisson;
};

void PrintTo(const BlockAt& at, std::ostream* out) {
  *out << blocks().block[at.block].name << ", nu " << at.poisson;
}

std::vector<BlockAt> all_blocks() {
  std::vector<BlockAt> out;
  for (std::size_t i = 0; i < blocks().block.size(); ++i) {
    for (const double poisson : blocks().poissons) out.push_back({i, poisson});
  }
  return out;
}

class FidelityStiffening : public testing::TestWithParam<BlockAt> {};

TEST_P(FidelityStiffening, ForceAgreesWithAHyperelasticBody) {
  const auto [at, poisson] = GetParam();
  const Block& block = blocks().block[at];
  const std::vector<double> bricks = reference(block.name, poisson);
  ASSERT_EQ(bricks.size(), blocks().brick_edges_m.size());
  std::vector<double> voxels;
  for (const double edge_m : blocks().voxel_edges_m) {
    voxels.push_back(solve_block(block, poisson, edge_m, true));
  }
  const std::size_t last_brick = bricks.size() - 1, last_voxel = voxels.size() - 1;
  const double wanted = bricks[last_brick];
  EXPECT_NEAR(bricks[last_brick - 1] / wanted, 1, 0.02) << "bricks";
  EXPECT_NEAR(voxels[last_voxel - 1] / voxels[last_voxel], 1, 0.02) << "voxels";
  EXPECT_NEAR(voxels[last_voxel] / wanted, 1, 0.02);
  const double linear = solve_block(block, poisson, blocks().voxel_edges_m[0], false);
  EXPECT_GT(voxels[0] / linear, 1.05) << "not far enough to tell stiffening from none";
  std::printf("%s, nu %g: %+.1f %% of CalculiX's, %.2f times the linear tissue's\n",
              block.name.c_str(), poisson, 100 * (voxels[last_voxel] / wanted - 1),
              voxels[0] / linear);
}

INSTANTIATE_TEST_SUITE_P(Blocks, FidelityStiffening, testing::ValuesIn(all_blocks()),
                         [](const testing::TestParamInfo<BlockAt>& row) {
                           return blocks().block[row.param.block].name + "_nu" +
                                  std::to_string(std::lround(row.param.poisson * 100));
                         });

}  // namespace
}  // namespace stylet::test
