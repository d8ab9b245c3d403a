// SPDX-License-Identifier: Apache-2.0
// How fast a hand may move before it feels the inertia of the step: the first resonance of an organ
// with the mass that tissue has, and with the mass that the kernel uses in the step.
//
// The explicit step adds mass, or slows short waves (Inertia). At rest nothing changes; the error
// of the force on a moving hand grows as the square of its frequency. Both resonances are
// Rayleigh's quotients of small motion about rest, in the softest shapes of the attached organ, by
// subspace iteration (Bathe 1982). Its lattice has at most kMostResonanceCells cells, if need be of
// several voxels each: separate tissue in one cell then moves together. Masses are those of the
// voxels. The shapes of coarser cells make both frequencies a little too high, but hardly change
// their ratio.
//
// Promises: for setting up and reports, not for a tick: it allocates. With tens of thousands of
// voxels it takes below a second for added mass, seconds for true mass. Units SI, hertz.
#pragma once

#include <cstdint>

#include "stylet/kernel.h"

namespace stylet {

constexpr std::uint32_t kMostResonanceCells = 1500;
// A departure only above this need not be reported: hands are slower, and so is their tremor (8 to
// 12 Hz, Elble and Koller 1990).
constexpr double kFastestHandHz = 20;

struct Resonance {
  // Both are 0 where nothing is attached, or all of what is held in space.
  double real_hz;     // with the mass that tissue has
  double stepped_hz;  // with the mass of the step
  // For a hand that moves the organ in that shape: the frequency from which the forces with the two
  // masses differ by a tenth of the force on a resting hand. For a hand that moves less of the
  // organ it is higher. Infinite where the masses are the same.
  double departs_hz;
};

// For a kernel that create() made; reads only its model.
Resonance first_resonance(const Kernel& kernel);

}  // namespace stylet
