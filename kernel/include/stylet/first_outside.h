// SPDX-License-Identifier: Apache-2.0
// Compares a configuration's values with their limits and keeps the first one outside, so that a
// refusal can name it; also for configurations of other parts than the kernel. Not in a tick.
#pragma once

#include "stylet/kernel.h"

namespace stylet {

class FirstOutside {
 public:
  explicit FirstOutside(std::uint32_t index) : refusal_{"", index, 0, 0, 0, 0} {}

  // NaN is outside.
  void check(const char* field, double value, double least, double most, std::uint32_t vertex = 0) {
    if (!good_ || (value >= least && value <= most)) return;
    good_ = false;
    refusal_ = {field, refusal_.index, value, least, most, vertex};
  }

  bool good() const { return good_; }
  Status status(ConfigRefusal* refusal_out) const {
    if (good_) return Status::kOk;
    if (refusal_out != nullptr) *refusal_out = refusal_;
    return Status::kConfigValueOutOfRange;
  }

 private:
  ConfigRefusal refusal_;
  bool good_ = true;
};

}  // namespace stylet
