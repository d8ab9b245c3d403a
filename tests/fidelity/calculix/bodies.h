// SPDX-License-Identifier: Apache-2.0
// The bodies of bodies.json in the kernel's lattice, at rest under their load.
//
// A case is a quarter of a layered block on a fixed bottom. A box in it is loaded: it is moved as
// one piece (nodes held along one axis), pulled by a force spread evenly over its voxels, or, if
// the box is a line, pulled by constraint particles as those of a needle. Values are named as in
// calculix.csv. Units: SI. Frame: rest frame, the block's low corner at 0.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rig.h"

namespace stylet::test {

using Point = std::array<double, 3>;

struct Layer {
  double thickness_m, youngs_modulus_pa;
};

enum class Act { kMove, kPullBox, kPullLine };

struct BodyCase {
  std::string name;
  std::vector<double> voxel_edges_m;  // from coarse to fine
  std::vector<Layer> layers;          // from the bottom up
  Act act;
  std::size_t axis;
  Point low_m, high_m;
  double amount;  // displacement in m, or force in N on the quarter
  std::vector<Point> probes_m;
};

struct Bodies {
  Point quarter_m;
  std::vector<double> brick_edges_m, poisson_ratios;
  std::vector<BodyCase> cases;
};

inline BodyCase read_case(const nlohmann::json& json) {
  BodyCase out;
  out.name = json.at("name");
  out.voxel_edges_m = json.at("voxel_edges_m").get<std::vector<double>>();
  for (const nlohmann::json& layer : json.at("layers")) {
    out.layers.push_back({layer.at("thickness_m"), layer.at("youngs_modulus_pa")});
  }
  const nlohmann::json& act = json.at("act");
  out.axis = act.at("axis");
  out.low_m = act.at("low_m");
  out.high_m = act.at("high_m");
  const bool moved = act.contains("displacement_m");
  const bool line = out.low_m[0] == out.high_m[0] && out.low_m[1] == out.high_m[1];
  out.act = moved ? Act::kMove : line ? Act::kPullLine : Act::kPullBox;
  out.amount = act.at(moved ? "displacement_m" : "force_n");
  out.probes_m = json.at("probes_m").get<std::vector<Point>>();
  return out;
}

inline Bodies read_bodies(const std::string& path) {
  std::ifstream file(path);
  const nlohmann::json json = nlohmann::json::parse(file);
  Bodies out;
  out.quarter_m = json.at("quarter_m");
  out.brick_edges_m = json.at("brick_edges_m").get<std::vector<double>>();
  out.poisson_ratios = json.at("poisson_ratios").get<std::vector<double>>();
  for (const nlohmann::json& one : json.at("cases")) out.cases.push_back(read_case(one));
  return out;
}

inline std::uint32_t in_edges(double length_m, double edge_m) {
  return static_cast<std::uint32_t>(std::lround(length_m / edge_m));
}

inline Node node_at(const Point& point_m, double edge_m) {
  return {in_edges(point_m[0], edge_m), in_edges(point_m[1], edge_m), in_edges(point_m[2], edge_m)};
}

inline TinyMaterial material_of(const Layer& layer, double poisson) {
  const double shear_pa = layer.youngs_modulus_pa / (2 * (1 + poisson));
  return elastic(static_cast<float>(shear_pa), static_cast<float>(poisson));
}

// The middle of the loaded box lies at z = 0, because positions of constraint particles are floats.
inline TinyOrgan organ_of(const Bodies& bodies, const BodyCase& body, double poisson,
                          double edge_m) {
  const Node size = node_at(bodies.quarter_m, edge_m);
  TinyOrgan tiny;
  tiny.nx = static_cast<std::uint16_t>(size.x);
  tiny.ny = static_cast<std::uint16_t>(size.y);
  tiny.nz = static_cast<std::uint16_t>(size.z);
  tiny.voxel_edge_m = static_cast<float>(edge_m);
  tiny.origin_m.z = static_cast<float>(-0.5 * (body.low_m[2] + body.high_m[2]));
  tiny.fixed_faces = kLowZ;
  tiny.materials.clear();
  std::vector<std::uint8_t> material_at;
  for (const Layer& layer : body.layers) {
    material_at.insert(material_at.end(), in_edges(layer.thickness_m, edge_m),
                       static_cast<std::uint8_t>(tiny.materials.size()));
    tiny.materials.push_back(material_of(layer, poisson));
  }
  tiny.material_at = [material_at](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return material_at[z];
  };
  return tiny;
}

inline bool inside(Node node, Node low, Node high) {
  return node.x >= low.x && node.x <= high.x && node.y >= low.y && node.y <= high.y &&
         node.z >= low.z && node.z <= high.z;
}

// Mirrors at x = 0 and y = 0. What is moved along `axis` looks the same in both. So on a mirror
// across that axis nothing moves within the mirror, and on any other mirror nothing moves through
// it.
inline void hold_mirrors(Rig& rig, std::size_t axis) {
  View view = rig.view();
  for_each_node(view, [&](Node node) {
    const std::uint32_t i = node_index(view, node);
    if (view.model.step_per_mass[i] <= 0) return;
    const std::array<bool, 2> on = {node.x == 0, node.y == 0};
    for (std::size_t component = 0; component < 3; ++component) {
      bool held = false;
      for (std::size_t plane = 0; plane < 2; ++plane) {
        held = held || (on[plane] && (component == plane) != (axis == plane));
      }
      if (held) hold(rig, i, component, 0);
    }
  });
}

using NodeForces = std::map<std::uint32_t, double>;

// Even load: every voxel of the box gives an eighth of its load to each corner.
inline NodeForces even_load(const View& view, Node low, Node high, double force_n) {
  NodeForces forces;
  const double part = force_n / ((high.x - low.x) * (high.y - low.y) * (high.z - low.z)) / 8;
  for_each_node(view, [&](Node node) {
    if (!inside(node, low, high) || node.x == high.x || node.y == high.y || node.z == high.z) {
      return;
    }
    for (std::uint32_t c = 0; c < 8; ++c) {
      const Node corner = {node.x + (c & 1U), node.y + ((c >> 1U) & 1U), node.z + (c >> 2U)};
      forces[node_index(view, corner)] += part;
    }
  });
  return forces;
}

// Constraint particles in the voxels along a line half an edge beside the z axis: together with
// their mirror images they are the line.
inline void hold_line(Rig& rig, Node low, Node high) {
  View view = rig.view();
  const float spring = 8 * view.model.slot_k[view.model.voxel_slot[0]];
  for (std::uint32_t z = low.z; z < high.z; ++z) {
    hold_constraint_particle(rig, {low.x, low.y, z}, {0, 0, 0}, {0, 0, 0}, spring);
  }
}

// Moves the needle's points so that each particle pulls with an equal part of the force.
inline void pull_line(Rig& rig, std::size_t axis, double force_n) {
  View view = rig.view();
  const std::uint32_t count = view.state.needle->shaft_count;
  measure_forces(view.model, view.state);
  Vec3 part = {};
  (axis == 0 ? part.x : axis == 1 ? part.y : part.z) = static_cast<float>(force_n / count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Particle& p = view.state.shaft[i];
    p.position_m = p.position_m + (1 / p.stiffness_n_per_m) * (part - p.force_n);
  }
}

using Values = std::map<std::string, double>;

// Rounding of floats lets the nodes dither by 1e-6 of their displacement.
constexpr double kStill = 3e-6;

inline Values move_box(Rig& rig, const BodyCase& body, Node low, Node high) {
  View view = rig.view();
  const std::size_t first = rig.holds.size();
  for_each_node(view, [&](Node node) {
    if (inside(node, low, high)) hold(rig, node_index(view, node), body.axis, body.amount);
  });
  settle(rig, kStill);
  double force = 0;
  for (std::size_t i = first; i < rig.holds.size(); ++i) force -= rig.holds[i].force_n;
  return {{"force_n", force}};
}

inline Values pull_box(Rig& rig, const BodyCase& body, Node low, Node high) {
  View view = rig.view();
  const NodeForces forces = even_load(view, low, high, body.amount);
  for (const auto& [node, force_n] : forces) {
    rig.loads.push_back({node, body.axis, static_cast<float>(force_n)});
  }
  settle(rig, kStill);
  double work = 0;
  for (const auto& [node, force_n] : forces) {
    work += force_n * static_cast<double>(motion(view, body.axis).u[node]);
  }
  return {{"mean_displacement_m", work / body.amount}};
}

inline Values pull_needle(Rig& rig, const BodyCase& body, Node low, Node high) {
  hold_line(rig, low, high);
  settle(rig, kStill, [&] { pull_line(rig, body.axis, body.amount); });
  return {};  // its own displacement grows without bound as the line gets thinner
}

inline Values solve_body(const Bodies& bodies, const BodyCase& body, double poisson,
                         double edge_m) {
  const TinyOrgan tiny = organ_of(bodies, body, poisson, edge_m);
  const bool bends = body.axis != 2 && body.act != Act::kMove;
  const std::uint32_t wave = bends ? 3U * tiny.nz : tiny.nz;  // bending is slower
  Rig rig =
      make_rig(tiny, resting_config(Config{}.hourglass_weight, static_cast<float>(poisson), wave));
  View view = rig.view();
  const Node low = node_at(body.low_m, edge_m), high = node_at(body.high_m, edge_m);
  hold_mirrors(rig, body.axis);
  Values values = body.act == Act::kMove      ? move_box(rig, body, low, high)
                  : body.act == Act::kPullBox ? pull_box(rig, body, low, high)
                                              : pull_needle(rig, body, low, high);
  for (std::size_t i = 0; i < body.probes_m.size(); ++i) {
    const std::uint32_t node = node_index(view, node_at(body.probes_m[i], edge_m));
    values["probe" + std::to_string(i) + "_m"] =
        static_cast<double>(motion(view, body.axis).u[node]);
  }
  return values;
}

}  // namespace stylet::test
