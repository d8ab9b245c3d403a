// SPDX-License-Identifier: Apache-2.0
// How fast a hand may be before the inertia of the step is felt: the first resonance of an organ
// with the mass that tissue has, and with the mass the kernel steps it with.
//
// The explicit step adds mass, or slows short waves (Inertia). At rest nothing changes; the force
// on a moving hand departs as the square of its frequency. Both frequencies are Rayleigh's
// quotients of small motion about rest, in the space of the softest shapes of the held organ:
// subspace iteration (Bathe 1982) on a lattice of at most kMostResonanceCells cells, several voxels
// a cell if need be, so that tissue that lies apart in one cell moves together; masses are those of
// the voxels. A shape taken from coarser cells makes both frequencies a little too high, their
// ratio hardly.
//
// Promises: for setting up and reports, not for a tick: allocates. Below a second for added mass,
// seconds for true mass in tens of thousands of voxels. Units SI, hertz.
#pragma once

#include <cstdint>

#include "stylet/kernel.h"

namespace stylet {

constexpr std::uint32_t kMostResonanceCells = 1500;
// What departs only above this is not worth a word: hands are slower, their tremor (8 to 12 Hz,
// Elble and Koller 1990) too.
constexpr double kFastestHandHz = 20;

struct Resonance {
  double real_hz;     // with the mass that tissue has; 0 where nothing holds the organ
  double stepped_hz;  // with that of the step
  // From here on the two differ by a tenth of the force that a resting hand feels, for a hand that
  // moves the organ in that shape; one that moves less of it meets this later. Infinite where they
  // are the same.
  double departs_hz;
};

// Of a kernel that create() made; reads its model alone.
Resonance first_resonance(const Kernel& kernel);

}  // namespace stylet
