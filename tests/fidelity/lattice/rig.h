// SPDX-License-Identifier: Apache-2.0
// A block of tissue on a test bench: nodes are held or loaded by hand, forces are read, motion is
// damped out.
//
// The kernel's own step does all the work. A held component is put back after every step, so that
// the velocity which the step gave it, divided by the step per mass, is the force on it: reactions
// are read in this way. Units: SI. Frame: rest frame; nodes and voxels are counted in voxel edges
// from the block's low corner.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/math.h"
#include "coupling/contact.h"
#include "coupling/match.h"
#include "lattice/lattice.h"
#include "lattice/voxel.h"
#include "reference_cluster.h"
#include "session.h"
#include "state/layout.h"

namespace stylet::test {

struct Node {
  std::uint32_t x, y, z;
};

struct Hold {
  std::uint32_t node;
  std::size_t axis;
  float displacement_m;
  double force_n;  // of the tissue on the node, in the last step
};

struct Load {
  std::uint32_t node;
  std::size_t axis;
  float force_n;
};

struct Rig {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
  std::vector<Hold> holds;
  std::vector<Load> loads;

  View view() const { return view_of(session.kernel); }
};

inline Vec3 to_float(const Vec& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Vec to_vec(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Rig make_rig(const TinyOrgan& tiny, const Config& config) {
  Rig rig{open_organ(tiny_organ(tiny)), {}, {}, {}};
  rig.session = make_session(rig.organ->organ, config);
  View view = rig.view();
  gather_coupled(view.model, view.state, view.scratch);
  return rig;
}

// The sweep alone, from forces straight to velocities: the tests here read these and hold them.
// With true mass the filter comes between the two; it has tests of its own (filter_test.cpp).
inline Config sweep_config() {
  Config config;
  config.inertia = Inertia::kAddedMass;
  config.substeps = 1;
  return config;
}

// A configuration that comes to rest in few steps: the time step is so long that every mass is the
// smallest stable one, and the drag is critical for a wave twice as long as `cells`.
inline Config resting_config(float hourglass_weight, float poisson, std::uint32_t cells) {
  Config config = sweep_config();
  config.period_s = kMaxPeriodS;
  config.tissue_damping_s = 0;
  config.hourglass_weight = hourglass_weight;
  // The bound on stiffness, constraint particles included, is 0.8 of the limit (filter.h).
  const float slowness = std::sqrt((2 + 3 * poisson / (1 - 2 * poisson)) / 1.6F);
  const float turn = 3.14F / (2 * static_cast<float>(cells) * slowness);  // angle per step
  config.surround_drag_per_s = std::min(2 * turn, 0.9F) / config.period_s;
  return config;
}

inline TinyOrgan block_of(std::uint16_t nx, std::uint16_t ny, std::uint16_t nz,
                          const TinyMaterial& material, float edge_m = 0.005F) {
  TinyOrgan tiny;
  tiny.nx = nx;
  tiny.ny = ny;
  tiny.nz = nz;
  tiny.voxel_edge_m = edge_m;
  tiny.materials = {material};
  return tiny;
}

// Material of shear modulus 1 Pa per unit of `shear_pa`.
inline TinyMaterial elastic(float shear_pa, float poisson) {
  TinyMaterial material;
  material.density_kg_per_m3 = 1;
  material.youngs_modulus_pa = 2 * shear_pa * (1 + poisson);
  material.poisson_ratio = poisson;
  return material;
}

inline std::uint32_t voxel_row_of(const View& view, Node voxel) {
  return row_at(view.model, static_cast<std::int32_t>(voxel.x), voxel.y, voxel.z);
}

inline std::uint32_t node_index(const View& view, Node node) {
  const ModelHead& head = *view.model.head;
  const std::uint32_t dx = node.x == head.size_x ? 1 : 0, dy = node.y == head.size_y ? 1 : 0,
                      dz = node.z == head.size_z ? 1 : 0;
  const Row& row = view.model.row[voxel_row_of(view, {node.x - dx, node.y - dy, node.z - dz})];
  return row.node[dy + 2 * dz] + node.x - row.x0;
}

template <typename Visit>
void for_each_node(const View& view, Visit visit) {
  const ModelHead& head = *view.model.head;
  for (std::uint32_t z = 0; z <= head.size_z; ++z) {
    for (std::uint32_t y = 0; y <= head.size_y; ++y) {
      for (std::uint32_t x = 0; x <= head.size_x; ++x) visit(Node{x, y, z});
    }
  }
}

inline Vec in_edges(Node node) {
  return {static_cast<double>(node.x), static_cast<double>(node.y), static_cast<double>(node.z)};
}

struct Motion {  // the arrays for one axis
  float *u, *v, *e;
};

inline Motion motion(View view, std::size_t axis) {
  State& s = view.state;
  const Motion all[3] = {{s.ux, s.vx, s.ex}, {s.uy, s.vy, s.ey}, {s.uz, s.vz, s.ez}};
  return all[axis];
}

inline Vec displacement_of(const View& view, std::uint32_t node) {
  return {static_cast<double>(view.state.ux[node]), static_cast<double>(view.state.uy[node]),
          static_cast<double>(view.state.uz[node])};
}

inline void place(View view, std::uint32_t node, std::size_t axis, float displacement_m) {
  const Motion m = motion(view, axis);
  m.u[node] = m.e[node] = displacement_m;
  m.v[node] = 0;
}

inline void place(const View& view, std::uint32_t node, const Vec& displacement_m) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place(view, node, axis, static_cast<float>(displacement_m[static_cast<Eigen::Index>(axis)]));
  }
}

inline void hold(Rig& rig, std::uint32_t node, std::size_t axis, double displacement_m) {
  rig.holds.push_back({node, axis, static_cast<float>(displacement_m), 0});
  place(rig.view(), node, axis, static_cast<float>(displacement_m));
}

// Nodes at this distance (voxel edges) or beyond never move again.
inline void fix_beyond(Rig& rig, const Vec& centre, double radius, const Vec& along = {1, 1, 1}) {
  View view = rig.view();
  for_each_node(view, [&](Node node) {
    if ((in_edges(node) - centre).cwiseProduct(along).norm() < radius) return;
    view.model.step_per_mass[node_index(view, node)] = 0;
  });
}

inline void step(Rig& rig) {
  View view = rig.view();
  const ModelHead& head = *view.model.head;
  const float keep = 1 - head.substep_s * head.config.surround_drag_per_s;  // as the step does
  for (const Load& load : rig.loads) {
    motion(view, load.axis).v[load.node] +=
        view.model.step_per_mass[load.node] * load.force_n / keep;
  }
  rig.session.kernel.step(rig.session.kernel);
  for (Hold& held : rig.holds) {
    held.force_n = static_cast<double>(motion(view, held.axis).v[held.node] /
                                       view.model.step_per_mass[held.node]);
    place(view, held.node, held.axis, held.displacement_m);
  }
}

inline double largest_speed(const View& view) {
  float largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float* v = motion(view, axis).v;
    for (std::uint32_t i = 0; i < view.model.head->counts.particles; ++i) {
      largest = std::max(largest, std::abs(v[i]));
    }
  }
  return static_cast<double>(largest);
}

// Steps until no node moves by more than `still` times the largest displacement in a step. After
// each step `constrain` may put nodes back. A body that does not come to rest fails the test.
template <typename Constrain>
int settle(Rig& rig, double still, Constrain constrain) {
  View view = rig.view();
  constexpr int kMostSteps = 20000, kBetweenLooks = 20;
  for (int i = 1; i <= kMostSteps; ++i) {
    step(rig);
    constrain();
    if (i % kBetweenLooks != 0) continue;
    const double moved = largest_speed(view) * static_cast<double>(view.model.head->substep_s);
    if (moved < still * static_cast<double>(view.state.head->max_displacement_m)) return i;
  }
  ADD_FAILURE() << "not at rest after " << kMostSteps << " steps: still moving "
                << largest_speed(view) << " m/s";
  return kMostSteps;
}

inline int settle(Rig& rig, double still = 1e-6) {
  return settle(rig, still, [] {});
}

// Forces on all nodes where they are, without moving anything.
inline std::vector<Vec> node_forces(Rig& rig) {
  View view = rig.view();
  const Kernel& kernel = rig.session.kernel;
  const std::vector<std::byte> state(kernel.state, kernel.state + kernel.sizes.state_bytes);
  const std::uint32_t count = view.model.head->counts.particles;
  float* const of_step = view.model.step_per_mass;
  const std::vector<float> step_per_mass(of_step, of_step + count);
  for (std::uint32_t i = 0; i < count; ++i) {
    view.model.step_per_mass[i] = view.model.particle_kg[i] > 0 ? 1.0F : 0.0F;
    view.state.vx[i] = view.state.vy[i] = view.state.vz[i] = 0;
  }
  kernel.step(kernel);
  std::vector<Vec> forces(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    forces[i] = {static_cast<double>(view.state.vx[i]), static_cast<double>(view.state.vy[i]),
                 static_cast<double>(view.state.vz[i])};
    view.model.step_per_mass[i] = step_per_mass[i];
  }
  std::copy(state.begin(), state.end(), kernel.state);
  return forces;
}

// Lets the rotations of all voxels follow what the nodes do, with every node where it is.
inline void let_rotations_follow(Rig& rig, int steps = 30) {
  View view = rig.view();
  const std::uint32_t count = view.model.head->counts.particles;
  float* const of_step = view.model.step_per_mass;
  const std::vector<float> step_per_mass(of_step, of_step + count);
  std::fill_n(of_step, count, 0.0F);
  for (int i = 0; i < steps; ++i) rig.session.kernel.step(rig.session.kernel);
  std::copy(step_per_mass.begin(), step_per_mass.end(), of_step);
}

// A constraint particle made by hand: one support of weight 1 in `voxel`, at `offset_m` from its
// centre, held `displacement_m` away from where it was at rest.
inline Particle& hold_constraint_particle(Rig& rig, Node voxel, Vec3 offset_m, Vec3 displacement_m,
                                          float stiffness_n_per_m) {
  View view = rig.view();
  const ModelHead& head = *view.model.head;
  const std::uint32_t row = voxel_row_of(view, voxel);
  const std::uint32_t slot = view.model.row[row].slot + voxel.x - view.model.row[row].x0;
  Particle& p = view.state.shaft[view.state.needle->shaft_count++];
  p = {};
  p.rest_m =
      head.origin_m +
      head.edge_m * Vec3{static_cast<float>(voxel.x) + 0.5F, static_cast<float>(voxel.y) + 0.5F,
                         static_cast<float>(voxel.z) + 0.5F} +
      offset_m;
  p.position_m = p.rest_m + displacement_m;
  p.stiffness_n_per_m = p.full_stiffness_n_per_m = stiffness_n_per_m;
  p.support_count = 1;
  p.support[0] = {slot, row, 1, offset_m, {}, {1, 0, 0, 0}};
  gather_coupled(view.model, view.state, view.scratch);
  return p;
}

}  // namespace stylet::test
