// SPDX-License-Identifier: Apache-2.0
// Sideways cutting: a needle dragged across tissue that has a toughness tears it.
//
// A particle whose force across the needle is above its limit takes hold of tissue farther on, so
// that the force is back on the limit: the return map of friction, across instead of along.
//
// Promises: bounded by kSupportsPerParticle, no allocation; stored energy falls by what is booked
// as cutting. Nothing in tissue without toughness, nor in paper mode. Units SI. PHYSICS 9.8.
#pragma once

#include "base/math.h"
#include "state/layout.h"

namespace stylet {

// Returns how far the particle cut, across `direction`; zero if its force across is at most
// `limit_n`.
Vec3 cut_sideways(const Model& model, State& state, Particle& p, Vec3 direction, float limit_n);

// The same for a particle of the shaft that carries `length_m` of it.
Vec3 cut_shaft_sideways(const Model& model, State& state, Particle& p, Vec3 direction,
                        float length_m);

}  // namespace stylet
