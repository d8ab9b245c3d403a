// SPDX-License-Identifier: Apache-2.0
#include "stylet/content_sum.h"

#include <algorithm>

#include "sha256.h"

namespace stylet {

std::array<std::uint8_t, 32> content_sha256(std::span<const std::byte> file, const Organ& organ) {
  if (organ.content_sha256.empty()) return sha256(std::array{file});
  const auto* const sum = reinterpret_cast<const std::byte*>(organ.content_sha256.data());
  const auto before = static_cast<std::size_t>(sum - file.data());
  return sha256(std::array{file.first(before), file.subspan(before + organ.content_sha256.size())});
}

bool has_its_bytes(std::span<const std::byte> file, const Organ& organ) {
  if (organ.content_sha256.empty()) return organ.format_version == 1;
  const auto sum = content_sha256(file, organ);
  const auto& said = organ.content_sha256;
  return std::equal(sum.begin(), sum.end(), said.begin(), said.end());
}

}  // namespace stylet
