// SPDX-License-Identifier: GPL-3.0-or-later
#include "file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <utility>

#include "refusal.h"

namespace stylet::bake {
namespace {

// Every file that was read, so that none of them is written over.
std::set<std::pair<dev_t, ino_t>>& files_read() {
  static std::set<std::pair<dev_t, ino_t>> all;
  return all;
}

// Refused before anything is made: an input, a device, a directory.
void check_output(const std::filesystem::path& path) {
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return;
  if (S_ISDIR(now.st_mode)) {
    refuse("{}: is a directory: expected the name of a file", path.string());
  }
  if (!S_ISREG(now.st_mode)) {
    refuse("{}: is a device or another special file: expected the name of a file", path.string());
  }
  if (files_read().contains({now.st_dev, now.st_ino})) {
    refuse("{}: is read by this command, too: expected another name", path.string());
  }
}

constexpr std::uintmax_t kMaxFileBytes = 4ULL << 30U;

// Writes, syncs and renames; false leaves errno set.
bool write_and_rename(int file, std::span<const std::byte> bytes, const std::string& temporary,
                      const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    refuse("{}: {}: expected a readable file", path.string(),
           std::filesystem::exists(path, error) ? "not a regular file" : "no such file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMaxFileBytes) {
    refuse("{}: {} bytes: expected at most {}", path.string(), size, kMaxFileBytes);
  }
  struct stat now {};
  if (::stat(path.c_str(), &now) == 0) files_read().insert({now.st_dev, now.st_ino});
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(bytes.size())) {
    refuse("{}: cannot be read: {}", path.string(), std::strerror(errno));
  }
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  check_output(path);
  std::string temporary = path.string() + ".part-XXXXXX";
  const int file = ::mkstemp(temporary.data());
  if (file < 0) refuse("{}: cannot be written: {}", path.string(), std::strerror(errno));
  const mode_t mask = ::umask(0);  // can only be read by setting it
  ::umask(mask);
  constexpr mode_t kAllMayWrite = 0666;
  const bool good =
      ::fchmod(file, kAllMayWrite & ~mask) == 0 && write_and_rename(file, bytes, temporary, path);
  const int error = errno;
  ::close(file);
  if (!good) {
    ::unlink(temporary.c_str());
    refuse("{}: cannot be written: {}", path.string(), std::strerror(error));
  }
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available in libcrypto");
  }
  return hex_of({digest.data(), size});
}

void write_sum(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string_view view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string line = sha256_hex(view) + "  " + path.filename().string() + "\n";
  write_file(path.string() + kSumEnding, std::as_bytes(std::span(line)));
}

SumCheck check_sum(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  const std::filesystem::path beside = path.string() + kSumEnding;
  if (!std::filesystem::exists(beside, error)) return SumCheck::kNone;
  return read_file(beside).starts_with(sha256_hex(bytes) + " ") ? SumCheck::kSame
                                                                : SumCheck::kDiffers;
}

}  // namespace stylet::bake
