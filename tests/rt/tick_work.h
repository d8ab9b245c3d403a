// SPDX-License-Identifier: Apache-2.0
// The amount of work in a tick, counted from outside, and the most instructions that it may take
// with AVX2.
//
// The bound is a sum of amounts times prices. The kernel's limits bound the amounts, so the bound
// has a largest value for any organ. Prices are what callgrind counted, rounded up; rt.costs.*
// compare ticks of every scene, of the worst case and of random sessions with their bounds
// (tests/rt/README.md). Promise: no allocation. Amounts are counted after the tick; what the tick
// added, by comparison with the state before it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/math.h"
#include "state/layout.h"

namespace stylet::test {

struct Price {
  const char* of;
  std::uint64_t instructions;
};
// The prices of the filter are the smallest, on average, that bound the passes of 120 random bodies
// (solid, with holes, round, in slices; 0 to 7 passes), rounded up; the price of its ties is a
// guess.
constexpr Price kPrices[] = {
    {"tick", 4000},
    {"padded voxel and substep", 71},
    {"padded particle and substep", 21},
    {"voxel row and substep", 281},
    {"tie and substep", 125},
    {"point of a surface that slides and substep", 2100},
    {"padded particle and substep where parts slide", 16},
    {"padded voxel and pass of the filter", 11},
    {"padded particle and pass of the filter", 12},
    {"voxel row and pass of the filter", 140},
    {"tie and pass of the filter", 60},
    {"voxel with constraint particles and substep", 190},
    {"eight such voxels, or fewer, and substep", 1860},
    {"constraint particle in each of sixteen such voxels, or fewer, and substep", 340},
    {"share of a constraint particle in a voxel and substep", 34},
    {"share of a constraint particle in a voxel", 170},
    {"needle", 15000},
    {"needle and further sheet", 2400},
    {"constraint particle", 2600},
    {"new constraint particle", 20000},
    {"solve of an elastic needle", 44000},
    {"rod in such a solve", 3520},
    {"load on an elastic needle", 300},
    {"search of the surface by a needle outside", 140000},  // all triangles and visits of limits.h
    {"rod and obstacle", 110},
    {"rod near an obstacle", 6300},  // 290 of these instructions if the list of touches is full
    {"vertex of an obstacle with a rod near", 461},
};
enum Amount : std::uint32_t {  // in the order of the prices
  kTicks,
  kSlots,
  kNodes,
  kRows,
  kTies,
  kSlidePoints,
  kSlidParticles,
  kFilteredSlots,
  kFilteredNodes,
  kFilteredRows,
  kFilteredTies,
  kCoupled,
  kEights,
  kPasses,
  kShares,
  kMembers,
  kNeedlesUsed,
  kFurtherSheets,
  kParticles,
  kAdded,
  kSolves,
  kRods,
  kLoads,
  kSearches,
  kPairs,
  kNearPairs,
  kNearVertices,
  kAmounts
};
static_assert(std::size(kPrices) == kAmounts);
using Amounts = std::array<std::uint64_t, kAmounts>;

// Instructions of the worst case (worst_case.h), as in costs.txt. No other tick may have a larger
// bound. (Its tissue has added mass: with true mass the passes of the filter would be added.)
constexpr std::uint64_t kDearestTick = 1088537477;

inline std::uint64_t bound_of(const Amounts& amount) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kAmounts; ++i) sum += amount[i] * kPrices[i].instructions;
  return sum;
}

struct TickWork {
  Amounts amount{};
  std::array<std::uint32_t, kMaxNeedles> particles_before{};
  std::array<bool, kMaxNeedles> looked_before{};  // the needle was not in the tissue
};

inline bool bends(const NeedleConfig& config) {
  return config.bending_nm2 > 0 || config.bent_angle_rad > 0;
}

// As in the kernel's own first look: whether the piece's axis is within the body's enlarged
// bounding sphere.
inline bool is_near(const Obstacle& body, Vec3 a, Vec3 b, float radius_m) {
  const Vec3 centre =
      body.config.pose.position_m + rotation_matrix(body.config.pose.rotation) * body.centre_m;
  const Vec3 along = b - a, gap = centre - a;
  const float length2 = dot(along, along);
  const float t = length2 > 0 ? clamp(dot(gap, along) / length2, 0, 1) : 0;
  const Vec3 left = gap - t * along;
  const float limit = (body.bound_m + body.config.rounding_m + radius_m) * 1.001F;
  return dot(left, left) <= limit * limit;
}

// An elastic needle looks for obstacles between where the hand has carried it and where it comes to
// lie, which is not far from there; and once more each time that it bends against the tissue.
inline void add_obstacles(const View& view, std::uint32_t rods, Vec3 shift, std::uint32_t answers,
                          Amounts& amount) {
  constexpr float kReachM = 2e-3F, kBendM = 5e-3F;
  const bool elastic = bends(view.model.needle_config());
  const std::uint32_t looks = elastic ? kRodFaceLooks + answers : 1;
  const float radius_m =
      view.model.needle_config().outer_radius_m + (elastic ? kReachM + kBendM : 0);
  for (std::uint32_t body = 0; body < view.model.head->obstacle_count; ++body) {
    const Obstacle& obstacle = view.model.obstacle[body];
    for (std::uint32_t rod = 0; rod < rods; ++rod) {
      amount[kPairs] += looks;
      if (!is_near(obstacle, view.state.node[rod] + shift, view.state.node[rod + 1] + shift,
                   radius_m)) {
        continue;
      }
      amount[kNearPairs] += looks;
      amount[kNearVertices] += looks * obstacle.config.vertex_count;
    }
  }
}

// How often an elastic needle bends against the tissue, besides the bend when it is placed. A
// needle that has let go of tissue in this tick may have done so in the first of two bends.
inline std::uint32_t answers_of(const NeedleState& own, bool was_held) {
  if (own.tip_alive == 0) return was_held ? 1 : 0;
  return own.phase == Phase::kContact ? 2 : 1;
}

inline void add_needle(const View& view, Vec3 shift, TickWork& work) {
  const NeedleState& own = *view.state.needle;
  Amounts& amount = work.amount;
  const std::uint32_t particles = own.shaft_count + own.tip_alive;
  std::uint32_t& before = work.particles_before[view.state.needle_index];
  const std::uint32_t answers = answers_of(own, before > 0);
  amount[kAdded] += particles > before ? particles - before : 0;
  amount[kParticles] += particles;
  before = particles;
  // A free tip looks for tissue; a tip that leaves its contact looks for the tissue in which it
  // then lies.
  const bool looks = own.phase == Phase::kFree || own.phase == Phase::kContact;
  const bool looked = std::exchange(work.looked_before[view.state.needle_index], looks);
  if (own.handle_known == 0) return;
  ++amount[kNeedlesUsed];
  amount[kFurtherSheets] += view.model.head->counts.sheets - 1;
  if (looks || looked || own.tip_alive == 0) ++amount[kSearches];
  const std::uint32_t rods = view.model.rod->rods;
  if (bends(view.model.needle_config())) {
    // Near bodies each look takes three times the Newton steps, plus as much as two solves for the
    // step lengths that are tried.
    const bool bodies = view.model.head->obstacle_count > 0;
    const std::uint32_t first = bodies ? 5 * kRodFaceLooks : 1, second = bodies ? 5 : 1;
    const std::uint32_t bends = first + answers * second;
    amount[kSolves] += bends;
    amount[kRods] += bends * rods;
    amount[kLoads] += bends * particles;
  }
  add_obstacles(view, rods, shift, answers, amount);
}

// How often matches include a constraint particle, one for each voxel of a group.
inline std::uint32_t passes_of(const View& view) {
  const std::uint32_t groups = (view.scratch.head->coupled_count + kLanes - 1) / kLanes;
  std::uint32_t passes = 0;
  for (std::uint32_t i = 0; i < groups; ++i) passes += view.scratch.group[i].most_members;
  return passes;
}

// The motion of particles counts as a pass, and so does the mass that springs add.
inline void add_filter(const View& view, Amounts& amount) {
  const ModelHead& head = *view.model.head;
  if (!has_true_mass(view.model)) return;
  const std::uint64_t passes = std::uint64_t{head.config.substeps} * (head.filter.passes + 1);
  amount[kFilteredSlots] = passes * head.counts.slots;
  amount[kFilteredNodes] = passes * head.counts.particles;
  amount[kFilteredRows] = passes * head.counts.rows;
  amount[kFilteredTies] = passes * head.counts.ties;
}

// To be called after each tick.
inline void count_work(const Kernel& kernel, Vec3 shift, TickWork& work) {
  View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  const std::uint64_t substeps = head.config.substeps;
  work.amount = {};
  Amounts& amount = work.amount;
  amount[kTicks] = 1;
  if (view.state.head->latched_fault != 0) return;  // after a fault nothing is computed
  amount[kSlots] = substeps * head.counts.slots;
  amount[kNodes] = substeps * head.counts.particles;
  amount[kRows] = substeps * head.counts.rows;
  amount[kTies] = substeps * head.counts.ties;
  amount[kSlidePoints] = substeps * head.counts.slide_points;
  amount[kSlidParticles] = substeps * head.counts.slid_particles;
  add_filter(view, amount);
  const std::uint32_t voxels = view.scratch.head->coupled_count;
  amount[kCoupled] = substeps * voxels;
  amount[kEights] = substeps * ((voxels + 7) / 8);
  amount[kPasses] = substeps * passes_of(view);
  for (std::uint32_t i = 0; i < voxels; ++i) {
    amount[kMembers] += view.scratch.coupled[i].member_count;
  }
  amount[kShares] = substeps * amount[kMembers];
  for (std::uint32_t n = 0; n < head.counts.needles; ++n) {
    add_needle(needle_view(view, n), shift, work);
  }
}

}  // namespace stylet::test
