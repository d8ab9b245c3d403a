// SPDX-License-Identifier: Apache-2.0
// An organ file, loaded into memory.
// Promise: gives the organ of an unchanged file from stylet-organ, or throws LoadError with one
// line: file, place, value and what was expected. Use before the loop only.
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
  Organ organ;  // points into `bytes`
};
OrganFile load_organ(const std::string& path);

}  // namespace stylet::hal
