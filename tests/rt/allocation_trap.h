// SPDX-License-Identifier: Apache-2.0
// Counts the calls of the heap by this thread while the trap is armed. The whole malloc family of
// the program is replaced (operator new goes through it), so that nothing gets past it.
#pragma once

#include <cstdint>

namespace stylet::test {

// Starts counting from zero in this thread.
void arm_allocation_trap();
// Stops; returns the number of calls of the heap since it was armed.
std::uint64_t disarm_allocation_trap();

}  // namespace stylet::test
