// SPDX-License-Identifier: Apache-2.0
// Holds what a caller configures of guard and loop against its limits; the first field outside is
// told.
#pragma once

#include "hal/hosts/c/refusal.h"

namespace stylet::c {

class Limits {
 public:
  explicit Limits(std::uint32_t index) : why_{"", index, 0, 0, 0} {}

  void check(const char* field, double value, double least, double most) {
    if (why_.field[0] != '\0' || (value >= least && value <= most)) return;
    why_ = {field, why_.index, value, least, most};
  }
  stylet_status status(stylet_refusal* refusal_out) const {
    if (why_.field[0] == '\0') return STYLET_OK;
    return refuse_config(refusal_out, Status::kConfigValueOutOfRange, why_);
  }

 private:
  ConfigRefusal why_;
};

}  // namespace stylet::c
