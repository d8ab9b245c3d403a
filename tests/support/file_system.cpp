// SPDX-License-Identifier: Apache-2.0
#include "file_system.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace {

bool g_exchanges = true, g_links = true;

}  // namespace

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) noexcept {
  if (!g_exchanges && flags != 0) {
    errno = EINVAL;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

extern "C" int link(const char* from, const char* to) noexcept {
  if (!g_links) {
    errno = EPERM;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace stylet::test {

FileSystem::FileSystem(bool exchanges, bool links) {
  g_exchanges = exchanges;
  g_links = links;
}

FileSystem::~FileSystem() {
  g_exchanges = g_links = true;
}

}  // namespace stylet::test
