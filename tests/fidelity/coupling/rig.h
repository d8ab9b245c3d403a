// SPDX-License-Identifier: Apache-2.0
// A block organ, a kernel, and a rigid needle along +x that a test moves by the position of its
// tip.
//
// Promises: the kernel runs unchanged; only `hold_one_shaft_particle` writes the state, to start
// from a case with a closed form. Units: SI. Frame: world.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/math.h"
#include "coupling/contact.h"
#include "coupling/match.h"
#include "coupling/return_map.h"
#include "coupling/spring.h"
#include "coupling/stiffness.h"
#include "coupling/support.h"
#include "lattice/voxel.h"
#include "promises.h"
#include "session.h"
#include "state/layout.h"
#include "stylet/kernel.h"
#include "tiny_organ.h"

namespace stylet::test {

struct Rig {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
  float length_m;

  Kernel& kernel() { return session.kernel; }
  View view() const { return view_of(session.kernel); }
};

enum class Tissue { kMoves, kFixed };

// With Tissue::kFixed every particle is attached, so that the coupling alone is measured.
inline Rig make_rig(const TinyOrgan& tiny, const Config& config, Tissue tissue = Tissue::kMoves) {
  TinyOrgan wanted = tiny;
  if (tissue == Tissue::kFixed) wanted.fixed_faces |= kLowX;  // so that the array exists
  std::vector<std::byte> bytes = tiny_organ(wanted);
  if (tissue == Tissue::kFixed) {
    auto* fixed = const_cast<std::uint8_t*>(format::GetOrgan(bytes.data())->voxel_fixed()->data());
    std::fill_n(fixed, std::size_t{tiny.nx} * tiny.ny * tiny.nz, std::uint8_t{255});
  }
  auto organ = open_organ(std::move(bytes));
  Session session = make_session(organ->organ, config);
  return {std::move(organ), std::move(session), config.needle[0].length_m};
}

// Needle along +x with its tip here.
inline Input along_x(Vec3 tip_m, float length_m) {
  const float half = std::sqrt(0.5F);
  return {{{tip_m.x - length_m, tip_m.y, tip_m.z}, {half, 0, -half, 0}}, 1};
}

// A tick; in each the wrench on every hand must be the sum over particles and contacts.
inline void checked_tick(Rig& rig, std::span<const Input> inputs, std::span<Output> outputs) {
  tick(rig.kernel(), inputs, outputs);
  for (std::uint32_t i = 0; i < outputs.size(); ++i) {
    const char* broken = broken_sum(rig.kernel(), i, outputs[i]);
    if (broken != nullptr) ADD_FAILURE() << "tick " << outputs[i].tick << ": " << broken;
  }
}
inline Output checked_tick(Rig& rig, const Input& input) {
  Output out = {};
  checked_tick(rig, {&input, 1}, {&out, 1});
  return out;
}

inline Output move_tip(Rig& rig, Vec3 tip_m) {
  return checked_tick(rig, along_x(tip_m, rig.length_m));
}

// Moves the tip along x at constant speed; `visit(output)` sees every tick.
template <typename Visit>
Output drive(Rig& rig, Vec3 from_m, float to_x_m, float speed_m_per_s, Visit visit) {
  const float period_s = rig.view().model.head->config.period_s;
  const double step = static_cast<double>(speed_m_per_s) * static_cast<double>(period_s);
  const double way = static_cast<double>(to_x_m) - static_cast<double>(from_m.x);
  const auto ticks = static_cast<int>(std::lround(std::fabs(way) / step));
  Output out = {};
  for (int i = 1; i <= ticks; ++i) {
    const double x = static_cast<double>(from_m.x) + way * i / ticks;
    out = move_tip(rig, {static_cast<float>(x), from_m.y, from_m.z});
    visit(out);
  }
  return out;
}
inline Output drive(Rig& rig, Vec3 from_m, float to_x_m, float speed_m_per_s) {
  return drive(rig, from_m, to_x_m, speed_m_per_s, [](const Output&) {});
}

// Keeps the pose for a while.
inline Output hold(Rig& rig, Vec3 tip_m, int ticks) {
  Output out = {};
  for (int i = 0; i < ticks; ++i) out = move_tip(rig, tip_m);
  return out;
}

// Lets a CP hold the tissue at a rest position by a spring of `stiffness_n_per_m`, without force.
inline void hold_tissue(const View& view, Particle& p, Vec3 rest_m, float stiffness_n_per_m) {
  p.rest_m = p.position_m = rest_m;
  p.stiffness_n_per_m = p.full_stiffness_n_per_m = stiffness_n_per_m;
  p.support_count = find_supports(view.model, rest_m, p.support);
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    p.support[i].goal_m = rest_m;
    p.support[i].turn = {1, 0, 0, 0};
    p.support[i].offset_m =
        rest_m -
        voxel_frame(view.model, view.state, p.support[i].slot, p.support[i].row).rest_centre_m;
  }
}

constexpr float kTipBeyondM = 0.03F;

// Puts one shaft CP with spring `stiffness_n_per_m` at a rest place. The tip of the needle that
// holds it is far behind the tissue, so that the friction of one unit of shaft is the only force.
inline Vec3 hold_one_shaft_particle(Rig& rig, Vec3 rest_m, float stiffness_n_per_m) {
  const Vec3 tip_m = rest_m + Vec3{kTipBeyondM, 0, 0};
  move_tip(rig, tip_m);
  View view = rig.view();
  Particle& p = view.state.shaft[0];
  p = {};
  p.arc_m = kTipBeyondM;
  p.friction = view.model.forces[0].friction;
  p.friction_length_m = view.model.needle_config().unit_m;
  hold_tissue(view, p, rest_m, stiffness_n_per_m);
  Particle& tip = *view.state.tip;
  tip = {};
  tip.rest_m = tip.position_m = tip_m;
  tip.track_m = kTipBeyondM;
  NeedleState& head = *view.state.needle;
  head.shaft_count = 1;
  head.tip_alive = 1;
  head.phase = Phase::kInserted;
  head.tissue_track_m = kTipBeyondM;
  return tip_m;
}

// The same for the tip, which holds the tissue at `rest_m`; the shaft CP behind it holds none.
inline Vec3 hold_tip(Rig& rig, Vec3 rest_m, float stiffness_n_per_m) {
  const Vec3 tip_m = hold_one_shaft_particle(rig, rest_m - Vec3{kTipBeyondM, 0, 0}, 1);
  View view = rig.view();
  Particle& tip = *view.state.tip;
  tip.track_m = kTipBeyondM;
  hold_tissue(view, tip, rest_m, stiffness_n_per_m);
  view.state.needle->layer = view.state.needle->spring_layer = 0;
  return tip_m;
}

inline double norm_of(Vec3 v) {
  return std::sqrt(static_cast<double>(v.x) * static_cast<double>(v.x) +
                   static_cast<double>(v.y) * static_cast<double>(v.y) +
                   static_cast<double>(v.z) * static_cast<double>(v.z));
}

// Least-squares line through points.
struct Line {
  double slope, offset;
};
inline Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return {xy / xx, my - xy / xx * mx};
}

}  // namespace stylet::test
