// SPDX-License-Identifier: Apache-2.0
// What holds of a needle between the steps of a tick (tick.cpp), asserted in debug, sanitizer and
// fuzzing builds (STYLET_INVARIANTS) and nowhere else.
//
// They guard against errors of this code: nothing that hardware or a user says can break them, a
// restored snapshot included (snapshot.cpp refuses what would). Numbers that are not finite are no
// error here: they become a fault at the tick's end.
#pragma once

#include "state/layout.h"

namespace stylet {

#ifdef STYLET_INVARIANTS
void assert_needle(const Model& model, const State& state);
#else
inline void assert_needle(const Model&, const State&) {}
#endif

}  // namespace stylet
