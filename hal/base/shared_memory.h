// SPDX-License-Identifier: Apache-2.0
// Memory that two processes can see, all of it there from the start, so that the loop never meets
// one of its pages for the first time. On Windows only the process that made it sees it: there are
// no side processes there.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>

namespace stylet::hal {

// The descriptors below are a side process's own. None of ours is there, so that none is
// overwritten while they are moved into place.
constexpr int kLeastDescriptor = 10;
// The same file under a descriptor that is not below; closes the one it was.
int raised(int descriptor);

struct SideError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);  // zero; throws SideError
  // The memory of a descriptor, in its full size.
  static SharedMemory of(int descriptor) { return {descriptor, 0}; }
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  std::span<std::byte> bytes() const { return bytes_; }
  int descriptor() const { return descriptor_; }

 private:
  SharedMemory(int descriptor, std::size_t bytes);
  int descriptor_;
  std::span<std::byte> bytes_;
};

}  // namespace stylet::hal
