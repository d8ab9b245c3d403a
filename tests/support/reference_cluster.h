// SPDX-License-Identifier: Apache-2.0
// Slow reference of one voxel in double precision: the match with all its particles, ghosts
// included.
//
// It is written from the minimisation itself, not from the kernel's closed forms: rotations by
// singular value decomposition, sums over every particle, ghost particles as particles with
// positions of their own. Units: SI. Frame: world; corner i of a voxel is at (i & 1, i >> 1 & 1, i
// >> 2).
// Source: Mueller et al. 2005 (fit); the energies are those at the head of
// kernel/src/lattice/lattice.h.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

namespace stylet::test {

using Vec = Eigen::Vector3d;
using Mat = Eigen::Matrix3d;

// The proper rotation that maximises tr(R^T a).
inline Mat reference_rotation(const Mat& a) {
  const Eigen::JacobiSVD<Mat> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double side = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Vec sign(1, 1, side < 0 ? -1 : 1);
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

struct FitPoint {
  Vec rest, place;
  double weight;
};

// The rigid map that fits all points best.
struct Fit {
  Mat rotation;
  Vec rest_centre, centre;

  Vec goal(const Vec& rest) const { return rotation * (rest - rest_centre) + centre; }
};

inline Fit fit_points(const std::vector<FitPoint>& points) {
  Fit fit = {Mat::Identity(), Vec::Zero(), Vec::Zero()};
  double weight = 0;
  for (const FitPoint& p : points) {
    fit.rest_centre += p.weight * p.rest;
    fit.centre += p.weight * p.place;
    weight += p.weight;
  }
  fit.rest_centre /= weight;
  fit.centre /= weight;
  Mat moment = Mat::Zero();
  for (const FitPoint& p : points) {
    moment += p.weight * (p.place - fit.centre) * (p.rest - fit.rest_centre).transpose();
  }
  fit.rotation = reference_rotation(moment);
  return fit;
}

// Sum of w |x - g|^2 at the best fit.
inline double fit_energy(const std::vector<FitPoint>& points) {
  const Fit fit = fit_points(points);
  double sum = 0;
  for (const FitPoint& p : points) sum += p.weight * (p.place - fit.goal(p.rest)).squaredNorm();
  return sum;
}

struct ReferenceVoxel {
  double edge_m = 0, spring_n_per_m = 0;
  double hourglass_weight = 1;
  double volume_ratio = 0;  // lambda / (2 G)
  double stiffening = 0;    // PHYSICS 2.7
  std::array<Vec, 8> corner;
  std::vector<FitPoint> held;  // constraint particles: rest from the voxel's centre, weight in N/m
};

inline Vec corner_offset(std::size_t i, double edge_m) {
  const auto side = [&](std::size_t bit) { return ((i >> bit) & 1U) != 0 ? 0.5 : -0.5; };
  return edge_m * Vec(side(0), side(1), side(2));
}

// Undeformed, its centre at 0.
inline ReferenceVoxel resting_voxel(double edge_m, double spring_n_per_m) {
  ReferenceVoxel voxel;
  voxel.edge_m = edge_m;
  voxel.spring_n_per_m = spring_n_per_m;
  for (std::size_t i = 0; i < 8; ++i) voxel.corner[i] = corner_offset(i, edge_m);
  return voxel;
}

inline std::vector<FitPoint> points_of(const ReferenceVoxel& voxel) {
  std::vector<FitPoint> points;
  for (std::size_t i = 0; i < 8; ++i) {
    points.push_back({corner_offset(i, voxel.edge_m), voxel.corner[i], voxel.spring_n_per_m});
  }
  points.insert(points.end(), voxel.held.begin(), voxel.held.end());
  return points;
}

// Affine fit of the corners alone.
struct AffineFit {
  Mat gradient;
  Vec centre;
};

inline AffineFit affine_fit(const ReferenceVoxel& voxel) {
  AffineFit fit = {Mat::Zero(), Vec::Zero()};
  for (const Vec& x : voxel.corner) fit.centre += x / 8;
  for (std::size_t i = 0; i < 8; ++i) {
    fit.gradient += voxel.corner[i] * corner_offset(i, voxel.edge_m).transpose();
  }
  fit.gradient /= 2 * voxel.edge_m * voxel.edge_m;
  return fit;
}

// How much of the strain changes the shape: by the principal stretches.
inline double shape_of(const Mat& gradient) {
  const Eigen::JacobiSVD<Mat> svd(gradient);
  Vec strain = svd.singularValues() - Vec::Ones();
  if (gradient.determinant() < 0) strain[2] = -svd.singularValues()[2] - 1;
  return (strain - Vec::Constant(strain.mean())).squaredNorm();
}

// What strain stiffening adds to the energy, over G: b J^2 / (2 + b J / 10).
inline double stiffening_of(double stiffening, double shape) {
  return stiffening * shape * shape / (2 + stiffening * shape / 10);
}

inline double voxel_energy(const ReferenceVoxel& voxel) {
  const AffineFit affine = affine_fit(voxel);
  double hourglass = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec q = corner_offset(i, voxel.edge_m);
    hourglass += (voxel.corner[i] - affine.centre - affine.gradient * q).squaredNorm();
  }
  const Mat r = reference_rotation(affine.gradient);
  const double volume = (r.transpose() * affine.gradient).trace() - 3;
  const double k = voxel.spring_n_per_m;
  return 0.5 * fit_energy(points_of(voxel)) + 0.5 * k * (voxel.hourglass_weight - 1) * hourglass +
         k * voxel.edge_m * voxel.edge_m *
             (voxel.volume_ratio * volume * volume +
              stiffening_of(voxel.stiffening, shape_of(affine.gradient)));
}

struct VoxelForces {
  std::array<Vec, 8> corner;  // on the corners
  std::vector<Vec> held;      // on the tissue, from the needle at each constraint particle
};

inline VoxelForces voxel_forces(const ReferenceVoxel& voxel) {
  const std::vector<FitPoint> points = points_of(voxel);
  const Fit fit = fit_points(points);
  const AffineFit affine = affine_fit(voxel);
  const Mat r = reference_rotation(affine.gradient);
  const double k = voxel.spring_n_per_m;
  const double pressure = voxel.volume_ratio * ((r.transpose() * affine.gradient).trace() - 3);
  VoxelForces out;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec q = points[i].rest;
    const Vec rest = points[i].place - affine.centre - affine.gradient * q;
    out.corner[i] = -k * ((points[i].place - fit.goal(q)) + (voxel.hourglass_weight - 1) * rest +
                          pressure * (r * q));
  }
  for (std::size_t i = 8; i < points.size(); ++i) {
    out.held.push_back(points[i].weight * (points[i].place - fit.goal(points[i].rest)));
  }
  return out;
}

// The match with ghosts as real particles. Each constraint particle brings one ghost at its mirror
// image (which keeps the centroid) and four across (which keep the moment isotropic). Each ghost
// begins at its rest position and is moved to its goal after every match, until nothing moves any
// more.
inline Fit fit_with_ghosts(const ReferenceVoxel& voxel, const Vec& rest_centre_m) {
  std::vector<FitPoint> points = points_of(voxel);
  const std::size_t real = points.size();
  for (const FitPoint& p : voxel.held) {
    const double length = p.rest.norm();
    const Vec along = length > 0 ? Vec(p.rest / length) : Vec(1, 0, 0);
    const Vec across = along.unitOrthogonal();
    const Vec third = along.cross(across);
    for (const Vec& rest : {Vec(-p.rest), Vec(length * across), Vec(-length * across),
                            Vec(length * third), Vec(-length * third)}) {
      points.push_back({rest, rest_centre_m + rest, p.weight});
    }
  }
  Fit fit = fit_points(points);
  for (int pass = 0; pass < 100000; ++pass) {
    double moved = 0;
    for (std::size_t i = real; i < points.size(); ++i) {
      const Vec goal = fit.goal(points[i].rest);
      moved = std::max(moved, (goal - points[i].place).norm());
      points[i].place = goal;
    }
    if (!(moved > 1e-15 * voxel.edge_m)) break;
    fit = fit_points(points);
  }
  return fit;
}

}  // namespace stylet::test
