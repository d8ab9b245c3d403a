// SPDX-License-Identifier: Apache-2.0
// What a caller may ask between ticks: counters, events, constraint particles, energies. Cold path.

#include "base/math.h"
#include "base/vec3d.h"
#include "coupling/bend.h"
#include "coupling/contact_spring.h"
#include "coupling/match.h"
#include "coupling/roll.h"
#include "coupling/spring.h"
#include "coupling/slides.h"
#include "lattice/voxel.h"
#include "laws/stiffening.h"
#include "needle/rod.h"
#include "state/attachment.h"
#include "state/layout.h"

namespace stylet {

const char* event_name(EventKind kind) {
  switch (kind) {
    case EventKind::kContact:
      return "contact";
    case EventKind::kRelease:
      return "release";
    case EventKind::kPuncture:
      return "puncture";
    case EventKind::kReentry:
      return "re-entry";
    case EventKind::kExit:
      return "exit";
    case EventKind::kLayer:
      return "layer";
    case EventKind::kObstacle:
      return "obstacle";
    case EventKind::kFlashback:
      return "flashback";
    case EventKind::kLossOfResistance:
      return "loss of resistance";
  }
  return "unknown";
}

std::uint32_t events(const Kernel& kernel, std::span<Event> events_out) {
  const View view = view_of(kernel);
  const std::uint32_t all = view.state.head->event_count;
  std::uint32_t count = all < kMaxEvents ? all : kMaxEvents;
  if (count > events_out.size()) count = static_cast<std::uint32_t>(events_out.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    events_out[i] = view.state.event[(all - count + i) % kMaxEvents];
  }
  return count;
}

namespace {

void add_use(std::uint32_t used, std::uint32_t most, Pool& pool) {
  pool.used += used;
  pool.used_max = pool.used_max > most ? pool.used_max : most;
}

}  // namespace

Stats stats(const Kernel& kernel) {
  const StateHead& s = *view_of(kernel).state.head;
  Stats out = {};
  out.ticks = s.tick;
  const View view = view_of(kernel);
  out.constraint_particles.capacity = kMaxConstraintParticles;
  out.obstacle_contacts.capacity = kMaxTouches;
  const ModelHead& head = *view.model.head;
  const float finest_m = head.level[head.counts.levels - 1].edge_m;
  for (std::uint32_t i = 0; i < view.model.head->counts.needles; ++i) {
    const NeedleState& needle = view.state.needle[i];
    add_use(needle.shaft_count, needle.shaft_max, out.constraint_particles);
    add_use(needle.touch_count, needle.touch_max, out.obstacle_contacts);
    const float unit = view.model.head->config.needle[i].unit_m;
    out.unit_in_voxels = max_of(out.unit_in_voxels, unit / finest_m);
  }
  out.coupled_voxels = {0, s.coupled_max, kMaxCoupledVoxels * view.model.head->counts.needles};
  out.tracks = {s.track_count, s.track_max, kMaxTracks};
  out.input_not_finite = s.input_not_finite;
  out.input_clamped = s.input_clamped;
  out.input_missing = s.input_missing;
  out.cp_pool_full = s.cp_pool_full;
  out.cp_voxel_pool_full = s.cp_voxel_pool_full;
  out.contact_budget = s.contact_budget;
  out.fault = s.fault_count;
  out.obstacle_pool_full = s.obstacle_pool_full;
  out.needle_unstable = s.needle_unstable;
  out.coupling_shortfall = s.coupling_shortfall;
  return out;
}

std::uint32_t constraint_particles(const Kernel& kernel, std::span<ConstraintParticle> out) {
  const View view = view_of(kernel);
  const Vec3 shift = attachment_shift(view.model, view.state);
  std::uint32_t count = 0;
  for (std::uint32_t n = 0; n < view.model.head->counts.needles; ++n) {
    const View one = needle_view(view, n);
    const std::uint32_t shaft = one.state.needle->shaft_count;
    for (std::uint32_t i = 0; i <= shaft && count < out.size(); ++i) {
      const bool is_tip = i == shaft;
      if (is_tip && one.state.needle->tip_alive == 0) break;
      const Particle& p = is_tip ? *one.state.tip : one.state.shaft[i];
      Vec3 goal = {};
      for (std::uint32_t j = 0; j < p.support_count; ++j) {
        goal = goal + p.support[j].weight * p.support[j].goal_m;
      }
      out[count++] = {grip(p) + shift,      goal + shift,     -1.0F * p.force_n,
                      is_tip ? 0 : p.arc_m, is_tip ? 1U : 0U, n};
    }
  }
  return count;
}

std::uint32_t obstacle_touches(const Kernel& kernel, std::span<ObstacleTouch> out) {
  const View view = view_of(kernel);
  std::uint32_t count = 0;
  for (std::uint32_t n = 0; n < view.model.head->counts.needles; ++n) {
    const View one = needle_view(view, n);
    for (std::uint32_t i = 0; i < one.state.needle->touch_count && count < out.size(); ++i) {
      const Touch& touch = one.state.touch[i];
      out[count++] = {touch.at_m, touch.normal, touch.force_n, touch.obstacle, n};
    }
  }
  return count;
}

std::uint32_t needle_shape(const Kernel& kernel, std::uint32_t needle, std::span<Vec3> out) {
  const View view = view_of(kernel);
  if (needle >= view.model.head->counts.needles) return 0;
  const View one = needle_view(view, needle);
  if (one.state.needle->handle_known == 0) return 0;
  const Vec3 shift = attachment_shift(view.model, view.state);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i <= one.model.rod->rods && count < out.size(); ++i) {
    out[count++] = one.state.node[i] + shift;
  }
  return count;
}

namespace {

// Energy of a voxel without its CPs: stretch, hourglass part and volume, as in lattice.h.
double voxel_energy(const Model& model, const State& state, std::uint32_t row_index,
                    std::uint32_t slot) {
  const Row& row = model.row[row_index];
  const ModelHead& head = *model.head;
  const double h = static_cast<double>(level_of(model, row).edge_m);
  const double k = static_cast<double>(model.slot_k[slot]);
  // For the present corners: the state's rotation is a substep old.
  const Mat3 r =
      rotation_matrix(corner_rotation(state, slot, sum_corners(model, state, slot, row_index)));
  const std::uint32_t along = slot - row.slot;
  const float* u[3] = {state.ux, state.uy, state.uz};
  double stretch = 0, hourglass = 0, trace = 0;
  for (int c = 0; c < 3; ++c) {
    double value[8], mean = 0, gradient[3] = {};
    for (unsigned i = 0; i < 8; ++i) {
      value[i] = static_cast<double>(u[c][row.node[i >> 1U] + along + (i & 1U)]);
      mean += value[i] / 8;
      for (unsigned j = 0; j < 3; ++j) {
        gradient[j] += ((i >> j) & 1U) != 0 ? value[i] / (4 * h) : -value[i] / (4 * h);
      }
    }
    for (unsigned i = 0; i < 8; ++i) {
      double rest = value[i] - mean;
      for (unsigned j = 0; j < 3; ++j) {
        rest -= gradient[j] * (((i >> j) & 1U) != 0 ? h / 2 : -h / 2);
      }
      hourglass += rest * rest;
    }
    for (int j = 0; j < 3; ++j) {
      const double f = gradient[j] + (c == j ? 1.0 : 0.0);
      const double off = f - static_cast<double>(r.m[c][j]);
      stretch += off * off;
      trace += f * static_cast<double>(r.m[c][j]);
    }
  }
  const double chi = static_cast<double>(head.hourglass_weight);
  const double volume = static_cast<double>(model.slot_volume[slot]);
  const double stiffer = stiffens(model)
                             ? stiffening_energy(static_cast<double>(model.slot_stiffening[slot]),
                                                 stretch - (trace - 3) * (trace - 3) / 3)
                             : 0.0;
  return k * h * h * (stretch + stiffer + volume * (trace - 3) * (trace - 3)) +
         0.5 * k * chi * hourglass;
}

Vec3 momentum_per_mass(const State& state, std::uint32_t particle) {
  return {state.wx[particle], state.wy[particle], state.wz[particle]};
}

double kinetic_energy(const Model& model, const State& state) {
  const ModelHead& head = *model.head;
  double sum = 0;
  std::uint32_t tie = 0;  // in the order of the particles
  for (std::uint32_t i = 0; i < head.counts.particles; ++i) {
    if (tie < head.counts.ties && model.tie[tie].node == i) {  // its representative counts
      ++tie;
      continue;
    }
    if (!(model.step_per_mass[i] > 0)) continue;
    const Vec3 v = {state.vx[i], state.vy[i], state.vz[i]};
    const Vec3 w = has_true_mass(model) ? momentum_per_mass(state, i) : v;
    sum += 0.5 * static_cast<double>(head.substep_s / model.step_per_mass[i]) *
           dot(to_double(v), to_double(w));
  }
  return sum;
}

// Springs of the CPs with their Maxwell branches, and what the corners hold beyond their own match.
double coupling_energy(const Model& model, const State& state) {
  double sum = 0;
  Particle p = {};
  for (std::uint32_t n = 0; n < model.head->counts.needles; ++n) {
    const Model model_n = needle_model(model, n);
    const State state_n = needle_state(state, n);
    const NeedleState& own = state.needle[n];
    const std::uint32_t first = n * kNeedleParticles;
    for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
      sum += rematch(model, state, first + i, p) + spring_energy(p);
    }
    sum += roll_energy(state_n);
    if (own.tip_alive != 0) {
      sum += rematch(model, state, first + kMaxConstraintParticles, p) +
             tip_energy(model_n, state_n, p);
    }
  }
  return sum;
}

double needles_energy(const Model& model, const State& state) {
  double sum = 0;
  for (std::uint32_t n = 0; n < model.head->counts.needles; ++n) {
    sum += bending_energy(model.rod[n], state.rod_shape[n]);
  }
  return sum;
}

}  // namespace

Energy energy(const Kernel& kernel) {
  const View view = view_of(kernel);
  const StateHead& s = *view.state.head;
  Energy out = {};
  for (std::uint32_t r = 0; r < view.model.head->counts.rows; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t slot = row.slot; slot < row.slot + row.count; ++slot) {
      if (view.model.slot_k[slot] > 0) out.elastic += voxel_energy(view.model, view.state, r, slot);
    }
  }
  out.elastic += slides_energy(view.model, view.state);
  if (has_slides(view.model)) out.sliding = view.state.slide_books->friction_j;
  out.kinetic = kinetic_energy(view.model, view.state);
  out.coupling = coupling_energy(view.model, view.state);
  out.bending = needles_energy(view.model, view.state);
  out.work_by_hand = s.work_by_hand_j;
  out.friction = s.friction_j;
  out.cutting = s.cutting_j;
  out.relaxation = s.relaxation_j;
  out.obstacles = s.obstacles_j;
  return out;
}

}  // namespace stylet
