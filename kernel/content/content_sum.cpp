// SPDX-License-Identifier: Apache-2.0
#include "stylet/content_sum.h"

#include <sha2.h>

#include <algorithm>

namespace stylet {

std::array<std::uint8_t, 32> content_sha256(std::span<const std::byte> file, const Organ& organ) {
  const auto* const all = reinterpret_cast<const std::uint8_t*>(file.data());
  const auto before = organ.content_sha256.empty()
                          ? file.size()
                          : static_cast<std::size_t>(organ.content_sha256.data() - all);
  const std::size_t behind = before + organ.content_sha256.size();
  std::array<std::uint8_t, SHA256_DIGEST_LENGTH> sum{};
  SHA2_CTX digest;
  SHA256Init(&digest);
  SHA256Update(&digest, all, before);
  SHA256Update(&digest, all + behind, file.size() - behind);
  SHA256Final(sum.data(), &digest);
  return sum;
}

bool has_its_bytes(std::span<const std::byte> file, const Organ& organ) {
  if (organ.content_sha256.empty()) return organ.format_version == 1;
  return std::ranges::equal(content_sha256(file, organ), organ.content_sha256);
}

}  // namespace stylet
