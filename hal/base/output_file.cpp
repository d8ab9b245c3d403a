// SPDX-License-Identifier: Apache-2.0
#include "hal/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace stylet::hal {
namespace {

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0;
}

}  // namespace

void check_output(const std::string& path, std::span<const std::string> inputs) {
  namespace fs = std::filesystem;
  if (path.empty()) return;
  std::error_code error;
  const fs::file_status now = fs::status(path, error);
  if (fs::is_directory(now)) {
    throw std::runtime_error(fmt::format("{}: is a directory: expected the name of a file", path));
  }
  if (fs::exists(now) && !fs::is_regular_file(now)) {
    throw std::runtime_error(
        fmt::format("{}: is a device or another special file: expected the name of a file", path));
  }
  for (const std::string& input : inputs) {
    if (!input.empty() && fs::equivalent(path, input, error) && !error) {
      throw std::runtime_error(fmt::format(
          "{}: this command reads this file, too: expected another name for what it writes", path));
    }
  }
}

std::string kept_name(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path wanted = path;
  fs::path name = wanted;
  for (int number = 2; fs::exists(fs::symlink_status(name)); ++number) {
    name = wanted.parent_path() / wanted.stem();
    name += fmt::format("-{}{}", number, wanted.extension().string());
  }
  return name.string();
}

void write_output(const std::string& path, std::string_view bytes) {
  constexpr mode_t kAllMayWrite = 0666;  // less the umask
  const std::string temporary = fmt::format("{}.{}.tmp", path, getpid());
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAllMayWrite);
  bool good = file >= 0 && write_all(file, bytes);
  good = good && std::rename(temporary.c_str(), path.c_str()) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (good) return;
  if (file >= 0) std::remove(temporary.c_str());
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(error)));
}

}  // namespace stylet::hal
