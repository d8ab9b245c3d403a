// SPDX-License-Identifier: Apache-2.0
// The tissue's energy and internal friction, by the textbook, in double precision: an independent
// check of the kernel's energy books. It is slow: it computes every voxel every time.
//
// For each voxel of edge h (PHYSICS 2.3, 2.4), k = G h fill:
// U = k/2 sum |x_i - R q_i - t|^2 + (chi - 1) k/2 sum |e_i|^2 + k h^2 nu/(1 - 2 nu) (tr R^T F -
// 3)^2
// The CPs of the voxel take part in the fit of R and t in the first term; R in the last is that of
// the corners alone. Units: SI.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "rig.h"

namespace stylet::test {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  // rows

inline double determinant(const Matrix3& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

// Rotation of the polar decomposition by Higham's Newton iteration; `a` must not be inverted.
inline Matrix3 polar_rotation(Matrix3 a) {
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double det = determinant(a);
    double change = 0;
    Matrix3 next;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const double cofactor = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
        next[i][j] = 0.5 * (a[i][j] + cofactor / det);
        change = std::max(change, std::fabs(next[i][j] - a[i][j]));
      }
    }
    a = next;
    if (change < 1e-13) break;
  }
  return a;
}

struct ReferenceCell {
  std::uint32_t slot;
  double k, volume;  // G h, nu / (1 - 2 nu)
  Vector3 rest_centre;
  std::array<std::uint32_t, 8> particle;  // bit 0 x, bit 1 y, bit 2 z
};

struct Corner8 {
  std::array<Vector3, 8> q, x;  // rest offset; place against the rest centre
  Vector3 mean;
  Matrix3 gradient;  // F
};

class ClusterReference {
 public:
  ClusterReference(const View& view, const std::vector<TinyMaterial>& materials, double chi)
      : h_(static_cast<double>(view.model.head->edge_m)), chi_(chi) {
    for (std::uint32_t r = 0; r < view.model.head->counts.rows; ++r) {
      const Row& row = view.model.row[r];
      for (std::uint32_t i = 0; i < row.count; ++i) {
        ReferenceCell cell = {row.slot + i, 0, 0, {}, {}};
        const TinyMaterial& m = materials[view.model.slot_material[cell.slot]];
        const double nu = static_cast<double>(m.poisson_ratio);
        cell.k = static_cast<double>(m.youngs_modulus_pa) / (2 * (1 + nu)) * h_;
        cell.volume = nu / (1 - 2 * nu);
        cell.rest_centre = {h_ * (row.x0 + i + 0.5), h_ * (row.y + 0.5),
                            h_ * (view.model.plane[row.plane].z + 0.5)};
        for (std::uint32_t c = 0; c < 8; ++c) cell.particle[c] = row.node[c >> 1U] + i + (c & 1U);
        cells_.push_back(cell);
      }
    }
  }

  // Elastic energy of tissue and CPs together, at the state's displacements.
  double energy(const View& view) const {
    const auto members = members_of(view);
    double sum = 0;
    for (const ReferenceCell& cell : cells_) {
      const State& s = view.state;
      const Corner8 c = corners(cell, &s.ux[0], &s.uy[0], &s.uz[0]);
      const auto found = members.find(cell.slot);
      sum +=
          found == members.end() ? cell_energy(cell, c, {}) : cell_energy(cell, c, found->second);
    }
    for_each_particle(view, [&](const Particle& p) {
      if (&p == view.state.tip && view.state.needle->phase == Phase::kContact) return;
      const double s = static_cast<double>(p.stiffness_n_per_m);
      const double m = static_cast<double>(p.relaxing_fraction);
      sum += 0.5 * m * (1 - m) * std::max(0.0, static_cast<double>(dot(p.memory_n, p.memory_m)));
      const double give = static_cast<double>(p.axial_fraction);
      if (give > 0) sum += 0.5 * s * (1 / give - 1) * std::pow(norm_of(p.axial_way_m), 2);
    });
    return sum + cone_energy(view);
  }

  // Work that damping takes in one substep: the difference of the internal forces at u and at
  // u + tau v, times the mean velocity. `u`, `v` before the substep, `w` the velocity behind it.
  double damping_loss(const std::array<std::vector<float>, 3>& u,
                      const std::array<std::vector<float>, 3>& v, const View& view,
                      double substep_s) const {
    const double tau = static_cast<double>(view.model.head->config.tissue_damping_s);
    const float* w[3] = {view.state.vx, view.state.vy, view.state.vz};
    std::array<std::vector<double>, 3> e;
    for (std::size_t a = 0; a < 3; ++a) {
      e[a].resize(u[a].size());
      for (std::size_t i = 0; i < u[a].size(); ++i) {
        e[a][i] = static_cast<double>(u[a][i]) + tau * static_cast<double>(v[a][i]);
      }
    }
    double loss = 0;
    for (const ReferenceCell& cell : cells_) {
      bool moving = false;
      for (const std::uint32_t p : cell.particle) {
        moving |= v[0][p] != 0 || v[1][p] != 0 || v[2][p] != 0;
      }
      if (!moving) continue;
      const auto at_u = forces(cell, corners(cell, u[0].data(), u[1].data(), u[2].data()));
      const auto at_e = forces(cell, corners(cell, e[0].data(), e[1].data(), e[2].data()));
      for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
          const std::uint32_t p = cell.particle[i];
          const double speed = 0.5 * (static_cast<double>(v[a][p]) + static_cast<double>(w[a][p]));
          loss += substep_s * (at_u[i][a] - at_e[i][a]) * speed;
        }
      }
    }
    return loss;
  }

 private:
  struct Member {
    double w;
    Vector3 x, r;  // place against the rest centre, rest offset
  };

  template <typename Visit>
  static void for_each_particle(const View& view, Visit visit) {
    const NeedleState& head = *view.state.needle;
    for (std::uint32_t i = 0; i < head.shaft_count; ++i) visit(view.state.shaft[i]);
    if (head.tip_alive != 0) visit(*view.state.tip);
  }

  // The tip in contact is a cone of radius a that goes over into a cylinder at the depth l = a pi /
  // (2 tan 15 degrees): F = k d^2 / (2 l), then k (d - l / 2). The lattice's part of the depth, L
  // F, is not part of the spring's. If the lattice gives way faster, by L g F^2, the spring carries
  // more and stores L g F^3 / 3 in all. The force is less by q, which may be at most the difference
  // to a cone with (1 - phi) k.
  struct ContactReference {
    double l, lattice, growth, most;  // growth up to the force `most`

    double force(double k, double d) const { return d < l ? k * d * d / (2 * l) : k * (d - l / 2); }
    // The force of all the tissue where the spring is this deep.
    double depth(double k, double spring) const {
      double low = spring, high = spring;
      while (high - lattice * force(k, high) < spring) high = 2 * high + l;
      for (int i = 0; i < 200; ++i) {
        const double mid = 0.5 * (low + high);
        (mid - lattice * force(k, mid) < spring ? low : high) = mid;
      }
      return 0.5 * (low + high);
    }
    double energy(double k, double spring) const {
      const double d = depth(k, spring), f = force(k, d);
      const double whole =
          d < l ? k * d * d * d / (6 * l) : k * (d * d / 2 - l * d / 2 + l * l / 6);
      return whole - 0.5 * lattice * f * f;
    }
    double growth_energy(double k, double spring) const {
      const double f = force(k, depth(k, spring)), m = std::min(f, most);
      return lattice * growth * (m * m * m / 3 + m * f * (f - m));
    }
    double missing(double k, double relaxed, double spring) const {
      return force(k, depth(k, spring)) - force(relaxed, depth(relaxed, spring));
    }
    double depth_missing(double k, double relaxed, double q) const {
      double low = 0, high = q > 0 ? l : 0;
      while (missing(k, relaxed, high) < q) high = 2 * high;
      for (int i = 0; i < 200; ++i) {
        const double mid = 0.5 * (low + high);
        (missing(k, relaxed, mid) < q ? low : high) = mid;
      }
      return 0.5 * (low + high);
    }
  };

  static double cone_energy(const View& view) {
    if (view.state.needle->phase != Phase::kContact) return 0;
    const Particle& tip = *view.state.tip;
    const ModelHead& head = *view.model.head;
    const MaterialModel& m = head.material[tip.material];
    Vec3 off = {};
    double squares = 0, beside = 0, all = 0;
    for (std::uint32_t i = 0; i < tip.support_count; ++i) {
      const Support& s = tip.support[i];
      off = off + s.weight * (tip.position_m - s.goal_m);
      // Weights are proportional to the roots of the stiffnesses; without stiffnesses they are
      // those of a single tissue.
      const MaterialModel& of = head.material[view.model.slot_material[s.slot]];
      const double w =
          static_cast<double>(s.weight) / std::sqrt(static_cast<double>(of.lattice[0].shear_pa));
      all += w;
      squares += w * w;
      // The needle of the tests goes along x.
      beside += w * w *
                (std::pow(static_cast<double>(s.offset_m.y), 2) +
                 std::pow(static_cast<double>(s.offset_m.z), 2)) /
                std::pow(static_cast<double>(head.edge_m), 2);
    }
    squares /= all * all;
    beside /= all * all;
    const double unit = static_cast<double>(m.lattice[0].shear_pa * head.edge_m);
    const double edge = static_cast<double>(head.edge_m);
    const double radius = static_cast<double>(head.config.needle[0].outer_radius_m);
    const double own = static_cast<double>(tip.full_stiffness_n_per_m);
    const double lattice =
        (0.170 - 0.101 * static_cast<double>(m.poisson_ratio) + 0.097 * squares + 0.281 * beside) /
        unit;
    const double k = 1 / (1 / own + lattice);
    const double punch =
        4 * static_cast<double>(m.shear_pa) * radius / (1 - static_cast<double>(m.poisson_ratio));
    // If the lattice is softer than the punch, the cone ends at a narrower cylinder.
    const double narrower = std::min(1.0, k / punch);
    const double relaxed = k * (1 - static_cast<double>(m.relaxing_fraction));
    const double grows = 0.06 - 0.1 * squares;
    const ContactReference law = {
        narrower * radius * 3.14159265 / (2 * std::tan(3.14159265 / 12)), lattice,
        grows / (unit * edge),
        unit * edge * std::min(5.0, (0.8 / (lattice * k) - 1) / (2 * grows))};
    const double q = own * norm_of(tip.memory_m), z = law.depth_missing(k, relaxed, q);
    const double along = own * static_cast<double>(dot(tip.memory_m, off));
    const double d = norm_of(off);
    return law.energy(k, d) + law.growth_energy(k, d) -
           (law.energy(k, z) - law.energy(relaxed, z) + along - q * z) -
           0.5 * static_cast<double>(tip.stiffness_n_per_m) *
               std::pow(norm_of(off - tip.slack_m), 2);
  }

  std::map<std::uint32_t, std::vector<Member>> members_of(const View& view) const {
    std::map<std::uint32_t, std::vector<Member>> members;
    std::map<std::uint32_t, Vector3> centre;
    for (const ReferenceCell& cell : cells_) centre[cell.slot] = cell.rest_centre;
    for_each_particle(view, [&](const Particle& p) {
      const float place[3] = {p.position_m.x, p.position_m.y, p.position_m.z};
      const float slack[3] = {p.slack_m.x, p.slack_m.y, p.slack_m.z};
      for (std::uint32_t s = 0; s < p.support_count; ++s) {
        const Support& share = p.support[s];
        Member member = {};
        member.w = static_cast<double>(p.stiffness_n_per_m) * static_cast<double>(share.weight);
        const float offset[3] = {share.offset_m.x, share.offset_m.y, share.offset_m.z};
        for (std::size_t a = 0; a < 3; ++a) {
          member.x[a] =
              static_cast<double>(place[a]) - static_cast<double>(slack[a]) - centre[share.slot][a];
          member.r[a] = static_cast<double>(offset[a]);
        }
        members[share.slot].push_back(member);
      }
    });
    return members;
  }

  template <typename T>
  Corner8 corners(const ReferenceCell& cell, const T* ux, const T* uy, const T* uz) const {
    Corner8 c = {};
    const T* u[3] = {ux, uy, uz};
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        c.q[i][a] = ((i >> a) & 1U) != 0 ? h_ / 2 : -h_ / 2;
        c.x[i][a] = c.q[i][a] + static_cast<double>(u[a][cell.particle[i]]);
        c.mean[a] += c.x[i][a] / 8;
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        for (std::size_t i = 0; i < 8; ++i) {
          c.gradient[a][b] += c.x[i][a] * c.q[i][b] / (2 * h_ * h_);
        }
      }
    }
    return c;
  }

  static Vector3 apply(const Matrix3& a, const Vector3& v) {
    Vector3 out = {};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) out[i] += a[i][j] * v[j];
    }
    return out;
  }

  static double trace_product(const Matrix3& a, const Matrix3& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sum += a[i][j] * b[i][j];
    }
    return sum;
  }

  double cell_energy(const ReferenceCell& cell, const Corner8& c,
                     const std::vector<Member>& members) const {
    const Matrix3 corner_rotation = polar_rotation(c.gradient);
    double whole = 8 * cell.k;
    Vector3 place = {}, offset = {};
    for (std::size_t a = 0; a < 3; ++a) place[a] = 8 * cell.k * c.mean[a];
    for (const Member& m : members) {
      whole += m.w;
      for (std::size_t a = 0; a < 3; ++a) {
        place[a] += m.w * m.x[a];
        offset[a] += m.w * m.r[a];
      }
    }
    Matrix3 fit = {};
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        fit[a][b] = 2 * cell.k * h_ * h_ * c.gradient[a][b] - place[a] * offset[b] / whole;
        for (const Member& m : members) fit[a][b] += m.w * m.x[a] * m.r[b];
        fit[a][b] /= 2 * cell.k * h_ * h_;
      }
    }
    const Matrix3 r = polar_rotation(fit);
    const Vector3 turned = apply(r, offset);
    double sum = 0, hourglass = 0;
    const auto square_off = [&](const Vector3& x, const Vector3& q) {
      const Vector3 goal = apply(r, q);
      double square = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double off = x[a] - goal[a] - (place[a] - turned[a]) / whole;
        square += off * off;
      }
      return square;
    };
    for (std::size_t i = 0; i < 8; ++i) {
      sum += 0.5 * cell.k * square_off(c.x[i], c.q[i]);
      const Vector3 affine = apply(c.gradient, c.q[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        const double rest = c.x[i][a] - c.mean[a] - affine[a];
        hourglass += rest * rest;
      }
    }
    for (const Member& m : members) sum += 0.5 * m.w * square_off(m.x, m.r);
    const double swell = trace_product(corner_rotation, c.gradient) - 3;
    return sum + 0.5 * (chi_ - 1) * cell.k * hourglass +
           cell.k * h_ * h_ * cell.volume * swell * swell;
  }

  std::array<Vector3, 8> forces(const ReferenceCell& cell, const Corner8& c) const {
    const Matrix3 r = polar_rotation(c.gradient);
    const double swell = cell.volume * (trace_product(r, c.gradient) - 3);
    std::array<Vector3, 8> out = {};
    for (std::size_t i = 0; i < 8; ++i) {
      const Vector3 turned = apply(r, c.q[i]), affine = apply(c.gradient, c.q[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        const double rest = c.x[i][a] - c.mean[a] - affine[a];
        out[i][a] = -cell.k * (affine[a] - turned[a] + chi_ * rest) - cell.k * swell * turned[a];
      }
    }
    return out;
  }

  double h_, chi_;
  std::vector<ReferenceCell> cells_;
};

}  // namespace stylet::test
