// SPDX-License-Identifier: Apache-2.0
// What an OpenIGTLink client is sent, as bytes; see igtl.h for the messages, their units and frame.
// The only place that knows the library.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hal/loop/record.h"
#include "hal/score/score.h"

namespace stylet::hal {

using IgtlBytes = std::vector<char>;

// One needle's messages, put to the end of `out`.
void add_igtl_needle(const TickRecord& record, const Course& course, IgtlBytes& out);
// No fault: OK.
void add_igtl_status(Fault fault, std::uint64_t tick, IgtlBytes& out);
void add_igtl_targets(std::span<const Target> targets, IgtlBytes& out);

}  // namespace stylet::hal
