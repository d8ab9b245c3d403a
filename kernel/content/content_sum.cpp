// SPDX-License-Identifier: Apache-2.0
#include "stylet/content_sum.h"

#include <openssl/evp.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace stylet {

std::array<std::uint8_t, 32> content_sha256(std::span<const std::byte> file, const Organ& organ) {
  const auto* const all = reinterpret_cast<const std::uint8_t*>(file.data());
  const auto before = organ.content_sha256.empty()
                          ? file.size()
                          : static_cast<std::size_t>(organ.content_sha256.data() - all);
  const std::size_t behind = before + organ.content_sha256.size();
  std::array<std::uint8_t, 32> sum{};
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(),
                                                                       &EVP_MD_CTX_free);
  if (EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1 ||
      EVP_DigestUpdate(digest.get(), all, before) != 1 ||
      EVP_DigestUpdate(digest.get(), all + behind, file.size() - behind) != 1 ||
      EVP_DigestFinal_ex(digest.get(), sum.data(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available in libcrypto");
  }
  return sum;
}

bool has_its_bytes(std::span<const std::byte> file, const Organ& organ) {
  if (organ.content_sha256.empty()) return organ.format_version == 1;
  return std::ranges::equal(content_sha256(file, organ), organ.content_sha256);
}

}  // namespace stylet
