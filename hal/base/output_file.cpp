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

#include "stylet/output_place.h"

namespace stylet::hal {
namespace {

constexpr mode_t kAllMayWrite = 0666;  // less the umask

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0;
}

// Never replaces a file; EEXIST: the name is taken. Without the system's own call (NFS, FUSE) by a
// second name, and without those (folders that a virtual machine shares) by a name that is reserved
// first.
bool rename_to_free(const char* from, const char* to) {
  if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  if (::link(from, to) == 0) {
    ::unlink(from);
    return true;
  }
  if (errno != EPERM && errno != ENOSYS && errno != EOPNOTSUPP) return false;
  const int reserved = ::open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAllMayWrite);
  if (reserved < 0) return false;
  ::close(reserved);
  if (std::rename(from, to) == 0) return true;
  const int error = errno;
  ::unlink(to);
  errno = error;
  return false;
}

}  // namespace

std::string checked_output(const std::string& path, std::span<const std::string> inputs) {
  if (path.empty()) return path;
  const OutputPlace place = output_place(path);
  if (!place.trouble.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", path, place.trouble));
  }
  std::error_code error;
  for (const std::string& input : inputs) {
    if (!input.empty() && std::filesystem::equivalent(place.path, input, error) && !error) {
      throw std::runtime_error(fmt::format(
          "{}: this command reads this file, too: expected another name for what it writes", path));
    }
  }
  return place.path.string();
}

std::string free_name(const OutputName& output) {
  namespace fs = std::filesystem;
  if (output.naming == Naming::kReplace) return output.wanted;
  const fs::path wanted = output.wanted;
  const bool numbered = output.naming == Naming::kNumber;
  const auto name = [&](int number) {
    if (number == 1 && !numbered) return wanted;
    fs::path with_number = wanted.parent_path() / wanted.stem();
    with_number += fmt::format("-{}{}", number, wanted.extension().string());
    return with_number;
  };
  int number = 1;
  while (fs::exists(fs::symlink_status(name(number)))) ++number;
  return name(number).string();
}

std::string take_name(const std::string& temporary, const std::string& first,
                      const OutputName& output) {
  if (output.naming == Naming::kReplace) {
    return std::rename(temporary.c_str(), first.c_str()) == 0 ? first : "";
  }
  for (std::string name = first;; name = free_name(output)) {
    if (rename_to_free(temporary.c_str(), name.c_str())) return name;
    if (errno != EEXIST) return "";
  }
}

void write_output(const std::string& path, std::string_view bytes) {
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
