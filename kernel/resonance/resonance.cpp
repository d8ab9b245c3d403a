// SPDX-License-Identifier: Apache-2.0
#include "stylet/resonance.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "lattice/hanging.h"
#include "lattice/voxel.h"
#include "stepped_mass.h"

namespace stylet {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Element = Eigen::Matrix<double, 24, 24>;

std::vector<Voxel> voxels_of(const Model& model) {
  std::vector<std::uint32_t> root(model.head->counts.particles);
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  for (std::uint32_t i = 0; i < model.head->counts.ties; ++i) {
    root[model.tie[i].node] = model.tie[i].representative;
  }
  const std::int32_t coarsest = coarsest_edge(model);
  std::vector<Voxel> all(model.head->counts.voxels);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const std::uint32_t slot = model.voxel_slot[i];
    const Row& row = model.row[model.voxel_row[i]];
    const Vec3 cell = cell_of(model, slot, row);
    const std::int32_t edge = coarsest >> level_of_particle(model, row.node[0]);
    all[i].at = {edge * static_cast<std::int32_t>(cell.x), edge * static_cast<std::int32_t>(cell.y),
                 edge * static_cast<std::int32_t>(cell.z)};
    all[i].edge = edge;
    all[i].k_n_per_m = static_cast<double>(model.slot_k[slot]);
    all[i].volume_ratio = static_cast<double>(model.slot_volume[slot]);
    for (std::uint32_t c = 0; c < 8; ++c) {
      all[i].corner[c] = root[row.node[c >> 1U] + slot - row.slot + (c & 1U)];
    }
  }
  return all;
}

// Stiffness of a voxel with k = 1 N/m in small motion about rest, in three parts: shear, the part
// that the volume ratio multiplies, and the part that the hourglass weight multiplies (report.cpp
// has the same energy in large motion).
struct Parts {
  Element shear, volume, hourglass;
};
Parts unit_parts() {
  Eigen::Matrix<double, 9, 24> gradient = Eigen::Matrix<double, 9, 24>::Zero();  // times the edge
  Element linear = Element::Zero();  // affine part of the motion: this gradient, and the mean
  for (int corner = 0; corner < 8; ++corner) {
    for (int other = 0; other < 8; ++other) {
      double same = 1.0 / 8;
      for (int j = 0; j < 3; ++j) same += (((corner ^ other) >> j) & 1) != 0 ? -0.125 : 0.125;
      for (int c = 0; c < 3; ++c) linear(3 * corner + c, 3 * other + c) = same;
    }
    for (int c = 0; c < 3; ++c) {
      for (int j = 0; j < 3; ++j) {
        gradient(3 * c + j, 3 * corner + c) = ((corner >> j) & 1) != 0 ? 0.25 : -0.25;
      }
    }
  }
  Eigen::Matrix<double, 9, 24> strain;
  Eigen::Matrix<double, 1, 24> trace = Eigen::Matrix<double, 1, 24>::Zero();
  for (int c = 0; c < 3; ++c) {
    trace += gradient.row(4 * c);
    for (int j = 0; j < 3; ++j) {
      strain.row(3 * c + j) = 0.5 * (gradient.row(3 * c + j) + gradient.row(3 * j + c));
    }
  }
  return {2 * strain.transpose() * strain, 2 * trace.transpose() * trace,
          Element::Identity() - linear};
}

// Cells of `size` of the finest voxels along each edge, with nodes at their corners.
struct Coarse {
  struct Sum {
    double k = 0, volume = 0;
    std::array<std::uint32_t, 8> node = {};
  };
  std::int32_t size;
  std::map<CoarseCell, Sum> cells;
  std::uint32_t nodes = 0;
};

CoarseCell cell_of(const Coarse& coarse, const Voxel& voxel) {
  return {voxel.at.x / coarse.size, voxel.at.y / coarse.size, voxel.at.z / coarse.size};
}

Coarse coarse_of(const std::vector<Voxel>& voxels, std::int32_t size) {
  Coarse out = {size, {}, 0};
  for (const Voxel& voxel : voxels) {
    Coarse::Sum& sum = out.cells[cell_of(out, voxel)];
    // k of a voxel is its shear modulus times its edge.
    const double part = static_cast<double>(voxel.edge * voxel.edge) / (size * size);
    sum.k += part * voxel.k_n_per_m;
    sum.volume += part * voxel.k_n_per_m * voxel.volume_ratio;
  }
  std::map<CoarseCell, std::uint32_t> nodes;
  for (auto& [cell, sum] : out.cells) {
    for (std::int32_t c = 0; c < 8; ++c) {
      const CoarseCell at = {cell.x + (c & 1), cell.y + ((c >> 1) & 1), cell.z + (c >> 2)};
      sum.node[static_cast<std::size_t>(c)] = nodes.emplace(at, out.nodes).first->second;
      out.nodes = static_cast<std::uint32_t>(nodes.size());
    }
  }
  return out;
}

Eigen::Index dof(std::uint32_t of, int axis) {
  return 3 * static_cast<Eigen::Index>(of) + axis;
}

// Stiffness of the spring that attaches a particle, N/m for each coordinate; 0 for a free one.
Eigen::VectorXd springs_of(const Model& model, const std::vector<Voxel>& voxels) {
  constexpr double kStiff = 100;  // in k of a voxel: a face gives way by a hundredth of a voxel
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dof(model.head->counts.particles, 0));
  for (const Voxel& voxel : voxels) {
    for (const std::uint32_t p : voxel.corner) {
      if (model.step_per_mass[p] > 0) continue;
      out.segment<3>(dof(p, 0)).array() += kStiff * voxel.k_n_per_m;
    }
  }
  return out;
}

// Nodes that are connected, through cells, with an attached particle.
std::vector<bool> held_nodes(const Coarse& coarse, const std::vector<Voxel>& voxels,
                             const Eigen::VectorXd& springs) {
  std::vector<bool> held(coarse.nodes);
  std::vector<std::vector<const Coarse::Sum*>> at(coarse.nodes);
  for (const auto& [cell, sum] : coarse.cells) {
    for (const std::uint32_t node : sum.node) at[node].push_back(&sum);
  }
  std::vector<std::uint32_t> to_visit;
  const auto hold = [&](const Coarse::Sum& cell) {
    for (const std::uint32_t node : cell.node) {
      if (!held[node]) to_visit.push_back(node);
      held[node] = true;
    }
  };
  for (const Voxel& voxel : voxels) {
    const bool any = std::any_of(voxel.corner.begin(), voxel.corner.end(),
                                 [&](std::uint32_t p) { return springs[dof(p, 0)] > 0; });
    if (any) hold(coarse.cells.at(cell_of(coarse, voxel)));
  }
  while (!to_visit.empty()) {
    const std::uint32_t node = to_visit.back();
    to_visit.pop_back();
    for (const Coarse::Sum* cell : at[node]) hold(*cell);
  }
  return held;
}

// Whether anything that is held can move. A node that hangs does not by itself.
bool anything_moves(const Model& model, const Coarse& coarse, const std::vector<Voxel>& voxels,
                    const std::vector<bool>& held, const Eigen::VectorXd& springs) {
  return std::any_of(voxels.begin(), voxels.end(), [&](const Voxel& voxel) {
    return held[coarse.cells.at(cell_of(coarse, voxel)).node[0]] &&
           std::any_of(voxel.corner.begin(), voxel.corner.end(), [&](std::uint32_t p) {
             return springs[dof(p, 0)] == 0 && !hangs(model, p);
           });
  });
}

// Motion of the particles from that of connected nodes: their weights, trilinear in a cell.
Sparse weights_of(const Model& model, const Coarse& coarse, const std::vector<Voxel>& voxels,
                  const std::vector<bool>& held) {
  const std::uint32_t particles = model.head->counts.particles;
  std::vector<bool> placed(particles);
  std::vector<Eigen::Triplet<double>> all;
  for (const Voxel& voxel : voxels) {
    const CoarseCell cell = cell_of(coarse, voxel);
    const Coarse::Sum& of = coarse.cells.at(cell);
    for (std::uint32_t c = 0; c < 8 && held[of.node[0]]; ++c) {
      const std::uint32_t particle = voxel.corner[c];
      if (placed[particle]) continue;
      placed[particle] = true;
      const auto within = [&](std::int32_t at, std::int32_t first, std::uint32_t bit) {
        const std::int32_t further = ((c >> bit) & 1U) != 0 ? voxel.edge : 0;
        return static_cast<double>(at - first * coarse.size + further) / coarse.size;
      };
      const std::array<double, 3> place = {within(voxel.at.x, cell.x, 0),
                                           within(voxel.at.y, cell.y, 1),
                                           within(voxel.at.z, cell.z, 2)};
      for (unsigned n = 0; n < 8; ++n) {
        double weight = 1;
        for (unsigned j = 0; j < 3; ++j) weight *= ((n >> j) & 1U) != 0 ? place[j] : 1 - place[j];
        for (int axis = 0; axis < 3; ++axis) {
          all.emplace_back(dof(particle, axis), dof(of.node[n], axis), weight);
        }
      }
    }
  }
  Sparse out(dof(particles, 0), dof(coarse.nodes, 0));
  out.setFromTriplets(all.begin(), all.end());
  return out;
}

// K; attached particles are on stiff springs, nodes connected to none stay where they are.
Sparse stiffness_of(const Coarse& coarse, const std::vector<bool>& held, const Sparse& weights,
                    const Eigen::VectorXd& springs, double hourglass_weight) {
  const Parts parts = unit_parts();
  std::vector<Eigen::Triplet<double>> all;
  for (const auto& [cell, sum] : coarse.cells) {
    if (!held[sum.node[0]]) continue;
    const Element k = sum.k * parts.shear + sum.volume * parts.volume +
                      sum.k * hourglass_weight * parts.hourglass;
    for (int i = 0; i < 24; ++i) {
      for (int j = 0; j < 24; ++j) {
        all.emplace_back(dof(sum.node[static_cast<std::size_t>(i / 3)], i % 3),
                         dof(sum.node[static_cast<std::size_t>(j / 3)], j % 3), k(i, j));
      }
    }
  }
  for (std::uint32_t n = 0; n < coarse.nodes; ++n) {
    for (int axis = 0; axis < 3 && !held[n]; ++axis) {
      all.emplace_back(dof(n, axis), dof(n, axis), 1);
    }
  }
  Sparse out(weights.cols(), weights.cols());
  out.setFromTriplets(all.begin(), all.end());
  const Sparse on_springs = springs.asDiagonal() * weights;
  return out + Sparse(weights.transpose() * on_springs);
}

// The smallest cells that are few enough, of whole voxels of the coarsest level: so each voxel lies
// in one cell, and a node that hangs is where the cell's shape is.
std::int32_t cell_size(const std::vector<Voxel>& voxels, std::int32_t coarsest) {
  for (std::int32_t size = coarsest;; size += coarsest) {
    std::map<CoarseCell, bool> cells;
    for (const Voxel& v : voxels) cells[{v.at.x / size, v.at.y / size, v.at.z / size}] = true;
    if (cells.size() <= kMostResonanceCells) return size;
  }
}

// For each coordinate of the particles: the mass that tissue has.
Eigen::VectorXd real_kg(const Model& model) {
  Eigen::VectorXd out(dof(model.head->counts.particles, 0));
  for (std::uint32_t i = 0; i < model.head->counts.particles; ++i) {
    out.segment<3>(dof(i, 0)).setConstant(static_cast<double>(model.particle_kg[i]));
  }
  return out;
}

// Lowest frequency for K and a mass; subspace iteration starts from gravity along x, y, z.
template <typename Mass>
double lowest_hz(const Eigen::SimplicialLDLT<Sparse>& solver, const Sparse& weights, Mass mass) {
  constexpr int kRounds = 3;  // the rest of the fourth shape falls by its frequency to the 4th
  Shapes shapes = Eigen::Matrix3d::Identity().replicate(weights.rows() / 3, 1);
  double lowest = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Shapes load = weights.transpose() * mass(shapes);
    const Shapes moved = solver.solve(load);
    shapes = weights * moved;
    const Eigen::Matrix3d k = moved.transpose() * load;
    const Eigen::Matrix3d m = shapes.transpose() * mass(shapes);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> ritz(0.5 * (k + k.transpose()),
                                                                         0.5 * (m + m.transpose()));
    lowest = ritz.eigenvalues()[0];
    shapes = shapes * ritz.eigenvectors();
  }
  return std::sqrt(lowest) / (2 * std::numbers::pi);
}

}  // namespace

Resonance first_resonance(const Kernel& kernel) {
  constexpr double kTenth = 0.1, kNever = std::numeric_limits<double>::infinity();
  const View view = view_of(kernel);
  const std::vector<Voxel> voxels = voxels_of(view.model);
  const Eigen::VectorXd springs = springs_of(view.model, voxels);
  if (!(springs.array() > 0).any()) return {0, 0, kNever};
  const Coarse coarse = coarse_of(voxels, cell_size(voxels, coarsest_edge(view.model)));
  const std::vector<bool> held = held_nodes(coarse, voxels, springs);
  if (!anything_moves(view.model, coarse, voxels, held, springs)) return {0, 0, kNever};
  const Sparse weights = weights_of(view.model, coarse, voxels, held);
  const Eigen::SimplicialLDLT<Sparse> solver(stiffness_of(
      coarse, held, weights, springs, static_cast<double>(view.model.head->hourglass_weight)));
  const Eigen::VectorXd kg = real_kg(view.model);
  Resonance out = {};
  out.real_hz =
      lowest_hz(solver, weights, [&](const Shapes& s) { return Shapes(kg.asDiagonal() * s); });
  out.stepped_hz = lowest_hz(solver, weights,
                             [&](const Shapes& s) { return stepped_mass(view.model, voxels, s); });
  // The force of one shape alone is its force at rest times 1 - (f / resonance)^2.
  const double apart = 1 / (out.stepped_hz * out.stepped_hz) - 1 / (out.real_hz * out.real_hz);
  out.departs_hz = apart > 0 ? std::sqrt(kTenth / apart) : kNever;
  return out;
}

}  // namespace stylet
