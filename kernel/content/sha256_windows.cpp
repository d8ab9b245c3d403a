// SPDX-License-Identifier: Apache-2.0
// The second needs the first.
// clang-format off
#include <windows.h>
#include <bcrypt.h>
// clang-format on

#include <algorithm>
#include <cstdlib>

#include "sha256.h"

namespace stylet {
namespace {

constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;  // it counts bytes in 32 bits

// Windows has SHA-256 in every version; where it fails, nothing may count as summed.
void must(NTSTATUS status) {
  if (status < 0) std::abort();
}

}  // namespace

std::array<std::uint8_t, 32> sha256(std::span<const std::span<const std::byte>> pieces) {
  std::array<std::uint8_t, 32> sum{};
  BCRYPT_ALG_HANDLE algorithm = nullptr;
  BCRYPT_HASH_HANDLE digest = nullptr;
  must(BCryptOpenAlgorithmProvider(&algorithm, BCRYPT_SHA256_ALGORITHM, nullptr, 0));
  must(BCryptCreateHash(algorithm, &digest, nullptr, 0, nullptr, 0, 0));
  for (std::span<const std::byte> piece : pieces) {
    while (!piece.empty()) {
      const std::size_t now = std::min(piece.size(), kMostAtOnce);
      auto* const bytes =
          const_cast<UCHAR*>(reinterpret_cast<const UCHAR*>(piece.data()));  // it only reads them
      must(BCryptHashData(digest, bytes, static_cast<ULONG>(now), 0));
      piece = piece.subspan(now);
    }
  }
  must(BCryptFinishHash(digest, sum.data(), static_cast<ULONG>(sum.size()), 0));
  BCryptDestroyHash(digest);
  BCryptCloseAlgorithmProvider(algorithm, 0);
  return sum;
}

}  // namespace stylet
