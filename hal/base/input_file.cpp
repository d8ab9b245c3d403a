// SPDX-License-Identifier: Apache-2.0
#include "hal/base/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace stylet::hal {
namespace {

// Of a file that can be opened; a pipe's content is not known yet.
std::string why_no_text(const std::string& path, bool& is_pipe_out) {
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return errno == ENOENT ? "no such file" : strerror(errno);
  is_pipe_out = S_ISFIFO(now.st_mode);
  if (S_ISDIR(now.st_mode)) return "is a directory";
  if (!S_ISREG(now.st_mode) && !is_pipe_out) return "is a device or another special file";
  if (::access(path.c_str(), R_OK) != 0) return strerror(errno);
  return S_ISREG(now.st_mode) && now.st_size == 0 ? "is empty" : "";
}

// Reads to the end from a descriptor that does not block. As long as a pipe had no writer, it ends
// at once.
std::string read_to_end(int file, bool is_pipe, std::size_t most, std::string& text_out) {
  constexpr int kWriterMs = 5000;
  std::array<char, 65536> block{};
  bool had_writer = !is_pipe, has_waited = false;
  while (true) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got > 0) {
      text_out.append(block.data(), static_cast<std::size_t>(got));
      if (text_out.size() > most) return "has more than " + std::to_string(most) + " bytes";
      had_writer = true;
      continue;
    }
    if (got < 0 && errno != EAGAIN && errno != EINTR) return strerror(errno);
    had_writer = had_writer || got < 0;
    if (got == 0 && had_writer) return text_out.empty() ? "is empty" : "";
    if (got == 0 && has_waited) return "is a pipe that nobody writes to";
    pollfd change = {file, POLLIN, 0};
    has_waited = ::poll(&change, 1, had_writer ? -1 : kWriterMs) == 0;
    had_writer = had_writer || change.revents != 0;
  }
}

}  // namespace

std::string why_unreadable(const std::string& path) {
  bool is_pipe = false;
  const std::string why = why_no_text(path, is_pipe);
  return why.empty() && is_pipe ? "is a pipe" : why;
}

std::string read_whole(const std::string& path, std::size_t most, std::string& text_out) {
  bool is_pipe = false;
  if (std::string why = why_no_text(path, is_pipe); !why.empty()) return why;
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return strerror(errno);
  std::string why = read_to_end(file, is_pipe, most, text_out);
  ::close(file);
  return why;
}

}  // namespace stylet::hal
