// SPDX-License-Identifier: Apache-2.0
#include "stepped_mass.h"

#include <algorithm>

#include "lattice/hanging.h"

namespace stylet {
namespace {

// The motion of each particle, node of the cascade or place of level 0, a column for each shape.
using Motions = std::vector<Eigen::Matrix3d>;

// For each coordinate of the particles 1 / mass in the step, which is 0 for attached particles; and
// that mass, which is 0 for them and for nodes that hang.
Eigen::VectorXd per_stepped_kg(const Model& model) {
  const float dt = model.head->substep_s;
  Eigen::VectorXd out(dof(model.head->counts.particles, 0));
  for (std::uint32_t i = 0; i < model.head->counts.particles; ++i) {
    out.segment<3>(dof(i, 0)).setConstant(static_cast<double>(model.step_per_mass[i] / dt));
  }
  return out;
}
Eigen::VectorXd stepped_kg(const Model& model, const Eigen::VectorXd& per_kg) {
  Eigen::VectorXd out = per_kg.unaryExpr([](double v) { return v > 0 ? 1 / v : 0; });
  for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
    out.segment<3>(dof(model.hanging[i].node, 0)).setZero();
  }
  return out;
}

// At each corner, N/m (filter.h).
double bound_of(const Voxel& voxel) {
  return voxel.k_n_per_m * (1 + 3 * voxel.volume_ratio);
}

void take(const HangingShare* share, const HangingShare* end, Motions& all) {
  while (share != end) {
    const HangingShare* const behind = share + share->count;
    for (const std::uint32_t to = share->to; share != behind; ++share) {
      all[to] += static_cast<double>(share->share) * all[share->from];
    }
  }
}

// What moves a node of the cascade by itself, 1/kg.
double own_mobility(const Model& model, std::uint32_t node, float limit_per_s2) {
  return static_cast<double>(std::min(model.cascade_mobility[node],
                                      limit_per_s2 / std::max(model.cascade_bound[node], 1e-20F)));
}

// What the passes of true mass filter: all particles of a lattice of one level; of a graded one
// those of level 0, and then its shadows.
struct CoarseLevel {
  struct Cell {
    std::array<std::uint32_t, 8> place;
    double bound_n_per_m;
  };
  std::vector<double> per_kg, bound_n_per_m;  // of places
  std::vector<Cell> cells;                    // and shadow cells
};

// Where a node of the cascade is in it, one of the border or a shadow of level 0.
std::uint32_t place_of(const Model& model, std::uint32_t node) {
  const Shadows& g = model.head->shadows;
  return node < g.border_end ? model.border[node - g.border_begin]
                             : g.first_particle + node - g.border_end;
}

std::uint32_t coarse_particles(const Model& model) {
  return is_graded(model) ? model.head->shadows.first_particle : model.head->counts.particles;
}

CoarseLevel coarse_level(const Model& model, const std::vector<Voxel>& voxels,
                         const Eigen::VectorXd& per_kg) {
  const Shadows& g = model.head->shadows;  // empty if there is one level
  const std::uint32_t particles = coarse_particles(model);
  const std::uint32_t count = particles + g.shadow_begin[1] - g.border_end;
  CoarseLevel out = {std::vector<double>(count), std::vector<double>(count), {}};
  for (std::uint32_t p = 0; p < particles; ++p) out.per_kg[p] = per_kg[dof(p, 0)];
  for (const Voxel& voxel : voxels) {
    if (voxel.edge != coarsest_edge(model)) continue;
    out.cells.push_back({voxel.corner, bound_of(voxel)});
    for (const std::uint32_t p : voxel.corner) out.bound_n_per_m[p] += bound_of(voxel);
  }
  for (std::uint32_t node = g.border_begin; node < g.shadow_begin[1]; ++node) {
    out.per_kg[place_of(model, node)] = own_mobility(model, node, g.fastest_per_s2);
    out.bound_n_per_m[place_of(model, node)] = static_cast<double>(model.cascade_bound[node]);
  }
  for (std::uint32_t i = 0; i < g.coarse_cells; ++i) {
    const ShadowCell& cell = model.shadow_cell[i];
    CoarseLevel::Cell own = {{}, 8 * static_cast<double>(cell.bound_n_per_m)};
    for (std::size_t c = 0; c < 8; ++c) own.place[c] = place_of(model, cell.node[c]);
    out.cells.push_back(own);
  }
  return out;
}

// The filter of true mass, p(S) (filter.h).
Motions filtered(const Filter& filter, const CoarseLevel& level, const Motions& start) {
  const std::size_t count = level.per_kg.size();
  Motions last = start, before = start;
  for (std::uint32_t j = 0; j < filter.passes; ++j) {
    Motions got(count, Eigen::Matrix3d::Zero());
    for (const CoarseLevel::Cell& cell : level.cells) {
      Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
      for (const std::uint32_t p : cell.place) mean += last[p] / 8;
      for (const std::uint32_t p : cell.place) got[p] += cell.bound_n_per_m * mean;
    }
    const FilterPass& pass = filter.pass[j];
    Motions next(count);
    for (std::size_t p = 0; p < count; ++p) {
      const double pulled = static_cast<double>(pass.bound_s2) * level.per_kg[p];
      next[p] = static_cast<double>(pass.last) * last[p] +
                static_cast<double>(pass.first) * start[p] +
                static_cast<double>(pass.before) * before[p] -
                pulled * (level.bound_n_per_m[p] * last[p] - got[p]);
    }
    before = last;
    last = next;
  }
  return last;
}

// The velocities that the step gives to momenta kg times shapes: through the cascade, which is
// empty if there is one level.
Shapes stepped(const Model& model, const CoarseLevel& coarse, const Eigen::VectorXd& kg,
               const Shapes& shapes) {
  const Shadows& g = model.head->shadows;
  const auto of = [&](std::uint32_t p) { return shapes.middleRows<3>(dof(p, 0)); };
  Motions all(model.head->counts.cascade, Eigen::Matrix3d::Zero());
  for (std::uint32_t i = 0; i < g.border_end; ++i) {
    const std::uint32_t p =
        i < g.border_begin ? g.first_particle + i : model.border[i - g.border_begin];
    all[i] = kg[dof(p, 0)] * of(p);
  }
  for (std::uint32_t level = model.head->counts.levels - 1; level > 0; --level) {
    take(model.down_share + g.down_begin[level], model.down_share + g.down_begin[level - 1], all);
    for (const std::uint32_t* const begin : {g.fine_begin + level, g.shadow_begin + level}) {
      for (std::uint32_t i = begin[0]; i < begin[1]; ++i) {
        all[i] *= own_mobility(model, i, g.limit_per_s2[level]);
      }
    }
  }
  Motions start(coarse.per_kg.size());
  const std::uint32_t particles = coarse_particles(model);
  for (std::uint32_t p = 0; p < particles; ++p) start[p] = of(p);
  for (std::uint32_t node = g.border_begin; node < g.shadow_begin[1]; ++node) {
    start[place_of(model, node)] = coarse.per_kg[place_of(model, node)] * all[node];
  }
  const Motions last = filtered(model.head->filter, coarse, start);
  for (std::uint32_t node = g.border_begin; node < g.shadow_begin[1]; ++node) {
    all[node] = last[place_of(model, node)];
  }
  for (std::uint32_t level = 1; level < model.head->counts.levels; ++level) {
    take(model.up_share + g.up_begin[level], model.up_share + g.up_begin[level + 1], all);
  }
  Shapes out(shapes.rows(), 3);
  for (std::uint32_t p = 0; p < model.head->counts.particles; ++p) {
    out.middleRows<3>(dof(p, 0)) = p < particles ? last[p] : all[p - particles];
  }
  return out;
}

// M times those shapes of which an operator A makes these: conjugate gradients in M, in which A is
// symmetric, for each shape.
template <typename Operator>
Shapes mass_of(const Eigen::VectorXd& kg, const Shapes& shapes, Operator moved) {
  constexpr int kMostRounds = 40;
  constexpr double kGood = 1e-6;  // of the square of the right-hand side
  Shapes out = shapes;
  Shapes left = shapes - moved(out);
  Shapes way = left;
  const auto squares = [&](const Shapes& a, const Shapes& b) {
    return Eigen::Array3d((a.array() * (kg.asDiagonal() * b).array()).colwise().sum());
  };
  const Eigen::Array3d enough = kGood * squares(shapes, shapes);
  Eigen::Array3d size = squares(left, left);
  for (int round = 0; round < kMostRounds && (size > enough).any(); ++round) {
    const Shapes changed = moved(way);
    const Eigen::Array3d length = (size > enough).select(size / squares(way, changed), 0);
    out += way * length.matrix().asDiagonal();
    left -= changed * length.matrix().asDiagonal();
    const Eigen::Array3d now = squares(left, left);
    way = left + way * (size > 0).select(now / size, 0).matrix().asDiagonal();
    size = now;
  }
  return kg.asDiagonal() * out;
}

}  // namespace

// With true mass it is M p(S)^-1, which is symmetric. (M (1 + c S) alone, with c the slope of p, is
// too light by up to a fifth where stiff tissue turns: there S is large at its surface.)
Shapes stepped_mass(const Model& model, const std::vector<Voxel>& voxels, const Shapes& shapes) {
  const Eigen::VectorXd per_kg = per_stepped_kg(model);
  const Eigen::VectorXd kg = stepped_kg(model, per_kg);
  const bool unfiltered = is_graded(model) && model.head->shadows.on == 0;
  if (!has_true_mass(model) || unfiltered) return kg.asDiagonal() * shapes;
  const CoarseLevel coarse = coarse_level(model, voxels, per_kg);
  return mass_of(kg, shapes, [&](const Shapes& s) { return stepped(model, coarse, kg, s); });
}

}  // namespace stylet
