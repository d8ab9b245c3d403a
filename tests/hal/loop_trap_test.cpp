// SPDX-License-Identifier: Apache-2.0
// The loop on the real clock makes no heap call, no page fault and no system call but sleeping.
// Each trap is also shown to fire.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>

#include "allocation_trap.h"
#include "hal/loop/host.h"
#include "rig.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kPeriodNs = 200'000;

// Uses everything that guard, coupling and device can do.
void run_on_real_clock(Rig& rig, const Device& device) {
  rig.config.period_ns = kPeriodNs;
  const DeviceModel& touch = *find_device_model("touch");
  rig.hand.config.device = touch.motion;
  GuardConfig& guard = rig.config.hand[0].guard;
  guard.device = touch.motion;
  guard.continuous_force_n = 0.05F;
  guard.thermal_s = 1;
  guard.passivity_damping_n_s_per_m = 2;
  rig.config.hand[0].coupling = {280, guard.max_force_n};
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), monotonic_clock(),
           {&rig.records, &rig.events, rig.display.get()}, rig.state);
}

// The same hand, whose `write` also does something a loop must not do.
struct Sinner {
  Device inner;
  void (*sin)();
};

Device sinning(Sinner& sinner) {
  const auto read = [](void* self, std::int64_t now_ns, Sample& sample) {
    const Device& inner = static_cast<Sinner*>(self)->inner;
    return inner.read(inner.self, now_ns, sample);
  };
  const auto write = [](void* self, const Command& command) {
    const Sinner& s = *static_cast<Sinner*>(self);
    s.inner.write(s.inner.self, command);
    s.sin();
  };
  return {&sinner, sinner.inner.info, read, write, [](void*) {}};
}

TEST(LoopTrap, CallsNoHeapAndCausesNoPageFault) {
  Rig rig;
  mlockall(MCL_CURRENT);
  const Input start = {to_world(rig.config.hand[0].mapping, {{}, {1, 0, 0, 0}}), 1};
  warm_up(rig.instance->kernel, std::span(&start, 1), 50);
  const ThreadUse before = thread_use();
  test::arm_allocation_trap();
  run_on_real_clock(rig, rig.device());
  EXPECT_EQ(test::disarm_allocation_trap(), 0U);
  const ThreadUse after = thread_use();
  munlockall();
  EXPECT_EQ(after.minor_faults + after.major_faults, before.minor_faults + before.major_faults);
  EXPECT_EQ(rig.state.ticks, rig.config.ticks);
  EXPECT_GT(rig.state.events_seen, 0U);
}

TEST(LoopTrap, HeapTrapFires) {
  Rig rig;
  Sinner sinner{rig.device(), [] {
                  int* volatile number = new int(1);  // volatile, or the compiler removes the pair
                  delete number;
                }};
  test::arm_allocation_trap();
  run_on_real_clock(rig, sinning(sinner));
  EXPECT_GE(test::disarm_allocation_trap(), rig.config.ticks);
}

// From here on any system call that is not allowed kills the process.
bool allow_only_sleep() {
  constexpr std::uint32_t kNumber = offsetof(seccomp_data, nr);
  sock_filter rules[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kNumber),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_nanosleep, 3, 0),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_gettime, 2, 0),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 1, 0),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program = {sizeof rules / sizeof rules[0], rules};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// How a child process ended that ran the loop and was allowed only to sleep, read the clock and
// exit.
int status_of_confined_run(void (*sin)()) {
  Rig rig;
  Sinner sinner{rig.device(), sin};
  const pid_t child = fork();
  if (child == 0) {
    if (!allow_only_sleep()) _exit(77);
    run_on_real_clock(rig, sinning(sinner));
    _exit(rig.state.ticks == rig.config.ticks ? 0 : 1);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

bool no_seccomp(int status) {
  return WIFEXITED(status) && WEXITSTATUS(status) == 77;
}

TEST(LoopTrap, MakesNoSystemCallButSleep) {
  const int status = status_of_confined_run([] {});
  if (no_seccomp(status)) GTEST_SKIP() << "this host has no seccomp";
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(LoopTrap, SystemCallTrapFires) {
  const int status = status_of_confined_run([] { (void)syscall(SYS_getppid); });
  if (no_seccomp(status)) GTEST_SKIP() << "this host has no seccomp";
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGSYS);
}

}  // namespace
}  // namespace stylet::hal
