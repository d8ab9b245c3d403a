// SPDX-License-Identifier: Apache-2.0
// How organ_open notes what it refuses.
#pragma once

#include "stylet/organ.h"

namespace stylet {

// Keeps the first refusal, so that every check below reads as one line; later checks do not run.
struct Checker {
  OrganRefusal refusal;

  bool require(bool good, Status status, const char* place, std::uint64_t index, double value,
               const char* expected) {
    if (!good) refusal = {status, place, index, value, expected};
    return good;
  }
  bool in_range(float value, float low, float high, const char* place, std::uint64_t index,
                const char* expected) {
    return require(value >= low && value <= high, Status::kOrganValueOutOfRange, place, index,
                   static_cast<double>(value), expected);
  }
};

}  // namespace stylet
