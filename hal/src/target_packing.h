// SPDX-License-Identifier: Apache-2.0
// A scene's targets on their way to another process.
#pragma once

#include "stylet/hal/packing.h"
#include "stylet/hal/score.h"

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

}  // namespace stylet::hal
