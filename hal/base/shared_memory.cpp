// SPDX-License-Identifier: Apache-2.0
#include "hal/base/shared_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace stylet::hal {
namespace {

[[noreturn]] void fail() {
  throw SideError(fmt::format("no memory for a process beside the loop: {}", std::strerror(errno)));
}

}  // namespace

int raised(int descriptor) {
  const int above = fcntl(descriptor, F_DUPFD_CLOEXEC, kLeastDescriptor);
  ::close(descriptor);
  return above;
}

// Sealed: if it were made smaller, every process that reads it would be killed.
SharedMemory::SharedMemory(std::size_t bytes)
    : SharedMemory(memfd_create("stylet", MFD_CLOEXEC | MFD_ALLOW_SEALING), bytes) {}

SharedMemory::SharedMemory(int descriptor, std::size_t bytes) : descriptor_(descriptor) {
  if (bytes > 0) {
    if (descriptor < 0 || ftruncate(descriptor, static_cast<off_t>(bytes)) != 0 ||
        fcntl(descriptor, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
      fail();
    }
    descriptor_ = raised(descriptor);
  }
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  void* at = size <= 0 ? MAP_FAILED
                       : mmap(nullptr, static_cast<std::size_t>(size), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_POPULATE, descriptor_, 0);
  if (at == MAP_FAILED) fail();
  bytes_ = {static_cast<std::byte*>(at), static_cast<std::size_t>(size)};
}

SharedMemory::~SharedMemory() {
  munmap(bytes_.data(), bytes_.size());
  ::close(descriptor_);
}

}  // namespace stylet::hal
