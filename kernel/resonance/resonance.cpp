// SPDX-License-Identifier: Apache-2.0
#include "stylet/resonance.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "layout.h"
#include "voxel.h"

namespace stylet {
namespace {

using Dense = Eigen::MatrixXd;
using Sparse = Eigen::SparseMatrix<double>;
using Element = Eigen::Matrix<double, 24, 24>;
using Shapes = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // three at a time

struct Cell {
  std::int32_t x, y, z;
  auto operator<=>(const Cell&) const = default;
};

// A voxel of the kernel's lattice.
struct Voxel {
  Cell at;
  double k_n_per_m, volume_ratio;
  std::array<std::uint32_t, 8> corner;  // particles, at x + bit 0, y + bit 1, z + bit 2
};

// Where a particle lies in the coarse lattice: weights of eight nodes.
struct Place {
  std::array<std::uint32_t, 8> node;
  std::array<double, 8> weight;
};

std::vector<Voxel> voxels_of(const View& view) {
  const ModelView& model = view.model;
  std::vector<std::uint32_t> root(model.head->counts.particles);
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  for (std::uint32_t i = 0; i < model.head->counts.ties; ++i) {
    root[model.tie[i].node] = model.tie[i].root;
  }
  std::vector<Voxel> all(model.head->counts.voxels);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const std::uint32_t slot = model.voxel_slot[i];
    const Row& row = model.row[model.voxel_row[i]];
    const Vec3 cell = cell_of(view, slot, row);
    all[i].at = {static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y),
                 static_cast<std::int32_t>(cell.z)};
    all[i].k_n_per_m = static_cast<double>(model.slot_k[slot]);
    all[i].volume_ratio = static_cast<double>(model.slot_volume[slot]);
    for (std::uint32_t c = 0; c < 8; ++c) {
      all[i].corner[c] = root[row.node[c >> 1U] + slot - row.slot + (c & 1U)];
    }
  }
  return all;
}

// Stiffness of a voxel with k = 1 N/m in small motion about rest, of three parts: shear, what the
// volume ratio multiplies, and what the weight of hourglass motion does (report.cpp has the same
// energy in large motion).
struct Parts {
  Element shear, volume, hourglass;
};
Parts unit_parts() {
  Eigen::Matrix<double, 9, 24> gradient = Eigen::Matrix<double, 9, 24>::Zero();  // times the edge
  Element linear = Element::Zero();  // the part of the motion that has this gradient, and the mean
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

// Cells of `size` voxels along each edge, those that hang together with what is held.
class Coarse {
 public:
  Coarse(const View& view, const std::vector<Voxel>& voxels, std::int32_t size)
      : size_(size), places_(view.model.head->counts.particles), held_(places_.size()) {
    for (const Voxel& voxel : voxels) {
      const Cell cell = {voxel.at.x / size, voxel.at.y / size, voxel.at.z / size};
      Sum& sum = cells_[cell];
      // Of a voxel k is the shear modulus times its edge.
      sum.k += voxel.k_n_per_m / (size * size);
      sum.volume += voxel.k_n_per_m * voxel.volume_ratio / (size * size);
    }
    for (auto& [cell, sum] : cells_) {
      for (std::int32_t c = 0; c < 8; ++c) {
        const Cell at = {cell.x + (c & 1), cell.y + ((c >> 1) & 1), cell.z + (c >> 2)};
        const auto found = nodes_.emplace(at, static_cast<std::uint32_t>(nodes_.size())).first;
        sum.node[static_cast<std::size_t>(c)] = found->second;
      }
    }
    for (const Voxel& voxel : voxels) place(view, voxel);
    keep_held();
  }

  bool holds(std::uint32_t particle) const {
    return places_[particle].weight[0] >= 0 && kept_[places_[particle].node[0]];
  }
  bool any_held() const { return any_held_; }

  // K, with what is held on stiff springs; nodes that nothing holds stay where they are.
  Sparse stiffness(double hourglass_weight) const {
    const Parts parts = unit_parts();
    std::vector<Eigen::Triplet<double>> all;
    for (const auto& [cell, sum] : cells_) {
      if (!kept_[sum.node[0]]) continue;
      const Element k = sum.k * parts.shear + sum.volume * parts.volume +
                        sum.k * hourglass_weight * parts.hourglass;
      for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 24; ++j) {
          all.emplace_back(dof(sum.node[static_cast<std::size_t>(i / 3)], i % 3),
                           dof(sum.node[static_cast<std::size_t>(j / 3)], j % 3), k(i, j));
        }
      }
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!(held_[i] > 0)) continue;
      const Place& p = places_[i];
      for (std::size_t a = 0; a < 8; ++a) {
        for (std::size_t b = 0; b < 8; ++b) {
          for (int c = 0; c < 3; ++c) {
            all.emplace_back(dof(p.node[a], c), dof(p.node[b], c),
                             held_[i] * p.weight[a] * p.weight[b]);
          }
        }
      }
    }
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      for (int c = 0; c < 3 && !kept_[n]; ++c) all.emplace_back(dof(n, c), dof(n, c), 1);
    }
    const auto size = static_cast<Eigen::Index>(3 * nodes_.size());
    Sparse out(size, size);
    out.setFromTriplets(all.begin(), all.end());
    return out;
  }

  // What particles do when nodes do this, and the forces on nodes of those on particles.
  Shapes to_particles(const Shapes& of_nodes) const {
    Shapes out = Shapes::Zero(static_cast<Eigen::Index>(3 * places_.size()), 3);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      if (!holds(i)) continue;
      for (std::size_t a = 0; a < 8; ++a) {
        out.middleRows<3>(dof(i, 0)) +=
            places_[i].weight[a] * of_nodes.middleRows<3>(dof(places_[i].node[a], 0));
      }
    }
    return out;
  }
  Shapes to_nodes(const Shapes& of_particles) const {
    Shapes out = Shapes::Zero(static_cast<Eigen::Index>(3 * nodes_.size()), 3);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      if (!holds(i)) continue;
      for (std::size_t a = 0; a < 8; ++a) {
        out.middleRows<3>(dof(places_[i].node[a], 0)) +=
            places_[i].weight[a] * of_particles.middleRows<3>(dof(i, 0));
      }
    }
    return out;
  }

  static Eigen::Index dof(std::uint32_t of, int axis) {
    return 3 * static_cast<Eigen::Index>(of) + axis;
  }

 private:
  struct Sum {
    double k = 0, volume = 0;
    std::array<std::uint32_t, 8> node = {};
  };

  // The places of a voxel's corners, and stiff springs where they are held.
  void place(const View& view, const Voxel& voxel) {
    constexpr double kStiff = 100;  // voxels in a row; a held face gives way by a hundredth of one
    const Cell cell = {voxel.at.x / size_, voxel.at.y / size_, voxel.at.z / size_};
    for (std::uint32_t c = 0; c < 8; ++c) {
      const std::uint32_t particle = voxel.corner[c];
      if (!(view.model.step_per_mass[particle] > 0)) held_[particle] += kStiff * voxel.k_n_per_m;
      const std::array<double, 3> within = {
          double(voxel.at.x - cell.x * size_ + std::int32_t(c & 1U)) / size_,
          double(voxel.at.y - cell.y * size_ + std::int32_t((c >> 1U) & 1U)) / size_,
          double(voxel.at.z - cell.z * size_ + std::int32_t(c >> 2U)) / size_};
      places_[particle].node = cells_.at(cell).node;
      for (unsigned n = 0; n < 8; ++n) {
        double weight = 1;
        for (unsigned j = 0; j < 3; ++j) {
          weight *= ((n >> j) & 1U) != 0 ? within[j] : 1 - within[j];
        }
        places_[particle].weight[n] = weight;
      }
    }
  }

  // Nodes that hang together with a held one.
  void keep_held() {
    kept_.assign(nodes_.size(), false);
    std::vector<std::vector<const Sum*>> at(nodes_.size());
    for (const auto& [cell, sum] : cells_) {
      for (const std::uint32_t node : sum.node) at[node].push_back(&sum);
    }
    std::vector<std::uint32_t> to_visit;
    const auto keep = [&](const std::array<std::uint32_t, 8>& nodes) {
      for (const std::uint32_t node : nodes) {
        if (!kept_[node]) to_visit.push_back(node);
        kept_[node] = true;
      }
    };
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (held_[i] > 0) keep(places_[i].node);
    }
    any_held_ = !to_visit.empty();
    while (!to_visit.empty()) {
      const std::uint32_t node = to_visit.back();
      to_visit.pop_back();
      for (const Sum* cell : at[node]) keep(cell->node);
    }
  }

  std::int32_t size_;
  std::map<Cell, Sum> cells_;
  std::map<Cell, std::uint32_t> nodes_;
  std::vector<Place> places_;  // of a particle that is none: weights below 0
  std::vector<double> held_;   // springs, N/m
  std::vector<bool> kept_;
  bool any_held_ = false;
};

// The fewest voxels a cell that leave few enough cells.
std::int32_t cell_size(const std::vector<Voxel>& voxels) {
  for (std::int32_t size = 1;; ++size) {
    std::map<Cell, bool> cells;
    for (const Voxel& v : voxels) cells[{v.at.x / size, v.at.y / size, v.at.z / size}] = true;
    if (cells.size() <= kMostResonanceCells) return size;
  }
}

// Mass times shapes of the particles: what tissue has.
Shapes real_mass(const View& view, const Coarse& coarse, const Shapes& shapes) {
  Shapes out = Shapes::Zero(shapes.rows(), 3);
  for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
    if (!coarse.holds(i)) continue;
    out.middleRows<3>(Coarse::dof(i, 0)) =
        static_cast<double>(view.model.particle_kg[i]) * shapes.middleRows<3>(Coarse::dof(i, 0));
  }
  return out;
}

// 1 / mass in the step of each coordinate; 0 for what is held or left out.
Eigen::VectorXd per_stepped_kg(const View& view, const Coarse& coarse) {
  const std::uint32_t count = view.model.head->counts.particles;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!coarse.holds(i)) continue;
    out.segment<3>(Coarse::dof(i, 0))
        .setConstant(static_cast<double>(view.model.step_per_mass[i] / view.model.head->substep_s));
  }
  return out;
}

// The filter of true mass, p(S) (filter.h).
Shapes filtered(const Filter& filter, const std::vector<Voxel>& voxels,
                const Eigen::VectorXd& per_kg, const Shapes& shapes) {
  Shapes last = shapes, before = shapes;
  for (std::uint32_t j = 0; j < filter.passes; ++j) {
    Shapes pull = Shapes::Zero(shapes.rows(), 3);
    for (const Voxel& voxel : voxels) {
      Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
      for (const std::uint32_t p : voxel.corner) mean += last.middleRows<3>(Coarse::dof(p, 0)) / 8;
      const double by = voxel.k_n_per_m * (1 + 3 * voxel.volume_ratio);
      for (const std::uint32_t p : voxel.corner) {
        pull.middleRows<3>(Coarse::dof(p, 0)) +=
            by * (last.middleRows<3>(Coarse::dof(p, 0)) - mean);
      }
    }
    const FilterPass& pass = filter.pass[j];
    const Shapes next = static_cast<double>(pass.last) * last +
                        static_cast<double>(pass.first) * shapes +
                        static_cast<double>(pass.before) * before -
                        static_cast<double>(pass.bound_s2) * (per_kg.asDiagonal() * pull);
    before = last;
    last = next;
  }
  return last;
}

// Mass in the step times shapes; with true mass M p(S)^-1, which is symmetric: conjugate gradients
// in M, for each shape. (M (1 + c S) alone, with c the slope of p, is too light by up to a fifth
// where stiff tissue turns: S is large at its surface then.)
Shapes stepped_mass(const View& view, const Coarse& coarse, const std::vector<Voxel>& voxels,
                    const Shapes& shapes) {
  constexpr int kMostRounds = 40;
  constexpr double kGood = 1e-6;  // of the square of what is asked for
  const Eigen::VectorXd per_kg = per_stepped_kg(view, coarse);
  const Eigen::VectorXd kg = per_kg.unaryExpr([](double v) { return v > 0 ? 1 / v : 0; });
  if (!has_true_mass(view)) return kg.asDiagonal() * shapes;
  Shapes out = shapes;
  Shapes left = shapes - filtered(view.model.head->filter, voxels, per_kg, out);
  Shapes way = left;
  const auto squares = [&](const Shapes& a, const Shapes& b) {
    return Eigen::Array3d((a.array() * (kg.asDiagonal() * b).array()).colwise().sum());
  };
  const Eigen::Array3d enough = kGood * squares(shapes, shapes);
  Eigen::Array3d size = squares(left, left);
  for (int round = 0; round < kMostRounds && (size > enough).any(); ++round) {
    const Shapes changed = filtered(view.model.head->filter, voxels, per_kg, way);
    const Eigen::Array3d length = (size > enough).select(size / squares(way, changed), 0);
    out += way * length.matrix().asDiagonal();
    left -= changed * length.matrix().asDiagonal();
    const Eigen::Array3d now = squares(left, left);
    way = left + way * (size > 0).select(now / size, 0).matrix().asDiagonal();
    size = now;
  }
  return kg.asDiagonal() * out;
}

// Lowest frequency of K and a mass, by subspace iteration from what gravity along x, y, z does.
template <typename Mass>
double lowest_hz(const Eigen::SimplicialLDLT<Sparse>& solver, const Coarse& coarse, Shapes shapes,
                 Mass mass) {
  constexpr int kRounds = 3;  // what is left of the fourth shape falls by its frequency to the 4th
  double lowest = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Shapes load = coarse.to_nodes(mass(shapes));
    const Shapes moved = solver.solve(load);
    shapes = coarse.to_particles(moved);
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
  constexpr double kTenth = 0.1;
  const View view = view_of(kernel);
  const std::vector<Voxel> voxels = voxels_of(view);
  const Coarse coarse(view, voxels, cell_size(voxels));
  if (!coarse.any_held()) return {0, 0, std::numeric_limits<double>::infinity()};
  const Eigen::SimplicialLDLT<Sparse> solver(
      coarse.stiffness(static_cast<double>(view.model.head->hourglass_weight)));
  Shapes gravity(static_cast<Eigen::Index>(3 * view.model.head->counts.particles), 3);
  for (Eigen::Index i = 0; i < gravity.rows(); i += 3) {
    gravity.middleRows<3>(i) = Eigen::Matrix3d::Identity();
  }
  Resonance out = {};
  out.real_hz = lowest_hz(solver, coarse, gravity,
                          [&](const Shapes& s) { return real_mass(view, coarse, s); });
  out.stepped_hz = lowest_hz(solver, coarse, gravity, [&](const Shapes& s) {
    return stepped_mass(view, coarse, voxels, s);
  });
  // The force of one shape alone is that at rest times 1 - (f / resonance)^2.
  const double apart = 1 / (out.stepped_hz * out.stepped_hz) - 1 / (out.real_hz * out.real_hz);
  out.departs_hz = apart > 0 ? std::sqrt(kTenth / apart) : std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace stylet
