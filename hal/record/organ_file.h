// SPDX-License-Identifier: Apache-2.0
// An organ file in memory.
// Promise: the organ of a file that stylet-organ wrote and nobody changed, or LoadError: one line
// with file, place, value and what was expected. Before the loop only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hal/loop/instance.h"
#include "stylet/organ.h"

namespace stylet::hal {

struct OrganFile {
  std::string path;
  std::vector<std::byte> bytes;
  Organ organ;  // points into bytes
};
OrganFile load_organ(const std::string& path);

}  // namespace stylet::hal
