// SPDX-License-Identifier: Apache-2.0
// Counts the instructions a function executes, by single-stepping it in a child process: exact,
// whatever else the machine does, for every instruction set it has, without hardware counters.
// A repeated string instruction counts once. About a microsecond and a half an instruction.
#pragma once

#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace stylet::test {

namespace detail {

// Instructions between the child's two stops; nothing where stepping is not permitted.
template <typename Body>
std::optional<std::uint64_t> steps_between_stops(const Body& body) {
  const pid_t child = fork();
  if (child < 0) return {};
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGSTOP);
    body();
    raise(SIGSTOP);
    _exit(0);
  }
  std::uint64_t count = 0;
  long last = 0;
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return {};
  for (;;) {
    if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0) return {};
    if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return {};
    if (WSTOPSIG(status) == SIGSTOP) break;
    const long at = ptrace(PTRACE_PEEKUSER, child, offsetof(user_regs_struct, rip), nullptr);
    count += at != last ? 1 : 0;
    last = at;
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return count;
}

}  // namespace detail

template <typename Body>
std::optional<std::uint64_t> count_instructions(const Body& body) {
  const auto all = detail::steps_between_stops(body);
  const auto none = detail::steps_between_stops([] {});
  if (!all || !none) return {};
  return *all - *none;
}

}  // namespace stylet::test
