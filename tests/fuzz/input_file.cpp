// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include "target.h"

namespace stylet::test {

InputFile::InputFile(std::span<const std::uint8_t> bytes, const char* suffix) {
  const char* folder = std::getenv("TMPDIR");
  path_ = std::string(folder != nullptr ? folder : "/tmp") + "/stylet-fuzz-XXXXXX" + suffix;
  const int fd = mkstemps(path_.data(), static_cast<int>(std::strlen(suffix)));
  promise(fd >= 0, "no temporary file could be made");
  const ssize_t written = write(fd, bytes.data(), bytes.size());
  promise(written == static_cast<ssize_t>(bytes.size()), "the temporary file is incomplete");
  (void)close(fd);
}

InputFile::~InputFile() {
  (void)std::remove(path_.c_str());
}

}  // namespace stylet::test
