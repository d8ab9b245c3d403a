// SPDX-License-Identifier: Apache-2.0
// Runs a scenario through hal's loop in virtual time and checks what must hold after every tick.
//
// Checked: promises.h (finite, sums, pools, phases); the force sent is within its limits of size
// and slew, and zero 25 ms after a fault or the last usable sample; no tick may cost more than the
// worst case of tests/rt; the observer of energy; and, once the needles are withdrawn, that the
// tissue is back at rest.
//
// The observer. Of all needles together, from the start of the session,
// E(t) = work of the hands on the needles' bases - energy stored in the tissue, in the springs of
// the constraint particles, in bent needles and in what they press of obstacles.
// The work is the integral of the wrench felt over the motion of the bases in the frame of the
// attachments (breathing moves that frame, and does no work in it); for each tick the wrench is the
// mean of those at its two ends. The energy of the tissue is the one that the step keeps
// (tissue_energy in step_energy.h). What the kernel dissipates makes E grow: a kernel that makes no
// energy keeps E above zero.
// In a gentle session E stays above -kObserverJ. In the others a hand may move by millimetres in a
// tick, and the force on the way is known only up to half of its change: the check is E >
// -(kObserverJ + slack), where slack is the sum of half the change of the wrench times the motion.
// There the observer also stops once a voxel is turned inside out. If a hand throws a needle
// through an obstacle in a tick, the force on the way does not lie between the wrenches at the
// ends: the slack of that tick is twice the force at the deepest point of a straight way, times the
// way, and the observer goes on from what is stored then. It stops where an elastic needle has
// found no stable shape (kFlagNeedleUnstable), and begins again a while after the last such tick,
// from what is stored then. Obstacles move in the frame of the attachments, and do work on a needle
// that touches them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "scenario.h"

namespace stylet::test {

constexpr double kObserverJ = 1e-6;

struct Verdict {
  const char* broken = nullptr;  // nullptr: every promise held
  std::uint64_t tick = 0;        // where it broke
  std::uint64_t ticks = 0;
  double observer_min_j = 0;
  std::uint64_t observed_ticks = 0;  // ticks that the observer of energy has judged
  std::uint32_t faults = 0, punctures = 0, touches_max = 0;
  // The tick with the most particles and contacts.
  std::uint64_t busiest_tick = 0;
  std::uint32_t busiest_load = 0;
  // The tick that may cost most (tick_work.h), and how many instructions it may take.
  std::uint64_t dearest_tick = 0, dearest_bound = 0;
  double rest_s = 0;  // how long the tissue took to come to rest
};

// `tamper` is called after every tick: the simulator's own tests use it to break a promise.
using Tamper = std::function<void(Kernel&, std::uint64_t tick)>;
// For ticks that are `wanted`, `count` gets a copy of the kernel as it was before the tick, and the
// tick's inputs: to repeat the tick and count its instructions.
struct Meter {
  std::function<bool(std::uint64_t tick)> wanted;
  std::function<void(Kernel& before, std::span<const Input> inputs)> count;
};
Session session_of(const Scenario& scenario);
Verdict simulate(const Scenario& scenario, const Tamper& tamper = {}, const Meter& meter = {});

}  // namespace stylet::test
