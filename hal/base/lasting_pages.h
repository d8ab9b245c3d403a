// SPDX-License-Identifier: Apache-2.0
// Pages of a file that another program may shorten. Touching a page that has gone raises SIGBUS,
// which would end this process with a hand on some other device.
//
// Promise: what is mapped here can be read and written, whatever becomes of the file. If pages have
// gone, all pages of the mapping are replaced at once by empty ones that nobody else sees. A SIGBUS
// with any other cause goes where it went before.
#pragma once

#include <cstddef>

namespace stylet::hal {

constexpr std::size_t kMostLastingMaps = 16;  // more needles than there can be; beyond it ENOMEM

// Null if it cannot be mapped, with the reason in errno. `bytes`: at most a page.
void* map_lasting(int file, std::size_t bytes);
void unmap_lasting(void* at, std::size_t bytes);

}  // namespace stylet::hal
