// SPDX-License-Identifier: Apache-2.0
// A million ticks with a needle that goes in, pauses, is pulled and comes out again: no heap call,
// no page fault, no system call. Each trap is also shown to fire.
#include <gtest/gtest.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <memory>

#include "allocation_trap.h"
#include "session.h"

namespace stylet::test {
namespace {

// Without optimisation a million ticks take minutes, and the promise is about optimised builds,
// which are shipped.
#ifdef __OPTIMIZE__
constexpr std::uint64_t kTicks = 1'000'000;
#else
constexpr std::uint64_t kTicks = 20'000;
#endif

class MillionTicks : public testing::TestWithParam<Setup> {
 protected:
  std::unique_ptr<OpenOrgan> opened_ = block_organ(14, 4, 8);
  Config config_ = config_of(GetParam());
  Script script_ = block_script(opened_->organ, config_);
  Session session_ = make_session(opened_->organ, GetParam());

  // The script proves nothing unless the needle really went in and out.
  void expect_needle_was_busy() {
    const Stats seen = stats(session_.kernel);
    EXPECT_GE(seen.ticks, kTicks);
    EXPECT_GT(seen.constraint_particles.used_max, 2U);
    EXPECT_GT(seen.input_missing, 0U);
    EXPECT_GT(seen.input_not_finite, 0U);
    EXPECT_EQ(seen.fault, 0U);
    Event last[kMaxEvents];
    const std::uint32_t count = events(session_.kernel, last);
    bool punctured = false, left = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      punctured |= last[i].kind == EventKind::kPuncture || last[i].kind == EventKind::kReentry;
      left |= last[i].kind == EventKind::kExit;
    }
    EXPECT_TRUE(punctured && left);
  }
};

INSTANTIATE_TEST_SUITE_P(Modes, MillionTicks, testing::ValuesIn(kSetups),
                         [](const auto& instance) { return setup_name(instance.param); });

TEST(AllocationTrap, Fires) {
  arm_allocation_trap();
  int* volatile number = new int(1);
  const std::uint64_t after_new = disarm_allocation_trap();
  arm_allocation_trap();
  delete number;
  const std::uint64_t after_delete = disarm_allocation_trap();
  EXPECT_EQ(after_new, 1U);
  EXPECT_EQ(after_delete, 1U);
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

TEST_P(MillionTicks, CallNoHeapAndCauseNoPageFault) {
  // As in the loop: all memory is locked if that is allowed, and the script has run once before.
  mlockall(MCL_CURRENT);
  run(session_.kernel, script_, 0, kCycleTicks);
  const long before = page_faults();
  arm_allocation_trap();
  run(session_.kernel, script_, kCycleTicks, kTicks);
  EXPECT_EQ(disarm_allocation_trap(), 0U);
  EXPECT_EQ(page_faults() - before, 0);
  munlockall();
  expect_needle_was_busy();
}

TEST(PageFaultCount, Counts) {
  constexpr std::size_t kPages = 16;
  const auto page_bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* fresh = mmap(nullptr, kPages * page_bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  madvise(fresh, kPages * page_bytes, MADV_NOHUGEPAGE);
  const long before = page_faults();
  for (std::size_t i = 0; i < kPages; ++i) {
    static_cast<volatile char*>(fresh)[i * page_bytes] = 1;
  }
  EXPECT_GE(page_faults() - before, static_cast<long>(kPages));
  munmap(fresh, kPages * page_bytes);
}

// Runs `body` in a child process that may only read, write and exit; `body` returns what the child
// writes to the parent. The result says how the child ended.
struct ChildEnd {
  int status = 0;
  std::uint64_t value = 0;
  bool has_value = false;
};

template <typename Body>
ChildEnd run_without_system_calls(Body body) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) syscall(SYS_exit, 77);
    const std::uint64_t value = body();
    const bool written = write(ends[1], &value, sizeof value) == sizeof value;
    syscall(SYS_exit, written ? 0 : 1);
  }
  close(ends[1]);
  ChildEnd end;
  end.has_value = read(ends[0], &end.value, sizeof end.value) == sizeof end.value;
  close(ends[0]);
  waitpid(child, &end.status, 0);
  return end;
}

bool seccomp_missing(const ChildEnd& end) {
  return WIFEXITED(end.status) && WEXITSTATUS(end.status) == 77;
}

TEST_P(MillionTicks, CallNoSystem) {
  const ChildEnd end = run_without_system_calls([this] {
    run(session_.kernel, script_, 0, kTicks);
    return hash(session_.kernel);
  });
  if (seccomp_missing(end)) GTEST_SKIP() << "this host has no seccomp";
  ASSERT_TRUE(WIFEXITED(end.status)) << "killed by signal " << WTERMSIG(end.status);
  EXPECT_TRUE(end.has_value);
  EXPECT_NE(end.value, hash(session_.kernel)) << "the child's kernel never moved";
}

TEST(SystemCallTrap, Fires) {
  const ChildEnd end =
      run_without_system_calls([] { return static_cast<std::uint64_t>(syscall(SYS_getpid)); });
  if (seccomp_missing(end)) GTEST_SKIP() << "this host has no seccomp";
  ASSERT_TRUE(WIFSIGNALED(end.status));
  EXPECT_EQ(WTERMSIG(end.status), SIGKILL);
  EXPECT_FALSE(end.has_value);
}

}  // namespace
}  // namespace stylet::test
