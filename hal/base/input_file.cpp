// SPDX-License-Identifier: Apache-2.0
#include "hal/base/input_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace stylet::hal {

std::string why_unreadable(const std::string& path) {
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return errno == ENOENT ? "no such file" : strerror(errno);
  if (S_ISDIR(now.st_mode)) return "is a directory";
  if (!S_ISREG(now.st_mode) && !S_ISFIFO(now.st_mode)) return "is a device or another special file";
  if (::access(path.c_str(), R_OK) != 0) return strerror(errno);
  return S_ISREG(now.st_mode) && now.st_size == 0 ? "is empty" : "";
}

}  // namespace stylet::hal
