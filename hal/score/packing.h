// SPDX-License-Identifier: Apache-2.0
// Writes a scene's targets and the score of an attempt for another process, and reads them back.
#pragma once

#include "hal/base/packing.h"
#include "hal/score/score.h"

namespace stylet::hal {

inline void pack_target(Packer& packer, const Target& target) {
  packer.put(target.name).put(target.position_m).put(target.radius_m).put(target.forbidden);
}

inline void unpack_target(Unpacker& unpacker, Target& target) {
  unpacker.get(target.name);
  unpacker.get(target.position_m);
  unpacker.get(target.radius_m);
  unpacker.get(target.forbidden);
}

// `Way` is a Packer's or an Unpacker's function.
template <typename Way>
void visit_score(Way way, Score& score) {
  way(score.duration_s);
  way(score.path_m);
  way(score.depth_path_m);
  way(score.puncture_count);
  way(score.punctures);
  way(score.withdrawals);
  way(score.targets);
  way(score.peak_force_n);
  way(score.peak_lateral_n);
  way(score.mean_force_n);
  way(score.faults);
}

}  // namespace stylet::hal
