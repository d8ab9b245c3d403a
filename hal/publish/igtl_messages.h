// SPDX-License-Identifier: Apache-2.0
// What is sent to an OpenIGTLink client, as bytes; igtl.h has the messages, their units and frame.
// Only this part knows the library.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hal/loop/record.h"
#include "hal/score/score.h"

namespace stylet::hal {

using IgtlBytes = std::vector<char>;

// Adds one needle's messages at the end of `out`.
void add_igtl_needle(const TickRecord& record, const Course& course, IgtlBytes& out);
// Without a fault: OK.
void add_igtl_status(Fault fault, std::uint64_t tick, IgtlBytes& out);
void add_igtl_targets(std::span<const Target> targets, IgtlBytes& out);

}  // namespace stylet::hal
