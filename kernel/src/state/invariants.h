// SPDX-License-Identifier: Apache-2.0
// What is true of a needle between the steps of a tick (tick.cpp). It is asserted only in debug,
// sanitizer and fuzzing builds and in the preset `invariants` (STYLET_INVARIANTS).
//
// The asserts guard against errors of this code. Nothing that hardware or a user says can break
// them, not even a restored snapshot (snapshot.cpp refuses such bytes). Numbers that are not finite
// are not an error here: they become a fault at the end of the tick.
#pragma once

#include "state/layout.h"

namespace stylet {

#ifdef STYLET_INVARIANTS
void assert_needle(const Model& model, const State& state);
#else
inline void assert_needle(const Model&, const State&) {}
#endif

}  // namespace stylet
