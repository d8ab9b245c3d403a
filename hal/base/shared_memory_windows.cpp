// SPDX-License-Identifier: Apache-2.0
// On Windows: pages of this process, which has no side processes.
#include <windows.h>

#include <cstring>

#include "hal/base/shared_memory.h"

namespace stylet::hal {

SharedMemory::SharedMemory(std::size_t bytes) : SharedMemory(-1, bytes) {}

SharedMemory::SharedMemory(int descriptor, std::size_t bytes) : descriptor_(descriptor) {
  // Zero, and as large as `bytes` says: null for none.
  void* const at = VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
  if (at == nullptr) throw SideError("out of memory, or memory of another process");
  std::memset(at, 0, bytes);  // touches every page
  bytes_ = {static_cast<std::byte*>(at), bytes};
}

SharedMemory::~SharedMemory() {
  VirtualFree(bytes_.data(), 0, MEM_RELEASE);
}

}  // namespace stylet::hal
