// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/file.h"

#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <utility>

#include "base/refusal.h"

namespace stylet::offline {
namespace {

// All files that were read, so that none of them is overwritten.
std::set<std::pair<dev_t, ino_t>>& files_read() {
  static std::set<std::pair<dev_t, ino_t>> all;
  return all;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  struct stat now {};
  const int unknown = ::stat(path.c_str(), &now);
  const std::string why = unknown != 0 && errno == ENOENT ? "no such file"
                          : unknown != 0                  ? std::strerror(errno)
                          : S_ISDIR(now.st_mode)          ? "is a directory"
                          : !S_ISREG(now.st_mode) ? "is a device, a pipe or another special file"
                          : ::access(path.c_str(), R_OK) != 0 ? std::strerror(errno)
                          : now.st_size == 0                  ? "is empty"
                                                              : "";
  if (!why.empty()) refuse("{}: {}: expected a readable file", path.string(), why);
  const auto size = static_cast<std::uintmax_t>(now.st_size);
  if (size > kMaxFileBytes) {
    refuse("{}: {} bytes: expected at most {}", path.string(), size, kMaxFileBytes);
  }
  files_read().insert({now.st_dev, now.st_ino});
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) {
    refuse("{}: ends or cannot be read after {} of {} bytes: expected all of them", path.string(),
           stream.gcount(), size);
  }
  return bytes;
}

bool was_read(const std::filesystem::path& path) {
  struct stat now {};
  return ::stat(path.c_str(), &now) == 0 && files_read().contains({now.st_dev, now.st_ino});
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const int made =
      EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  if (made != 1) throw std::runtime_error("SHA-256 is not available in libcrypto");
  return hex_of({digest.data(), size});
}

std::string sum_line(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string_view view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return sha256_hex(view) + "  " + path.filename().string() + "\n";
}

bool has_sum_line(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path beside = path.string() + kSumEnding;
  const std::string some = sum_line(path, {});
  if (!std::filesystem::is_regular_file(beside, error)) return false;
  if (std::filesystem::file_size(beside, error) != some.size()) return false;
  const std::size_t digits = sha256_hex({}).size();
  const std::string text = read_file(beside);
  return text.find_first_not_of("0123456789abcdef") == digits &&
         std::string_view(text).substr(digits) == std::string_view(some).substr(digits);
}

SumCheck check_sum(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  const std::filesystem::path beside = path.string() + kSumEnding;
  if (!std::filesystem::exists(beside, error)) return SumCheck::kNone;
  return read_file(beside).starts_with(sha256_hex(bytes) + " ") ? SumCheck::kSame
                                                                : SumCheck::kDiffers;
}

}  // namespace stylet::offline
