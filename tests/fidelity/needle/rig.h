// SPDX-License-Identifier: Apache-2.0
// A needle with its loads, solved tick by tick, for the tests of the rod.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "needle/rod.h"

namespace stylet::test {

struct Turn {
  double wxyz[4];
};
inline Turn turn_about(Vec3d axis, double angle_rad) {
  const Vec3d v = (std::sin(0.5 * angle_rad) / norm(axis)) * axis;
  return {{std::cos(0.5 * angle_rad), v.x, v.y, v.z}};
}
inline Vec3d turned(const Turn& turn, Vec3d a) {
  const Vec3d v{turn.wxyz[1], turn.wxyz[2], turn.wxyz[3]};
  const Vec3d c = 2.0 * cross(v, a);
  return a + turn.wxyz[0] * c + cross(v, c);
}

struct Needle {
  double length_m, bending_nm2;
  Turn handle{{1, 0, 0, 0}};
  RodModel model{};
  RodLoads loads{};
  RodShape shape{};
  RodScratch scratch{};
  RodResult result{};

  Needle(std::uint32_t rods, double length, double bending, std::span<const RodKink> rest = {})
      : length_m(length), bending_nm2(bending) {
    make_rod(rods, length, bending, rest, model);
    relax_rod(model, shape);
  }

  RodLoad& add(double arc_m) {
    RodLoad& load = loads.load[loads.count++];
    load = {};
    load.arc_m = arc_m;
    return load;
  }
  void push(double arc_m, Vec3d force_n) { add(arc_m).force_n = force_n; }
  void hold(double arc_m, Vec3d place_m, Sym3d stiffness) {
    RodLoad& load = add(arc_m);
    load.place_m = place_m;
    load.stiffness_n_per_m = stiffness;
  }

  void tick() { solve_rod(model, handle.wxyz, loads, shape, scratch, result); }
  // Ticks until the step still needed is below the bound; false: it never was.
  bool settle(double bound_rad = 1e-13, int most_ticks = 400) {
    for (int i = 0; i < most_ticks; ++i) {
      tick();
      if (result.last_turn_rad < bound_rad) return true;
    }
    return false;
  }
  Vec3d tip() const { return result.node_m[model.rods]; }
};

// On the heap: a needle is 150 kB.
inline std::unique_ptr<Needle> needle(std::uint32_t rods, double length_m, double bending_nm2,
                                      std::span<const RodKink> rest = {}) {
  return std::make_unique<Needle>(rods, length_m, bending_nm2, rest);
}

constexpr Sym3d kLateral{1, 0, 0, 1, 0, 0};
constexpr Sym3d kIsotropic{1, 0, 0, 1, 0, 1};
inline Sym3d operator*(double s, const Sym3d& k) {
  return {s * k.xx, s * k.xy, s * k.xz, s * k.yy, s * k.yz, s * k.zz};
}

// Over all joints, the largest difference between the moment of the loads beyond the joint and the
// moment with which its spring answers, about the axes that it bends about. The spring's law is
// that of the rod's header, written out again.
inline double worst_moment_error(const Needle& n) {
  double worst = 0;
  for (std::uint32_t j = 0; j < n.model.rods; ++j) {
    Vec3d moment{0, 0, 0};
    for (std::uint32_t i = 0; i < n.loads.count; ++i) {
      if (n.loads.load[i].arc_m <= j * n.model.rod_m) continue;
      const Vec3d at = rod_point(n.model, n.result, n.loads.load[i].arc_m).place_m;
      moment = moment + cross(at - n.result.node_m[j], n.result.load_n[i]);
    }
    const Vec3d rest = n.scratch.joint[j].rest, along = n.result.direction[j];
    const double open = 1 + dot(rest, along);
    const double k = (j == 0 ? 2 : 1) * n.bending_nm2 / n.model.rod_m;
    const Vec3d spring = k * (2.0 / 3) * (2 / (open * open) + 1) * cross(rest, along);
    const Vec3d middle = (1 / norm(rest + along)) * (rest + along);
    const Vec3d off = moment - spring;
    worst = std::max(worst, norm(off - dot(off, middle) * middle));
  }
  return worst;
}

}  // namespace stylet::test
