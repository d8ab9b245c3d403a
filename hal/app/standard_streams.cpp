// SPDX-License-Identifier: Apache-2.0
#include "hal/app/standard_streams.h"

#include <limits.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "hal/app/stop_signal.h"

namespace stylet::app {
namespace {

constexpr int kLookMs = 100, kPatienceMs = 1000;

struct Stream {
  int file;
  bool drops;          // dropping what cannot be written is not an error
  int waited_ms = 0;   // since the end was asked for
  bool bound = false;  // the standard stream is this one
};
Stream g_out = {STDOUT_FILENO, false}, g_error = {STDERR_FILENO, true};

// False: nobody reads, and the end was asked for.
bool wait_for_room(Stream& stream) {
  pollfd room = {stream.file, POLLOUT, 0};
  while (::poll(&room, 1, kLookMs) <= 0) {
    if (!stop_was_asked()) continue;
    stream.waited_ms += kLookMs;
    if (stream.waited_ms > kPatienceMs) return false;
  }
  return true;
}

// Writes pieces so short that a pipe which has room takes each of them without waiting.
ssize_t write_bounded(void* cookie, const char* bytes, std::size_t size) {
  Stream& stream = *static_cast<Stream*>(cookie);
  std::size_t done = 0;
  while (done < size) {
    if (!wait_for_room(stream)) {
      errno = EAGAIN;
      break;
    }
    const ssize_t written =
        ::write(stream.file, bytes + done, std::min<std::size_t>(size - done, PIPE_BUF));
    if (written < 0 && errno != EINTR) break;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  if (done < size && errno == EAGAIN && stream.drops) return static_cast<ssize_t>(size);
  return static_cast<ssize_t>(done);
}

void bind(Stream& stream, std::FILE*& standard, int buffering) {
  if (stream.bound) return;
  std::fflush(standard);
  std::FILE* const bounded =
      ::fopencookie(&stream, "w", {nullptr, write_bounded, nullptr, nullptr});
  if (bounded == nullptr) return;  // no memory: the stream stays as it was
  (void)std::setvbuf(bounded, nullptr, buffering, BUFSIZ);
  standard = bounded;
  stream.bound = true;
}

}  // namespace

void bound_standard_streams() {
  bind(g_out, stdout, isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF);
  bind(g_error, stderr, _IONBF);
}

}  // namespace stylet::app
