// SPDX-License-Identifier: Apache-2.0
// Pages of a file that another program may shorten. A touch of one that has gone raises SIGBUS,
// which would end this process with a hand on some other device.
//
// Promise: what is mapped here can be read and written whatever becomes of the file. Pages that
// have gone are replaced, all of the mapping at once, by empty ones that nobody else sees. A SIGBUS
// of anything else goes where it went before.
#pragma once

#include <cstddef>

namespace stylet::hal {

constexpr std::size_t kMostLastingMaps = 16;  // more needles than there are; then ENOMEM

// Null, and errno: not mapped. `bytes`: at most a page.
void* map_lasting(int file, std::size_t bytes);
void unmap_lasting(void* at, std::size_t bytes);

}  // namespace stylet::hal
