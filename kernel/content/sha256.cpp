// SPDX-License-Identifier: Apache-2.0
#include "sha256.h"

#include <sha2.h>

namespace stylet {

std::array<std::uint8_t, 32> sha256(std::span<const std::span<const std::byte>> pieces) {
  std::array<std::uint8_t, SHA256_DIGEST_LENGTH> sum{};
  SHA2_CTX digest;
  SHA256Init(&digest);
  for (const std::span<const std::byte> piece : pieces) {
    SHA256Update(&digest, reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size());
  }
  SHA256Final(sum.data(), &digest);
  return sum;
}

}  // namespace stylet
